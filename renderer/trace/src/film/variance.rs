//! The variance of a film's means: that of each pixel's batches, times what neighbouring pixels show
//! of how much less the mean of all samples errs.
//!
//! Batches know nothing of what low discrepancy gains beyond them, which differs from scene to scene
//! and grows with the number of samples. Two things show it. Both are upper bounds of the variance and
//! need many pixels to be known well, so they are summed over a block and those around it:
//!
//! - halves of the samples, which know all but the last doubling ([`super::halves`]);
//! - means of pixels against those beside them, whose errors are independent. They differ by the
//!   picture's own detail too, so this decides only where it is much lower than the other.
//!
//! - **In**: the film's sums.
//! - **Out**: the variance of the mean of luminance or of a channel of each pixel.
//! - **Always true**: with independent samples the expectation is their variance, whatever the scene.
//! - **Left out**: gains that differ from pixel to pixel within some blocks, but for what the pixel's own
//!   batches know of them.

use rayon::prelude::*;

use super::batches::{Series, sum_of};
use super::block::BLOCK_SIDE;
use super::sums::Film;

/// Sums of halves wrap around where a row's brightness times its samples is beyond this.
const MOST_OF_ROW: f64 = (1_u64 << 30) as f64;

/// Neighbours decide where they show less than this part of what halves do. Both are known within some
/// 20 %, so it is no chance.
const MUCH_LOWER: f64 = 0.5;
/// And only where there are so many pixels.
const LEAST_PIXELS: f64 = 64.0;

/// Variances of means, summed over the pixels of some blocks.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    batches: f64,
    halves: f64,
    neighbours: f64,
    rows: f64,
    pixels: f64,
}

impl Shown {
    fn add(&mut self, other: &Self) {
        self.batches += other.batches;
        self.halves += other.halves;
        self.neighbours += other.neighbours;
        self.rows += other.rows;
        self.pixels += other.pixels;
    }

    /// The variance of the mean over that of the batches.
    fn gain(&self) -> f64 {
        if self.batches <= 0.0 {
            return 1.0;
        }
        let by_neighbours =
            self.pixels >= LEAST_PIXELS && self.neighbours < MUCH_LOWER * self.halves;
        let variance = if by_neighbours {
            self.neighbours
        } else {
            self.halves
        };
        // As if one more row showed no gain: on a film of few rows chance must not make the error 0.
        (self.rows * variance / self.batches + 1.0) / (self.rows + 1.0)
    }
}

impl Film {
    /// The variance of the mean of a number for each pixel, row by row from the top, computed on the
    /// current thread pool. Of fewer than sixteen samples it is an upper bound, that of independent ones.
    pub fn variance(&self, series: Series) -> Vec<f64> {
        let means = self.map(|pixel| pixel.mean_of(series));
        let mut variances = self.map(|pixel| pixel.variance(series));
        let shown: Vec<Shown> = (0..self.blocks())
            .into_par_iter()
            .map(|block| self.shown(block, series, &means, &variances))
            .collect();
        let gains: Vec<f64> = (0..self.blocks())
            .map(|block| self.around(block, &shown).gain())
            .collect();
        let (width, across) = (self.width as usize, self.blocks_across());
        let side = BLOCK_SIDE as usize;
        for (place, variance) in variances.iter_mut().enumerate() {
            // What is not known stays infinite.
            if variance.is_finite() {
                *variance *= gains[place / width / side * across + place % width / side];
            }
        }
        variances
    }

    /// Sum over a block and those around it.
    fn around(&self, block: usize, shown: &[Shown]) -> Shown {
        let across = self.blocks_across();
        let near = |place: usize, count: usize| place.saturating_sub(1)..(place + 2).min(count);
        let mut sum = Shown::default();
        for row in near(block / across, shown.len() / across) {
            for column in near(block % across, across) {
                sum.add(&shown[row * across + column]);
            }
        }
        sum
    }

    /// What a block's pixels show; nothing if it has fewer than sixteen samples, or is too bright.
    fn shown(&self, block: usize, series: Series, means: &[f64], variances: &[f64]) -> Shown {
        let across = self.blocks_across();
        let [x, y] = [block % across, block / across].map(|place| place * BLOCK_SIDE as usize);
        let [width, height] = [self.width, self.height].map(|size| size as usize);
        let side = BLOCK_SIDE as usize;
        let (columns, rows) = (x..(x + side).min(width), y..(y + side).min(height));
        let halves = self.halves[block].differences();
        let Some((count, differences)) = halves else {
            return Shown::default();
        };
        let drawn = f64::from(self.drawn[block]);
        let shares: Vec<f64> = match series {
            Series::Channel(number) => {
                let of = |channel| if channel == number { 1.0 } else { 0.0 };
                (0..self.channels()).map(of).collect()
            }
            Series::Luminance if self.channels() == 1 => vec![1.0],
            Series::Luminance => self
                .luminance
                .iter()
                .map(|&share| f64::from(share))
                .collect(),
        };
        let scale = series.scale(&self.luminance);
        let differences: Vec<f64> = differences.map(sum_of).collect();
        let mut shown = Shown {
            rows: rows.len() as f64,
            pixels: (rows.len() * columns.len()) as f64,
            ..Shown::default()
        };
        for (row, differences) in rows.zip(differences.chunks(self.channels())) {
            let line = row * width;
            let brightness: f64 = means[line..][columns.clone()].iter().map(|m| m.abs()).sum();
            let batches: f64 = variances[line..][columns.clone()].iter().sum();
            if brightness * drawn > MOST_OF_ROW || !batches.is_finite() || scale <= 0.0 {
                return Shown::default();
            }
            let shared = differences.iter().zip(&shares);
            let difference: f64 = shared.map(|(difference, share)| difference * share).sum();
            // Of the mean of both halves, and of all samples.
            let deviation = difference / scale / f64::from(2 * count);
            shown.halves += deviation * deviation * f64::from(2 * count) / drawn;
            shown.batches += batches;
            for column in columns.clone() {
                shown.neighbours += against_neighbours(means, [width, height], [column, row]);
            }
        }
        shown
    }
}

/// The square of by how much a pixel differs from the mean of the two beside it and of the two above and
/// below, over the square that independent errors of variance 1 would have. At a border both
/// neighbours are the one that there is.
fn against_neighbours(means: &[f64], [width, height]: [usize; 2], [x, y]: [usize; 2]) -> f64 {
    let (mut difference, mut own, mut others) = (0.0, 0.0, 0.0);
    for (place, size, step) in [(x, width, 1), (y, height, width)] {
        if size < 2 {
            continue;
        }
        let here = y * width + x;
        let before = (place > 0).then(|| means[here - step]);
        let after = (place + 1 < size).then(|| means[here + step]);
        own += 2.0;
        others += if before.is_some() && after.is_some() {
            2.0
        } else {
            4.0
        };
        let one = before.or(after).unwrap_or(0.0);
        difference += 2.0 * means[here] - one - after.unwrap_or(one);
    }
    if own > 0.0 {
        difference * difference / (own * own + others)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A random number in [0, 1) of a film, a pixel and a sample.
    fn chance(seed: u32, x: u32, y: u32, number: u32) -> f32 {
        let mut bits = u64::from(seed) << 48 ^ u64::from(x) << 36 ^ u64::from(y) << 24;
        bits ^= u64::from(number);
        for _ in 0..2 {
            bits = (bits ^ bits >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
        (bits >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// A film of 24 × 20 pixels and so many samples in two channels.
    fn exposed(samples: u32, value: impl Fn(u32, u32, u32) -> [f32; 2] + Sync) -> Film {
        let mut film = Film::new(24, 20, &[0.25, 0.75], &[]).expect("a small film");
        film.expose(|block| {
            block.expose(samples, |x, y, pixel| {
                for number in 0..samples {
                    pixel.add::<0>(number, &value(x, y, number), None);
                }
            });
        });
        film
    }

    /// The mean over pixels and 16 films of the variance reported, over that over the films.
    fn ratio(
        samples: u32,
        series: Series,
        value: impl Fn(u32, u32, u32, u32) -> [f32; 2] + Sync,
    ) -> f64 {
        let films: Vec<Film> = (0..16)
            .map(|seed| exposed(samples, |x, y, number| value(seed, x, y, number)))
            .collect();
        let means: Vec<Vec<f64>> = films
            .iter()
            .map(|film| film.map(|p| p.mean_of(series)))
            .collect();
        let reported: f64 = films.iter().flat_map(|film| film.variance(series)).sum();
        let over_films: f64 = (0..means[0].len())
            .map(|pixel| {
                let mean = means.iter().map(|means| means[pixel]).sum::<f64>() / 16.0;
                means
                    .iter()
                    .map(|means| (means[pixel] - mean).powi(2))
                    .sum::<f64>()
                    / 15.0
            })
            .sum();
        reported / 16.0 / over_films
    }

    #[test]
    fn independent_samples_have_their_variance_whatever_the_picture() {
        for detail in [0.0, 1.0] {
            let value = |seed: u32, x: u32, y: u32, number: u32| {
                let shade = detail * ((x * 7 + y * 5) % 11) as f32;
                let noise = chance(seed, x, y, number);
                [shade + noise, shade - noise * noise]
            };
            for samples in [16, 40, 64] {
                for series in [Series::Luminance, Series::Channel(0), Series::Channel(1)] {
                    let ratio = ratio(samples, series, value);
                    // 480 pixels and 16 films tell a variance to 1.7 %, rows of films likewise.
                    assert!((ratio - 1.0).abs() < 0.1, "{series:?}, {samples}: {ratio}");
                }
            }
        }
    }

    #[test]
    fn what_low_discrepancy_gains_beyond_a_batch_is_counted() {
        // One random number for each pixel, and for each sample the bits of its number reversed: as
        // spread as can be, so that the mean of n errs by 1/n of a sample's error.
        let value = |detail: f32| {
            move |seed: u32, x: u32, y: u32, number: u32| {
                let even = number.reverse_bits() as f32 / 4_294_967_296.0;
                let value = (even + chance(seed, x, y, 0)).fract();
                let shade = detail * ((x * 7 + y * 5) % 11) as f32;
                [shade + value, shade + value]
            }
        };
        for samples in [16, 64, 256] {
            // Neighbours show it all; with the detail of a picture, halves show it but for a factor of
            // 2² − 1 and the tenth that one row of a film may count for.
            let [plain, detailed] =
                [0.0, 1.0].map(|detail| ratio(samples, Series::Channel(1), value(detail)));
            eprintln!("{samples}: {plain} {detailed}");
            assert!((0.9..2.0).contains(&plain), "{samples}: {plain}");
            assert!((0.9..4.5).contains(&detailed), "{samples}: {detailed}");
        }
    }

    #[test]
    fn a_film_of_one_pixel_is_not_right_by_chance() {
        let mut film = Film::new(1, 1, &[1.0], &[]).expect("a small film");
        film.expose(|block| {
            block.expose(64, |_, _, pixel| {
                for number in 0..64 {
                    // Both halves are alike, batches are not.
                    let value = f32::from(number / 16 % 2 == 1);
                    pixel.add::<0>(number, &[value], None);
                }
            });
        });
        let [found] = film.variance(Series::Luminance)[..] else {
            panic!("a pixel has one variance");
        };
        // Means 0, 1, 0, 1: variance 1/3, of the mean of four a quarter of that, and half of it.
        assert!((found - 1.0 / 24.0).abs() < 1e-9, "{found}");
    }
}
