//! How the faces of a blade differ from smooth sheets, in numbers.

use super::dust::DustPlan;
use super::stomata::StomataPlan;
use crate::document::{Declared, Keys, RangeError};

/// How the faces of a blade differ from smooth sheets.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = refuse_tiny_cells)]
pub struct SurfacePlan {
    /// Depth of the groove over a vein on the adaxial face, over the vein's diameter; below 0 it
    /// stands out.
    #[key("impressed", -2.0..=2.0)]
    pub impressed: f64,
    /// Height of a vein on the abaxial face over its diameter; below 0 it is sunk.
    #[key("raised", -2.0..=2.0)]
    pub raised: f64,
    /// Height to which the lamina bulges far from veins, towards the adaxial side.
    #[key("bulge_mm", 0.0..=5.0)]
    pub bulge_mm: f64,
    /// Distance from a vein within which it rises to that; narrower areoles bulge less.
    #[key("bulge_width_mm", 0.05..=100.0)]
    pub bulge_width_mm: f64,
    /// GGX roughness of both coats over a fully developed vein beside their own: squares add up.
    #[key("vein_roughness", 0.0..=1.0)]
    pub vein_roughness: f64,
    /// GGX roughness of both coats over tissue that has died of age, beside their own: squares add
    /// up.
    #[key("dead_roughness", 0.0..=1.0)]
    pub dead_roughness: f64,
    /// How far the leaf has matured: 0 just unfolded, 1 mature.
    #[key("maturity", 0.0..=1.0)]
    pub maturity: f64,
    /// Roughness of both coats of a leaf that has just unfolded over that of the mature one; below
    /// 1 it is glossier.
    #[key("young_roughness", 0.2..=1.5)]
    pub young_roughness: f64,
    /// Width of the cells of the epidermis: 0 for none, else from 5. They are seen where a pixel is
    /// smaller than a cell.
    #[key("cells_um", 0.0..=500.0)]
    pub cells_um: f64,
    /// Length of these cells along the midrib over their width.
    #[key("cell_elongation", 1.0..=30.0)]
    pub cell_elongation: f64,
    /// Share of a coat's roughness, as a square, that the bulging of cells makes.
    #[key("cell_share", 0.0..=1.0)]
    pub cell_share: f64,
    /// Optical thickness of wax crystals on the adaxial face, which scatter all light: 0.1 is a
    /// breath, 1 a white bloom.
    #[key("adaxial_bloom", 0.0..=10.0, at = 0)]
    /// Optical thickness of wax crystals on the abaxial face.
    #[key("abaxial_bloom", 0.0..=10.0, at = 1)]
    pub bloom: [f64; 2],
    /// Its stomata: pits that are seen where a pixel is smaller than they are.
    #[key("stomata", block)]
    pub stomata: StomataPlan,
    /// Mineral dust on its faces; left out, they are clean.
    #[key("dust", block)]
    pub dust: DustPlan,
}

impl SurfacePlan {
    /// A surface of which nothing is said: smooth, mature and clean.
    pub const SMOOTH: Self = Self {
        impressed: 0.0,
        raised: 0.0,
        bulge_mm: 0.0,
        bulge_width_mm: 1.0,
        vein_roughness: 0.0,
        dead_roughness: 0.0,
        maturity: 1.0,
        young_roughness: 0.6,
        cells_um: 0.0,
        cell_elongation: 1.0,
        cell_share: 0.2,
        bloom: [0.0; 2],
        stomata: StomataPlan::NONE,
        dust: DustPlan::NONE,
    };

    /// Roughness of the coats at the leaf's maturity over that of the mature leaf.
    pub fn roughness_by_age(&self) -> f64 {
        self.young_roughness + (1.0 - self.young_roughness) * self.maturity
    }

    /// The same surface as far as the blade's mesh carries it: the bulge alone.
    #[must_use]
    pub(crate) fn displacement_alone(&self) -> Self {
        Self {
            bulge_mm: self.bulge_mm,
            bulge_width_mm: self.bulge_width_mm,
            ..Self::SMOOTH
        }
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for the first field out of range, by name.
    pub fn validate(&self) -> Result<(), RangeError> {
        self.in_range()?;
        let valid = self.cells_um == 0.0 || self.cells_um >= 5.0;
        RangeError::unless(valid, "cells_um", self.cells_um, "0, or 5 to 500")?;
        self.stomata.validate()
    }
}

fn refuse_tiny_cells(plan: &mut SurfacePlan, keys: &mut Keys<'_>) {
    if keys.is_sound() {
        let help = "cells of an epidermis are 10 to 200 µm wide; write 0 for none";
        keys.refuse_gap("cells_um", plan.cells_um, [5.0, 500.0], help);
    }
}
