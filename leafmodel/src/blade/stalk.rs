//! Stalks in space: tubes along polylines, closed at both ends.

#[cfg(test)]
mod testing;

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::not_grown::{NotGrown, not_grown};
use crate::plane::polyline;

/// How far the sides of a tube may lie inside the round stalk that they approximate, mm.
const SAGITTA_MM: f64 = 0.01;
/// Least and greatest number of sides.
const SIDES: [usize; 2] = [8, 48];
/// Most of one with relief.
const MOST_SIDES: usize = 4096;

/// Tubes in space. Lengths are millimetres.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct StalkMesh {
    /// Places of the vertices.
    pub positions: Vec<DVec3>,
    /// Unit normals, outward.
    pub normals: Vec<DVec3>,
    /// Texture coordinates: one half, and the share of the way from the tube's first end to its
    /// last.
    pub uvs: Vec<DVec2>,
    /// Diameter of the tube at each vertex, > 0.
    pub thickness_mm: Vec<f64>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl StalkMesh {
    /// A tube along `points` with a radius at each of them (both mm) and a hemisphere around each
    /// end point.
    ///
    /// Cross-sections are regular polygons whose sides lie at most 10 µm inside the circle, 8 to 48
    /// of them; they are carried along without twist (parallel transport). The radius of bends must
    /// be large compared with that of the tube, or the inner side folds.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for lists, numbers or kinks of which no tube can be made.
    pub fn tube(points: &[DVec3], radii_mm: &[f64]) -> Result<Self, NotGrown> {
        Self::of_sides(points, radii_mm, sides(widest(radii_mm)))
    }

    /// A tube whose surface stands out from the round one by `height`, of the way along it, mm, the
    /// turn about it, radians, and the radius there, mm; edges of the round one along and around it
    /// are about `edge_mm` long, or as short as those of [`Self::tube`]. It bends smoothly at the
    /// points. What is steeper than its edges can follow comes out jagged.
    ///
    /// # Errors
    ///
    /// As [`Self::tube`].
    pub(crate) fn raised(
        points: &[DVec3],
        radii_mm: &[f64],
        edge_mm: f64,
        height: impl Fn(f64, f64, f64) -> f64,
    ) -> Result<Self, NotGrown> {
        let (points, radii) = refined(points, radii_mm, edge_mm)?;
        let widest = widest(&radii);
        let around = (2.0 * PI * widest / edge_mm).ceil() as usize;
        let sides = around.clamp(sides(widest), MOST_SIDES);
        let mut tube = Self::of_sides(&points, &radii, sides)?;
        let lengths = polyline::lengths(&points);
        // Behind a pole and the rings of the first hemisphere.
        let first = 1 + (rings_of_cap(sides) - 1) * sides;
        for (ring, ((&middle, &radius), &way)) in
            points.iter().zip(&radii).zip(&lengths).enumerate()
        {
            for side in 0..sides {
                let turn = 2.0 * PI * side as f64 / sides as f64;
                let place = &mut tube.positions[first + ring * sides + side];
                *place += (*place - middle) * (height(way, turn, radius) / radius);
            }
        }
        tube.face_outward();
        Ok(tube)
    }

    /// Gives each vertex the mean normal of its triangles, by their areas.
    fn face_outward(&mut self) {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|v| self.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            for &vertex in triangle {
                normals[vertex as usize] += normal;
            }
        }
        for (normal, mean) in self.normals.iter_mut().zip(normals) {
            *normal = mean.try_normalize().unwrap_or(*normal);
        }
    }

    fn of_sides(points: &[DVec3], radii_mm: &[f64], sides: usize) -> Result<Self, NotGrown> {
        let tangents = tangents(points, radii_mm)?;
        let lengths = polyline::lengths(points);
        let last = points.len() - 1;
        let whole = lengths[last];
        let mut tube = Self::default();
        let mut across = tangents[0].any_orthonormal_vector();
        // Rings of a hemisphere between its pole and the tube, which has the one at its foot.
        let cap = rings_of_cap(sides);
        tube.pole(points[0], -tangents[0], radii_mm[0], 0.0);
        for i in (1..cap).rev() {
            let up = 0.5 * PI * i as f64 / cap as f64;
            tube.ring(
                sides,
                (points[0], -tangents[0], across),
                (radii_mm[0], up),
                0.0,
                true,
            );
        }
        for i in 0..=last {
            across = (across - tangents[i] * across.dot(tangents[i])).normalize();
            // Where the tube tapers, normals are inclined along its axis.
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            let slope = (radii_mm[before] - radii_mm[after]) / (lengths[after] - lengths[before]);
            let start = tube.positions.len();
            tube.ring(
                sides,
                (points[i], tangents[i], across),
                (radii_mm[i], 0.0),
                lengths[i] / whole,
                false,
            );
            for normal in &mut tube.normals[start..] {
                *normal = (*normal + tangents[i] * slope).normalize();
            }
        }
        for i in 1..cap {
            let up = 0.5 * PI * i as f64 / cap as f64;
            tube.ring(
                sides,
                (points[last], tangents[last], across),
                (radii_mm[last], up),
                1.0,
                false,
            );
        }
        tube.pole(points[last], tangents[last], radii_mm[last], 1.0);
        tube.join(sides);
        Ok(tube)
    }

    fn pole(&mut self, centre: DVec3, outward: DVec3, radius: f64, along: f64) {
        self.vertex(centre + outward * radius, outward, 2.0 * radius, along);
    }

    fn vertex(&mut self, position: DVec3, normal: DVec3, thickness_mm: f64, along: f64) {
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(DVec2::new(0.5, along));
        self.thickness_mm.push(thickness_mm);
    }

    /// A circle of latitude `up` on the sphere about `centre` whose pole lies towards `axis`. Rings
    /// run counter-clockwise seen from the tube's far end. On the near end, whose pole points the
    /// other way, that is `against` the axis.
    fn ring(
        &mut self,
        sides: usize,
        (centre, axis, across): (DVec3, DVec3, DVec3),
        (radius, up): (f64, f64),
        along: f64,
        against: bool,
    ) {
        let forward = if against { -axis } else { axis };
        let aside = forward.cross(across);
        let (sin, cos) = (libm::sin(up), libm::cos(up));
        for side in 0..sides {
            let turn = 2.0 * PI * side as f64 / sides as f64;
            let radial = across * libm::cos(turn) + aside * libm::sin(turn);
            let normal = (radial * cos + axis * sin).normalize();
            self.vertex(centre + normal * radius, normal, 2.0 * radius, along);
        }
    }

    /// Triangles between the rings of one tube and to its poles.
    fn join(&mut self, sides: usize) {
        let rings = (self.positions.len() - 2) / sides;
        let at = |ring: usize, side: usize| (1 + ring * sides + side % sides) as u32;
        let end = (self.positions.len() - 1) as u32;
        for side in 0..sides {
            self.triangles.push([0, at(0, side + 1), at(0, side)]);
            for ring in 1..rings {
                let [a, b] = [at(ring - 1, side), at(ring - 1, side + 1)];
                let [c, d] = [at(ring, side), at(ring, side + 1)];
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
            self.triangles
                .push([end, at(rings - 1, side), at(rings - 1, side + 1)]);
        }
    }

    /// Adds tubes to these.
    pub fn append(&mut self, other: Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.uvs.extend(other.uvs);
        self.thickness_mm.extend(other.thickness_mm);
        let moved = other.triangles.into_iter().map(|t| t.map(|v| v + first));
        self.triangles.extend(moved);
    }
}

fn widest(radii_mm: &[f64]) -> f64 {
    radii_mm.iter().copied().fold(0.0, f64::max)
}

/// Rings of a hemisphere from its pole to the tube, which has the last one.
fn rings_of_cap(sides: usize) -> usize {
    (sides / 4).max(2)
}

/// A smooth line through the points with pieces of at most `edge_mm`, and the radii there.
fn refined(
    points: &[DVec3],
    radii_mm: &[f64],
    edge_mm: f64,
) -> Result<(Vec<DVec3>, Vec<f64>), NotGrown> {
    let tangents = tangents(points, radii_mm)?;
    let (mut fine, mut radii) = (vec![points[0]], vec![radii_mm[0]]);
    for (i, pair) in points.windows(2).enumerate() {
        let length = pair[0].distance(pair[1]);
        let pieces = (length / edge_mm).ceil().max(1.0) as usize;
        for piece in 1..=pieces {
            let t = piece as f64 / pieces as f64;
            let (square, rest) = (t * t, 1.0 - t);
            // Cubic Hermite interpolation.
            let at = pair[0] * ((1.0 + 2.0 * t) * rest * rest)
                + tangents[i] * (length * t * rest * rest)
                + pair[1] * (square * (3.0 - 2.0 * t))
                - tangents[i + 1] * (length * square * rest);
            fine.push(at);
            radii.push(radii_mm[i] + (radii_mm[i + 1] - radii_mm[i]) * t);
        }
    }
    Ok((fine, radii))
}

/// Number of sides of a polygon that approximates a circle of this radius, mm: its sagitta is
/// `r (1 − cos(π/n))`.
fn sides(radius: f64) -> usize {
    let [fewest, most] = SIDES;
    if radius <= 2.0 * SAGITTA_MM {
        return fewest;
    }
    let needed = PI / libm::acos(1.0 - SAGITTA_MM / radius);
    (needed.ceil() as usize).clamp(fewest, most)
}

/// Directions at the points: half-way between those of the pieces on both sides.
fn tangents(points: &[DVec3], radii_mm: &[f64]) -> Result<Vec<DVec3>, NotGrown> {
    if points.len() < 2 || points.len() != radii_mm.len() {
        let (points, radii) = (points.len(), radii_mm.len());
        return Err(not_grown!(
            "a stalk needs two points or more and a radius for each: {points} points, {radii} radii"
        ));
    }
    let good = |i: usize| {
        let apart = i == 0 || points[i] != points[i - 1];
        points[i].is_finite() && radii_mm[i].is_finite() && radii_mm[i] > 0.0 && apart
    };
    if let Some(index) = (0..points.len()).find(|&i| !good(i)) {
        return Err(not_grown!(
            "point {index} of a stalk has a bad place or radius"
        ));
    }
    let pieces: Vec<DVec3> = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).normalize())
        .collect();
    let kink = pieces
        .windows(2)
        .position(|pair| pair[0].dot(pair[1]) <= 0.0);
    if let Some(before) = kink {
        let at = before + 1;
        return Err(not_grown!("a stalk turns by 90° or more at point {at}"));
    }
    let last = pieces.len() - 1;
    let between = |i: usize| (pieces[i.saturating_sub(1)] + pieces[i.min(last)]).normalize();
    Ok((0..points.len()).map(between).collect())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn volume(mesh: &StalkMesh) -> f64 {
        let cones = mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
            a.dot(b.cross(c)) / 6.0
        });
        cones.sum()
    }

    #[test]
    fn a_straight_tube_has_the_area_and_volume_of_a_capsule() {
        for radius in [0.3, 1.0, 4.0] {
            let tube = |length: f64| {
                let end = DVec3::new(1.0, 2.0, -2.0) / 3.0 * length;
                StalkMesh::tube(&[DVec3::ZERO, end], &[radius; 2]).expect("a tube")
            };
            let mesh = tube(30.0);
            assert_eq!(mesh.validate(), Ok(()));
            let n = sides(radius) as f64;
            // A longer tube has the side of a prism in addition.
            let side = 2.0 * n * radius * libm::sin(PI / n);
            let more = tube(50.0).area() - mesh.area();
            assert!((more - 20.0 * side).abs() < 1e-9 * more, "{more}");
            let area = 2.0 * PI * radius * 30.0 + 4.0 * PI * radius * radius;
            let volume_of_all = PI * radius * radius * (30.0 + radius * 4.0 / 3.0);
            // A polygon of n sides has sin(2π/n)/(2π/n) of the circle's area.
            assert!((mesh.area() / area - 1.0).abs() < 6.0 / (n * n), "{radius}");
            assert!(
                (volume(&mesh) / volume_of_all - 1.0).abs() < 10.0 / (n * n),
                "{radius}"
            );
        }
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn tubes_along_arcs_are_closed_and_look_outward(
            turn in -2.0..2.0_f64, twist in -2.0..2.0_f64, thick in 0.05..2.0, taper in 0.05..1.0,
        ) {
            let (points, radii): (Vec<DVec3>, Vec<f64>) = (0..=30)
                .map(|i| {
                    let t = f64::from(i) / 30.0;
                    let (a, b) = (turn * t, twist * t);
                    let p = DVec3::new(libm::sin(a), t + libm::cos(a) * 0.1, libm::sin(b)) * 20.0;
                    (p, thick * (1.0 + (taper - 1.0) * t))
                })
                .unzip();
            let mesh = StalkMesh::tube(&points, &radii).expect("a tube");
            prop_assert_eq!(mesh.validate(), Ok(()));
            prop_assert!(volume(&mesh) > 0.0);
            prop_assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-12));
        }
    }

    #[test]
    fn what_is_no_way_is_refused() {
        let (o, x) = (DVec3::ZERO, DVec3::X);
        let tube = |points: &[DVec3], radii: &[f64]| {
            let refused = StalkMesh::tube(points, radii).expect_err("no tube");
            refused.to_string()
        };
        assert!(tube(&[o, x], &[1.0]).ends_with("2 points, 1 radii"));
        let bad = "point 1 of a stalk has a bad place or radius";
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(tube(&[o, x], &[1.0, radius]), bad);
        }
        assert_eq!(tube(&[o, o], &[1.0; 2]), bad);
        let kink = "a stalk turns by 90° or more at point 1";
        assert_eq!(tube(&[o, x, o], &[1.0; 3]), kink);
    }

    #[test]
    fn a_raised_tube_is_closed_and_holds_as_much_more_as_its_heights_say() {
        let (points, radii): (Vec<DVec3>, Vec<f64>) = (0..=12)
            .map(|i| {
                let t = f64::from(i) / 12.0;
                (
                    DVec3::new(libm::sin(t), t, libm::cos(2.0 * t)) * 20.0,
                    2.0 - t,
                )
            })
            .unzip();
        let raised = |high: f64| {
            let height = move |way: f64, turn: f64, radius: f64| {
                let waves = (1.0 + libm::cos(5.0 * turn)) * (1.0 + libm::sin(way));
                high * radius * waves
            };
            StalkMesh::raised(&points, &radii, 0.2, height).expect("a tube")
        };
        let (flat, mesh) = (raised(0.0), raised(0.05));
        assert_eq!((flat.validate(), mesh.validate()), (Ok(()), Ok(())));
        assert!(
            mesh.normals
                .iter()
                .all(|n| (n.length() - 1.0).abs() < 1e-12)
        );
        let edges = flat.triangles.iter().flat_map(|t| {
            let [a, b, c] = t.map(|v| flat.positions[v as usize]);
            [a.distance(b), b.distance(c), c.distance(a)]
        });
        // Edges across a quad are longer, and so are those outside a bend.
        assert!(edges.fold(0.0, f64::max) < 0.4);
        // The mean square of 1 + h / r over turns is 1 + 2 · 0.05 m + 1.5 · 0.05² m² for m = 1 + sin,
        // and that of m is 1, of its square 1.5.
        let expected = 1.0 + 0.1 + 1.5 * 1.5 * 0.0025;
        let tubes = [&mesh, &flat].map(volume);
        // Hemispheres, some 5 % of the volume, stay as they are.
        let ratio = tubes[0] / tubes[1];
        assert!((ratio - expected).abs() < 0.02, "{ratio} {expected}");
    }

    #[test]
    fn tubes_are_put_together() {
        let tube = |from: f64| {
            let ends = [DVec3::X * from, DVec3::X * from + DVec3::Y];
            StalkMesh::tube(&ends, &[0.1; 2]).expect("a tube")
        };
        let mut both = tube(0.0);
        both.append(tube(5.0));
        assert_eq!(both.validate(), Ok(()));
        assert!((both.area() - 2.0 * tube(0.0).area()).abs() < 1e-9);
    }
}
