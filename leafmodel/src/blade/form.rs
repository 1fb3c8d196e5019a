//! The lamina bent in space: ruffle, pleats, fold and curl, as one smooth map.
//!
//! A point of the flat lamina, given with its height above it, is displaced in four steps: by the
//! ruffle and the folds along veins, perpendicular to the lamina; onto the curved blade, if the lamina is the map of one; by
//! the fold about the midrib; and by the curl along it. Each step has continuous first derivatives,
//! so the blade has no crease. The fold preserves lengths across the midrib, the curl lengths along
//! it.

use glam::{DVec2, DVec3};

use super::plan::BladeForm;
use super::pleats::Pleats;
use crate::numeric::spline_weights;
use crate::plane::polygon;
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;

/// Distance from the midrib, over the leaf's length, at which the fold has reached tanh 1 = 76 % of
/// its angle.
const FOLD_ROUNDING: f64 = 0.03;
/// Entries of the fold's table on each side.
const FOLD_STEPS: usize = 1024;
/// Number of places along the leaf at which its width is stored.
const WIDTH_BINS: usize = 128;
/// The width used for the ruffle is averaged over this share of the length, which hides lobes and
/// teeth.
const WIDTH_BLUR: f64 = 0.08;
/// Least width for the ruffle, over the greatest.
const LEAST_WIDTH: f64 = 0.35;
/// Phase lead of the waves of the left margin over those of the right one, radians, since real
/// margins are not mirror images.
const LEFT_AHEAD: f64 = 1.9;

impl BladeForm {
    /// A coarse sheet of the blade of a flat leaf of this outline: `count` ≥ 2 rows, from the lowest
    /// point of the margin to the highest, of the leftmost, a middle and the rightmost place, mm, in
    /// the leaf's frame. Lobes and teeth count as if the blade filled the gaps between them.
    pub(crate) fn rows(&self, outline: &Outline, count: usize) -> Vec<[DVec3; 3]> {
        let bending = Bending::new(self, outline, ConformalMap::FLAT);
        let points = outline.points();
        let (low, high) = outline.bounds();
        let step = (high.y - low.y) / (count - 1) as f64;
        (0..count)
            .map(|row| {
                let y = low.y + step * row as f64;
                let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
                let mut take = |x: f64| reach = [reach[0].min(x), reach[1].max(x)];
                for (a, b) in polygon::sides(points) {
                    if (a.y - y).abs() <= 0.5 * step {
                        take(a.x);
                    }
                    if (a.y - y) * (b.y - y) < 0.0 {
                        take(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                    }
                }
                let [left, right] = reach;
                let middle = outline.base().x.clamp(left, right);
                [left, middle, right].map(|x| bending.place(DVec2::new(x, y), 0.0))
            })
            .collect()
    }
}

/// The map from the flat lamina into space.
#[derive(Debug)]
pub(super) struct Bending {
    base: DVec2,
    /// The conformal map of a blade with Gaussian curvature.
    map: ConformalMap,
    /// Place of the base on the curved blade.
    base_in_space: DVec3,
    ruffle: Ruffle,
    pleats: Option<Pleats>,
    fold: Fold,
    /// Curvature of the midrib, 1/mm.
    curvature: f64,
}

impl Bending {
    /// The map that `form` gives to a leaf of this outline. The base goes to the origin.
    pub(super) fn new(form: &BladeForm, outline: &Outline, map: ConformalMap) -> Self {
        let length = outline.length();
        let (low, high) = outline.bounds();
        let widest = (high.x - outline.base().x).max(outline.base().x - low.x);
        Self {
            base: outline.base(),
            map,
            base_in_space: map.in_space(outline.base(), 0.0),
            ruffle: Ruffle::new(form, outline),
            pleats: None,
            fold: Fold::new(form.fold, FOLD_ROUNDING * length, widest),
            curvature: form.curl / length,
        }
    }

    /// The same with folds along veins.
    pub(super) fn pleated(self, pleats: Pleats) -> Self {
        Self {
            pleats: Some(pleats),
            ..self
        }
    }

    /// The place in space, mm, of the point at `height` (mm, towards the adaxial side) above the
    /// flat point `p`.
    pub(super) fn place(&self, p: DVec2, height: f64) -> DVec3 {
        let q = p - self.base;
        let folded = self.pleats.as_ref().map_or(0.0, |pleats| pleats.height(p));
        let height = height + self.ruffle.height(q) + folded;
        let (q, height) = if self.map.is_flat() {
            (q, height)
        } else {
            let at = self.map.in_space(p, height) - self.base_in_space;
            (at.truncate(), at.z)
        };
        let (x, z) = self.fold.place(q.x, height);
        self.curled(x, q.y, z)
    }

    /// Bends the plane x = 0 about an axis at distance 1/curvature towards −z. With
    /// `s = sin(κy)/κ` and `v = (1 − cos κy)/κ`, `(y, z)` goes to `(s + z κ s, z − (1 + κz) v)`.
    fn curled(&self, x: f64, y: f64, z: f64) -> DVec3 {
        let k = self.curvature;
        let angle = k * y;
        // Series keep both accurate as the curvature goes to 0.
        let (s, v) = if angle.abs() < 1e-6 {
            (y, 0.5 * k * y * y)
        } else {
            let half = libm::sin(0.5 * angle);
            (libm::sin(angle) / k, 2.0 * half * half / k)
        };
        let stretch = 1.0 + k * z;
        DVec3::new(x, stretch * s, z - stretch * v)
    }
}

/// The bend across the midrib: the lamina turns by `angle · tanh(x / w)`, which is an arc near the
/// midrib and straight away from it.
#[derive(Debug)]
struct Fold {
    angle: f64,
    rounding: f64,
    step: f64,
    /// Place of the lamina in the plane across the midrib, at multiples of `step` from it.
    table: Vec<DVec2>,
}

impl Fold {
    fn new(angle: f64, rounding: f64, widest: f64) -> Self {
        let step = widest / FOLD_STEPS as f64;
        let mut fold = Self {
            angle,
            rounding,
            step,
            table: vec![DVec2::ZERO],
        };
        let mut at = DVec2::ZERO;
        for i in 0..=FOLD_STEPS {
            let x = step * i as f64;
            // Simpson's rule: the step is far below the rounding, the error below 1e-12 of the
            // width.
            let sum = fold.along(x) + 4.0 * fold.along(x + 0.5 * step) + fold.along(x + step);
            at += sum * (step / 6.0);
            fold.table.push(at);
        }
        fold
    }

    /// Direction of the lamina at a distance from the midrib.
    fn along(&self, x: f64) -> DVec2 {
        let turned = self.angle * libm::tanh(x / self.rounding);
        DVec2::new(libm::cos(turned), libm::sin(turned))
    }

    /// The place, in the plane across the midrib, of a point at the distance `x` from the midrib
    /// along the lamina and at `height` above it.
    fn place(&self, x: f64, height: f64) -> (f64, f64) {
        let side = if x < 0.0 { -1.0 } else { 1.0 };
        let x = x.abs();
        let i = ((x / self.step) as usize).min(FOLD_STEPS);
        let (left, right) = (self.step * i as f64, self.step * (i + 1) as f64);
        let t = (x - left) / self.step;
        // A cubic with the exact places and directions at both entries, so that slopes are
        // continuous.
        let (from, to) = (self.table[i], self.table[i + 1]);
        let (d_from, d_to) = (self.along(left) * self.step, self.along(right) * self.step);
        let at = from
            + t * (d_from
                + t * ((3.0 * (to - from) - 2.0 * d_from - d_to)
                    + t * (2.0 * (from - to) + d_from + d_to)));
        let normal = self.along(x).perp();
        let p = at + normal * height;
        (side * p.x, p.y)
    }
}

/// The wave along the margin: `A (x/w)² sin(2π n y / L)`, with the smoothed half-width `w(y)`.
#[derive(Debug)]
struct Ruffle {
    amplitude: f64,
    /// Radians per mm.
    frequency: f64,
    low: f64,
    bin: f64,
    widths: Vec<f64>,
}

impl Ruffle {
    fn new(form: &BladeForm, outline: &Outline) -> Self {
        let length = outline.length();
        let (low, high) = outline.bounds();
        let low = low.y - outline.base().y;
        let high = high.y - outline.base().y;
        let bin = (high - low) / WIDTH_BINS as f64;
        Self {
            amplitude: form.ruffle * length,
            frequency: std::f64::consts::TAU * form.ruffle_waves / length,
            low,
            bin,
            widths: half_widths(outline, low, bin, WIDTH_BLUR * length / bin),
        }
    }

    fn height(&self, q: DVec2) -> f64 {
        if self.amplitude == 0.0 {
            return 0.0;
        }
        let share = q.x / self.width(q.y);
        let ahead = if q.x < 0.0 { LEFT_AHEAD } else { 0.0 };
        // Second order in x: both halves meet at the midrib with the same (zero) height and slope.
        let growth = share * share / (1.0 + 0.25 * share * share);
        self.amplitude * growth * libm::sin(self.frequency * q.y + ahead)
    }

    /// Half-width at a height on the leaf: a uniform quadratic B-spline over the bins, which has
    /// continuous slopes.
    fn width(&self, y: f64) -> f64 {
        let last = self.widths.len() as f64 - 1.0;
        let place = ((y - self.low) / self.bin - 0.5).clamp(0.0, last);
        let middle = (place + 0.5).floor().min(last);
        let t = place - middle;
        let at = |offset: f64| self.widths[(middle + offset).clamp(0.0, last) as usize];
        let [before, here, behind] = spline_weights(t);
        before * at(-1.0) + here * at(0.0) + behind * at(1.0)
    }
}

/// Greatest distance of the margin from the midrib in each bin along the leaf, blurred by a
/// Gaussian of `sigma` bins, and not below a share of the greatest.
fn half_widths(outline: &Outline, low: f64, bin: f64, sigma: f64) -> Vec<f64> {
    let mut raw = vec![0.0_f64; WIDTH_BINS];
    let points = outline.points();
    for (a, b) in polygon::sides(points) {
        let (a, b) = (a - outline.base(), b - outline.base());
        let pieces = ((b.y - a.y).abs() / bin).ceil().max(1.0);
        for piece in 0..=pieces as usize {
            let p = a.lerp(b, piece as f64 / pieces);
            let at = (((p.y - low) / bin) as usize).min(WIDTH_BINS - 1);
            raw[at] = raw[at].max(p.x.abs());
        }
    }
    let greatest = raw.iter().copied().fold(0.0, f64::max);
    let reach = libm::ceil(3.0 * sigma) as usize;
    (0..WIDTH_BINS)
        .map(|i| {
            let (mut sum, mut weights) = (0.0, 0.0);
            let near = i.saturating_sub(reach)..(i + reach + 1).min(WIDTH_BINS);
            for (j, &width) in near.clone().zip(&raw[near]) {
                let d = (j as f64 - i as f64) / sigma;
                let weight = libm::exp(-0.5 * d * d);
                sum += weight * width;
                weights += weight;
            }
            (sum / weights).max(LEAST_WIDTH * greatest)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::blade::tests::{ellipse, flat};
    use properties::fixed;

    fn bent() -> BladeForm {
        BladeForm {
            fold: 0.6,
            curl: 0.9,
            ruffle: 0.02,
            ruffle_waves: 5.0,
            ..flat()
        }
    }

    #[test]
    fn rows_of_a_coarse_sheet_reach_the_margin_and_bend_with_the_blade() {
        let outline = ellipse(20.0, 60.0, 60);
        let rows = flat().rows(&outline, 7);
        let (low, high) = outline.bounds();
        assert_eq!((rows[0][1].y, rows[6][1].y), (low.y, high.y));
        let [left, middle, right] = rows[3];
        assert!((left.x - low.x).abs() < 0.1 && (right.x - high.x).abs() < 0.1);
        assert_eq!(middle.x, outline.base().x);
        let bending = Bending::new(&bent(), &outline, ConformalMap::FLAT);
        for (flat, bent) in rows.iter().zip(bent().rows(&outline, 7)) {
            for (flat, bent) in flat.iter().zip(bent) {
                assert!(bending.place(flat.truncate(), 0.0).distance(bent) < 1e-9);
            }
        }
    }

    #[test]
    fn a_flat_form_leaves_the_lamina_where_it_is() {
        let bending = Bending::new(&flat(), &ellipse(20.0, 60.0, 60), ConformalMap::FLAT);
        for p in [(0.0, 0.0), (3.0, 20.0), (-7.5, 41.0)].map(DVec2::from) {
            let placed = bending.place(p, 0.25);
            assert!((placed - p.extend(0.25)).length() < 1e-12, "{placed}");
        }
    }

    #[test]
    fn the_curl_keeps_the_midrib_and_bends_it_towards_the_abaxial_side() {
        let form = BladeForm {
            curl: 1.2,
            ..flat()
        };
        let bending = Bending::new(&form, &ellipse(20.0, 60.0, 60), ConformalMap::FLAT);
        let radius = 60.0 / 1.2;
        for y in [0.0, 10.0, 35.0, 60.0] {
            let placed = bending.place(DVec2::new(0.0, y), 0.0);
            let angle = y / radius;
            let arc = DVec3::new(0.0, radius * angle.sin(), radius * (angle.cos() - 1.0));
            assert!((placed - arc).length() < 1e-12, "{placed}");
        }
    }

    #[test]
    fn the_fold_raises_both_halves_by_its_angle() {
        let form = BladeForm {
            fold: 0.5,
            ..flat()
        };
        let bending = Bending::new(&form, &ellipse(40.0, 60.0, 60), ConformalMap::FLAT);
        for side in [-1.0, 1.0] {
            let [a, b] = [12.0, 18.0].map(|x| bending.place(DVec2::new(side * x, 30.0), 0.0));
            let (rise, run) = (b.z - a.z, side * (b.x - a.x));
            assert!((rise.atan2(run) - 0.5).abs() < 1e-3, "{}", rise.atan2(run));
            assert!((rise.hypot(run) - 6.0).abs() < 1e-9);
        }
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn the_map_has_continuous_slopes(x in -9.0..9.0, y in 0.0..60.0, turn in 0.0..6.3) {
            let bending = Bending::new(&bent(), &ellipse(20.0, 60.0, 60), ConformalMap::FLAT);
            // One-sided differences from both sides of a point agree up to the second derivative.
            let step = 1e-4 * DVec2::new(libm::cos(turn), libm::sin(turn));
            for p in [DVec2::new(x, y), DVec2::new(0.0, y)] {
                let [before, at, after] = [p - step, p, p + step].map(|p| bending.place(p, 0.0));
                let jump = ((after - at) - (at - before)).length() / 1e-4;
                prop_assert!(jump < 2e-4, "slopes jump by {} at {}", jump, p);
            }
        }
    }
}
