//! The walls on which plants climb: meshes of the scene in the plant's frame.

use glam::{DMat4, DVec3};
use leafmodel::plant::Wall;

use super::planted::Planted;
use crate::scene::authored::Plant;
use crate::scene::description::{Description, ObjectShape};
use crate::scene::model::Wanted;
use crate::scene::world::meshes::build_mesh;

/// The key that is wrong, why, and what to do.
type WallFault = (&'static str, String, &'static str);

/// The wall of the plant that is this object; none if it climbs on none that is given.
pub(super) fn of(
    scene: &Description,
    planted: &Planted,
    plant: &Plant,
    object: usize,
) -> Result<Option<Wall>, WallFault> {
    let Some(climbing) = plant.plan.climbing.filter(|_| !plant.walls.is_empty()) else {
        return Ok(None);
    };
    let stands = &scene.objects[object];
    if stands.value.instances.is_some() || stands.value.is_spread() {
        let problem = format!(
            "the plant climbs on a wall, and `{}` has many places",
            stands.name
        );
        return Err(("wall", problem, "write an object for each place"));
    }
    let to_plant = stands.value.to_world.inverse();
    let mut triangles = Vec::new();
    for &wall in &plant.walls {
        triangles.extend(surface(scene, planted, wall, to_plant)?);
    }
    Ok(Some(Wall::of(&triangles, climbing.away)))
}

/// The triangles of an object that is a mesh in one place, in the plant's frame, mm.
fn surface(
    scene: &Description,
    planted: &Planted,
    object: usize,
    to_plant: DMat4,
) -> Result<Vec<[DVec3; 3]>, WallFault> {
    let fault = |problem: String, help| Err(("wall", problem, help));
    let wall = &scene.objects[object];
    let (&[ObjectShape::Mesh { mesh, .. }], None, None, false) = (
        wall.value.shapes.as_slice(),
        planted.of_object[object],
        &wall.value.instances,
        wall.value.is_spread(),
    ) else {
        let problem = format!("the object `{}` is not a mesh in one place", wall.name);
        return fault(
            problem,
            "name an object with a `mesh`, such as a wall of `masonry`",
        );
    };
    let shape = &scene.meshes[mesh];
    let built = match build_mesh(&shape.name, &shape.value, Wanted::default()) {
        Ok(built) => built.mesh,
        Err(error) => {
            let help = "mend the mesh, or let the plant climb on another";
            return fault(error.to_string(), help);
        }
    };
    let to_plant = to_plant * wall.value.to_world;
    let place = |corner: u32| -> DVec3 {
        let at = built.positions()[corner as usize].as_dvec3();
        to_plant.transform_point3(at) * 1e3
    };
    let triangles = built.triangles().iter();
    Ok(triangles.map(|triangle| triangle.map(place)).collect())
}
