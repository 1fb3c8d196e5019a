//! `[leaves.NAME]`: a grown leaf, and the keys for faces that leaves share with materials.

use leafmodel::blade::surface::SurfacePlan;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Number, Word};
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file::{self, require_prospect};
use leafmodel::species::{self, Preset};

use super::fluorescence::fluorescence;
use super::spectrum::SpectrumOf;
use crate::scene::description::{Coat, Leaf, LeafFaces, LeafOptics};

/// Why a leaf of layers does not fluoresce.
pub(super) const DARK_LAYERS: &str = "fluorescence is worked out for plates, not for layers";
/// Refractive index of a coat.
const COAT_ETA: f64 = 1.45;
/// GGX roughness of the adaxial and the abaxial coat: satin on the adaxial, matt on the abaxial
/// face.
const COAT_ALPHA: [f64; 2] = [0.3, 0.45];

/// Words for the ways in which light is scattered.
const OPTICS: [(&str, LeafOptics); 2] = [
    ("plates", LeafOptics::Plates),
    ("layers", LeafOptics::Layers),
];

/// Least GGX roughness of a coat.
const LEAST_ALPHA: f64 = 0.02;

impl Default for Leaf {
    fn default() -> Self {
        Self::from(plan_file::usual_leaf(100.0))
    }
}

impl From<LeafPlan> for Leaf {
    /// A leaf with the default surface.
    fn from(plan: LeafPlan) -> Self {
        Self {
            plan,
            faces: LeafFaces::usual(),
            fluorescence: None,
            light_spread: 1.0,
            extrapolate: false,
        }
    }
}

impl LeafFaces {
    /// Faces with all defaults.
    pub(crate) fn usual() -> Self {
        Self {
            optics: LeafOptics::Plates,
            abaxial_ratio: None,
            abaxial_reflectance: None,
            coats: COAT_ALPHA.map(|alpha| Coat {
                eta: COAT_ETA,
                alpha_across: alpha,
                alpha_along: alpha,
            }),
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
                *alpha = (*alpha * factor).clamp(LEAST_ALPHA, 1.0);
            }
        }
        faces
    }
}

impl Declared for Leaf {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        require_prospect(keys);
        if let Some(block) = keys.reader() {
            self.extrapolate = block.cx.extrapolate.get();
        }
        plan_file::leaf_preset(&mut self.plan, keys);
        let preset = keys.base().and_then(species::find);
        if let Some(alpha) = preset.and_then(Preset::adaxial_roughness) {
            let [adaxial, _] = &mut self.faces.coats;
            (adaxial.alpha_across, adaxial.alpha_along) = (alpha, alpha);
        }
        plan_file::leaf(&mut self.plan, keys);
        faces(&mut self.faces, keys);
        fluorescence(&mut self.fluorescence, keys);
        if self.plan.form.closed && self.fluorescence.is_some() {
            let problem =
                "a closed blade is cut in two, and its halves cannot fluoresce".to_owned();
            let help = "leave `fluorescence` out, or let the blade be open: `blade.closed = false`";
            keys.refuse(&["fluorescence"], problem, help);
        }
        if self.faces.optics == LeafOptics::Layers && self.fluorescence.is_some() {
            impossible(keys, DARK_LAYERS, "leave `fluorescence` out, or `optics`");
        }
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

/// Reports what a leaf of layers cannot be.
pub(super) fn impossible(keys: &Keys<'_>, problem: &str, help: &str) {
    let error = DocumentError::Impossible {
        key: "optics".to_owned(),
        problem: problem.to_owned(),
        help: help.to_owned(),
    };
    keys.report(&["optics"], error);
}

/// The keys of a leaf's faces.
pub(super) fn faces(faces: &mut LeafFaces, keys: &mut Keys<'_>) {
    keys.key(
        "optics",
        &mut faces.optics,
        Word(&OPTICS),
        "`plates`: light is scattered at the surface. `layers`, for close-ups: it is followed through \
         cuticle, epidermis and mesophyll, and may leave beside the place where it entered.",
    );
    if faces.optics == LeafOptics::Layers && keys.has("abaxial_ratio") {
        impossible(
            keys,
            "layers have two faces of their own",
            "leave `abaxial_ratio` out, or `optics`",
        );
    }
    keys.optional(
        "abaxial_ratio",
        &mut faces.abaxial_ratio,
        SpectrumOf::Ratio,
        "Abaxial over adaxial reflectance. Left out, it follows what the leaf absorbs: near 1 where \
         that is little, 1.7 where it is nearly all.",
    );
    let [adaxial, abaxial] = &mut faces.coats;
    let about = "Coat of the adaxial face.";
    keys.block("adaxial", about, |keys| coat(adaxial, keys));
    let about = "Coat of the abaxial face.";
    keys.block("abaxial", about, |keys| coat(abaxial, keys));
}

/// The keys of the coat of one face.
fn coat(coat: &mut Coat, keys: &mut Keys<'_>) {
    const ALPHA: Number = Number(Limits::closed(LEAST_ALPHA, 1.0));
    let limits = Number(Limits::closed(1.0, 2.5));
    keys.key(
        "eta",
        &mut coat.eta,
        limits,
        "Refractive index; 1.35 to 1.5 in leaves.",
    );
    keys.exclude("alpha", "alpha_across");
    keys.exclude("alpha", "alpha_along");
    let mut alpha = coat.alpha_across;
    keys.key(
        "alpha",
        &mut alpha,
        ALPHA,
        "GGX roughness in all directions. Glossy 0.1 to 0.2, satin 0.25 to 0.4, matt 0.45 to 0.6 \
            (our estimates; so are the defaults).",
    );
    if alpha != coat.alpha_across {
        (coat.alpha_across, coat.alpha_along) = (alpha, alpha);
    }
    let about = "GGX roughness across the midrib, in place of `alpha`.";
    keys.key("alpha_across", &mut coat.alpha_across, ALPHA, about);
    let about = "GGX roughness along the midrib, in place of `alpha`.";
    keys.key("alpha_along", &mut coat.alpha_along, ALPHA, about);
}
