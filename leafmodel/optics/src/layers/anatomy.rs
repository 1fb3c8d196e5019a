//! The cells of a leaf, layer by layer, and what every number of them rests on.

use thiserror::Error;

use crate::constituent::Constituent;
use crate::pigments::{Basis, Figure};

/// Density of cutin and wax.
const CUTICLE_G_PER_CM3: f64 = 1.1;

/// A layer of a leaf, from its adaxial face to its abaxial one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tissue {
    /// The adaxial cuticle.
    Cuticle,
    /// The adaxial epidermis.
    UpperEpidermis,
    /// Columns of cells that stand on the blade.
    Palisade,
    /// Rounded cells with air between them.
    Spongy,
    /// The abaxial epidermis.
    LowerEpidermis,
}

impl Tissue {
    /// All of them, in their order.
    pub const ALL: [Self; 5] = [
        Self::Cuticle,
        Self::UpperEpidermis,
        Self::Palisade,
        Self::Spongy,
        Self::LowerEpidermis,
    ];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cuticle => "cuticle",
            Self::UpperEpidermis => "upper_epidermis",
            Self::Palisade => "palisade",
            Self::Spongy => "spongy",
            Self::LowerEpidermis => "lower_epidermis",
        }
    }
}

/// Sizes of cells and what is between them, in a leaf whose cells hold as much water as they can.
///
/// Lengths are µm, shares in [0, 1). A leaf with more water has more cells of the same size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anatomy {
    /// Thickness of each of [`Tissue::ALL`], µm.
    pub thickness_um: [f64; 5],
    /// Share of air in the palisade.
    pub palisade_air: f64,
    /// Share of air in the spongy mesophyll.
    pub spongy_air: f64,
    /// Length of a palisade cell across the blade, µm.
    pub palisade_length_um: f64,
    /// Width of a palisade cell, µm.
    pub palisade_width_um: f64,
    /// Diameter of a spongy cell, µm.
    pub spongy_diameter_um: f64,
    /// Width of an epidermal cell, µm.
    pub epidermis_width_um: f64,
    /// Share of chlorophyll and carotenoids that is in the palisade; the spongy mesophyll has the
    /// rest.
    pub palisade_pigment: f64,
    /// Share of cell walls in the volume of a cell.
    pub wall_share: f64,
}

/// A number of an anatomy that is out of range.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{field} is {value}, it must be {range}")]
pub struct AnatomyError {
    /// Which number.
    pub field: &'static str,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Anatomy {
    /// A thin bifacial leaf of a broad-leaved plant; [`Anatomy::figures`] says what it rests on.
    pub const BIFACIAL: Self = Self {
        thickness_um: [2.0, 18.0, 70.0, 90.0, 15.0],
        palisade_air: 0.2,
        spongy_air: 0.5,
        palisade_length_um: 45.0,
        palisade_width_um: 15.0,
        spongy_diameter_um: 25.0,
        epidermis_width_um: 30.0,
        palisade_pigment: 0.52,
        wall_share: 0.1,
    };

    /// The anatomy itself if every number is in range.
    ///
    /// # Errors
    ///
    /// [`AnatomyError`] for the first number out of range.
    pub fn checked(self) -> Result<Self, AnatomyError> {
        const LENGTH: &str = "finite and above 0";
        const SHARE: &str = "at least 0 and below 1";
        let [cuticle, upper, palisade, spongy, lower] = self.thickness_um;
        let lengths = [
            ("the cuticle's thickness", cuticle),
            ("the upper epidermis' thickness", upper),
            ("the palisade's thickness", palisade),
            ("the spongy mesophyll's thickness", spongy),
            ("the lower epidermis' thickness", lower),
            ("the palisade cells' length", self.palisade_length_um),
            ("the palisade cells' width", self.palisade_width_um),
            ("the spongy cells' diameter", self.spongy_diameter_um),
            ("the epidermal cells' width", self.epidermis_width_um),
        ];
        let shares = [
            ("the palisade's share of air", self.palisade_air),
            ("the spongy mesophyll's share of air", self.spongy_air),
            ("the palisade's share of pigment", self.palisade_pigment),
            ("the share of cell walls", self.wall_share),
        ];
        let lengths = lengths.map(|(field, value)| {
            let good = value > 0.0 && value.is_finite();
            (field, value, good, LENGTH)
        });
        let shares = shares.map(|(field, value)| {
            let good = (0.0..1.0).contains(&value);
            (field, value, good, SHARE)
        });
        for (field, value, good, range) in lengths.into_iter().chain(shares) {
            if !good {
                return Err(AnatomyError {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(self)
    }

    /// Share of the volume that cells fill.
    pub(super) fn filled(&self, tissue: Tissue) -> f64 {
        match tissue {
            Tissue::Cuticle | Tissue::UpperEpidermis | Tissue::LowerEpidermis => 1.0,
            Tissue::Palisade => 1.0 - self.palisade_air,
            Tissue::Spongy => 1.0 - self.spongy_air,
        }
    }

    /// Thickness of a layer, µm.
    pub fn thickness_um(&self, tissue: Tissue) -> f64 {
        self.thickness_um[tissue as usize]
    }

    /// Volume of cells per area of the leaf, µm. The cuticle has none.
    fn cells_um(&self, tissue: Tissue) -> f64 {
        match tissue {
            Tissue::Cuticle => 0.0,
            Tissue::UpperEpidermis | Tissue::Palisade | Tissue::Spongy | Tissue::LowerEpidermis => {
                self.thickness_um(tissue) * self.filled(tissue)
            }
        }
    }

    fn all_cells_um(&self) -> f64 {
        Tissue::ALL.map(|tissue| self.cells_um(tissue)).iter().sum()
    }

    /// Water of a leaf with this anatomy whose cells are full, cm.
    pub fn water_cm(&self) -> f64 {
        1e-4 * self.all_cells_um()
    }

    /// Dry matter of a layer per area of the leaf, g/cm²: in cells to their water as the medians of
    /// ANGERS are.
    fn dry_matter_of(&self, tissue: Tissue) -> f64 {
        const PER_WATER: f64 = 0.0044 / 0.0103;
        1e-4 * match tissue {
            Tissue::Cuticle => CUTICLE_G_PER_CM3 * self.thickness_um(tissue),
            Tissue::UpperEpidermis | Tissue::Palisade | Tissue::Spongy | Tissue::LowerEpidermis => {
                PER_WATER * self.cells_um(tissue)
            }
        }
    }

    /// Dry matter of a leaf with this anatomy, g/cm².
    pub fn dry_matter_g_per_cm2(&self) -> f64 {
        Tissue::ALL
            .map(|tissue| self.dry_matter_of(tissue))
            .iter()
            .sum()
    }

    /// Share of a constituent that is in a layer; over all layers they add up to 1.
    pub fn share(&self, constituent: Constituent, tissue: Tissue) -> f64 {
        match constituent {
            Constituent::Chlorophyll | Constituent::Carotenoids => match tissue {
                Tissue::Palisade => self.palisade_pigment,
                Tissue::Spongy => 1.0 - self.palisade_pigment,
                Tissue::Cuticle | Tissue::UpperEpidermis | Tissue::LowerEpidermis => 0.0,
            },
            Constituent::Anthocyanins | Constituent::Betacyanins | Constituent::Betaxanthins => {
                f64::from(u8::from(tissue == Tissue::Palisade))
            }
            Constituent::Brown
            | Constituent::Water
            | Constituent::Structure
            | Constituent::Extra => self.cells_um(tissue) / self.all_cells_um(),
            Constituent::DryMatter | Constituent::Proteins | Constituent::CarbonBased => {
                self.dry_matter_of(tissue) / self.dry_matter_g_per_cm2()
            }
        }
    }

    /// Optical depth of scattering by full cells.
    ///
    /// Convex bodies of surface `S` meet light over `S/4` on average, so a layer of balls of
    /// diameter `d` that fill a share `φ` of the thickness `h` has `1.5 φ h / d`. The sides of
    /// palisade cells stand on the blade: light that they reflect or refract keeps its angle to the
    /// normal, so that only the ends count, `φ` for each row of cells. Cells of the epidermis touch
    /// each other, and nothing scatters there.
    pub(super) fn full_cells(&self, tissue: Tissue) -> f64 {
        let thickness = self.thickness_um(tissue) * self.filled(tissue);
        match tissue {
            Tissue::Cuticle | Tissue::UpperEpidermis | Tissue::LowerEpidermis => 0.0,
            Tissue::Palisade => thickness / self.palisade_length_um,
            Tissue::Spongy => 1.5 * thickness / self.spongy_diameter_um,
        }
    }

    /// How many walls of empty cells light meets on its way along the normal: half of the walls'
    /// area, as they are crumpled and lie in any direction. A wall between two cells of the
    /// epidermis belongs to both.
    pub(super) fn empty_walls(&self, tissue: Tissue) -> f64 {
        let thickness = self.thickness_um(tissue) * self.filled(tissue);
        let area = match tissue {
            Tissue::Cuticle => 0.0,
            Tissue::UpperEpidermis | Tissue::LowerEpidermis => {
                2.0 + 2.0 * thickness / self.epidermis_width_um
            }
            Tissue::Palisade => {
                thickness * (4.0 / self.palisade_width_um + 2.0 / self.palisade_length_um)
            }
            Tissue::Spongy => 6.0 * thickness / self.spongy_diameter_um,
        };
        0.5 * area
    }

    /// Every number of [`Anatomy::BIFACIAL`] and of the model around it, with its source.
    pub fn figures() -> Vec<Figure> {
        use Basis::{Assumed, Unverified};
        const SECTIONS: &str =
            "cross-sections of thin bifacial leaves in textbooks of plant anatomy, from memory";
        const POROSITY: &str = "0.1 to 0.3 of the palisade, 0.4 to 0.6 below it, from memory";
        const RAN: &str = "Ran et al. 2025 (MADLM), from notes on it";
        const LEE: &str = "nine red-senescing species, Lee et al. 2003, abstract; betalains alike";
        const OWN: &str = "this project";
        let it = Self::BIFACIAL;
        let [palisade_length, palisade_width] = [it.palisade_length_um, it.palisade_width_um];
        let numbers = [
            ("air, palisade", it.palisade_air, "", Unverified, POROSITY),
            ("air, spongy", it.spongy_air, "", Unverified, POROSITY),
            (
                "palisade cells, length",
                palisade_length,
                "µm",
                Unverified,
                SECTIONS,
            ),
            (
                "palisade cells, width",
                palisade_width,
                "µm",
                Unverified,
                SECTIONS,
            ),
            (
                "spongy cells, diameter",
                it.spongy_diameter_um,
                "µm",
                Unverified,
                SECTIONS,
            ),
            (
                "epidermal cells, width",
                it.epidermis_width_um,
                "µm",
                Unverified,
                SECTIONS,
            ),
            (
                "chlorophyll, carotenoids: palisade's share",
                it.palisade_pigment,
                "",
                Unverified,
                RAN,
            ),
            (
                "anthocyanins, betalains: palisade's share",
                1.0,
                "",
                Assumed,
                LEE,
            ),
            (
                "cutin and wax, density",
                CUTICLE_G_PER_CM3,
                "g/cm³",
                Unverified,
                "from memory",
            ),
            (
                "walls in the volume of cells",
                it.wall_share,
                "",
                Assumed,
                OWN,
            ),
        ];
        let thickness = Tissue::ALL.map(|tissue| {
            let of = format!("thickness, {}", tissue.name());
            (of, it.thickness_um(tissue), "µm", Unverified, SECTIONS)
        });
        let numbers = numbers
            .map(|(of, value, unit, basis, source)| (of.to_owned(), value, unit, basis, source));
        let all = thickness.into_iter().chain(numbers);
        all.map(|(of, value, unit, basis, source)| Figure {
            of,
            value,
            unit,
            basis,
            source,
        })
        .collect()
    }
}
