//! How a flat lamina is bent, and how finely it is meshed.

use super::error::BladeError;
use super::margin_thickness::MarginThickness;
use crate::document::{Declared, Keys, Limits, Number};
use crate::venation::network::VeinSegment;

/// How a flat lamina is bent, and how finely it is meshed. Angles are radians.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct BladeForm {
    /// Angle by which each half is raised about the midrib, towards the adaxial side.
    ///
    /// Radians.
    #[key("fold_deg", degrees(-80.0..=80.0))]
    pub fold: f64,
    /// Angle through which the midrib bends from base to apex, towards the abaxial side.
    ///
    /// Radians.
    #[key("curl_deg", degrees(-355.0..=355.0))]
    pub curl: f64,
    /// Height of the wave along the margin over the leaf's length.
    #[key("ruffle", 0.0..=0.5)]
    pub ruffle: f64,
    /// Waves along each side.
    #[key("ruffle_waves", 0.0..=100.0)]
    pub ruffle_waves: f64,
    /// Slope of the folds along primary and secondary veins (pleats), which lie in the valleys.
    ///
    /// Radians.
    #[key("pleat_deg", degrees(0.0..=55.0))]
    pub pleat: f64,
    /// Height of veins on the abaxial side over their diameter.
    #[key("relief", 0.0..=5.0)]
    pub relief: f64,
    /// Thickness between veins.
    #[key("thickness_mm", 0.001..=10.0)]
    pub thickness_mm: f64,
    /// How it falls towards the margin.
    #[key(flat)]
    pub margin: MarginThickness,
    /// Whether the blade has two faces and a rim, for pictures from close by, and not one sheet
    /// that stands for both.
    #[key("closed")]
    pub closed: bool,
    /// Longest edge of the mesh, mm, 0.001 to 10000.
    pub max_edge_mm: f64,
    /// Veins of at least this radius, mm, are edges of the mesh and have relief, 0.0001 to 1000.
    pub meshed_vein_radius_mm: f64,
}

impl BladeForm {
    /// The default form of a leaf of this length: nearly flat.
    pub(crate) fn nearly_flat(length_mm: f64) -> Self {
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
    pub(super) fn major(&self, veins: &[VeinSegment]) -> Vec<VeinSegment> {
        let is_major = |vein: &&VeinSegment| {
            vein.radius_from.max(vein.radius_to) >= self.meshed_vein_radius_mm
        };
        veins.iter().filter(is_major).copied().collect()
    }

    /// The keys of `blade`; edges of the mesh lie within `edges`.
    pub(crate) fn keys(&mut self, keys: &mut Keys<'_>, edges: Limits) {
        self.declare(keys);
        let about = "Longest edge of the mesh.";
        keys.key("max_edge_mm", &mut self.max_edge_mm, Number(edges), about);
        let limits = Number(Limits::closed(1e-4, 1e3));
        let about = "Veins at least this wide are edges of the mesh and have relief.";
        let radius = &mut self.meshed_vein_radius_mm;
        keys.key("meshed_vein_radius_mm", radius, limits, about);
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::Range`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        let mut own = *self;
        // How fine a mesh may be depends on the leaf; a file knows its length.
        let errors = Keys::check(|keys| own.keys(keys, Limits::closed(1e-3, 1e4)));
        Ok(errors.into_iter().next().map_or(Ok(()), Err)?)
    }
}
