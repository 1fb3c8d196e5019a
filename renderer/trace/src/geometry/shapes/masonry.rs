//! Walls of bricks.

use std::f64::consts::TAU;

use document::declared::{Declared, Defaults, Words};
use document::keys::Keys;
use document::limits::Limits;
use document::value_kind::Numbers;
use glam::{DVec2, DVec3, Vec2};
use rayon::prelude::*;

use super::terrain::MOST_SQUARES;
use crate::geometry::{MeshError, TriangleMesh};
use crate::sampling::mixer::random;

/// A wall in stretcher bond that stands on z = 0 and faces +x: bricks with rounded and chipped edges
/// whose faces lie at x = 0 or near, and the mortar between them, which lies back.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Masonry {
    /// Extent along y.
    #[key("width_m", required, above(0.0, 1e6), at = 0, default = [1.0; 2])]
    /// Height.
    #[key("height_m", required, above(0.0, 1e6), at = 1)]
    pub size: [f64; 2],
    /// Which part of it the mesh is.
    #[key("part", word, default = MasonryPart::Bricks)]
    pub part: MasonryPart,
    /// Length and height of a brick.
    #[key("brick_mm", milli(30.0..=1e4), default = [0.215, 0.065])]
    pub brick: [f64; 2],
    /// Width of the joints.
    #[key("joint_mm", milli(0.0..=1000.0), default = 0.01)]
    pub joint: f64,
    /// How far the mortar lies behind the faces of the bricks.
    #[key("recess_mm", milli(0.0..=1000.0), default = 0.006)]
    pub recess: f64,
    /// How uneven, displaced and chipped bricks are: 0 new, 1 old.
    #[key("roughness", 0.0..=1.0, default = 0.6)]
    pub roughness: f64,
    /// Of bricks that are sorted at random into so many kinds, only those of one kind: its number,
    /// and how many there are.
    #[key(with = Self::kinds, default = [1; 2])]
    pub kind: [u32; 2],
    /// Same numbers and seed, same wall.
    #[key("seed")]
    pub seed: u64,
}

/// The parts of a wall, which are made of different materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Words)]
pub enum MasonryPart {
    /// Its bricks.
    Bricks,
    /// What joins them.
    Mortar,
}

/// Radius of the edges of bricks, m.
const EDGE: f64 = 0.004;
/// Distances of vertices from an edge, m, before they are evenly spaced.
const NEAR_EDGE: [f64; 5] = [0.0, 0.0005, 0.0013, 0.0026, 0.0042];
/// Distance of vertices in the middle of faces, m.
const SPACING: f64 = 0.0025;
/// How far bricks reach behind the mortar, m.
const BEHIND: f64 = 0.006;
/// Least part of a brick at the end of a row, m.
const SMALLEST: f64 = 0.025;
/// Waves of a surface.
const WAVES: u64 = 12;
/// Chips on the edges of a brick at most.
const CHIPS: u64 = 5;

/// A brick: the corners of its face on the wall, and its number.
struct Brick {
    from: DVec2,
    to: DVec2,
    number: u64,
}

/// Vertices of a part of the wall.
#[derive(Default)]
struct Patch {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Masonry {
    /// The key `kind`.
    fn kinds(&mut self, keys: &mut Keys<'_>) {
        let about = "Bricks are sorted at random into so many kinds; these are the ones of one kind: \
            its number from 1, and how many kinds there are.";
        let mut kind = self.kind.map(f64::from);
        let limits = Numbers::<2>(Limits::closed(1.0, 16.0));
        keys.key("kind", &mut kind, limits, about);
        if kind[0] > kind[1] || kind.iter().any(|number| number.fract() != 0.0) {
            let problem = format!("there is no kind {} of {}", kind[0], kind[1]);
            let help = "write two whole numbers, such as `[1, 2]`, the first at most the second";
            keys.refuse(&["kind"], problem, help);
        }
        self.kind = kind.map(|number| number as u32);
    }

    /// Refuses more squares than fit in memory.
    fn check(&mut self, keys: &mut Keys<'_>) {
        if self.squares() > MOST_SQUARES {
            let problem = format!(
                "the wall would have {:.0} million squares, more than {:.0}",
                1e-6 * self.squares(),
                1e-6 * MOST_SQUARES
            );
            keys.refuse(&["width_m"], problem, "make it smaller");
        }
    }

    /// About the number of squares of its mesh.
    pub fn squares(&self) -> f64 {
        let [width, height] = self.size;
        let course = self.brick[1] + self.joint;
        let edges = NEAR_EDGE.len() as f64;
        let along = |length: f64| length / SPACING + 2.0 * edges;
        match self.part {
            MasonryPart::Bricks => {
                let bricks = (height / course + 1.0) * (width / (self.brick[0] + self.joint) + 1.0);
                bricks * along(self.brick[0]) * along(self.brick[1])
            }
            MasonryPart::Mortar => along(width) * along(height),
        }
    }

    /// Its mesh, with normals.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it has too many triangles, or is too large or too small for single
    /// precision; also if no brick is of the kind.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let patches: Vec<Patch> = match self.part {
            MasonryPart::Bricks => self
                .bricks()
                .par_iter()
                .map(|brick| self.face(brick))
                .collect(),
            MasonryPart::Mortar => vec![self.mortar()],
        };
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for patch in patches {
            let first = positions.len() as u32;
            positions.extend(patch.positions);
            let moved = patch.triangles.into_iter();
            triangles.extend(moved.map(|triangle| triangle.map(|corner| corner + first)));
        }
        let mut normals = vec![DVec3::ZERO; positions.len()];
        for triangle in &triangles {
            let [a, b, c]: [DVec3; 3] = triangle.map(|corner| positions[corner as usize]);
            let normal = (b - a).cross(c - a);
            for corner in triangle {
                normals[*corner as usize] += normal;
            }
        }
        let [width, height] = self.size;
        let uv = |at: &DVec3| Vec2::new((at.y / width + 0.5) as f32, (at.z / height) as f32);
        TriangleMesh::new(
            positions.iter().map(|at| at.as_vec3()).collect(),
            Some(
                normals
                    .iter()
                    .map(|normal| normal.normalize_or(DVec3::X).as_vec3())
                    .collect(),
            ),
            Some(positions.iter().map(uv).collect()),
            triangles,
        )
    }

    fn bricks(&self) -> Vec<Brick> {
        let [width, height] = self.size;
        let [length, course] = self.brick;
        let (step, rise) = (length + self.joint, course + self.joint);
        let mut bricks = Vec::new();
        let mut row = 0_u64;
        while row as f64 * rise < height {
            let bottom = row as f64 * rise;
            let top = (bottom + course).min(height);
            let shift = if row.is_multiple_of(2) {
                0.0
            } else {
                0.5 * step
            };
            let mut place = 0_u64;
            loop {
                let from = place as f64 * step - shift - 0.5 * width;
                if from >= 0.5 * width {
                    break;
                }
                let number = row * 0x1_0000 + place;
                let left = from.max(-0.5 * width);
                let right = (from + length).min(0.5 * width);
                let [kind, kinds] = self.kind.map(f64::from);
                let drawn = (random(self.seed, 64 * number + 63) * kinds).floor() + 1.0;
                if right - left >= SMALLEST && top - bottom >= SMALLEST && drawn == kind {
                    bricks.push(Brick {
                        from: DVec2::new(left, bottom),
                        to: DVec2::new(right, top),
                        number,
                    });
                }
                place += 1;
            }
            row += 1;
        }
        bricks
    }

    /// The face of a brick and its sides.
    fn face(&self, brick: &Brick) -> Patch {
        let chance = |what: u64| random(self.seed, 64 * brick.number + what);
        let even = |what: u64| 2.0 * chance(what) - 1.0;
        let rough = self.roughness;
        let moved = DVec2::new(even(0), even(1)) * (0.0012 * rough);
        let (from, to) = (brick.from + moved, brick.to + moved);
        let size = to - from;
        let tilt = DVec2::new(even(2), even(3)) * (0.012 * rough);
        let out = 0.0015 * rough * even(4);
        let waves = waves(
            self.seed ^ brick.number.wrapping_mul(0x9e37_79b9),
            0.04,
            0.003,
        );
        let chips: Vec<(DVec2, f64)> = (0..(chance(5) * rough * (CHIPS + 1) as f64) as u64)
            .map(|number| {
                let at = |what: u64| chance(8 + 4 * number + what);
                // Somewhere on the border.
                let along = at(0) * 2.0 * (size.x + size.y);
                let place = if along < size.x {
                    DVec2::new(along, 0.0)
                } else if along < 2.0 * size.x {
                    DVec2::new(along - size.x, size.y)
                } else if along < 2.0 * size.x + size.y {
                    DVec2::new(0.0, along - 2.0 * size.x)
                } else {
                    DVec2::new(size.x, along - 2.0 * size.x - size.y)
                };
                (place, 0.004 + 0.012 * at(1) * at(1))
            })
            .collect();
        let edge = EDGE * (0.5 + 0.5 * rough);
        let height = |at: DVec2| {
            let near = at.min(size - at).max(DVec2::ZERO);
            let drop = |distance: f64| {
                let gap = (edge - distance).max(0.0);
                edge - (edge * edge - gap * gap).max(0.0).sqrt()
            };
            let waves: f64 = waves.iter().map(|wave| wave(at)).sum();
            let chip: f64 = chips
                .iter()
                .map(|(place, radius)| {
                    let share = at.distance(*place) / radius;
                    0.45 * radius * (1.0 - share * share).max(0.0)
                })
                .sum();
            let leaning = tilt.dot(at - 0.5 * size);
            out + leaning + 0.0012 * rough * waves - drop(near.x) - drop(near.y) - chip
        };
        let (us, vs) = (places(size.x), places(size.y));
        let mut patch = Patch::default();
        for v in &vs {
            for u in &us {
                let at = DVec2::new(*u, *v);
                let on = from + at;
                patch.positions.push(DVec3::new(height(at), on.x, on.y));
            }
        }
        let columns = us.len() as u32;
        let rows = vs.len() as u32;
        let corner = |column: u32, row: u32| row * columns + column;
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let [a, b] = [corner(column, row), corner(column + 1, row)];
                let [c, d] = [corner(column + 1, row + 1), corner(column, row + 1)];
                patch.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        // The border, counter-clockwise seen from +x, and the same behind the mortar.
        let mut border: Vec<u32> = (0..columns).map(|column| corner(column, 0)).collect();
        border.extend((1..rows).map(|row| corner(columns - 1, row)));
        border.extend(
            (0..columns - 1)
                .rev()
                .map(|column| corner(column, rows - 1)),
        );
        border.extend((1..rows - 1).rev().map(|row| corner(0, row)));
        let back = patch.positions.len() as u32;
        for vertex in &border {
            let at = patch.positions[*vertex as usize];
            let behind = -self.recess - BEHIND;
            patch
                .positions
                .push(DVec3::new(behind.min(at.x - 1e-4), at.y, at.z));
        }
        let count = border.len();
        for number in 0..count {
            let next = (number + 1) % count;
            let [a, b] = [border[number], border[next]];
            let [c, d] = [back + next as u32, back + number as u32];
            patch.triangles.extend([[a, d, c], [a, c, b]]);
        }
        patch
    }

    /// The mortar: an uneven plane.
    fn mortar(&self) -> Patch {
        let [width, height] = self.size;
        let count = |extent: f64| (extent / SPACING).ceil().max(1.0) as u32;
        let (columns, rows) = (count(width), count(height));
        let waves = waves(self.seed ^ 0x6d6f_7274, 0.05, 0.004);
        let mut patch = Patch::default();
        for row in 0..=rows {
            for column in 0..=columns {
                let at = DVec2::new(
                    width * (f64::from(column) / f64::from(columns) - 0.5),
                    height * f64::from(row) / f64::from(rows),
                );
                let wave: f64 = waves.iter().map(|wave| wave(at)).sum();
                let depth = -self.recess + 0.002 * self.roughness * wave;
                patch.positions.push(DVec3::new(depth, at.x, at.y));
            }
        }
        let corner = |column: u32, row: u32| row * (columns + 1) + column;
        for row in 0..rows {
            for column in 0..columns {
                let [a, b] = [corner(column, row), corner(column + 1, row)];
                let [c, d] = [corner(column + 1, row + 1), corner(column, row + 1)];
                patch.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        patch
    }
}

/// Places of vertices along an edge of a brick: dense where it is round.
fn places(length: f64) -> Vec<f64> {
    let near: Vec<f64> = NEAR_EDGE
        .into_iter()
        .filter(|place| *place < 0.4 * length)
        .collect();
    let last = near[near.len() - 1];
    let middle = length - 2.0 * last;
    let pieces = (middle / SPACING).ceil().max(1.0) as u32;
    let mut places = near.clone();
    places.extend((1..pieces).map(|piece| last + middle * f64::from(piece) / f64::from(pieces)));
    places.extend(near.iter().rev().map(|place| length - place));
    places
}

/// Waves between two lengths, m, whose heights are as their lengths; the greatest is about 1 high.
fn waves(seed: u64, longest: f64, shortest: f64) -> Vec<impl Fn(DVec2) -> f64> {
    (0..WAVES)
        .map(|number| {
            let at = |what: u64| random(seed, 4 * number + what);
            let share = (number as f64 + at(0)) / WAVES as f64;
            let relative = libm::pow(shortest / longest, share);
            let (sin, cos) = libm::sincos(TAU * at(1));
            let vector = DVec2::new(cos, sin) * (TAU / (longest * relative));
            // Short waves are much lower, or a brick would be rippled.
            let (height, phase) = (0.5 * libm::pow(relative, 1.3), TAU * at(2));
            move |place: DVec2| height * libm::cos(vector.dot(place) + phase)
        })
        .collect()
}
