//! Maps of colours, as the texture `lamina_colours` of `reference/`.
//!
//! The pictures are written as linear colours, row by row from the top, and the three spectra of
//! which a colour is the sum beside them, so that both programs have the same reflectances.

use crate::image::{Layer, Picture};
use crate::material::Material;
use crate::material::colour_map::{ColourMap, Wrap};
use crate::plugin::element::Element;

/// Path, within the export, of the spectra of red, green and blue.
pub(crate) const BASIS: &str = "spectra/rgb_basis.csv";

/// Path, within the export, of a picture of a material.
fn file(id: &str, slot: usize) -> String {
    format!("maps/{id}.colours-{slot}.exr")
}

/// The texture of a map, as the parameter `name`.
///
/// # Panics
///
/// If there is no map: a material with a picture has one.
pub(crate) fn texture(id: &str, name: &'static str, map: Option<&ColourMap>) -> Element {
    let map = map.expect("what is built of a picture has a map");
    let [u, v] = map.repeats().to_array().map(f64::from);
    let texture = Element::plugin("texture", "lamina_colours")
        .with("name", name)
        .string("basis", BASIS)
        .float("repeats_u", u)
        .float("repeats_v", v)
        .boolean("tinted", map.is_tinted());
    let slots = map.slots().iter().enumerate();
    slots.fold(texture, |texture, (number, slot)| {
        let [r, g, b] = slot.factor;
        let picture = slot.texture.as_ref().map(|picture| {
            let [across, down] = picture.wrap().map(Wrap::word);
            format!(" {across} {down} {}", file(id, number))
        });
        let picture = picture.unwrap_or_default();
        let (begins, shift) = (slot.begins, slot.shift);
        let value = format!("{begins:e} {shift:e} {r:e} {g:e} {b:e}{picture}");
        texture.string(&format!("slot_{number}"), value)
    })
}

/// The maps of colours, and of numbers stored as such, that a material has, each with its id.
pub(crate) fn maps(id: &str, material: &Material) -> Vec<(String, ColourMap)> {
    let colours = material.colour_map().cloned();
    let colours = colours.map(|map| (id.to_owned(), map));
    let further = if let Material::Model(model) = material {
        let ids = ["finish", "normals"].map(|of| format!("{id}.{of}"));
        ids.into_iter().zip(model.finish_maps()).collect()
    } else {
        Vec::new()
    };
    colours.into_iter().chain(further).collect()
}

/// The pictures of a map, each with its path within the export.
pub(crate) fn pictures(id: &str, map: &ColourMap) -> Vec<(String, Picture)> {
    let slots = map.slots().iter().enumerate();
    let pictures = slots.filter_map(|(number, slot)| {
        let texture = slot.texture.as_ref()?;
        let [width, height] = texture.size();
        let layer = |channel: usize, name: &str| {
            Layer::new(
                name,
                texture
                    .texels()
                    .iter()
                    .map(|texel| texel[channel])
                    .collect(),
            )
        };
        let picture = Picture::new(
            [width as u32, height as u32],
            [layer(0, "R"), layer(1, "G"), layer(2, "B")],
        );
        Some((file(id, number), picture))
    });
    pictures.collect()
}
