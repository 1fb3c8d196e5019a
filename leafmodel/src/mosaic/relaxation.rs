//! One relaxation event: cells move apart.
//!
//! Cells of types `a` and `b` at a distance `d` below the radius `r` push each other by
//! `(1 − α_ab)(1 − d/r)`; each cell moves by the sum of pushes times `r` times the step's weight.
//!
//! Where cells crowd, the weight is lowered: above about `2/(n r²)`, for `n` cells per area, moves
//! overshoot and cells oscillate instead of coming to rest. (For the mode that oscillates most,
//! `n w_r²` cells within `r²` act as a spring of `0.94 n r²` times the weight.) The paper does not
//! mention this.

mod blocks;
mod kernel;

use glam::DVec2;
use rayon::prelude::*;

use self::blocks::Block;
use self::kernel::Places;
use super::control::Controls;
use super::live::Live;
use super::surface::Surface;
use super::walk::walk;
use crate::buckets::Buckets;

/// Greatest product of the weight and the number of cells in a square of side `r`.
const MOST_WEIGHT: f64 = 1.0;

/// Longest move in one event, over the radius.
const LONGEST_MOVE: f64 = 0.5;

/// The interaction between types.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bonds<'a> {
    /// Rows of the adhesion matrix.
    pub adhesion: &'a [Vec<f64>],
    pub controls: Controls<'a>,
    /// The weight of a step.
    pub step: f64,
}

/// A surface prepared for relaxation within a radius.
#[derive(Debug)]
pub(super) struct Relaxation {
    radius: f64,
    blocks: Vec<Block>,
}

/// The numbers of the cells in each face.
fn by_face(surface: &Surface, cells: &[Live]) -> Buckets {
    let faces = cells.iter().map(|cell| cell.face as usize);
    Buckets::new(surface.faces().len(), faces.zip(0..))
}

impl Relaxation {
    pub(super) fn new(surface: &Surface, radius: f64) -> Self {
        Self {
            radius,
            blocks: blocks::blocks(surface, radius),
        }
    }

    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// Moves all cells once. Controls are evaluated on the surface `mature`.
    pub(super) fn relax(
        &self,
        surface: &Surface,
        mature: &Surface,
        cells: &mut [Live],
        bonds: &Bonds<'_>,
    ) {
        let crowding = cells.len() as f64 * self.radius * self.radius / surface.total_area();
        let step = bonds.step.min(MOST_WEIGHT / crowding) * self.radius;
        let by_face = by_face(surface, cells);
        let before: &[Live] = cells;
        let steered = bonds.controls.steer_adhesion();
        let blocked = bonds.controls.block();
        let kinds = bonds.adhesion.len();
        let moves = |places: &mut Vec<Places>, block: &Block| -> Vec<(u32, u32, DVec2)> {
            if !block
                .own
                .iter()
                .any(|&(face, _)| !by_face.list(face as usize).is_empty())
            {
                return Vec::new();
            }
            self.gather(block, before, &by_face, places);
            let mut moved = Vec::new();
            let mut row = Vec::new();
            for &(face, unfold) in &block.own {
                for &number in by_face.list(face as usize) {
                    let cell = &before[number as usize];
                    let kind = usize::from(cell.kind);
                    row.clone_from(&bonds.adhesion[kind]);
                    if steered {
                        let at = mature.position(&surface.point(cell.face, cell.at));
                        bonds.controls.adhesion(at, cell.kind, &mut row);
                    }
                    let (x, y) = self.place(block, unfold.apply(cell.at));
                    let mut force = DVec2::ZERO;
                    for (places, adhesion) in places.iter().zip(&row) {
                        let (fx, fy) = places.repulsion(x, y);
                        force += DVec2::new(f64::from(fx), f64::from(fy)) * (1.0 - adhesion);
                    }
                    let way = (force * step).clamp_length_max(LONGEST_MOVE * self.radius);
                    let way = unfold.turn_back(way);
                    let (face, at) = if blocked {
                        free_walk(surface, mature, cell, way, bonds.controls)
                    } else {
                        walk(surface, cell.face, cell.at, way)
                    };
                    moved.push((number, face, at));
                }
            }
            moved
        };
        let new_places = || (0..kinds).map(|_| Places::default()).collect::<Vec<_>>();
        let moved: Vec<Vec<_>> = self.blocks.par_iter().map_init(new_places, moves).collect();
        for (number, face, at) in moved.into_iter().flatten() {
            let cell = &mut cells[number as usize];
            (cell.face, cell.at) = (face, at);
        }
    }

    /// `Σ (1 − α)(1 − d/r)²/2` over all pairs nearer than the radius: the energy that relaxation
    /// lowers.
    #[cfg(test)]
    pub(super) fn energy(&self, surface: &Surface, cells: &[Live], adhesion: &[Vec<f64>]) -> f64 {
        let by_face = by_face(surface, cells);
        let mut places: Vec<Places> = (0..adhesion.len()).map(|_| Places::default()).collect();
        let mut energy = 0.0;
        for block in &self.blocks {
            self.gather(block, cells, &by_face, &mut places);
            for &(face, unfold) in &block.own {
                for &number in by_face.list(face as usize) {
                    let cell = &cells[number as usize];
                    let row = &adhesion[usize::from(cell.kind)];
                    let (x, y) = self.place(block, unfold.apply(cell.at));
                    let sums = places
                        .iter()
                        .zip(row)
                        .map(|(places, a)| (1.0 - a) * places.energy(x, y));
                    // Minus the cell's own term.
                    energy += sums.sum::<f64>() - 0.5 * (1.0 - row[usize::from(cell.kind)]);
                }
            }
        }
        energy / 2.0
    }

    /// A place of the block's frame relative to its middle, in radii.
    fn place(&self, block: &Block, at: DVec2) -> (f32, f32) {
        let relative = (at - block.centre) / self.radius;
        (relative.x as f32, relative.y as f32)
    }

    /// The cells within reach of those of a block, by type.
    fn gather(&self, block: &Block, cells: &[Live], by_face: &Buckets, places: &mut [Places]) {
        places.iter_mut().for_each(Places::clear);
        let reach = (block.reach + self.radius).powi(2);
        for (face, unfold) in &block.near {
            for &number in by_face.list(*face as usize) {
                let cell = &cells[number as usize];
                let at = unfold.apply(cell.at);
                if at.distance_squared(block.centre) <= reach {
                    let (x, y) = self.place(block, at);
                    places[usize::from(cell.kind)].push(x, y);
                }
            }
        }
        places.iter_mut().for_each(Places::pad);
    }
}

/// A walk that does not end in a blocked place: if necessary, only half of it, a quarter, or none.
pub(super) fn free_walk(
    surface: &Surface,
    mature: &Surface,
    cell: &Live,
    way: DVec2,
    controls: Controls<'_>,
) -> (u32, DVec2) {
    for share in [1.0, 0.5, 0.25] {
        let (face, at) = walk(surface, cell.face, cell.at, way * share);
        let point = surface.point(face, at);
        if !controls.is_blocked(mature.position(&point)) {
            return (face, at);
        }
    }
    (cell.face, cell.at)
}
