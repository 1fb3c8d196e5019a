//! A blade with two faces and a rim, for pictures from so near that its edge has a thickness.
//!
//! The sheet is the middle of the blade. Each vertex goes half the blade's thickness to either
//! side, across the blade and not along the normal of its relief, whose grooves are narrower than
//! the blade is thick; and the margin, as well as the edge of every hole, is closed by half a
//! circle from one face to the other. The adaxial face and the adaxial half of the rim are one mesh, the
//! others a second one; both have normals towards the adaxial side of the tissue that they cut, as
//! the sheet has, so the abaxial face's point inwards.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::BladeMesh;
use super::mesh::vertex_normals;

/// Rows of rectangles from a face to the middle of the rim.
const ROWS: u32 = 3;

impl BladeMesh {
    /// The blade, whose form is closed, as one closed body; normals and triangles face outwards.
    #[must_use]
    pub fn body(&self, uv: impl Fn(DVec2) -> DVec2) -> Self {
        let [mut body, below] = self.closed(uv);
        let first = body.positions.len() as u32;
        body.positions.extend(below.positions);
        body.normals
            .extend(below.normals.into_iter().map(|normal| -normal));
        body.uvs.extend(below.uvs);
        body.thickness_mm.extend(below.thickness_mm);
        body.lamina.extend(below.lamina);
        body.relief_mm.extend(below.relief_mm);
        body.across.extend(below.across);
        let turned = below.triangles.into_iter().map(|[a, b, c]| [a, c, b]);
        body.triangles.extend(turned.map(|t| t.map(|v| v + first)));
        body
    }

    /// The adaxial and the abaxial half of the blade, whose form is closed, each with half the rim. `uv` gives the texture
    /// coordinates of a flat place, which may lie beyond the margin by the width of the rim.
    #[must_use]
    pub fn closed(&self, uv: impl Fn(DVec2) -> DVec2) -> [Self; 2] {
        let rim = Rim::of(self);
        [1.0, -1.0].map(|side| {
            let mut half = self.clone();
            for (vertex, place) in half.positions.iter_mut().enumerate() {
                *place += self.across[vertex] * (0.5 * side * self.thickness_mm[vertex]);
            }
            let first = half.positions.len();
            rim.close(&mut half, self, side, &uv);
            // The rim has the normals of its circle, the face those of its own relief.
            let normals = vertex_normals(&half.positions, &half.triangles);
            half.normals[..first].copy_from_slice(&normals[..first]);
            half
        })
    }
}

/// The edges of a sheet that only one triangle has.
struct Rim {
    /// The sheet lies to the left.
    edges: Vec<[u32; 2]>,
    /// By vertex of those edges the unit directions away from the sheet, in space and on the flat
    /// lamina.
    outward: HashMap<u32, (DVec3, DVec2)>,
}

impl Rim {
    fn of(sheet: &BladeMesh) -> Self {
        let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
        let mut sorted: Vec<[u32; 2]> = sheet.triangles.iter().flat_map(sides).collect();
        sorted.sort_unstable();
        let is_open = |&[a, b]: &[u32; 2]| sorted.binary_search(&[b, a]).is_err();
        let edges: Vec<[u32; 2]> = sorted.iter().copied().filter(is_open).collect();
        let mut outward: HashMap<u32, (DVec3, DVec2)> = HashMap::new();
        for &[a, b] in &edges {
            let [p, q] = [a, b].map(|v| sheet.positions[v as usize]);
            let [flat_p, flat_q] = [a, b].map(|v| sheet.lamina[v as usize]);
            let flat = -(flat_q - flat_p).perp().normalize_or_zero();
            for vertex in [a, b] {
                let normal = sheet.across[vertex as usize];
                let away = (q - p).cross(normal).normalize_or_zero();
                let sums = outward.entry(vertex).or_default();
                sums.0 += away;
                sums.1 += flat;
            }
        }
        for (&vertex, (away, flat)) in &mut outward {
            let normal = sheet.across[vertex as usize];
            *away = (*away - normal * away.dot(normal)).normalize_or_zero();
            *flat = flat.normalize_or_zero();
        }
        Self { edges, outward }
    }

    /// Adds to the face on one `side` of a sheet (1 adaxial, −1 abaxial) its half of the rim.
    fn close(
        &self,
        half: &mut BladeMesh,
        sheet: &BladeMesh,
        side: f64,
        uv: impl Fn(DVec2) -> DVec2,
    ) {
        // The vertices of the rows beyond the face, by vertex of the face.
        let mut first: HashMap<u32, u32> = HashMap::new();
        for vertex in self.edges.iter().flatten() {
            if first.contains_key(vertex) {
                continue;
            }
            first.insert(*vertex, half.positions.len() as u32);
            let at = *vertex as usize;
            let (away, flat_away) = self.outward[vertex];
            let (normal, radius) = (sheet.across[at], 0.5 * sheet.thickness_mm[at]);
            for row in 1..=ROWS {
                let angle = FRAC_PI_2 * f64::from(row) / f64::from(ROWS);
                // The last row is the middle of the rim, the same bits in both halves.
                let cosine = if row < ROWS { libm::cos(angle) } else { 0.0 };
                let out = normal * (side * cosine) + away * libm::sin(angle);
                let lamina = sheet.lamina[at] + flat_away * (radius * angle);
                half.positions.push(sheet.positions[at] + out * radius);
                half.normals.push((out * side).normalize_or(normal));
                half.lamina.push(lamina);
                half.uvs.push(uv(lamina));
                half.thickness_mm.push(sheet.thickness_mm[at]);
                half.relief_mm.push(sheet.relief_mm[at]);
                half.across.push(sheet.across[at]);
            }
        }
        for &[a, b] in &self.edges {
            let row = |vertex: u32, row: u32| match row {
                0 => vertex,
                _ => first[&vertex] + row - 1,
            };
            for inner in 0..ROWS {
                let [p, q] = [row(a, inner), row(b, inner)];
                let [s, r] = [row(a, inner + 1), row(b, inner + 1)];
                half.triangles.extend([[p, s, r], [p, r, q]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::BladeForm;
    use crate::blade::frame::UvFrame;
    use crate::blade::tests::{ellipse, flat, herringbone};
    use crate::venation::conformal_map::ConformalMap;

    /// An ellipse as a sheet, both of its halves, and the body.
    fn leaf(form: &BladeForm) -> (BladeMesh, [BladeMesh; 2], BladeMesh) {
        let outline = ellipse(20.0, 40.0, 360);
        let map = ConformalMap::new(0.0, DVec2::ZERO);
        let veins = herringbone(40.0, 4, 0.3);
        let sheet = BladeMesh::from_veins(&outline, &veins, map, form).expect("it has a mesh");
        let frame = UvFrame::around(outline.points());
        let halves = sheet.closed(|p| frame.uv(p));
        let body = sheet.body(|p| frame.uv(p));
        (sheet, halves, body)
    }

    fn volume(body: &BladeMesh, origin: DVec3) -> f64 {
        let triangles = body.triangles.iter();
        let cones = triangles.map(|t| t.map(|v| body.positions[v as usize] - origin));
        cones.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn a_flat_leaf_has_the_volume_of_its_area_and_a_round_rim() {
        let form = BladeForm {
            thickness_mm: 0.4,
            closed: true,
            ..flat()
        };
        let (sheet, _, body) = leaf(&form);
        let found = volume(&body, DVec3::ZERO);
        let elsewhere = volume(&body, DVec3::new(7.0, -3.0, 50.0));
        assert!((elsewhere / found - 1.0).abs() < 1e-9, "it is closed");
        let area: f64 = sheet.triangles.iter().map(|t| sheet.flat_area(t)).sum();
        let rim = Rim::of(&sheet);
        let place = |v: u32| sheet.positions[v as usize];
        let around: f64 = rim
            .edges
            .iter()
            .map(|&[a, b]| place(a).distance(place(b)))
            .sum();
        // Pappus: half a dodecagon for the circle, a little beyond the margin.
        let half_circle = 0.5 * (6.0 * libm::sin(std::f64::consts::FRAC_PI_3 / 2.0)) * 0.04;
        let expected = area * 0.4 + half_circle * around;
        let slack = 2.0 * std::f64::consts::PI * half_circle * 0.1;
        assert!(
            (found - expected - 0.5 * slack).abs() < slack,
            "{found} {expected}"
        );
    }

    #[test]
    fn halves_meet_in_the_middle_of_the_rim_and_face_the_adaxial_side() {
        let form = BladeForm {
            fold: 0.4,
            curl: 0.7,
            relief: 0.5,
            closed: true,
            ..flat()
        };
        let (sheet, halves, body) = leaf(&form);
        let open = |half: &BladeMesh| {
            let mut places: Vec<[u64; 3]> = Rim::of(half)
                .edges
                .iter()
                .flatten()
                .map(|&v| half.positions[v as usize].to_array().map(f64::to_bits))
                .collect();
            places.sort_unstable();
            places.dedup();
            places
        };
        let [above, below] = halves.each_ref().map(open);
        assert_eq!(above.len(), Rim::of(&sheet).outward.len());
        for half in &halves {
            assert_eq!(half.uvs.len(), half.positions.len());
            assert_eq!(half.turned_over().count(), 0);
        }
        assert_eq!(above, below);
        assert_eq!(body.turned_over().count(), 0);
        let found = volume(&body, DVec3::ZERO);
        let elsewhere = volume(&body, DVec3::new(90.0, 0.0, -50.0));
        assert!((elsewhere / found - 1.0).abs() < 1e-9, "it is closed");
    }
}
