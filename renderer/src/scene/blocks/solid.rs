//! `[solids.NAME]`: a body of solid tissue.

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::plan_file::{self, require_prospect};

use crate::scene::description::Solid;
use crate::scene::description::tissue::extrapolate;

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
