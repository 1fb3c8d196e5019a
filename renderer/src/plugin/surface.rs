//! What Mitsuba gets of a material.

use super::colours;
use super::element::Element;
use super::spectra::Spectra;
use crate::material::Material;
use crate::material::held::Held;
use crate::material::palette::Palette;

/// Plugin for leaves, in `reference/`.
const LEAF: &str = "lamina_leaf";
/// Plugin for leaves with a relief, in `reference/`.
const RELIEF: &str = "lamina_relief";
/// The faces of a leaf.
pub(crate) const FACES: [&str; 2] = ["adaxial", "abaxial"];

/// A material of the world, of which Mitsuba's plugin is made.
pub(crate) struct Exported<'w> {
    /// Its name in the export.
    pub(crate) id: &'w str,
    /// The tracer's material.
    pub(crate) material: &'w Material,
    /// Spectra that were written.
    pub(crate) spectra: &'w mut Spectra,
}

impl Exported<'_> {
    /// A plugin of the material's name, with the contents of its tissue, if it is tissue: uniform contents,
    /// the file of a map, or measured spectra. `extrapolate` says whether PROSPECT's table is continued.
    pub(crate) fn plugin(&self, kind: &str, extrapolate: bool) -> Element {
        let bsdf = Element::plugin("bsdf", kind).called(self.id);
        let Some(tissue) = self.material.tissue() else {
            return bsdf;
        };
        let prospect = |bsdf: Element| {
            bsdf.string("prospect", absorption_file(tissue.palette))
                .boolean("extrapolate", extrapolate)
        };
        match tissue.held {
            Some(Held::Uniform(contents)) => {
                let bsdf = prospect(bsdf.string("tissue", "contents"));
                let contents = (**contents).into_iter();
                contents.fold(bsdf, |bsdf, (constituent, value)| {
                    bsdf.float(constituent.channel(), value)
                })
            }
            Some(Held::Map(_)) => {
                let bsdf = bsdf.string("tissue", "map");
                prospect(bsdf.string("map", format_args!("maps/{}.exr", self.id)))
            }
            None => bsdf.string("tissue", "measured"),
        }
    }

    /// The plugin of a leaf, without its faces: one thickness of the blade in texture coordinates if light
    /// spreads sideways in it, its relief, and which half of a fold it is.
    pub(crate) fn leaf(&self, extrapolate: bool) -> Element {
        let has_relief = self.material.relief().is_some();
        let kind = if has_relief { RELIEF } else { LEAF };
        let mut bsdf = self.plugin(kind, extrapolate);
        let Material::Leaf(leaf) = self.material else {
            return bsdf;
        };
        if let Some(spread) = leaf.spread() {
            let [u, v] = spread.thickness_uv().to_array();
            bsdf = bsdf
                .float("spread_u", f64::from(u))
                .float("spread_v", f64::from(v));
        }
        if has_relief {
            bsdf = bsdf.string("relief", relief_file(self.id));
        }
        if let Some(face) = leaf.half_face() {
            bsdf = bsdf.string("half", FACES[face]);
        }
        bsdf
    }

    /// The texture of its map of colours, as the parameter `name`.
    pub(crate) fn colours(&self, name: &'static str) -> Element {
        colours::texture(self.id, name, self.material.colour_map())
    }
}

/// Path, within the export, of the table of a palette.
pub(crate) fn absorption_file(palette: &Palette) -> String {
    match palette.number() {
        0 => "prospect_d.csv".to_owned(),
        number => format!("pigments-{number}.csv"),
    }
}

/// Path, within the export, of the relief of a material.
pub(crate) fn relief_file(id: &str) -> String {
    format!("maps/{id}.relief.exr")
}
