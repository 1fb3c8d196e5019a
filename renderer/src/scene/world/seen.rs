//! What of a scene its picture shows, and where its rays are traced for that.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::camera::frustum::{Frustum, Glimpse};
use crate::camera::view::{Near, View};
use crate::geometry::instance::FAR;
use crate::geometry::{Instance, TriangleMesh, origin_near};
use crate::scene::description::{Description, Places};
use trace::world::WorldObjects;

/// How far before what is seen rays start at least, m.
const MARGIN: f64 = 1.0;

/// Rounding of a place over the size of what is there from which on it is reported.
const COARSE: f64 = 0.01;

/// Half the distance between 1 and the next number in single precision.
const ROUNDING: f64 = 1.0 / 16_777_216.0;

/// What of a scene its picture shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// What of it ends nearest to the camera, with its number.
    first: Option<(u32, Glimpse)>,
    /// Least distance along the axis of the camera at which anything is seen, m.
    depth: f64,
    /// Least and greatest place in the picture at which anything is seen.
    places: [DVec2; 2],
    /// Whether the camera and everything in the scene are near the scene's origin.
    is_near: bool,
    /// Least and greatest coordinates of all that there is, m.
    bounds: [DVec3; 2],
}

impl Seen {
    const NOTHING: Self = Self {
        first: None,
        depth: f64::INFINITY,
        places: [DVec2::INFINITY, DVec2::NEG_INFINITY],
        is_near: true,
        bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
    };

    /// What a view shows of the instances, each taken for the box around its mesh.
    pub(super) fn of(
        scene: &Description,
        view: &View,
        meshes: &[TriangleMesh],
        instances: &[Instance],
    ) -> Self {
        let film = &scene.film;
        let frustum = Frustum::new(view, [film.width, film.height], film.filter_radius);
        let seen = |(number, instance): (usize, &Instance)| {
            let corners = corners_of(instance, meshes);
            let glimpse = frustum.glimpse(corners);
            Self {
                first: glimpse.map(|glimpse| (number as u32, glimpse)),
                depth: glimpse.map_or(f64::INFINITY, |glimpse| glimpse.depths[0]),
                places: glimpse.map_or(Self::NOTHING.places, |glimpse| glimpse.places),
                is_near: corners.iter().all(|corner| corner.length() <= FAR),
                bounds: [
                    corners.into_iter().fold(DVec3::INFINITY, DVec3::min),
                    corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max),
                ],
            }
        };
        let all = instances.par_iter().enumerate().map(seen);
        let mut all = all.reduce(|| Self::NOTHING, Self::and);
        all.is_near &= view.position.length() <= FAR;
        all
    }

    /// What is seen of either.
    fn and(self, other: Self) -> Self {
        let ends = |(number, glimpse): &(u32, Glimpse)| (glimpse.depths[1], *number);
        let first = [self.first, other.first].into_iter().flatten();
        Self {
            first: first.min_by(|a, b| {
                let [(a, first), (b, second)] = [ends(a), ends(b)];
                a.total_cmp(&b).then(first.cmp(&second))
            }),
            depth: self.depth.min(other.depth),
            places: [
                self.places[0].min(other.places[0]),
                self.places[1].max(other.places[1]),
            ],
            is_near: self.is_near && other.is_near,
            bounds: [
                self.bounds[0].min(other.bounds[0]),
                self.bounds[1].max(other.bounds[1]),
            ],
        }
    }

    /// Where the rays of the picture are traced: around the nearest point of what ends nearest to the
    /// camera. Whatever is around everything, as a dome is, does not end near.
    pub(super) fn near(&self) -> Near {
        let Some((_, glimpse)) = self.first.filter(|_| !self.is_near) else {
            return Near::default();
        };
        let distance = (self.depth - MARGIN).floor();
        Near {
            origin: origin_near(glimpse.nearest),
            distance: if distance > FAR { distance } else { 0.0 },
        }
    }

    /// Notes on a picture that shows nothing, and on objects whose places are coarse in it.
    pub(super) fn notes(
        &self,
        scene: &Description,
        meshes: &[TriangleMesh],
        (instances, objects): (&[Instance], &WorldObjects),
    ) -> Vec<String> {
        let mut notes = Vec::new();
        notes.extend(self.on_nothing(scene));
        let origin = self.near().origin;
        // By object: how many places are coarse, the greatest rounding, and the size there.
        let mut coarse: BTreeMap<usize, (usize, f64, f64)> = BTreeMap::new();
        for (number, instance) in instances.iter().enumerate() {
            let [first, .., last] = corners_of(instance, meshes);
            let size = (last - first).length();
            let rounding = (instance.translation - origin).abs().max_element() * ROUNDING;
            if rounding > COARSE * size {
                let own = coarse.entry(objects[number].object).or_default();
                own.0 += 1;
                if rounding > own.1 {
                    (own.1, own.2) = (rounding, size);
                }
            }
        }
        notes.extend(coarse.into_iter().map(|(object, (count, rounding, size))| {
            format!(
                "objects.{}: {count} of its parts are so far from what the picture shows that their \
                 places are rounded by up to {rounding:.1e} m, and they are {size:.1e} m large: \
                 render what is near and what is far apart",
                scene.objects[object].name
            )
        }));
        notes
    }

    /// A note on a picture in which nothing is to be seen.
    fn on_nothing(&self, scene: &Description) -> Option<String> {
        let [least, most] = self.bounds;
        if scene.objects.is_empty() || !(least.is_finite() && most.is_finite()) {
            return None;
        }
        if self.first.is_none() {
            // To the millimetre; −0 is 0.
            let middle = (500.0 * (least + most)).round() / 1000.0 + DVec3::ZERO;
            return Some(format!(
                "camera: no object is in the picture; the middle of all objects is at [{}, {}, {}] m, \
                 which `look_at_m` may name",
                middle.x, middle.y, middle.z
            ));
        }
        // Places go from −1 to 1.
        let size = DVec2::new(scene.film.width.into(), scene.film.height.into());
        let pixels = ((self.places[1] - self.places[0]) * 0.5 * size).max_element();
        (pixels < 1.0).then(|| {
            format!(
                "camera: all objects in the picture together are {pixels:.1e} pixels large; check \
                 the units of `position_m` and of the objects"
            )
        })
    }
}

/// The corners of the box around an instance's mesh, in the scene.
pub(super) fn corners_of(instance: &Instance, meshes: &[TriangleMesh]) -> [DVec3; 8] {
    let (least, most) = meshes[instance.mesh as usize].bounds();
    corners_between([least, most].map(Vec3::as_dvec3), &instance.to_scene())
}

/// The images of the corners of a box, which lies between two of them.
pub(super) fn corners_between(sides: [DVec3; 2], to: &DAffine3) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        let [x, y, z] = [0, 1, 2].map(|axis| sides[corner >> axis & 1][axis]);
        to.transform_point3(DVec3::new(x, y, z))
    })
}

/// Most corners of triangles that are looked at one by one.
const MOST_CORNERS: usize = 4_000_000;

/// Where the objects of a world are.
#[derive(Clone, Copy)]
pub(super) struct ObjectPlaces<'a> {
    pub(super) meshes: &'a [TriangleMesh],
    pub(super) instances: &'a [Instance],
    pub(super) objects: &'a WorldObjects,
}

impl ObjectPlaces<'_> {
    fn parts(&self, object: Option<usize>) -> impl Iterator<Item = &Instance> {
        let instances = self.instances.iter().enumerate();
        let parts = instances.filter(move |(number, _)| {
            object.is_none_or(|object| self.objects[*number].object == object)
        });
        parts.map(|(_, instance)| instance)
    }
}

impl Places for ObjectPlaces<'_> {
    /// The middle of the box, along the axes of the scene, around all parts of an object in all its
    /// places, m.
    ///
    /// Each part counts with its box in its own frame, so that an object with a million places costs
    /// no more than its places.
    fn middle(&self, object: usize) -> DVec3 {
        let corners = self
            .parts(Some(object))
            .flat_map(|part| corners_of(part, self.meshes));
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in corners {
            least = least.min(corner);
            most = most.max(corner);
        }
        0.5 * (least + most)
    }

    /// The corners of all triangles or, if these are too many, of the boxes around the parts.
    fn around(&self, object: Option<usize>) -> Vec<DVec3> {
        let mesh = |part: &Instance| &self.meshes[part.mesh as usize];
        let corners: usize = self
            .parts(object)
            .map(|part| mesh(part).positions().len())
            .sum();
        if corners > MOST_CORNERS {
            let boxes = self
                .parts(object)
                .flat_map(|part| corners_of(part, self.meshes));
            return boxes.collect();
        }
        let all = self.parts(object).flat_map(|part| {
            let to_scene = part.to_scene();
            let places = mesh(part).positions().iter();
            places.map(move |place| to_scene.transform_point3(place.as_dvec3()))
        });
        all.collect()
    }
}
