//! Media, and which shapes they fill.

use glam::{DVec3, Vec3Swizzles as _};

use crate::plugin::UNITS_PER_METRE;
use crate::plugin::element::Element;
use crate::plugin::spectra::{RANGE_NM, Spectra};
use crate::scene::description::{Description, Medium, MediumPhase, Named, Spectrum};
use crate::scene::world::{MaterialOwner, World};
use crate::spectrum::Curve;

/// Two bodies that may lie within each other, by the names of their objects; Mitsuba must be told
/// what is outside of the inner one, and no scene says that.
pub(super) fn nested<'s>(scene: &'s Description, world: &World) -> Option<[&'s str; 2]> {
    if !world.media.are_present {
        return None;
    }
    let numbers = 0..world.objects.len() as u32;
    let bodies = numbers.filter(|&number| world.objects[number as usize].body.is_some());
    let mut boxes: Vec<(DVec3, DVec3, usize)> = bodies
        .map(|number| {
            let (least, most) = world.geometry.bounds_of(number);
            (least, most, world.objects[number as usize].object)
        })
        .collect();
    boxes.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    for (number, (least, most, object)) in boxes.iter().enumerate() {
        let behind = boxes[number + 1..].iter();
        for (from, to, other) in behind.take_while(|other| other.0.x < most.x) {
            let overlap = from.yz().cmplt(most.yz()).all() && to.yz().cmpgt(least.yz()).all();
            if overlap {
                return Some([object, other].map(|&object| scene.objects[object].name.as_str()));
            }
        }
    }
    None
}

/// Name of a medium in the export.
fn id(scene: &Description, medium: usize) -> String {
    format!("medium-{}", scene.media[medium].name)
}

/// All media that fill something.
pub(super) fn media<'a>(
    scene: &'a Description,
    spectra: &'a mut Spectra,
) -> impl Iterator<Item = Element> + 'a {
    let used = |number: usize| {
        let mut materials = scene.materials.iter();
        materials.any(|named| named.value.interior() == Some(number))
    };
    let numbers = (0..scene.media.len()).filter(move |&number| used(number));
    numbers.map(|number| medium(&id(scene, number), &scene.media[number], spectra))
}

/// The medium that fills what is made of a material, as a child of the shape.
pub(super) fn of_material(scene: &Description, world: &World, material: usize) -> Option<Element> {
    let MaterialOwner::Scene(number) = world.owners[material] else {
        return None;
    };
    let medium = scene.materials[number].value.interior()?;
    Some(
        Element::new("ref")
            .with("name", "interior")
            .with("id", id(scene, medium)),
    )
}

/// A medium: Mitsuba takes extinction and albedo.
fn medium(id: &str, named: &Named<Medium>, spectra: &mut Spectra) -> Element {
    let Medium {
        absorption,
        scattering,
        phase,
        g,
        leaves: _,
    } = &named.value;
    let [absorbed, scattered] = [absorption, scattering].map(Curve::from_description);
    let at = |nm: f64| [&absorbed, &scattered].map(|curve| f64::from(curve.at(nm as f32)));
    let is_even = |spectrum: &Spectrum| matches!(spectrum, Spectrum::Constant(_));
    let of = |f: &dyn Fn([f64; 2]) -> f64| {
        if is_even(absorption) && is_even(scattering) {
            return Spectrum::Constant(f(at(RANGE_NM[0])));
        }
        // A ratio of linear functions is not linear: a point each nanometre.
        let [first, last] = RANGE_NM.map(|nm| nm as u32);
        Spectrum::Table {
            points: (first..=last)
                .map(|nm| (f64::from(nm), f(at(f64::from(nm)))))
                .collect(),
            extrapolate: true,
        }
    };
    let albedo = of(&|[a, s]| if s > 0.0 { s / (a + s) } else { 0.0 });
    let extinction = of(&|[a, s]| a + s);
    let phase = match phase {
        MediumPhase::HenyeyGreenstein if *g == 0.0 => Element::plugin("phase", "isotropic"),
        MediumPhase::HenyeyGreenstein => Element::plugin("phase", "hg").float("g", *g),
        MediumPhase::Rayleigh => Element::plugin("phase", "rayleigh"),
    };
    Element::plugin("medium", "homogeneous")
        .called(id)
        .holding(spectra.element("albedo", &albedo, 1.0))
        .holding(spectra.element("sigma_t", &extinction, 1.0 / UNITS_PER_METRE))
        .holding(phase)
}
