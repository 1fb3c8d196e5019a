//! Presets: leaf plans by name, each with the source of its numbers.
//!
//! - **In**: a name, as in `lamina grow poplar`.
//! - **Out**: a [`LeafPlan`] with every number in it.
//! - **Left out**: no number is hidden. A preset is a plan like any other, which can be written out
//!   and changed.
//!
//! ```
//! use leafmodel::species::{self, PRESETS};
//!
//! for preset in PRESETS {
//!     println!("{:24}{}", preset.name, preset.about);
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

mod architectures;
mod arcuate;
mod as_grown;
mod beyond;
#[cfg(test)]
mod claims;
pub mod colours;
mod compound_leaves;
mod contours;
mod developed;
pub mod diagnosis;
mod extended;
#[cfg(test)]
pub(crate) mod grown_once;
mod individuals;
pub mod leaf_traits;
mod list;
pub mod maple;
mod peltate;
mod runions;
mod specimens;
mod stances;
pub mod surfaces;
pub mod table_1;
mod trees;
mod trees_contours;
mod xia;
pub mod young;

use crate::blade::BladeForm;
use crate::blade::stance::Stance;
use crate::blade::tissue::Tissue;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::optics::Constituent::{
    Anthocyanins, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::optics::{Contents, Pigments, VeinFactors};
use crate::venation::plan::AuxinPlan;

use self::colours::ColouredLeaf;
pub use self::list::PRESETS;
use self::table_1::Row;
use self::young::Form;

/// A named leaf plan.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// Its name: lower-case words joined by `-`.
    pub name: &'static str,
    /// What it shows, and what the caption of its figure claims.
    pub about: &'static str,
    /// The source of its numbers, and how they depart from it.
    pub source: &'static str,
    /// The row of Table 1 of Runions et al. 2005 that it stands for, if any.
    pub row: Option<&'static Row>,
    /// Makes the plan.
    plan: PlanOf,
}

/// How a preset's plan is made.
#[derive(Clone, Copy, Debug)]
enum PlanOf {
    /// By a function of its own.
    Function(fn() -> LeafPlan),
    /// From the parameters of a figure.
    Form(&'static Form),
    /// From the table of a leaf that is not green.
    Coloured(&'static ColouredLeaf),
}

impl Preset {
    /// The whole plan of the leaf.
    pub fn plan(&self) -> LeafPlan {
        let mut plan = match self.plan {
            PlanOf::Function(plan) => plan(),
            PlanOf::Form(form) => form.plan(),
            PlanOf::Coloured(leaf) => leaf.plan(),
        };
        stances::apply(self.name, &mut plan);
        plan
    }
}

/// The preset of this name, if there is one.
pub fn find(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

/// A flat green leaf: contents of a mature broad leaf, veins paler than the blade. It serves leaves
/// without [`leaf_traits`] of a species; its numbers lie in the middle of the usual range
/// (`docs/src/theory/tissue.md`).
fn green_leaf(length_mm: f64, seed: u64, outline: OutlinePlan, venation: AuxinPlan) -> LeafPlan {
    let veinlet = venation.veinlet_radius_mm;
    LeafPlan {
        length_mm,
        seed,
        outline,
        venation: venation.into(),
        tissue: Tissue {
            lamina: Contents::of(&[
                (Structure, 1.5),
                (Chlorophyll, 38.0),
                (Carotenoids, 9.0),
                (Anthocyanins, 0.5),
                (Water, 0.01),
                (DryMatter, 0.005),
            ]),
            vein_factors: VeinFactors::default(),
            vein_body: None,
            full_vein_radius_mm: (4.0 * veinlet).clamp(0.001, 0.2),
            sheath_width_mm: (5.0 * veinlet).clamp(0.001, 0.15),
            mottle: 0.1,
            mottle_scale_mm: 1.5,
        },
        unevenness: None,
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        form: BladeForm {
            fold: 8.0_f64.to_radians(),
            curl: 20.0_f64.to_radians(),
            ruffle: 0.01,
            ruffle_waves: 2.5,
            pleat: 0.0,
            relief: 0.6,
            thickness_mm: 0.2,
            margin: crate::blade::MarginThickness::EVEN,
            closed: false,
            max_edge_mm: length_mm / 80.0,
            meshed_vein_radius_mm: 0.12,
        },
        stance: Stance::default(),
        surface: None,
        hairs: Vec::new(),
        petiole: None,
        compound: None,
        damage: None,
        pigments: Pigments::default(),
        map_size: 1600,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_found_by_its_name_and_can_be_carried_out() {
        for preset in PRESETS {
            let allowed = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-';
            assert!(preset.name.bytes().all(allowed), "{}", preset.name);
            let found = find(preset.name).expect("it is in the list");
            assert!(
                std::ptr::eq(found, preset),
                "{} is there twice",
                preset.name
            );
            let plan = preset.plan();
            assert_eq!(plan.tissue.validate(), Ok(()));
            plan.form.validate().expect("a good form");
            plan.check_senescence().expect("a good old age");
            plan.check_lamina().expect("a good outline and venation");
        }
        assert!(find("popplar").is_none());
    }
}
