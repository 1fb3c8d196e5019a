//! The surface point of a hit, and rays that leave it.

use glam::{DVec3, Mat3, Vec2, Vec3};

use super::frame::Frame;
use super::mesh::TriangleMesh;
use super::placement::Placement;
use super::ray::{Hit, Ray};

/// Half the distance between 1 and the next `f32`: the relative error of one rounding.
const ROUNDING: f64 = 1.0 / 16_777_216.0;

/// Share of the distance that a ray of [`SurfacePoint::spawn_to`] leaves out at its target.
const SHADOW_GAP: f32 = 1e-4;

/// Cosine from the normal below which a ray of [`SurfacePoint::spawn_whole`] would leave out too
/// much.
const LEAST_SLOPE: f32 = 0.01;

/// Cosine between the two normals below which a point no longer rises in full over its triangle.
const LEAST_COSINE: f32 = 0.1;

/// A point of a surface, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position, m, computed from the barycentrics and so on the triangle up to one rounding.
    pub position: Vec3,
    /// Offset, m, > 0: a point this far from `position` along the geometric normal lies on that
    /// side of the triangle for every ray test.
    pub position_error: f32,
    /// Unit. In the mesh's own frame faces are counter-clockwise seen from its side. Instances
    /// transform it as a normal, so in a mirrored closed mesh it still points outwards.
    pub geometric_normal: Vec3,
    /// Unit. Interpolated from the mesh's normals, turned to the side of the geometric normal; that
    /// normal itself where the mesh has none.
    pub shading_normal: Vec3,
    /// How far, m, on the side of the geometric normal and on the other, a point must rise from the
    /// triangle so that nothing of the triangle lies above the plane of the shading normal through
    /// it; 0 where the mesh has no normals.
    pub rise: [f32; 2],
    /// Unit, at right angles to the shading normal up to rounding: the direction in which v grows,
    /// or some fixed direction where the mesh has no uvs or they do not span the triangle.
    pub tangent: Vec3,
    /// Interpolated; the weights of the second and third vertex if the mesh has none.
    pub uv: Vec2,
    /// Number of the instance.
    pub instance: u32,
    /// Number of the triangle in the instance's mesh.
    pub triangle: u32,
}

impl SurfacePoint {
    /// The frame of the shading normal and the tangent.
    #[inline]
    pub fn frame(&self) -> Frame {
        let (normal, along) = (self.shading_normal, self.tangent);
        Frame {
            across: along.cross(normal),
            along,
            normal,
        }
    }

    /// The ray that leaves this point in `direction` (any length), `t` from 0 to infinity. It
    /// starts beside the surface, on the side to which it goes, and never hits its own triangle.
    pub fn spawn(&self, direction: Vec3) -> Ray {
        Ray::new(self.beside(direction), direction)
    }

    /// The same ray, but from the point itself, so that the way to a hit is whole: what is missing
    /// beside the surface counts where a metre of a medium is hundreds of mean free paths. What lies
    /// within the point's error of the surface is left out. Nearly along the surface it is
    /// [`SurfacePoint::spawn`].
    pub fn spawn_whole(&self, direction: Vec3) -> Ray {
        let slope = direction.dot(self.geometric_normal).abs();
        if slope < LEAST_SLOPE * direction.length() {
            return self.spawn(direction);
        }
        Ray::new(self.position, direction).starting_at(1.001 * self.position_error / slope)
    }

    /// The ray from this point to `target`: `t` is 0 here and 1 there, and ends a ten-thousandth
    /// before it.
    pub fn spawn_to(&self, target: Vec3) -> Ray {
        Self::shadow(self.beside(target - self.position), target)
    }

    /// Whether the shading normal differs from the geometric one.
    #[inline]
    pub fn is_smooth(&self) -> bool {
        self.rise != [0.0, 0.0]
    }

    /// Whether a direction goes to one side of the shading normal's plane and to the other of the
    /// triangle. None does where the mesh has no normals.
    #[inline]
    pub fn is_between_planes(&self, direction: Vec3) -> bool {
        self.is_smooth()
            && direction.dot(self.geometric_normal) * direction.dot(self.shading_normal) < 0.0
    }

    /// Where a ray starts that leaves between the planes: over the triangle, on the side of the
    /// shading normal to which it goes, and so high that it passes over the triangle.
    pub fn raised(&self, direction: Vec3) -> Vec3 {
        let way = self.way_up(direction);
        way.origin() + way.direction() * self.rise[self.side_of(direction)]
    }

    /// The way that must be free for such a ray: from beside the triangle up to where the ray
    /// starts, and a little beyond.
    pub(crate) fn way_up(&self, direction: Vec3) -> Ray {
        let side = self.side_of(direction);
        let up = self.geometric_normal * [1.0, -1.0][side];
        Ray::new(self.position + up * self.position_error, up)
            .up_to(1.01 * self.rise[side] + self.position_error)
    }

    /// The side of the shading normal to which a direction goes: 0, or 1 against it.
    fn side_of(&self, direction: Vec3) -> usize {
        usize::from(direction.dot(self.shading_normal) < 0.0)
    }

    /// The ray from any point to `target`, likewise.
    pub fn shadow(origin: Vec3, target: Vec3) -> Ray {
        Ray::new(origin, target - origin).up_to(1.0 - SHADOW_GAP)
    }

    /// The origin of a ray in `direction`.
    fn beside(&self, direction: Vec3) -> Vec3 {
        let side = if direction.dot(self.geometric_normal) < 0.0 {
            -1.0
        } else {
            1.0
        };
        self.position + self.geometric_normal * (side * self.position_error)
    }

    /// The surface at a hit of a triangle with these corners, in the frame in which the placement's
    /// mesh is traced.
    pub(super) fn at(
        hit: &Hit,
        corners: [Vec3; 3],
        mesh: &TriangleMesh,
        placement: &Placement,
    ) -> Self {
        let weights = {
            let (b1, b2) = (f64::from(hit.b1), f64::from(hit.b2));
            [1.0 - b1 - b2, b1, b2]
        };
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let local = a * weights[0] + b * weights[1] + c * weights[2];
        let world = placement.to_world(local);

        let cross = (b - a).cross(c - a);
        let normal_world = placement.normal_to_world(cross);
        // Of a sheared mesh not the triangle's area in the world.
        let per_length = 1.0 / normal_world.length();
        let geometric = (normal_world * per_length).as_vec3();
        let position = world.as_vec3();

        let [e1, e2] = [b - a, c - a].map(DVec3::as_vec3);
        let edges = [e1, e2, e2 - e1].map(Vec3::length_squared);
        let longest2 = edges[0].max(edges[1]).max(edges[2]);
        let error = {
            // Rounding `world` to f32, and then the sum that moves off the surface.
            let rounding = geometric.abs().dot(position.abs()) * (2.0 * ROUNDING as f32);
            // Across the triangle in its own frame, times twice its area: the next ray's origin
            // carried into the mesh's frame in f32, with five roundings a coordinate, one of them
            // in the matrix,
            let carried = placement.to_local_size(position) * (6.0 * ROUNDING as f32);
            let carried = (cross * per_length).abs().as_vec3().dot(carried);
            // and the triangle test: vertices relative to the origin, the shear, and edge functions
            // whose error counts the more the thinner the triangle is. (Twice the area is at most
            // the square of the longest edge.)
            let thinness = longest2 * per_length as f32;
            let tested = 32.0 * ROUNDING as f32 * longest2.sqrt() * thinness;
            // The bound itself is rounded.
            (rounding + carried + tested) * 1.000_01
        };

        // For directions and texture coordinates single precision is enough.
        let weights = weights.map(|weight| weight as f32);
        let mut normal = geometric;
        let mut rise = [0.0; 2];
        let vertices = || mesh.triangles()[hit.triangle as usize].map(|index| index as usize);
        if let Some(normals) = mesh.normals() {
            let [na, nb, nc] = vertices().map(|vertex| normals[vertex]);
            let interpolated = na * weights[0] + nb * weights[1] + nc * weights[2];
            if let Some(unit) = (placement.normals_f32 * interpolated).try_normalize() {
                // The winding defines the sides; normals given for the other side are flipped.
                normal = if unit.dot(geometric) < 0.0 {
                    -unit
                } else {
                    unit
                };
                let plane = placement.direction_to_local(normal);
                let climbs = [e1, e2].map(|edge| edge.dot(plane));
                rise = rise_over(climbs, weights, normal.dot(geometric));
            }
        }

        let mut uv = Vec2::new(weights[1], weights[2]);
        let mut tangent = None;
        if let Some(uvs) = mesh.uvs() {
            let uvs = vertices().map(|vertex| uvs[vertex]);
            uv = uvs[0] * weights[0] + uvs[1] * weights[1] + uvs[2] * weights[2];
            tangent = along_v([e1, e2], uvs, &placement.linear_f32, normal);
        }
        Self {
            position,
            position_error: error.max(f32::MIN_POSITIVE),
            geometric_normal: geometric,
            shading_normal: normal,
            rise,
            tangent: tangent.unwrap_or_else(|| any_tangent(normal)),
            uv,
            instance: hit.instance,
            triangle: hit.triangle,
        }
    }
}

/// How texture coordinates lie on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureScale {
    /// Length of ∂p/∂v in the world, m, > 0.
    pub metres_per_v: f32,
    /// Whether u runs against the x axis of the frame whose z axis is the normal and whose y axis
    /// is ∂p/∂v, as on a mirrored leaf.
    pub is_mirrored: bool,
}

impl TextureScale {
    /// The scale at a hit of a triangle with these corners, in the frame in which the placement's
    /// mesh is traced.
    pub(super) fn at(
        hit: &Hit,
        [a, b, c]: [Vec3; 3],
        mesh: &TriangleMesh,
        placement: &Placement,
    ) -> Option<Self> {
        let vertices = mesh.triangles()[hit.triangle as usize].map(|index| index as usize);
        let uvs = mesh.uvs()?;
        let [at_a, at_b, at_c] = vertices.map(|vertex| uvs[vertex]);
        let (first, second) = (at_b - at_a, at_c - at_a);
        let determinant = first.perp_dot(second);
        if determinant == 0.0 {
            return None;
        }
        let derivative = (c - a) * (first.x / determinant) - (b - a) * (second.x / determinant);
        let length = (placement.linear * derivative.as_dvec3()).length() as f32;
        (length > 0.0 && length.is_finite()).then_some(Self {
            metres_per_v: length,
            is_mirrored: (determinant < 0.0) != placement.is_mirrored,
        })
    }
}

/// How texture coordinates change along unit directions in the plane of a triangle with these
/// corners, in the frame in which the placement's mesh is traced, 1/m.
///
/// A direction is `α e₁ + β e₂` of two edges, and the change `α Δuv₁ + β Δuv₂`.
pub(super) fn uv_per_metre(
    hit: &Hit,
    [a, b, c]: [Vec3; 3],
    (mesh, placement): (&TriangleMesh, &Placement),
    directions: [Vec3; 2],
) -> [Vec2; 2] {
    let vertices = mesh.triangles()[hit.triangle as usize].map(|index| index as usize);
    // Without texture coordinates the weights of the second and the third vertex stand for them.
    let (first, second) = mesh.uvs().map_or((Vec2::X, Vec2::Y), |uvs| {
        let [at_a, at_b, at_c] = vertices.map(|vertex| uvs[vertex]);
        (at_b - at_a, at_c - at_a)
    });
    let [e1, e2] = [b - a, c - a].map(|edge| placement.linear * edge.as_dvec3());
    let normal = e1.cross(e2);
    let square = normal.length_squared();
    directions.map(|direction| {
        if square == 0.0 {
            return Vec2::ZERO;
        }
        let direction = direction.as_dvec3();
        let alpha = direction.cross(e2).dot(normal) / square;
        let beta = e1.cross(direction).dot(normal) / square;
        first * alpha as f32 + second * beta as f32
    })
}

/// Unit direction of ∂p/∂v in the world, at right angles to `normal`; `None` if the uvs do not span
/// the triangle.
///
/// With e = ∂p/∂u Δu + ∂p/∂v Δv on two edges: ∂p/∂v = (Δu₁ e₂ − Δu₂ e₁) / (Δu₁ Δv₂ − Δu₂ Δv₁).
fn along_v(edges: [Vec3; 2], uvs: [Vec2; 3], linear: &Mat3, normal: Vec3) -> Option<Vec3> {
    let (first, second) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    let determinant = first.perp_dot(second);
    // Below this the uvs' own rounding decides the direction.
    let lengths2 = first.length_squared() * second.length_squared();
    if determinant * determinant <= lengths2 * 1e-12 {
        return None;
    }
    // Only its direction counts.
    let derivative = (edges[1] * first.x - edges[0] * second.x) * determinant.signum();
    let direction = *linear * derivative;
    let flat = direction - normal * normal.dot(direction);
    let length2 = flat.length_squared();
    // If it is nearly parallel to the normal, only rounding is left.
    (length2 > 1e-12 * direction.length_squared()).then(|| flat / length2.sqrt())
}

/// [`SurfacePoint::rise`] of a point of a triangle with these weights, whose edges from the first
/// corner climb so far along the shading normal, which has this cosine to the geometric one.
fn rise_over([first, second]: [f32; 2], weights: [f32; 3], cosine: f32) -> [f32; 2] {
    let corner = -(weights[1] * first + weights[2] * second);
    let corners = [corner, corner + first, corner + second];
    let highest = corners.into_iter().fold(0.0, f32::max);
    let lowest = corners.into_iter().fold(0.0, f32::min);
    // A normal nearly in the plane of the triangle would ask for a point far away.
    let per_height = 1.0 / cosine.max(LEAST_COSINE);
    [highest * per_height, -lowest * per_height]
}

/// Some unit vector at right angles to a unit vector, without a branch that flips between
/// neighbours except at z = 0.
///
/// # Source
///
/// \[duff2017\], the second vector of its basis.
fn any_tangent(n: Vec3) -> Vec3 {
    let sign = if n.z.is_sign_negative() { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    Vec3::new(b, sign + n.y * n.y * a, -n.y)
}

#[cfg(test)]
mod tests;
