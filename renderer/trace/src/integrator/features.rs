//! Features: data of a sample besides radiance, for compositing and denoising.

use crate::integrator::path::FirstHit;
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthSampler, Wavelengths, cie};

/// A quantity of the first hit of a camera ray: up to three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Point, world, m.
    Position,
    /// Unit shading normal on the side of the camera, world.
    Normal,
    /// Linear sRGB of the surface under white light.
    Albedo,
    /// Share of light that the surface scatters, mean over the bands of a spectral film.
    MeanAlbedo,
    /// Number + 1 of the object.
    Object,
}

impl Quantity {
    /// Its numbers; if there are fewer than three, the others are 0.
    #[inline]
    pub fn of<const N: usize>(self, sight: &Sight<'_, N>) -> [f32; 3] {
        let hit = sight.hit;
        match self {
            Self::Position => hit.position.to_array(),
            Self::Normal => hit.normal.to_array(),
            Self::Albedo => sight.colour(hit.albedo),
            Self::MeanAlbedo => [sight.mean(hit.albedo), 0.0, 0.0],
            Self::Object => [hit.object.saturating_add(1) as f32, 0.0, 0.0],
        }
    }
}

/// The first hit of a sample's camera ray, with the data needed to convert it to features.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a, const N: usize> {
    /// The place.
    pub hit: &'a FirstHit<N>,
    /// The path's wavelengths.
    pub wavelengths: &'a Wavelengths<N>,
    /// Converts them to colours.
    pub sampler: &'a WavelengthSampler,
    /// Light for the albedo's colour, see [`white`].
    pub white: &'a Spectrum,
    /// Sum of the albedo over the channels of all other groups.
    pub others: f32,
    /// Whether the film records features of this sample. If not, numbers only need to be finite
    /// where the true ones are.
    pub recorded: bool,
}

impl<const N: usize> Sight<'_, N> {
    /// Linear sRGB of a surface that scatters a share of each wavelength, computed only if it is
    /// recorded.
    fn colour(&self, share: Lanes<N>) -> [f32; 3] {
        let mut colour = [0.0; 3];
        if self.recorded {
            let seen = share * self.white.lanes(self.wavelengths);
            self.sampler
                .film_values(self.wavelengths, &seen, &mut colour);
        }
        colour
    }

    /// Mean over the bands, of which each has a wavelength of its own.
    fn mean(&self, share: Lanes<N>) -> f32 {
        let sum = self.others + self.sampler.sum_of_seen(self.wavelengths, &share);
        sum / self.sampler.channels() as f32
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

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::spectrum::recorded::{Band, FilmKind};

    #[test]
    fn the_mean_albedo_is_that_of_the_bands_and_of_no_lane_beyond() {
        let bands = [500.0, 700.0, 900.0].map(|center_nm| Band {
            center_nm,
            width_nm: 10.0,
        });
        let bands = bands.to_vec();
        let sampler = WavelengthSampler::new(&FilmKind::Spectral { bands });
        let hit = FirstHit {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            albedo: Lanes([0.1, 0.3, 0.8, 7.0]),
            object: 0,
        };
        let sight = Sight {
            hit: &hit,
            wavelengths: &sampler.draw::<4>(0.5, 0),
            sampler: &sampler,
            white: &white(&sampler),
            others: 0.0,
            recorded: true,
        };
        let [mean, ..] = Quantity::MeanAlbedo.of(&sight);
        assert!((mean - 0.4).abs() < 1e-6, "{mean}");
    }
}
