//! A round spot on an object's surface: where the port of a sphere is.

use glam::{DMat4, DVec2, DVec3, Vec2, Vec3};

use super::error::{InstrumentError, Problem};
use super::stage::Stage;
use crate::geometry::{Geometry, Ray};
use crate::scene::description::{Object, Spot, SpotMiddle};

/// Rings of points, and points on each, at which a spot is probed.
const RINGS: usize = 16;
const ON_A_RING: usize = 48;

/// Distance of the port from the highest point of the surface behind it, in diameters.
const CLEARANCE: f32 = 1e-4;

/// Most that a surface rises over the highest probe, as a share of the heights that probes span: the
/// probes nearest to any point are at most 0.09 radii from it, and a ridge as steep as the slope from
/// the highest to the lowest rises by that share.
const SAG: f32 = 0.1;

/// The axes of an object in the world: x, y and the normal of its adaxial side, unit.
pub(super) fn axes_of(object: &Object) -> [Vec3; 3] {
    let linear = DMat4::from_cols(
        object.to_world.x_axis,
        object.to_world.y_axis,
        object.to_world.z_axis,
        glam::DVec4::W,
    );
    let [x, y] = [linear.x_axis, linear.y_axis].map(glam::DVec4::truncate);
    // Normals of a mirrored object point to the side where those of the mesh do.
    let z = x.cross(y).normalize() * linear.determinant().signum();
    [x.normalize(), y.normalize(), z].map(DVec3::as_vec3)
}

/// The port of a sphere: a disc that the surface touches from behind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Port {
    /// Its middle, m.
    pub(super) middle: Vec3,
    /// Its radius, m.
    pub(super) radius: f32,
    /// The direction out of the surface, unit.
    pub(super) normal: Vec3,
}

impl Port {
    /// Whether something stands in front of it.
    pub(super) fn faces_a_surface(&self, geometry: &Geometry) -> bool {
        geometry.occluded(&Ray::new(self.middle, self.normal))
    }
}

/// The port on either face over a spot.
pub(super) fn ports(
    stage: &Stage<'_>,
    (name, object): (&str, &Object),
    spot: &Spot,
) -> Result<[Port; 2], InstrumentError> {
    let found = match spot.middle {
        SpotMiddle::Point(at) => at_point(stage, object, at),
        SpotMiddle::Uv(uv) => at_uv(&stage.geometry, uv.as_vec2()),
    };
    let (middle, normal) = found.ok_or_else(|| {
        let place = match spot.middle {
            SpotMiddle::Point(at) => format!("`at_mm = [{}, {}]`", 1e3 * at.x, 1e3 * at.y),
            SpotMiddle::Uv(uv) => format!("`at_uv = [{}, {}]`", uv.x, uv.y),
        };
        let object = name.to_owned();
        Problem::OffTheObject { object, place }.at(&spot.at)
    })?;
    let radius = 0.5 * spot.diameter as f32;
    let probe = |normal: Vec3| Probe::new(&stage.geometry, middle, normal, radius);
    let refuse = |share: f64| {
        Problem::NotCovered {
            object: name.to_owned(),
            share: 100.0 * share,
        }
        .at(&spot.at)
    };
    // The port lies along the mean of the surface.
    let first = probe(normal);
    let normal = first.mean_normal.try_normalize().unwrap_or(normal);
    let adaxial = probe(normal);
    let abaxial = probe(-normal);
    let missing = adaxial.missing.max(abaxial.missing);
    if missing > 0.0 {
        return Err(refuse(missing));
    }
    let port = |probe: &Probe, normal: Vec3| Port {
        middle: middle
            + normal
                * (probe.highest + SAG * (probe.highest - probe.lowest) + 2.0 * radius * CLEARANCE),
        radius,
        normal,
    };
    Ok([port(&adaxial, normal), port(&abaxial, -normal)])
}

/// The surface behind a port.
struct Probe {
    /// Share of the port behind which there is nothing.
    missing: f64,
    /// Heights of the highest and the lowest point over the middle, m.
    highest: f32,
    lowest: f32,
    /// Sum of the normals on the side of the port.
    mean_normal: Vec3,
}

impl Probe {
    fn new(geometry: &Geometry, middle: Vec3, normal: Vec3, radius: f32) -> Self {
        let (across, along) = normal.any_orthonormal_pair();
        let mut probe = Self {
            missing: 0.0,
            // Those of the middle itself.
            highest: 0.0,
            lowest: 0.0,
            mean_normal: Vec3::ZERO,
        };
        let diameter = 2.0 * radius;
        for ring in 0..=RINGS {
            // Rings of equal area, and the edge.
            let r = radius * ((ring as f32 + 0.5) / RINGS as f32).sqrt().min(0.9999);
            for point in 0..ON_A_RING {
                let turn = (point as f32 + 0.5 * (ring % 2) as f32) / ON_A_RING as f32;
                let (sin, cos) = libm::sincosf(std::f32::consts::TAU * turn);
                let foot = middle + (across * cos + along * sin) * r;
                let ray = Ray::new(foot + normal * diameter, -normal).up_to(2.0 * diameter);
                let Some(hit) = geometry.intersect(&ray) else {
                    probe.missing += 1.0;
                    continue;
                };
                let surface = geometry.surface(&hit);
                let height = (surface.position - middle).dot(normal);
                probe.highest = probe.highest.max(height);
                probe.lowest = probe.lowest.min(height);
                let outwards = surface.geometric_normal;
                let side = outwards.dot(normal).signum();
                probe.mean_normal += outwards * side;
            }
        }
        probe.missing /= ((RINGS + 1) * ON_A_RING) as f64;
        probe
    }
}

/// The point of the surface over x and y of the object's own frame, and its adaxial normal.
fn at_point(stage: &Stage<'_>, object: &Object, at: DVec2) -> Option<(Vec3, Vec3)> {
    let geometry = &stage.geometry;
    let (least, most) = geometry.bounds();
    let reach = (most - least).length().max(1e-6);
    let to_world = |z: f64| {
        let point = object.to_world.transform_point3(DVec3::new(at.x, at.y, z));
        (point - geometry.origin()).as_vec3()
    };
    let along = (to_world(1.0) - to_world(0.0)).try_normalize()?;
    let down = -along;
    // From farther than any part of it.
    let middle = 0.5 * (least + most);
    let height = (middle - to_world(0.0)).dot(along) + 2.0 * reach;
    let ray = Ray::new(to_world(0.0) + along * height, down);
    let hit = geometry.intersect(&ray)?;
    let surface = geometry.surface(&hit);
    Some((surface.position, surface.geometric_normal))
}

/// The point of the surface with these texture coordinates, and its normal.
fn at_uv(geometry: &Geometry, uv: Vec2) -> Option<(Vec3, Vec3)> {
    (0..geometry.instances()).find_map(|number| {
        let mesh = geometry.mesh(geometry.instance(number).mesh);
        let to_world = geometry.to_world(number);
        let uvs = mesh.uvs()?;
        mesh.triangles().iter().find_map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| uvs[vertex as usize]);
            let (first, second, to) = (b - a, c - a, uv - a);
            let area = first.perp_dot(second);
            let (b1, b2) = (to.perp_dot(second) / area, first.perp_dot(to) / area);
            if !(area != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) {
                return None;
            }
            let [a, b, c] = triangle.map(|vertex| {
                let point = mesh.positions()[vertex as usize];
                to_world.transform_point3(point)
            });
            let mirrors = to_world.matrix3.determinant().signum();
            let normal = (b - a).cross(c - a).try_normalize()? * mirrors;
            Some((a + (b - a) * b1 + (c - a) * b2, normal))
        })
    })
}
