//! The integrating sphere.
//!
//! The sample is lit from one side, by parallel light or by even light from the half space, and
//! everything that it sends back into that half space is reflected, everything that goes on into
//! the other is transmitted. The rest is absorbed. Light that leaves does not come back: the sphere
//! is an ideal one, without the error of substitution.

use glam::Vec3;

use super::batches::{Effort, Estimate, Experiment, estimates};
use super::constituents::{self, PARTS};
use super::detector::check_layers;
use super::error::{InstrumentError, Problem};
use super::fluorescence::{self, Illumination, Manner};
use super::flux::{Escaped, Event, Flux, LANES, Straight, Witness};
use super::lamp::{Bench, FACES, Lamp};
use super::row::Reading;
use super::spectral::{Series, by_wavelength, plain, rows};
use super::stage::Stage;
use crate::geometry::Ray;
use crate::sampling::stream::Stream;
use crate::scene::description::{Description, Instrument, Named, Sample};
use crate::spectrum::Wavelengths;
use trace::world::World;

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
struct Lit<'a> {
    stage: &'a Stage<'a>,
    lamp: &'a Lamp<'a>,
    /// Whether absorption is told by constituents.
    constituents: bool,
    wavelengths: Wavelengths<LANES>,
}

impl Experiment for Lit<'_> {
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
        let flux = Flux {
            stage: self.stage,
            course: &Straight,
            wavelengths: &self.wavelengths,
            ways: WAYS,
        };
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
    lit: &'a Lit<'a>,
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
    world: &World,
    scene: &Description,
    (instrument, sample): (&Named<Instrument>, &Sample),
    first_set: usize,
    effort: &Effort<'_>,
) -> Result<Reading, InstrumentError> {
    let at = &instrument.value.at;
    let bench = Bench::new(world, scene, sample, at)?;
    check_layers(scene, &bench.stage, &instrument.value, sample.constituents)?;
    let lamps = bench.lamps(sample);
    let count = instrument.value.measured_nm().len();
    let sets = count.div_ceil(LANES);
    let grid = world.wavelengths.grid();
    let lit: Vec<Lit<'_>> = lamps
        .iter()
        .flat_map(|lamp| (0..sets).map(move |set| (lamp, grid.set(first_set + set))))
        .map(|(lamp, wavelengths)| Lit {
            stage: &bench.stage,
            lamp,
            constituents: sample.constituents,
            wavelengths,
        })
        .collect();
    let found = estimates(&lit, effort);
    if found.iter().any(|figures| figures[0].value.is_nan()) {
        return Err(Problem::NothingLit {
            object: scene.objects[sample.object].name.clone(),
        }
        .at(at));
    }
    let mut all = Vec::new();
    for (figures, lamp) in found.chunks(sets).zip(&lamps) {
        let parts = constituents::names().map(|name| (BY_CONSTITUENT, Some(name)));
        let told = QUANTITIES.into_iter().map(|quantity| (quantity, None));
        let told: Vec<_> = if sample.constituents {
            told.chain(parts).collect()
        } else {
            told.collect()
        };
        let series = told.into_iter().enumerate();
        let series: Vec<Series> = series
            .map(|(number, ((quantity, photons), part))| {
                let mut row = plain(&instrument.name, quantity, lamp.direction).row;
                row.face = Some(FACES[lamp.face]);
                row.part = part.map(str::to_owned);
                let mut figures = by_wavelength(figures, number, count);
                if quantity == ABSORPTANCE {
                    figures = figures.iter().map(Estimate::beyond_rounding).collect();
                }
                Series {
                    row,
                    photons: Some((photons, 1.0)),
                    figures,
                }
            })
            .collect();
        all.extend(rows(&instrument.value, &series));
    }
    if let Some(reading) = &instrument.value.fluorescence {
        let lights: Vec<_> = lamps
            .iter()
            .map(|lamp| (lamp, lamp.direction, Some(FACES[lamp.face])))
            .collect();
        let read = (instrument.name.as_str(), reading);
        let sample = (&bench.stage, &Straight);
        let own = fluorescence::read_out(sample, &lights, read, &FLUORESCENCE, effort);
        all.extend(own);
    }
    Ok(Reading {
        rows: all,
        cut: bench.stage.cuts.paths(),
    })
}

impl Illumination for Lamp<'_> {
    fn ray(&self, stream: &mut Stream) -> Ray {
        Lamp::ray(self, stream)
    }

    fn is_back(&self, direction: Vec3) -> bool {
        direction.dot(self.frame.normal) > 0.0
    }
}
