//! Plants of a scene as objects with instances: its leaves in their places, and its axes.
//!
//! The tracer and the exporters see leaves, a mesh and places.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use leafmodel::blade::stalk::StalkMesh;
use leafmodel::document::names::Named;
use leafmodel::not_grown::NotGrown;
use leafmodel::optics::Contents;
use leafmodel::plant::{Crumb, Foot, Organ, Plant as Grown, Wall};

use super::individuals::{age, ageless, individuals, scattered_ranks, users};
use super::planted::{Fault, Planted, add};
use super::walls;
use crate::geometry::shapes::Lump;
use crate::scene::authored::Plant;
use crate::scene::description::material::solid::PlainSolid;
use crate::scene::description::{
    Coat, Description, Held, InstancePlace, Leaf, Material, Mesh, ObjectShape, Shape, SolidOptics,
    Spectrum,
};
use crate::spectrum::library;

/// Most places of the leaves of one object's plants.
const MOST_PLACES: usize = 1 << 24;

/// What the bark of a young axis holds in its outer millimetre: browned, over a green cortex;
/// by eye.
const BARK: Contents = Contents::prospect_d([1.5, 10.0, 3.0, 6.0, 1.6, 0.02, 0.03]);
/// GGX roughness of bark.
const BARK_ALPHA: f64 = 0.5;
/// What a green stem holds; by eye.
const GREEN: Contents = Contents::prospect_d([1.5, 16.0, 4.5, 1.5, 0.05, 0.06, 0.008]);
/// What white filaments hold, and what pale yellow anthers and a greenish white pistil do; by eye.
const FILAMENT: Contents = Contents::prospect_d([1.5, 0.4, 0.2, 0.0, 0.0, 0.05, 0.004]);
const ANTHER: Contents = Contents::prospect_d([1.5, 0.0, 1.0, 0.0, 0.0, 0.03, 0.008]);
const PISTIL: Contents = Contents::prospect_d([1.5, 1.2, 0.5, 0.0, 0.0, 0.06, 0.004]);
/// GGX roughness of soft tissue.
const SOFT_ALPHA: f64 = 0.35;
/// The measured surface of fired clay.
const CLAY: &str = "brick-light-red";
/// Shapes of crumbs of soil.
const CRUMB_SHAPES: u32 = 5;

/// A plant's parts with the scene's numbers, and their places in the plant's frame, m.
struct BoughParts {
    shapes: Vec<ObjectShape>,
    places: Vec<(u32, DAffine3)>,
}

/// Grows the plants of all objects, and gives these their shapes and places.
pub(super) fn place(scene: &mut Description, planted: &Planted) -> Result<(), Fault> {
    // What climbs on an object has a shape of its own in each place.
    let mut known: BTreeMap<(usize, Option<usize>), BoughParts> = BTreeMap::new();
    for (number, plant) in planted.of_object.iter().enumerate() {
        let Some(plant) = *plant else {
            continue;
        };
        let Named { name, value } = &planted.plants[plant];
        let climbs = !value.walls.is_empty();
        let parts = match known.entry((plant, climbs.then_some(number))) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => {
                let own = if climbs {
                    format!("{name}.{}", scene.objects[number].name)
                } else {
                    name.clone()
                };
                let fault =
                    |key: &str, problem, help| Fault::new(&["plants", name, key], problem, help);
                let wall = walls::of(scene, planted, value, number)
                    .map_err(|(key, problem, help)| fault(key, problem, help))?;
                if value.days.is_some()
                    && let Some((problem, help)) = ageless(scene, &value.leaves)
                {
                    return Err(fault("days", problem, help));
                }
                let (parts, crossing) = parts(scene, planted, (&own, value), wall.as_ref())
                    .map_err(|error| {
                        let usual = ("nodes", "use fewer nodes or branches");
                        let (key, help) = error.remedy().unwrap_or(usual);
                        fault(key, error.to_string(), help)
                    })?;
                scene.crossing.extend(crossing.map(|value| Named {
                    name: name.clone(),
                    value,
                }));
                place.insert(parts)
            }
        };
        let object = &mut scene.objects[number].value;
        let stands = match object.instances.take() {
            None => vec![object.to_world],
            Some(places) => places.iter().map(InstancePlace::matrix).collect(),
        };
        if stands.len() * parts.places.len() > MOST_PLACES {
            let name = &scene.objects[number].name;
            let problem = format!(
                "{} plants of {} parts are more than {MOST_PLACES} places",
                stands.len(),
                parts.places.len()
            );
            let path = &["objects", name, "instances"];
            return Err(Fault::new(path, problem, "use fewer places"));
        }
        let placed = stands.iter().flat_map(|stand| {
            let places = parts.places.iter();
            places.map(move |(shape, to_plant)| InstancePlace::new(*shape, *stand * *to_plant))
        });
        object.instances = Some(placed.collect());
        object.shapes.clone_from(&parts.shapes);
    }
    Ok(())
}

/// Grows a plant and adds its leaves, its axes and their bark to the scene; also how many leaves cut
/// something, of how many, if any do.
fn parts(
    scene: &mut Description,
    planted: &Planted,
    (name, plant): (&str, &Plant),
    wall: Option<&Wall>,
) -> Result<(BoughParts, Option<[usize; 2]>), NotGrown> {
    let mut kinds = plant.leaves.clone();
    if plant.plan.flower.is_some() {
        kinds.extend(plant.perianth.iter().flatten());
    }
    let mut individuals: Vec<Vec<Leaf>> = kinds
        .iter()
        .map(|&leaf| individuals(&scene.leaves[leaf].value, plant.plan.individuals))
        .collect();
    if let Some(days) = plant.days {
        let rank = scattered_ranks(plant.plan.individuals as usize);
        for leaves in &mut individuals[..plant.leaves.len()] {
            age(leaves, days, &rank);
        }
    }
    let foot = |leaf: &Leaf| Foot::of(&leaf.plan);
    let feet = individuals
        .iter()
        .map(|leaves| leaves.iter().map(foot).collect::<Result<Vec<_>, _>>());
    let feet = feet.collect::<Result<Vec<_>, _>>()?;
    let mut grown = Grown::grow(&plant.plan, &feet, wall)?;
    let extrapolate = kinds
        .iter()
        .any(|&leaf| scene.leaves[leaf].value.extrapolate);
    let mut parts = BoughParts {
        shapes: Vec::new(),
        places: Vec::new(),
    };
    let soil = add_organs(scene, &mut parts, (name, plant, extrapolate), &mut grown);
    if let Some(soil) = soil {
        add_crumbs(scene, &mut parts, (name, soil), &grown.crumbs);
    }
    add_leaves(
        (scene, planted),
        &mut parts,
        name,
        (&kinds, plant.leaves.len(), &individuals),
        &grown,
    );
    let crossing = grown.crossing.filter(|some| *some > 0);
    let crossing = crossing.map(|some| [some, grown.leaves.len()]);
    Ok((parts, crossing))
}

/// Adds axes and organs of a plant, with their materials; the material of its soil.
fn add_organs(
    scene: &mut Description,
    parts: &mut BoughParts,
    (name, plant, extrapolate): (&str, &Plant, bool),
    grown: &mut Grown,
) -> Option<usize> {
    let stem = || tissue(GREEN, SOFT_ALPHA, extrapolate);
    let bark = || {
        if plant.plan.is_green {
            stem()
        } else {
            tissue(BARK, BARK_ALPHA, extrapolate)
        }
    };
    let material = material_of(scene, name, (plant.bark, "bark"), bark);
    let axes = std::mem::take(&mut grown.axes);
    add_body(scene, parts, format!("{name}.axes"), axes, material);
    let mut of_soil = None;
    for (organ, body) in std::mem::take(&mut grown.organs) {
        let [pot, soil] = plant.potting;
        let (own, what) = match organ {
            Organ::Peduncle => ((plant.bark, "stem"), stem()),
            Organ::Filaments => (
                (None, "filaments"),
                tissue(FILAMENT, SOFT_ALPHA, extrapolate),
            ),
            Organ::Anthers => ((None, "anthers"), tissue(ANTHER, BARK_ALPHA, extrapolate)),
            Organ::Pistil => ((None, "pistil"), tissue(PISTIL, SOFT_ALPHA, extrapolate)),
            Organ::Pot => ((pot, "pot"), clay(extrapolate)),
            Organ::Soil => {
                let moisture = plant.plan.pot.map_or(0.5, |pot| pot.moisture);
                ((soil, "soil"), even(library::soil(moisture), extrapolate))
            }
        };
        let material = material_of(scene, name, own, || what);
        if organ == Organ::Soil {
            of_soil = Some(material);
        }
        let number = scene.meshes.len();
        let named = format!("{name}.{}.{number}", own.1);
        add_body(scene, parts, named, body, material);
    }
    of_soil
}

/// Adds crumbs of soil, which has this material.
fn add_crumbs(
    scene: &mut Description,
    parts: &mut BoughParts,
    (name, material): (&str, usize),
    crumbs: &[Crumb],
) {
    if crumbs.is_empty() {
        return;
    }
    let first = parts.shapes.len() as u32;
    for shape in 0..CRUMB_SHAPES {
        let lump = Lump {
            radius: 1e-3,
            angularity: 0.35,
            irregularity: 0.5,
            segments: 18,
            seed: u64::from(shape),
        };
        let name = format!("{name}.crumb.{shape}");
        let mesh = add(&mut scene.meshes, name, Shape::Mesh(Mesh::Lump(lump)));
        parts.shapes.push(ObjectShape::Mesh { mesh, material });
    }
    parts.places.extend(crumbs.iter().map(|crumb| {
        let place = DAffine3::from_scale_rotation_translation(
            DVec3::splat(crumb.radius_mm),
            crumb.turn,
            crumb.at * 1e-3,
        );
        (first + crumb.shape % CRUMB_SHAPES, place)
    }));
}

/// Adds the leaves of a plant, each individual once; the first `borne` kinds are no sepals or petals.
fn add_leaves(
    (scene, planted): (&mut Description, &Planted),
    parts: &mut BoughParts,
    name: &str,
    (kinds, borne, individuals): (&[usize], usize, &[Vec<Leaf>]),
    grown: &Grown,
) {
    let mut shapes: BTreeMap<(usize, bool, u32), u32> = BTreeMap::new();
    for leaf in &grown.leaves {
        let kind = kinds[leaf.kind];
        let shape = *shapes
            .entry((kind, leaf.kind < borne, leaf.individual))
            .or_insert_with(|| {
                let value = individuals[leaf.kind][leaf.individual as usize].clone();
                // The first individual is the leaf itself, unless something else shows that at its own age.
                let own = value.plan.senescence == scene.leaves[kind].value.plan.senescence
                    || users(scene, planted, kind) == 1;
                let number = if leaf.individual == 0 && own {
                    scene.leaves[kind].value = value;
                    kind
                } else {
                    let of = &scene.leaves[kind].name;
                    let name = format!("{of}.{name}.{}", leaf.individual + 1);
                    add(&mut scene.leaves, name, value)
                };
                parts.shapes.push(ObjectShape::Leaf { leaf: number });
                parts.shapes.len() as u32 - 1
            });
        let to_plant = DAffine3 {
            translation: leaf.to_plant.translation * 1e-3,
            ..leaf.to_plant
        };
        parts.places.push((shape, to_plant));
    }
}

/// The number of a material that the file names, or of a new one.
fn material_of(
    scene: &mut Description,
    name: &str,
    (named, what): (Option<usize>, &str),
    usual: impl FnOnce() -> Material,
) -> usize {
    named.unwrap_or_else(|| add(&mut scene.materials, format!("{name}.{what}"), usual()))
}

/// Adds a body of the plant in its own frame.
fn add_body(
    scene: &mut Description,
    parts: &mut BoughParts,
    name: String,
    body: StalkMesh,
    material: usize,
) {
    let mesh = add(&mut scene.meshes, name, Shape::Body(Arc::new(body)));
    let shape = parts.shapes.len() as u32;
    parts.shapes.push(ObjectShape::Mesh { mesh, material });
    parts.places.push((shape, DAffine3::IDENTITY));
}

/// A matt surface of a measured spectrum.
fn even(points: Vec<(f64, f64)>, extrapolate: bool) -> Material {
    Material::matt(Spectrum::Table {
        points,
        extrapolate,
    })
}

fn clay(extrapolate: bool) -> Material {
    let number = library::SURFACES.iter().position(|name| *name == CLAY);
    even(
        library::surface(number.expect("it is one of them")),
        extrapolate,
    )
}

/// Solid tissue with these contents.
fn tissue(contents: Contents, alpha: f64, extrapolate: bool) -> Material {
    let optics = SolidOptics::default();
    Material::Solid(PlainSolid {
        held: Held::Contents {
            contents,
            extrapolate,
        },
        pigments: Box::default(),
        optics: SolidOptics {
            coat: Coat::even(optics.coat.eta, alpha),
            ..optics
        },
    })
}

#[cfg(test)]
mod tests;
