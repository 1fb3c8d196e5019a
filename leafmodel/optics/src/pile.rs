//! N plates, N real: the leaf.

use super::constituent::Constituent;
use super::contents::Contents;
use super::interface::Interface;
use super::plate::Plate;
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
