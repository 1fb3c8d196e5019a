//! The integrating sphere.
//!
//! The sample is lit from one side, by parallel light or by even light from the half space, and
//! everything that it sends back into that half space is reflected, everything that goes on into
//! the other is transmitted. The rest is absorbed. Light that leaves does not come back: the sphere
//! is an ideal one, without the error of substitution.

use glam::Vec3;

use super::batches::{Estimate, Experiment};
use super::constituents::{self, PARTS};
use super::detector::check_layers;
use super::error::InstrumentError;
use super::fluorescence::{self, Illumination, Manner};
use super::flux::{Escaped, Event, Flux, LANES, Straight, Witness};
use super::lamp::{Bench, FACES, Lamp};
use super::measurement::Measurement;
use super::row::Reading;
use super::spectral::Series;
use super::stage::Stage;
use crate::geometry::Ray;
use crate::sampling::stream::Stream;
use crate::scene::description::Sample;
use crate::spectrum::Wavelengths;

/// Ways in which light goes on from where it first meets the sample. Whether it is reflected or
/// transmitted is most of what differs between rays, and costs less than another ray.
const WAYS: u32 = 8;
/// Figures of a wavelength, each with the word for its photon flux.
const QUANTITIES: [(&str, &str); 3] = [
    ("reflectance", "reflected_photon_flux"),
    ("transmittance", "transmitted_photon_flux"),
    (ABSORPTANCE, "absorbed_photon_flux"),
];
const ABSORPTANCE: &str = "absorptance";
/// What is told of each constituent.
const BY_CONSTITUENT: (&str, &str) = (
    "absorbed_by_constituent",
    "photon_flux_absorbed_by_constituent",
);

/// How fluorescence is shown.
const FLUORESCENCE: Manner = Manner {
    words: [
        Some("fluorescence_emitted"),
        Some("fluorescence_backward"),
        Some("fluorescence_forward"),
        Some("fluorescence_absorbed"),
        None,
    ],
    ways: WAYS,
    counts_misses: false,
    soil: None,
};

/// One light on one face, at one set of wavelengths.
struct LitInSphere<'a> {
    stage: &'a Stage<'a>,
    lamp: &'a Lamp<'a>,
    /// Whether absorption is told by constituents.
    constituents: bool,
    wavelengths: Wavelengths<LANES>,
}

impl Experiment for LitInSphere<'_> {
    fn sums(&self) -> usize {
        let parts = if self.constituents { PARTS } else { 0 };
        1 + (QUANTITIES.len() + parts) * LANES
    }

    fn end(&self, rays: u64) {
        self.stage.cuts.measured(rays);
    }

    fn stream(&self) -> u32 {
        self.lamp.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let ray = self.lamp.ray(stream);
        let (counted, parts) = sums.split_at_mut(1 + QUANTITIES.len() * LANES);
        let mut gathered = Gathered {
            lit: self,
            parts,
            normal: self.lamp.frame.normal,
            is_lit: false,
            flux: [[0.0; LANES]; 2],
        };
        let flux = Flux::new(self.stage, &Straight, &self.wavelengths, WAYS);
        flux.of_lamp(ray, stream, &mut gathered);
        if !gathered.is_lit {
            return;
        }
        counted[0] += 1.0;
        for lane in 0..LANES {
            let [r, t] = gathered.flux.map(|of| of[lane]);
            counted[1 + lane] += r;
            counted[1 + LANES + lane] += t;
            counted[1 + 2 * LANES + lane] += 1.0 - r - t;
        }
    }
}

/// What the sphere gathers of one ray.
struct Gathered<'a> {
    lit: &'a LitInSphere<'a>,
    /// Sums of constituents.
    parts: &'a mut [f64],
    /// Out of the face that is lit.
    normal: Vec3,
    /// Whether the ray has met the sample.
    is_lit: bool,
    /// Reflected and transmitted flux.
    flux: [[f64; LANES]; 2],
}

impl Witness<'_> for Gathered<'_> {
    fn event(&mut self, event: &Event) {
        self.is_lit = true;
        if self.lit.constituents {
            let absorbed = constituents::absorbed(self.lit.stage, event, &self.lit.wavelengths);
            let absorbed = absorbed.iter().flat_map(|lanes| lanes.0);
            for (sum, absorbed) in self.parts.iter_mut().zip(absorbed) {
                *sum += f64::from(absorbed);
            }
        }
    }

    fn escape(&mut self, escaped: &Escaped) {
        let side = usize::from(escaped.direction.dot(self.normal) <= 0.0);
        for (sum, weight) in self.flux[side].iter_mut().zip(escaped.weight.0) {
            *sum += f64::from(weight);
        }
    }
}

/// Measures.
pub(super) fn read_out(
    measurement: &Measurement<'_>,
    sample: &Sample,
) -> Result<Reading, InstrumentError> {
    let bench = Bench::new(measurement, sample)?;
    check_layers(measurement, &bench.stage, sample.constituents)?;
    let lamps = bench.lamps(sample);
    let lit = measurement.lit(lamps.iter(), |lamp, wavelengths| LitInSphere {
        stage: &bench.stage,
        lamp,
        constituents: sample.constituents,
        wavelengths,
    });
    let found = measurement.estimates(&lit, sample.object)?;
    let told = QUANTITIES.map(|quantity| (quantity, None));
    let mut told = told.to_vec();
    if sample.constituents {
        told.extend(constituents::names().map(|name| (BY_CONSTITUENT, Some(name))));
    }
    let mut all = Vec::new();
    for (figures, lamp) in found.chunks(measurement.sets()).zip(&lamps) {
        let series = told.iter().enumerate();
        let series = series.map(|(number, ((quantity, photons), part))| {
            let mut row = measurement.row(quantity, lamp.direction);
            row.face = Some(FACES[lamp.face]);
            row.part = part.map(str::to_owned);
            let mut figures = measurement.by_wavelength(figures, number);
            if *quantity == ABSORPTANCE {
                figures = figures.iter().map(Estimate::beyond_rounding).collect();
            }
            Series {
                row,
                photons: Some((photons, 1.0)),
                figures,
            }
        });
        all.extend(measurement.rows(&series.collect::<Vec<_>>()));
    }
    let lights = lamps.iter();
    let lights = lights.map(|lamp| (lamp, lamp.direction, Some(FACES[lamp.face])));
    let sample = (&bench.stage, &Straight);
    all.extend(fluorescence::read_out(
        measurement,
        sample,
        lights,
        &FLUORESCENCE,
    ));
    Ok(bench.stage.reading(all))
}

impl Illumination for Lamp<'_> {
    fn ray(&self, stream: &mut Stream) -> Ray {
        Lamp::ray(self, stream)
    }

    fn is_back(&self, direction: Vec3) -> bool {
        direction.dot(self.frame.normal) > 0.0
    }
}
