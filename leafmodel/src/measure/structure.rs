//! How evenly areoles lie: the structure factor of their centroids.
//!
//! `S(k) = |Σⱼ exp(−i k·xⱼ)|² / N` over the `N` centroids in a rectangle, only at wavevectors
//! `k = 2π (m/Lₓ, n/L_y)` of that rectangle, where the rectangle's own Fourier transform is 0, so that
//! its finite size adds nothing (\[hawat2023\]). Poisson points have `S = 1`; in a hyperuniform
//! pattern `S ~ k^a` with `a > 0` at small `k` (\[torquato2018\]).

use std::f64::consts::TAU;

use glam::DVec2;
use rayon::prelude::*;

use super::subject::Subject;
use super::window;
use crate::numeric::bisect;

/// Least number of centroids.
const FEWEST: usize = 50;

/// Wavevectors up to this many times `2π √ρ` (with `ρ` points per area) are measured.
const FARTHEST: f64 = 2.0;

/// Those up to this many times are fitted.
const FITTED: f64 = 0.25;

/// Bins of `k`, and the most wavevectors of one.
const BINS: usize = 40;
const MOST_IN_BIN: usize = 64;

/// Most wavevectors of the fit, and least.
const MOST_FITTED: usize = 1024;
const FEWEST_FITTED: usize = 8;

/// Points that are added up at a time.
const CHUNK: usize = 1024;

/// Mean structure factors below this are rounding: of a perfect lattice.
const NOTHING: f64 = 1e-12;

/// One bin of the structure factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureBin {
    /// Mean `|k|`, rad/mm.
    pub k_per_mm: f64,
    /// Mean `S(k)`.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
    /// Number of wavevectors.
    pub wavevectors: usize,
}

/// The structure factor of the centroids of areoles.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// Lower left and upper right corner of the window, mm.
    pub window: (DVec2, DVec2),
    /// Number of centroids in it.
    pub count: usize,
    /// The bins, by `k`, those without wavevectors left out.
    pub bins: Vec<StructureBin>,
    /// Mean `S(k)` over the wavevectors of the fit.
    pub low: Option<f64>,
    /// The exponent `a` of `S(k) ~ k^a`, and its standard error.
    pub exponent: Option<(f64, f64)>,
}

impl Subject<'_> {
    /// The structure factor in the largest rectangle of a raster within the blade and the hull of
    /// the centroids; `None` for fewer than 50 centroids.
    pub fn structure(&self) -> Option<Structure> {
        let points: Vec<DVec2> = self.found.iter().map(|areole| areole.centroid).collect();
        if points.len() < FEWEST {
            return None;
        }
        let window = window::largest(&points, self.blade.outline())?;
        structure(&points, window)
    }
}

/// The structure factor of the points in a rectangle.
fn structure(points: &[DVec2], (low, high): (DVec2, DVec2)) -> Option<Structure> {
    let size = high - low;
    let inside: Vec<DVec2> = points
        .iter()
        .filter(|p| p.cmpge(low).all() && p.cmplt(high).all())
        .map(|p| (*p - low) / size)
        .collect();
    if inside.len() < FEWEST {
        return None;
    }
    let unit = TAU * (inside.len() as f64 / (size.x * size.y)).sqrt();
    let length = |[m, n]: [i32; 2]| TAU * (DVec2::new(f64::from(m), f64::from(n)) / size).length();
    let chosen = chosen(unit, size, length);
    let values = factors(
        &inside,
        &chosen.iter().map(|(wave, _)| *wave).collect::<Vec<_>>(),
    );
    let all: Vec<(f64, f64)> = chosen
        .iter()
        .zip(&values)
        .map(|((wave, _), s)| (length(*wave), *s))
        .collect();
    let bins = (0..BINS).filter_map(|bin| {
        let in_bin = chosen
            .iter()
            .zip(&all)
            .filter(|((_, place), _)| *place == Some(bin));
        bin_of(&in_bin.map(|(_, pair)| *pair).collect::<Vec<_>>())
    });
    let fitted: Vec<(f64, f64)> = all
        .iter()
        .copied()
        .filter(|(k, _)| *k <= FITTED * unit)
        .collect();
    let enough = fitted.len() >= FEWEST_FITTED;
    let low_k = fitted.iter().map(|(_, s)| s).sum::<f64>() / fitted.len().max(1) as f64;
    Some(Structure {
        window: (low, high),
        count: inside.len(),
        bins: bins.collect(),
        low: enough.then_some(low_k),
        exponent: if enough && low_k > NOTHING {
            exponent(&fitted)
        } else {
            None
        },
    })
}

/// The wavevectors that are measured, in units of the window's, one of each pair `±k`, and the bin to
/// which each counts. Of many, every so many-th is taken.
fn chosen(
    unit: f64,
    size: DVec2,
    length: impl Fn([i32; 2]) -> f64,
) -> Vec<([i32; 2], Option<usize>)> {
    let most = FARTHEST * unit;
    let [across, along] = [size.x, size.y].map(|side| (most * side / TAU) as i32);
    let mut bins: Vec<Vec<[i32; 2]>> = vec![Vec::new(); BINS];
    let mut low = Vec::new();
    for m in 0..=across {
        for n in if m == 0 { 1 } else { -along }..=along {
            let k = length([m, n]);
            if k < most {
                bins[(k / most * BINS as f64) as usize].push([m, n]);
            }
            if k <= FITTED * unit {
                low.push([m, n]);
            }
        }
    }
    let thin = |list: &[[i32; 2]], most: usize| -> Vec<[i32; 2]> {
        let step = list.len().div_ceil(most).max(1);
        list.iter().copied().step_by(step).collect()
    };
    let mut chosen: Vec<([i32; 2], Option<usize>)> = Vec::new();
    for (bin, list) in bins.iter().enumerate() {
        chosen.extend(
            thin(list, MOST_IN_BIN)
                .into_iter()
                .map(|wave| (wave, Some(bin))),
        );
    }
    let seen: std::collections::BTreeSet<[i32; 2]> = chosen.iter().map(|(wave, _)| *wave).collect();
    let more = thin(&low, MOST_FITTED)
        .into_iter()
        .filter(|wave| !seen.contains(wave));
    chosen.extend(more.map(|wave| (wave, None)));
    chosen
}

/// `S` at each wavevector; places in shares of the window.
fn factors(places: &[DVec2], waves: &[[i32; 2]]) -> Vec<f64> {
    let most = waves
        .iter()
        .flatten()
        .map(|n| n.unsigned_abs())
        .max()
        .unwrap_or(0) as usize;
    // Sums of chunks are added in their order, so that threads change nothing.
    let sums: Vec<Vec<DVec2>> = places
        .par_chunks(CHUNK)
        .map(|chunk| {
            let mut sums = vec![DVec2::ZERO; waves.len()];
            let mut powers = [vec![DVec2::X; most + 1], vec![DVec2::X; most + 1]];
            for place in chunk {
                for (axis, powers) in powers.iter_mut().enumerate() {
                    let (sin, cos) = libm::sincos(-TAU * place[axis]);
                    for i in 1..=most {
                        powers[i] = times(powers[i - 1], DVec2::new(cos, sin));
                    }
                }
                for (sum, [m, n]) in sums.iter_mut().zip(waves) {
                    let along = powers[1][n.unsigned_abs() as usize];
                    let along = if *n < 0 {
                        DVec2::new(along.x, -along.y)
                    } else {
                        along
                    };
                    *sum += times(powers[0][*m as usize], along);
                }
            }
            sums
        })
        .collect();
    let whole = |wave: usize| sums.iter().map(|chunk| chunk[wave]).sum::<DVec2>();
    (0..waves.len())
        .map(|wave| whole(wave).length_squared() / places.len() as f64)
        .collect()
}

/// The product of two complex numbers.
fn times(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

fn bin_of(pairs: &[(f64, f64)]) -> Option<StructureBin> {
    let count = pairs.len() as f64;
    let value = pairs.iter().map(|(_, s)| s).sum::<f64>() / count;
    let squares: f64 = pairs.iter().map(|(_, s)| (s - value) * (s - value)).sum();
    (!pairs.is_empty()).then(|| StructureBin {
        k_per_mm: pairs.iter().map(|(k, _)| k).sum::<f64>() / count,
        value,
        error: if pairs.len() > 1 {
            (squares / (count - 1.0) / count).sqrt()
        } else {
            value
        },
        wavevectors: pairs.len(),
    })
}

/// The exponent `a` of `S ~ C k^a` and its standard error, by Whittle's likelihood (\[robinson1995\]):
/// each `S` is distributed exponentially about its mean, so `a` minimises
/// `ln Σ Sᵢ kᵢ^−a + a Σ ln kᵢ / m`, and its standard error is `1 / √Σ (ln kᵢ − mean)²`.
fn exponent(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    const STEPS: usize = 80;
    let count = pairs.len() as f64;
    let middle = pairs.iter().map(|(k, _)| libm::log(*k)).sum::<f64>() / count;
    let centred: Vec<(f64, f64)> = pairs
        .iter()
        .map(|(k, s)| (libm::log(*k) - middle, *s))
        .collect();
    let spread: f64 = centred.iter().map(|(x, _)| x * x).sum();
    // The slope of what is minimised, which rises with `a`.
    let slope = |a: f64| {
        let (mut sum, mut weighted) = (0.0, 0.0);
        for (x, s) in &centred {
            let weight = s * libm::exp(-a * x);
            sum += weight;
            weighted += weight * x;
        }
        -weighted / sum
    };
    let (low, high) = (-8.0, 16.0);
    if !(slope(low) < 0.0 && slope(high) > 0.0) {
        return None;
    }
    let (low, high) = bisect(low, high, STEPS, |a| slope(a) < 0.0);
    Some((0.5 * (low + high), 1.0 / spread.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use properties::uniform;

    const SIDE: i32 = 64;

    /// Points of a square lattice of 64 by 64, each moved within its cell by a share of its side.
    fn jittered(share: f64, seed: u64) -> Vec<DVec2> {
        let cells = (0..SIDE * SIDE).map(|i| DVec2::new(f64::from(i % SIDE), f64::from(i / SIDE)));
        cells
            .zip(0..)
            .map(|(cell, i)| {
                let random = DVec2::new(uniform(seed, 78, i), uniform(seed, 79, i));
                cell + DVec2::splat(0.5) + share * (random - DVec2::splat(0.5))
            })
            .collect()
    }

    fn of(points: &[DVec2]) -> Structure {
        structure(points, (DVec2::ZERO, DVec2::splat(f64::from(SIDE)))).expect("many points")
    }

    #[test]
    fn poisson_points_have_a_structure_factor_of_one_and_no_exponent() {
        for seed in 1..5 {
            let count = u64::from(SIDE.unsigned_abs().pow(2));
            let place =
                |i| f64::from(SIDE) * DVec2::new(uniform(seed, 78, i), uniform(seed, 79, i));
            let found = of(&(0..count).map(place).collect::<Vec<_>>());
            assert_eq!(found.count, 4096);
            // Some 400 exponential variables: their mean is known to 5 %, the exponent to 0.1.
            let low = found.low.expect("many wavevectors");
            assert!((low - 1.0).abs() < 0.2, "{low}");
            let (exponent, error) = found.exponent.expect("many wavevectors");
            assert!((0.08..0.12).contains(&error), "{error}");
            assert!(exponent.abs() < 4.0 * error, "{exponent} ± {error}");
            let beyond = found.bins.iter().filter(|bin| bin.wavevectors >= 60);
            for bin in beyond {
                assert!((bin.value - 1.0).abs() < 5.0 * bin.error, "{bin:?}");
            }
        }
    }

    #[test]
    fn a_jittered_grid_is_hyperuniform_with_exponent_two_and_its_known_structure_factor() {
        for seed in 1..5 {
            let found = of(&jittered(1.0, seed));
            let (exponent, error) = found.exponent.expect("many wavevectors");
            // In the fitted range S bends below k²: to first order the exponent is 0.05 less.
            assert!(
                (exponent - 1.97).abs() < 4.0 * error,
                "{exponent} ± {error}"
            );
            // Independent moves: S = 1 − |φ|², with φ = sinc(kₓ/2) sinc(k_y/2) for uniform ones;
            // on the average over directions 1 − φ² is k²/12 − k⁴ (…) at small k.
            let first = found.bins[2];
            let expected = first.k_per_mm * first.k_per_mm / 12.0;
            assert!(
                (first.value - expected).abs() < 5.0 * first.error,
                "{first:?} {expected}"
            );
        }
    }

    #[test]
    fn a_lattice_has_nothing_at_small_wavevectors_and_peaks_at_its_own() {
        let found = of(&jittered(0.0, 1));
        assert!(found.low.expect("many wavevectors") < 1e-20);
        assert_eq!(found.exponent, None);
        let points: Vec<DVec2> = jittered(0.0, 1)
            .iter()
            .map(|p| *p / f64::from(SIDE))
            .collect();
        let peak = factors(&points, &[[SIDE, 0], [0, SIDE], [SIDE, -SIDE], [SIDE, 1]]);
        for value in &peak[..3] {
            assert!((value - 4096.0).abs() < 1e-6, "{value}");
        }
        assert!(peak[3] < 1e-12);
    }

    #[test]
    fn few_points_have_none() {
        assert_eq!(
            structure(&jittered(1.0, 1)[..40], (DVec2::ZERO, DVec2::splat(64.0))),
            None
        );
    }
}
