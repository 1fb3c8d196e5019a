//! The goniometer.
//!
//! The sample is lit from one side and seen from many directions, before and behind. What it sends
//! into a direction, over what it takes in of the beam, is its BRDF or BTDF; times π, the factor by
//! which it is brighter than a perfect diffuser.

use std::f64::consts::FRAC_1_PI;

use super::batches::{Estimate, Experiment};
use super::detector::{self, Detectors, angles};
use super::error::InstrumentError;
use super::flux::{Escaped, Event, Flux, LANES, Scattering, Straight, Witness};
use super::lamp::{Bench, FACES, Lamp};
use super::ledger::add;
use super::measurement::Measurement;
use super::row::{Direction, Reading};
use super::spectral::Series;
use super::stage::Stage;
use crate::sampling::stream::Stream;
use crate::scene::description::Gonio;
use crate::spectrum::{Lanes, Wavelengths};

/// One light on one face, at one set of wavelengths.
struct LitSample<'a> {
    stage: &'a Stage<'a>,
    lamp: &'a Lamp<'a>,
    /// Before the sample and behind it.
    detectors: &'a [Detectors; 2],
    wavelengths: Wavelengths<LANES>,
}

impl Experiment for LitSample<'_> {
    fn sums(&self) -> usize {
        1 + 2 * self.detectors[0].len() * LANES
    }

    fn end(&self, rays: u64) {
        self.stage.cuts.measured(rays);
    }

    fn stream(&self) -> u32 {
        self.lamp.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let ray = self.lamp.ray(stream);
        let flux = Flux::new(self.stage, &Straight, &self.wavelengths, 1);
        let mut tally = GonioTally {
            lit: self,
            sums,
            is_lit: false,
        };
        flux.of_lamp(ray, stream, &mut tally);
        if tally.is_lit {
            sums[0] += 1.0;
        }
    }
}

/// The sums to which one ray adds.
struct GonioTally<'a> {
    lit: &'a LitSample<'a>,
    sums: &'a mut [f64],
    /// Whether the ray has met the sample.
    is_lit: bool,
}

impl GonioTally<'_> {
    fn add(&mut self, side: usize, number: usize, seen: Lanes<LANES>) {
        add(
            self.sums,
            side * self.lit.detectors[0].len() + number,
            &seen,
        );
    }
}

impl Witness<'_> for GonioTally<'_> {
    fn scattering(&mut self, at: &Scattering<'_>) {
        let lit = self.lit;
        for (side, detectors) in lit.detectors.iter().enumerate() {
            detectors.see((lit.stage, &Straight), at, |number, seen| {
                self.add(side, number, seen);
            });
        }
    }

    fn event(&mut self, _event: &Event) {
        self.is_lit = true;
    }

    fn escape(&mut self, escaped: &Escaped) {
        // What passes beside the sample is no part of the measurement.
        if !self.is_lit {
            return;
        }
        for (side, detectors) in self.lit.detectors.iter().enumerate() {
            detectors.gather(escaped, |number, seen| self.add(side, number, seen));
        }
    }
}

/// Quantities of a light, before the sample and behind it, each with what a factor is multiplied by
/// and the unit.
fn quantities(light: Direction) -> [&'static [(&'static str, f64, &'static str)]; 2] {
    match light {
        Direction::Beam(_) => [
            &[("brf", 1.0, "1"), ("brdf", FRAC_1_PI, "sr-1")],
            &[("btf", 1.0, "1"), ("btdf", FRAC_1_PI, "sr-1")],
        ],
        Direction::Diffuse => [&[("hdrf", 1.0, "1")], &[("hdtf", 1.0, "1")]],
    }
}

/// Measures.
pub(super) fn read_out(
    measurement: &Measurement<'_>,
    gonio: &Gonio,
) -> Result<Reading, InstrumentError> {
    let bench = Bench::new(measurement, &gonio.sample)?;
    detector::check(measurement, &bench.stage, &gonio.detector)?;
    detector::check_layers(measurement, &bench.stage, false)?;
    let lamps = bench.lamps(&gonio.sample);
    let detectors: Vec<[Detectors; 2]> = lamps
        .iter()
        .map(|lamp| {
            [1.0, -1.0].map(|side| {
                let senses = [lamp.turn, side];
                Detectors::new(&gonio.detector, &lamp.frame, lamp.azimuth, senses)
            })
        })
        .collect();
    let pairs = lamps.iter().zip(&detectors);
    let lit = measurement.lit(pairs, |(lamp, detectors), wavelengths| LitSample {
        stage: &bench.stage,
        lamp,
        detectors,
        wavelengths,
    });
    let found = measurement.estimates(&lit, gonio.sample.object)?;
    let views = angles(&gonio.detector);
    let mut all = Vec::new();
    for (figures, lamp) in found.chunks(measurement.sets()).zip(&lamps) {
        let mut series = Vec::new();
        for (side, quantities) in quantities(lamp.direction).into_iter().enumerate() {
            for (number, &view) in views.iter().enumerate() {
                let number = side * views.len() + number;
                let factors = measurement.by_wavelength(figures, number);
                for &(quantity, times, unit) in quantities {
                    let mut row = measurement.row(quantity, lamp.direction);
                    row.face = Some(FACES[lamp.face]);
                    row.view = Some(view);
                    row.unit = unit;
                    let scaled = |factor| Estimate::weighted([(factor, times)].into_iter());
                    series.push(Series::new(row, factors.iter().map(scaled).collect()));
                }
            }
        }
        all.extend(measurement.rows(&series));
    }
    Ok(bench.stage.reading(all))
}
