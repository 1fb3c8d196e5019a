//! What a picture records besides radiance: layers for compositing and denoising.

use crate::integrator::path::{FirstHit, PathResult};
use crate::spectrum::cie;
use crate::spectrum::{Curve, Spectrum, WavelengthSampler, Wavelengths};

/// Values of a sample, in this order: the film's own channels (R, G, B or bands), coverage, then sums over
/// covered samples of distance, position, normal and, on a colour film, albedo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// R, G, B or the bands.
    pub beauty: usize,
    /// Whether albedo is recorded.
    pub albedo: bool,
}

/// Most values of a sample: 32 bands and the layers.
pub const MOST_CHANNELS: usize = 48;

impl Layout {
    /// For a film of this kind.
    pub fn new(wavelengths: &WavelengthSampler) -> Self {
        Self {
            beauty: wavelengths.channels(),
            albedo: wavelengths.is_rgb(),
        }
    }

    /// Place of coverage.
    pub fn alpha(self) -> usize {
        self.beauty
    }

    /// Place of distance.
    pub fn depth(self) -> usize {
        self.beauty + 1
    }

    /// Place of x of the position.
    pub fn position(self) -> usize {
        self.beauty + 2
    }

    /// Place of x of the normal.
    pub fn normal(self) -> usize {
        self.beauty + 5
    }

    /// Place of red of the albedo.
    pub fn albedo(self) -> usize {
        self.beauty + 8
    }

    /// Values of a sample.
    pub fn channels(self) -> usize {
        self.beauty + 8 + if self.albedo { 3 } else { 0 }
    }

    /// Fills a sample's values from what its path found; albedo is shown under the light `white`.
    pub fn fill<const N: usize>(
        self,
        sampler: &WavelengthSampler,
        wavelengths: &Wavelengths<N>,
        found: &PathResult<N>,
        white: &Spectrum,
        values: &mut [f32],
    ) {
        sampler.film_values(wavelengths, &found.radiance, &mut values[..self.beauty]);
        values[self.beauty..].fill(0.0);
        let Some(FirstHit {
            distance,
            position,
            normal,
            albedo,
        }) = &found.first
        else {
            return;
        };
        values[self.alpha()] = 1.0;
        values[self.depth()] = *distance;
        values[self.position()..][..3].copy_from_slice(&position.to_array());
        values[self.normal()..][..3].copy_from_slice(&normal.to_array());
        if self.albedo {
            let seen = *albedo * white.lanes(wavelengths);
            sampler.film_values(wavelengths, &seen, &mut values[self.albedo()..][..3]);
        }
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
