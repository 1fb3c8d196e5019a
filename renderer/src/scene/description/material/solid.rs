//! Solid tissue of uniform contents or of a map.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::optics::contents_keys::refuse_unknown_absorption;
use leafmodel::optics::{Contents, Pigments};
use leafmodel::solid::held_contents;

use super::sources::Sources;
use crate::material::solid::SolidMaterial;
use crate::scene::assets::AssetError;
use crate::scene::description::tissue::{Held, SolidOptics};
use crate::scene::tissue;

/// Solid tissue of uniform contents or a map (grown bodies bring their own maps).
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check_contents)]
pub struct PlainSolid {
    /// Its contents.
    #[key(with = Self::declare_held)]
    pub held: Held,
    /// What its constituents absorb.
    #[key("pigments", block, with = Pigments::declare)]
    pub pigments: Box<Pigments>,
    /// The optics of the tissue.
    #[key(flat)]
    pub optics: SolidOptics,
}

impl PlainSolid {
    fn declare_held(&mut self, keys: &mut Keys<'_>) {
        for kind in keys.one_of(&["contents", "map"], Some("contents")) {
            if kind == "contents" {
                let contents = Contents::NOTHING;
                self.held.declare_contents(contents, held_contents, keys);
            } else {
                self.held.declare_map(keys);
            }
        }
    }

    fn check_contents(&mut self, keys: &mut Keys<'_>) {
        if let Held::Contents { contents, .. } = &self.held {
            refuse_unknown_absorption(&self.pigments, contents, keys);
        }
    }

    pub(super) fn built(&self, sources: &mut Sources<'_>) -> Result<SolidMaterial, AssetError> {
        let palette = sources.palettes.of(&self.pigments);
        let table = sources.reflectances.of(self.optics.tissue.eta);
        let held = Sources::held(&self.held)?;
        Ok(tissue::solid(held, palette, &self.optics, table))
    }
}
