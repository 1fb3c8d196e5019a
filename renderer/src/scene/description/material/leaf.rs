//! A leaf of uniform contents, of a map, or of measured spectra.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::optics::contents_keys::refuse_unknown_absorption;
use leafmodel::optics::{Contents, Pigments};
use leafmodel::plan_file::{self, require_prospect};

use super::measured::Measured;
use super::sources::Sources;
use crate::material;
use crate::material::leaf::LeafMaterial;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::assets::AssetError;
use crate::scene::description::tissue::{
    Fluorescence, Held, LeafFaces, LeafOptics, extrapolate, impossible,
};
use crate::scene::tissue;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A leaf of uniform contents or measured spectra (grown leaves bring their own maps).
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::refuse_layers)]
pub struct PlainLeaf {
    /// Its tissue, which determines R and T.
    #[key(with = Self::declare_tissue)]
    pub tissue: LeafTissue,
    /// What its constituents absorb.
    #[key("pigments", block, with = Pigments::declare)]
    pub pigments: Box<Pigments>,
    /// The properties of its faces.
    #[key(flat)]
    #[key(with = Self::refuse_ratio_of_measured)]
    pub faces: LeafFaces,
    /// How its chlorophyll fluoresces; `None` if it does not.
    #[key(flat, with = Fluorescence::declare_of)]
    pub fluorescence: Option<Fluorescence>,
}

/// The tissue of a leaf, which determines R and T.
#[derive(Clone, Debug)]
pub enum LeafTissue {
    /// PROSPECT-D of contents.
    Held(Held),
    /// Measured spectra.
    Measured {
        /// Directional–hemispherical reflectance, adaxial face.
        reflectance: Spectrum,
        /// Directional–hemispherical transmittance.
        transmittance: Spectrum,
    },
}

impl Default for LeafTissue {
    fn default() -> Self {
        Self::Held(Held::default())
    }
}

impl PlainLeaf {
    fn declare_tissue(&mut self, keys: &mut Keys<'_>) {
        let mut held = match &self.tissue {
            LeafTissue::Held(held) => held.clone(),
            LeafTissue::Measured { .. } => Held::default(),
        };
        // A named preset needs no contents, but contents may be given to change it.
        let mut contents = match held {
            Held::Contents { contents, .. } => contents,
            Held::Map { .. } => Contents::NOTHING,
        };
        plan_file::colour_preset(&mut contents, keys);
        if keys.base().is_some() {
            for other in ["map", "measured"] {
                keys.exclude("preset", other);
            }
            let about = "What of the preset's contents is different.";
            keys.block("contents", about, |keys| {
                plan_file::contents(&mut contents, keys);
            });
            require_prospect(keys);
            self.tissue = LeafTissue::Held(Held::Contents {
                contents,
                extrapolate: extrapolate(keys),
            });
        } else {
            for kind in keys.one_of(&["contents", "map", "measured"], Some("contents")) {
                match kind {
                    "contents" => {
                        held.declare_contents(contents, plan_file::contents, keys);
                        self.tissue = LeafTissue::Held(held.clone());
                    }
                    "map" => {
                        held.declare_map(keys);
                        self.tissue = LeafTissue::Held(held.clone());
                    }
                    _ => {
                        let about = "Measured spectra of a leaf.";
                        keys.required_block("measured", about, &[], |keys| {
                            let mut measured = Measured::default();
                            measured.declare(keys);
                            self.faces.abaxial_reflectance = measured.abaxial;
                            self.tissue = LeafTissue::Measured {
                                reflectance: measured.reflectance,
                                transmittance: measured.transmittance,
                            };
                        });
                    }
                }
            }
        }
        keys.exclude("measured", "pigments");
    }

    /// Reports a ratio of faces of which both were measured.
    fn refuse_ratio_of_measured(&mut self, keys: &mut Keys<'_>) {
        let faces = &self.faces;
        if faces.abaxial_reflectance.is_some() && faces.abaxial_ratio.is_some() {
            let problem = "both faces were measured".to_owned();
            let help = "leave `abaxial_ratio` out, or the abaxial reflectance";
            keys.refuse(&["abaxial_ratio"], problem, help);
        }
        keys.exclude("measured", "fluorescence");
    }

    fn refuse_layers(&mut self, keys: &mut Keys<'_>) {
        if let LeafTissue::Held(Held::Contents { contents, .. }) = &self.tissue {
            refuse_unknown_absorption(&self.pigments, contents, keys);
        }
        self.faces.refuse_light_of(self.fluorescence, keys);
        if self.faces.optics == LeafOptics::Layers
            && matches!(self.tissue, LeafTissue::Measured { .. })
        {
            let problem = "layers need contents, and measured spectra say nothing of the inside";
            let help = "give contents or a map, or leave `optics` out";
            impossible(keys, problem, help);
        }
    }

    pub(super) fn built(&self, sources: &mut Sources<'_>) -> Result<LeafMaterial, AssetError> {
        let made = match &self.tissue {
            LeafTissue::Held(held) => material::leaf::LeafTissue::Held(Sources::held(held)?),
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => material::leaf::LeafTissue::Measured {
                reflectance: Curve::from_description(reflectance),
                transmittance: Curve::from_description(transmittance),
            },
        };
        let palette = sources.palettes.of(&self.pigments);
        Ok(tissue::leaf(made, palette, &self.faces, self.fluorescence))
    }

    pub(super) fn plugin(&self, surface: &mut Exported<'_>) -> Element {
        let bsdf = match &self.tissue {
            LeafTissue::Held(held) => surface.leaf(held.extrapolates()),
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => surface
                .leaf(false)
                .holding(surface.spectra.element("reflectance", reflectance, 1.0))
                .holding(surface.spectra.element("transmittance", transmittance, 1.0)),
        };
        self.faces.written(bsdf, surface.spectra)
    }
}
