//! Fresnel's transmittance averaged over directions: what one face of a plate lets through.

/// A face between air and leaf tissue at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// `n`, refractive index of the tissue over that of air, > 1.
    pub refractive_index: f64,
    /// `t_av(40°, n)`, share of light that enters when directions fill a cone of half-angle 40°.
    pub t_av_40: f64,
    /// `t_av(90°, n)`, share that enters when directions fill the hemisphere.
    pub t_av_90: f64,
}

impl Interface {
    /// The face of a tissue of index `n`, 1.05 to 3 (the closed form loses digits towards 1).
    pub fn of_index(refractive_index: f64) -> Self {
        let within_40_deg = libm::sin(40.0_f64.to_radians());
        Self {
            refractive_index,
            t_av_40: average_transmittance(within_40_deg * within_40_deg, refractive_index),
            t_av_90: average_transmittance(1.0, refractive_index),
        }
    }

    /// `t₂₁ = t_av(90°, n) / n²`: share of diffuse light inside that gets out (radiance is squeezed
    /// by n² on entering, and what comes back past the critical angle is reflected totally).
    pub fn transmissivity_from_inside(&self) -> f64 {
        self.t_av_90 / (self.refractive_index * self.refractive_index)
    }
}

/// Unpolarised Fresnel transmittance into a medium of index `n`, averaged over directions up to
/// the angle `θ` whose `sin²θ` is given, with weight `sin 2θ`. In (0, 1).
///
/// # Source
///
/// Closed form by Stern (1964), Applied Optics 3:111, in the arrangement of Allen (1973), Applied
/// Optics 12:664; \[jacquemoud1990\] uses it. Tests compare it with quadrature of Fresnel's
/// formulae.
fn average_transmittance(sin_squared: f64, n: f64) -> f64 {
    let n2 = n * n;
    let plus = n2 + 1.0;
    let minus = n2 - 1.0;
    let minus2 = minus * minus;
    let a = (n + 1.0) * (n + 1.0) / 2.0;
    let k = -minus2 / 4.0;
    let from_middle = sin_squared - plus / 2.0;
    // At 90° the radicand is zero up to rounding, and may come out negative.
    let b = (from_middle * from_middle + k).max(0.0).sqrt() - from_middle;

    let perpendicular = {
        let primitive = |x: f64| k * k / (6.0 * x * x * x) + k / x - x / 2.0;
        primitive(b) - primitive(a)
    };
    let parallel = {
        let of_a = 2.0 * plus * a - minus2;
        let of_b = 2.0 * plus * b - minus2;
        let linear = -2.0 * n2 * (b - a) / (plus * plus);
        let logarithm = -2.0 * n2 * plus * libm::log(b / a) / minus2;
        let inverse = n2 * (1.0 / b - 1.0 / a) / 2.0;
        let plus3 = plus * plus * plus;
        let mixed_logarithm =
            16.0 * n2 * n2 * (n2 * n2 + 1.0) * libm::log(of_b / of_a) / (plus3 * minus2);
        let mixed_inverse = 16.0 * n2 * n2 * n2 * (1.0 / of_b - 1.0 / of_a) / plus3;
        linear + logarithm + inverse + mixed_logarithm + mixed_inverse
    };
    (perpendicular + parallel) / (2.0 * sin_squared)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unpolarised Fresnel transmittance at one angle, from the formulae themselves.
    fn fresnel(cos_i: f64, n: f64) -> f64 {
        let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (n * n)).sqrt();
        let s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
        let p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
        1.0 - f64::midpoint(s * s, p * p)
    }

    /// Composite Simpson in `c = cos θ` (weight `2c dc`), where the integrand is smooth.
    fn by_quadrature(sin_squared: f64, n: f64) -> f64 {
        let lowest = (1.0 - sin_squared).sqrt();
        let steps = 20_000;
        let h = (1.0 - lowest) / steps as f64;
        let integrand = |i: usize| {
            let c = lowest + h * i as f64;
            2.0 * c * fresnel(c, n)
        };
        let inner: f64 = (1..steps)
            .map(|i| integrand(i) * if i % 2 == 1 { 4.0 } else { 2.0 })
            .sum();
        (integrand(0) + inner + integrand(steps)) * h / 3.0 / sin_squared
    }

    #[test]
    fn the_closed_form_is_the_average_of_fresnels_transmittance() {
        let sin_40 = 40.0_f64.to_radians().sin();
        for n in [1.2, 1.3, 1.4, 1.45, 1.5115, 1.6, 2.0] {
            let face = Interface::of_index(n);
            let near = by_quadrature(sin_40 * sin_40, n);
            let all = by_quadrature(1.0, n);
            assert!((face.t_av_40 - near).abs() < 1e-12, "n = {n}: {near}");
            assert!((face.t_av_90 - all).abs() < 1e-12, "n = {n}: {all}");
        }
    }

    #[test]
    fn light_inside_finds_it_harder_to_leave_than_light_outside_to_enter() {
        let face = Interface::of_index(1.45);
        assert!(face.transmissivity_from_inside() < face.t_av_90 / 2.0);
        assert!(face.t_av_90 < face.t_av_40);
    }
}
