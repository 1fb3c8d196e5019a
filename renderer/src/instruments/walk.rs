//! Light followed from where it starts until it leaves, by the renderer's own scattering.

use glam::{Vec2, Vec3};

use super::LANES;
use super::stage::Stage;
use crate::geometry::{Hit, Ray};
use crate::integrator::cone::Cone;
use crate::integrator::encounter::Encounter;
use crate::integrator::leaf_walk::{LeafWalk, Leaving};
use crate::material::leaf::Inside;
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};

/// Weight, in the lane where it is greatest, below which Russian roulette is applied.
const ROULETTE_BELOW: f32 = 0.02;

/// Most scattering events of a path. Roulette ends paths long before, unless light is caught
/// between surfaces that absorb nothing; what such a path still carries counts as absorbed where
/// it is.
const MOST_EVENTS: u32 = 100_000;

/// One scattering event.
pub(super) struct Event {
    /// Number of the object in the scene.
    pub(super) object: usize,
    /// Where it is, m.
    pub(super) position: Vec3,
    /// Weight of the light that arrives.
    pub(super) before: Lanes<LANES>,
    /// Weight of the light that goes on. It may be more than arrives: only the mean over directions
    /// and over the roulette is not.
    pub(super) after: Lanes<LANES>,
    /// Whether the light comes straight from where it started.
    pub(super) is_first: bool,
}

/// Light that leaves.
pub(super) struct Escaped {
    /// Direction, unit.
    pub(super) direction: Vec3,
    /// Its weight.
    pub(super) weight: Lanes<LANES>,
}

/// The first hit of a ray, which may be moved on its way to it, and the distance that it went
/// before it was moved last; `None` if the ray leaves.
pub(super) trait Course {
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Option<Hit>, f32);
}

/// Rays that go straight on.
pub(super) struct Straight;

impl Course for Straight {
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Option<Hit>, f32) {
        (stage.geometry.intersect(ray), 0.0)
    }
}

/// How light is followed.
pub(super) struct Walk<'a, C> {
    pub(super) stage: &'a Stage<'a>,
    pub(super) course: &'a C,
    pub(super) wavelengths: &'a Wavelengths<LANES>,
    /// Number of ways, a power of 2, in which light goes on from the first event. Their random
    /// numbers are evenly spread, so that each kind of scattering there has nearly its share of
    /// them.
    pub(super) ways: u32,
}

/// Light on its way.
struct Leg {
    ray: Ray,
    cone: Cone,
    weight: Lanes<LANES>,
}

/// What is told of light on its way, in the order of what befalls it.
pub(super) trait Witness {
    /// It is scattered.
    fn event(&mut self, event: &Event);
    /// It leaves.
    fn escape(&mut self, escaped: &Escaped);
}

impl<C: Course> Walk<'_, C> {
    /// Follows light of weight 1 until all of it is absorbed or leaves. The first set of the stream
    /// is the caller's.
    pub(super) fn follow(&self, ray: Ray, stream: &Stream, witness: &mut impl Witness) {
        let (cone, weight) = (Cone::of_beam(), Lanes::ONE);
        let mut leg = Leg { ray, cone, weight };
        let Some(met) = self.meet(&mut leg, witness) else {
            return;
        };
        let share = 1.0 / self.ways as f32;
        for way in 0..self.ways {
            let mut stream = stream.part(way, self.ways);
            let mut next = self.scatter(&met, leg.weight * share, 0, &mut stream, witness);
            let mut event = 1;
            while let Some(mut leg) = next {
                let Some(met) = self.meet(&mut leg, witness) else {
                    break;
                };
                next = self.scatter(&met, leg.weight, event, &mut stream, witness);
                event += 1;
            }
        }
    }

    /// The surface that light meets; `None` if it leaves.
    fn meet(&self, leg: &mut Leg, witness: &mut impl Witness) -> Option<Met<'_>> {
        let (hit, gone) = self.course.next(self.stage, &mut leg.ray);
        let Some(hit) = hit else {
            witness.escape(&Escaped {
                direction: leg.ray.direction,
                weight: leg.weight,
            });
            return None;
        };
        let cone = leg.cone.from(gone);
        let geometry = &self.stage.geometry;
        let material = self.stage.material_of(hit.instance);
        let inside = material.inside().map(|inside| (inside, hit));
        let beam = (&leg.ray, &cone);
        let encounter = Encounter::new(geometry, material, beam, &hit, self.wavelengths);
        Some(Met {
            encounter,
            inside,
            object: self.stage.objects[hit.instance as usize].object,
        })
    }

    /// Light of a weight that goes on from a surface; `None` if nothing does.
    fn scatter(
        &self,
        Met {
            encounter,
            inside,
            object,
        }: &Met<'_>,
        weight: Lanes<LANES>,
        event: u32,
        stream: &mut Stream,
        witness: &mut impl Witness,
    ) -> Option<Leg> {
        stream.seek(1 + event);
        let numbers = stream.next4();
        let [.., roulette] = numbers;
        let leaving = match inside {
            Some((inside, hit)) => {
                let at = (hit, &encounter.surface, &encounter.frame, encounter.wo);
                let geometry = &self.stage.geometry;
                LeafWalk::new(geometry, *inside, at, self.wavelengths, numbers).through()
            }
            None => at_surface(encounter, numbers),
        };
        let mut after = leaving.map_or(Lanes::ZERO, |leaving| weight * leaving.weight);
        let greatest = after.max_lane();
        let below = ROULETTE_BELOW / self.ways as f32;
        if !greatest.is_finite() || event + 1 == MOST_EVENTS {
            after = Lanes::ZERO;
        } else if greatest < below {
            let survival = greatest / below;
            after = if roulette < survival {
                after * (1.0 / survival)
            } else {
                Lanes::ZERO
            };
        }
        witness.event(&Event {
            object: *object,
            position: encounter.surface.position,
            before: weight,
            after,
            is_first: event == 0,
        });
        let leaving = leaving.filter(|_| !after.is_zero())?;
        Some(Leg {
            ray: leaving.surface.spawn(leaving.towards),
            cone: Cone::scattered(encounter.width),
            weight: after,
        })
    }
}

/// Light that goes on from a surface which scatters it there.
fn at_surface(
    encounter: &Encounter<'_, LANES>,
    [lobe, x, y, _]: [f32; 4],
) -> Option<Leaving<LANES>> {
    let Encounter { bsdf, wo, .. } = encounter;
    let sample = bsdf.seen_from(*wo)?.sample(lobe, Vec2::new(x, y))?;
    Some(Leaving {
        towards: encounter.frame.to_world(sample.wi),
        pdf: None,
        weight: sample.weight * bsdf.flux_over_radiance(*wo, sample.wi),
        surface: encounter.surface,
    })
}

/// A surface that light meets.
struct Met<'a> {
    encounter: Encounter<'a, LANES>,
    /// What is inside, if light is followed through it, and where it was met.
    inside: Option<(Inside<'a>, Hit)>,
    /// Number of the object in the scene.
    object: usize,
}
