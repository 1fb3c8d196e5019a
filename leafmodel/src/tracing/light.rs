//! Where the ink is: light made even, and the level that parts veins from the tissue between.

use rayon::prelude::*;

use super::error::TraceError;
use super::grid::{Mask, Raster};
use super::settings::{Ink, Settings, Threshold};

/// Number of bins of a histogram.
const BINS: usize = 1024;

/// Window over which light is made even, as a share of the blade's longer side.
const LIGHT_WINDOW: f64 = 0.125;

/// How far from its least and greatest value, as a fraction of their difference, a picture of two
/// values may be, and the greatest fraction of its pixels that may be elsewhere.
const TWO_VALUES: f32 = 0.05;
const MOST_OTHERS: f64 = 0.01;

/// Least difference of the means on both sides of a level, as a share of the brighter: a picture
/// without veins has noise alone.
const LEAST_CONTRAST: f64 = 0.04;

/// How far each pixel of the blade is on the vein's side of the level, in grey values: above 0 in
/// veins.
pub(super) fn ink(
    picture: &Raster,
    blade: &Mask,
    settings: &Settings,
) -> Result<Raster, TraceError> {
    let picture = smoothed_within(picture, blade, settings.smoothing_px);
    let sign = match settings.veins {
        Ink::Dark => 1.0,
        Ink::Bright => -1.0,
    };
    let under = |level: f32, picture: &Raster| picture.each(|_, value| sign * (level - value));
    let under_otsu = |picture: &Raster| {
        let level = otsu(picture, blade).ok_or(TraceError::NoContrast)?;
        Ok::<_, TraceError>(under(level, picture))
    };
    Ok(match settings.threshold {
        Threshold::Level(level) => under(level as f32, &picture),
        Threshold::Otsu { even_light: false } => under_otsu(&picture)?,
        Threshold::Otsu { even_light: true } => {
            under_otsu(&evened(&picture, blade, settings.veins))?
        }
        Threshold::Sauvola { window_px, k } => {
            let half = (window_px / 2.0).round().max(1.0) as usize;
            sauvola(&picture, blade, settings.veins, half, k)
        }
    })
}

/// The pixels of lines one pixel wide in a picture of two values, a mask or a drawing: a Gaussian
/// against noise, which such a picture has not, would take diagonal ones away. `None` for other
/// pictures.
pub(super) fn hairlines(picture: &Raster, settings: &Settings) -> Option<Vec<bool>> {
    let (width, height) = (picture.width(), picture.height());
    let values = picture.values();
    let bounds = (f32::INFINITY, f32::NEG_INFINITY);
    let (low, high) = values.iter().fold(bounds, |(low, high), &value| {
        (low.min(value), high.max(value))
    });
    let slack = TWO_VALUES * (high - low);
    let is_other = |value: &&f32| **value > low + slack && **value < high - slack;
    let others = values.iter().filter(is_other).count();
    if high <= low || others as f64 > MOST_OTHERS * values.len() as f64 {
        return None;
    }
    let level = match settings.threshold {
        Threshold::Level(level) => level as f32,
        Threshold::Otsu { .. } | Threshold::Sauvola { .. } => 0.5 * (low + high),
    };
    let is_vein = |x: usize, y: usize| {
        let value = values[y * width + x];
        match settings.veins {
            Ink::Dark => value < level,
            Ink::Bright => value > level,
        }
    };
    // A pixel of a wider vein is in a square of four.
    let is_square = |x: usize, y: usize| {
        x + 1 < width
            && y + 1 < height
            && is_vein(x, y)
            && is_vein(x + 1, y)
            && is_vein(x, y + 1)
            && is_vein(x + 1, y + 1)
    };
    let lines = (0..width * height).map(|at| {
        let (x, y) = (at % width, at / width);
        let (left, up) = (x.checked_sub(1), y.checked_sub(1));
        let is_wide = is_square(x, y)
            || left.is_some_and(|left| is_square(left, y))
            || up.is_some_and(|up| is_square(x, up))
            || left.zip(up).is_some_and(|(left, up)| is_square(left, up));
        is_vein(x, y) && !is_wide
    });
    Some(lines.collect())
}

/// The picture after a Gaussian that mixes no background into the blade: else the rim of a blade
/// without veins would be paler than the rest of it.
fn smoothed_within(picture: &Raster, blade: &Mask, deviation: f64) -> Raster {
    let width = picture.width();
    let is_in = |at: usize| blade.cells[blade.cell(at % width, at / width)];
    let masked = picture.each(|at, value| if is_in(at) { value } else { 0.0 });
    let weights = picture.each(|at, _| if is_in(at) { 1.0 } else { 0.0 });
    let weights = smoothed(&weights, deviation);
    let sums = smoothed(&masked, deviation);
    let plain = smoothed(picture, deviation);
    plain.each(|at, value| {
        if is_in(at) {
            sums.values()[at] / weights.values()[at]
        } else {
            value
        }
    })
}

/// The picture after a Gaussian of a standard deviation in pixels.
fn smoothed(picture: &Raster, deviation: f64) -> Raster {
    if deviation <= 0.0 {
        return picture.clone();
    }
    let reach = (3.0 * deviation).ceil() as usize;
    let weights: Vec<f64> = (0..=reach)
        .map(|i| {
            let off = i as f64 / deviation;
            libm::exp(-0.5 * off * off)
        })
        .collect();
    let total = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
    let weights: Vec<f32> = weights.iter().map(|w| (w / total) as f32).collect();
    let (width, height) = (picture.width(), picture.height());
    let across = picture.mapped(|_, from, to| {
        for (x, to) in to.iter_mut().enumerate() {
            let mut sum = weights[0] * from[x];
            for (i, weight) in weights.iter().enumerate().skip(1) {
                sum += weight * (from[x.saturating_sub(i)] + from[(x + i).min(width - 1)]);
            }
            *to = sum;
        }
    });
    across.mapped(|y, from, to| {
        for (to, from) in to.iter_mut().zip(from) {
            *to = weights[0] * from;
        }
        for (i, weight) in weights.iter().enumerate().skip(1) {
            let row = |y: usize| &across.values()[y * width..][..width];
            let (above, below) = (row(y.saturating_sub(i)), row((y + i).min(height - 1)));
            for ((to, above), below) in to.iter_mut().zip(above).zip(below) {
                *to += weight * (above + below);
            }
        }
    })
}

/// Each pixel over the brightness of the tissue about it: the mean of those pixels of the blade in
/// a window that are no darker (for bright veins: no brighter) than the mean of all of the window.
fn evened(picture: &Raster, blade: &Mask, veins: Ink) -> Raster {
    let longer = picture.width().max(picture.height());
    let half = ((LIGHT_WINDOW * longer as f64 / 2.0) as usize).max(4);
    let all = Means::new(picture, blade, |_, _| true);
    let mean = all.over(picture, half);
    let tissue = Means::new(picture, blade, |at, value| match veins {
        Ink::Dark => value >= mean[at],
        Ink::Bright => value <= mean[at],
    });
    // Where a window holds little blade (about a petiole) the vein itself would be its tissue.
    let whole = tissue.whole();
    let mut tissue = tissue.over_at_least(picture, half, 0.25);
    for level in &mut tissue {
        if *level == 0.0 {
            *level = whole;
        }
    }
    picture.each(|at, value| {
        // Light that is not there at all has nothing to be compared with.
        if tissue[at] > 1e-6 {
            (value / tissue[at]).min(4.0)
        } else {
            1.0
        }
    })
}

/// Sums over rectangles of the blade from the upper left corner, of values and of pixels.
struct Means {
    width: usize,
    height: usize,
    sums: Vec<f64>,
    counts: Vec<u32>,
}

impl Means {
    /// Takes the pixels of the blade for which `counts` holds, by number and value.
    fn new(picture: &Raster, blade: &Mask, counts: impl Fn(usize, f32) -> bool) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let stride = width + 1;
        let mut means = Self {
            width,
            height,
            sums: vec![0.0; stride * (height + 1)],
            counts: vec![0; stride * (height + 1)],
        };
        for y in 0..height {
            let (mut sum, mut count) = (0.0, 0);
            for x in 0..width {
                let at = y * width + x;
                let value = picture.values()[at];
                if blade.cells[blade.cell(x, y)] && counts(at, value) {
                    sum += f64::from(value);
                    count += 1;
                }
                let here = (y + 1) * stride + x + 1;
                means.sums[here] = means.sums[here - stride] + sum;
                means.counts[here] = means.counts[here - stride] + count;
            }
        }
        means
    }

    /// The mean of all pixels that count, 0 without any.
    fn whole(&self) -> f32 {
        let last = self.sums.len() - 1;
        (self.sums[last] / f64::from(self.counts[last].max(1))) as f32
    }

    /// The mean about each pixel over a square with sides of 2 `half` + 1, 0 where nothing counts.
    fn over(&self, picture: &Raster, half: usize) -> Vec<f32> {
        self.over_at_least(picture, half, 0.0)
    }

    /// The same, 0 where less than a share of the square's pixels counts.
    fn over_at_least(&self, picture: &Raster, half: usize, share: f64) -> Vec<f32> {
        let mut means = vec![0.0; picture.values().len()];
        means
            .par_chunks_mut(self.width)
            .enumerate()
            .for_each(|(y, row)| {
                for (x, mean) in row.iter_mut().enumerate() {
                    let [a, b, c, d] = self.corners(x, y, half);
                    let count = self.counts[d] + self.counts[a] - self.counts[b] - self.counts[c];
                    let (across, down) = (b - a, (c - a) / (self.width + 1));
                    let least = share * across as f64 * down as f64;
                    if count > 0 && f64::from(count) >= least {
                        let sum = self.sums[d] + self.sums[a] - self.sums[b] - self.sums[c];
                        *mean = (sum / f64::from(count)) as f32;
                    }
                }
            });
        means
    }

    /// Upper left, upper right, lower left and lower right corner of a square about a pixel.
    fn corners(&self, x: usize, y: usize, half: usize) -> [usize; 4] {
        let (left, right) = (x.saturating_sub(half), (x + half + 1).min(self.width));
        let (up, down) = (y.saturating_sub(half), (y + half + 1).min(self.height));
        let at = |x: usize, y: usize| y * (self.width + 1) + x;
        [at(left, up), at(right, up), at(left, down), at(right, down)]
    }
}

/// The level with the greatest variance between the pixels of the blade below and above it
/// (\[otsu1979\], its measure of separability). `None` if the means differ by less than
/// [`LEAST_CONTRAST`].
fn otsu(picture: &Raster, blade: &Mask) -> Option<f32> {
    let width = picture.width();
    let cells = |y: usize| &blade.cells[blade.cell(0, y)..][..width];
    let values = || {
        let rows = picture.values().chunks(width).enumerate();
        rows.flat_map(|(y, row)| row.iter().zip(cells(y)).filter(|(_, is_in)| **is_in))
            .map(|(value, _)| *value)
    };
    let (low, high) = values().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if high <= low {
        return None;
    }
    let scale = BINS as f32 / (high - low);
    let mut counts = [0_u64; BINS];
    for value in values() {
        counts[(((value - low) * scale) as usize).min(BINS - 1)] += 1;
    }
    let total: u64 = counts.iter().sum();
    let moment = |bins: &mut dyn Iterator<Item = (usize, u64)>| {
        bins.map(|(bin, count)| bin as f64 * count as f64)
            .sum::<f64>()
    };
    let all = moment(&mut counts.iter().copied().enumerate());
    let (mut below, mut of_below) = (0_u64, 0.0);
    // The greatest variance, and the first and last level that have it: between two peaks without
    // anything between them all levels are as good, and the middle one is taken.
    let mut best = (0.0, 0, 0);
    let mut means = (0.0, 0.0);
    for (bin, &count) in counts.iter().enumerate() {
        below += count;
        of_below += bin as f64 * count as f64;
        if below == 0 || below == total {
            continue;
        }
        let (here, there) = (below as f64, (total - below) as f64);
        let (dark, bright) = (of_below / here, (all - of_below) / there);
        let variance = here * there * (bright - dark) * (bright - dark);
        if variance > best.0 {
            best = (variance, bin, bin);
            means = (dark, bright);
        } else if variance == best.0 {
            best.2 = bin;
        }
    }
    let grey = |bin: f64| f64::from(low) + (bin + 0.5) / f64::from(scale);
    let (dark, bright) = (grey(means.0), grey(means.1));
    let contrast = (bright - dark) / bright.abs().max(1e-9);
    let level = f64::from(low) + (0.5 * (best.1 + best.2) as f64 + 1.0) / f64::from(scale);
    (contrast >= LEAST_CONTRAST).then_some(level as f32)
}

/// The distance to the local level `m (1 + k (s/R − 1))` with the mean `m` and the standard
/// deviation `s` of a window and the greatest deviation `R` of the picture
/// (\[sauvola2000\]). Bright veins are dark ones of the negative.
fn sauvola(picture: &Raster, blade: &Mask, veins: Ink, half: usize, k: f64) -> Raster {
    let top = picture.values().iter().copied().fold(0.0_f32, f32::max);
    let dark = match veins {
        Ink::Dark => picture.clone(),
        Ink::Bright => picture.each(|_, value| top - value),
    };
    let squares = dark.each(|_, value| value * value);
    let mean = Means::new(&dark, blade, |_, _| true).over(&dark, half);
    let square = Means::new(&squares, blade, |_, _| true).over(&squares, half);
    let deviation = |at: usize| (square[at] - mean[at] * mean[at]).max(0.0).sqrt();
    let greatest = (0..mean.len())
        .into_par_iter()
        .map(deviation)
        .reduce(|| 0.0, f32::max);
    dark.each(|at, value| {
        let share = deviation(at) / greatest.max(1e-9);
        mean[at] * (1.0 + k as f32 * (share - 1.0)) - value
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dark lines 4 pixels wide, 20 apart, on tissue; `light` falls on pixel (x, y).
    fn lined(light: impl Fn(usize, usize) -> f32) -> Raster {
        let size = 200;
        let values = (0..size * size).map(|at| {
            let (x, y) = (at % size, at / size);
            light(x, y) * if x % 20 < 4 { 0.4 } else { 0.8 }
        });
        Raster::new(size, size, values.collect()).expect("a good raster")
    }

    fn wrong(picture: &Raster, threshold: Threshold, veins: Ink) -> usize {
        let blade = Mask::new(200, 200, |_, _| true);
        let settings = Settings {
            threshold,
            veins,
            smoothing_px: 0.0,
            ..Settings::new(0.01)
        };
        let found = ink(picture, &blade, &settings).expect("it has lines");
        let is_line = |at: usize| at % 200 % 20 < 4;
        (0..200 * 200)
            .filter(|&at| (found.values()[at] > 0.0) != is_line(at))
            .count()
    }

    #[test]
    fn otsu_parts_two_greys_in_the_middle() {
        let blade = Mask::new(200, 200, |_, _| true);
        let level = otsu(&lined(|_, _| 1.0), &blade).expect("two greys");
        assert!((level - 0.6).abs() < 1e-3, "{level}");
        assert_eq!(otsu(&lined(|_, _| 0.0), &blade), None);
    }

    #[test]
    fn light_that_falls_to_a_third_is_made_even() {
        let uneven = lined(|x, y| 1.0 - 0.35 * (x + y) as f32 / 200.0);
        let otsu = |even_light| Threshold::Otsu { even_light };
        let sauvola = Threshold::Sauvola {
            window_px: 41.0,
            k: 0.3,
        };
        assert!(wrong(&uneven, otsu(false), Ink::Dark) > 4000);
        assert_eq!(wrong(&uneven, otsu(true), Ink::Dark), 0);
        assert_eq!(wrong(&uneven, sauvola, Ink::Dark), 0);
        // Bright lines on dark tissue are the negative.
        let negative = lined(|_, _| 1.0).mapped(|_, from, to| {
            for (to, from) in to.iter_mut().zip(from) {
                *to = 1.2 - from;
            }
        });
        assert_eq!(wrong(&negative, otsu(true), Ink::Bright), 0);
    }
}
