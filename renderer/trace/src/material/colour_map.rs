//! Colours over texture coordinates, as reflectances.
//!
//! A colour is linear sRGB; its spectrum is that of [`crate::spectrum::rgb`], which is linear in the
//! colour, so that colours are mixed first and become a spectrum once.

use std::sync::Arc;

use glam::Vec2;

use crate::spectrum::rgb::Primaries;
use crate::spectrum::{Curve, Lanes, WavelengthGrid, Wavelengths};

/// What lies beside a picture, where texture coordinates leave [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// Its mirror image.
    Mirror,
    /// Its border.
    Clamp,
}

impl Wrap {
    /// All of them, with the word for each.
    pub const WORDS: [(&'static str, Self); 3] = [
        ("repeat", Self::Repeat),
        ("mirror", Self::Mirror),
        ("clamp", Self::Clamp),
    ];

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Repeat => "repeat",
            Self::Mirror => "mirror",
            Self::Clamp => "clamp",
        }
    }

    /// The texel for a number of any size.
    #[inline]
    fn texel(self, number: i64, count: usize) -> usize {
        let count = count as i64;
        let texel = match self {
            Self::Repeat => number.rem_euclid(count),
            Self::Mirror => {
                let within = number.rem_euclid(2 * count);
                within.min(2 * count - 1 - within)
            }
            Self::Clamp => number.clamp(0, count - 1),
        };
        texel as usize
    }
}

/// Greatest number of a texel, of either sign.
const FARTHEST: f32 = 1e12;

/// A picture of colours, bilinear between texel centres. Its lowest row is at v = 0, as one looks at
/// it.
#[derive(Clone, Debug)]
pub struct ColourTexture {
    width: usize,
    height: usize,
    /// Linear sRGB, row by row from the top.
    texels: Box<[[f32; 3]]>,
    /// Across and down.
    wrap: [Wrap; 2],
}

impl ColourTexture {
    /// A picture of `texels`, row by row from the top, `width` in a row, each in [0, 1] where it is
    /// seen.
    ///
    /// # Panics
    ///
    /// If they do not fill a rectangle.
    pub fn new(width: usize, texels: Vec<[f32; 3]>, wrap: [Wrap; 2]) -> Self {
        assert!(
            width > 0 && !texels.is_empty() && texels.len().is_multiple_of(width),
            "a picture fills its rectangle"
        );
        Self {
            width,
            height: texels.len() / width,
            texels: texels.into(),
            wrap,
        }
    }

    /// Number of texels along u and v.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The texels, row by row from the top.
    pub fn texels(&self) -> &[[f32; 3]] {
        &self.texels
    }

    /// What lies beside it, across and down.
    pub fn wrap(&self) -> [Wrap; 2] {
        self.wrap
    }

    /// The texel of a column and a row, which may lie beside the picture.
    pub fn texel(&self, column: i64, row: i64) -> [f32; 3] {
        let column = self.wrap[0].texel(column, self.width);
        let row = self.wrap[1].texel(row, self.height);
        self.texels[row * self.width + column]
    }

    /// The colour at texture coordinates of its own.
    #[inline]
    pub fn at(&self, uv: Vec2) -> [f32; 3] {
        // Far out there is no detail left, and beyond the range of floats no number.
        let x = (uv.x * self.width as f32 - 0.5).clamp(-FARTHEST, FARTHEST);
        let y = ((1.0 - uv.y) * self.height as f32 - 0.5).clamp(-FARTHEST, FARTHEST);
        let (x0, y0) = (x.floor(), y.floor());
        let (share_x, share_y) = (x - x0, y - y0);
        let mut colour = [0.0; 3];
        for (dy, weight_y) in [(0, 1.0 - share_y), (1, share_y)] {
            let row = self.wrap[1].texel(y0 as i64 + dy, self.height);
            for (dx, weight_x) in [(0, 1.0 - share_x), (1, share_x)] {
                let column = self.wrap[0].texel(x0 as i64 + dx, self.width);
                let texel = self.texels[row * self.width + column];
                for (sum, value) in colour.iter_mut().zip(texel) {
                    *sum += weight_x * weight_y * value;
                }
            }
        }
        colour
    }
}

/// One of the pictures of a map: from `begins` along u to where the next one begins.
#[derive(Clone, Debug)]
pub struct Slot {
    /// Where it begins.
    pub begins: f32,
    /// What is taken from u to have the picture's own.
    pub shift: f32,
    /// Factor on the picture; in [0, 1] if these are reflectances.
    pub factor: [f32; 3],
    /// The picture; white without one.
    pub texture: Option<Arc<ColourTexture>>,
}

/// Pictures side by side along u, so that a mesh of several materials has one map.
#[derive(Clone, Debug)]
pub struct ColourMap {
    /// By where they begin; at least one.
    slots: Box<[Slot]>,
    /// How often the pictures lie along u and v in what is 1 wide.
    repeats: Vec2,
    /// Whether colours of vertices are factors on its own.
    is_tinted: bool,
    primaries: Primaries,
}

impl ColourMap {
    /// A map of slots, which are in the order of where they begin.
    ///
    /// # Panics
    ///
    /// If there is no slot.
    pub fn new(slots: Vec<Slot>, repeats: Vec2) -> Self {
        assert!(!slots.is_empty(), "a map has a picture or a colour");
        Self {
            slots: slots.into(),
            repeats,
            is_tinted: false,
            primaries: Primaries::new(Curve::Constant(1.0)),
        }
    }

    /// The same map on a mesh whose vertices have colours, which are factors on those of the map.
    #[must_use]
    pub fn tinted(self) -> Self {
        Self {
            is_tinted: true,
            ..self
        }
    }

    /// Whether colours of vertices are factors on its own.
    #[inline]
    pub fn is_tinted(&self) -> bool {
        self.is_tinted
    }

    /// A map of one picture times a factor.
    pub fn of(texture: ColourTexture, factor: f32, repeats: Vec2) -> Self {
        let slot = Slot {
            begins: f32::MIN,
            shift: 0.0,
            factor: [factor; 3],
            texture: Some(Arc::new(texture)),
        };
        Self::new(vec![slot], repeats)
    }

    /// Its pictures, by where they begin.
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// How often the pictures lie along u and v in what is 1 wide.
    pub fn repeats(&self) -> Vec2 {
        self.repeats
    }

    /// Evaluates the spectra of red, green and blue at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.primaries.tabulate(grid);
    }

    /// Numbers that red, green and blue exceed nowhere.
    pub fn greatest(&self) -> [f32; 3] {
        let mut most = [0.0_f32; 3];
        for slot in &self.slots {
            let texels = slot.texture.iter().flat_map(|texture| texture.texels());
            let brightest = texels
                .copied()
                .reduce(|a, b| std::array::from_fn(|i| a[i].max(b[i])));
            let brightest = brightest.unwrap_or([1.0; 3]);
            most = std::array::from_fn(|i| most[i].max(slot.factor[i] * brightest[i]));
        }
        most
    }

    /// The number of the slot at texture coordinates, and those of its picture.
    #[inline]
    pub fn place(&self, uv: Vec2) -> (usize, Vec2) {
        // What is before the first slot belongs to it.
        let behind = self.slots.partition_point(|slot| slot.begins <= uv.x);
        let number = behind.saturating_sub(1);
        let own = Vec2::new(uv.x - self.slots[number].shift, uv.y) * self.repeats;
        (number, own)
    }

    /// Linear sRGB at texture coordinates.
    #[inline]
    pub fn colour(&self, uv: Vec2) -> [f32; 3] {
        let (number, own) = self.place(uv);
        let slot = &self.slots[number];
        let Some(texture) = &slot.texture else {
            return slot.factor;
        };
        let colour = texture.at(own);
        std::array::from_fn(|i| slot.factor[i] * colour[i])
    }

    /// Reflectance at texture coordinates and a path's wavelengths, with a factor on the colour.
    #[inline]
    pub fn spectrum<const N: usize>(
        &self,
        uv: Vec2,
        tint: [f32; 3],
        wavelengths: &Wavelengths<N>,
    ) -> Lanes<N> {
        let colour = self.colour(uv);
        let colour = std::array::from_fn(|i| colour[i] * tint[i]);
        self.primaries.spectrum(colour, wavelengths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red in the upper left corner, green beside it, blue below, white in the last.
    fn four(wrap: [Wrap; 2]) -> ColourMap {
        let texels = vec![
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, 1.0, 1.0],
        ];
        ColourMap::of(ColourTexture::new(2, texels, wrap), 1.0, Vec2::ONE)
    }

    #[test]
    fn the_lowest_row_of_a_picture_is_at_v_0() {
        let map = four([Wrap::Clamp; 2]);
        let at = |u, v| map.colour(Vec2::new(u, v));
        assert_eq!(at(0.25, 0.75), [1.0, 0.0, 0.0]);
        assert_eq!(at(0.75, 0.75), [0.0, 1.0, 0.0]);
        assert_eq!(at(0.25, 0.25), [0.0, 0.0, 1.0]);
        assert_eq!(at(0.5, 0.25), [0.5, 0.5, 1.0]);
        assert_eq!(at(0.0, 1.0), [1.0, 0.0, 0.0]);
        assert_eq!(at(-3e9, 3e38), [1.0, 0.0, 0.0]);
    }

    #[test]
    fn beside_a_picture_is_it_again_or_its_mirror_image_or_its_border() {
        for (wrap, beside) in [
            (Wrap::Repeat, [1.0, 0.0, 0.0]),
            (Wrap::Mirror, [0.0, 1.0, 0.0]),
            (Wrap::Clamp, [0.0, 1.0, 0.0]),
        ] {
            assert_eq!(four([wrap; 2]).colour(Vec2::new(1.25, 0.75)), beside);
        }
        let mirror = four([Wrap::Mirror; 2]);
        assert_eq!(mirror.colour(Vec2::new(1.75, 0.75)), [1.0, 0.0, 0.0]);
        assert_eq!(mirror.colour(Vec2::new(-0.25, -0.25)), [0.0, 0.0, 1.0]);
        // On the border of a picture that repeats both ends meet.
        let repeated = four([Wrap::Repeat; 2]);
        assert_eq!(repeated.colour(Vec2::new(1.0, 0.75)), [0.5, 0.5, 0.0]);
    }

    #[test]
    fn each_slot_has_its_own_picture_and_factor() {
        let texture = four([Wrap::Repeat; 2]).slots[0].texture.clone();
        let slot = |begins, shift, factor: f32, texture| Slot {
            begins,
            shift,
            factor: [factor; 3],
            texture,
        };
        let slots = vec![slot(0.0, 0.0, 0.25, None), slot(1.5, 2.0, 0.5, texture)];
        let map = ColourMap::new(slots, Vec2::ONE);
        assert_eq!(map.colour(Vec2::new(-1.0, 0.3)), [0.25; 3]);
        assert_eq!(map.colour(Vec2::new(1.4, 0.3)), [0.25; 3]);
        assert_eq!(map.colour(Vec2::new(2.25, 0.75)), [0.5, 0.0, 0.0]);
        assert_eq!(map.colour(Vec2::new(2.75, 0.25)), [0.5; 3]);
    }
}
