//! Stomata: elliptic pits in a face.
//!
//! A pit of half axes a, b and depth D has the height `−D (1 − q²)²` at `q² = (x/a)² + (y/b)² < 1`.
//! Scattered stomata lie one to each cell of a jittered grid, in any direction; those in rows follow
//! the veins: rows are lines of equal distance to the nearest vein, and pits are long along them.
//! Their slopes are part of what the coat's roughness is made of, as those of cells are.

use std::f32::consts::{PI, TAU};

use glam::{IVec2, Vec2};

use super::cells::{SPREAD, smooth};
use crate::sampling::mixer;

/// Jitter of scattered stomata, and of those in rows across and along, in cells of the grid.
const JITTER: [Vec2; 2] = [Vec2::splat(0.6), Vec2::new(0.12, 0.5)];
/// Width of a ray in widths of a pit up to which pits are seen whole, and from which they are not.
const SEEN: [f32; 2] = [0.3, 1.2];
/// Greatest share of the square of the coat's roughness that is theirs.
const MOST_SHARE: f32 = 0.5;
/// Distances to a vein between which scattered stomata set in, in their lengths.
const SET_IN: [f32; 2] = [1.0, 2.0];

/// Numbers of the stomata of both faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StomataNumbers {
    /// Stomata per mm² of the adaxial and the abaxial face.
    pub per_mm2: [f32; 2],
    /// Length of a pit, µm.
    pub length_um: f32,
    /// Its width over its length.
    pub aspect: f32,
    /// Its depth, µm.
    pub depth_um: f32,
    /// Distance between rows along veins, µm; 0 if stomata lie scattered.
    pub row_um: f32,
}

impl StomataNumbers {
    /// Faces without stomata.
    pub const NONE: Self = Self {
        per_mm2: [0.0; 2],
        length_um: 25.0,
        aspect: 0.6,
        depth_um: 0.0,
        row_um: 0.0,
    };
}

/// The stomata of one face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stomata {
    /// Cells of the grid, mm.
    cell_mm: Vec2,
    /// Half of width and length, mm.
    half_mm: Vec2,
    depth_mm: f32,
    in_rows: bool,
    /// Variance of slopes across and along a pit's axis, over the whole face.
    variance: Vec2,
    /// Cells are numbered from here, so that faces differ.
    origin: i32,
}

/// Where a ray meets a face, as stomata see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// mm from the origin of the map.
    pub(super) mm: Vec2,
    /// Distance to the axis of the nearest vein, mm.
    pub(super) from_vein_mm: f32,
    /// Unit direction away from it.
    pub(super) away: Vec2,
    /// Width of the ray, mm.
    pub(super) width_mm: f32,
}

/// Stomata at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resolved {
    /// Slope, outwards positive.
    pub(super) slope: Vec2,
    /// What of the square of the coat's roughness on each axis is seen as slope.
    pub(super) resolved: Vec2,
}

impl Stomata {
    /// The stomata of face 0 (adaxial) or 1; `None` if it has none.
    pub(super) fn new(plan: &StomataNumbers, face: usize) -> Option<Self> {
        let density = plan.per_mm2[face];
        if density == 0.0 || plan.depth_um == 0.0 {
            return None;
        }
        let length = plan.length_um * 1e-3;
        let half_mm = 0.5 * Vec2::new(length * plan.aspect, length);
        let depth_mm = plan.depth_um * 1e-3;
        let row = plan.row_um * 1e-3;
        let in_rows = row > 0.0;
        let cell_mm = if in_rows {
            Vec2::new(row, 1.0 / (density * row))
        } else {
            Vec2::splat(density.sqrt().recip())
        };
        // ∫ (∂z/∂x)² over a pit is (2π/3) D² b/a.
        let whole = density * depth_mm * depth_mm * 2.0 * PI / 3.0;
        let ratio = half_mm.y / half_mm.x;
        let variance = whole * Vec2::new(ratio, 1.0 / ratio);
        Some(Self {
            cell_mm,
            half_mm,
            depth_mm,
            in_rows,
            variance: if in_rows {
                variance
            } else {
                Vec2::splat(0.5 * variance.element_sum())
            },
            origin: 7919 * face as i32,
        })
    }

    /// Whether a ray of a width, mm, sees any.
    pub(super) fn are_seen(&self, width_mm: f32) -> bool {
        let [_, most] = SEEN;
        width_mm < most * 2.0 * self.half_mm.x
    }

    /// The pit at a place of a face whose coat has these squares of roughness.
    pub(super) fn at(&self, place: &Place, squares: [f32; 2]) -> Resolved {
        let [least, most] = SEEN;
        let wide = place.width_mm / (2.0 * self.half_mm.x);
        let seen = smooth((most - wide) / (most - least));
        // Coats that are too smooth for such pits have shallower ones.
        let most = MOST_SHARE * squares[0].min(squares[1]);
        let own = SPREAD * self.variance.max_element();
        let flattened = if own > most { (most / own).sqrt() } else { 1.0 };
        let strength = seen * flattened;
        let resolved = SPREAD * strength * strength * self.variance;
        let (slope, there) = if self.in_rows {
            self.in_row(place)
        } else {
            self.scattered(place)
        };
        Resolved {
            slope: strength * there * slope,
            resolved,
        }
    }

    fn scattered(&self, place: &Place) -> (Vec2, f32) {
        let length = 2.0 * self.half_mm.y;
        let [none, all] = SET_IN;
        let there = smooth((place.from_vein_mm / length - none) / (all - none));
        if there == 0.0 {
            return (Vec2::ZERO, 0.0);
        }
        (self.nearest(place.mm, None), there)
    }

    /// Rows begin one row away from the vein's axis; beside it are ribs without stomata.
    fn in_row(&self, place: &Place) -> (Vec2, f32) {
        let away = place.away;
        let along = Vec2::new(-away.y, away.x);
        // Both sides of a vein, and neighbouring veins, have stomata of their own.
        let axis = place.mm - away * place.from_vein_mm;
        let own = (axis.dot(away) / (4.0 * self.cell_mm.x)).round() as i32;
        let at = Vec2::new(place.from_vein_mm, place.mm.dot(along));
        if at.x < self.cell_mm.x {
            return (Vec2::ZERO, 0.0);
        }
        let slope = self.nearest(at, Some(own));
        (slope.x * away + slope.y * along, 1.0)
    }

    /// The slope of the nearest pit, in the frame of `at`; `row` numbers what it belongs to, and is
    /// given for pits that lie along +y.
    fn nearest(&self, at: Vec2, row: Option<i32>) -> Vec2 {
        let place = at / self.cell_mm;
        let home = place.floor().as_ivec2();
        let mut nearest = (1.0, Vec2::ZERO);
        for dy in -1..=1 {
            for dx in -1..=1 {
                let cell = home + IVec2::new(dx, dy);
                let other = self.origin ^ row.map_or(0, |row| row.wrapping_mul(31));
                let bits = mixer::of_cell(cell.to_array(), other);
                let unit = |shift: u32| (bits >> shift & 0xffff) as f32 / 65_536.0;
                let jitter = JITTER[usize::from(row.is_some())];
                let strayed = (Vec2::new(unit(0), unit(16)) - 0.5) * jitter;
                let from_middle = at - (cell.as_vec2() + 0.5 + strayed) * self.cell_mm;
                let angle = if row.is_some() { 0.0 } else { TAU * unit(32) };
                let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
                let [x, y] = [Vec2::new(cos, sin), Vec2::new(-sin, cos)];
                let local = Vec2::new(from_middle.dot(x), from_middle.dot(y));
                let square = (local / self.half_mm).length_squared();
                if square < nearest.0 {
                    let steep = 4.0 * self.depth_mm * (1.0 - square);
                    let slope = steep * local / (self.half_mm * self.half_mm);
                    nearest = (square, slope.x * x + slope.y * y);
                }
            }
        }
        nearest.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: StomataNumbers = StomataNumbers {
        per_mm2: [60.0, 250.0],
        length_um: 25.0,
        aspect: 0.5,
        depth_um: 2.0,
        row_um: 0.0,
    };

    fn place(mm: Vec2) -> Place {
        Place {
            mm,
            from_vein_mm: mm.x,
            away: Vec2::X,
            width_mm: 0.0,
        }
    }

    /// Means over 16 × 16 cells of the grid, far from a vein, of slopes and their squares; and the
    /// share of the face that pits cover.
    fn moments(stomata: &Stomata) -> (Vec2, Vec2, f32) {
        let count = 1200;
        let (mut sum, mut squares, mut covered) = (Vec2::ZERO, Vec2::ZERO, 0.0);
        for i in 0..count * count {
            let at = Vec2::new((i % count) as f32 + 0.5, (i / count) as f32 + 0.5);
            let cells = at * (16.0 / count as f32) + 24.0;
            let found = stomata.at(&place(cells * stomata.cell_mm), [0.2; 2]);
            sum += found.slope;
            squares += found.slope * found.slope;
            covered += f32::from(u8::from(found.slope != Vec2::ZERO));
        }
        let n = (count * count) as f32;
        (sum / n, squares / n, covered / n)
    }

    #[test]
    fn a_face_has_as_many_pits_as_it_should_and_they_take_their_slopes_from_the_roughness() {
        for (row_um, face) in [(0.0, 0), (0.0, 1), (120.0, 0), (120.0, 1)] {
            let plan = StomataNumbers { row_um, ..PLAN };
            let stomata = Stomata::new(&plan, face).expect("it has stomata");
            let (mean, squares, covered) = moments(&stomata);
            // An ellipse each.
            let area = PI / 4.0 * 0.025 * 0.0125;
            let expected = plan.per_mm2[face] * area;
            let about = format!("{row_um} {face}: {mean} {squares} {covered}");
            // The border cuts some.
            assert!(
                (covered / expected - 1.0).abs() < 0.04,
                "{about} {expected}"
            );
            assert!(mean.length() < 2e-3, "{about}");
            let seen = stomata.at(&place(Vec2::splat(3.0)), [0.2; 2]).resolved / SPREAD;
            assert!(
                (squares / seen - 1.0).abs().max_element() < 0.08,
                "{about} {seen}"
            );
        }
    }

    #[test]
    fn stomata_in_rows_keep_away_from_the_vein_and_lie_in_lines() {
        let plan = StomataNumbers {
            row_um: 120.0,
            ..PLAN
        };
        let stomata = Stomata::new(&plan, 0).expect("it has stomata");
        let mut across = vec![0; 600];
        for (i, pits) in across.iter_mut().enumerate() {
            for j in 0..2000 {
                let at = Vec2::new(0.001 * (i as f32 + 0.5), 0.003 * j as f32);
                let found = stomata.at(&place(at), [0.2; 2]);
                *pits += i32::from(found.slope != Vec2::ZERO);
            }
        }
        // None in the first row, next to the vein; then one row each 0.12 mm, and nothing between.
        assert_eq!(across[..120].iter().sum::<i32>(), 0);
        for row in 1..5 {
            let within = |from: usize, to: usize| across[row * 120 + from..row * 120 + to].iter();
            assert!(within(50, 70).all(|pits| *pits > 20), "{row}");
            assert_eq!(
                within(0, 40).chain(within(80, 120)).sum::<i32>(),
                0,
                "{row}"
            );
        }
    }

    #[test]
    fn a_wide_ray_sees_none() {
        let stomata = Stomata::new(&PLAN, 1).expect("it has stomata");
        assert!(!stomata.are_seen(0.05) && stomata.are_seen(0.004));
        let wide = Place {
            width_mm: 0.05,
            ..place(Vec2::splat(3.0))
        };
        let found = stomata.at(&wide, [0.2; 2]);
        assert_eq!((found.slope, found.resolved), (Vec2::ZERO, Vec2::ZERO));
    }
}
