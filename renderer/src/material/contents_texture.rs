//! Maps of a leaf's contents: float pictures over uv.

use glam::Vec2;
use leafmodel::optics::{Contents, PerConstituent, Texel};

/// A contents map: bilinear between texel centres, clamped at the border; row 0 is at v = 0.
#[derive(Clone, Debug)]
pub struct ContentsTexture {
    width: usize,
    height: usize,
    texels: Box<[Texel]>,
}

impl ContentsTexture {
    /// A map from `width × height` texels, row by row.
    ///
    /// # Panics
    ///
    /// If the number of texels is not `width × height`, or is zero.
    pub fn new(width: usize, height: usize, texels: Vec<Texel>) -> Self {
        assert!(
            !texels.is_empty() && texels.len() == width * height,
            "a map fills its rectangle"
        );
        Self {
            width,
            height,
            texels: texels.into(),
        }
    }

    /// Number of texels along u and v.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
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
        let x = (uv.x * self.width as f32 - 0.5).clamp(0.0, (self.width - 1) as f32);
        let y = (uv.y * self.height as f32 - 0.5).clamp(0.0, (self.height - 1) as f32);
        let (x0, y0) = (x as usize, y as usize);
        let (x1, y1) = ((x0 + 1).min(self.width - 1), (y0 + 1).min(self.height - 1));
        let (share_x, share_y) = (x - x0 as f32, y - y0 as f32);
        let texel = |x: usize, y: usize| &self.texels[y * self.width + x];
        let (a, b, c, d) = (texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1));
        let value = |i| {
            let below = a[i] * (1.0 - share_x) + b[i] * share_x;
            let above = c[i] * (1.0 - share_x) + d[i] * share_x;
            below * (1.0 - share_y) + above * share_y
        };
        Texel::from_fn(value)
    }

    /// One of the four texels around `uv`, drawn by the numbers `within` in [0, 1) with the weights
    /// of [`ContentsTexture::at`].
    #[inline(always)]
    pub fn drawn(&self, uv: Vec2, within: Vec2) -> &Texel {
        // A float below 0 becomes the index 0.
        let x = (uv.x * self.width as f32 - 0.5 + within.x) as usize;
        let y = (uv.y * self.height as f32 - 0.5 + within.y) as usize;
        &self.texels[y.min(self.height - 1) * self.width + x.min(self.width - 1)]
    }
}

#[cfg(test)]
mod tests {
    use leafmodel::optics::Constituent;

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
