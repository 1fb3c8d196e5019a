//! Folds along secondary veins: the blade is corrugated as it lay in the bud.
//!
//! Such a (plicate) blade has a fold along each secondary vein, which lies in the valley, and one
//! half-way between two of them, which is the ridge on the adaxial side. So its height is the
//! distance to the nearest of these veins times the slope of the folds. The veins are those of the
//! net: all primaries, and the secondaries that are not much finer than the thickest one.
//!
//! The height is kept on a square lattice and read as a quadratic B-spline, so folds are rounded
//! over about one and a half places of the lattice and slopes are continuous.

use std::collections::BTreeMap;

use glam::DVec2;

use super::plan::BladeForm;
use crate::numeric::spline_weights;
use crate::shape::outline::Outline;
use crate::venation::network::VeinSegment;

/// Places of the lattice along the leaf.
const PLACES: f64 = 200.0;
/// Most places along a side of the lattice, for leaves far wider than long.
const MOST_PLACES: f64 = 1000.0;
/// Least radius of a secondary, where it begins, over that of the thickest one.
const STRONG: f64 = 0.4;
/// Share of the leaf's length within which folds rise from the base.
const RISE: f64 = 0.12;

/// Heights of the folds over the flat lamina.
#[derive(Clone, Debug)]
pub(super) struct Pleats {
    origin: DVec2,
    spacing: f64,
    columns: usize,
    rows: usize,
    /// mm, row by row; empty without folds.
    heights: Vec<f64>,
}

impl Pleats {
    /// The folds that `form` gives to a leaf with these veins.
    pub(super) fn new(form: &BladeForm, outline: &Outline, veins: &[VeinSegment]) -> Self {
        let length = outline.length();
        let (low, high) = outline.bounds();
        let spacing = (length / PLACES).max((high - low).max_element() / MOST_PLACES);
        let origin = low - 2.0 * spacing;
        let count = ((high - low) / spacing).ceil() + 5.0;
        let mut pleats = Self {
            origin,
            spacing,
            columns: count.x as usize,
            rows: count.y as usize,
            heights: Vec::new(),
        };
        let folded = if form.pleat == 0.0 {
            Vec::new()
        } else {
            folded_along(veins)
        };
        if folded.is_empty() {
            return pleats;
        }
        let slope = libm::tan(form.pleat);
        let nearest = pleats.nearest(&folded);
        let place = |i: usize| {
            origin + spacing * DVec2::new((i % pleats.columns) as f64, (i / pleats.columns) as f64)
        };
        // Beside the base, folds of both sides would meet on top of each other.
        let rise = |p: DVec2| (p.distance(outline.base()) / (RISE * length)).min(1.0);
        pleats.heights = (0..nearest.len())
            .map(|i| slope * rise(place(i)) * place(i).distance(nearest[i]))
            .collect();
        pleats
    }

    /// The nearest point of the veins for each place of the lattice, found by sweeps in which each
    /// place tries those of its neighbours (Danielsson 1980).
    fn nearest(&self, veins: &[VeinSegment]) -> Vec<DVec2> {
        let (columns, rows) = (self.columns as isize, self.rows as isize);
        let mut nearest = vec![DVec2::INFINITY; self.columns * self.rows];
        let place = |column: isize, row: isize| {
            self.origin + self.spacing * DVec2::new(column as f64, row as f64)
        };
        let closer = |found: &mut DVec2, p: DVec2, other: DVec2| {
            if !found.is_finite() || other.distance_squared(p) < found.distance_squared(p) {
                *found = other;
            }
        };
        for vein in veins {
            let pieces = (4.0 * vein.from.distance(vein.to) / self.spacing)
                .ceil()
                .max(1.0);
            for piece in 0..=pieces as usize {
                let q = vein.from.lerp(vein.to, piece as f64 / pieces);
                let corner = ((q - self.origin) / self.spacing).floor();
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let (column, row) = (corner.x as isize + dx, corner.y as isize + dy);
                    if (0..columns).contains(&column) && (0..rows).contains(&row) {
                        let at = (row * columns + column) as usize;
                        closer(&mut nearest[at], place(column, row), q);
                    }
                }
            }
        }
        // Twice in each direction: the front of a sweep goes round what a vein hides.
        for sweep in 0..4 {
            let backward = sweep % 2 == 1;
            for i in 0..columns * rows {
                let at = if backward { columns * rows - 1 - i } else { i };
                let (column, row) = (at % columns, at / columns);
                let mut found = nearest[at as usize];
                for (dx, dy) in [(-1, 0), (-1, -1), (0, -1), (1, -1)] {
                    let side = if backward { -1 } else { 1 };
                    let (x, y) = (column + side * dx, row + side * dy);
                    if (0..columns).contains(&x) && (0..rows).contains(&y) {
                        let other = nearest[(y * columns + x) as usize];
                        if other.is_finite() {
                            closer(&mut found, place(column, row), other);
                        }
                    }
                }
                nearest[at as usize] = found;
            }
            // Along rows the other way too, as neighbours of one row depend on each other.
            for i in 0..columns * rows {
                let at = if backward { i } else { columns * rows - 1 - i };
                let (column, row) = (at % columns, at / columns);
                let x = column + if backward { -1 } else { 1 };
                if (0..columns).contains(&x) {
                    let other = nearest[(row * columns + x) as usize];
                    if other.is_finite() {
                        closer(&mut nearest[at as usize], place(column, row), other);
                    }
                }
            }
        }
        nearest
    }

    /// The folds as a grid with cells of this side (mm) sees them: averaged over a square of that
    /// side.
    pub(super) fn seen_by(mut self, side: f64) -> Self {
        let half = (0.5 * side / self.spacing).round() as usize;
        let (columns, rows) = (self.columns, self.rows);
        // Of the heights before each place of a line.
        let mut sums: Vec<f64> = Vec::new();
        for (step, count, others) in [(1, columns, rows), (columns, rows, columns)] {
            let before = self.heights.clone();
            if before.is_empty() {
                break;
            }
            for line in 0..others {
                let from = line * if step == 1 { columns } else { 1 };
                let at = |i: usize| before[from + i.min(count - 1) * step];
                sums.clear();
                sums.push(0.0);
                for i in 0..count + half {
                    sums.push(sums[i] + at(i));
                }
                for i in 0..count {
                    let (first, end) = (i.saturating_sub(half), i + half + 1);
                    self.heights[from + i * step] =
                        (sums[end] - sums[first]) / (end - first) as f64;
                }
            }
        }
        self
    }

    /// Height of a flat point towards the adaxial side, mm, ≥ 0.
    pub(super) fn height(&self, p: DVec2) -> f64 {
        if self.heights.is_empty() {
            return 0.0;
        }
        let most = DVec2::new(self.columns as f64 - 2.0, self.rows as f64 - 2.0);
        let place = ((p - self.origin) / self.spacing).clamp(DVec2::ONE, most);
        let middle = (place + 0.5).floor().min(most);
        let t = place - middle;
        let (x, y) = (spline_weights(t.x), spline_weights(t.y));
        let first = (middle.y as usize - 1) * self.columns + middle.x as usize - 1;
        (0..3)
            .map(|row| {
                let values = &self.heights[first + row * self.columns..][..3];
                y[row] * (x[0] * values[0] + x[1] * values[1] + x[2] * values[2])
            })
            .sum()
    }
}

/// The veins along which a blade is folded: primaries, and strong secondaries to their ends.
fn folded_along(veins: &[VeinSegment]) -> Vec<VeinSegment> {
    let key = |p: DVec2| [p.x.to_bits(), p.y.to_bits()];
    // The secondary that leads to each point.
    let mut leading: BTreeMap<[u64; 2], usize> = BTreeMap::new();
    for (number, vein) in veins.iter().enumerate().filter(|(_, vein)| vein.order == 2) {
        let best = leading.entry(key(vein.to)).or_insert(number);
        if veins[*best].radius_from < vein.radius_from {
            *best = number;
        }
    }
    // Radius where the secondary of each piece begins.
    let mut start = vec![0.0_f64; veins.len()];
    for (number, vein) in veins.iter().enumerate().filter(|(_, vein)| vein.order == 2) {
        let mut way = vec![number];
        let mut at = vein.from;
        let known = loop {
            match leading.get(&key(at)) {
                Some(&before) if start[before] > 0.0 => break start[before],
                // A ring of secondaries has no beginning.
                Some(&before) if !way.contains(&before) => {
                    way.push(before);
                    at = veins[before].from;
                }
                Some(_) | None => break veins[way[way.len() - 1]].radius_from,
            }
        };
        for number in way {
            start[number] = known;
        }
    }
    let thickest = start.iter().copied().fold(0.0, f64::max);
    let strong = |number: usize| match veins[number].order {
        1 => true,
        2 => start[number] >= STRONG * thickest,
        _ => false,
    };
    (0..veins.len())
        .filter(|&number| strong(number))
        .map(|number| veins[number])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::tests::{ellipse, flat, herringbone};

    fn pleated(veins: &[VeinSegment]) -> Pleats {
        let form = BladeForm {
            pleat: 0.3,
            ..flat()
        };
        Pleats::new(&form, &ellipse(40.0, 60.0, 120), veins)
    }

    fn exact(veins: &[VeinSegment], p: DVec2) -> f64 {
        let distance = |vein: &VeinSegment| {
            let along = vein.to - vein.from;
            let share = ((p - vein.from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (vein.from + along * share).distance(p)
        };
        veins.iter().map(distance).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_height_is_the_distance_to_the_next_fold_times_the_slope() {
        let veins = herringbone(60.0, 7, 0.5);
        let pleats = pleated(&veins);
        for i in 0..400 {
            let p = DVec2::new(-11.0 + 0.055 * f64::from(i), 14.0 + 0.09 * f64::from(i));
            let wanted = libm::tan(0.3) * exact(&veins, p);
            // Rounded over a place and a half of 0.3 mm, at 0.31 of slope.
            let off = (pleats.height(p) - wanted).abs();
            assert!(off < 0.09, "{off} at {p}");
        }
    }

    #[test]
    fn fine_secondaries_fold_nothing() {
        let veins = herringbone(60.0, 7, 0.5);
        let mut more = veins.clone();
        let from = DVec2::new(0.0, 30.3);
        more.push(VeinSegment {
            from,
            to: from + DVec2::new(6.0, 4.0),
            radius_from: 0.03,
            radius_to: 0.02,
            order: 2,
        });
        let p = from + DVec2::new(4.0, 2.6);
        assert_eq!(pleated(&veins).height(p), pleated(&more).height(p));
    }

    #[test]
    fn a_secondary_folds_the_blade_to_its_thin_end() {
        let veins = herringbone(60.0, 3, 0.5);
        let last = veins
            .iter()
            .rfind(|vein| vein.order == 2)
            .expect("a secondary");
        let pleats = pleated(&veins);
        let aside = (last.to - last.from).perp().normalize() * 2.0;
        let end = last.from;
        assert!(pleats.height(end) < 0.1, "{}", pleats.height(end));
        assert!(pleats.height(end + aside) > 0.5);
    }

    #[test]
    fn a_grid_sees_wide_folds_and_not_those_finer_than_its_cells() {
        let veins = herringbone(60.0, 7, 0.5);
        let (exact, fine) = (pleated(&veins), pleated(&veins).seen_by(0.6));
        let coarse = pleated(&veins).seen_by(16.0);
        let spread = |pleats: &Pleats| {
            let heights =
                (0..200).map(|i| pleats.height(DVec2::new(7.0, 20.0 + 0.1 * f64::from(i))));
            let all: Vec<f64> = heights.collect();
            let [low, high] = [f64::min, f64::max].map(|f| all.iter().copied().reduce(f));
            high.expect("heights") - low.expect("heights")
        };
        let [exact, fine, coarse] = [&exact, &fine, &coarse].map(spread);
        assert!(fine > 0.85 * exact && fine < exact, "{fine} of {exact}");
        assert!(coarse < 0.35 * exact, "{coarse} of {exact}");
    }

    #[test]
    fn without_an_angle_there_are_no_folds() {
        let pleats = Pleats::new(
            &flat(),
            &ellipse(40.0, 60.0, 60),
            &herringbone(60.0, 5, 0.5),
        );
        assert_eq!(pleats.height(DVec2::new(3.0, 20.0)), 0.0);
    }
}
