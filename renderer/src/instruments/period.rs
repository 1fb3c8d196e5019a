//! A box that repeats itself without end along x and y.

use std::ops::RangeInclusive;

use glam::{Vec2, Vec3};

use super::InstrumentError;
use super::stage::Stage;
use super::walk::Course;
use crate::geometry::{GeometryError, Hit, Ray};
use crate::scene::description::Description;
use crate::scene::world::World;

/// Most times that a ray enters the box anew without a hit; then it counts as having left. A ray
/// needs a slope below 1e-5 for a box as high as wide.
const MOST_TURNS: u32 = 100_000;

/// Most copies of an instance along an axis that reach into the box.
const MOST_COPIES: u32 = 100;

/// Share of the box's size by which instances are taken to reach into it at the least.
const TOUCH: f32 = 1e-6;

/// A box, open at the top and below, whose sides are joined: what leaves at one comes in at the
/// opposite one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Period {
    pub(super) least: Vec2,
    pub(super) most: Vec2,
    /// Heights below and above everything that stands in it, m.
    pub(super) heights: [f32; 2],
}

impl Course for Period {
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Option<Hit>, f32) {
        let mut gone = 0.0;
        for _ in 0..MOST_TURNS {
            let (t_side, axis) = self.side(ray);
            ray.t_max = t_side;
            if let Some(hit) = stage.geometry.intersect(ray) {
                return (Some(hit), gone);
            }
            let height = ray.origin.z + ray.direction.z * t_side;
            if !t_side.is_finite() || !(self.heights[0]..=self.heights[1]).contains(&height) {
                return (None, gone);
            }
            gone += t_side;
            ray.origin += ray.direction * t_side;
            ray.origin[axis] = if ray.direction[axis] > 0.0 {
                self.least[axis]
            } else {
                self.most[axis]
            };
        }
        (None, gone)
    }
}

impl Period {
    /// How far it is to the side by which a ray leaves, in lengths of its direction, and the axis
    /// across that side.
    fn side(&self, ray: &Ray) -> (f32, usize) {
        let to_side = |axis: usize| {
            let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
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
        if x <= y { (x, 0) } else { (y, 1) }
    }

    /// The instances of a world that reach into the box, those of its copies included, without lamps.
    ///
    /// What reaches beyond two opposite sides, as ground does, is not repeated across them.
    pub(super) fn stage<'w>(
        [least, most]: [Vec2; 2],
        world: &'w World,
        scene: &Description,
        at: &str,
    ) -> Result<(Stage<'w>, Self), InstrumentError> {
        let size = most - least;
        let mut places = Vec::new();
        for number in 0..world.objects.len() as u32 {
            if world.objects[number as usize].light.is_some() {
                continue;
            }
            let (from, to) = world.geometry.bounds_of(number);
            let [x, y] = [0, 1].map(|axis| {
                let touch = TOUCH * size[axis];
                if from[axis] <= least[axis] + touch && to[axis] >= most[axis] - touch {
                    return 0..=0;
                }
                let first = ((least[axis] - touch - to[axis]) / size[axis]).ceil();
                let last = ((most[axis] + touch - from[axis]) / size[axis]).floor();
                first as i32..=last as i32
            });
            let copies = |range: &RangeInclusive<i32>| range.end().abs_diff(*range.start());
            if copies(&x).max(copies(&y)) > MOST_COPIES && !x.is_empty() && !y.is_empty() {
                return Err(InstrumentError::TooWide {
                    at: at.to_owned(),
                    object: scene.objects[world.objects[number as usize].object]
                        .name
                        .clone(),
                    most: MOST_COPIES,
                });
            }
            for i in x {
                for j in y.clone() {
                    let by = Vec2::new(i as f32, j as f32) * size;
                    places.push((number, by.extend(0.0)));
                }
            }
        }
        let refuse = |source: GeometryError| InstrumentError::Geometry {
            at: at.to_owned(),
            source,
        };
        let stage = Stage::new(world, &places).map_err(refuse)?;
        let (low, high) = stage.geometry.bounds();
        let margin =
            1e-4 * (high.z - low.z).max(size.min_element()) + 1e-6 * high.abs().max_element();
        let period = Self {
            least,
            most,
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
