//! Presets: leaf plans by name, each with the source of its numbers.
//!
//! A preset is a file, `leafmodel/species/NAME.toml`: what a list says of it, where its numbers are
//! from, and in the block `leaf` the keys of a plan ([`crate::plan_file`]). It may inherit from another
//! one (`base`), and do without some of what that has (`without`). Code has no table of species.
//!
//! - **In**: a name, as in `lamina grow poplar`.
//! - **Out**: a [`LeafPlan`] with every number in it, and what is known of it.
//! - **Always true**: a file is parsed when its preset is asked for, once.
//! - **Left out**: no number is hidden. A preset is a plan like any other, which can be written out
//!   and changed. What the keys of `leaf` mean belongs to [`crate::plan_file`], which makes the plan.
//!
//! ```
//! use leafmodel::species::{self, PRESETS};
//!
//! for preset in PRESETS {
//!     println!("{:24}{}", preset.name, preset.about());
//! }
//! let maple = species::find("maple").ok_or("the maple is a preset")?;
//! let plan = maple.plan();
//! // A plan is data: here is a smaller leaf of the same kind, and one that is folded.
//! let mut small = plan.clone();
//! small.length_mm *= 0.5;
//! let mut folded = plan.clone();
//! folded.form.fold = 30_f64.to_radians();
//! assert!(small != plan && folded != plan);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(test)]
mod claims;
pub mod diagnosis;
mod file;
#[cfg(test)]
pub(crate) mod grown_once;
mod individuals;
#[cfg(test)]
mod tests;
pub mod traits;

use std::sync::OnceLock;

pub(crate) use self::file::{BLOCKS, read};
use self::file::{Heading, PresetFile};
use self::traits::{Counts, Traits};
use crate::document::Opened;
use crate::leaf::LeafPlan;

/// A named leaf plan.
#[derive(Debug)]
pub struct Preset {
    /// Its name: lower-case words joined by `-`.
    pub name: &'static str,
    file: PresetFile,
    known: OnceLock<(Option<Traits>, Counts)>,
    /// Its plan, once it was asked for.
    pub(crate) plan: OnceLock<LeafPlan>,
}

impl Preset {
    const fn new(name: &'static str, text: &'static str) -> Self {
        Self {
            name,
            file: PresetFile::new(name, text),
            known: OnceLock::new(),
            plan: OnceLock::new(),
        }
    }

    /// What it shows, and what the caption of its figure claims.
    pub fn about(&self) -> &str {
        &self.heading().about
    }

    /// The source of its numbers, and how they depart from it.
    pub fn source(&self) -> &str {
        &self.heading().source
    }

    /// GGX roughness of the adaxial coat, if it is not the default.
    pub fn adaxial_roughness(&self) -> Option<f64> {
        self.heading().adaxial_roughness
    }

    /// Where the numbers of its species are from, if it stands for one.
    pub fn traits(&self) -> Option<&Traits> {
        self.known().0.as_ref()
    }

    /// Whether the leaf has another colour than summer's green.
    #[cfg(test)]
    pub(crate) fn is_coloured(&self) -> bool {
        self.traits().is_some_and(Traits::is_coloured)
    }

    /// What floras count on its species.
    pub(crate) fn counts(&self) -> &Counts {
        &self.known().1
    }

    /// Its file with all that it inherits.
    pub(crate) fn opened(&self) -> Opened {
        let bases = || BASES.iter().chain(PRESETS);
        let named = |name: &str| Some(&bases().find(|base| base.name == name)?.file);
        self.file.opened(&named)
    }

    fn heading(&self) -> &Heading {
        self.file.heading()
    }

    fn known(&self) -> &(Option<Traits>, Counts) {
        self.known.get_or_init(|| traits::read(self.opened()))
    }
}

/// The preset of this name, if there is one.
pub fn find(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

/// A list of the files of these names.
macro_rules! files {
    ($list:ident: $($name:literal)*) => {
        static $list: [Preset; [$($name),*].len()] =
            [$(Preset::new($name, include_str!(concat!("../species/", $name, ".toml")))),*];
    };
}

// What presets share and what is none itself.
files! { BASES: "bases/green-leaf" "bases/species-leaf" "bases/tree" }

/// All presets, in the order in which a list shows them: the figures of Runions et al. 2005 in their
/// order, extensions of that paper, trees and shrubs, leaves in other colours, splines, the examples
/// of Xia 2007, leaves that develop from their margin, extensions of Young 2010, compound leaves, then
/// the figures of Young 2010.
pub static PRESETS: &[Preset] = &LISTED;

/// Of all presets in this order. Whoever means to change a preset's numbers or adds one writes the hash that the failure of
/// `no_preset_has_drifted` shows.
#[cfg(test)]
const HASH: &str = "098acefb5458d2b4";

files! { LISTED:
    "runions-9a" "runions-9b" "runions-9c" "runions-9d" "runions-9e" "runions-9f" "runions-9g"
    "runions-9h" "runions-9i" "ginkgo" "alchemilla" "sweetgum" "toothed" "tertiary" "orchid"
    "reticulate" "cherry" "grass" "poplar" "poplar-urquhart" "poplar-fine" "poplar-x10"
    "developmental" "trillium"
    "brochidodromous" "free-endings" "cupped"
    "maple" "white-oak" "red-oak" "cottonwood" "aspen" "birch" "willow" "ivy" "magnolia" "croton"
    "ginkgo-leaf" "alchemilla-leaf" "sweetgum-leaf" "cherry-leaf" "orchid-leaf" "grass-blade"
    "trillium-petal" "trillium-bract" "trillium-sepal" "nasturtium"
    "ginkgo-autumn" "birch-autumn" "poplar-autumn" "sugar-maple-autumn" "red-maple-autumn"
    "sweetgum-autumn" "oak-litter" "cotinus" "acer-variegated" "ivy-variegated" "iron-chlorosis"
    "croton-variegated" "croton-tricolor" "amaranth"
    "arcuate-default" "pinnate" "pinnate-to-arcuate-1" "pinnate-to-arcuate-2"
    "pinnate-to-arcuate-3" "arcuate" "palmate-splines"
    "xia-1" "xia-2" "xia-3" "xia-4" "xia-5" "xia-5a" "xia-5b" "xia-5c" "xia-5d" "xia-5e" "xia-5f"
    "xia-autumn" "maple-transport"
    "maple-development" "white-oak-development" "red-oak-development" "cottonwood-development"
    "birch-development" "willow-development" "ivy-development" "magnolia-development" "linden"
    "hawthorn" "arabidopsis" "cardamine" "tomato" "horse-chestnut-development" "plantain"
    "maple-palmate" "begonia" "dogwood"
    "ash" "rose" "horse-chestnut" "mimosa" "clover"
    "young-3a" "young-3b" "young-3c" "young-3d" "young-4a" "young-4b" "young-4c" "young-4d"
    "young-5a" "young-5b" "young-5c" "young-5d" "young-6a" "young-6b" "young-6c" "young-6d"
    "young-7a" "young-7b" "young-7c" "young-7d" "young-8a" "young-8b" "young-8c" "young-8d"
    "young-9a" "young-9b" "young-9c" "young-9d"
}
