//! How the faces of a blade differ from smooth sheets, in numbers.

use super::super::tissue::TissueError;
use super::dust::DustPlan;
use super::stomata::StomataPlan;

/// How the faces of a blade differ from smooth sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePlan {
    /// Depth of the groove over a vein on the adaxial face, over the vein's diameter, −2 (raised)
    /// to 2.
    pub impressed: f64,
    /// Height of a vein on the abaxial face over its diameter, −2 to 2.
    pub raised: f64,
    /// Height to which the lamina bulges far from veins, towards the adaxial side, mm, 0 to 5.
    pub bulge_mm: f64,
    /// Distance from a vein within which the lamina rises to that height, mm, 0.05 to 100.
    pub bulge_width_mm: f64,
    /// GGX roughness that the coat has over a fully developed vein beside its own: the squares add
    /// up; 0 to 1.
    pub vein_roughness: f64,
    /// GGX roughness that the coats have over dead tissue beside their own: the squares add up; 0
    /// to 1.
    pub dead_roughness: f64,
    /// How far the leaf has matured: 0 just unfolded, 1 mature.
    pub maturity: f64,
    /// Roughness of the coats of a leaf that has just unfolded over that of a mature one, 0.2 to
    /// 1.5; between, it is linear in the maturity.
    pub young_roughness: f64,
    /// Mean width of the cells of the epidermis, µm; 0 for none, else 5 to 500.
    pub cells_um: f64,
    /// Length of these cells along the leaf over their width, 1 to 30.
    pub cell_elongation: f64,
    /// Share of the coat's roughness, as a square, that the cells' own bulges make, 0 to 1.
    pub cell_share: f64,
    /// Optical thickness of the wax bloom on the adaxial and the abaxial face, 0 to 10.
    pub bloom: [f64; 2],
    /// Its stomata.
    pub stomata: StomataPlan,
    /// The dust on it.
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
    pub fn displacement_alone(&self) -> Self {
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
    /// [`TissueError`] for the first field out of range, by name.
    pub fn validate(&self) -> Result<(), TissueError> {
        let share = |field, value| (field, value, 0.0..=1.0, "from 0 to 1");
        let fields = [
            ("impressed", self.impressed, -2.0..=2.0, "from -2 to 2"),
            ("raised", self.raised, -2.0..=2.0, "from -2 to 2"),
            ("bulge_mm", self.bulge_mm, 0.0..=5.0, "from 0 to 5"),
            (
                "bulge_width_mm",
                self.bulge_width_mm,
                0.05..=100.0,
                "from 0.05 to 100",
            ),
            share("vein_roughness", self.vein_roughness),
            share("dead_roughness", self.dead_roughness),
            share("maturity", self.maturity),
            (
                "young_roughness",
                self.young_roughness,
                0.2..=1.5,
                "from 0.2 to 1.5",
            ),
            (
                "cells_um",
                self.cells_um,
                0.0..=500.0,
                "0, or from 5 to 500",
            ),
            (
                "cell_elongation",
                self.cell_elongation,
                1.0..=30.0,
                "from 1 to 30",
            ),
            share("cell_share", self.cell_share),
            ("adaxial_bloom", self.bloom[0], 0.0..=10.0, "from 0 to 10"),
            ("abaxial_bloom", self.bloom[1], 0.0..=10.0, "from 0 to 10"),
        ];
        for (field, value, range, text) in fields {
            TissueError::unless(range.contains(&value), field, value, text)?;
        }
        let valid = self.cells_um == 0.0 || self.cells_um >= 5.0;
        TissueError::unless(valid, "cells_um", self.cells_um, "0, or from 5 to 500")?;
        self.stomata.validate()?;
        self.dust.validate()
    }
}
