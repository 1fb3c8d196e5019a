//! The bulge of the lamina between veins.
//!
//! The lamina swells towards the height H that it would have without veins; veins hold it down.
//! Its height h follows a screened Poisson equation,
//!
//! `L² ∇²h = h − H + L² σ δ h`
//!
//! with the width L within which the lamina rises, and with lines δ along the veins of strength
//! `σ = 20/L · min(1, r / r_full)`: beside a fully developed vein h falls to a tenth of H, a finer
//! one holds it down less. A small areole bulges little, with the square of its width, and a wide
//! one rises to H. The equation and σ are ours; they are the simplest sheet under pressure on an
//! elastic bed that has these two limits.

use glam::DVec2;
use rayon::prelude::*;

use super::super::frame::UvFrame;
use super::plan::SurfacePlan;
use crate::venation::network::VeinSegment;

/// Strength of a fully developed vein, in 1/L.
const STRENGTH: f64 = 20.0;
/// Places of the grid within the width L, at most.
const PLACES_WITHIN: f64 = 8.0;
/// Sweeps of successive over-relaxation. Errors fall to 0.84 in each on the finest grid.
const SWEEPS: usize = 48;
/// Rows that a thread takes at a time.
const ROWS: usize = 64;

/// A sheet that veins hold down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeldSheet<'a> {
    /// Where it lies.
    pub(crate) frame: &'a UvFrame,
    /// The veins.
    pub(crate) veins: &'a [VeinSegment],
    /// Radius from which a vein is fully developed, mm.
    pub(crate) full_vein_radius_mm: f64,
}

/// Heights on a grid.
#[derive(Debug)]
pub(crate) struct Bulge {
    origin: DVec2,
    spacing: f64,
    columns: usize,
    /// mm, row by row; empty if nothing bulges.
    heights: Vec<f64>,
}

impl Bulge {
    /// The bulge of a blade on a grid that is not much finer than `finest`, mm: texels of a map, or
    /// edges of a mesh. On a grid coarser than the width what is left is the mean height of many
    /// areoles.
    pub(crate) fn of(plan: &SurfacePlan, sheet: &HeldSheet<'_>, finest: f64) -> Self {
        let (height, width) = (plan.bulge_mm, plan.bulge_width_mm);
        let spacing = finest.max(width / PLACES_WITHIN);
        let mut bulge = Self::flat(sheet.frame, spacing);
        if height == 0.0 {
            return bulge;
        }
        let rows = (sheet.frame.size.y / spacing).ceil() as usize + 3;
        let held = bulge.held(sheet, STRENGTH / width, rows);
        bulge.heights = vec![0.5 * height; bulge.columns * rows];
        bulge.relax(&held, height, spacing * spacing / (width * width));
        bulge
    }

    fn flat(frame: &UvFrame, spacing: f64) -> Self {
        Self {
            origin: frame.min - spacing,
            spacing,
            columns: (frame.size.x / spacing).ceil() as usize + 3,
            heights: Vec::new(),
        }
    }

    /// The strength of the veins times their length about each place of the grid.
    fn held(&self, sheet: &HeldSheet<'_>, strength: f64, rows: usize) -> Vec<f64> {
        let mut held = vec![0.0; self.columns * rows];
        for vein in sheet.veins {
            let along = vein.to - vein.from;
            let pieces = (2.0 * along.length() / self.spacing).ceil().max(1.0);
            for piece in 0..pieces as usize {
                let t = (piece as f64 + 0.5) / pieces;
                let radius = vein.radius_from + t * (vein.radius_to - vein.radius_from);
                let grown = (radius / sheet.full_vein_radius_mm).min(1.0);
                let amount = strength * grown * along.length() / pieces;
                let place = (vein.from + t * along - self.origin) / self.spacing;
                // Veins beyond the frame hold nothing within it.
                if place.min_element() < 0.0 {
                    continue;
                }
                let low = place.floor();
                let share = place - low;
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let (column, row) = (low.x as usize + dx, low.y as usize + dy);
                    if column < self.columns && row < rows {
                        let x = if dx == 1 { share.x } else { 1.0 - share.x };
                        let y = if dy == 1 { share.y } else { 1.0 - share.y };
                        held[row * self.columns + column] += amount * x * y;
                    }
                }
            }
        }
        held
    }

    /// Red-black over-relaxation; `bed` is the square of the spacing over that of the width.
    ///
    /// Places of each colour have a list of their own, half a row after the other: a sweep reads
    /// one and writes the other.
    fn relax(&mut self, held: &[f64], height: f64, bed: f64) {
        let jacobi = 4.0 / (4.0 + bed);
        let omega = 2.0 / (1.0 + (1.0 - jacobi * jacobi).sqrt());
        let columns = self.columns;
        let half = columns.div_ceil(2);
        let [mut even, mut odd] = parted(&self.heights, columns);
        let held = parted(held, columns);
        for sweep in 0..2 * SWEEPS {
            let colour = sweep % 2;
            let (own, other) = if colour == 0 {
                (&mut even, &odd)
            } else {
                (&mut odd, &even)
            };
            let rows = own.par_chunks_mut(half).enumerate().with_min_len(ROWS);
            rows.for_each(|(row, own)| {
                let at = |row: usize| other.get(row * half..(row + 1) * half);
                let beside = &other[row * half..][..half];
                let (below, above) = (row.checked_sub(1).and_then(at), at(row + 1));
                let held = &held[colour][row * half..][..half];
                // The column of the first place; the others are two apart.
                let first = (row + colour) % 2;
                // At the border of the grid, which lies beyond the margin, the sheet is level.
                let risen = |i: usize, h: f64, [left, right]: [Option<f64>; 2]| {
                    let [left, right] = [left, right].map(|side| side.unwrap_or(h));
                    let [below, above] = [below, above].map(|row| row.map_or(h, |row| row[i]));
                    let sum = left + right + below + above;
                    let target = (sum + bed * height) / (4.0 + bed + held[i]);
                    h + omega * (target - h)
                };
                let count = (columns - first).div_ceil(2);
                // Places that have a neighbour on either side.
                let inner = 1 - first..(columns - first) / 2;
                let sides = |i: usize| {
                    let left = (i + first).checked_sub(1).map(|left| beside[left]);
                    [
                        left,
                        (2 * i + first + 1 < columns).then(|| beside[i + first]),
                    ]
                };
                for i in (0..inner.start).chain(inner.end..count) {
                    own[i] = risen(i, own[i], sides(i));
                }
                for (i, h) in inner.clone().zip(&mut own[inner]) {
                    let sides = [beside[i + first - 1], beside[i + first]];
                    *h = risen(i, *h, sides.map(Some));
                }
            });
        }
        for (row, heights) in self.heights.chunks_mut(columns).enumerate() {
            for (column, height) in heights.iter_mut().enumerate() {
                let own = [&even, &odd][(row + column) % 2];
                *height = own[row * half + column / 2];
            }
        }
    }

    fn at(&self, column: usize, row: usize) -> f64 {
        self.heights[row * self.columns + column]
    }

    /// Slopes at a point, bilinear between places of central differences.
    pub(crate) fn slope(&self, p: DVec2) -> DVec2 {
        if self.heights.is_empty() {
            return DVec2::ZERO;
        }
        let rows = self.heights.len() / self.columns;
        let place = (p - self.origin) / self.spacing;
        let most = DVec2::new((self.columns - 3) as f64, (rows - 3) as f64);
        let low = place.floor().clamp(DVec2::ONE, most.max(DVec2::ONE));
        let share = (place - low).clamp(DVec2::ZERO, DVec2::ONE);
        let (column, row) = (low.x as usize, low.y as usize);
        let slope = |column: usize, row: usize| {
            let [column, row] = [column.min(self.columns - 2), row.min(rows - 2)];
            DVec2::new(
                self.at(column + 1, row) - self.at(column - 1, row),
                self.at(column, row + 1) - self.at(column, row - 1),
            ) / (2.0 * self.spacing)
        };
        let low = slope(column, row).lerp(slope(column + 1, row), share.x);
        let high = slope(column, row + 1).lerp(slope(column + 1, row + 1), share.x);
        low.lerp(high, share.y)
    }

    /// Height at a point, mm, bilinear; beyond the frame that at its border.
    pub(crate) fn height(&self, p: DVec2) -> f64 {
        if self.heights.is_empty() {
            return 0.0;
        }
        let rows = self.heights.len() / self.columns;
        let place = (p - self.origin) / self.spacing;
        let most = DVec2::new((self.columns - 2) as f64, (rows - 2) as f64);
        let low = place.floor().clamp(DVec2::ZERO, most);
        let share = (place - low).clamp(DVec2::ZERO, DVec2::ONE);
        let (column, row) = (low.x as usize, low.y as usize);
        let mix = |row| self.at(column, row) * (1.0 - share.x) + self.at(column + 1, row) * share.x;
        mix(row) * (1.0 - share.y) + mix(row + 1) * share.y
    }
}

/// The places of a grid whose row and column have an even sum, and the others; each list has half
/// of the columns, rounded up, for each row.
fn parted(grid: &[f64], columns: usize) -> [Vec<f64>; 2] {
    let half = columns.div_ceil(2);
    let rows = grid.len() / columns;
    [0, 1].map(|colour| {
        let mut places = vec![0.0; half * rows];
        for (row, places) in places.chunks_mut(half).enumerate() {
            let own = grid[row * columns..][..columns].iter();
            let own = own.skip((row + colour) % 2).step_by(2);
            places
                .iter_mut()
                .zip(own)
                .for_each(|(to, from)| *to = *from);
        }
        places
    })
}
