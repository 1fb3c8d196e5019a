//! Light followed from where it starts until it leaves, by the renderer's own scattering.

mod media;

use glam::{Vec2, Vec3};

pub(super) use self::media::Passage;

use super::LANES;
use super::stage::Stage;
use crate::bsdf::View;
use crate::geometry::{Hit, Ray};
use crate::integrator::cone::Cone;
use crate::integrator::encounter::Encounter;
use crate::integrator::facet::{Facet, Surroundings};
use crate::integrator::leaf_walk::{LeafWalk, Leaving};
use crate::material::Material;
use crate::material::leaf::Inside;
use crate::sampling::dimensions::instrument as sets;
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};

/// Weight, in the lane where it is greatest, below which Russian roulette is applied.
const ROULETTE_BELOW: f32 = 0.02;

/// One scattering event.
pub(super) struct Event {
    /// Number of the object in the scene.
    pub(super) object: usize,
    /// Number of the instance on the stage; `None` within a medium.
    pub(super) instance: Option<u32>,
    /// Where it is, m, and its texture coordinates.
    pub(super) position: Vec3,
    pub(super) uv: Vec2,
    /// Weight of the light that arrives.
    pub(super) before: Lanes<LANES>,
    /// Weight of the light that goes on. It may be more than arrives: only the mean over directions
    /// and over the roulette is not.
    pub(super) after: Lanes<LANES>,
    /// Whether the light comes straight from where it started.
    pub(super) is_first: bool,
    /// Whether it is scattered; if not, it goes straight on, perhaps weakened by a medium.
    pub(super) is_scattered: bool,
}

/// Light at a surface that it meets, before it goes on.
pub(super) struct Scattering<'e> {
    /// The surface, its frame and its BSDF.
    pub(super) encounter: &'e Encounter<'e, LANES>,
    /// The BSDF seen from where the light comes.
    pub(super) view: &'e View<'e, LANES>,
    /// Weight of the light that arrives.
    pub(super) weight: Lanes<LANES>,
    /// Random numbers that the way of the light does not use.
    pub(super) numbers: [f32; 4],
}

/// Light that arrives at a surface, before it is scattered.
pub(super) struct Struck<'a, 'm> {
    /// Where, and from where.
    pub(super) encounter: &'a Encounter<'m, LANES>,
    /// The material.
    pub(super) material: &'m Material,
    /// Weight of the light.
    pub(super) weight: Lanes<LANES>,
    /// Where it is, in scenes with media.
    pub(super) passage: Passage,
}

/// Light that leaves.
pub(super) struct Escaped {
    /// Direction, unit.
    pub(super) direction: Vec3,
    /// Its weight.
    pub(super) weight: Lanes<LANES>,
    /// Whether its direction is one of finitely many: that of a beam, or of a mirror.
    pub(super) is_specular: bool,
}

/// What is ahead of a ray.
pub(super) enum Ahead {
    /// A surface.
    Hit(Hit),
    /// Nothing: the ray leaves, or comes to its end if it has one.
    Nothing,
    /// The search was given up.
    Unknown,
}

/// How rays go on.
pub(super) trait Course {
    /// What is ahead of a ray, which may be moved on its way to it, and the distance that it went
    /// before it was moved last.
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Ahead, f32);

    /// Whether a ray leaves without a hit. If the search is given up it does not, and what it carries
    /// counts as cut.
    fn is_clear(&self, stage: &Stage<'_>, ray: Ray, carried: &Lanes<LANES>) -> bool;

    /// Whether nothing is in the way of a short ray that ends.
    fn is_free(&self, stage: &Stage<'_>, way: &Ray) -> bool {
        !stage.geometry.occluded(way)
    }
}

/// A stage, and how rays go on in it.
pub(super) struct Staged<'a, C>(pub(super) &'a Stage<'a>, pub(super) &'a C);

impl<C: Course> Surroundings for Staged<'_, C> {
    fn is_free(&self, way: &Ray) -> bool {
        self.1.is_free(self.0, way)
    }
}

/// Rays that go straight on.
pub(super) struct Straight;

impl Course for Straight {
    fn next(&self, stage: &Stage<'_>, ray: &mut Ray) -> (Ahead, f32) {
        let hit = stage.geometry.intersect(ray);
        (hit.map_or(Ahead::Nothing, Ahead::Hit), 0.0)
    }

    fn is_clear(&self, stage: &Stage<'_>, ray: Ray, _: &Lanes<LANES>) -> bool {
        !stage.geometry.occluded(&ray)
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
    is_specular: bool,
    passage: Passage,
}

/// What is told of light on its way, in the order of what befalls it.
pub(super) trait Witness<'m> {
    /// It arrives at a surface.
    fn struck(&mut self, _struck: &Struck<'_, 'm>) {}
    /// The surface sends it on; told before the event.
    fn scattering(&mut self, _at: &Scattering<'_>) {}
    /// It is scattered.
    fn event(&mut self, event: &Event);
    /// It leaves.
    fn escape(&mut self, escaped: &Escaped);
}

impl<'m, C: Course> Walk<'m, C> {
    /// Follows light of weight 1 until all of it is absorbed or leaves. The first set of the stream
    /// is the caller's.
    pub(super) fn follow(&self, ray: Ray, stream: &Stream, witness: &mut impl Witness<'m>) {
        let mut leg = Leg {
            ray,
            cone: Cone::of_beam(),
            weight: Lanes::ONE,
            is_specular: true,
            passage: Passage::in_the_open(),
        };
        let Some(met) = self.meet(&mut leg, &mut stream.clone(), witness) else {
            return;
        };
        let share = 1.0 / self.ways as f32;
        for way in 0..self.ways {
            let mut stream = stream.part(way, self.ways);
            let mut next = self.scatter(&met, &leg, share, 0, &mut stream, witness);
            let mut event = 1;
            while let Some(mut leg) = next {
                let Some(met) = self.meet(&mut leg, &mut stream, witness) else {
                    break;
                };
                next = self.scatter(&met, &leg, 1.0, event, &mut stream, witness);
                event += 1;
            }
        }
    }

    /// Follows light of a weight that starts at a surface. The first set of the stream is the
    /// caller's.
    pub(super) fn follow_on(
        &self,
        (ray, passage): (Ray, Passage),
        weight: Lanes<LANES>,
        stream: &mut Stream,
        witness: &mut impl Witness<'m>,
    ) {
        let mut next = Some(Leg {
            ray,
            cone: Cone::of_beam(),
            weight,
            is_specular: false,
            passage,
        });
        let mut event = 0;
        while let Some(mut leg) = next {
            let Some(met) = self.meet(&mut leg, stream, witness) else {
                break;
            };
            next = self.scatter(&met, &leg, 1.0, event, stream, witness);
            event += 1;
        }
    }

    /// The surface that light meets; `None` if it leaves.
    fn meet(
        &self,
        leg: &mut Leg,
        stream: &mut Stream,
        witness: &mut impl Witness<'m>,
    ) -> Option<Met<'m>> {
        let (ahead, gone) = if self.stage.world.media.are_present {
            self.fly(leg, stream, witness)
        } else {
            self.course.next(self.stage, &mut leg.ray)
        };
        if leg.weight.is_zero() {
            return None;
        }
        let hit = match ahead {
            Ahead::Hit(hit) => hit,
            Ahead::Nothing => {
                witness.escape(&Escaped {
                    direction: leg.ray.direction(),
                    weight: leg.weight,
                    is_specular: leg.is_specular,
                });
                return None;
            }
            Ahead::Unknown => {
                self.stage.cuts.add(leg.weight);
                return None;
            }
        };
        let cone = leg.cone.from(gone);
        let geometry = &self.stage.geometry;
        let material = self.stage.material_of(hit.instance);
        let inside = material.inside().map(|inside| (inside, hit));
        let beam = (&leg.ray, &cone);
        let encounter = Encounter::new(geometry, material, beam, &hit, self.wavelengths);
        Some(Met {
            encounter,
            material,
            inside,
            object: self.stage.objects[hit.instance as usize].object,
        })
    }

    /// A share of light that has met a surface and goes on from there; `None` if nothing does.
    fn scatter(
        &self,
        met: &Met<'m>,
        arriving: &Leg,
        share: f32,
        event: u32,
        stream: &mut Stream,
        witness: &mut impl Witness<'m>,
    ) -> Option<Leg> {
        let Met {
            encounter,
            material,
            inside,
            object,
        } = met;
        let weight = arriving.weight * share;
        witness.struck(&Struck {
            encounter,
            material,
            weight,
            passage: arriving.passage,
        });
        stream.seek(sets::EVENT.of(event));
        let numbers = stream.next4();
        let [.., roulette] = numbers;
        let around = Staged(self.stage, self.course);
        let most_events = self.stage.world.integrator.max_events;
        let (leaving, is_specular) = if let Some((inside, hit)) = inside {
            let at = (hit, &encounter.surface, &encounter.frame, encounter.wo);
            let geometry = &self.stage.geometry;
            let chance = (numbers, most_events);
            let mut walk = LeafWalk::new(geometry, *inside, at, self.wavelengths, chance);
            let mut leaving = walk.through();
            if let Some(leaving) = &mut leaving {
                let facet = Facet {
                    around: &around,
                    surface: &leaving.surface,
                };
                leaving.towards = facet.leaving(leaving.towards);
            } else {
                self.stage.cuts.add(weight * walk.cut());
            }
            (leaving, false)
        } else {
            let view = encounter.bsdf.seen_from(encounter.wo);
            if let Some(view) = &view {
                let mut aside = stream.clone();
                aside.seek(sets::DETECTOR.of(event));
                witness.scattering(&Scattering {
                    encounter,
                    view,
                    weight,
                    numbers: aside.next4(),
                });
            }
            at_surface(encounter, &around, view, numbers)
        };
        let mut after = leaving.map_or(Lanes::ZERO, |leaving| weight * leaving.weight);
        let greatest = after.max_lane();
        let below = ROULETTE_BELOW / self.ways as f32;
        if !greatest.is_finite() {
            after = Lanes::ZERO;
        } else if event + 1 >= most_events {
            // What such a path still carries counts as absorbed where it is.
            self.stage.cuts.add(after);
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
            instance: Some(encounter.surface.instance),
            position: encounter.surface.position,
            uv: encounter.surface.uv,
            before: weight,
            after,
            is_first: event == 0 && arriving.passage.is_straight,
            is_scattered: true,
        });
        let leaving = leaving.filter(|_| !after.is_zero())?;
        let facet = Facet {
            around: &around,
            surface: &leaving.surface,
        };
        let mut leg = Leg {
            ray: facet.spawn(leaving.towards),
            cone: Cone::scattered(encounter.width),
            weight: after,
            is_specular,
            passage: arriving.passage,
        };
        if self.stage.world.media.are_present {
            let mut passage = leg.passage;
            passage.leave(self.stage, facet, &mut leg.ray);
            leg.passage = passage;
        }
        Some(leg)
    }
}

/// Light that goes on from a surface which scatters it there, and whether its direction is one of
/// finitely many.
fn at_surface(
    encounter: &Encounter<'_, LANES>,
    around: &impl Surroundings,
    view: Option<View<'_, LANES>>,
    [lobe, x, y, _]: [f32; 4],
) -> (Option<Leaving<LANES>>, bool) {
    let facet = encounter.facet(around);
    let Some((towards, sample)) =
        view.and_then(|view| facet.sample((&encounter.frame, &view), lobe, Vec2::new(x, y)))
    else {
        return (None, false);
    };
    let flux = encounter.bsdf.flux_over_radiance(encounter.wo, sample.wi);
    let leaving = Leaving {
        towards,
        pdf: None,
        weight: sample.weight * flux,
        surface: encounter.surface,
    };
    (Some(leaving), sample.specular)
}

/// A surface that light meets.
struct Met<'a> {
    encounter: Encounter<'a, LANES>,
    material: &'a Material,
    /// What is inside, if light is followed through it, and where it was met.
    inside: Option<(Inside<'a>, Hit)>,
    /// Number of the object in the scene.
    object: usize,
}
