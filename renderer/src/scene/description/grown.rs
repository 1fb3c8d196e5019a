//! `[leaves.NAME]` and `[solids.NAME]`: what is grown.

use leafmodel::blade::surface::SurfacePlan;
use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::Number;
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file::{self, require_prospect};
use leafmodel::solid::SolidPlan;
use leafmodel::species::{self, Preset};

use super::tissue::{
    ALPHA, Fluorescence, LeafFaces, LeafOptics, SolidOptics, extrapolate, impossible,
};

/// A grown leaf: mesh, content maps and coats.
#[derive(Clone, Debug)]
pub struct Leaf {
    /// The plan from which it is grown.
    pub plan: LeafPlan,
    /// The properties of its faces.
    pub faces: LeafFaces,
    /// How its chlorophyll fluoresces; `None` if it does not.
    pub fluorescence: Option<Fluorescence>,
    /// Factor on the distance over which light that the blade lets through spreads sideways, ≥ 0.
    pub light_spread: f64,
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub extrapolate: bool,
}

/// A grown body of solid tissue: mesh and map of contents.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// The plan from which it is grown.
    pub plan: SolidPlan,
    /// The optics of the tissue.
    pub optics: SolidOptics,
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub extrapolate: bool,
}

impl Default for Leaf {
    fn default() -> Self {
        Self::from(LeafPlan::of_length(100.0))
    }
}

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

impl Declared for Leaf {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        require_prospect(keys);
        self.extrapolate = extrapolate(keys);
        plan_file::leaf_preset(&mut self.plan, keys);
        let preset = keys.base().and_then(species::find);
        if let Some(alpha) = preset.and_then(Preset::adaxial_roughness) {
            let [adaxial, _] = &mut self.faces.coats;
            (adaxial.alpha_across, adaxial.alpha_along) = (alpha, alpha);
        }
        plan_file::leaf(&mut self.plan, keys);
        self.faces.declare(keys);
        Fluorescence::declare_of(&mut self.fluorescence, keys);
        if self.plan.form.closed && self.fluorescence.is_some() {
            let problem =
                "a closed blade is cut in two, and its halves cannot fluoresce".to_owned();
            let help = "leave `fluorescence` out, or let the blade be open: `blade.closed = false`";
            keys.refuse(&["fluorescence"], problem, help);
        }
        self.faces.refuse_light_of(self.fluorescence, keys);
        if self.faces.optics == LeafOptics::Layers && self.plan.form.closed {
            impossible(
                keys,
                "a closed blade is two sheets, and light is followed through one",
                "leave the key of the closed blade out, or `optics`",
            );
        }
        keys.key(
            "light_spread",
            &mut self.light_spread,
            Number(Limits::closed(0.0, 10.0)),
            "Factor on the distance over which light that the blade lets through spreads sideways; \
             with 1 that follows from thickness, scattering and absorption, with 0 veins stay sharp.",
        );
    }
}

impl Declared for Solid {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        require_prospect(keys);
        self.extrapolate = extrapolate(keys);
        self.optics.declare(keys);
        self.plan.declare(keys);
    }
}

impl Solid {
    /// As a block `[solids.NAME]` of a file, which has what differs from the defaults.
    pub(in crate::scene) fn to_toml(&self, name: &str) -> String {
        let (mut own, mut usual) = (self.clone(), Self::default());
        plan_file::solid_to_toml(name, &mut own, &mut usual, Self::declare)
    }
}
