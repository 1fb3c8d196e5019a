//! Pictures that shine, read by linear interpolation.

use crate::simd;

/// Linear sRGB, row by row from the top.
#[derive(Clone, Debug)]
pub struct Texels {
    width: usize,
    height: usize,
    colours: Box<[[f32; 3]]>,
    greatest: [f32; 3],
}

/// Greatest number of a texel, of either sign.
const FARTHEST: f32 = 1e12;

/// What lies beyond the left and the right border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The opposite border, as in a picture of all azimuths.
    Opposite,
    /// The same border.
    Same,
}

impl Texels {
    /// A picture from finite texels, `width` per row.
    pub fn new(texels: Vec<[f32; 3]>, width: usize) -> Self {
        let greatest = texels.iter().fold([0.0_f32; 3], |most, texel| {
            std::array::from_fn(|i| most[i].max(texel[i]))
        });
        Self {
            width,
            height: texels.len() / width,
            colours: texels.into(),
            greatest,
        }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The texels, row by row from the top.
    pub fn texels(&self) -> &[[f32; 3]] {
        &self.colours
    }

    /// The greatest red, green and blue of all.
    pub fn greatest(&self) -> [f32; 3] {
        self.greatest
    }

    /// Prefetches the texels around a place that is roughly this.
    #[inline]
    pub fn prefetch(&self, [across, down]: [f32; 2]) {
        let column = (across * self.width as f32 - 0.5) as usize;
        let row = (down * self.height as f32 - 0.5) as usize;
        for row in [row, row + 1] {
            simd::prefetch(&self.colours, row * self.width + column);
        }
    }

    /// The colour at a share of the width from the left and a share of the height from the top. A
    /// texel's colour is that of its middle; between middles it is linear.
    pub fn at(&self, [across, down]: [f32; 2], beyond: Beyond) -> [f32; 3] {
        // Far out there is no detail left, and beyond the range of floats no number.
        let x = (across * self.width as f32 - 0.5).clamp(-FARTHEST, FARTHEST);
        let y = (down * self.height as f32 - 0.5).clamp(0.0, (self.height - 1) as f32);
        let (x0, y0) = (x.floor(), y.floor());
        let (share_x, share_y) = (x - x0, y - y0);
        let columns = [0, 1].map(|offset| {
            let (column, width) = (x0 as i64 + offset, self.width as i64);
            match beyond {
                // A division is slow, and hardly a place lies beyond.
                _ if (0..width).contains(&column) => column as usize,
                Beyond::Opposite => column.rem_euclid(width) as usize,
                Beyond::Same => column.clamp(0, width - 1) as usize,
            }
        });
        let row = |offset: usize| (y0 as usize + offset).min(self.height - 1);
        let mut colour = [0.0; 3];
        for (dy, weight_y) in [(0, 1.0 - share_y), (1, share_y)] {
            for (column, weight_x) in columns.into_iter().zip([1.0 - share_x, share_x]) {
                let texel = self.colours[row(dy) * self.width + column];
                for (sum, value) in colour.iter_mut().zip(texel) {
                    *sum += weight_x * weight_y * value;
                }
            }
        }
        colour
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_linear_between_the_middles_of_texels() {
        let grey = |value: f32| [value; 3];
        let picture = Texels::new([0.0, 4.0, 8.0, 2.0].map(grey).into(), 2);
        for (place, expected) in [
            ([0.25, 0.25], 0.0),
            ([0.5, 0.25], 2.0),
            ([0.25, 0.5], 4.0),
            ([0.5, 0.5], 3.5),
            ([0.5, 1.0], 5.0),
        ] {
            assert_eq!(picture.at(place, Beyond::Same), grey(expected), "{place:?}");
        }
        assert_eq!(picture.at([0.0, 0.0], Beyond::Same), grey(0.0));
        assert_eq!(picture.at([0.0, 0.0], Beyond::Opposite), grey(2.0));
        assert_eq!(picture.at([1.0, 0.0], Beyond::Same), grey(4.0));
    }
}
