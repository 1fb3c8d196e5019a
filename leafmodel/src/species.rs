//! Leaves to start from, by name.
//!
//! A preset is a whole [`LeafPlan`]; its `source` says which of its numbers were measured or published and which
//! were judged by eye.

use crate::blade::BladeForm;
use crate::blade::tissue::Tissue;
use crate::leaf::LeafPlan;
use crate::optics::Contents;
use crate::shape::growth_shape::{GrowthShape, VeinRow};
use crate::shape::outline_plan::Contour;
use crate::venation::plan::VenationPlan;

/// A leaf with a name.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// What it is called on the command line: letters, digits and `-`.
    pub name: &'static str,
    /// What it shows, in a line.
    pub about: &'static str,
    /// Where its numbers come from.
    pub source: &'static str,
    /// Makes its plan.
    pub plan: fn() -> LeafPlan,
}

impl Preset {
    /// The plan of the leaf.
    pub fn plan(&self) -> LeafPlan {
        (self.plan)()
    }
}

/// All presets, in the order in which they are listed.
pub static PRESETS: &[Preset] = &[Preset {
    name: "poplar",
    about: "broad leaf with a closed net of veins on isogonic growth",
    source: "veins: Runions et al. 2005, Table 1, poplar at ten units to a segment; outline, contents and blade by eye",
    plan: poplar,
}];

/// The preset of that name.
pub fn find(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

fn poplar() -> LeafPlan {
    let vein = |position, slope| VeinRow { position, slope };
    let outline = GrowthShape {
        rows: 200,
        axial_rate: 0.1,
        rate_ratio: 1.22,
        widest_at: 0.32,
        falloff: 3.0,
        lobe_decay: 0.0,
        lobe_exponent: 2.0,
        veins: vec![vein(0.1, -0.35), vein(0.9, 0.45)],
    };
    LeafPlan {
        length_mm: 80.0,
        seed: 7,
        outline: Contour::GrowthAlgorithm(outline).into(),
        venation: VenationPlan::default(),
        tissue: Tissue {
            lamina: Contents::from_array([1.5, 38.0, 9.0, 0.5, 0.0, 0.01, 0.005]),
            vein_factors: Contents::from_array([1.5, 0.1, 0.12, 1.0, 1.0, 2.0, 3.0]),
            full_vein_radius_mm: 0.06,
            sheath_width_mm: 0.1,
            mottle: 0.1,
            mottle_scale_mm: 1.5,
        },
        form: BladeForm {
            fold: 12.0_f64.to_radians(),
            curl: 25.0_f64.to_radians(),
            ruffle: 0.012,
            ruffle_waves: 2.5,
            relief: 0.6,
            thickness_mm: 0.2,
            max_edge_mm: 1.0,
            meshed_vein_radius_mm: 0.12,
        },
        map_size: 1024,
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
            let outline = plan.outline.grow(plan.length_mm).expect("a good outline");
            crate::venation::check(&outline, &plan.venation).expect("a good plan");
        }
        assert!(find("popplar").is_none());
    }
}
