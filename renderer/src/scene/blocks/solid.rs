//! `[solids.NAME]`: a body of solid tissue.

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::plan_file::{self, require_prospect, usual_solid};

use crate::scene::description::tissue::extrapolate;
use crate::scene::description::{Solid, SolidOptics};

impl Solid {
    /// A body with all defaults.
    pub(crate) fn usual() -> Self {
        Self {
            plan: usual_solid(),
            optics: SolidOptics::default(),
            extrapolate: false,
        }
    }
}

/// The keys of one of `[solids]`.
pub(crate) fn solid(solid: &mut Solid, keys: &mut Keys<'_>) {
    require_prospect(keys);
    solid.extrapolate = extrapolate(keys);
    solid.optics.declare(keys);
    plan_file::solid(&mut solid.plan, keys);
}
