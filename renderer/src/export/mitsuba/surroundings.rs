//! What shines from everywhere around a scene: one sphere, far away, that shines inwards with the
//! sum of all such lights.
//!
//! A light whose radiance changes with direction and wavelength is the texture `lamina_sky`, which
//! `reference/` registers: three maps of weights, and a table of their spectra. If there is none,
//! the scene needs no sphere, since `constant` is Mitsuba's own.

use crate::image::{Layer, Picture};
use crate::light::Light as Built;
use crate::light::radiance_table::RadianceTable;
use crate::plugin::element::Element;
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::{RANGE_NM, Spectra};
use crate::plugin::weights_file;
use crate::scene::description::Description;
use crate::scene::world::World;
use crate::spectrum::Curve;

use super::emitter::{far, shining};

/// Radius of the sphere over the distance of suns, which lie before it.
const BEHIND_SUNS: f64 = 2.0;

/// Path, within the export, of the spectra that the weights of a light weigh.
pub(super) fn spectra_file(light: &str) -> String {
    format!("spectra/light-{light}.csv")
}

/// The tables of the lights that have one, with the lights' names.
pub(super) fn tables<'w>(
    scene: &'w Description,
    world: &'w World,
) -> impl Iterator<Item = (&'w str, RadianceTable<'w>)> {
    scene.with_built(&world.lights).filter_map(|(light, own)| {
        let table = own.iter().find_map(Built::radiance_table);
        table.map(|table| (light.name.as_str(), table))
    })
}

/// The emitters of all that shines from everywhere.
pub(super) fn emitters(scene: &Description, world: &World, spectra: &mut Spectra) -> Vec<Element> {
    let skies: Vec<Element> = tables(scene, world)
        .map(|(light, table)| sky(light, &table))
        .collect();
    let constant = scene.lights.iter().filter_map(|light| {
        match light.value.emitter(&mut Spectra::default()) {
            Emitter::Around(radiance) => radiance,
            Emitter::Placed(_) | Emitter::Disc { .. } | Emitter::OnShape => None,
        }
    });
    if skies.is_empty() {
        return constant
            .map(|radiance| {
                let emitter = Element::plugin("emitter", "constant");
                emitter.holding(spectra.element("radiance", radiance, 1.0))
            })
            .collect();
    }
    let even: Vec<Element> = constant
        .enumerate()
        .map(|(number, radiance)| spectra.element(&format!("even_{number}"), radiance, 1.0))
        .collect();
    let sum = Element::plugin("texture", "lamina_sum")
        .with("name", "radiance")
        .holding_all(skies)
        .holding_all(even);
    let (distance, middle) = far(world);
    let sphere = Element::plugin("shape", "sphere")
        .holding(
            Element::new("point")
                .with("name", "center")
                .with("x", middle.x)
                .with("y", middle.y)
                .with("z", middle.z),
        )
        .float("radius", BEHIND_SUNS * distance)
        .boolean("flip_normals", true);
    let emitter = Element::plugin("emitter", "area").holding(sum);
    vec![shining(sphere, emitter)]
}

/// The texture of one light.
fn sky(light: &str, table: &RadianceTable<'_>) -> Element {
    Element::plugin("texture", "lamina_sky")
        .with("name", format!("sky-{light}"))
        .string("weights", weights_file(light))
        .string("spectra", spectra_file(light))
        .float("rotation", f64::from(table.rotation))
}

/// The spectra of a table with a line for each wavelength at which one of them has a point.
/// Mitsuba's own spectra cannot be negative.
pub(super) fn spectra(table: &RadianceTable<'_>) -> String {
    let curves: Vec<&Curve> = table.spectra.iter().chain(table.ground).collect();
    let points = curves.iter().flat_map(|curve| curve.points());
    let mut all_nm: Vec<f64> = points.map(|(nm, _)| nm).chain(RANGE_NM).collect();
    all_nm.sort_by(f64::total_cmp);
    all_nm.dedup();
    let mut text = "wavelength_nm,red,green,blue".to_owned();
    text += if table.ground.is_some() {
        ",ground\n"
    } else {
        "\n"
    };
    for nm in all_nm {
        let values = curves
            .iter()
            .map(|curve| format!(",{}", curve.at(nm as f32)));
        text += &format!("{nm}{}\n", values.collect::<String>());
    }
    text
}

/// Three or four weights as a picture, its first row towards the zenith or at the upper border.
pub(super) fn weights<const N: usize>(size: [usize; 2], texels: &[[f32; N]]) -> Picture {
    let layers = ["R", "G", "B", "A"].into_iter().take(N).enumerate();
    Picture::new(
        [size[0] as u32, size[1] as u32],
        layers.map(|(channel, name)| {
            Layer::new(name, texels.iter().map(|texel| texel[channel]).collect())
        }),
    )
}
