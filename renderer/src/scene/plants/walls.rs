//! The walls on which plants climb: a mesh of the scene in the plant's frame.

use glam::DVec3;
use leafmodel::plant::Wall;

use crate::scene::description::{Description, ObjectShape, Plant};
use crate::scene::world::meshes::build_mesh;

/// The key that is wrong, why, and what to do.
type Fault = (&'static str, String, &'static str);

/// The wall of the plant that is this object; none if it climbs on none that is given.
pub(super) fn of(scene: &Description, plant: &Plant, object: usize) -> Result<Option<Wall>, Fault> {
    let (Some(on), Some(climbing)) = (plant.wall, plant.plan.climbing) else {
        return Ok(None);
    };
    let fault = |problem: String, help| Err(("wall", problem, help));
    let (stands, wall) = (&scene.objects[object], &scene.objects[on]);
    if stands.value.instances.is_some() || stands.value.is_spread() {
        let problem = format!(
            "the plant climbs on a wall, and `{}` has many places",
            stands.name
        );
        return fault(problem, "write an object for each place");
    }
    let (&[ObjectShape::Mesh { mesh, .. }], None, None, false) = (
        wall.value.shapes.as_slice(),
        wall.value.plant,
        &wall.value.instances,
        wall.value.is_spread(),
    ) else {
        let problem = format!("the object `{}` is not a mesh in one place", wall.name);
        return fault(
            problem,
            "name an object with a `mesh`, such as a wall of `masonry`",
        );
    };
    let to_plant = stands.value.to_world.inverse() * wall.value.to_world;
    let shape = &scene.meshes[mesh];
    let built = match build_mesh(&shape.name, &shape.value, false) {
        Ok(built) => built.mesh,
        Err(error) => {
            let help = "mend the mesh, or let the plant climb on another";
            return fault(error.to_string(), help);
        }
    };
    let place = |corner: u32| -> DVec3 {
        let at = built.positions()[corner as usize].as_dvec3();
        to_plant.transform_point3(at) * 1e3
    };
    let triangles: Vec<[DVec3; 3]> = built
        .triangles()
        .iter()
        .map(|triangle| triangle.map(place))
        .collect();
    Ok(Some(Wall::of(&triangles, climbing.away)))
}
