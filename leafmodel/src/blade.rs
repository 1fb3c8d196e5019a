//! The lamina in space: its mesh and relief, and the contents of its tissue at each place.
//!
//! [`BladeMesh::build`] cuts the flat lamina into triangles that follow the margin and the major
//! veins, raises the veins, and bends the whole. [`petiole`] gives it a stalk.
//!
//! - **In**: an outline, the veins, a [`BladeForm`].
//! - **Out**: a [`BladeMesh`] in millimetres, base at the origin, midrib along +y, adaxial side +z.
//! - **Always true**: what [`BladeMesh::validate`] checks: no cracks, no flipped or folded faces.
//! - **Left out**: the two surfaces of a sheet with thickness (thickness is a number at each
//!   vertex).
//!
//! ```
//! use leafmodel::blade::{BladeForm, BladeMesh};
//! use leafmodel::species;
//!
//! let plan = species::find("poplar").ok_or("the poplar is a preset")?.plan();
//! let lamina = plan.grow_lamina()?;
//! // Halves raised by 20° about a straight midrib.
//! let form = BladeForm { fold: 20_f64.to_radians(), curl: 0.0, ..plan.form };
//! let mesh = BladeMesh::build(&lamina.outline, &lamina.network, &form)?;
//! mesh.validate(lamina.outline.area())?;
//! let highest = mesh.positions.iter().map(|p| p.z).fold(0.0, f64::max);
//! assert!(highest > 0.0, "the margin stands above the midrib");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod ageing;
pub mod ageing_courses;
mod closed;
pub mod contents_map;
mod coverage;
mod error;
mod form;
pub mod frame;
pub mod hairs;
pub mod layers;
pub(crate) mod margin_thickness;
pub mod masks;
pub mod mesh;
pub mod mottle;
pub mod petiole;
mod pleats;
mod refine;
mod relief;
pub mod senescence;
mod sheet;
mod size_field;
mod skeleton;
pub mod stalk;
pub mod stance;
pub mod surface;
pub mod tissue;
mod triangulate;
pub mod unevenness;
pub mod vein_body;
pub mod vein_cover;
pub mod vein_field;
mod vein_grid;
mod vein_light;
pub mod vein_profile;
pub mod weathering;

pub use frame::UvFrame;
pub use margin_thickness::MarginThickness;
pub use mesh::{BladeError, BladeMesh};
pub(crate) use sheet::even_sheet;

use crate::venation::network::VeinSegment;

/// How a flat lamina is bent, and how finely it is meshed. Angles are radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeForm {
    /// Angle by which each half is raised about the midrib, towards the adaxial side (0 flat), −1.4
    /// to 1.4.
    pub fold: f64,
    /// Angle through which the midrib bends from base to apex, towards the abaxial side (0
    /// straight), −6.2 to 6.2.
    pub curl: f64,
    /// Amplitude of the wave along the margin as a share of the leaf's length, 0 to 0.5.
    pub ruffle: f64,
    /// Waves along each side of the margin, 0 to 100.
    pub ruffle_waves: f64,
    /// Slope of the folds along primary and secondary veins, radians, 0 (none) to 1.
    pub pleat: f64,
    /// Height of vein relief on the abaxial side over the vein's diameter, 0 (none) to 5.
    pub relief: f64,
    /// Thickness of the lamina between veins, mm, 0.001 to 10.
    pub thickness_mm: f64,
    /// How it falls towards the margin.
    pub margin: MarginThickness,
    /// Whether it has two faces and a rim, and not one sheet that stands for both.
    pub closed: bool,
    /// Longest edge of the mesh, mm, 0.001 to 10000.
    pub max_edge_mm: f64,
    /// Veins of at least this radius, mm, are edges of the mesh and have relief, 0.0001 to 1000.
    pub meshed_vein_radius_mm: f64,
}

impl BladeForm {
    /// The default form of a leaf of this length: nearly flat.
    pub fn nearly_flat(length_mm: f64) -> Self {
        Self {
            fold: 0.0,
            curl: 0.0,
            ruffle: 0.0,
            ruffle_waves: 3.0,
            pleat: 0.0,
            relief: 0.5,
            thickness_mm: 0.2,
            margin: MarginThickness::EVEN,
            closed: false,
            max_edge_mm: length_mm / 80.0,
            meshed_vein_radius_mm: 0.1,
        }
    }

    /// The veins that are edges of the mesh and have relief.
    fn major(&self, veins: &[VeinSegment]) -> Vec<VeinSegment> {
        let is_major = |vein: &&VeinSegment| {
            vein.radius_from.max(vein.radius_to) >= self.meshed_vein_radius_mm
        };
        veins.iter().filter(is_major).copied().collect()
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::OutOfRange`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        let fields = [
            ("fold", self.fold, -1.4..=1.4, "-1.4 to 1.4 (radians)"),
            ("curl", self.curl, -6.2..=6.2, "-6.2 to 6.2 (radians)"),
            ("ruffle", self.ruffle, 0.0..=0.5, "0 to 0.5"),
            ("ruffle_waves", self.ruffle_waves, 0.0..=100.0, "0 to 100"),
            ("pleat", self.pleat, 0.0..=1.0, "0 to 1 (radians)"),
            ("relief", self.relief, 0.0..=5.0, "0 to 5"),
            (
                "thickness_mm",
                self.thickness_mm,
                1e-3..=10.0,
                "0.001 to 10 (millimetres)",
            ),
            (
                "max_edge_mm",
                self.max_edge_mm,
                1e-3..=1e4,
                "0.001 to 10000 (millimetres)",
            ),
            (
                "meshed_vein_radius_mm",
                self.meshed_vein_radius_mm,
                1e-4..=1e3,
                "0.0001 to 1000 (millimetres)",
            ),
        ];
        BladeError::unless_within(fields.into_iter().chain(self.margin.fields()))
    }
}

#[cfg(test)]
mod tests;
