//! The texels of a map, and the fields between veins that they belong to.

use glam::DVec2;
use rayon::prelude::*;

use super::super::frame::UvFrame;
use super::super::mottle::Mottle;
use crate::shape::outline::Outline;
use crate::venation::network::VeinSegment;

/// Highest order of the veins that enclose fields.
pub(super) const ENCLOSING: u8 = 3;
/// Size of the noise from which fields take their numbers, mm: smaller than most of them.
const FIELD_NOISE_MM: f64 = 0.4;

/// The texels of a map.
pub(super) struct Grid<'a> {
    pub(super) frame: &'a UvFrame,
    pub(super) width: usize,
    pub(super) height: usize,
}

/// A texel that belongs to no field yet, and one at which a vein or the margin ends fields.
const OPEN: u32 = u32::MAX;
const WALL: u32 = u32::MAX - 1;

impl Grid<'_> {
    fn size(&self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64)
    }

    /// The middle of a texel.
    pub(super) fn middle(&self, column: usize, row: usize) -> DVec2 {
        let texel = DVec2::new(column as f64, row as f64) + 0.5;
        self.frame.point(texel / self.size())
    }

    /// As [`Grid::middle`], of the texel with a number.
    pub(super) fn place(&self, i: usize) -> DVec2 {
        self.middle(i % self.width, i / self.width)
    }

    /// Calls `work` with each row's number and values, on all threads.
    pub(super) fn each_row<T: Send>(
        &self,
        values: &mut [T],
        work: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let rows = values.par_chunks_mut(self.width).enumerate();
        rows.with_min_len(8)
            .for_each(|(row, values)| work(row, values));
    }

    /// For each texel whether its middle lies within the margin.
    pub(super) fn inside(&self, outline: &Outline) -> Vec<bool> {
        let mut inside = vec![false; self.width * self.height];
        self.each_row(&mut inside, |row, inside| {
            for (column, inside) in inside.iter_mut().enumerate() {
                *inside = outline.contains(self.middle(column, row));
            }
        });
        inside
    }

    /// A number of mean 0 and deviation 1 for each texel: that of its field.
    pub(super) fn field_numbers(
        &self,
        inside: &[bool],
        veins: &[VeinSegment],
        seed: u64,
    ) -> Vec<f64> {
        let (fields, count) = self.fields(inside, veins);
        let mut middles = vec![(DVec2::ZERO, 0.0); count];
        for (i, &field) in fields.iter().enumerate() {
            if let Some((sum, area)) = middles.get_mut(field as usize) {
                *sum += self.place(i);
                *area += 1.0;
            }
        }
        // The noise changes little with a field's middle, so maps of all sizes show the same leaf.
        let noise = Mottle::new(seed, FIELD_NOISE_MM);
        let number =
            |&(sum, area): &(DVec2, f64)| (noise.at(sum / area) / NOISE_DEVIATION).clamp(-2.5, 2.5);
        let numbers: Vec<f64> = middles.iter().map(number).collect();
        let of = |field: &u32| numbers.get(*field as usize).copied().unwrap_or(0.0);
        let sharp: Vec<f64> = fields.iter().map(of).collect();
        self.softened(&self.softened(&sharp))
    }

    /// The field of each texel, and how many there are. Texels of veins belong to the nearest.
    fn fields(&self, inside: &[bool], veins: &[VeinSegment]) -> (Vec<u32>, usize) {
        let texels = inside.len();
        let is_open = |&inside: &bool| if inside { OPEN } else { WALL };
        let mut field: Vec<u32> = inside.iter().map(is_open).collect();
        for vein in veins.iter().filter(|vein| vein.order <= ENCLOSING) {
            self.wall(vein, &mut field);
        }
        let mut count = 0;
        // Texels at which fields may grow over walls, the earlier the nearer.
        let mut edge = Vec::new();
        let mut open = Vec::new();
        for start in 0..texels {
            if field[start] != OPEN {
                continue;
            }
            field[start] = count;
            open.push(start);
            while let Some(i) = open.pop() {
                let mut is_edge = false;
                for other in self.beside(i) {
                    if field[other] == OPEN {
                        field[other] = count;
                        open.push(other);
                    }
                    is_edge |= field[other] == WALL;
                }
                if is_edge {
                    edge.push(i);
                }
            }
            count += 1;
        }
        let mut next = 0;
        while let Some(&i) = edge.get(next) {
            next += 1;
            for other in self.beside(i) {
                if field[other] == WALL {
                    field[other] = field[i];
                    edge.push(other);
                }
            }
        }
        (field, count as usize)
    }

    /// Makes walls of the texels through which a vein's axis goes, without gaps at corners.
    fn wall(&self, vein: &VeinSegment, field: &mut [u32]) {
        let texel = |p: DVec2| self.frame.uv(p) * self.size();
        let (from, to) = (texel(vein.from), texel(vein.to));
        let steps = (3.0 * from.distance(to)).ceil().max(1.0);
        let most = self.size() - 1.0;
        let mut before: Option<(usize, usize)> = None;
        for step in 0..=steps as usize {
            let p = from.lerp(to, step as f64 / steps).clamp(DVec2::ZERO, most);
            let (column, row) = (p.x as usize, p.y as usize);
            field[row * self.width + column] = WALL;
            if let Some((_, row_before)) = before {
                field[row_before * self.width + column] = WALL;
            }
            before = Some((column, row));
        }
    }

    /// The four texels beside one, less those beyond the map.
    fn beside(&self, i: usize) -> impl Iterator<Item = usize> {
        let (column, row) = (i % self.width, i / self.width);
        let (width, height) = (self.width, self.height);
        let left = (column > 0).then(|| i - 1);
        let right = (column + 1 < width).then_some(i + 1);
        let below = (row > 0).then(|| i - width);
        let above = (row + 1 < height).then_some(i + width);
        [left, right, below, above].into_iter().flatten()
    }

    /// Means over each texel and those beside it.
    fn softened(&self, values: &[f64]) -> Vec<f64> {
        let mut means = vec![0.0; values.len()];
        self.each_row(&mut means, |row, means| {
            for (i, mean) in (row * self.width..).zip(means) {
                let (mut sum, mut count) = (0.0, 0.0);
                for other in self.beside(i) {
                    sum += values[other];
                    count += 1.0;
                }
                *mean = (values[i] + sum) / (1.0 + count);
            }
        });
        means
    }
}

/// Standard deviation of the noise of [`Mottle`] (measured).
pub(super) const NOISE_DEVIATION: f64 = 0.36;
