//! Tissue of a flat lamina, looked up by places in the plane.

use glam::DVec2;

use super::TypeField;
use crate::mosaic::surface::{Surface, SurfacePoint};
use crate::mosaic::voronoi::distance_to_triangle;
use crate::optics::Contents;
use crate::plane::segment::Line;
use crate::plane::{bounds, polygon};

/// Most squares along a side of the grid in which faces are looked up.
const MOST_SQUARES: f64 = 160.0;
/// Width of the grid beyond the sheet, as a share of its extent. Farther out the nearest point of
/// the margin is approximate.
const BEYOND: f64 = 0.1;

/// A mosaic on one or both faces of a flat sheet in the plane z = 0, looked up by places in that
/// plane.
#[derive(Clone, Debug)]
pub struct SheetField {
    field: TypeField,
    corners: Vec<[DVec2; 3]>,
    both: bool,
    low: DVec2,
    square: f64,
    columns: usize,
    rows: usize,
    /// For each square the faces that can hold its points or be nearest to them.
    faces: Vec<Vec<u32>>,
}

impl SheetField {
    /// Prepares the look-up of `field`, which lies on `surface`.
    ///
    /// `surface` is a flat sheet in the plane z = 0 or, if `both` is set, [`Surface::both_faces`]
    /// of one.
    pub fn new(surface: &Surface, field: TypeField, both: bool) -> Self {
        let count = surface.faces().len() / if both { 2 } else { 1 };
        let corners: Vec<[DVec2; 3]> = surface.faces()[..count]
            .iter()
            .map(|face| face.map(|vertex| surface.positions()[vertex as usize].truncate()))
            .collect();
        let (low, high) = bounds(corners.iter().flatten().copied());
        let edge = BEYOND * (high - low).max_element();
        let (low, high) = (low - edge, high + edge);
        let size = high - low;
        let squares = (count as f64).sqrt().clamp(4.0, MOST_SQUARES);
        let square = size.max_element() / squares;
        let columns = (size.x / square).ceil().max(1.0) as usize;
        let rows = (size.y / square).ceil().max(1.0) as usize;
        let mut faces = vec![Vec::new(); columns * rows];
        for (corners, face) in corners.iter().zip(0..) {
            let [a, b, c] = *corners;
            let from = (a.min(b).min(c) - low) / square;
            let to = (a.max(b).max(c) - low) / square;
            for row in from.y as usize..=(to.y as usize).min(rows - 1) {
                for column in from.x as usize..=(to.x as usize).min(columns - 1) {
                    let middle = low + (DVec2::new(column as f64, row as f64) + 0.5) * square;
                    if distance_to_triangle(corners, middle) <= 0.71 * square {
                        faces[row * columns + column].push(face);
                    }
                }
            }
        }
        let margin: Vec<(u32, DVec2, DVec2)> = (0..count as u32)
            .flat_map(|face| (0..3).map(move |edge| (face, edge)))
            .filter(|&(face, edge)| {
                let beyond = surface.neighbour(face, edge);
                beyond.is_none_or(|beyond| beyond as usize >= count)
            })
            .map(|(face, edge)| {
                let corners = corners[face as usize];
                (face, corners[edge], corners[(edge + 1) % 3])
            })
            .collect();
        for (square_number, list) in faces.iter_mut().enumerate() {
            let (column, row) = (square_number % columns, square_number / columns);
            let middle = low + (DVec2::new(column as f64, row as f64) + 0.5) * square;
            let reach = |&(_, a, b): &(u32, DVec2, DVec2)| Line::new([a, b]).distance(middle);
            let nearest = margin.iter().map(reach).fold(f64::INFINITY, f64::min);
            if !list.is_empty() && nearest > 0.71 * square {
                continue;
            }
            // A margin nearest to some point of the square is at most a diagonal further from its
            // middle.
            let near = margin
                .iter()
                .filter(|edge| reach(edge) <= nearest + 1.42 * square);
            list.extend(near.map(|(face, _, _)| *face));
            list.sort_unstable();
            list.dedup();
        }
        Self {
            field,
            corners,
            both,
            low,
            square,
            columns,
            rows,
            faces,
        }
    }

    /// The mosaic that is looked up.
    pub fn field(&self) -> &TypeField {
        &self.field
    }

    /// The point of the sheet's adaxial face at a place of the plane (mm), for places outside the
    /// sheet its nearest point.
    pub fn locate(&self, p: DVec2) -> SurfacePoint {
        let at = ((p - self.low) / self.square).max(DVec2::ZERO);
        let column = (at.x as usize).min(self.columns - 1);
        let row = (at.y as usize).min(self.rows - 1);
        let mut best = (f64::INFINITY, 0);
        for &face in &self.faces[row * self.columns + column] {
            let distance = distance_to_triangle(&self.corners[face as usize], p);
            if distance < best.0 {
                best = (distance, face);
                if distance == 0.0 {
                    break;
                }
            }
        }
        let face = best.1;
        let corners = &self.corners[face as usize];
        let p = if best.0 > 0.0 {
            polygon::nearest(corners, p).at
        } else {
            p
        };
        let [a, b, c] = *corners;
        let twice = (b - a).perp_dot(c - a);
        let v = ((p - a).perp_dot(c - a) / twice).clamp(0.0, 1.0);
        let w = ((b - a).perp_dot(p - a) / twice).clamp(0.0, 1.0 - v);
        SurfacePoint {
            face,
            barycentric: [1.0 - v - w, v, w],
        }
    }

    /// Contents of the blade's tissue at a place in the plane (mm); outside the sheet those at its
    /// nearest point.
    ///
    /// With both faces the contents per area are the mean of the two faces' contents: each face's
    /// tissue is half of the blade's thickness, and light passes both.
    ///
    /// # Panics
    ///
    /// If there are not as many contents and weights as types.
    pub fn at(&self, p: DVec2, of_types: &[Contents], weights: &mut [f64]) -> Contents {
        let adaxial = self.locate(p);
        let first = self.field.contents(&adaxial, of_types, weights);
        if !self.both {
            return first;
        }
        let [u, v, w] = adaxial.barycentric;
        let abaxial = SurfacePoint {
            face: adaxial.face + self.corners.len() as u32,
            barycentric: [u, w, v],
        };
        let second = self.field.contents(&abaxial, of_types, weights);
        Contents(first.zip_with(second.0, |one, other| 0.5 * (one + other)))
    }
}
