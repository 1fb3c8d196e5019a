//! Plants of a scene as objects with instances: its leaves in their places, and its axes.
//!
//! After this nothing else has to know that a plant is one: the tracer and the exporters see leaves,
//! a mesh and places.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use glam::DAffine3;
use leafmodel::document::keys::Keys;
use leafmodel::document::names::Named;
use leafmodel::optics::{Contents, Pigments};
use leafmodel::plant::{Foot, Plant as Grown, PlantError};

use super::individuals::individuals;
use crate::scene::description::{
    Coat, Description, Held, InstancePlace, Leaf, Material, Mesh, ObjectShape, Plant, SolidOptics,
};

/// Most places of the leaves of one object's plants.
const MOST_PLACES: usize = 1 << 24;

/// What the bark of a young axis holds in its outer millimetre: browned, over a green cortex;
/// by eye.
const BARK: Contents = Contents::prospect_d([1.5, 10.0, 3.0, 6.0, 1.6, 0.02, 0.03]);
/// GGX roughness of bark.
const BARK_ALPHA: f64 = 0.5;

/// A plant's parts with the scene's numbers, and their places in the plant's frame, m.
struct Parts {
    shapes: Vec<ObjectShape>,
    places: Vec<(u32, DAffine3)>,
}

/// Replaces the plants of all objects; `keys` are those at the top of the file, to which what is
/// wrong is reported.
pub(in crate::scene) fn place(scene: &mut Description, keys: &Keys<'_>) {
    let mut known: BTreeMap<usize, Parts> = BTreeMap::new();
    for number in 0..scene.objects.len() {
        let Some(plant) = scene.objects[number].value.plant else {
            continue;
        };
        let parts = match known.entry(plant) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => {
                let Named { name, value } = scene.plants[plant].clone();
                match parts(scene, &name, &value) {
                    Ok(parts) => place.insert(parts),
                    Err(error) => {
                        let (key, help) = match error {
                            PlantError::NotBorne(_) | PlantError::NoLeaf => {
                                ("leaf", "let it bear another leaf")
                            }
                            PlantError::Bent(_) => ("length_mm", "let its axes bend less"),
                            PlantError::OutOfRange { .. }
                            | PlantError::NoRoom { .. }
                            | PlantError::TooLarge => ("nodes", "use fewer nodes or branches"),
                        };
                        keys.refuse(&["plants", &name, key], error.to_string(), help);
                        return;
                    }
                }
            }
        };
        let object = &mut scene.objects[number].value;
        let stands = match object.instances.take() {
            None => vec![object.to_world],
            Some(places) => places.iter().map(InstancePlace::matrix).collect(),
        };
        if stands.len() * parts.places.len() > MOST_PLACES {
            let name = scene.objects[number].name.clone();
            let problem = format!(
                "{} plants of {} parts are more than {MOST_PLACES} places",
                stands.len(),
                parts.places.len()
            );
            keys.refuse(
                &["objects", &name, "instances"],
                problem,
                "use fewer places",
            );
            return;
        }
        let placed = stands.iter().flat_map(|stand| {
            let places = parts.places.iter();
            places.map(move |(shape, to_plant)| InstancePlace::new(*shape, *stand * *to_plant))
        });
        object.instances = Some(placed.collect());
        object.shapes.clone_from(&parts.shapes);
    }
}

/// Grows a plant and adds its leaves, its axes and their bark to the scene.
fn parts(scene: &mut Description, name: &str, plant: &Plant) -> Result<Parts, PlantError> {
    let individuals: Vec<Vec<Leaf>> = plant
        .leaves
        .iter()
        .map(|&leaf| individuals(&scene.leaves[leaf].value, plant.plan.individuals))
        .collect();
    let foot = |leaf: &Leaf| Foot::of(&leaf.plan);
    let feet = individuals
        .iter()
        .map(|leaves| leaves.iter().map(foot).collect::<Result<Vec<_>, _>>());
    let feet = feet.collect::<Result<Vec<_>, _>>()?;
    let grown = Grown::grow(&plant.plan, &feet)?;
    let extrapolate = plant
        .leaves
        .iter()
        .any(|&leaf| scene.leaves[leaf].value.extrapolate);
    let material = plant.bark.unwrap_or_else(|| {
        scene.materials.push(Named {
            name: format!("{name}.bark"),
            value: bark(extrapolate),
        });
        scene.materials.len() - 1
    });
    scene.meshes.push(Named {
        name: format!("{name}.axes"),
        value: Mesh::Axes(Arc::new(grown.axes)),
    });
    let mut parts = Parts {
        shapes: vec![ObjectShape::Mesh {
            mesh: scene.meshes.len() - 1,
            material,
        }],
        places: vec![(0, DAffine3::IDENTITY)],
    };
    let mut shapes: BTreeMap<(usize, u32), u32> = BTreeMap::new();
    for leaf in &grown.leaves {
        let shape = *shapes
            .entry((plant.leaves[leaf.kind], leaf.individual))
            .or_insert_with(|| {
                let kind = plant.leaves[leaf.kind];
                // The first individual is the leaf itself.
                let number = if leaf.individual == 0 {
                    kind
                } else {
                    let of = &scene.leaves[kind].name;
                    scene.leaves.push(Named {
                        name: format!("{of}.{name}.{}", leaf.individual + 1),
                        value: individuals[leaf.kind][leaf.individual as usize].clone(),
                    });
                    scene.leaves.len() - 1
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
    Ok(parts)
}

fn bark(extrapolate: bool) -> Material {
    let usual = SolidOptics::usual();
    Material::Solid {
        held: Held::Contents {
            contents: BARK,
            extrapolate,
        },
        pigments: Box::new(Pigments::default()),
        optics: SolidOptics {
            coat: Coat {
                alpha_across: BARK_ALPHA,
                alpha_along: BARK_ALPHA,
                ..usual.coat
            },
            ..usual
        },
    }
}

#[cfg(test)]
mod tests;
