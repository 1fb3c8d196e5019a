//! Mottle: smooth noise over the lamina.

use glam::DVec2;

use crate::random::hashed;

/// Gradient noise of two octaves with values in [−1, 1], mean 0, continuous with its second
/// derivative.
///
/// Gradients sit on the corners of a square lattice (Perlin 1985), one of 16 directions each, taken
/// from a hash of seed, octave and corner; between corners a quintic blends them (Perlin 2002). The
/// second octave has half the size and half the height.
///
/// \[perlin1985\] ACM SIGGRAPH 19(3):287; \[perlin2002\] ACM TOG 21(3):681.
#[derive(Clone, Copy, Debug)]
pub struct Mottle {
    /// State of the hash of each octave.
    octaves: [u64; 2],
    scale_mm: f64,
    /// Cells of the first octave after which the lattice repeats, both ways.
    repeat: Option<u32>,
}

/// Cosines of 0, 22.5, 45, 67.5 and 90°.
const COSINES: [f64; 5] = [
    1.0,
    0.923_879_532_511_286_7,
    std::f64::consts::FRAC_1_SQRT_2,
    0.382_683_432_365_089_8,
    0.0,
];

/// 16 unit vectors, evenly around the circle. Which one comes next is chance, so that they are looked
/// up, not chosen by branches.
const DIRECTIONS: [DVec2; 16] = {
    let mut directions = [DVec2::ZERO; 16];
    let mut step = 0;
    while step < 16 {
        let (c, s) = (COSINES[step % 4], COSINES[4 - step % 4]);
        directions[step] = match step / 4 {
            0 => DVec2::new(c, s),
            1 => DVec2::new(-s, c),
            2 => DVec2::new(-c, -s),
            _ => DVec2::new(s, -c),
        };
        step += 1;
    }
    directions
};

impl Mottle {
    /// Noise whose patches are about `scale_mm` (> 0) wide.
    #[must_use]
    pub fn new(seed: u64, scale_mm: f64) -> Self {
        Self {
            octaves: [0, 1].map(|octave| hashed(seed, octave)),
            scale_mm,
            repeat: None,
        }
    }

    /// The same noise with a lattice that repeats after `cells` (≥ 1) cells of `scale_mm`, as that
    /// of Perlin 1985 does after 256.
    #[must_use]
    pub(crate) fn repeating(self, cells: u32) -> Self {
        Self {
            repeat: Some(cells),
            ..self
        }
    }

    /// The noise at a point given in millimetres, in [−1, 1].
    #[must_use]
    pub fn at(&self, point: DVec2) -> f64 {
        // One lattice cell holds about half a wave.
        let place = point / self.scale_mm;
        let [whole, half] = self.octaves;
        let repeat = |octaves_down: u32| self.repeat.map(|cells| i64::from(cells) << octaves_down);
        let sum =
            (octave(whole, place, repeat(0)) + 0.5 * octave(half, 2.0 * place, repeat(1))) / 1.5;
        // Gradient noise seldom comes near its bounds; this spreads it, with slope 3/2 at 0 and 0
        // at ±1.
        let bounded = sum.clamp(-1.0, 1.0);
        bounded * (1.5 - 0.5 * bounded * bounded)
    }
}

/// One octave on the unit lattice, which repeats after `repeat` cells if given, in [−1, 1].
fn octave(state: u64, place: DVec2, repeat: Option<i64>) -> f64 {
    let corner = place.floor();
    let inside = place - corner;
    let (column, row) = (corner.x as i64, corner.y as i64);
    let lattice = |number: i64| repeat.map_or(number, |cells| number.rem_euclid(cells)) as u64;
    let pulls = |i: i64| {
        let state = hashed(state, lattice(column.wrapping_add(i)));
        [0, 1].map(|j: i64| {
            let bits = hashed(state, lattice(row.wrapping_add(j)));
            let gradient = DIRECTIONS[(bits >> 60) as usize];
            gradient.dot(inside - DVec2::new(i as f64, j as f64))
        })
    };
    let ([low_left, high_left], [low_right, high_right]) = (pulls(0), pulls(1));
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (x, y) = (fade(inside.x), fade(inside.y));
    let low = low_left + x * (low_right - low_left);
    let high = high_left + x * (high_right - high_left);
    // With unit gradients the bound is √½, reached in the middle of a cell.
    std::f64::consts::SQRT_2 * (low + y * (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(mottle: Mottle) -> Vec<f64> {
        (0..10_000)
            .map(|i| {
                let (column, row) = (i % 100, i / 100);
                mottle.at(DVec2::new(
                    f64::from(column) * 0.37 - 20.0,
                    f64::from(row) * 0.41,
                ))
            })
            .collect()
    }

    #[test]
    fn values_stay_in_bounds_average_to_nothing_and_vary() {
        let values = samples(Mottle::new(5, 1.0));
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        assert!(values.iter().all(|v| v.abs() <= 1.0));
        // 10⁴ samples, of which about one a lattice cell (1500 cells) is independent.
        assert!(mean.abs() < 4.0 * (variance / 1500.0).sqrt(), "{mean}");
        assert!((0.2..0.6).contains(&variance.sqrt()), "{variance}");
    }

    #[test]
    fn another_seed_is_another_pattern_and_the_same_seed_the_same_bits() {
        let bits = |seed| -> Vec<u64> {
            samples(Mottle::new(seed, 1.0))
                .into_iter()
                .map(f64::to_bits)
                .collect()
        };
        assert_eq!(bits(7), bits(7));
        let equal = bits(7)
            .iter()
            .zip(bits(8))
            .filter(|(a, b)| **a == *b)
            .count();
        assert!(equal < 100, "{equal}");
    }

    #[test]
    fn there_is_no_step_across_the_lattice() {
        let mottle = Mottle::new(3, 2.0);
        for i in 0..200 {
            let along = f64::from(i) * 0.137;
            for (low, high) in [
                (DVec2::new(4.0 - 1e-9, along), DVec2::new(4.0 + 1e-9, along)),
                (
                    DVec2::new(along, -2.0 - 1e-9),
                    DVec2::new(along, -2.0 + 1e-9),
                ),
            ] {
                assert!((mottle.at(low) - mottle.at(high)).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn gradients_have_length_one_in_sixteen_directions() {
        for (i, one) in DIRECTIONS.iter().enumerate() {
            assert!((one.length() - 1.0).abs() < 1e-15);
            assert!(
                DIRECTIONS[..i]
                    .iter()
                    .all(|other| (*other - *one).length() > 0.3)
            );
        }
    }

    #[test]
    fn a_lattice_repeats_after_its_cells_and_not_before() {
        let noise = Mottle::new(4, 2.0);
        let repeating = noise.repeating(5);
        let shift = |cells: f64| DVec2::new(2.0 * cells, -2.0 * cells);
        let mut other = 0;
        for i in 0..500 {
            let p = DVec2::new(0.173 * f64::from(i), 31.0 - 0.211 * f64::from(i));
            let value = repeating.at(p);
            assert!((value - repeating.at(p + shift(5.0))).abs() < 1e-9);
            other += i32::from((value - repeating.at(p + shift(4.0))).abs() > 0.05);
            other += i32::from((noise.at(p) - noise.at(p + shift(5.0))).abs() > 0.05);
        }
        assert!(other > 800, "{other}");
    }
}
