//! N plates, N real: the leaf.

use super::constituent::Constituent;
use super::contents::Contents;
use super::interface::Interface;
use super::plate::{Layer, Plate};
use super::prospect_d::Coefficients;

/// Directional–hemispherical reflectance and transmittance at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReflectanceTransmittance {
    /// Share of light that comes back, in [0, 1].
    pub reflectance: f64,
    /// Share that goes through, in [0, 1 − reflectance].
    pub transmittance: f64,
}

impl Coefficients {
    /// `R` and `T` of a leaf with these contents, lit at near-normal incidence.
    pub fn reflectance_transmittance(&self, contents: &Contents) -> ReflectanceTransmittance {
        pile(
            &self.interface,
            self.absorption_per_plate(contents),
            contents[Constituent::Structure],
        )
    }
}

/// `R` and `T` of `plates` (real, ≥ 1) plates of absorption `k` (≥ 0) each.
///
/// The outermost plate is lit from a cone of 40°, the others by diffuse light:
/// `T = T₁ T_s / (1 − R_s r)`, `R = R₁ + T₁ R_s t / (1 − R_s r)`, where `R_s`, `T_s` belong to the
/// `N − 1` plates below.
///
/// # Source
///
/// \[jacquemoud1990\], after Stokes (1862) and Allen et al. (1969);
/// `docs/src/theory/leaf-optics.md`.
pub fn pile(interface: &Interface, k: f64, plates: f64) -> ReflectanceTransmittance {
    let plate = Plate::new(interface, k);
    let (r_below, t_below) = below(&plate, plates - 1.0);
    let entering = plate.lit_transmittance / (1.0 - r_below * plate.reflectance);
    let reflectance = plate.lit_reflectance + entering * r_below * plate.transmittance;
    ReflectanceTransmittance {
        reflectance,
        // Rounding alone could bring the sum above one in a leaf that absorbs nothing.
        transmittance: (entering * t_below).min(1.0 - reflectance),
    }
}

/// Reflectance and transmittance of `m` (real, ≥ 0) plates in diffuse light.
///
/// Stokes' solution in the form `R = sinh mβ / sinh(α + mβ)`, `T = sinh α / sinh(α + mβ)` with
/// `sinh α = Δ / 2r`, `sinh β = Δ / 2t` and `Δ² = (1+r+t)(1+r−t)(1−r+t)(1−r−t)`. The usual form has
/// `a = e^α`, `b = e^β` and divides differences of numbers near 1; this one is exact to rounding
/// down to no absorption at all, where it becomes `T = t / (t + m r)`, `R = 1 − T`.
fn below(plate: &Plate, m: f64) -> (f64, f64) {
    let (r, t) = (plate.reflectance, plate.transmittance);
    if m <= 0.0 {
        return (0.0, 1.0);
    }
    let squared = (1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * plate.absorptance;
    let delta = squared.sqrt();
    let alpha = libm::asinh(delta / (2.0 * r));
    let m_beta = m * libm::asinh(delta / (2.0 * t));
    // Hyperbolic sines over each other, written with falling exponentials so that nothing
    // overflows.
    let whole = libm::expm1(-2.0 * (alpha + m_beta));
    if whole == 0.0 {
        let lossless = t + m * r;
        return (m * r / lossless, t / lossless);
    }
    (
        libm::exp(-alpha) * libm::expm1(-2.0 * m_beta) / whole,
        libm::exp(-m_beta) * libm::expm1(-2.0 * alpha) / whole,
    )
}

/// `R` and `T` with their slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slopes {
    /// `[R, T]`.
    pub(super) values: [f64; 2],
    /// Their derivatives by the absorption of a plate.
    pub(super) by_absorption: [f64; 2],
    /// Their derivatives by the number of plates, with the absorption of each as it is.
    pub(super) by_plates: [f64; 2],
}

impl Slopes {
    /// Absorptions between which slopes are computed: Stokes' formulae divide by what is absorbed, and
    /// nothing changes any more where nothing passes.
    const ABSORPTIONS: [f64; 2] = [1e-8, 30.0];

    /// As [`pile`].
    pub(super) fn of(interface: &Interface, k: f64, plates: f64) -> Self {
        let [least, most] = Self::ABSORPTIONS;
        let Layer {
            absorbed,
            passed: tau,
            slope,
        } = Layer::of(k.clamp(least, most));
        let (t_lit, t_in) = (interface.t_av_40, interface.t_av_90);
        let t_out = interface.transmissivity_from_inside();
        let inside = 1.0 - t_out;
        // One plate, and its derivatives by τ.
        let bounced = inside * tau;
        let once = 1.0 / (1.0 - bounced * bounced);
        let passes = tau * t_out * once;
        let by_tau = t_out * (1.0 + bounced * bounced) * once * once;
        let [lit_t, t] = [t_lit, t_in].map(|face| face * passes);
        let [d_lit_t, dt] = [t_lit, t_in].map(|face| face * by_tau);
        let (lit_r, r) = (1.0 - t_lit + bounced * lit_t, 1.0 - t_in + bounced * t);
        let d_lit_r = inside * (lit_t + tau * d_lit_t);
        let dr = inside * (t + tau * dt);
        let lost = t_in * absorbed / (1.0 - bounced);
        let d_lost = -t_in * (1.0 - inside) / ((1.0 - bounced) * (1.0 - bounced));
        // The plates below, as in `below`, whose Δ² is `squared`.
        let m = plates - 1.0;
        let parts = [1.0 + r + t, 1.0 + r - t, 1.0 - r + t];
        let squared = parts[0] * parts[1] * parts[2] * lost;
        let delta = squared.sqrt();
        let d_log_delta = 0.5
            * ((dr + dt) / parts[0] + (dr - dt) / parts[1] + (dt - dr) / parts[2] + d_lost / lost);
        // sinh α or sinh β, the slope of α or β, and e^α or e^β.
        let angle = |share: f64, d_share: f64| {
            let x = delta / (2.0 * share);
            let root = (1.0 + x * x).sqrt();
            (x, x * (d_log_delta - d_share / share) / root, x + root)
        };
        let ((sinh_alpha, d_alpha, rise_alpha), (sinh_beta, d_beta, _)) =
            (angle(r, dr), angle(t, dt));
        let beta = libm::asinh(sinh_beta);
        // e^−2α − 1, e^−2mβ − 1 and e^−2(α+mβ) − 1.
        let fall_alpha = 1.0 / rise_alpha;
        let of_alpha = -2.0 * sinh_alpha * fall_alpha;
        let root = libm::expm1(-m * beta);
        let (fall_beta, of_beta) = (1.0 + root, root * (2.0 + root));
        let whole = of_alpha + of_beta + of_alpha * of_beta;
        let (r_below, t_below) = (fall_alpha * of_beta / whole, fall_beta * of_alpha / whole);
        // cosh(mβ), cosh α and cosh(α + mβ) over sinh(α + mβ).
        let cosh_beta = -fall_alpha * (2.0 + of_beta) / whole;
        let cosh_alpha = -fall_beta * (2.0 + of_alpha) / whole;
        let coth = -(2.0 + whole) / whole;
        let d_whole = d_alpha + m * d_beta;
        let below_by_tau = [
            cosh_beta * m * d_beta - r_below * coth * d_whole,
            cosh_alpha * d_alpha - t_below * coth * d_whole,
        ];
        let below_by_plates = [beta * (cosh_beta - r_below * coth), -beta * t_below * coth];
        // The first plate on the others.
        let open = 1.0 / (1.0 - r_below * r);
        let entering = lit_t * open;
        let on_top = |[d_r_below, d_t_below]: [f64; 2], [d_lit_r, d_lit_t, dr, dt]: [f64; 4]| {
            let d_entering = open * (d_lit_t + entering * (d_r_below * r + r_below * dr));
            [
                d_lit_r + d_entering * r_below * t + entering * (d_r_below * t + r_below * dt),
                d_entering * t_below + entering * d_t_below,
            ]
        };
        let by_tau = on_top(below_by_tau, [d_lit_r, d_lit_t, dr, dt]);
        let reflectance = lit_r + entering * r_below * t;
        let is_opaque = k > most;
        Self {
            values: [reflectance, (entering * t_below).min(1.0 - reflectance)],
            by_absorption: by_tau.map(|by_tau| if is_opaque { 0.0 } else { by_tau * slope }),
            by_plates: on_top(below_by_plates, [0.0; 4]),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::ProspectD;
    use properties::fixed;

    fn face() -> Interface {
        Interface::of_index(1.45)
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn without_absorption_all_light_comes_out(n in 1.0..8.0, index in 1.2..1.6) {
            let leaf = pile(&Interface::of_index(index), 0.0, n);
            prop_assert!((leaf.reflectance + leaf.transmittance - 1.0).abs() < 4e-15);
        }

        #[test]
        fn slopes_are_those_of_the_pile(n in 1.001..4.0, log_k in -5.0..1.3) {
            let k = 10f64.powf(log_k);
            let both = |k, n| {
                let leaf = pile(&face(), k, n);
                [leaf.reflectance, leaf.transmittance]
            };
            let slopes = Slopes::of(&face(), k, n);
            let (dk, dn) = (1e-4 * k, 1e-5);
            let by_k = [both(k - dk, n), both(k + dk, n)];
            let by_n = [both(k, n - dn), both(k, n + dn)];
            for i in 0..2 {
                prop_assert!((slopes.values[i] - both(k, n)[i]).abs() < 1e-12);
                for (slope, [low, high], step) in [
                    (slopes.by_absorption[i], by_k, dk),
                    (slopes.by_plates[i], by_n, dn),
                ] {
                    let by_steps = (high[i] - low[i]) / (2.0 * step);
                    let off = (slope - by_steps).abs();
                    prop_assert!(off < 1e-5 * (1.0 + by_steps.abs()), "{slope} {by_steps}");
                }
            }
        }

        #[test]
        fn no_light_is_made(n in 1.0..8.0, log_k in -20.0..3.0) {
            let leaf = pile(&face(), 10f64.powf(log_k), n);
            prop_assert!(leaf.reflectance >= 0.0 && leaf.transmittance >= 0.0);
            prop_assert!(leaf.reflectance + leaf.transmittance <= 1.0);
        }

        #[test]
        fn a_trace_of_absorption_changes_a_trace(n in 1.0..4.0, log_k in -18.0..-9.0) {
            // The derivative of R + T at zero is bounded by some path length, below 2·10 n here.
            let k = 10f64.powf(log_k);
            let leaf = pile(&face(), k, n);
            let absorbed = 1.0 - leaf.reflectance - leaf.transmittance;
            prop_assert!(absorbed <= 20.0 * n * k + 4e-15, "{absorbed} of K = {k}");
            let clear = pile(&face(), 0.0, n);
            prop_assert!((leaf.reflectance - clear.reflectance).abs() <= 20.0 * n * k + 4e-15);
        }

        #[test]
        fn more_of_any_constituent_never_brightens(
            constituent in prop::sample::select(&Constituent::ABSORBING[..]),
            share in 0.0..1.0,
            nm in 400.0..2500.0,
            n in 1.0..3.0,
        ) {
            let betalains = |each| [(Constituent::Betacyanins, each), (Constituent::Betaxanthins, each)];
            let most = Contents::prospect_d([0.0, 100.0, 25.0, 40.0, 2.0, 0.05, 0.03]);
            let most = most.with(&betalains(30.0));
            let leaf = Contents::prospect_d([n, 20.0, 4.0, 1.0, 0.1, 0.008, 0.004]);
            let mut leaf = leaf.with(&betalains(0.5));
            let at = ProspectD::coefficients(nm).expect("in range");
            leaf[constituent] = share * most[constituent];
            let less = at.reflectance_transmittance(&leaf);
            leaf[constituent] *= 1.1;
            let more = at.reflectance_transmittance(&leaf);
            prop_assert!(more.reflectance <= less.reflectance + 1e-15);
            prop_assert!(more.transmittance <= less.transmittance + 1e-15);
        }
    }

    #[test]
    fn two_plates_are_one_plate_on_another() {
        let plate = Plate::new(&face(), 0.3);
        let (r, t) = (plate.reflectance, plate.transmittance);
        let (r_two, t_two) = below(&plate, 2.0);
        assert!((r_two - (r + t * t * r / (1.0 - r * r))).abs() < 1e-15);
        assert!((t_two - t * t / (1.0 - r * r)).abs() < 1e-15);
    }

    #[test]
    fn one_plate_has_nothing_below() {
        let plate = Plate::new(&face(), 0.3);
        let leaf = pile(&face(), 0.3, 1.0);
        assert_eq!(leaf.reflectance, plate.lit_reflectance);
        assert_eq!(leaf.transmittance, plate.lit_transmittance);
    }

    #[test]
    fn extreme_absorption_leaves_the_first_reflection() {
        for k in [50.0, 700.0, 800.0, 1e12, 1e300] {
            let leaf = pile(&face(), k, 1.7);
            assert!((leaf.reflectance - (1.0 - face().t_av_40)).abs() < 1e-15);
            assert!((0.0..1e-20).contains(&leaf.transmittance), "K = {k}");
        }
    }
}
