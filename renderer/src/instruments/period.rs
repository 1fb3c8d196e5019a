//! A box that repeats itself without end along x and y.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::error::{InstrumentError, Problem};
use super::flux::{Course, LANES, Straight};
use super::measurement::Measurement;
use super::stage::Stage;
use crate::geometry::{Ray, origin_near};
use crate::spectrum::Lanes;
use crate::walk::Ahead;
use trace::world::World;

/// Most times that a ray passes the sides of the box from one surface to the next; then it is cut. In
/// a box as high as wide these are rays within a thousandth of a degree of the horizon.
pub const MOST_TURNS: u32 = 100_000;

/// Greatest height of what stands in the box over the box's smaller side. Diffuse light passes the
/// sides some one and a half times as often as that.
const MOST_HEIGHT: f64 = 1000.0;

/// Share of the box's size, or of its distance from the origin, within which a place counts as being
/// on a side.
const TOUCH: f64 = 1e-6;

/// The sides of a box in the scene.
struct Sides {
    least: DVec2,
    most: DVec2,
    /// Distances from the sides within which a place counts as being on them, m.
    touch: DVec2,
}

/// A box, open at the top and below, whose sides are joined: what leaves at one comes in at the
/// opposite one. Its coordinates are around the origin of its stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Period {
    pub(super) least: Vec2,
    pub(super) most: Vec2,
    /// Distances from the sides within which a place counts as being on them, m.
    touch: Vec2,
    /// Heights below and above everything that stands in it, m.
    pub(super) heights: [f32; 2],
}

impl Course for Period {
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Ahead, f32) {
        let mut gone = 0.0;
        let end = ray.t_max();
        for _ in 0..MOST_TURNS {
            let (t_side, t_beyond, axis) = self.side(ray);
            let to_end = end - gone;
            *ray = ray.up_to(t_beyond.min(to_end));
            if let Some(hit) = stage.geometry.intersect(ray) {
                return (Ahead::Hit(hit), gone);
            }
            if to_end <= t_side {
                return (Ahead::Nothing, gone);
            }
            *ray = ray.up_to(f32::INFINITY);
            if !self.enter(ray, t_side, axis) {
                return (Ahead::Nothing, gone);
            }
            gone += t_side;
        }
        (Ahead::Unknown, gone)
    }

    fn is_free(&self, stage: &Stage<'_>, way: &Ray) -> bool {
        // What lies beyond the sides may be missing there.
        let end = (way.origin() + way.direction() * way.t_max()).truncate();
        let is_within = end.cmpge(self.least).all() && end.cmple(self.most).all();
        is_within && Straight.is_free(stage, way)
    }

    fn is_clear(&self, stage: &Stage<'_>, mut ray: Ray, carried: &Lanes<LANES>) -> bool {
        for _ in 0..MOST_TURNS {
            let (t_side, t_beyond, axis) = self.side(&ray);
            ray = ray.up_to(t_beyond);
            if stage.geometry.occluded(&ray) {
                return false;
            }
            if !self.enter(&mut ray, t_side, axis) {
                return true;
            }
        }
        stage.cuts.add(*carried);
        false
    }
}

impl Sides {
    fn of([least, most]: [DVec2; 2]) -> Self {
        let origin = origin_near((0.5 * (least + most)).extend(0.0)).truncate();
        let reach = (least - origin).abs().max((most - origin).abs());
        Self {
            least,
            most,
            touch: TOUCH * reach.max(most - least),
        }
    }

    /// Where an instance stands along an axis: in how many boxes' lengths from its own place its
    /// copies reach into the box; `None` if it is left out.
    fn copies(&self, axis: usize, [from, to]: [f64; 2]) -> Option<RangeInclusive<i32>> {
        let (least, most, touch) = (self.least[axis], self.most[axis], self.touch[axis]);
        if from <= least + touch && to >= most - touch {
            return Some(0..=0);
        }
        let middle = 0.5 * (from + to);
        if middle < least - touch || middle >= most - touch {
            return None;
        }
        let size = most - least;
        let first = ((least - touch - to) / size).ceil();
        let last = ((most + touch - from) / size).floor();
        Some(first as i32..=last as i32)
    }

    /// Where each instance of a world but lamps stands, nowhere if it is left out; with the least and
    /// the greatest height of its box.
    fn places(&self, world: &World) -> Vec<(u32, [f64; 2], Vec<DVec3>)> {
        let numbers = 0..world.objects.len() as u32;
        let own = numbers.filter(|&number| world.objects[number as usize].light.is_none());
        own.map(|number| {
            let (from, to) = world.geometry.bounds_of(number);
            let along = |axis: usize| self.copies(axis, [from[axis], to[axis]]);
            let mut places = Vec::new();
            if let (Some(x), Some(y)) = (along(0), along(1)) {
                for i in x {
                    for j in y.clone() {
                        let by = DVec2::new(f64::from(i), f64::from(j)) * (self.most - self.least);
                        places.push(by.extend(0.0));
                    }
                }
            }
            (number, [from.z, to.z], places)
        })
        .collect()
    }
}

impl Period {
    /// Lets a ray that leaves by a side come in at the opposite one; `false` if it leaves above or
    /// below everything.
    fn enter(&self, ray: &mut Ray, t_side: f32, axis: usize) -> bool {
        let height = ray.origin().z + ray.direction().z * t_side;
        if !t_side.is_finite() || !(self.heights[0]..=self.heights[1]).contains(&height) {
            return false;
        }
        let mut origin = ray.origin() + ray.direction() * t_side;
        // By the size, not to the side: what starts beyond a surface on the side stays beyond it.
        let size = self.most[axis] - self.least[axis];
        origin[axis] -= size.copysign(ray.direction()[axis]);
        *ray = Ray::new(origin, ray.direction())
            .starting_at((ray.t_min() - t_side).max(0.0))
            .up_to(ray.t_max());
        true
    }

    /// How far it is to the side by which a ray leaves, and to where it is beyond any surface on a
    /// side, in lengths of its direction; and the axis across that side.
    fn side(&self, ray: &Ray) -> (f32, f32, usize) {
        let to_side = |axis: usize| {
            let (origin, direction) = (ray.origin()[axis], ray.direction()[axis]);
            let side = if direction > 0.0 {
                self.most[axis]
            } else {
                self.least[axis]
            };
            if direction == 0.0 {
                f32::INFINITY
            } else {
                // A ray may start beyond the side by the offset from its surface.
                ((side - origin) / direction).max(0.0)
            }
        };
        let [x, y] = [to_side(0), to_side(1)];
        let beyond = |axis: usize, t: f32| t + self.touch[axis] / ray.direction()[axis].abs();
        let t_beyond = beyond(0, x).min(beyond(1, y));
        if x <= y {
            (x, t_beyond, 0)
        } else {
            (y, t_beyond, 1)
        }
    }

    /// The objects of which parts are left out of a box, by number, each with how many.
    pub(super) fn left_out(within: [DVec2; 2], world: &World) -> BTreeMap<usize, usize> {
        let mut left_out = BTreeMap::new();
        for (number, _, places) in Sides::of(within).places(world) {
            if places.is_empty() {
                *left_out
                    .entry(world.objects[number as usize].object)
                    .or_insert(0) += 1;
            }
        }
        left_out
    }

    /// The object of each instance that stands in a box.
    pub(super) fn within(within: [DVec2; 2], world: &World) -> impl Iterator<Item = usize> {
        let places = Sides::of(within).places(world).into_iter();
        let own = places.filter(|(_, _, places)| !places.is_empty());
        own.map(|(number, _, _)| world.objects[number as usize].object)
    }

    /// The instances of a world that stand in the box, those of their copies included that reach
    /// into it from beyond its sides, without lamps.
    ///
    /// An instance stands in the box if the middle of its bounds does: of what goes on beyond the
    /// box, the same is not counted twice. What reaches beyond two opposite sides, as ground does,
    /// stands in it and is not repeated across them.
    pub(super) fn stage<'w>(
        measurement: &Measurement<'w>,
        within: [DVec2; 2],
    ) -> Result<(Stage<'w>, Self), InstrumentError> {
        let world = measurement.world;
        let mut heights = [f64::INFINITY, f64::NEG_INFINITY];
        let mut places: Vec<(u32, DVec3)> = Vec::new();
        // Its own height, m, and number.
        let mut tallest = (f64::NEG_INFINITY, 0);
        for (number, [low, high], own) in Sides::of(within).places(world) {
            if !own.is_empty() {
                heights = [heights[0].min(low), heights[1].max(high)];
                if high - low > tallest.0 {
                    tallest = (high - low, number);
                }
            }
            places.extend(own.into_iter().map(|by| (number, by)));
        }
        if places.is_empty() {
            return Err(measurement.refuse(Problem::NothingWithin));
        }
        let side = (within[1] - within[0]).min_element();
        if heights[1] - heights[0] > MOST_HEIGHT * side {
            let object = world.objects[tallest.1 as usize].object;
            return Err(measurement.refuse(Problem::TooHigh {
                heights,
                side,
                most: MOST_HEIGHT,
                object: measurement.object(object),
            }));
        }
        let middle = 0.5 * (within[0] + within[1]);
        let middle = middle.extend(0.5 * (heights[0] + heights[1]));
        let refuse = |source| measurement.refuse(Problem::Geometry(source));
        let stage = Stage::new(world, &places, middle).map_err(refuse)?;
        let (low, high) = stage.geometry.bounds();
        let origin = stage.geometry.origin().truncate();
        let [least, most] = within.map(|corner| (corner - origin).as_vec2());
        let size = most - least;
        let far = least.abs().max(most.abs()).max(size);
        let margin =
            1e-4 * (high.z - low.z).max(size.min_element()) + 1e-6 * high.abs().max_element();
        let period = Self {
            least,
            most,
            touch: TOUCH as f32 * far,
            heights: [low.z - margin, high.z + margin],
        };
        Ok((stage, period))
    }

    /// A point of the plane above everything, from a point of the unit square.
    pub(super) fn on_top(&self, [u, v]: [f32; 2]) -> Vec3 {
        let place = self.least + (self.most - self.least) * Vec2::new(u, v);
        place.extend(self.heights[1])
    }
}
