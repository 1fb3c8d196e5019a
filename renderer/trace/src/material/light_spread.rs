//! The sideways spread of light that a blade lets through.
//!
//! `docs/src/theory/light-spread.md` derives the kernel and its length; `reference/run light-spread`
//! measures both by a Monte Carlo simulation.

use std::f32::consts::TAU;

use glam::Vec2;
use optics::{Constituent, Contents, Texel};

use super::contents_texture::ContentsTexture;
use super::palette::Palette;
use crate::sampling::mixer::{Sequence, mixed};
use crate::spectrum::{Curve, Spectrum, WavelengthGrid, Wavelengths};

/// Range over which lengths are tabulated, nm; the end values hold outside, as PROSPECT's do.
const RANGE_NM: [f64; 2] = [400.0, 2500.0];

/// The spread of light that leaves a blade opposite to where it entered.
///
/// Light that leaves at `x` entered at `x + r` with the density `e^(−r/s) / (2π s²)`, with the
/// length `s` of [`length`]. Each look-up draws one `r`, so a mean over many look-ups is exact.
#[derive(Clone, Debug)]
pub struct LightSpread {
    /// A thickness of the blade in texture coordinates.
    thickness_uv: Vec2,
    /// The length `s` over the thickness.
    length: Spectrum,
}

/// Length `s` of the kernel over the thickness of a blade with the structure `N` that absorbs
/// `Σ C k`: `0.81 / ((1 + 0.18 (N − 1)) ∛(1 + 6.2 Σ C k))`.
///
/// Fitted to a slab with rough faces whose scattering is such that it transmits what `N` plates do;
/// for `N` from 1.3 to 3 and `Σ C k` from 0 to 3 the root mean square error is 4 %.
pub fn length(structure: f64, absorbed: f64) -> f64 {
    0.81 / ((1.0 + 0.18 * (structure - 1.0)) * libm::cbrt(1.0 + 6.2 * absorbed))
}

impl LightSpread {
    /// The spread in a blade that holds `mean` in the mean and of which one thickness is
    /// `thickness_uv` in texture coordinates.
    pub fn new(thickness_uv: Vec2, mean: &Contents, palette: &Palette) -> Self {
        let [first, last] = RANGE_NM;
        let at = |nm| {
            let absorption = palette.coefficients(nm).absorption;
            let each = Constituent::ABSORBING.iter();
            let absorbed = each.map(|&one| mean[one] * absorption[one]).sum();
            length(mean[Constituent::Structure], absorbed)
        };
        Self {
            thickness_uv,
            length: Spectrum::from(Curve::uniform(first, 1.0, (last - first) as usize, at)),
        }
    }

    /// Evaluates the lengths at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.length.tabulate(grid);
    }

    /// A thickness of the blade in texture coordinates.
    pub fn thickness_uv(&self) -> Vec2 {
        self.thickness_uv
    }

    /// Where light entered that leaves at `uv`, with the length of each wavelength. The place
    /// depends on `uv` and the wavelengths alone, like a random number.
    ///
    /// Around a point the texel is drawn by the weights of bilinear interpolation.
    #[inline(always)]
    pub fn entry<const N: usize>(
        &self,
        map: &ContentsTexture,
        uv: Vec2,
        wavelengths: &Wavelengths<N>,
    ) -> Entry<N> {
        let [u1, u2, turn, within_x, within_y] = numbers(uv, wavelengths.nm[0]);
        let radius = -libm::logf((1.0 - u1) * (1.0 - u2));
        let (sin, cos) = libm::sincosf(TAU * turn);
        let offset = self.thickness_uv * Vec2::new(cos, sin) * radius;
        let within = Vec2::new(within_x, within_y);
        let lengths = self.length.lanes(wavelengths);
        // No closure: it would be compiled without the vector instructions of its caller.
        let mut texels = [0; N];
        for (texel, length) in texels.iter_mut().zip(lengths.0) {
            *texel = map.drawn(uv + offset * length, within);
        }
        Entry {
            texels,
            uv,
            offset,
            within,
        }
    }

    /// What the blade holds where light entered, at the same wavelengths. Where the kernel meets
    /// texels outside the blade it is turned round.
    #[inline(always)]
    pub fn entered<'m, const N: usize>(
        &self,
        map: &'m ContentsTexture,
        entry: &Entry<N>,
        wavelengths: &Wavelengths<N>,
    ) -> [&'m Texel; N] {
        let mut entered = entry.texels.map(|texel| map.texel(texel));
        for (lane, entered) in entered.iter_mut().enumerate() {
            if !is_tissue(entered) {
                let length = self.length.lanes(wavelengths).0[lane];
                *entered = entry.turned_round(map, length);
            }
        }
        entered
    }
}

/// Where light entered that leaves at a point, for each of a path's wavelengths.
#[derive(Clone, Copy, Debug)]
pub struct Entry<const N: usize> {
    /// Numbers of the texels of a map.
    pub texels: [u32; N],
    /// Where it leaves.
    uv: Vec2,
    /// The way from there for a length of 1, in texture coordinates.
    offset: Vec2,
    /// The numbers that choose between the four texels around a place.
    within: Vec2,
}

impl<const N: usize> Entry<N> {
    /// What is held at the opposite place, or, outside the blade, where the light leaves.
    #[cold]
    fn turned_round<'m>(&self, map: &'m ContentsTexture, length: f32) -> &'m Texel {
        let [opposite, here] = [self.uv - self.offset * length, self.uv]
            .map(|place| map.texel(map.drawn(place, self.within)));
        if is_tissue(opposite) { opposite } else { here }
    }
}

/// Whether a texel is within the blade or was extended from it.
fn is_tissue(texel: &Texel) -> bool {
    texel[Constituent::Structure] >= 1.0
}

/// Five numbers in [0, 1) from the bits of a place and a wavelength.
#[inline]
fn numbers(uv: Vec2, nm: f32) -> [f32; 5] {
    let place = u64::from(uv.x.to_bits()) << 32 | u64::from(uv.y.to_bits());
    let mut sequence = Sequence(place ^ mixed(u64::from(nm.to_bits())));
    let mut next = || {
        let bits = sequence.next();
        // 24 bits fill the digits of a float.
        [bits >> 40, (bits >> 8) & 0xff_ffff].map(|bits| bits as f32 * (1.0 / 16_777_216.0))
    };
    let ([a, b], [c, d], [e, _]) = (next(), next(), next());
    [a, b, c, d, e]
}

#[cfg(test)]
mod tests;
