//! Fluxes of a canopy that repeats itself without end.
//!
//! Light enters through the top of a box whose sides are joined ([`Period`]). What leaves at the
//! top is reflected, the rest is absorbed by soil or by another object, or goes on below where
//! there is no soil. All figures are shares of the light that enters.

use std::collections::BTreeSet;

use glam::{DVec3, Vec2, Vec3};

use super::batches::{Budget, Experiment, estimates};
use super::period::Period;
use super::row::{Direction, Row};
use super::sphere::{directions, towards};
use super::stage::Stage;
use super::walk::{Escaped, Event, Walk, Witness};
use super::{InstrumentError, LANES};
use crate::geometry::Ray;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::{Canopy, Description, Instrument, Named};
use crate::scene::world::World;
use crate::spectrum::Wavelengths;

/// Rays along each side of the box by which soil is looked for.
const SOIL_PROBES: u32 = 48;

/// What is told of each wavelength.
#[derive(Clone, Debug, PartialEq)]
struct Quantity {
    word: &'static str,
    part: Option<String>,
}

/// The places of the sums of an object, by lanes, behind the denominator.
#[derive(Debug)]
struct Ledger {
    quantities: Vec<Quantity>,
    /// Number of the first quantity of objects, and which object each is.
    objects: (usize, Vec<usize>),
    /// Number of the first quantity of layers, and the heights between them.
    layers: (usize, Vec<f32>),
    soil: Option<usize>,
}

const REFLECTED: usize = 0;
const TRANSMITTED: usize = 1;
const UNCOLLIDED: usize = 2;
const ARRIVING: usize = 3;
const BY_SOIL: usize = 4;

impl Ledger {
    fn new(scene: &Description, stage: &Stage<'_>, canopy: &Canopy) -> Self {
        let own = |word| Quantity { word, part: None };
        let mut quantities = vec![own("reflected"), own("transmitted"), own("uncollided")];
        if canopy.soil.is_some() {
            quantities.push(own("arriving_at_soil"));
            quantities.push(own("absorbed_by_soil"));
        }
        let numbers: BTreeSet<usize> = (0..stage.objects.len())
            .map(|instance| stage.objects[instance].object)
            .filter(|object| Some(*object) != canopy.soil)
            .collect();
        let objects = (quantities.len(), numbers.into_iter().collect::<Vec<_>>());
        quantities.extend(objects.1.iter().map(|&object| Quantity {
            word: "absorbed",
            part: Some(scene.objects[object].name.clone()),
        }));
        let first_layer = quantities.len();
        let borders = &canopy.layers;
        if let [lowest, .., highest] | [lowest @ highest] = borders.as_slice() {
            let between = borders.windows(2);
            let between = between.map(|pair| format!("{} to {} m", pair[0], pair[1]));
            let below = std::iter::once(format!("below {lowest} m"));
            let names = below.chain(between).chain([format!("above {highest} m")]);
            quantities.extend(names.map(|name| Quantity {
                word: "absorbed_in_layer",
                part: Some(name),
            }));
        }
        let origin = stage.world.origin.z;
        Self {
            quantities,
            objects,
            layers: (
                first_layer,
                borders.iter().map(|z| (z - origin) as f32).collect(),
            ),
            soil: canopy.soil,
        }
    }

    /// Adds what is left at an event.
    fn add(&self, event: &Event, sums: &mut [f64]) {
        let absorbed =
            |lane: usize| f64::from(event.before.0[lane]) - f64::from(event.after.0[lane]);
        if Some(event.object) == self.soil {
            if event.is_scattered {
                add(sums, ARRIVING, |lane| f64::from(event.before.0[lane]));
            }
            add(sums, BY_SOIL, absorbed);
            return;
        }
        let (first, objects) = &self.objects;
        let place = objects.partition_point(|object| *object < event.object);
        add(sums, first + place, absorbed);
        let (first, borders) = &self.layers;
        if !borders.is_empty() {
            let layer = borders.partition_point(|border| *border < event.position.z);
            add(sums, first + layer, absorbed);
        }
    }
}

/// Adds to the lanes of a quantity.
fn add(sums: &mut [f64], quantity: usize, value: impl Fn(usize) -> f64) {
    let lanes = sums[1 + quantity * LANES..].iter_mut().take(LANES);
    for (lane, sum) in lanes.enumerate() {
        *sum += value(lane);
    }
}

/// One light, at one set of wavelengths.
struct Lit<'a> {
    stage: &'a Stage<'a>,
    period: Period,
    ledger: &'a Ledger,
    direction: Direction,
    azimuth: f64,
    wavelengths: Wavelengths<LANES>,
    stream: u32,
}

impl Experiment for Lit<'_> {
    fn sums(&self) -> usize {
        1 + self.ledger.quantities.len() * LANES
    }

    fn stream(&self) -> u32 {
        self.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let [x, y, u, v] = stream.next4();
        let towards = match self.direction {
            Direction::Beam(angle) => towards(angle, self.azimuth),
            Direction::Diffuse => warp::cosine_hemisphere(Vec2::new(u, v)),
        };
        let ray = Ray::new(self.period.on_top([x, y]), -towards);
        sums[0] += 1.0;
        let walk = Walk {
            stage: self.stage,
            course: &self.period,
            wavelengths: &self.wavelengths,
            ways: 1,
        };
        let ledger = self.ledger;
        let is_untouched = true;
        walk.follow(
            ray,
            stream,
            &mut Tally {
                ledger,
                sums,
                is_untouched,
            },
        );
    }
}

/// The sums to which one ray adds.
struct Tally<'a> {
    ledger: &'a Ledger,
    sums: &'a mut [f64],
    /// Whether the ray has been scattered by nothing so far.
    is_untouched: bool,
}

impl Witness for Tally<'_> {
    fn event(&mut self, event: &Event) {
        self.is_untouched &= !event.is_scattered;
        if event.is_first && Some(event.object) == self.ledger.soil {
            add(self.sums, UNCOLLIDED, |lane| {
                f64::from(event.before.0[lane])
            });
        }
        self.ledger.add(event, self.sums);
    }

    fn escape(&mut self, escaped: &Escaped) {
        let weight = |lane: usize| f64::from(escaped.weight.0[lane]);
        if escaped.direction.z > 0.0 {
            add(self.sums, REFLECTED, weight);
            return;
        }
        add(self.sums, TRANSMITTED, weight);
        if self.is_untouched {
            add(self.sums, UNCOLLIDED, weight);
        }
    }
}

/// The box in the frame of a world.
fn within(world: &World, canopy: &Canopy) -> [Vec2; 2] {
    let origin = DVec3::new(world.origin.x, world.origin.y, 0.0).truncate();
    canopy.within.map(|corner| (corner - origin).as_vec2())
}

/// What of a scene stands outside the box and is left out, a sentence for each object.
pub(super) fn notes(world: &World, scene: &Description, canopy: &Canopy) -> Vec<String> {
    let left_out = Period::left_out(within(world, canopy), world);
    let note = |(object, count): (usize, usize)| {
        let numbers = 0..world.objects.len();
        let own = numbers.filter(|&number| world.objects[number].object == object);
        let all = own.count();
        format!(
            "{count} of {all} parts of the object `{}` stand outside `within_m` and are left out",
            scene.objects[object].name
        )
    };
    left_out.into_iter().map(note).collect()
}

/// Measures.
pub(super) fn read_out(
    world: &World,
    scene: &Description,
    (instrument, canopy): (&Named<Instrument>, &Canopy),
    first_set: usize,
    budget: &Budget,
) -> Result<Vec<Row>, InstrumentError> {
    let at = &instrument.value.at;
    let (stage, period) = Period::stage(within(world, canopy), world, at)?;
    let ledger = Ledger::new(scene, &stage, canopy);
    if ledger.objects.1.is_empty() {
        return Err(InstrumentError::NoLeaves { at: at.clone() });
    }
    let stands = 0..stage.objects.len();
    let mut bodies = stands.filter(|&number| {
        let body = stage.objects[number].body;
        body.is_some_and(|body| body.medium.is_some())
    });
    if let (Some(number), false) = (bodies.next(), canopy.layers.is_empty()) {
        return Err(InstrumentError::MediumInLayers {
            at: at.clone(),
            object: scene.objects[stage.objects[number].object].name.clone(),
        });
    }
    if let Some(soil) = canopy.soil
        && !is_covered(&stage, &period, soil)
    {
        return Err(InstrumentError::SoilTooSmall {
            at: at.clone(),
            object: scene.objects[soil].name.clone(),
        });
    }
    let nm = &instrument.value.wavelengths_nm;
    let sets = nm.len().div_ceil(LANES);
    let directions = directions(&canopy.incidence);
    let mut lit = Vec::new();
    for (number, &direction) in directions.iter().enumerate() {
        for set in 0..sets {
            lit.push(Lit {
                stage: &stage,
                period,
                ledger: &ledger,
                direction,
                azimuth: canopy.incidence.azimuth,
                wavelengths: world.wavelengths.grid().set(first_set + set),
                stream: number as u32,
            });
        }
    }
    let found = estimates(&lit, budget);
    let mut rows = Vec::new();
    for (figures, &direction) in found.chunks(sets).zip(&directions) {
        for (i, &wavelength_nm) in nm.iter().enumerate() {
            for (number, quantity) in ledger.quantities.iter().enumerate() {
                let figure = figures[i / LANES][number * LANES + i % LANES];
                rows.push(Row {
                    instrument: instrument.name.clone(),
                    incidence: direction,
                    face: None,
                    part: quantity.part.clone(),
                    wavelength_nm,
                    quantity: quantity.word,
                    value: figure.value,
                    error: figure.error,
                    unit: "1",
                });
            }
        }
    }
    Ok(rows)
}

/// Whether an object is met everywhere below the top of the box, by a grid of rays.
fn is_covered(stage: &Stage<'_>, period: &Period, object: usize) -> bool {
    let numbers = 0..stage.objects.len() as u32;
    let own = numbers.filter(|&number| stage.objects[number as usize].object == object);
    let own: Vec<(u32, Vec3)> = own.map(|number| (number, Vec3::ZERO)).collect();
    let Ok(soil) = stage.geometry.with_places(&own) else {
        return false;
    };
    (0..SOIL_PROBES * SOIL_PROBES).all(|probe| {
        let place = [probe % SOIL_PROBES, probe / SOIL_PROBES];
        let place = place.map(|i| (i as f32 + 0.5) / SOIL_PROBES as f32);
        let down = Ray::new(period.on_top(place), Vec3::NEG_Z);
        soil.occluded(&down)
    })
}
