//! What a picture records besides radiance: layers for compositing and denoising.

use crate::film::{FEATURE_SAMPLES, Feature};
use crate::integrator::path::PathResult;
use crate::spectrum::cie;
use crate::spectrum::{Curve, Spectrum, WavelengthSampler, Wavelengths};

/// What a film of some kind records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Channels: R, G, B or the bands.
    pub beauty: usize,
    /// Whether albedo is recorded.
    pub albedo: bool,
}

/// Most channels of a film: 32 bands.
pub const MOST_CHANNELS: usize = 32;

impl Layout {
    /// For a film of this kind.
    pub fn new(wavelengths: &WavelengthSampler) -> Self {
        Self {
            beauty: wavelengths.channels(),
            albedo: wavelengths.is_rgb(),
        }
    }

    /// What the path of sample number `number` met first, if anything; albedo is shown under the light `white`, and worked
    /// out only where it is recorded.
    pub fn feature<const N: usize>(
        self,
        number: u32,
        sampler: &WavelengthSampler,
        wavelengths: &Wavelengths<N>,
        found: &PathResult<N>,
        white: &Spectrum,
    ) -> Option<Feature> {
        let first = found.first.as_ref()?;
        let mut albedo = [0.0; 3];
        if self.albedo && number < FEATURE_SAMPLES {
            let seen = first.albedo * white.lanes(wavelengths);
            sampler.film_values(wavelengths, &seen, &mut albedo);
        }
        Some(Feature {
            position: first.position.to_array(),
            normal: first.normal.to_array(),
            albedo,
            object: first.object,
        })
    }
}

/// D65 of luminance 1: a surface of albedo 1 under it is 1 1 1 in linear sRGB.
pub fn white(sampler: &WavelengthSampler) -> Spectrum {
    let luminance = cie::xyz_of(cie::d65)[1];
    let curve = Curve::uniform(300.0, 5.0, 106, |nm| cie::d65(nm) / luminance);
    let mut white = Spectrum::from(curve);
    white.tabulate(sampler.grid());
    white
}
