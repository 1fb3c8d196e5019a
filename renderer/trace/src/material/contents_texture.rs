//! Maps of a leaf's contents: float pictures over uv.

use glam::Vec2;
use optics::{Constituent, Contents, PerConstituent, Texel};

use crate::simd;

/// A contents map: bilinear between texel centres, clamped at the border; row 0 is at v = 0.
#[derive(Clone, Debug)]
pub struct ContentsTexture {
    width: u32,
    height: u32,
    texels: Box<[Texel]>,
}

/// The four texels around a place.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    /// Their numbers: left and right of the lower row, then of the upper one.
    pub texels: [u32; 4],
    /// Shares of the right ones and of the upper row.
    shares: [f32; 2],
}

impl ContentsTexture {
    /// A map from `width × height` texels, row by row; they are best in
    /// [huge pages](numerics::memory).
    ///
    /// # Panics
    ///
    /// If the number of texels is not `width × height`, is zero, or does not fit into 32 bits.
    pub fn new(width: usize, height: usize, texels: Vec<Texel>) -> Self {
        assert!(
            !texels.is_empty() && texels.len() == width * height,
            "a map fills its rectangle"
        );
        assert!(u32::try_from(texels.len()).is_ok(), "texels have numbers");
        Self {
            width: width as u32,
            height: height as u32,
            texels: texels.into_boxed_slice(),
        }
    }

    /// Number of texels along u and v.
    pub fn size(&self) -> (usize, usize) {
        (self.width as usize, self.height as usize)
    }

    /// The texels, row by row from v = 0.
    pub fn texels(&self) -> &[Texel] {
        &self.texels
    }

    /// Mean contents over all texels.
    pub fn mean(&self) -> Contents {
        let add = |sum: f64, value: f32| sum + f64::from(value);
        let sums = self
            .texels
            .iter()
            .fold(PerConstituent::splat(0.0), |sums, texel| {
                sums.zip_with(*texel, add)
            });
        Contents(sums.map(|sum| sum / self.texels.len() as f64))
    }

    /// Contents at `uv`.
    #[inline(always)]
    pub fn at(&self, uv: Vec2) -> Texel {
        self.between(&self.around(uv))
    }

    /// The four texels around `uv`.
    #[inline(always)]
    pub fn around(&self, uv: Vec2) -> Around {
        let [x, y] = [uv.x * self.width as f32, uv.y * self.height as f32].map(|at| at - 0.5);
        let (right, top) = (self.width - 1, self.height - 1);
        let (x0, y0) = (simd::whole(x, right), simd::whole(y, top));
        let (x1, y1) = ((x0 + 1).min(right), (y0 + 1).min(top));
        let (below, above) = (y0 * self.width, y1 * self.width);
        Around {
            texels: [below + x0, below + x1, above + x0, above + x1],
            shares: [
                x.clamp(0.0, right as f32) - x0 as f32,
                y.clamp(0.0, top as f32) - y0 as f32,
            ],
        }
    }

    /// Contents between four texels.
    #[inline(always)]
    pub fn between(&self, around: &Around) -> Texel {
        let [share_x, share_y] = around.shares;
        let [a, b, c, d] = around.texels;
        let (a, b) = (self.texel(a).as_array(), self.texel(b).as_array());
        let (c, d) = (self.texel(c).as_array(), self.texel(d).as_array());
        // No closure: it would be compiled without the vector instructions of its caller.
        let mut values = [0.0; Constituent::COUNT];
        for (i, value) in values.iter_mut().enumerate() {
            let below = a[i] * (1.0 - share_x) + b[i] * share_x;
            let above = c[i] * (1.0 - share_x) + d[i] * share_x;
            *value = below * (1.0 - share_y) + above * share_y;
        }
        Texel::new(values)
    }

    /// A texel by its number.
    #[inline(always)]
    pub fn texel(&self, number: u32) -> &Texel {
        &self.texels[number as usize]
    }

    /// Prefetches a texel.
    #[inline(always)]
    pub fn prefetch(&self, number: u32) {
        simd::prefetch(&self.texels, number as usize);
    }

    /// Number of one of the four texels around `uv`, drawn by the numbers `within` in [0, 1) with
    /// the weights of [`ContentsTexture::at`].
    #[inline(always)]
    pub fn drawn(&self, uv: Vec2, within: Vec2) -> u32 {
        let x = uv.x * self.width as f32 - 0.5 + within.x;
        let y = uv.y * self.height as f32 - 0.5 + within.y;
        simd::whole(y, self.height - 1) * self.width + simd::whole(x, self.width - 1)
    }
}

#[cfg(test)]
mod tests {
    use optics::Constituent;

    use super::*;

    #[test]
    fn a_lookup_at_a_texel_centre_gives_the_texel_and_between_two_their_mean() {
        let (structure, chlorophyll) = (Constituent::Structure, Constituent::Chlorophyll);
        let texel =
            |value: f32| Texel::splat(0.0).with(&[(structure, 1.0 + value), (chlorophyll, value)]);
        let map = ContentsTexture::new(2, 2, vec![texel(1.0), texel(2.0), texel(3.0), texel(4.0)]);
        let at = |x, y| map.at(Vec2::new(x, y));
        assert_eq!(at(0.25, 0.25)[chlorophyll], 1.0);
        assert_eq!(at(0.75, 0.75)[chlorophyll], 4.0);
        assert_eq!(at(0.5, 0.25)[chlorophyll], 1.5);
        assert_eq!(at(0.5, 0.5)[structure], 3.5);
        assert_eq!(at(-1.0, 2.0)[chlorophyll], 3.0);
    }
}
