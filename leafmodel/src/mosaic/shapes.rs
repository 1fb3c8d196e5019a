//! Bodies on which mosaics grow: fruits, caps, stems and leaves as even triangle meshes.
//!
//! - **In**: sizes in millimetres, a profile to turn about an axis, or the outline of a leaf.
//! - **Out**: a [`Shape`]: points, exact unit normals of the smooth body, triangles seen
//!   counter-clockwise from outside.
//! - **Always true**: no edge is longer than asked for; triangles have about the same size
//!   everywhere, without crowding at poles.
//! - **Left out**: whether a profile given by the user crosses itself.

pub mod lathe;

use glam::{DVec2, DVec3};

use crate::blade::sheet::even_sheet;
use crate::document::RangeError;
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::outline::Outline;

/// Most triangles of one shape.
const MOST_TRIANGLES: f64 = 4e6;
/// Edge of an icosahedron over the radius of its sphere, times the stretch of its faces' centres by
/// projection onto the sphere.
const ICOSAHEDRON_EDGE: f64 = 1.051_462_224 / 0.794_654_472;

/// A body or sheet as triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Points, mm.
    pub positions: Vec<DVec3>,
    /// Unit normals of the smooth surface at the points, outwards (the adaxial side of a sheet).
    pub normals: Vec<DVec3>,
    /// Points of each triangle, counter-clockwise seen from where the normals point.
    pub faces: Vec<[u32; 3]>,
}

/// A sphere around the origin: the faces of an icosahedron, divided evenly and projected outwards.
///
/// # Errors
///
/// [`NotGrown`] unless both are finite and above 0, and for too many triangles.
pub fn sphere(radius_mm: f64, max_edge_mm: f64) -> Result<Shape, NotGrown> {
    positive("radius_mm", radius_mm)?;
    ellipsoid(DVec3::splat(radius_mm), max_edge_mm)
}

/// An ellipsoid around the origin with these semi-axes, mm. It is a stretched sphere, so its
/// triangles are as unequal as its axes.
///
/// # Errors
///
/// [`NotGrown`] unless all are finite and above 0, and for too many triangles.
pub fn ellipsoid(semi_axes_mm: DVec3, max_edge_mm: f64) -> Result<Shape, NotGrown> {
    for axis in semi_axes_mm.to_array() {
        positive("semi_axes_mm", axis)?;
    }
    positive("max_edge_mm", max_edge_mm)?;
    ellipsoid_triangles(semi_axes_mm, max_edge_mm)?;
    let cuts = ellipsoid_cuts(semi_axes_mm, max_edge_mm);
    let (directions, faces) = divided_icosahedron(cuts as u32);
    Ok(Shape {
        positions: directions.iter().map(|&d| d * semi_axes_mm).collect(),
        normals: directions
            .iter()
            .map(|&d| (d / semi_axes_mm).normalize())
            .collect(),
        faces,
    })
}

/// Pieces into which each edge of an icosahedron is cut for an ellipsoid.
fn ellipsoid_cuts(semi_axes_mm: DVec3, max_edge_mm: f64) -> f64 {
    libm::ceil(ICOSAHEDRON_EDGE * semi_axes_mm.max_element() / max_edge_mm).max(1.0)
}

/// The number of triangles of an ellipsoid.
///
/// # Errors
///
/// [`NotGrown`] for too many triangles.
pub(crate) fn ellipsoid_triangles(semi_axes_mm: DVec3, max_edge_mm: f64) -> Result<f64, NotGrown> {
    let cuts = ellipsoid_cuts(semi_axes_mm, max_edge_mm);
    let triangles = 20.0 * cuts * cuts;
    affordable(triangles)?;
    Ok(triangles)
}

/// A cube around the origin with rounded edges and corners.
///
/// Edges are quarters of cylinders, corners eighths of spheres. A corner radius of half the side
/// gives a sphere.
///
/// # Errors
///
/// [`NotGrown`] unless all are finite and above 0 and the corner radius at most half
/// the side, and for too many triangles.
pub fn rounded_cube(
    side_mm: f64,
    corner_radius_mm: f64,
    max_edge_mm: f64,
) -> Result<Shape, NotGrown> {
    positive("side_mm", side_mm)?;
    positive("max_edge_mm", max_edge_mm)?;
    let fits = corner_radius_mm > 0.0 && corner_radius_mm <= 0.5 * side_mm;
    let limits = "above 0 and at most half the side";
    RangeError::unless(fits, "corner_radius_mm", corner_radius_mm, limits)?;
    let flat = 0.5 * side_mm - corner_radius_mm;
    // Squares a little smaller than the edge allowed, as their diagonals are edges too; near
    // corners they are lozenges with diagonals up to √3.
    let step = max_edge_mm / 3f64.sqrt();
    let in_flat = libm::ceil(2.0 * flat / step);
    let in_arc = libm::ceil(std::f64::consts::FRAC_PI_4 * corner_radius_mm / step).max(1.0);
    let cells = in_flat + 2.0 * in_arc;
    affordable(12.0 * cells * cells)?;
    // Along each axis: the offset by the flat part, and the slope of the direction.
    let axis: Vec<(f64, f64)> = (0..=cells as u32)
        .map(|i| {
            let i = f64::from(i);
            let tangent = |k: f64| {
                if k == in_arc {
                    1.0
                } else {
                    libm::tan(std::f64::consts::FRAC_PI_4 * k / in_arc)
                }
            };
            if i < in_arc {
                (-flat, -tangent(in_arc - i))
            } else if i > in_arc + in_flat {
                (flat, tangent(i - in_arc - in_flat))
            } else if in_flat == 0.0 {
                (0.0, 0.0)
            } else {
                (flat * (2.0 * (i - in_arc) / in_flat - 1.0), 0.0)
            }
        })
        .collect();
    let mut lattice = std::collections::BTreeMap::new();
    let mut shape = Shape {
        positions: Vec::new(),
        normals: Vec::new(),
        faces: Vec::new(),
    };
    let last = cells as u32;
    for (normal, side) in (0..3).flat_map(|normal| [(normal, 0), (normal, last)]) {
        let mut vertex = |i: u32, j: u32| {
            let mut at = [0; 3];
            at[normal] = side;
            at[(normal + 1) % 3] = i;
            at[(normal + 2) % 3] = j;
            *lattice.entry(at).or_insert_with(|| {
                let corner = at.map(|k| axis[k as usize]);
                let direction = DVec3::from_array(corner.map(|(_, slope)| slope)).normalize();
                let core = DVec3::from_array(corner.map(|(core, _)| core));
                shape.positions.push(core + direction * corner_radius_mm);
                shape.normals.push(direction);
                (shape.positions.len() - 1) as u32
            })
        };
        let mut squares = Vec::new();
        for i in 0..last {
            for j in 0..last {
                squares.push([
                    vertex(i, j),
                    vertex(i + 1, j),
                    vertex(i + 1, j + 1),
                    vertex(i, j + 1),
                ]);
            }
        }
        for mut square in squares {
            if side == 0 {
                square.reverse();
            }
            let [a, b, c, d] = square;
            let length = |p: u32, q: u32| {
                shape.positions[p as usize].distance_squared(shape.positions[q as usize])
            };
            if length(a, c) <= length(b, d) {
                shape.faces.extend([[a, b, c], [a, c, d]]);
            } else {
                shape.faces.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    Ok(shape)
}

/// The lamina of a leaf as an even flat sheet in the plane z = 0, adaxial side +z, in the frame of
/// the outline.
///
/// # Errors
///
/// [`NotGrown`] for an edge outside 0.001 to 10000 mm and for too many triangles.
pub fn sheet(outline: &Outline, max_edge_mm: f64) -> Result<Shape, NotGrown> {
    let (points, faces) = even_sheet(outline, max_edge_mm).map_err(NotGrown::because)?;
    Ok(Shape {
        normals: vec![DVec3::Z; points.len()],
        positions: points.into_iter().map(|p: DVec2| p.extend(0.0)).collect(),
        faces,
    })
}

fn positive(field: &'static str, value: f64) -> Result<(), NotGrown> {
    let valid = value.is_finite() && value > 0.0;
    Ok(RangeError::unless(
        valid,
        field,
        value,
        "the positive numbers (millimetres)",
    )?)
}

fn affordable(triangles: f64) -> Result<(), NotGrown> {
    if triangles <= MOST_TRIANGLES {
        return Ok(());
    }
    // A plan has no key for edges, so the error names triangles instead.
    Err(not_grown!(
        "it would take about {triangles:.0} triangles, too many: make the body less slender, give its \
         mosaic fewer cells, or raised tissue a wider slope"
    ))
}

/// Unit vectors and faces of an icosahedron whose edges are cut into `cuts` pieces.
fn divided_icosahedron(cuts: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let corners: Vec<DVec3> = (0..3)
        .flat_map(|axis| {
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)].map(|(s, t)| {
                let mut p = [0.0; 3];
                p[axis] = s;
                p[(axis + 1) % 3] = t * golden;
                DVec3::from_array(p)
            })
        })
        .collect();
    // Corners 2 apart are joined; three that are mutually joined make a face.
    let joined = |a: usize, b: usize| corners[a].distance_squared(corners[b]) < 4.5;
    let mut points = Vec::new();
    let mut known = std::collections::BTreeMap::new();
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if !(joined(a, b) && joined(b, c) && joined(a, c)) {
                    continue;
                }
                let outwards = (corners[b] - corners[a])
                    .cross(corners[c] - corners[a])
                    .dot(corners[a]);
                let [a, b, c] = if outwards > 0.0 { [a, b, c] } else { [a, c, b] };
                let mut point = |i: u32, j: u32| {
                    let mut shares = [(a, cuts - i - j), (b, i), (c, j)];
                    shares.sort_unstable();
                    // Points on edges and corners are identified by the corners that contribute to
                    // them.
                    let key: Vec<(usize, u32)> =
                        shares.into_iter().filter(|&(_, share)| share > 0).collect();
                    *known.entry(key.clone()).or_insert_with(|| {
                        let sum: DVec3 = key
                            .iter()
                            .map(|&(corner, share)| corners[corner] * f64::from(share))
                            .sum();
                        points.push(sum.normalize());
                        (points.len() - 1) as u32
                    })
                };
                for i in 0..cuts {
                    for j in 0..cuts - i {
                        faces.push([point(i, j), point(i + 1, j), point(i, j + 1)]);
                        if i + j + 1 < cuts {
                            faces.push([point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
                        }
                    }
                }
            }
        }
    }
    (points, faces)
}

#[cfg(test)]
mod tests;
