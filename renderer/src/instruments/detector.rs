//! Detectors far away, and what of followed light they see.
//!
//! The figure of a detector is the radiance of the sample towards it over that of a perfect diffuser
//! in the same light: a reflectance factor, or a transmittance factor behind the sample. Of a cone
//! it is the mean, weighted by the cosine, as the diffuser's light in it is.
//!
//! A scattering event sends flux `f |cos|` into each solid angle, wherever its BSDF is finite. The
//! next-event estimator adds what of it arrives unhindered; light that a mirror sends, which has no
//! such value, is counted where it leaves. Counting all light that leaves within the cone has the
//! same mean.

use std::f64::consts::PI;

use glam::{DVec3, Vec2};

use super::error::InstrumentError;
use super::flux::{Course, Escaped, LANES, Scattering, Staged};
use super::measurement::Measurement;
use super::row::ViewAngles;
use super::stage::Stage;
use crate::bsdf::Scattered;
use crate::geometry::frame::Frame;
use crate::sampling::warp;
use crate::scene::description::{Detector, Estimator};
use crate::spectrum::Lanes;

/// Fails if a leaf of layers is measured in a way that it has no figures for.
pub(super) fn check_layers(
    measurement: &Measurement<'_>,
    stage: &Stage<'_>,
    constituents: bool,
) -> Result<(), InstrumentError> {
    match stage.layered() {
        Some(object) if constituents => Err(measurement.inside(
            object,
            "is a leaf of layers, whose absorption is not split by constituents: leave out \
             `constituents`",
        )),
        Some(_) | None => Ok(()),
    }
}

/// Fails if next events are asked for where they would miss light: that which a medium scatters, and
/// that which leaves a leaf of layers elsewhere than it came in.
pub(super) fn check(
    measurement: &Measurement<'_>,
    stage: &Stage<'_>,
    detector: &Detector,
) -> Result<(), InstrumentError> {
    let unseen = [
        (
            stage.filled(),
            "is filled by a medium, whose scattering next events do not see: write \
             `estimator = \"count\"` in `detector`",
        ),
        (
            stage.passed(),
            "has no boundary for light, but one for next events: write \
             `estimator = \"count\"` in `detector`",
        ),
        (
            stage.layered(),
            "is a leaf of layers, through which next events do not see: write \
             `estimator = \"count\"` in `detector`",
        ),
    ];
    for (object, problem) in unseen {
        if let (true, Some(object)) = (detector.has_next_events(), object) {
            return Err(measurement.inside(object, problem));
        }
    }
    Ok(())
}

/// One direction of a detector.
#[derive(Clone, Copy, Debug)]
struct Towards {
    /// The frame about it: +z to the detector.
    frame: Frame,
    /// Reflectance factor of unit flux for each solid angle, and of unit flux in the cone.
    of_intensity: f32,
    of_flux: f32,
}

/// A detector in all its directions.
#[derive(Clone, Debug)]
pub(super) struct Detectors {
    towards: Vec<Towards>,
    /// One less the cosine of the half-angle.
    opening: f32,
    estimator: Estimator,
}

/// The angles of a detector, in the order of its figures.
pub(super) fn angles(detector: &Detector) -> Vec<ViewAngles> {
    let of_azimuth = |&azimuth: &f64| {
        let zeniths = detector.zeniths.iter();
        zeniths.map(move |&zenith| ViewAngles { zenith, azimuth })
    };
    detector.azimuths.iter().flat_map(of_azimuth).collect()
}

impl Detectors {
    /// A detector over a surface whose frame and normal these are, and the azimuth of the light, in
    /// the frame. The senses are those of azimuths, -1 in a mirrored frame, and of the normal, -1
    /// behind the surface.
    pub(super) fn new(
        detector: &Detector,
        frame: &Frame,
        azimuth: f64,
        [turn, side]: [f64; 2],
    ) -> Self {
        let alpha = detector.half_angle;
        // ∫ cos θ dω over a cone about θ is π sin² α cos θ; its solid angle is 2π (1 − cos α).
        let opening = 1.0 - libm::cos(alpha);
        let spread = 2.0 / (1.0 + libm::cos(alpha));
        let towards = angles(detector).into_iter().map(|angles| {
            let (sin, cos) = libm::sincos(angles.zenith);
            let (sin_azimuth, cos_azimuth) = libm::sincos(azimuth + turn * angles.azimuth);
            let local = DVec3::new(sin * cos_azimuth, sin * sin_azimuth, side * cos);
            Towards {
                frame: Frame::from_normal(frame.to_world(local.as_vec3()).normalize()),
                of_intensity: (PI * spread / cos) as f32,
                of_flux: (1.0 / (libm::sin(alpha).powi(2) * cos)) as f32,
            }
        });
        Self {
            towards: towards.collect(),
            opening: opening as f32,
            estimator: detector.estimator,
        }
    }

    /// Number of directions.
    pub(super) fn len(&self) -> usize {
        self.towards.len()
    }

    /// What each direction sees of a scattering event, by its number.
    pub(super) fn see(
        &self,
        (stage, course): (&Stage<'_>, &impl Course),
        at: &Scattering<'_>,
        mut add: impl FnMut(usize, Lanes<LANES>),
    ) {
        match self.estimator {
            Estimator::NextEvent => {}
            Estimator::Count => return,
        }
        let encounter = at.encounter;
        let around = Staged(stage, course);
        let facet = encounter.facet(&around);
        let [u, v, ..] = at.numbers;
        // The same place in all cones.
        let local = warp::cone(Vec2::new(u, v), self.opening);
        for (number, towards) in self.towards.iter().enumerate() {
            let direction = if self.opening > 0.0 {
                towards.frame.to_world(local)
            } else {
                towards.frame.normal
            };
            let (wi, Scattered { f, .. }) = facet.scatter((&encounter.frame, at.view), direction);
            let of_intensity = wi.z.abs()
                * encounter.bsdf.flux_over_radiance(encounter.wo, wi)
                * towards.of_intensity;
            let seen = at.weight * f * of_intensity;
            if !seen.is_zero() && course.is_clear(stage, facet.spawn(direction), &seen) {
                add(number, seen);
            }
        }
    }

    /// What each direction sees of light that leaves, by its number.
    pub(super) fn gather(&self, escaped: &Escaped, mut add: impl FnMut(usize, Lanes<LANES>)) {
        let is_counted = match self.estimator {
            Estimator::NextEvent => escaped.is_specular,
            Estimator::Count => true,
        };
        if !is_counted || self.opening == 0.0 {
            return;
        }
        for (number, towards) in self.towards.iter().enumerate() {
            // |a − b|² is 2 (1 − cos), also of angles that a cosine in f32 cannot tell.
            let apart = escaped.direction.distance_squared(towards.frame.normal);
            if apart <= 2.0 * self.opening {
                add(number, escaped.weight * towards.of_flux);
            }
        }
    }
}
