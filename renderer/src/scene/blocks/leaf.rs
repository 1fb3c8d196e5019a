//! `[leaves.NAME]`: a grown leaf.

use leafmodel::blade::surface::SurfacePlan;
use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::Number;
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file::{self, require_prospect};
use leafmodel::species::{self, Preset};

use crate::scene::description::tissue::{ALPHA, extrapolate, impossible};
use crate::scene::description::{Fluorescence, Leaf, LeafFaces, LeafOptics};

impl From<LeafPlan> for Leaf {
    /// A leaf with the default surface.
    fn from(plan: LeafPlan) -> Self {
        Self {
            plan,
            faces: LeafFaces::default(),
            fluorescence: None,
            light_spread: 1.0,
            extrapolate: false,
        }
    }
}

impl Leaf {
    /// Its faces at its age: coats are as rough as the leaf is mature.
    pub(crate) fn faces_by_age(&self) -> LeafFaces {
        let mut faces = self.faces.clone();
        let surface = self.plan.surface.as_ref();
        let factor = surface.map_or(1.0, SurfacePlan::roughness_by_age);
        for coat in &mut faces.coats {
            for alpha in [&mut coat.alpha_across, &mut coat.alpha_along] {
                *alpha = (*alpha * factor).clamp(ALPHA[0], ALPHA[1]);
            }
        }
        faces
    }
}

/// The keys of one of `[leaves]`.
pub(super) fn leaf(leaf: &mut Leaf, keys: &mut Keys<'_>) {
    require_prospect(keys);
    leaf.extrapolate = extrapolate(keys);
    plan_file::leaf_preset(&mut leaf.plan, keys);
    let preset = keys.base().and_then(species::find);
    if let Some(alpha) = preset.and_then(Preset::adaxial_roughness) {
        let [adaxial, _] = &mut leaf.faces.coats;
        (adaxial.alpha_across, adaxial.alpha_along) = (alpha, alpha);
    }
    plan_file::leaf(&mut leaf.plan, keys);
    leaf.faces.declare(keys);
    Fluorescence::declare_of(&mut leaf.fluorescence, keys);
    if leaf.plan.form.closed && leaf.fluorescence.is_some() {
        let problem = "a closed blade is cut in two, and its halves cannot fluoresce".to_owned();
        let help = "leave `fluorescence` out, or let the blade be open: `blade.closed = false`";
        keys.refuse(&["fluorescence"], problem, help);
    }
    leaf.faces.refuse_light_of(leaf.fluorescence, keys);
    if leaf.faces.optics == LeafOptics::Layers && leaf.plan.form.closed {
        impossible(
            keys,
            "a closed blade is two sheets, and light is followed through one",
            "leave the key of the closed blade out, or `optics`",
        );
    }
    keys.key(
        "light_spread",
        &mut leaf.light_spread,
        Number(Limits::closed(0.0, 10.0)),
        "Factor on the distance over which light that the blade lets through spreads sideways; \
         with 1 that follows from thickness, scattering and absorption, with 0 veins stay sharp.",
    );
}
