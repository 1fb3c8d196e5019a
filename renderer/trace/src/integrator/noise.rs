//! Adaptive sampling: decides when a block of pixels has enough samples.
//!
//! At 16, 32, 64, … samples the luminance of every pixel is compared with its value at half as many
//! samples. Half the difference of two independent halves has the variance of their mean.
//! Low-discrepancy halves complement each other, so their mean is better than that and the estimate
//! is conservative.
//!
//! - **In**: the film's sums at these borders, and the target relative error.
//! - **Out**: for each block the number of samples at which it stops.
//! - **Always true**: a decision depends on the sums of all samples up to a border and on nothing
//!   else, so it does not depend on threads or time. A block is judged by 64 independent
//!   differences, one per pixel, so it rarely stops by chance.
//! - **Left out**: light that none of the first samples of a block found.

use rayon::prelude::*;

use crate::film::{BLOCK_SIDE, Film};

/// The first border. A decision needs two, so no block stops before twice as many samples.
const FIRST_BORDER: u32 = 16;
/// Blocks stop at multiples of this many samples only, where passes end.
pub const STEP: u32 = 16;
/// Errors are relative to the block's luminance plus this share of the picture's mean, so that
/// nearly black parts need not be as precise as bright ones.
const FLOOR: f64 = 0.1;

/// The noise of every block and the number of samples at which it stops.
#[derive(Clone, Debug)]
pub struct NoiseWatch {
    aim: f64,
    most: u32,
    /// Luminance of each pixel at the last border, in the film's order of blocks.
    luminance: Vec<f32>,
    blocks: Vec<BlockNoise>,
}

#[derive(Clone, Copy, Debug)]
struct BlockNoise {
    /// Samples at which the block stops, if the picture's most are no fewer. It does not depend on
    /// the most, so that a render can go on to more.
    goal: u32,
    /// Relative error of a single sample: that of `n` samples is this over √n. Negative while it is
    /// unknown.
    of_one_sample: f32,
}

impl BlockNoise {
    /// Samples for a relative error, a multiple of [`STEP`]; `None` while the noise is unknown.
    fn needed(self, aim: f64) -> Option<u32> {
        let samples = (f64::from(self.of_one_sample) / aim).powi(2);
        let steps = (samples / f64::from(STEP)).ceil() as u32;
        (self.of_one_sample >= 0.0).then(|| steps.saturating_mul(STEP))
    }
}

impl NoiseWatch {
    /// The initial state, in which every block goes on to `most` samples.
    pub fn new(film: &Film, aim: f64, most: u32) -> Self {
        let pixels = film.width() as usize * film.height() as usize;
        let block = BlockNoise {
            goal: u32::MAX,
            of_one_sample: -1.0,
        };
        Self {
            aim,
            most,
            luminance: vec![0.0; pixels],
            blocks: vec![block; film.blocks()],
        }
    }

    /// The target relative error.
    pub fn aim(&self) -> f64 {
        self.aim
    }

    /// Lets blocks go on to `most` samples.
    pub(crate) fn set_most(&mut self, most: u32) {
        self.most = most;
    }

    /// Lets blocks go on to a lower relative error, by what is known of their noise.
    pub(crate) fn set_aim(&mut self, aim: f64) {
        self.aim = aim;
        for block in &mut self.blocks {
            if let Some(needed) = block.needed(aim) {
                block.goal = needed;
            }
        }
    }

    /// What [`NoiseWatch::restored`] needs: the luminance of each pixel at the last border, then
    /// goal and relative error of a single sample for each block.
    pub fn words(&self) -> Vec<u32> {
        let luminance = self.luminance.iter().map(|value| value.to_bits());
        let blocks = self.blocks.iter();
        let blocks = blocks.flat_map(|block| [block.goal, block.of_one_sample.to_bits()]);
        luminance.chain(blocks).collect()
    }

    /// This initial state with what was found until its [`words`](Self::words) were made; `None`
    /// if they are those of another film.
    pub fn restored(mut self, words: &[u32]) -> Option<Self> {
        let (luminance, blocks) = words.split_at_checked(self.luminance.len())?;
        if blocks.len() != 2 * self.blocks.len() {
            return None;
        }
        for (own, word) in self.luminance.iter_mut().zip(luminance) {
            *own = f32::from_bits(*word);
        }
        for (own, words) in self.blocks.iter_mut().zip(blocks.chunks_exact(2)) {
            *own = BlockNoise {
                goal: words[0],
                of_one_sample: f32::from_bits(words[1]),
            };
        }
        let known = |value: f32| value.is_finite();
        let is_sound = self.luminance.iter().all(|&value| known(value))
            && self.blocks.iter().all(|block| known(block.of_one_sample));
        is_sound.then_some(self)
    }

    /// Whether a decision is due at this number of samples.
    pub(crate) fn is_border(samples: u32) -> bool {
        samples >= FIRST_BORDER && samples.is_power_of_two()
    }

    /// Number of samples at which a block stops, by present knowledge.
    pub fn goal(&self, block: usize) -> u32 {
        self.blocks[block].goal.min(self.most)
    }

    /// Judges the blocks that have come to the border at `samples` samples.
    ///
    /// Blocks that stopped before it keep what is known of them, and so do those that were beyond it
    /// when others were told to go on to a lower error.
    pub fn look(&mut self, film: &Film, samples: u32) {
        let found = self.compare(film, samples);
        let pixels = |number: usize| f64::from(film.pixels_of(number));
        let sum: f64 = (0..)
            .zip(&found)
            .map(|(number, block)| block.luminance * pixels(number))
            .sum();
        let mean = sum / self.luminance.len() as f64;
        for (number, (block, found)) in self.blocks.iter_mut().zip(&found).enumerate() {
            // At the first border there is nothing to compare with.
            if film.drawn_of(number) != samples || samples == FIRST_BORDER {
                continue;
            }
            let error = found.relative_error(mean);
            block.of_one_sample = (error * f64::from(samples).sqrt()) as f32;
            // If more than twice as many are needed, the next border decides.
            let needed = block.needed(self.aim).unwrap_or(u32::MAX);
            block.goal = needed.max(samples);
        }
    }

    /// The relative error reached: root mean square over the picture's pixels; `None` before two
    /// borders.
    pub fn reached(&self, film: &Film) -> Option<f64> {
        let mut sum = 0.0;
        for (number, block) in self.blocks.iter().enumerate() {
            let of_one = f64::from(block.of_one_sample);
            if of_one < 0.0 {
                return None;
            }
            let variance = of_one * of_one / f64::from(film.drawn_of(number));
            sum += variance * f64::from(film.pixels_of(number));
        }
        Some((sum / self.luminance.len() as f64).sqrt())
    }

    /// Compares every block with its last border; of those that have come to this one, its luminance
    /// is stored.
    fn compare(&mut self, film: &Film, samples: u32) -> Vec<Compared> {
        let (width, height) = (film.width(), film.height());
        self.luminance
            .par_chunks_mut((width * BLOCK_SIDE) as usize)
            .enumerate()
            .flat_map_iter(|(row, line)| {
                let y = row as u32 * BLOCK_SIDE;
                let pixels = BLOCK_SIDE * BLOCK_SIDE.min(height - y);
                let blocks = line.chunks_mut(pixels as usize).enumerate();
                let first = row * width.div_ceil(BLOCK_SIDE) as usize;
                blocks.map(move |(column, before)| {
                    let is_here = film.drawn_of(first + column) == samples;
                    let x = column as u32 * BLOCK_SIDE;
                    let across = BLOCK_SIDE.min(width - x);
                    let count = before.len() as f64;
                    let mut sums = [0.0; 2];
                    for (within, before) in (0..).zip(before) {
                        let pixel = film.pixel(x + within % across, y + within / across);
                        let now = pixel.luminance();
                        let difference = now - f64::from(*before);
                        sums[0] += now;
                        sums[1] += difference * difference;
                        if is_here {
                            *before = now as f32;
                        }
                    }
                    Compared {
                        luminance: sums[0] / count,
                        square: sums[1] / count,
                    }
                })
            })
            .collect()
    }
}

/// A block's luminance, and the change of its pixels since they had half as many samples.
#[derive(Clone, Copy, Debug)]
struct Compared {
    /// Mean over the pixels.
    luminance: f64,
    /// Mean over the pixels of the squared difference: with independent halves the variance of a
    /// pixel's mean.
    square: f64,
}

impl Compared {
    /// Relative error of a pixel, in a picture with this mean luminance.
    fn relative_error(&self, picture_mean: f64) -> f64 {
        if self.square <= 0.0 {
            return 0.0;
        }
        self.square.sqrt() / (self.luminance.max(0.0) + FLOOR * picture_mean.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A random 0 or 1 for a sample of a pixel.
    fn coin(x: u32, y: u32, number: u32) -> f32 {
        let mut bits = u64::from(x) << 42 | u64::from(y) << 21 | u64::from(number);
        for _ in 0..2 {
            bits = (bits ^ bits >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
        (bits >> 63) as f32
    }

    /// Exposes a row of four blocks to grey samples until all have enough for the aim.
    fn exposed(
        aim: f64,
        most: u32,
        value: impl Fn(u32, u32, u32) -> f32 + Sync,
    ) -> (Film, NoiseWatch) {
        let mut film =
            Film::new(4 * BLOCK_SIDE, BLOCK_SIDE, &[0.25, 0.5, 0.25], &[]).expect("a small film");
        let mut watch = NoiseWatch::new(&film, aim, most);
        expose(&mut film, &mut watch, value);
        (film, watch)
    }

    /// Adds samples until all blocks have enough.
    fn expose(
        film: &mut Film,
        watch: &mut NoiseWatch,
        value: impl Fn(u32, u32, u32) -> f32 + Sync,
    ) {
        loop {
            let drawn: Vec<u32> = (0..film.blocks()).map(|b| film.drawn_of(b)).collect();
            let lacking = drawn.iter().zip(0..).filter(|&(&n, b)| n < watch.goal(b));
            let Some(next) = lacking.map(|(&n, _)| n).min() else {
                return;
            };
            let end = (next / STEP + 1) * STEP;
            film.expose(|block| {
                let first = drawn[block.number()];
                let end = end.min(watch.goal(block.number()));
                if first < end {
                    block.expose(end - first, |x, y, pixel| {
                        (first..end).for_each(|n| pixel.add::<0>(n, &[value(x, y, n); 3], None));
                    });
                }
            });
            if NoiseWatch::is_border(end) {
                watch.look(film, end);
            }
        }
    }

    #[test]
    fn blocks_that_had_enough_go_on_to_a_lower_noise() {
        // Half the noise from block to block, so that all stop at other numbers of samples.
        let value = |x, y, number| {
            let deviation = 0.5_f32.powi((x / BLOCK_SIDE) as i32);
            1.0 + deviation * (2.0 * coin(x, y, number) - 1.0)
        };
        let (mut film, mut watch) = exposed(0.08, 100_000, value);
        let before = [0, 1, 2, 3].map(|block| film.drawn_of(block));
        watch.set_aim(0.03);
        expose(&mut film, &mut watch, value);
        let (at_once, its_watch) = exposed(0.03, 100_000, value);
        for (block, before) in (0..4).zip(before) {
            // The mean of the picture, to which errors are relative too, is known better now.
            let (both, once) = (film.drawn_of(block), at_once.drawn_of(block));
            assert!(both >= before, "{both} after {before}");
            assert!(both.abs_diff(once) <= STEP, "{both} and {once} at once");
        }
        assert!(film.drawn_of(0) > 2 * before[0], "{before:?}");
        let reached = [(&film, &watch), (&at_once, &its_watch)]
            .map(|(film, watch)| watch.reached(film).expect("there were enough samples"));
        assert!(reached[0] <= 0.03, "{reached:?}");
    }

    #[test]
    fn a_block_gets_as_many_samples_as_its_variance_asks_for() {
        // Blocks without noise, with relative deviation 1, with deviation 0.5, and dark with
        // relative deviation 1.
        let value = |x, y, number| match x / BLOCK_SIDE {
            0 => 1.0,
            1 => 2.0 * coin(x, y, number),
            2 => 0.5 + coin(x, y, number),
            _ => 0.02 * coin(x, y, number),
        };
        let (film, watch) = exposed(0.05, 100_000, value);
        let drawn = [0, 1, 2, 3].map(|block| film.drawn_of(block));
        // The floor is a tenth of the mean over the picture, 0.7525.
        let expected = |deviation: f64, mean: f64| (deviation / (mean + 0.07525) / 0.05).powi(2);
        assert_eq!(drawn[0], 32);
        for (drawn, expected) in [
            (drawn[1], expected(1.0, 1.0)),
            (drawn[2], expected(0.5, 1.0)),
        ] {
            // 64 squares of normal numbers have a relative deviation of √(2/64) = 0.18; three of it
            // and a step.
            let off = (f64::from(drawn) - expected).abs();
            assert!(
                off < 0.54 * expected + f64::from(STEP),
                "{drawn} is not near {expected}"
            );
        }
        assert_eq!(
            drawn[3],
            32,
            "{} are enough in the dark",
            expected(0.01, 0.01)
        );
        let reached = watch.reached(&film).expect("there were enough samples");
        assert!(reached > 0.01 && reached <= 0.05, "{reached}");
    }

    #[test]
    fn no_block_gets_more_samples_than_the_most() {
        let (film, watch) = exposed(1e-4, 72, coin);
        assert_eq!(film.drawn_range(), [72, 72]);
        let reached = watch.reached(&film).expect("there were enough samples");
        assert!(reached > 0.05, "{reached}");
    }

    #[test]
    fn nothing_is_known_of_the_noise_of_few_samples() {
        let (film, watch) = exposed(0.5, 31, coin);
        assert_eq!(film.drawn_range(), [31, 31]);
        assert_eq!(watch.reached(&film), None);
    }

    #[test]
    fn a_black_picture_has_no_noise() {
        let (film, watch) = exposed(0.01, 1000, |_, _, _| 0.0);
        assert_eq!(film.drawn_range(), [32, 32]);
        assert_eq!(watch.reached(&film), Some(0.0));
    }
}
