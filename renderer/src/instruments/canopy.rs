//! Fluxes of a canopy that repeats itself without end.
//!
//! Light enters through the top of a box whose sides are joined ([`Period`]). What leaves at the
//! top is reflected, the rest is absorbed by soil or by another object, or goes on below where
//! there is no soil. All figures are shares of the light that enters.

use glam::{DVec3, Vec2, Vec3};

use super::batches::{Experiment, estimates};
use super::detector::{self, Detectors, angles};
use super::error::{InstrumentError, Problem};
use super::fluorescence::{self, Illumination, Manner};
use super::flux::{Escaped, Event, Flux, LANES, Scattering, Witness};
use super::lamp::{directions, towards};
use super::ledger::{Ledger, REFLECTED, TRANSMITTED, UNCOLLIDED, add};
use super::measurement::Measurement;
use super::period::Period;
use super::row::{Direction, Reading};
use super::spectral::Series;
use super::stage::Stage;
use crate::geometry::Ray;
use crate::geometry::frame::Frame;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::{Canopy, Description};
use crate::spectrum::Wavelengths;
use trace::world::World;

/// Rays along each side of the box by which soil is looked for.
const SOIL_PROBES: u32 = 48;

/// Most quantities, times lights and sets of wavelengths, where instances are told one by one: each
/// takes some 4 KiB.
const MOST_FIGURES: usize = 1 << 18;

/// One light, at one set of wavelengths.
struct LitCanopy<'a> {
    stage: &'a Stage<'a>,
    period: Period,
    ledger: &'a Ledger,
    direction: Direction,
    azimuth: f64,
    detectors: Option<&'a Detectors>,
    wavelengths: Wavelengths<LANES>,
    stream: u32,
}

impl Experiment for LitCanopy<'_> {
    fn sums(&self) -> usize {
        let seen = self.detectors.map_or(0, Detectors::len);
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
        let flux = Flux::new(self.stage, &self.period, &self.wavelengths, 1);
        let mut tally = CanopyTally {
            lit: self,
            sums,
            is_untouched: true,
        };
        flux.of_lamp(ray, stream, &mut tally);
    }
}

impl Illumination for LitCanopy<'_> {
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
struct CanopyTally<'a> {
    lit: &'a LitCanopy<'a>,
    sums: &'a mut [f64],
    /// Whether the ray has been scattered by nothing so far.
    is_untouched: bool,
}

impl Witness<'_> for CanopyTally<'_> {
    fn scattering(&mut self, at: &Scattering<'_>) {
        let lit = self.lit;
        if let Some(detectors) = lit.detectors {
            let first = lit.ledger.quantities.len();
            detectors.see((lit.stage, &lit.period), at, |number, seen| {
                add(self.sums, first + number, &seen);
            });
        }
    }

    fn event(&mut self, event: &Event) {
        self.is_untouched &= !event.is_scattered;
        let ledger = self.lit.ledger;
        if event.is_first && Some(event.object) == ledger.soil {
            add(self.sums, UNCOLLIDED, &event.before);
        }
        ledger.add(self.lit.stage, event, &self.lit.wavelengths, self.sums);
    }

    fn escape(&mut self, escaped: &Escaped) {
        if let Some(detectors) = self.lit.detectors {
            let first = self.lit.ledger.quantities.len();
            detectors.gather(escaped, |number, seen| {
                add(self.sums, first + number, &seen);
            });
        }
        let weight = &escaped.weight;
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

/// What errors of a single draw leave out.
const ONE_DRAW: &str = "standard errors hold for these leaves where they are; other draws of a \
    canopy, by other seeds of `scatter`, `volume` or plants, differ by more: `realisations` measures \
    several draws of what is scattered or floats";

/// What there is to say of a box without leaves.
const BARE: &str =
    "nothing lies in `within_m` besides the soil: the figures are those of bare soil";

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
    let is_bare = Period::within(canopy.within, world).all(|object| Some(object) == canopy.soil);
    let of_all = [(is_bare, BARE), (canopy.realisations == 1, ONE_DRAW)];
    let of_all = of_all.into_iter().find(|(holds, _)| *holds);
    let mut notes: Vec<String> = of_all
        .map(|(_, of_all)| of_all.to_owned())
        .into_iter()
        .collect();
    notes.extend(left_out.into_iter().map(note));
    notes
}

/// Measures.
pub(super) fn read_out(
    measurement: &Measurement<'_>,
    canopy: &Canopy,
) -> Result<Reading, InstrumentError> {
    let scene = measurement.scene;
    let (stage, period) = Period::stage(measurement, canopy.within)?;
    let ground = (canopy.within[1] - canopy.within[0]).element_product();
    let ledger = Ledger::new(scene, &stage, canopy, ground);
    check(measurement, (&stage, &period), canopy)?;
    detector::check_layers(measurement, &stage, canopy.constituents)?;
    let directions = directions(&canopy.incidence);
    let sets = measurement.sets();
    let figures = ledger.quantities.len() * sets * directions.len();
    if canopy.instances && figures > MOST_FIGURES {
        let most = MOST_FIGURES;
        return Err(measurement.refuse(Problem::TooManyInstances { figures, most }));
    }
    let azimuth = canopy.incidence.azimuth;
    // +x along x, the normal upwards.
    let upwards = Frame::new(Vec3::Z, Vec3::Y);
    let detectors = canopy.detector.as_ref();
    let detectors = detectors.map(|own| Detectors::new(own, &upwards, azimuth, [1.0; 2]));
    let numbered = (0..).zip(&directions);
    let lit = measurement.lit(numbered, |(stream, &direction), wavelengths| LitCanopy {
        stage: &stage,
        period,
        ledger: &ledger,
        direction,
        azimuth,
        detectors: detectors.as_ref(),
        wavelengths,
        stream,
    });
    let found = estimates(&lit, measurement.effort);
    let seen = canopy.detector.as_ref().map(angles).unwrap_or_default();
    let mut all = Vec::new();
    for (figures, &direction) in found.chunks(sets).zip(&directions) {
        let mut series = Vec::new();
        for (number, quantity) in ledger.quantities.iter().enumerate() {
            let mut row = measurement.row(quantity.word, direction);
            row.part.clone_from(&quantity.part);
            series.push(Series {
                row,
                photons: quantity.photons,
                figures: measurement.by_wavelength(figures, number),
            });
        }
        for (number, &view) in seen.iter().enumerate() {
            let mut row = measurement.row(factor_of(direction), direction);
            row.view = Some(view);
            let number = ledger.quantities.len() + number;
            series.push(Series::new(row, measurement.by_wavelength(figures, number)));
        }
        all.extend(measurement.rows(&series));
    }
    let lights = lit.iter().step_by(sets);
    let lights = lights.map(|lit| (lit, lit.direction, None));
    let (sample, manner) = ((&stage, &period), fluorescence_of(canopy));
    all.extend(fluorescence::read_out(measurement, sample, lights, &manner));
    Ok(stage.reading(all))
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
    measurement: &Measurement<'_>,
    (stage, period): (&Stage<'_>, &Period),
    canopy: &Canopy,
) -> Result<(), InstrumentError> {
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
        detector::check(measurement, stage, detector)?;
    }
    for (asked, problem) in untold {
        if let (true, Some(object)) = (asked, stage.filled()) {
            return Err(measurement.inside(object, problem));
        }
    }
    if let Some(soil) = canopy.soil
        && !is_covered(stage, period, soil)
    {
        let object = measurement.object(soil);
        return Err(measurement.refuse(Problem::SoilTooSmall { object }));
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
