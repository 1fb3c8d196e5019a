//! The lamina in space: mesh, relief, and what the tissue holds where.

mod form;
mod relief;
mod sites;

pub mod contents_map;
pub mod frame;
pub mod mesh;
pub mod mottle;
pub mod tissue;
pub mod triangulate;
pub mod vein_field;
pub mod vein_profile;

/// How a flat lamina is bent, and how finely it is meshed. Angles are radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeForm {
    /// Angle by which each half is raised about the midrib, towards the adaxial side (0 flat).
    pub fold: f64,
    /// Angle through which the midrib bends from base to apex, towards the abaxial side (0 straight).
    pub curl: f64,
    /// Amplitude of the wave along the margin as a share of the leaf's length, ≥ 0.
    pub ruffle: f64,
    /// Waves along each side of the margin.
    pub ruffle_waves: f64,
    /// Height of vein relief on the abaxial side over the vein's diameter, ≥ 0 (0 none).
    pub relief: f64,
    /// Thickness of the lamina between veins, mm, > 0.
    pub thickness_mm: f64,
    /// Longest edge of the mesh, mm, > 0.
    pub max_edge_mm: f64,
    /// Veins at least this wide (radius, mm) are edges of the mesh and have relief.
    pub meshed_vein_radius_mm: f64,
}

impl BladeForm {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`mesh::BladeError::OutOfRange`] with the first one outside its range.
    pub fn validate(&self) -> Result<(), mesh::BladeError> {
        let checks = [
            ("fold", self.fold, -1.4, 1.4),
            ("curl", self.curl, -6.2, 6.2),
            ("ruffle", self.ruffle, 0.0, 0.5),
            ("ruffle_waves", self.ruffle_waves, 0.0, 100.0),
            ("relief", self.relief, 0.0, 5.0),
            ("thickness_mm", self.thickness_mm, 1e-3, 10.0),
            ("max_edge_mm", self.max_edge_mm, 1e-3, 1e4),
            (
                "meshed_vein_radius_mm",
                self.meshed_vein_radius_mm,
                1e-4,
                1e3,
            ),
        ];
        for (field, value, least, most) in checks {
            if !(least..=most).contains(&value) {
                return Err(mesh::BladeError::OutOfRange {
                    field,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }
}
