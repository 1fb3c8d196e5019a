//! The blade as a triangle mesh.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::BladeForm;
use super::form::Bend;
use super::frame::UvFrame;
use super::relief::Relief;
use super::sites;
use super::triangulate::{TriangulationError, triangulate};
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Most triangles of a blade.
const MOST_TRIANGLES: f64 = 2e7;

/// The blade: one sheet of triangles, counter-clockwise seen from the adaxial side (+z of the flat leaf).
///
/// Light transport takes the leaf for a sheet (its thickness is in its optics), so there is one surface; the thickness
/// of the tissue is told for every vertex. All lists but `triangles` have an entry a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeMesh {
    /// Positions in space, mm; the base at the origin, the midrib leaving along +y.
    pub positions: Vec<DVec3>,
    /// Unit normals on the adaxial side.
    pub normals: Vec<DVec3>,
    /// Texture coordinates in the [`UvFrame`] of the margin.
    pub uvs: Vec<DVec2>,
    /// Thickness of the tissue, mm, > 0.
    pub thickness_mm: Vec<f64>,
    /// Place in the flat lamina, mm.
    pub lamina: Vec<DVec2>,
    /// Vertex numbers.
    pub triangles: Vec<[u32; 3]>,
}

/// Why there is no such blade.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BladeError {
    /// A number of the form is out of range.
    #[error("{field} is {value}, it must be from {least} to {most}")]
    OutOfRange {
        /// Which number.
        field: &'static str,
        /// What it was.
        value: f64,
        /// Least value.
        least: f64,
        /// Greatest value.
        most: f64,
    },
    /// Edges so short that the mesh would not fit into memory.
    #[error(
        "max_edge_mm is {max_edge_mm}: a leaf of {area_mm2} mm² would have more than 20 million triangles"
    )]
    TooFine {
        /// Longest edge, mm.
        max_edge_mm: f64,
        /// Area of the lamina, mm².
        area_mm2: f64,
    },
    /// The lamina could not be triangulated.
    #[error(transparent)]
    Triangulation(#[from] TriangulationError),
}

/// What is wrong with a mesh. No mesh from [`BladeMesh::build`] has any of it.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshFault {
    /// A triangle names a vertex that is not there, or one vertex twice.
    #[error("triangle {triangle} has bad vertices")]
    BadTriangle {
        /// Its number.
        triangle: usize,
    },
    /// A number is not finite, a normal no unit vector, a thickness not above 0.
    #[error("vertex {vertex} has a bad number")]
    BadVertex {
        /// Its number.
        vertex: usize,
    },
    /// An edge belongs to more than two triangles, or to two that run along it in the same sense.
    #[error("the edge from vertex {from} to vertex {to} is used twice in one sense")]
    NotManifold {
        /// Its start.
        from: u32,
        /// Its end.
        to: u32,
    },
    /// A triangle of the flat lamina is turned over or has no area.
    #[error("triangle {triangle} is turned over in the flat lamina")]
    Flipped {
        /// Its number.
        triangle: usize,
    },
}

impl BladeMesh {
    /// Meshes the lamina within an outline, with the major veins of a network as edges and relief, and bends it.
    ///
    /// # Errors
    ///
    /// [`BladeError`] if the form is out of range or the lamina cannot be triangulated.
    pub fn build(
        outline: &Outline,
        network: &VenationNetwork,
        form: &BladeForm,
    ) -> Result<Self, BladeError> {
        form.validate()?;
        let area_mm2 = outline.area();
        if area_mm2 / (0.4 * form.max_edge_mm * form.max_edge_mm) > MOST_TRIANGLES {
            return Err(BladeError::TooFine {
                max_edge_mm: form.max_edge_mm,
                area_mm2,
            });
        }
        let axes = sites::major_axes(network, form.meshed_vein_radius_mm);
        let sites = sites::place(outline, &axes, form.max_edge_mm);
        let flat = triangulate(outline, &sites, sites::least_area(form.max_edge_mm))?;
        let (min, max) = outline.bounds();
        let relief = Relief::new(axes, form.relief, min, max);
        let half_width = min.x.abs().max(max.x.abs());
        let bend = Bend::new(*form, outline.length(), half_width);
        let ridges: Vec<f64> = flat.points.iter().map(|&point| relief.at(point)).collect();
        let positions: Vec<DVec3> = flat
            .points
            .iter()
            .zip(&ridges)
            .map(|(point, ridge)| bend.apply(point.extend(-ridge)))
            .collect();
        let frame = UvFrame::around(outline.points());
        Ok(Self {
            normals: vertex_normals(&positions, &flat.triangles),
            positions,
            uvs: flat.points.iter().map(|&point| frame.uv(point)).collect(),
            thickness_mm: ridges
                .iter()
                .map(|ridge| form.thickness_mm + ridge)
                .collect(),
            lamina: flat.points,
            triangles: flat.triangles,
        })
    }

    /// Area of the flat lamina that the triangles cover, mm².
    pub fn lamina_area(&self) -> f64 {
        self.triangles
            .iter()
            .map(|&triangle| self.flat_area(triangle))
            .sum()
    }

    fn flat_area(&self, triangle: [u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|vertex| self.lamina[vertex as usize]);
        0.5 * (b - a).perp_dot(c - a)
    }

    /// Checks everything that a mesh must be: whole, oriented, without cracks and folds in the flat lamina.
    ///
    /// # Errors
    ///
    /// [`MeshFault`], the first one found.
    pub fn validate(&self) -> Result<(), MeshFault> {
        let count = self.positions.len();
        for vertex in 0..count {
            let sound = self.positions[vertex].is_finite()
                && (self.normals[vertex].length() - 1.0).abs() < 1e-9
                && self.uvs[vertex].is_finite()
                && self.thickness_mm[vertex] > 0.0;
            if !sound {
                return Err(MeshFault::BadVertex { vertex });
            }
        }
        let mut directed = BTreeMap::new();
        for (number, &[a, b, c]) in self.triangles.iter().enumerate() {
            if [a, b, c].iter().any(|&vertex| vertex as usize >= count)
                || a == b
                || b == c
                || c == a
            {
                return Err(MeshFault::BadTriangle { triangle: number });
            }
            if self.flat_area([a, b, c]) <= 0.0 {
                return Err(MeshFault::Flipped { triangle: number });
            }
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if directed.insert((from, to), number).is_some() {
                    return Err(MeshFault::NotManifold { from, to });
                }
            }
        }
        Ok(())
    }
}

/// Normals of the triangles about each vertex, weighted by their angle there.
fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|vertex| positions[vertex as usize]);
        let face = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize_or_zero();
        for i in 0..3 {
            let there = corners[(i + 1) % 3] - corners[i];
            let back = corners[(i + 2) % 3] - corners[i];
            let angle = libm::atan2(there.cross(back).length(), there.dot(back));
            normals[triangle[i] as usize] += face * angle;
        }
    }
    normals
        .into_iter()
        .map(|normal| normal.normalize_or(DVec3::Z))
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::shape::growth_shape::{GrowthShape, VeinRow};
    use crate::venation;
    use crate::venation::plan::{Growth, Pattern, VenationPlan};

    fn leaf(rate_ratio: f64, widest_at: f64, slope: f64, seed: u64) -> (Outline, VenationNetwork) {
        let shape = GrowthShape {
            rows: 60,
            axial_rate: 0.1,
            rate_ratio,
            widest_at,
            falloff: 3.0,
            lobe_decay: 0.0,
            lobe_exponent: 2.0,
            veins: vec![VeinRow {
                position: 0.5,
                slope,
            }],
        };
        let plan = VenationPlan {
            pattern: Pattern::Closed,
            final_length: 80.0,
            kill_distance: 1.0,
            source_birth_distance: 3.0,
            vein_birth_distance: 3.0,
            darts_per_area: 0.01,
            growth: Growth::Marginal {
                initial_length: 10.0,
                length_step: 1.0,
            },
            murray_exponent: 2.0,
            veinlet_radius_mm: 0.05,
        };
        let outline = shape.grow(60.0).expect("a good shape");
        let network = venation::grow(&outline, &plan, seed).expect("a good plan");
        (outline, network)
    }

    fn form() -> BladeForm {
        BladeForm {
            fold: 0.3,
            curl: 0.5,
            ruffle: 0.01,
            ruffle_waves: 4.0,
            relief: 0.5,
            thickness_mm: 0.2,
            max_edge_mm: 2.0,
            meshed_vein_radius_mm: 0.15,
        }
    }

    /// Share of triangles whose least angle in the flat lamina is below `degrees`.
    fn share_below(mesh: &BladeMesh, degrees: f64) -> f64 {
        let slivers = mesh.triangles.iter().filter(|triangle| {
            let corners = triangle.map(|vertex| mesh.lamina[vertex as usize]);
            (0..3).any(|i| {
                let there = corners[(i + 1) % 3] - corners[i];
                let back = corners[(i + 2) % 3] - corners[i];
                there.angle_to(back).abs().to_degrees() < degrees
            })
        });
        slivers.count() as f64 / mesh.triangles.len() as f64
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

        #[test]
        fn a_blade_has_no_cracks_flips_or_slivers(
            rate_ratio in 1.1..1.6,
            widest_at in 0.2..0.7,
            slope in -0.3..1.0,
            seed in 0_u64..1000,
        ) {
            let (outline, network) = leaf(rate_ratio, widest_at, slope, seed);
            let mesh = BladeMesh::build(&outline, &network, &form()).expect("a good form");
            prop_assert_eq!(mesh.validate(), Ok(()));
            // Thinning the margin gives away slivers of its curve, no more.
            let lost = (mesh.lamina_area() / outline.area() - 1.0).abs();
            prop_assert!(lost < 2e-3, "area differs by {}", lost);
            prop_assert!(share_below(&mesh, 5.0) < 0.01, "{}", share_below(&mesh, 5.0));
            prop_assert!(share_below(&mesh, 15.0) < 0.05, "{}", share_below(&mesh, 15.0));
            let holes = euler_characteristic(&mesh);
            prop_assert_eq!(holes, 1, "one sheet without holes");
        }
    }

    fn euler_characteristic(mesh: &BladeMesh) -> i64 {
        let mut edges = std::collections::BTreeSet::new();
        for &[a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.insert((from.min(to), from.max(to)));
            }
        }
        mesh.positions.len() as i64 - edges.len() as i64 + mesh.triangles.len() as i64
    }

    #[test]
    fn veins_stand_out_on_the_abaxial_side_and_thicken_the_blade() {
        let (outline, network) = leaf(1.25, 0.35, 0.0, 1);
        let flat = BladeForm {
            fold: 0.0,
            curl: 0.0,
            ruffle: 0.0,
            ..form()
        };
        let mesh = BladeMesh::build(&outline, &network, &flat).expect("a good form");
        let deepest = mesh
            .positions
            .iter()
            .map(|position| position.z)
            .fold(0.0, f64::min);
        let thickest = mesh.thickness_mm.iter().copied().fold(0.0, f64::max);
        assert!(deepest < -0.1, "{deepest}");
        assert!((thickest - 0.2 + deepest).abs() < 1e-12);
        assert!(mesh.positions.iter().all(|position| position.z <= 0.0));
        let midrib = network
            .segments()
            .map(|vein| vein.radius_from)
            .fold(0.0, f64::max);
        assert!(
            -deepest <= midrib + 1e-9,
            "no deeper than the relief of the thickest vein"
        );
    }

    #[test]
    fn a_number_out_of_range_is_named() {
        let (outline, network) = leaf(1.25, 0.35, 0.0, 1);
        let bad = BladeForm {
            curl: f64::NAN,
            ..form()
        };
        let error = BladeMesh::build(&outline, &network, &bad).expect_err("not a number");
        assert!(error.to_string().contains("curl"), "{error}");
        let bad = BladeForm {
            max_edge_mm: 0.001,
            ..form()
        };
        let error = BladeMesh::build(&outline, &network, &bad).expect_err("too fine");
        assert!(matches!(error, BladeError::TooFine { .. }));
    }
}
