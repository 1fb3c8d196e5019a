//! `[solids.NAME]`: a body of solid tissue, and the optics that it shares with
//! `[materials.NAME.solid]`.

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::Number;
use leafmodel::optics::solid::{ETA, SCATTERING_PER_MM, Solid as Tissue};
use leafmodel::plan_file::require_prospect;
use leafmodel::solid::SolidPlan;

use crate::scene::description::{Coat, Solid, SolidOptics};

/// Default of the depth over which contents are spread, mm.
const DEPTH_MM: f64 = 1.0;
/// Default of the GGX roughness of the skin.
const COAT_ALPHA: f64 = 0.3;

impl SolidOptics {
    /// Optics with all defaults.
    pub(crate) fn usual() -> Self {
        Self {
            tissue: Tissue {
                depth_mm: DEPTH_MM,
                scattering_per_mm: SCATTERING_PER_MM,
                eta: ETA,
            },
            coat: Coat {
                eta: ETA,
                alpha_across: COAT_ALPHA,
                alpha_along: COAT_ALPHA,
            },
        }
    }
}

impl Solid {
    /// A body with all defaults.
    pub(crate) fn usual() -> Self {
        Self {
            plan: SolidPlan::default(),
            optics: SolidOptics::usual(),
            extrapolate: false,
        }
    }
}

/// The keys of one of `[solids]`.
pub(crate) fn solid(solid: &mut Solid, keys: &mut Keys<'_>) {
    require_prospect(keys);
    if let Some(block) = keys.reader() {
        solid.extrapolate = block.cx.extrapolate.get();
    }
    optics(&mut solid.optics, keys);
    solid.plan.declare(keys);
}

/// The keys of the optics of solid tissue.
pub(super) fn optics(optics: &mut SolidOptics, keys: &mut Keys<'_>) {
    let SolidOptics { tissue, coat } = optics;
    let limits = Number(Limits::closed(0.001, 1000.0));
    let about = "Depth over which the contents are spread.";
    keys.key("depth_mm", &mut tissue.depth_mm, limits, about);
    let about = "µs′: reduced scattering.";
    keys.key(
        "scattering_per_mm",
        &mut tissue.scattering_per_mm,
        limits,
        about,
    );
    // By default the skin has the refractive index of the tissue.
    let same = coat.eta == tissue.eta;
    let index = Number(Limits::closed(1.0, 2.0));
    keys.key(
        "eta",
        &mut tissue.eta,
        index,
        "Refractive index of the tissue.",
    );
    if same {
        coat.eta = tissue.eta;
    }
    keys.block("coat", "The surface of its skin.", |keys| {
        let limits = Number(Limits::closed(1.0, 2.5));
        let about = "Refractive index; left out, that of the tissue.";
        keys.key("eta", &mut coat.eta, limits, about);
        let limits = Number(Limits::closed(0.02, 1.0));
        keys.key("alpha", &mut coat.alpha_across, limits, "GGX roughness.");
        coat.alpha_along = coat.alpha_across;
    });
}
