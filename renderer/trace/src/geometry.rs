//! Triangles in space: meshes, their instances, and the nearest hits of rays.
//!
//! A [`TriangleMesh`] is cleaned when it is made, so later code never sees a vertex that is not
//! finite or a face without area. [`Geometry`] holds one tree for each mesh, in a frame centred on
//! the mesh, and one tree over the instances; meshes that stand in one place each share one tree in
//! the world where its precision is enough. It is immutable and shared by every thread.
//!
//! - **In**: meshes in `f32`, affine instances with their places in `f64`, metres, and the origin
//!   around which rays are traced.
//! - **Out**: the nearest [`Hit`] of a [`Ray`], whether anything is hit, and the [`SurfacePoint`]
//!   of a hit.
//! - **Always true**: a hit is a function of the ray, the triangle and the meshes that are traced in
//!   the same frame. Trees only cull, boxes are conservative, and equal distances go to the smaller
//!   (instance, triangle); so the layout of a tree never reaches a picture. No ray slips between two
//!   triangles of a mesh that share an edge.
//! - **Left out**: motion, curves, and watertight seams between *different* meshes, which are only
//!   as tight as `f32` allows.
//!
//! ```
//! use glam::{DAffine3, DVec3, Vec3};
//! use trace::geometry::{Geometry, Instance, Ray, TriangleMesh};
//!
//! let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
//! let triangle = TriangleMesh::new(corners, None, None, vec![[0, 1, 2]])?;
//! // The triangle a metre up, and once more two metres up.
//! let at = |height| Instance::new(0, &DAffine3::from_translation(DVec3::Z * height));
//! let geometry = Geometry::build(vec![triangle], vec![at(1.0), at(2.0)])?;
//! let ray = Ray::new(Vec3::new(0.2, 0.2, 0.0), Vec3::Z);
//! let hit = geometry.intersect(&ray).expect("it is above");
//! assert_eq!((hit.instance, hit.t), (0, 1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod binary_tree;
mod bounds;
mod bvh;
mod hilbert;
mod slab;
mod triangle;
mod wide_tree;

pub mod assembly;
pub mod frame;
pub mod import;
pub mod instance;
pub mod mesh;
mod placement;
pub mod ray;
pub mod scatter;
pub mod shapes;
pub mod stored_number;
pub mod surface;

pub use assembly::{Geometry, GeometryError, Hit};
pub use import::{ImportError, import};
pub use instance::{Instance, origin_near};
pub use mesh::{DroppedFaces, MeshError, TriangleMesh};
pub use ray::Ray;
pub use surface::{SurfacePoint, TextureScale};

#[cfg(test)]
mod testing;
