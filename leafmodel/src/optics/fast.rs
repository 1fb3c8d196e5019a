//! The same leaf optics for inner loops: a few dozen nanoseconds a wavelength.
//!
//! The formulae are those of [`super::plate`] and [`super::pile`], in a form without branches, so that
//! several wavelengths go side by side through the processor's vector units. The transmissivity of a
//! layer comes from a table of its optical depth, exponentials and logarithms from polynomials.
//!
//! - **In**: [`PileLane`]s, made once a wavelength; absorption per plate, number of plates.
//! - **Out**: `(R, T)` in `f32`, before rounding within 1e-7 (relative) of the exact model,
//!   or within 1e-15 (absolute) where less than 1e-8 of the light passes.
//! - **Always true**: the same bits for a lane alone and among others, on every machine.

mod depth;
mod elementary;

use super::constituents::{Coefficients, SpecificAbsorption};
use super::contents::Contents;
use elementary::{exp_minus_one, log_one_plus};

/// Below this `1 − e^−2(α+mβ)` the pile is taken to be lossless. At such values the share absorbed is far below `f32`.
const LOSSLESS: f64 = 1e-30;

/// What the faces of a plate do at one wavelength, ready for use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PileLane {
    /// `t_av(40°)`.
    t_lit: f64,
    /// `t₁₂ = t_av(90°)`.
    t_in: f64,
    /// `t₂₁ = t₁₂ / n²`.
    t_out: f64,
    /// What the constituents absorb at this wavelength.
    absorption: SpecificAbsorption,
}

impl PileLane {
    /// A lane for the wavelength at which these constants hold.
    pub fn new(coefficients: &Coefficients) -> Self {
        Self {
            t_lit: coefficients.interface.t_av_40,
            t_in: coefficients.interface.t_av_90,
            t_out: coefficients.interface.transmissivity_from_inside(),
            absorption: coefficients.absorption,
        }
    }

    /// `K(λ)` of one plate, as [`Coefficients::absorption_per_plate`].
    #[inline]
    pub fn absorption_per_plate(&self, contents: &Contents) -> f64 {
        self.absorption.of_leaf(contents) / contents.structure
    }

    /// `(R, T)` of `n` (real, ≥ 1) plates of absorption `k_per_plate` (≥ 0) each.
    #[inline]
    pub fn evaluate(&self, k_per_plate: f64, n: f64) -> (f32, f32) {
        let (r, t) = self.evaluate_f64(depth::optical_depth(k_per_plate), n);
        (r as f32, t as f32)
    }

    /// `(R, T)` of a leaf with these contents at each of the lanes.
    #[inline]
    pub fn evaluate_lanes<const L: usize>(
        lanes: &[Self; L],
        contents: &Contents,
    ) -> ([f32; L], [f32; L]) {
        let mut depths = [0.0; L];
        let per_plate = 1.0 / contents.structure;
        for (depth, lane) in depths.iter_mut().zip(lanes) {
            *depth = depth::optical_depth(lane.absorption.of_leaf(contents) * per_plate);
        }
        let (mut r, mut t) = ([0.0; L], [0.0; L]);
        for i in 0..L {
            let both = lanes[i].evaluate_f64(depths[i], contents.structure);
            r[i] = both.0 as f32;
            t[i] = both.1 as f32;
        }
        (r, t)
    }

    /// `R`, `T` from the optical depth `−ln τ` of a layer.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inside the loop over lanes can it be vectorised"
    )]
    fn evaluate_f64(&self, depth: f64, n: f64) -> (f64, f64) {
        // One plate. `absorbed` is 1 − τ to full relative accuracy.
        let absorbed = -exp_minus_one(-depth);
        let tau = 1.0 - absorbed;
        let r_inside = 1.0 - self.t_out;
        let inside = r_inside * tau;
        let once = 1.0 / ((1.0 - inside) * (1.0 + inside));
        let passes = tau * self.t_out * once;
        let t_first = self.t_lit * passes;
        let r_first = (1.0 - self.t_lit) + inside * t_first;
        let t = self.t_in * passes;
        let r = (1.0 - self.t_in) + inside * t;
        let lost = self.t_in * absorbed * (1.0 + inside) * once;

        // The plates below, as in `pile::below`: `rise` is sinh α, `x` sinh β, `fall` e^−α. Where no
        // light passes, t is kept from zero: then β is huge, and nothing comes from below anyhow.
        let delta = ((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * lost).sqrt();
        let some_t = t.max(1e-140);
        let half = 0.5 * delta / (r * some_t);
        let (rise, x) = (half * some_t, half * r);
        let fall = (1.0 + rise * rise).sqrt() - rise;
        // asinh x = ln(1 + x + x² / (1 + √(1 + x²))), which keeps its digits for small x.
        let x2 = x * x;
        let beta = log_one_plus(x + x2 / (1.0 + (1.0 + x2).sqrt()));
        let m = n - 1.0;
        let root = exp_minus_one(-m * beta); // e^−mβ − 1
        let y = 1.0 + root; // e^−mβ
        let one_minus_y2 = -root * (1.0 + y);
        let one_minus_fall2 = 2.0 * rise * fall;
        let whole = one_minus_y2 + y * y * one_minus_fall2;
        let (back, through, of) = if whole > LOSSLESS {
            (fall * one_minus_y2, y * one_minus_fall2, whole)
        } else {
            (m * r, t, t + m * r)
        };
        let (r_below, t_below) = (back / of, through / of);

        let entering = t_first / (1.0 - r_below * r);
        let reflectance = r_first + entering * r_below * t;
        (reflectance, (entering * t_below).min(1.0 - reflectance))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::optics::ProspectD;
    use crate::optics::pile::pile;

    fn lane(nm: f64) -> (Coefficients, PileLane) {
        let at = ProspectD::coefficients(nm).expect("in range");
        (at, PileLane::new(&at))
    }

    proptest! {
        #[test]
        fn the_fast_model_is_the_exact_one_to_1e_7(
            nm in 400.0..2500.0,
            log_k in -12.0..1.0,
            n in 1.0..4.0,
        ) {
            let k = 10f64.powf(log_k);
            let (at, lane) = lane(nm);
            let exact = pile(&at.interface, k, n);
            let (r, t) = lane.evaluate_f64(depth::optical_depth(k), n);
            prop_assert!((r - exact.reflectance).abs() <= 1e-7 * exact.reflectance, "R {r}: {exact:?}");
            prop_assert!((t - exact.transmittance).abs() <= 1e-7 * exact.transmittance + 1e-15, "T {t}: {exact:?}");
        }

        #[test]
        fn what_is_absorbed_is_right_too(nm in 400.0..2500.0, log_k in -9.0..-1.0, n in 1.0..4.0) {
            let k = 10f64.powf(log_k);
            let (at, lane) = lane(nm);
            let exact = pile(&at.interface, k, n);
            let (r, t) = lane.evaluate_f64(depth::optical_depth(k), n);
            let exact = 1.0 - exact.reflectance - exact.transmittance;
            prop_assert!(((1.0 - r - t) - exact).abs() <= 1e-6 * exact + 1e-14);
        }
    }

    #[test]
    fn nothing_absorbed_means_all_comes_out() {
        for n in [1.0, 1.0 + 1e-12, 1.5, 3.7] {
            for k in [0.0, 1e-300, 1e-40, 1e-20] {
                let (_, lane) = lane(800.0);
                let (r, t) = lane.evaluate_f64(depth::optical_depth(k), n);
                assert!((r + t - 1.0).abs() < 1e-14, "N = {n}, K = {k}: {r} + {t}");
            }
        }
    }

    #[test]
    fn extreme_absorption_stays_finite() {
        for n in [1.0, 1.5, 40.0] {
            for k in [30.0, 128.0, 745.0, 1e4, 1e300] {
                let (at, lane) = lane(1450.0);
                let (r, t) = lane.evaluate(k, n);
                let first = (1.0 - at.interface.t_av_40) as f32;
                assert!((r - first).abs() < 1e-7, "N = {n}, K = {k}: {r}");
                assert!((0.0..1e-10).contains(&t), "N = {n}, K = {k}: {t}");
            }
        }
    }

    #[test]
    fn lanes_together_are_the_lanes_alone() {
        let contents = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("valid");
        let lanes = std::array::from_fn::<_, 8, _>(|i| lane(410.0 + 250.0 * i as f64).1);
        let (r, t) = PileLane::evaluate_lanes(&lanes, &contents);
        for i in 0..8 {
            let alone = PileLane::evaluate_lanes(&[lanes[i]], &contents);
            assert_eq!(
                (alone.0[0].to_bits(), alone.1[0].to_bits()),
                (r[i].to_bits(), t[i].to_bits())
            );
        }
    }

    #[test]
    #[ignore = "a measurement, not a check: run it in release with --nocapture"]
    fn nanoseconds_a_wavelength() {
        let lanes = std::array::from_fn::<_, 8, _>(|i| lane(410.0 + 50.0 * i as f64).1);
        let mut contents = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("valid");
        let rounds = 400_000;
        let start = std::time::Instant::now();
        let mut sum = 0.0_f32;
        for i in 0..rounds {
            contents.chlorophyll = 20.0 + f64::from(i % 100);
            let (r, t) = PileLane::evaluate_lanes(&lanes, &contents);
            sum += r[i as usize % 8] + t[3];
        }
        let ns = start.elapsed().as_secs_f64() * 1e9 / f64::from(rounds) / 8.0;
        eprintln!("{ns:.1} ns a wavelength (sum {sum})");
    }
}
