//! Materials of Mitsuba's own alone, in the colours that glTF gets.
//!
//! A blade is a `blendbsdf` of what its two faces send back (`twosided` of two `principled`) and of what it
//! lets through (`principledthin`), all else a `principled` or a `diffuse`. Relief and the direction of stretched
//! highlights are left out. A `roughplastic` would lose up to half of what the body below a rough coat sends back.

use std::collections::BTreeMap;

use thiserror::Error;

use super::bsdf::is_stock;
use crate::export::gltf::{Arrangement, Finish, GltfError, Illuminant, Surface, surfaces_of};
use crate::export::names::material_id;
use crate::material::colour_map::Wrap;
use crate::plugin::element::Element;
use crate::scene::description::Description;
use crate::scene::world::World;

/// Why materials of Mitsuba's own cannot show a scene.
#[derive(Debug, Error)]
pub enum StockError {
    /// A model of several materials; the scene's material.
    #[error(
        "`{0}` is a model of several materials, which only the plugins have: leave --stock out"
    )]
    Slots(String),
    /// The pictures of a material cannot be made.
    #[error(transparent)]
    Colours(#[from] GltfError),
}

/// Most texels along a side of a picture.
const TEXTURE: u32 = 2048;
/// A refractive index at which a surface reflects nothing of its own, and the least that Mitsuba takes.
const NO_COAT: f64 = 1.0001;

/// The surfaces of all materials that would need a plugin, by number.
pub(super) struct Stock<'w>(BTreeMap<usize, Surface<'w>>);

impl<'w> Stock<'w> {
    pub(super) fn of(scene: &Description, world: &'w World) -> Result<Self, StockError> {
        let mut surfaces = surfaces_of(scene, world, TEXTURE, Illuminant::D65)?;
        surfaces.retain(|&number, _| !is_stock(scene, world, number));
        for (&number, surface) in &surfaces {
            if surface.finishes.len() > 1 && !matches!(surface.arrangement, Arrangement::Faces) {
                return Err(StockError::Slots(material_id(scene, world, number)));
            }
        }
        Ok(Self(surfaces))
    }

    /// Pictures with their paths within the export.
    pub(super) fn pictures(&self) -> impl Iterator<Item = (String, &[u8])> {
        self.0.values().flat_map(|surface| {
            let all = surface.pictures.iter().enumerate();
            all.map(|(number, (_, bytes, _))| (path(surface, number), &bytes[..]))
        })
    }

    /// A material, unless it is one of Mitsuba's own in any case.
    pub(super) fn bsdf(&self, number: usize, id: &str) -> Option<Element> {
        let surface = self.0.get(&number)?;
        let mut faces = surface.finishes.iter().map(|finish| face(surface, finish));
        let two_sided =
            |faces: Vec<Element>| Element::plugin("bsdf", "twosided").holding_all(faces);
        let [first, ..] = &surface.finishes[..] else {
            return None;
        };
        let Some((fraction, colour, map)) = first.through else {
            return Some(two_sided(faces.collect()).called(id));
        };
        let sent_back = match surface.arrangement {
            Arrangement::Faces => two_sided(faces.collect()),
            Arrangement::Whole | Arrangement::Backs | Arrangement::Slots(_) => {
                two_sided(faces.by_ref().take(1).collect())
            }
        };
        // Of what it scatters diffusely it lets all through.
        let let_through = Element::plugin("bsdf", "principledthin")
            .holding(coloured(surface, "base_color", colour, map))
            .float("diff_trans", 2.0)
            .float("eta", NO_COAT);
        let blend = Element::plugin("bsdf", "blendbsdf")
            .called(id)
            .float("weight", f64::from(fraction))
            .holding(sent_back)
            .holding(let_through);
        Some(blend)
    }
}

/// Path, within the export, of a picture.
fn path(surface: &Surface<'_>, number: usize) -> String {
    format!("maps/{}.{}.png", surface.name, surface.pictures[number].0)
}

/// What a surface sends back.
fn face(surface: &Surface<'_>, finish: &Finish) -> Element {
    let colour = |name| coloured(surface, name, finish.base, finish.base_map);
    if finish.eta == 1.0 {
        return Element::plugin("bsdf", "diffuse").holding(colour("reflectance"));
    }
    Element::plugin("bsdf", "principled")
        .holding(colour("base_color"))
        .float("metallic", f64::from(finish.metallic))
        .float("roughness", f64::from(finish.roughness))
        .float("eta", f64::from(finish.eta))
}

/// A parameter that is a colour or a picture.
fn coloured(
    surface: &Surface<'_>,
    name: &'static str,
    colour: [f32; 3],
    map: Option<usize>,
) -> Element {
    let Some(number) = map else {
        let [r, g, b] = colour.map(|value| value.clamp(0.0, 1.0));
        return Element::new("rgb")
            .with("name", name)
            .with("value", format!("{r}, {g}, {b}"));
    };
    let [wrap, _] = surface.pictures[number].2;
    let mode = match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Mirror => "mirror",
        Wrap::Clamp => "clamp",
    };
    let (repeats, shift) = match surface.arrangement {
        Arrangement::Slots(map) => (map.repeats(), map.slots()[0].shift),
        Arrangement::Whole | Arrangement::Faces | Arrangement::Backs => (glam::Vec2::ONE, 0.0),
    };
    // Mitsuba's first row is at v = 0.
    let to_uv = Element::new("transform")
        .with("name", "to_uv")
        .holding(Element::new("translate").with("x", -shift))
        .holding(
            Element::new("scale")
                .with("x", repeats.x)
                .with("y", -repeats.y),
        )
        .holding(Element::new("translate").with("y", 1));
    Element::plugin("texture", "bitmap")
        .with("name", name)
        .string("filename", path(surface, number))
        .string("wrap_mode", mode)
        .holding(to_uv)
}
