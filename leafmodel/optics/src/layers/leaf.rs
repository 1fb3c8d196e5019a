//! A leaf as five layers, from its contents.

use super::anatomy::{Anatomy, AnatomyError, Tissue};
use super::ordinates::{Fluxes, Ordinates, Resolution};
use super::phase::{Phase, mean_cosine_of_ball, wall};
use super::stack::{Face, Incidence, Layer, Stack, StackError};
use crate::constituent::Constituent;
use crate::contents::Contents;
use crate::prospect_d::{Coefficients, ProspectD};

/// A leaf with less water than this, g per g of dry matter, has empty cells.
pub const DRY_BELOW: f64 = 0.5;
/// Nothing passes so much; more would not be finite in the end.
const DEEPEST: f64 = 1e6;
/// Where the amount of scattering is found, nm: leaves absorb least there.
const SCATTERING_NM: f64 = 800.0;
/// The most scattering that a structure can ask for, in surfaces of the anatomy.
const MOST_SCATTERING: f64 = 1e3;

/// Whether a leaf's cells hold water.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Full: their surfaces refract light on its way between them and air.
    Full,
    /// Empty, as those of dead tissue: light meets thin walls in air.
    Empty,
}

/// What says how much a leaf scatters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scattering {
    /// The structure `N`: as much as makes the leaf reflect what PROSPECT-D's pile of `N` plates
    /// does, both without absorption, at 800 nm. The anatomy says in which layers.
    OfStructure,
    /// The surfaces of the anatomy's cells alone.
    OfCells,
}

/// A leaf as layers. Its face [`Face::First`] is the adaxial one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayeredLeaf {
    contents: Contents,
    anatomy: Anatomy,
    cells: Cells,
    /// How many times as many cells it has as its anatomy says.
    amount: f64,
    /// How many times as much it scatters as its anatomy says.
    scattering: f64,
}

/// What both faces of a leaf do.
#[derive(Clone, Debug, PartialEq)]
pub struct Faces {
    /// Lit along the normal, adaxial face first.
    pub normal: [Fluxes; 2],
    /// Lit evenly from the hemisphere, adaxial face first. Both transmittances are one.
    pub diffuse: [Fluxes; 2],
}

/// A slice of a leaf, parallel to its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slice {
    /// Which layer it belongs to.
    pub tissue: Tissue,
    /// Distance of its middle from the adaxial face, µm.
    pub depth_um: f64,
    /// Its thickness, µm.
    pub thickness_um: f64,
    /// Share of the light that falls on the leaf that it absorbs.
    pub absorbed: f64,
}

impl LayeredLeaf {
    /// A bifacial leaf of these contents (which [`Contents::checked`] has found good).
    pub fn new(contents: &Contents) -> Self {
        Self::of_anatomy(contents, Anatomy::BIFACIAL, Scattering::OfStructure)
    }

    /// A leaf of these contents with cells of its own.
    ///
    /// # Errors
    ///
    /// [`AnatomyError`] for the first number of the anatomy out of range.
    pub fn with_anatomy(
        contents: &Contents,
        anatomy: Anatomy,
        scattering: Scattering,
    ) -> Result<Self, AnatomyError> {
        Ok(Self::of_anatomy(contents, anatomy.checked()?, scattering))
    }

    fn of_anatomy(contents: &Contents, anatomy: Anatomy, scattering: Scattering) -> Self {
        let (water, dry) = (contents[Constituent::Water], contents.all_dry_matter());
        // A gram of water is a cubic centimetre.
        let cells = if water < DRY_BELOW * dry {
            Cells::Empty
        } else {
            Cells::Full
        };
        let amount = match cells {
            Cells::Full => water / anatomy.water_cm(),
            Cells::Empty => dry / anatomy.dry_matter_g_per_cm2(),
        };
        let amount = amount.min(DEEPEST);
        let mut leaf = Self {
            contents: *contents,
            anatomy,
            cells,
            amount,
            scattering: amount,
        };
        match scattering {
            Scattering::OfStructure => leaf.scattering = leaf.scattering_of_structure(),
            Scattering::OfCells => {}
        }
        leaf
    }

    /// How much scattering makes the leaf reflect what PROSPECT-D's pile does, without absorption.
    fn scattering_of_structure(&self) -> f64 {
        let at = ProspectD::coefficients_extrapolated(SCATTERING_NM);
        let structure = self.contents[Constituent::Structure];
        let clear = Contents::NOTHING.with(&[(Constituent::Structure, structure)]);
        let wanted = at.reflectance_transmittance(&clear).reflectance;
        let reflected = |scattering: f64| {
            let leaf = Self {
                contents: clear,
                scattering,
                ..*self
            };
            let [adaxial, _] = leaf.faces(&at, Resolution::FAST).normal;
            adaxial.reflected
        };
        let off = |logarithm: f64| reflected(libm::exp(logarithm)) - wanted;
        // Reflectance rises with scattering, from that of clear faces towards 1.
        let most = libm::log(MOST_SCATTERING);
        let (mut low, mut high) = ((-most, off(-most)), (most, off(most)));
        if low.1 >= 0.0 {
            return 1.0 / MOST_SCATTERING;
        }
        if high.1 <= 0.0 {
            return MOST_SCATTERING;
        }
        // The rule of false position: an end that stays twice counts half (Illinois).
        let mut middle = 0.0;
        let mut was_low = None;
        for _ in 0..60 {
            let value = off(middle);
            if value.abs() < 1e-9 {
                break;
            }
            let is_low = value < 0.0;
            let again = was_low == Some(is_low);
            let (moved, stays) = if is_low {
                (&mut low, &mut high)
            } else {
                (&mut high, &mut low)
            };
            *moved = (middle, value);
            if again {
                stays.1 *= 0.5;
            }
            was_low = Some(is_low);
            middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        }
        libm::exp(middle)
    }

    /// Whether its cells are full.
    pub fn cells(&self) -> Cells {
        self.cells
    }

    /// How many times as much it scatters as the surfaces of its cells say.
    #[cfg(test)]
    pub(crate) fn scattering_over_cells(&self) -> f64 {
        self.scattering / self.amount
    }

    /// Thickness of the leaf, µm; that of a dead one is what it was.
    pub fn thickness_um(&self) -> f64 {
        self.amount * self.anatomy.thickness_um.iter().sum::<f64>()
    }

    /// The layers at a wavelength, from the adaxial face on.
    ///
    /// Water, walls and cuticle have one index, PROSPECT-D's. That of tissue with air is the mean
    /// by volume, as Gladstone and Dale's law has it.
    pub fn stack(&self, at: &Coefficients) -> Stack {
        let index = at.interface.refractive_index;
        // What meets light, how much of what meets it is turned, and how far.
        let (turned, g) = match self.cells {
            Cells::Full => (1.0, mean_cosine_of_ball(index)),
            Cells::Empty => wall(index),
        };
        let met = |tissue| match self.cells {
            Cells::Full => self.anatomy.full_cells(tissue),
            Cells::Empty => self.anatomy.empty_walls(tissue),
        };
        let phase = Phase::HenyeyGreenstein { g };
        let layer = |tissue| {
            let absorption: f64 = Constituent::ABSORBING
                .into_iter()
                .map(|constituent| {
                    let share = self.anatomy.share(constituent, tissue);
                    share * self.contents[constituent] * at.absorption[constituent]
                })
                .sum();
            let solid = match (self.cells, tissue) {
                (_, Tissue::Cuticle) => 1.0,
                (Cells::Full, _) => self.anatomy.filled(tissue),
                (Cells::Empty, _) => self.anatomy.filled(tissue) * self.anatomy.wall_share,
            };
            let scattering = (self.scattering * turned * met(tissue)).min(DEEPEST);
            let absorption = absorption.min(DEEPEST);
            Layer::of_depths(1.0 + (index - 1.0) * solid, scattering, absorption, phase)
        };
        Stack::new(Tissue::ALL.map(layer).to_vec())
            .expect("contents, table and anatomy were found good")
    }

    /// How light that falls on one face is absorbed with depth at a wavelength: each layer in this
    /// many slices of equal thickness, at least one, from the adaxial face on.
    ///
    /// # Errors
    ///
    /// [`StackError`] for no slices, or a direction out of range.
    pub fn profile(
        &self,
        at: &Coefficients,
        face: Face,
        incidence: Incidence,
        slices: usize,
    ) -> Result<Vec<Slice>, StackError> {
        let whole = self.stack(at);
        let sliced = whole.layers().iter().flat_map(|layer| {
            let slice = Layer {
                depth: layer.depth / slices as f64,
                ..*layer
            };
            std::iter::repeat_n(slice, slices)
        });
        let stack = Stack::new(sliced.collect())?;
        let cosines: Vec<f64> = match incidence {
            Incidence::Directional { cosine } => vec![cosine],
            Incidence::Lambertian => vec![],
        };
        let solved = Ordinates::new(&stack, Resolution::FAST, &cosines)?;
        let absorbed = solved.fluxes(face, &[incidence])?.swap_remove(0).absorbed;
        let mut above_um = 0.0;
        let places = Tissue::ALL
            .into_iter()
            .flat_map(|tissue| std::iter::repeat_n(tissue, slices));
        Ok(places
            .zip(absorbed)
            .map(|(tissue, absorbed)| {
                let thickness_um = self.amount * self.anatomy.thickness_um(tissue) / slices as f64;
                let depth_um = above_um + 0.5 * thickness_um;
                above_um += thickness_um;
                Slice {
                    tissue,
                    depth_um,
                    thickness_um,
                    absorbed,
                }
            })
            .collect())
    }

    /// What both faces do at a wavelength.
    pub fn faces(&self, at: &Coefficients, resolution: Resolution) -> Faces {
        let incidences = [Incidence::NORMAL, Incidence::Lambertian];
        let solved = Ordinates::new(&self.stack(at), resolution, &[1.0]).and_then(|solved| {
            let of = |face| solved.fluxes(face, &incidences);
            Ok([of(Face::First)?, of(Face::Last)?])
        });
        let mut faces = solved.expect("the normal is a direction, and solved for");
        let diffuse = faces.each_mut().map(|of_face| of_face.swap_remove(1));
        Faces {
            normal: faces.map(|mut of_face| of_face.swap_remove(0)),
            diffuse,
        }
    }
}

#[cfg(test)]
mod tests;
