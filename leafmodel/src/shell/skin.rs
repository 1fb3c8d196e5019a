//! The sheet as flat pieces that may touch each other.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::grid::{Grid, quadratic};
use crate::plane::polygon;

/// Pieces of a cell along each side.
const PIECES: usize = 2;
/// Height of a bent sheet over a flat piece, as a share of a cell's side, at the strongest bend
/// that a cell can follow (a radius of two cells).
const BULGE: f64 = 0.03;
/// Greatest half of the distance that is kept, as a share of a cell's side: cells that do not count
/// as neighbours begin two sides apart.
const WIDEST: f64 = 0.4;

/// Corners of a piece, counter-clockwise.
const CORNERS: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// A piece of a cell, between four places of the sheet.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Control points of its cell.
    pub(super) points: [u32; 9],
    /// Which part of the cell it is.
    part: usize,
    /// Column and row of the cell.
    pub(super) cell: [usize; 2],
    /// Which corners it speaks for; each corner has one piece that does.
    pub(super) owns: [bool; 4],
    /// Which of its sides lie on the margin, each from the corner of this number to the next.
    pub(super) margin: [bool; 4],
    /// Half the thickness of what lies there, mm.
    pub(super) radius: f64,
}

/// The pieces of a sheet.
#[derive(Clone, Debug)]
pub(crate) struct Skin {
    pub(super) pieces: Vec<Piece>,
    /// Weights of the nine control points at the four corners of each part of a cell.
    weights: [[[f64; 9]; 4]; PIECES * PIECES],
    /// The side of a cell, mm.
    pub(super) spacing: f64,
}

impl Skin {
    /// The pieces of `grid` that the shape within `margin` touches; `contains` tells whether a
    /// point lies within it, `radius` half its thickness (mm).
    pub(crate) fn over(
        grid: &Grid,
        margin: &[DVec2],
        contains: impl Fn(DVec2) -> bool,
        radius: impl Fn(DVec2) -> f64,
    ) -> Self {
        let h = grid.spacing();
        let side = h / PIECES as f64;
        let place = |p: DVec2| {
            let at = (p - grid.origin()) / side;
            [at.x, at.y].map(|x| x.floor() as i32)
        };
        let mut touched: BTreeSet<[i32; 2]> = BTreeSet::new();
        for (a, b) in polygon::sides(margin) {
            let steps = (a.distance(b) / (0.2 * side)).ceil().max(1.0) as usize;
            for step in 0..steps {
                touched.insert(place(a.lerp(b, step as f64 / steps as f64)));
            }
        }
        let mut skin = Self {
            pieces: Vec::new(),
            weights: weights(),
            spacing: h,
        };
        let mut places = Vec::new();
        for cell in 0..grid.cells() {
            let (cell_place, points) = grid.cell_points(cell);
            for part in 0..PIECES * PIECES {
                let [i, j] = [part % PIECES, part / PIECES];
                let [x, y] = [cell_place[0] * PIECES + i, cell_place[1] * PIECES + j];
                let at = DVec2::new(x as f64, y as f64);
                let on = |s: f64, t: f64| grid.origin() + side * (at + DVec2::new(s, t));
                let key = [x as i32, y as i32];
                if !touched.contains(&key) && !contains(on(0.5, 0.5)) {
                    continue;
                }
                let around = (0..9).map(|k| radius(on(0.5 * (k % 3) as f64, 0.5 * (k / 3) as f64)));
                let thickest = around.fold(0.0, f64::max);
                skin.pieces.push(Piece {
                    points,
                    part,
                    cell: cell_place,
                    owns: [false; 4],
                    margin: [false; 4],
                    radius: (thickest + BULGE * h).min(WIDEST * h),
                });
                places.push(key);
            }
        }
        skin.own(&places);
        skin
    }

    /// Finds the pieces that speak for each corner, and the sides on the margin.
    fn own(&mut self, places: &[[i32; 2]]) {
        let exist: BTreeSet<[i32; 2]> = places.iter().copied().collect();
        let mut spoken = BTreeSet::new();
        for (piece, &[x, y]) in self.pieces.iter_mut().zip(places) {
            for (corner, [i, j]) in CORNERS.into_iter().enumerate() {
                let at = [x + i as i32, y + j as i32];
                piece.owns[corner] = spoken.insert(at);
            }
            let beside = [[x, y - 1], [x + 1, y], [x, y + 1], [x - 1, y]];
            piece.margin = beside.map(|place| !exist.contains(&place));
        }
    }

    /// The corners of each piece with the control points at `x`.
    pub(super) fn corners(&self, x: &[DVec3]) -> Vec<[DVec3; 4]> {
        self.pieces
            .iter()
            .map(|piece| {
                self.weights[piece.part].map(|weights| {
                    let pairs = piece.points.iter().zip(weights);
                    pairs.map(|(&point, w)| x[point as usize] * w).sum()
                })
            })
            .collect()
    }

    /// Weights of a piece's control points at the place that has these shares of its corners.
    pub(super) fn weights(&self, piece: u32, shares: &[f64; 4]) -> [f64; 9] {
        let corners = &self.weights[self.pieces[piece as usize].part];
        std::array::from_fn(|i| {
            (0..4)
                .map(|corner| shares[corner] * corners[corner][i])
                .sum()
        })
    }
}

fn weights() -> [[[f64; 9]; 4]; PIECES * PIECES] {
    std::array::from_fn(|part| {
        CORNERS.map(|[i, j]| {
            let at = |k: usize| k as f64 / PIECES as f64;
            let [x, y] = [at(part % PIECES + i), at(part / PIECES + j)].map(|t| quadratic(t)[0]);
            std::array::from_fn(|k| x[k % 3] * y[k / 3])
        })
    })
}
