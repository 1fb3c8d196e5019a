//! Light followed from where it starts until it leaves, by the renderer's own scattering.

use glam::{Vec2, Vec3};

use super::stage::Stage;
use crate::bsdf::View;
use crate::geometry::{Geometry, Hit, Ray};
use crate::material::Material;
use crate::medium::{BodyPlace, Phase};
use crate::sampling::dimensions::{Sets, instrument as sets};
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};
use crate::walk::cone::Cone;
use crate::walk::encounter::Encounter;
use crate::walk::facet::{Facet, Surroundings};
use crate::walk::leaf_walk::{LeafWalk, Leaving};
use crate::walk::{self, Ahead, Arrival, Boundary, Collision, Walk, roulette};
use trace::world::{World, WorldObjects};

/// Number of wavelengths that a path carries.
pub(super) const LANES: usize = 8;

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

/// How rays go on.
pub(super) trait Course {
    /// What is ahead of a ray, nothing at its end too, and the distance that it went before it was
    /// moved last on its way.
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

/// How flux is followed.
pub(super) struct Flux<'a, C> {
    pub(super) stage: &'a Stage<'a>,
    pub(super) course: &'a C,
    pub(super) wavelengths: &'a Wavelengths<LANES>,
    /// Number of ways, a power of 2, in which light goes on from the first event. Their random
    /// numbers are evenly spread, so that each kind of scattering there has nearly its share of
    /// them.
    pub(super) ways: u32,
}

/// Light on its way.
type Leg = walk::Leg<LANES, Departure>;

/// What is remembered of where light comes from.
#[derive(Clone, Copy)]
pub(super) struct Departure {
    /// Whether its direction is one of finitely many.
    is_specular: bool,
}

/// Where light is.
#[derive(Clone, Copy)]
pub(super) struct Passage {
    around: walk::Passage,
    /// Whether no medium has scattered it.
    is_straight: bool,
}

impl AsMut<walk::Passage> for Passage {
    fn as_mut(&mut self) -> &mut walk::Passage {
        &mut self.around
    }
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

/// An event at which light of an object goes straight on; its weights before and after.
fn passing(
    object: usize,
    (position, uv): (Vec3, Vec2),
    [before, after]: [Lanes<LANES>; 2],
) -> Event {
    Event {
        object,
        instance: None,
        position,
        uv,
        before,
        after,
        is_first: false,
        is_scattered: false,
    }
}

impl<'m, C: Course> Flux<'m, C> {
    /// Light at some wavelengths that goes on in `ways` from where it first meets something.
    pub(super) fn new(
        stage: &'m Stage<'m>,
        course: &'m C,
        wavelengths: &'m Wavelengths<LANES>,
        ways: u32,
    ) -> Self {
        Self {
            stage,
            course,
            wavelengths,
            ways,
        }
    }

    /// Follows light of weight 1 from a lamp in the open, until all of it is absorbed or leaves. The
    /// first set of the stream is the caller's.
    pub(super) fn of_lamp(&self, ray: Ray, stream: &Stream, witness: &mut impl Witness<'m>) {
        let passage = Passage {
            around: walk::Passage::default(),
            is_straight: true,
        };
        self.start((ray, passage), Lanes::ONE, true, stream, witness);
    }

    /// Follows light of a weight that a surface emits. The first set of the stream is the caller's.
    pub(super) fn of_surface(
        &self,
        start: (Ray, Passage),
        weight: Lanes<LANES>,
        stream: &Stream,
        witness: &mut impl Witness<'m>,
    ) {
        self.start(start, weight, false, stream, witness);
    }

    fn start(
        &self,
        (ray, passage): (Ray, Passage),
        throughput: Lanes<LANES>,
        is_specular: bool,
        stream: &Stream,
        witness: &mut impl Witness<'m>,
    ) {
        let mut leg = Leg {
            ray,
            cone: Cone::of_beam(),
            throughput,
            origin: Departure { is_specular },
        };
        self.follow(&mut leg, passage, 0, &mut stream.clone(), witness);
    }

    /// What is left of light after Russian roulette; nothing of what is no number.
    fn play(&self, weight: Lanes<LANES>, number: impl FnOnce() -> f32) -> Lanes<LANES> {
        let greatest = weight.max_lane();
        if !greatest.is_finite() {
            return Lanes::ZERO;
        }
        let below = ROULETTE_BELOW / self.ways as f32;
        roulette(greatest, below, number).map_or(Lanes::ZERO, |factor| weight * factor)
    }

    /// Number of the object that a body belongs to.
    fn owner(&self, body: BodyPlace) -> usize {
        self.stage.objects.object_of(body)
    }

    /// Turns a leg that has met a surface into the one by which a share of its light continues; false
    /// if nothing does.
    fn scatter(
        &self,
        (material, encounter, hit): (&'m Material, &Encounter<'m, LANES>, &Hit),
        (leg, passage): (&mut Leg, &mut Passage),
        (share, event): (f32, u32),
        stream: &mut Stream,
        witness: &mut impl Witness<'m>,
    ) -> bool {
        let weight = leg.throughput * share;
        witness.struck(&Struck {
            encounter,
            material,
            weight,
            passage: *passage,
        });
        stream.seek(sets::EVENT.of(event));
        let numbers = stream.next4();
        let [lobe, x, y, chance] = numbers;
        let geometry = &self.stage.geometry;
        let around = Staged(self.stage, self.course);
        let most_events = self.stage.world.integrator.max_events;
        let (leaving, is_specular) = if let Some(inside) = material.inside() {
            let at = (hit, &encounter.surface, &encounter.frame, encounter.wo);
            let chance = (numbers, most_events);
            let mut walk = LeafWalk::new(geometry, inside, at, self.wavelengths, chance);
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
            let facet = encounter.facet(&around);
            let drawn = view
                .and_then(|view| facet.sample((&encounter.frame, &view), lobe, Vec2::new(x, y)));
            let is_specular = drawn.as_ref().is_some_and(|(_, sample)| sample.specular);
            let leaving = drawn.map(|(towards, sample)| Leaving {
                towards,
                pdf: None,
                weight: sample.weight * encounter.bsdf.flux_over_radiance(encounter.wo, sample.wi),
                surface: encounter.surface,
            });
            (leaving, is_specular)
        };
        let mut after = leaving.map_or(Lanes::ZERO, |leaving| weight * leaving.weight);
        if event + 1 < most_events {
            after = self.play(after, || chance);
        } else {
            // What such a path still carries counts as absorbed where it is.
            if after.max_lane().is_finite() {
                self.stage.cuts.add(after);
            }
            after = Lanes::ZERO;
        }
        let surface = &encounter.surface;
        witness.event(&Event {
            object: self.stage.objects[surface.instance as usize].object,
            instance: Some(surface.instance),
            position: surface.position,
            uv: surface.uv,
            before: weight,
            after,
            is_first: event == 0 && passage.is_straight,
            is_scattered: true,
        });
        let Some(leaving) = leaving.filter(|_| !after.is_zero()) else {
            return false;
        };
        let facet = Facet {
            around: &around,
            surface: &leaving.surface,
        };
        *leg = Leg {
            ray: facet.spawn(leaving.towards),
            cone: Cone::scattered(encounter.width),
            throughput: after,
            origin: Departure { is_specular },
        };
        if self.stage.world.media.are_present
            && let Some(boundary) = Boundary::at(&self.stage.objects, &leaving.surface)
        {
            let direction = leg.ray.direction();
            boundary.leave(&mut passage.around.inside, direction);
            leg.ray = facet.spawn_whole(direction);
        }
        true
    }
}

impl<'m, C: Course, W: Witness<'m>> Walk<'m, LANES, W> for Flux<'m, C> {
    type Origin = Departure;
    type Passage = Passage;

    const FLIGHTS: Sets = sets::FLIGHT;
    const COUNTS_FLIGHTS: bool = true;

    fn world(&self) -> &'m World {
        self.stage.world
    }

    fn scenery(&self) -> (&Geometry, &WorldObjects) {
        (&self.stage.geometry, &self.stage.objects)
    }

    fn wavelengths(&self) -> &Wavelengths<LANES> {
        self.wavelengths
    }

    fn next(&self, ray: &mut Ray, [from, reach]: [f32; 2], _: u32, _: &mut W) -> (Ahead, f32) {
        *ray = ray.up_to(from + reach);
        let (ahead, moved) = self.course.next(self.stage, ray);
        let is_end = matches!(ahead, Ahead::Nothing) && ray.t_max().is_finite();
        (if is_end { Ahead::End(reach) } else { ahead }, moved)
    }

    fn arrives(&self, at: &Arrival<'_, LANES>, _: u32, witness: &mut W) -> bool {
        let surface = at.surface;
        let object = match at.around {
            Some(body) => self.owner(body),
            None => self.stage.objects[surface.instance as usize].object,
        };
        let place = (surface.position, surface.uv);
        witness.event(&passing(object, place, [at.before, at.after]));
        !at.after.is_zero()
    }

    fn collides(
        &self,
        leg: &mut Leg,
        passage: &mut Passage,
        at: &Collision<LANES>,
        _: u32,
        stream: &mut Stream,
        witness: &mut W,
    ) -> bool {
        passage.is_straight = false;
        let [coin, lobe, x, y] = stream.next4();
        // Of leaves, the numbers of the flight have chosen the leaf.
        let u = match at.medium.phase {
            Phase::HenyeyGreenstein { .. } | Phase::Rayleigh => at.u,
            Phase::Leaf { .. } => Vec2::new(x, y),
        };
        let (scattering, weight) = at.medium.turn(leg.ray.direction(), lobe, u);
        let after = self.play(leg.throughput * weight, || coin);
        witness.event(&Event {
            is_scattered: true,
            ..passing(
                self.owner(at.place),
                (at.position, Vec2::ZERO),
                [at.before, after],
            )
        });
        *leg = Leg {
            ray: Ray::new(at.position, scattering.direction),
            cone: leg.cone.from(at.moved + leg.ray.t_max()),
            throughput: after,
            origin: Departure { is_specular: false },
        };
        !after.is_zero()
    }

    fn meets(
        &self,
        leg: &mut Leg,
        passage: &mut Passage,
        (material, encounter, hit): (&'m Material, &mut Encounter<'m, LANES>, &Hit),
        event: u32,
        stream: &mut Stream,
        witness: &mut W,
    ) -> bool {
        if leg.throughput.is_zero() {
            return false;
        }
        let met = (material, &*encounter, hit);
        if event > 0 || self.ways == 1 {
            return self.scatter(met, (leg, passage), (1.0, event), stream, witness);
        }
        let share = 1.0 / self.ways as f32;
        for way in 0..self.ways {
            let mut stream = stream.part(way, self.ways);
            let (mut leg, mut passage) = (*leg, *passage);
            let next = (&mut leg, &mut passage);
            if self.scatter(met, next, (share, event), &mut stream, witness) {
                self.follow(&mut leg, passage, 1, &mut stream, witness);
            }
        }
        false
    }

    fn leaves(&self, leg: &mut Leg, passage: &mut Passage, witness: &mut W) {
        let around = passage.around.inside.innermost();
        if let Some((body, number)) = around.and_then(|(at, body)| Some((at, body.medium?))) {
            // No closed body is left without passing its boundary, but by rounding.
            let medium = &self.stage.world.media.media[number as usize];
            let medium = medium.at(leg.ray.direction(), self.wavelengths);
            let before = leg.throughput;
            leg.throughput *= medium.passed(&before, f32::INFINITY);
            let place = (leg.ray.origin(), Vec2::ZERO);
            let weights = [before, leg.throughput];
            witness.event(&passing(self.owner(body), place, weights));
        }
        if !leg.throughput.is_zero() {
            witness.escape(&Escaped {
                direction: leg.ray.direction(),
                weight: leg.throughput,
                is_specular: leg.origin.is_specular,
            });
        }
    }

    /// What light that is caught still carries counts as absorbed where it is, if anything is there.
    fn cut(&self, leg: &mut Leg, passage: &mut Passage, witness: &mut W) {
        if let Some((body, _)) = passage.around.inside.innermost() {
            let place = (leg.ray.origin(), Vec2::ZERO);
            let weights = [leg.throughput, Lanes::ZERO];
            witness.event(&passing(self.owner(body), place, weights));
        }
        self.stage.cuts.add(leg.throughput);
    }
}
