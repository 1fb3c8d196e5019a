//! Fluxes of a canopy that repeats itself without end.
//!
//! Light enters through the top of a box whose sides are joined ([`Period`]). What leaves at the
//! top is reflected, the rest is absorbed by soil or by another object, or goes on below where
//! there is no soil. All figures are shares of the light that enters.

use glam::{DVec3, Vec2, Vec3};

use super::batches::{Effort, Experiment, estimates};
use super::detector::{self, Detectors, angles};
use super::error::{InstrumentError, Problem};
use super::fluorescence::{self, Illumination, Manner};
use super::flux::{Escaped, Event, Flux, LANES, Scattering, Witness};
use super::lamp::{directions, towards};
use super::ledger::{Ledger, REFLECTED, TRANSMITTED, UNCOLLIDED, add};
use super::period::Period;
use super::row::{Direction, Reading};
use super::spectral::{Series, by_wavelength, plain, rows};
use super::stage::Stage;
use crate::geometry::Ray;
use crate::geometry::frame::Frame;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::{Canopy, Description, Instrument, Named};
use crate::spectrum::Wavelengths;
use trace::world::World;

/// Rays along each side of the box by which soil is looked for.
const SOIL_PROBES: u32 = 48;

/// Most quantities, times lights and sets of wavelengths, where instances are told one by one: each
/// takes some 4 KiB.
const MOST_FIGURES: usize = 1 << 18;

/// One light, at one set of wavelengths.
struct Lit<'a> {
    stage: &'a Stage<'a>,
    period: Period,
    ledger: &'a Ledger,
    direction: Direction,
    azimuth: f64,
    detectors: Option<Detectors>,
    wavelengths: Wavelengths<LANES>,
    stream: u32,
}

impl Experiment for Lit<'_> {
    fn sums(&self) -> usize {
        let seen = self.detectors.as_ref().map_or(0, Detectors::len);
        1 + (self.ledger.quantities.len() + seen) * LANES
    }

    fn end(&self, rays: u64) {
        self.stage.cuts.measured(rays);
    }

    fn stream(&self) -> u32 {
        self.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let ray = self.ray(stream);
        sums[0] += 1.0;
        let flux = Flux {
            stage: self.stage,
            course: &self.period,
            wavelengths: &self.wavelengths,
            ways: 1,
        };
        let mut tally = Tally {
            lit: self,
            sums,
            is_untouched: true,
        };
        flux.of_lamp(ray, stream, &mut tally);
    }
}

impl Illumination for Lit<'_> {
    fn ray(&self, stream: &mut Stream) -> Ray {
        let [x, y, u, v] = stream.next4();
        let towards = match self.direction {
            Direction::Beam(angle) => towards(angle, self.azimuth),
            Direction::Diffuse => warp::cosine_hemisphere(Vec2::new(u, v)),
        };
        Ray::new(self.period.on_top([x, y]), -towards)
    }

    fn is_back(&self, direction: Vec3) -> bool {
        direction.z > 0.0
    }
}

/// The sums to which one ray adds.
struct Tally<'a> {
    lit: &'a Lit<'a>,
    sums: &'a mut [f64],
    /// Whether the ray has been scattered by nothing so far.
    is_untouched: bool,
}

impl Witness<'_> for Tally<'_> {
    fn scattering(&mut self, at: &Scattering<'_>) {
        let Lit {
            stage,
            period,
            ledger,
            detectors,
            ..
        } = self.lit;
        if let Some(detectors) = detectors {
            let first = ledger.quantities.len();
            detectors.see((stage, period), at, |number, seen| {
                add(self.sums, first + number, |lane| f64::from(seen.0[lane]));
            });
        }
    }

    fn event(&mut self, event: &Event) {
        self.is_untouched &= !event.is_scattered;
        let ledger = self.lit.ledger;
        if event.is_first && Some(event.object) == ledger.soil {
            add(self.sums, UNCOLLIDED, |lane| {
                f64::from(event.before.0[lane])
            });
        }
        ledger.add(self.lit.stage, event, &self.lit.wavelengths, self.sums);
    }

    fn escape(&mut self, escaped: &Escaped) {
        if let Some(detectors) = &self.lit.detectors {
            let first = self.lit.ledger.quantities.len();
            detectors.gather(escaped, |number, seen| {
                add(self.sums, first + number, |lane| f64::from(seen.0[lane]));
            });
        }
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

/// What errors of canopies leave out.
const ONE_DRAW: &str = "standard errors hold for these leaves where they are; other draws of a \
    canopy, by other seeds of `scatter`, `volume` or plants, differ by more";

/// What users should know of the figures: for how much the errors hold, and what of a scene lies
/// outside the box and is left out, a sentence for each object.
pub(super) fn notes(world: &World, scene: &Description, canopy: &Canopy) -> Vec<String> {
    let left_out = Period::left_out(canopy.within, world);
    let note = |(object, count): (usize, usize)| {
        let numbers = 0..world.objects.len();
        let own = numbers.filter(|&number| world.objects[number].object == object);
        let all = own.count();
        format!(
            "{count} of {all} parts of the object `{}` stand outside `within_m` and are left out",
            scene.objects[object].name
        )
    };
    let mut notes = vec![ONE_DRAW.to_owned()];
    notes.extend(left_out.into_iter().map(note));
    notes
}

/// Measures.
pub(super) fn read_out(
    world: &World,
    scene: &Description,
    (instrument, canopy): (&Named<Instrument>, &Canopy),
    first_set: usize,
    effort: &Effort<'_>,
) -> Result<Reading, InstrumentError> {
    let at = &instrument.value.at;
    let (stage, period) = Period::stage(canopy.within, world, scene, at)?;
    let ground = (canopy.within[1] - canopy.within[0]).element_product();
    let ledger = Ledger::new(scene, &stage, canopy, ground);
    check(scene, (&stage, &period), canopy, &ledger, at)?;
    detector::check_layers(scene, &stage, &instrument.value, canopy.constituents)?;
    let count = instrument.value.measured_nm().len();
    let sets = count.div_ceil(LANES);
    let directions = directions(&canopy.incidence);
    check_size(at, canopy, &ledger, sets * directions.len())?;
    let azimuth = canopy.incidence.azimuth;
    // +x along x, the normal upwards.
    let upwards = Frame::new(Vec3::Z, Vec3::Y);
    let mut lit = Vec::new();
    for (number, &direction) in directions.iter().enumerate() {
        for set in 0..sets {
            lit.push(Lit {
                stage: &stage,
                period,
                ledger: &ledger,
                direction,
                azimuth,
                detectors: canopy
                    .detector
                    .as_ref()
                    .map(|detector| Detectors::new(detector, &upwards, azimuth, [1.0; 2])),
                wavelengths: world.wavelengths.grid().set(first_set + set),
                stream: number as u32,
            });
        }
    }
    let found = estimates(&lit, effort);
    let seen = canopy.detector.as_ref().map(angles).unwrap_or_default();
    let mut all = Vec::new();
    for (figures, &direction) in found.chunks(sets).zip(&directions) {
        let mut series = Vec::new();
        for (number, quantity) in ledger.quantities.iter().enumerate() {
            let mut row = plain(&instrument.name, quantity.word, direction).row;
            row.part.clone_from(&quantity.part);
            series.push(Series {
                row,
                photons: quantity.photons,
                figures: by_wavelength(figures, number, count),
            });
        }
        for (number, &view) in seen.iter().enumerate() {
            let mut row = plain(&instrument.name, factor_of(direction), direction).row;
            row.view = Some(view);
            let number = ledger.quantities.len() + number;
            series.push(Series {
                row,
                photons: None,
                figures: by_wavelength(figures, number, count),
            });
        }
        all.extend(rows(&instrument.value, &series));
    }
    if let Some(reading) = &instrument.value.fluorescence {
        let lights: Vec<_> = lit
            .iter()
            .step_by(sets)
            .map(|lit| (lit, lit.direction, None))
            .collect();
        let read = (instrument.name.as_str(), reading);
        let (sample, manner) = ((&stage, &period), fluorescence_of(canopy));
        all.extend(fluorescence::read_out(
            sample, &lights, read, &manner, effort,
        ));
    }
    Ok(Reading {
        rows: all,
        cut: stage.cuts.paths(),
    })
}

/// How fluorescence is shown.
fn fluorescence_of(canopy: &Canopy) -> Manner {
    Manner {
        words: [
            Some("fluorescence_emitted"),
            Some("fluorescence_upwards"),
            Some("fluorescence_downwards"),
            Some("fluorescence_absorbed"),
            canopy.soil.map(|_| "fluorescence_absorbed_by_soil"),
        ],
        ways: 1,
        counts_misses: true,
        soil: canopy.soil,
    }
}

/// Fails if a canopy cannot be measured as it is asked for.
fn check(
    scene: &Description,
    (stage, period): (&Stage<'_>, &Period),
    canopy: &Canopy,
    ledger: &Ledger,
    at: &str,
) -> Result<(), InstrumentError> {
    if ledger.objects.1.is_empty() {
        return Err(Problem::NoLeaves.at(at));
    }
    let untold = [
        (
            !canopy.layers.is_empty(),
            "is filled by a medium, whose absorption is not told by layers: leave out `layers_m`",
        ),
        (
            canopy.instances,
            "is filled by a medium, whose absorption is not told by instances: leave out `instances`",
        ),
    ];
    if let Some(detector) = &canopy.detector {
        detector::check(scene, stage, detector, at)?;
    }
    for (asked, problem) in untold {
        if let (true, Some(object)) = (asked, stage.filled()) {
            return Err(Problem::inside(&scene.objects[object].name, problem).at(at));
        }
    }
    if let Some(soil) = canopy.soil
        && !is_covered(stage, period, soil)
    {
        return Err(Problem::SoilTooSmall {
            object: scene.objects[soil].name.clone(),
        }
        .at(at));
    }
    Ok(())
}

/// Fails if there are more sums of instances than there is memory for.
fn check_size(
    at: &str,
    canopy: &Canopy,
    ledger: &Ledger,
    experiments: usize,
) -> Result<(), InstrumentError> {
    let figures = ledger.quantities.len() * experiments;
    if canopy.instances && figures > MOST_FIGURES {
        return Err(Problem::TooManyInstances {
            figures,
            most: MOST_FIGURES,
        }
        .at(at));
    }
    Ok(())
}

/// The word for a reflectance factor in a light.
fn factor_of(light: Direction) -> &'static str {
    match light {
        Direction::Beam(_) => "brf",
        Direction::Diffuse => "hdrf",
    }
}

/// Whether an object is met everywhere below the top of the box, by a grid of rays.
fn is_covered(stage: &Stage<'_>, period: &Period, object: usize) -> bool {
    let numbers = 0..stage.objects.len() as u32;
    let own = numbers.filter(|&number| stage.objects[number as usize].object == object);
    let own: Vec<(u32, DVec3)> = own.map(|number| (number, DVec3::ZERO)).collect();
    let Ok(soil) = stage.geometry.with_places(&own, stage.geometry.origin()) else {
        return false;
    };
    (0..SOIL_PROBES * SOIL_PROBES).all(|probe| {
        let place = [probe % SOIL_PROBES, probe / SOIL_PROBES];
        let place = place.map(|i| (i as f32 + 0.5) / SOIL_PROBES as f32);
        let down = Ray::new(period.on_top(place), Vec3::NEG_Z);
        soil.occluded(&down)
    })
}
