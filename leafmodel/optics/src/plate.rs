//! One plate: a layer that absorbs, between two rough faces.

use super::interface::Interface;

const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;

/// Above this the continued fraction is used, below it the power series.
const SERIES_UP_TO: f64 = 1.0;

/// Transmissivity `τ(K) = 2 E₃(K)` of a layer of absorption `K ≥ 0` for diffuse light, in [0, 1].
///
/// `τ = 2 ∫₀¹ μ exp(−K/μ) dμ`, the same as `(1−K) e^−K + K² E₁(K)`, a form that loses all its
/// digits for large `K`. Relative error below 1e-13; 1 at `K = 0`, 0 once `e^−K` underflows.
///
/// # Source
///
/// \[jacquemoud1990\] for its use; series and continued fraction of `E₃` as in the NIST Digital
/// Library of Mathematical Functions, 8.19.8 and 8.19.17.
pub(crate) fn layer_transmissivity(k: f64) -> f64 {
    if k <= SERIES_UP_TO {
        1.0 - absorbed_by_series(k)
    } else {
        2.0 * third_exponential_integral(k)
    }
}

/// `1 − τ(K)`, to full relative accuracy also where τ is nearly 1. In [0, 1].
pub fn layer_absorptance(k: f64) -> f64 {
    if k <= SERIES_UP_TO {
        absorbed_by_series(k)
    } else {
        1.0 - 2.0 * third_exponential_integral(k)
    }
}

/// `1 − 2 E₃(k)` for `0 ≤ k ≤ 1`:
/// `2k − k² (3/2 − γ − ln k) + 2 Σ_{m≥3} (−k)^m / ((m−2) m!)`.
fn absorbed_by_series(k: f64) -> f64 {
    if k <= 0.0 {
        return 0.0;
    }
    // `power` is (−k)^m / m!, which falls off so fast for k ≤ 1 that some 20 terms are enough.
    let mut power = k * k / 2.0;
    let mut tail = 0.0;
    let mut m = 2.0;
    loop {
        m += 1.0;
        power *= -k / m;
        let term = power / (m - 2.0);
        tail += term;
        if term.abs() <= 1e-18 * k {
            break;
        }
    }
    k * (2.0 - k * (1.5 - EULER_GAMMA - libm::log(k))) + 2.0 * tail
}

/// `E₃(k)` for `k > 1` by its continued fraction, evaluated from the front (modified Lentz).
fn third_exponential_integral(k: f64) -> f64 {
    let mut b = k + 3.0;
    let mut c = f64::INFINITY;
    let mut d = 1.0 / b;
    let mut h = d;
    let mut i = 1.0;
    loop {
        let a = -i * (2.0 + i);
        b += 2.0;
        d = 1.0 / (a * d + b);
        c = b + a / c;
        let factor = c * d;
        h *= factor;
        i += 1.0;
        if (factor - 1.0).abs() < 1e-16 || i > 200.0 {
            break;
        }
    }
    h * libm::exp(-k)
}

/// Terms of the series of `E₁` for [`Layer`].
const TERMS: usize = 30;
/// Up to this absorption that series is used. Its terms alternate, so that it loses digits above.
const LAYER_SERIES_UP_TO: f64 = 2.5;

/// What a layer absorbs and lets through, with the slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layer {
    /// `1 − τ(K)`.
    pub(super) absorbed: f64,
    /// `τ(K)`.
    pub(super) passed: f64,
    /// `dτ/dK = −2 E₂(K)`.
    pub(super) slope: f64,
}

impl Layer {
    /// Of absorption `k > 0`, from `E₁` by the recurrence `n Eₙ₊₁ = e^−k − k Eₙ`; relative error below
    /// 1e-12 up to `k = 10`.
    ///
    /// # Source
    ///
    /// NIST Digital Library of Mathematical Functions, 6.6.2 for the series, 8.19.12 for the
    /// recurrence.
    pub(super) fn of(k: f64) -> Self {
        let fall = libm::exp(-k);
        if k > LAYER_SERIES_UP_TO {
            // Downwards the recurrence keeps its digits where e^−k and k E₂ nearly cancel.
            let passed = 2.0 * third_exponential_integral(k);
            let slope = -2.0 * (fall - passed) / k;
            return Self {
                absorbed: 1.0 - passed,
                passed,
                slope,
            };
        }
        let e1 = -EULER_GAMMA - libm::log(k) + k * first_integral_series(k);
        let e2 = fall - k * e1;
        Self {
            absorbed: k * e2 - libm::expm1(-k),
            passed: fall - k * e2,
            slope: -2.0 * e2,
        }
    }
}

/// `Σ_{m≥1} (−1)^(m+1) k^(m−1) / (m m!)`.
fn first_integral_series(k: f64) -> f64 {
    const COEFFICIENTS: [f64; TERMS] = {
        let mut coefficients = [0.0; TERMS];
        let (mut m, mut factorial) = (1, 1.0);
        while m <= TERMS {
            factorial *= m as f64;
            let sign = if m % 2 == 1 { 1.0 } else { -1.0 };
            coefficients[m - 1] = sign / (m as f64 * factorial);
            m += 1;
        }
        coefficients
    };
    let mut sum = 0.0;
    for coefficient in COEFFICIENTS.iter().rev() {
        sum = sum * k + coefficient;
    }
    sum
}

/// What one plate does to light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Reflectance of the outermost plate, lit from a cone of 40°.
    pub lit_reflectance: f64,
    /// Transmittance of the outermost plate, lit from a cone of 40°.
    pub lit_transmittance: f64,
    /// Reflectance of a plate in diffuse light, in (0, 1).
    pub reflectance: f64,
    /// Transmittance of a plate in diffuse light, in [0, 1).
    pub transmittance: f64,
    /// `1 − reflectance − transmittance` in diffuse light, without cancellation, in [0, 1).
    pub absorptance: f64,
}

impl Plate {
    /// A plate with these faces and absorption `k ≥ 0`: all reflections inside summed.
    ///
    /// With `τ` the layer's transmissivity, `t₁₂` and `t₂₁ = t₁₂/n²` those of a face from outside
    /// and inside, `r = 1 − t` each: `t = t₁₂ τ t₂₁ / (1 − r₂₁² τ²)`, `r = r₁₂ + r₂₁ τ t`. What is
    /// absorbed follows by subtraction, where all that is large drops out:
    /// `1 − r − t = t₁₂ (1 − τ) / (1 − r₂₁ τ)`.
    ///
    /// # Source
    ///
    /// Allen et al. (1969), J. Opt. Soc. Am. 59:1376; \[jacquemoud1990\].
    pub fn new(interface: &Interface, k: f64) -> Self {
        let tau = layer_transmissivity(k);
        let absorbed = layer_absorptance(k);
        let (t_lit, t_in) = (interface.t_av_40, interface.t_av_90);
        let t_out = interface.transmissivity_from_inside();
        let r_inside = 1.0 - t_out;
        let passes = tau * t_out / (1.0 - r_inside * r_inside * tau * tau);
        let (lit_transmittance, transmittance) = (t_lit * passes, t_in * passes);
        Self {
            lit_reflectance: (1.0 - t_lit) + r_inside * tau * lit_transmittance,
            lit_transmittance,
            reflectance: (1.0 - t_in) + r_inside * tau * transmittance,
            transmittance,
            absorptance: t_in * absorbed / (1.0 - r_inside * tau),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `2 E₃(k)` to 20 digits, from the series and the continued fraction in 60-digit arithmetic.
    const TAU: &[(f64, f64)] = &[
        (1e-12, 9.99999999998000000000e-1),
        (1e-06, 9.99998000014738295226e-1),
        (0.001, 9.98007830872905752784e-1),
        (0.01, 9.80553128369330184026e-1),
        (0.1, 8.32582915816557514487e-1),
        (0.25, 6.49368251956287288342e-1),
        (0.5, 4.43208728550356914739e-1),
        (0.9, 2.51405956828119612338e-1),
        (0.999, 2.19681144915694337861e-1),
        (1.0, 2.19383934395520273677e-1),
        (1.001, 2.19087162643337659972e-1),
        (1.5, 1.13478980340708552313e-1),
        (2.0, 6.02667595956317863750e-2),
        (3.0, 1.78612931120454507538e-2),
        (5.0, 1.75560178554127654672e-3),
        (8.0, 6.23614666936108416940e-5),
        (13.0, 2.85586213971563604884e-7),
        (20.0, 1.80182336266928030235e-10),
        (50.0, 7.28581885295040996244e-24),
    ];

    #[test]
    fn the_transmissivity_has_thirteen_digits() {
        for &(k, exact) in TAU {
            let error = (layer_transmissivity(k) - exact).abs() / exact;
            assert!(error < 1e-13, "K = {k}: relative error {error}");
        }
    }

    #[test]
    fn the_absorptance_keeps_its_digits_where_little_is_absorbed() {
        // 1 − τ = 2k − k² (3/2 − γ − ln k) − k³/3 + …; at 1e-9 two terms are exact to 1e-18.
        let k = 1e-9_f64;
        let exact = 2e-9 - 1e-18 * (1.5 - EULER_GAMMA - libm::log(k));
        assert!((layer_absorptance(k) - exact).abs() < 1e-15 * exact);
        for &(k, tau) in TAU {
            let absorbed = layer_absorptance(k);
            let error = (absorbed - (1.0 - tau)).abs();
            assert!(error < 1e-15, "K = {k}: {absorbed} is off by {error}");
        }
    }

    #[test]
    fn the_transmissivity_is_finite_at_both_ends() {
        assert_eq!(layer_transmissivity(0.0), 1.0);
        assert_eq!(layer_absorptance(0.0), 0.0);
        assert_eq!(layer_transmissivity(f64::MIN_POSITIVE), 1.0);
        for k in [700.0, 745.0, 800.0, 1e6, 1e300] {
            let tau = layer_transmissivity(k);
            assert!((0.0..1e-300).contains(&tau), "K = {k}: {tau}");
        }
    }

    #[test]
    fn the_layer_with_its_slope_is_the_layer() {
        for step in 0..600 {
            let k = 10f64.powf(-9.0 + 0.018 * f64::from(step));
            let layer = Layer::of(k);
            let near = |value: f64, exact: f64| (value - exact).abs() < 1e-12 * exact;
            assert!(
                near(layer.absorbed, layer_absorptance(k)),
                "K = {k}: {layer:?}"
            );
            assert!(
                near(layer.passed, layer_transmissivity(k)),
                "K = {k}: {layer:?}"
            );
            let h = 1e-5 * k;
            let difference = if k < 1.0 {
                layer_absorptance(k - h) - layer_absorptance(k + h)
            } else {
                layer_transmissivity(k + h) - layer_transmissivity(k - h)
            };
            let slope = difference / (2.0 * h);
            assert!(
                (layer.slope - slope).abs() < 1e-6 * slope.abs(),
                "K = {k}: {layer:?}"
            );
        }
    }

    #[test]
    fn series_and_continued_fraction_meet() {
        let below = layer_transmissivity(SERIES_UP_TO);
        let above = 2.0 * third_exponential_integral(SERIES_UP_TO);
        assert!((below - above).abs() < 1e-14 * below);
    }

    #[test]
    fn a_plates_shares_add_up_to_one() {
        let face = Interface::of_index(1.45);
        for k in [0.0, 1e-12, 1e-6, 0.01, 0.3, 1.0, 2.5, 40.0, 900.0] {
            let plate = Plate::new(&face, k);
            let sum = plate.reflectance + plate.transmittance + plate.absorptance;
            assert!((sum - 1.0).abs() < 2e-15, "K = {k}: {sum}");
        }
    }
}
