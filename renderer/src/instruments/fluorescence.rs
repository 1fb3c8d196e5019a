//! Fluorescence of a sample: light of some wavelengths is followed to leaves, and what these emit is
//! followed at other wavelengths until it leaves or is absorbed.
//!
//! Wherever light meets a leaf that fluoresces, the leaf emits the mean of what that light excites.
//! What is emitted scatters and is absorbed as any light; that it excites other leaves in turn is
//! left out.

use glam::{Vec2, Vec3};

use super::batches::{Experiment, estimates};
use super::flux::{Course, Escaped, Event, Flux, LANES, Passage, Staged, Struck, Witness};
use super::ledger::add_each;
use super::measurement::Measurement;
use super::row::{Direction, Row};
use super::stage::Stage;
use crate::bsdf::fluorescence::{sent_out, taken_in};
use crate::geometry::Ray;
use crate::geometry::frame::Frame;
use crate::geometry::surface::SurfacePoint;
use crate::material::leaf::LeafMaterial;
use crate::sampling::dimensions::instrument as sets;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::ExcitationLight;
use crate::spectrum::{Curve, Lanes, Share, Wavelengths};
use crate::walk::facet::{Facet, Surroundings};

/// Step by which a spectrum is resolved, nm.
const STEP_NM: f64 = 5.0;

const EMITTED: usize = 0;
const BACK: usize = 1;
const FORTH: usize = 2;
const ABSORBED: usize = 3;
const BY_SOIL: usize = 4;
/// Number of quantities.
const QUANTITIES: usize = 5;

/// Light of an instrument.
pub(super) trait Illumination: Sync {
    /// One of its rays, for which it takes one set of random numbers.
    fn ray(&self, stream: &mut Stream) -> Ray;
    /// Whether light in this direction goes back to where the rays come from.
    fn is_back(&self, direction: Vec3) -> bool;
}

/// How an instrument shows what it finds.
pub(super) struct Manner {
    /// Words for what is emitted, leaves backwards, leaves forwards, is absorbed, and is absorbed by
    /// soil; those without a word are not told.
    pub(super) words: [Option<&'static str>; QUANTITIES],
    /// Ways in which light goes on from its first event.
    pub(super) ways: u32,
    /// Whether rays that meet nothing count.
    pub(super) counts_misses: bool,
    /// The object that is soil.
    pub(super) soil: Option<usize>,
}

/// Wavelengths that light is followed at together.
struct Packet {
    wavelengths: Wavelengths<LANES>,
    /// Photons of each, in any unit.
    photons: [f64; LANES],
}

/// Light that excites, one after the other: its name and its packets.
fn excitations(light: &ExcitationLight) -> Vec<(String, Vec<Packet>)> {
    match light {
        ExcitationLight::Monochromatic(list) => list
            .iter()
            .map(|&nm| {
                let mut photons = [0.0; LANES];
                photons[0] = 1.0;
                let wavelengths = Wavelengths::new([nm as f32; LANES]);
                let packet = Packet {
                    wavelengths,
                    photons,
                };
                (format!("excited at {nm} nm"), vec![packet])
            })
            .collect(),
        ExcitationLight::Spectrum(spectrum) => {
            let curve = Curve::from_description(spectrum);
            let [first, last] = leafmodel::optics::fluorescence::EXCITED_NM;
            let count = ((last - first) / STEP_NM) as usize;
            let middles: Vec<f64> = (0..count)
                .map(|i| first + STEP_NM * (i as f64 + 0.5))
                .collect();
            let packet = |own: &[f64]| {
                let nm = std::array::from_fn(|i| own[i.min(own.len() - 1)]);
                let photons = std::array::from_fn(|i| {
                    // Energy times wavelength is a number of photons but for hc.
                    let mean = curve.over(&Share::around(nm[i], STEP_NM));
                    let energy = f64::from(mean) * STEP_NM;
                    if i < own.len() { energy * nm[i] } else { 0.0 }
                });
                let wavelengths = Wavelengths::new(nm.map(|nm| nm as f32));
                Packet {
                    wavelengths,
                    photons,
                }
            };
            let packets = middles.chunks(LANES).map(packet).collect();
            vec![("excited by the spectrum".to_owned(), packets)]
        }
    }
}

/// One light, one excitation, and one set of wavelengths at which emission is measured.
struct FluorescenceExperiment<'a, L, C> {
    stage: &'a Stage<'a>,
    light: &'a L,
    course: &'a C,
    manner: &'a Manner,
    packets: &'a [Packet],
    emission: Wavelengths<LANES>,
    stream: u32,
}

impl<L: Illumination, C: Course + Sync> FluorescenceExperiment<'_, L, C> {
    fn flux<'w>(&'w self, wavelengths: &'w Wavelengths<LANES>, ways: u32) -> Flux<'w, C> {
        Flux::new(self.stage, self.course, wavelengths, ways)
    }
}

impl<L: Illumination, C: Course + Sync> Experiment for FluorescenceExperiment<'_, L, C> {
    fn sums(&self) -> usize {
        1 + QUANTITIES * LANES
    }

    fn end(&self, rays: u64) {
        self.stage.cuts.measured(rays);
    }

    fn stream(&self) -> u32 {
        self.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let ray = self.light.ray(stream);
        let count = self.packets.len();
        stream.seek(sets::PACKET.of(0));
        let which = (stream.next4()[0] * count as f32) as usize;
        let packet = &self.packets[which.min(count - 1)];
        let mut exciting = Exciting {
            packet,
            emission: &self.emission,
            is_lit: false,
            starts: Vec::new(),
        };
        self.flux(&packet.wavelengths, self.manner.ways)
            .of_lamp(ray, stream, &mut exciting);
        if !exciting.is_lit && !self.manner.counts_misses {
            return;
        }
        sums[0] += 1.0;
        let flux = self.flux(&self.emission, 1);
        let around = Staged(self.stage, self.course);
        for (number, start) in exciting.starts.iter().enumerate() {
            let mut stream = stream.nested(number as u32);
            stream.seek(sets::START.of(0));
            let Some((ray, weights)) = start.ray(&around, stream.next4()) else {
                continue;
            };
            // Roulette knows weights of about 1.
            let greatest = weights.iter().copied().fold(0.0, f64::max);
            let scale = greatest * count as f64;
            let weight = Lanes(weights.map(|weight| (weight / greatest) as f32));
            let mut emitted = Emitted {
                light: self.light,
                soil: self.manner.soil,
                scale,
                sums: &mut *sums,
            };
            emitted.add(EMITTED, |lane| f64::from(weight.0[lane]));
            flux.of_surface((ray, start.passage), weight, &stream, &mut emitted);
        }
    }
}

/// Light that excites, on its way.
struct Exciting<'a, 'm> {
    packet: &'a Packet,
    emission: &'a Wavelengths<LANES>,
    is_lit: bool,
    starts: Vec<Start<'m>>,
}

/// A place where a leaf emits.
struct Start<'m> {
    leaf: &'m LeafMaterial,
    surface: SurfacePoint,
    frame: Frame,
    /// Sign of z of directions on the lit face.
    lit: f32,
    /// What leaves the lit and the other face.
    leaving: [[f64; LANES]; 2],
    /// Where it is, in scenes with media.
    passage: Passage,
}

impl<'m> Witness<'m> for Exciting<'_, 'm> {
    fn struck(&mut self, struck: &Struck<'_, 'm>) {
        self.is_lit = true;
        let Some(leaf) = struck.material.fluorescing() else {
            return;
        };
        let encounter = struck.encounter;
        let (wo, uv) = (encounter.wo, encounter.surface.uv);
        let passed = f64::from(taken_in(leaf.coats(), wo));
        let photons = std::array::from_fn(|lane| {
            self.packet.photons[lane] * f64::from(struck.weight.0[lane]) * passed
        });
        let excited = leaf.excited(uv, &self.packet.wavelengths);
        let source = excited.source(usize::from(wo.z < 0.0), &photons);
        let emitting = leaf.emitting(uv, self.emission);
        self.starts.push(Start {
            leaf,
            surface: encounter.surface,
            frame: encounter.frame,
            lit: 1.0_f32.copysign(wo.z),
            leaving: [false, true].map(|through| emitting.leaving(&source, through)),
            passage: struck.passage,
        });
    }

    fn event(&mut self, _event: &Event) {
        self.is_lit = true;
    }

    fn escape(&mut self, _escaped: &Escaped) {}
}

impl Start<'_> {
    /// A ray of what is emitted, with its weights; `None` if that is nothing.
    fn ray(
        &self,
        around: &impl Surroundings,
        [side, x, y, _]: [f32; 4],
    ) -> Option<(Ray, [f64; LANES])> {
        let [lit, other] = self.leaving.map(|lanes| lanes.iter().sum::<f64>());
        let through = other / (lit + other);
        if !through.is_finite() {
            return None;
        }
        let is_through = f64::from(side) < through;
        let up = warp::cosine_hemisphere(Vec2::new(x, y));
        let sign = if is_through { -self.lit } else { self.lit };
        let local = Vec3::new(up.x, up.y, sign * up.z);
        let sent = f64::from(sent_out(self.leaf.coats(), local));
        let chance = if is_through { through } else { 1.0 - through };
        let weights = self.leaving[usize::from(is_through)].map(|own| own * sent / chance);
        let is_some = up.z > 0.0 && weights.iter().any(|weight| *weight > 0.0);
        is_some.then(|| {
            let facet = Facet {
                around,
                surface: &self.surface,
            };
            let towards = facet.leaving(self.frame.to_world(local));
            (facet.spawn(towards), weights)
        })
    }
}

/// What is emitted, on its way.
struct Emitted<'a, L> {
    light: &'a L,
    soil: Option<usize>,
    /// Photons that a weight of 1 stands for.
    scale: f64,
    sums: &'a mut [f64],
}

impl<L> Emitted<'_, L> {
    fn add(&mut self, quantity: usize, weight: impl Fn(usize) -> f64) {
        let scaled = std::array::from_fn(|lane| self.scale * weight(lane));
        add_each(self.sums, quantity, &scaled);
    }
}

impl<L: Illumination> Witness<'_> for Emitted<'_, L> {
    fn event(&mut self, event: &Event) {
        let is_soil = self.soil == Some(event.object);
        self.add(if is_soil { BY_SOIL } else { ABSORBED }, |lane| {
            f64::from(event.before.0[lane]) - f64::from(event.after.0[lane])
        });
    }

    fn escape(&mut self, escaped: &Escaped) {
        let is_back = self.light.is_back(escaped.direction);
        self.add(if is_back { BACK } else { FORTH }, |lane| {
            f64::from(escaped.weight.0[lane])
        });
    }
}

/// A light with its direction and, of a sphere, the face that it falls on.
pub(super) type Lit<'a, L> = (&'a L, Direction, Option<&'static str>);

/// Measures, for each light, if the instrument measures fluorescence.
pub(super) fn read_out<'l, L: Illumination + 'l, C: Course + Sync>(
    measurement: &Measurement<'_>,
    (stage, course): (&Stage<'_>, &C),
    lights: impl Iterator<Item = Lit<'l, L>>,
    manner: &Manner,
) -> Vec<Row> {
    let Some(reading) = &measurement.instrument.value.fluorescence else {
        return Vec::new();
    };
    let lights: Vec<Lit<'_, L>> = lights.collect();
    let excitations = excitations(&reading.light);
    let unit = match reading.light {
        ExcitationLight::Monochromatic(_) => "1/nm",
        ExcitationLight::Spectrum(_) => "W/(m^2 nm)",
    };
    let nm = &reading.emission_nm;
    let emissions: Vec<Wavelengths<LANES>> = nm
        .chunks(LANES)
        .map(|own| {
            let lane = |i: usize| own[i.min(own.len() - 1)] as f32;
            Wavelengths::new(std::array::from_fn(lane))
        })
        .collect();
    let mut readings = Vec::new();
    for (stream, (light, ..)) in (0..).zip(&lights) {
        for (_, packets) in &excitations {
            for emission in &emissions {
                readings.push(FluorescenceExperiment {
                    stage,
                    light: *light,
                    course,
                    manner,
                    packets,
                    emission: *emission,
                    stream,
                });
            }
        }
    }
    let found = estimates(&readings, measurement.effort);
    let mut found = found.chunks(emissions.len());
    let mut rows = Vec::new();
    for (_, incidence, face) in &lights {
        for (excitation, _) in &excitations {
            let figures = found
                .next()
                .expect("each light and excitation was measured");
            for (i, &wavelength_nm) in nm.iter().enumerate() {
                // Photons of a spectrum were counted in energy times wavelength.
                let per_photon = match reading.light {
                    ExcitationLight::Monochromatic(_) => 1.0,
                    ExcitationLight::Spectrum(_) => 1.0 / wavelength_nm,
                };
                for (quantity, word) in manner.words.iter().enumerate() {
                    let Some(word) = word else { continue };
                    let of = |quantity| figures[i / LANES][quantity * LANES + i % LANES];
                    let mut figure = of(quantity);
                    if figure.value == 0.0 {
                        // The error is that of a share then, here of what is emitted.
                        figure.error *= of(EMITTED).value;
                    }
                    rows.push(Row {
                        face: *face,
                        part: Some(excitation.clone()),
                        wavelength_nm: Some(wavelength_nm),
                        value: figure.value * per_photon,
                        error: figure.error * per_photon,
                        unit,
                        ..measurement.row(word, *incidence)
                    });
                }
            }
        }
    }
    rows
}
