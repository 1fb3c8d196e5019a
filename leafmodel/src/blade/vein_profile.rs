//! The profile of a vein across its width, and how maps of coarse texels preserve it.

use super::tissue::Tissue;
use super::vein_body::VeinBody;
use crate::numeric::smooth_step;

/// Strength of a vein of radius `r` over that of a fully developed one: `min(1, r / r_full)^½`, in
/// [0, 1].
///
/// The exponent of one half is by eye; we know of no measurement. With 1 the finest net nearly
/// vanishes beside the secondaries; below 0.3 all orders look alike.
pub(super) fn strength(radius: f64, full_radius: f64) -> f64 {
    // A square root, unlike a power, is exact on every machine.
    (radius / full_radius).min(1.0).sqrt()
}

/// What the excess of a vein is measured by.
#[derive(Clone, Copy, Debug)]
pub(super) enum Surplus {
    /// The radius of a fully developed vein, mm.
    OverFull(f64),
    /// The thickness of the blade.
    OverBlade(VeinBody),
}

impl Surplus {
    pub(super) fn of(tissue: &Tissue) -> Self {
        let full = Self::OverFull(tissue.full_vein_radius_mm);
        tissue.vein_body.map_or(full, Self::OverBlade)
    }

    /// Radius, mm, from which veins have an excess.
    pub(super) fn least_radius(self) -> f64 {
        match self {
            Self::OverFull(radius) => radius,
            Self::OverBlade(body) => 0.5 * body.blade_mm,
        }
    }
}

/// Weight across a vein: 1 up to the radius `r`, then `1 − (3u² − 2u³)` with `u = (d − r) / s` down
/// to 0 at `r + s`; continuous with its first derivative.
///
/// With a texel width `h` it is the same profile averaged under a tent of half-width `h` (two
/// texels wide, as bilinear look-up will use the map). The total cover, `∫ w dd = 2r + s`, is then
/// preserved in a row of texels of any size, and a vein thinner than a texel appears wide and faint
/// instead of broken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile {
    /// Sheath width `s`, mm, > 0.
    pub(super) sheath: f64,
    /// Texel width `h`, mm, ≥ 0.
    pub(super) texel: f64,
}

impl Profile {
    /// Distance from a vein's axis beyond which its weight is 0.
    pub(super) fn reach(self, radius: f64) -> f64 {
        radius + self.sheath + self.texel
    }

    /// Weight at the distance `d` (≥ 0) from the axis of a vein of radius `r`, in [0, 1].
    pub(super) fn weight(self, d: f64, r: f64) -> f64 {
        let h = self.texel;
        if d + h <= r {
            return 1.0;
        }
        if d - h >= r + self.sheath {
            return 0.0;
        }
        // Here the tent hardly changes the profile, and second differences would lose precision.
        if h < 1e-3 * self.sheath {
            return self.sharp(d, r);
        }
        let second = |x: f64| self.second_integral(x.abs(), r);
        let mean = (second(d + h) - 2.0 * second(d) + second(d - h)) / (h * h);
        mean.clamp(0.0, 1.0)
    }

    /// Mean of the square of the weight, from the weight's own square up to the weight.
    pub(super) fn square(self, d: f64, r: f64) -> f64 {
        let h = self.texel;
        let weight = self.weight(d, r);
        if h < 1e-3 * self.sheath || weight == 0.0 || weight == 1.0 {
            return weight * weight;
        }
        let second = |x: f64| self.second_integral_of_square(x.abs(), r);
        let mean = (second(d + h) - 2.0 * second(d) + second(d - h)) / (h * h);
        mean.clamp(weight * weight, weight)
    }

    /// The profile itself, for `h = 0`.
    fn sharp(self, d: f64, r: f64) -> f64 {
        1.0 - smooth_step((d - r) / self.sheath)
    }

    /// `∫₀^d ∫₀^x w(y) dy dx`, even in `d`: its second difference over `h` is the average under the
    /// tent.
    fn second_integral(self, d: f64, r: f64) -> f64 {
        let s = self.sheath;
        if d <= r {
            return 0.5 * d * d;
        }
        let u = ((d - r) / s).min(1.0);
        let inside = 0.5 * r * r + r * s * u + s * s * u * u * (0.5 + u * u * (0.1 * u - 0.25));
        let beyond = (d - r - s).max(0.0);
        inside + (r + 0.5 * s) * beyond
    }

    /// As [`Profile::second_integral`] of the square of the weight.
    fn second_integral_of_square(self, d: f64, r: f64) -> f64 {
        let s = self.sheath;
        if d <= r {
            return 0.5 * d * d;
        }
        let u = ((d - r) / s).min(1.0);
        let fall = 0.5 + u * u * (-0.5 + u * (0.2 + u * (0.3 + u * (u / 14.0 - 2.0 / 7.0))));
        let inside = 0.5 * r * r + r * s * u + s * s * u * u * fall;
        let beyond = (d - r - s).max(0.0);
        inside + (r + 13.0 / 35.0 * s) * beyond
    }

    /// Excess of a vein of radius `r` over a fully developed one at the distance `d` from its axis:
    /// `r / r_full − 1` on the axis, falling as `(1 − (d/r)²)²` to 0 at the vein's edge; 0 for
    /// veins up to `r_full`. Over a blade it is [`VeinBody::layers`].
    ///
    /// A vein narrower than the texels is widened to 1.5 texels and lowered in proportion.
    pub(super) fn excess(self, d: f64, r: f64, surplus: Surplus) -> f64 {
        if r <= surplus.least_radius() {
            return 0.0;
        }
        let shown = r.max(1.5 * self.texel);
        if d >= shown {
            return 0.0;
        }
        let q = d / shown;
        match surplus {
            Surplus::OverFull(full) => {
                let dome = (1.0 - q * q) * (1.0 - q * q);
                (r / full - 1.0) * (r / shown) * dome
            }
            Surplus::OverBlade(body) => body.layers(q * r, r) * (r / shown),
        }
    }

    /// Distance from the axis beyond which the excess is 0.
    pub(super) fn excess_reach(self, radius: f64) -> f64 {
        radius.max(1.5 * self.texel)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    #[test]
    fn a_vein_is_full_inside_its_radius_and_gone_beyond_its_sheath() {
        let profile = Profile {
            sheath: 0.1,
            texel: 0.0,
        };
        assert_eq!(profile.weight(0.0, 0.05), 1.0);
        assert_eq!(profile.weight(0.05, 0.05), 1.0);
        assert!((profile.weight(0.1, 0.05) - 0.5).abs() < 1e-12);
        assert_eq!(profile.weight(0.15, 0.05), 0.0);
        assert_eq!(strength(0.25, 0.25), 1.0);
        assert_eq!(strength(3.0, 0.25), 1.0);
        let power = libm::pow(0.1 / 0.25, 0.5);
        assert!((strength(0.1, 0.25) - power).abs() < 1e-15);
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn texels_of_any_size_keep_what_a_vein_covers(
            radius in 0.001..0.5, sheath in 0.01..0.3, texel in 0.002..3.0, phase in 0.0..1.0_f64,
        ) {
            let profile = Profile { sheath, texel };
            let count = (profile.reach(radius) / texel).ceil() as i32 + 1;
            let at = |i: i32| ((f64::from(i) + phase) * texel).abs();
            let sum: f64 = (-count..=count).map(|i| profile.weight(at(i), radius) * texel).sum();
            let covers = 2.0 * radius + sheath;
            prop_assert!((sum - covers).abs() < 1e-9 * covers.max(texel), "{sum} {covers}");
            let squares: f64 = (-count..=count).map(|i| profile.square(at(i), radius) * texel).sum();
            let covers = 2.0 * radius + 2.0 * 13.0 / 35.0 * sheath;
            prop_assert!((squares - covers).abs() < 1e-9 * covers.max(texel), "{squares} {covers}");
        }

        #[test]
        fn the_profile_falls_smoothly(
            radius in 0.001..0.5, sheath in 0.01..0.3, texel in 0.0..0.5, place in 0.0..1.0,
        ) {
            let profile = Profile { sheath, texel };
            let step = 1e-4 * (sheath + radius);
            let d = place * profile.reach(radius);
            let slope = |d: f64| (profile.weight(d + step, radius) - profile.weight(d, radius)) / step;
            prop_assert!(slope(d) <= 1e-6);
            // The slope is at most 1.5/s, its change at most 6/s² a unit length.
            prop_assert!((slope(d + step) - slope(d)).abs() <= 1.1 * 6.0 * step / (sheath * sheath) + 1e-4);
        }

        #[test]
        fn coarse_texels_keep_most_of_the_excess(
            radius in 0.26..0.6, texel in 0.05..3.0, phase in 0.0..1.0_f64,
        ) {
            let profile = Profile { sheath: 0.1, texel };
            let count = (profile.excess_reach(radius) / texel).ceil() as i32 + 1;
            let sum: f64 = (-count..=count)
                .map(|i| profile.excess(((f64::from(i) + phase) * texel).abs(), radius, Surplus::OverFull(0.25)) * texel)
                .sum();
            let whole = (radius / 0.25 - 1.0) * radius * 16.0 / 15.0;
            prop_assert!((sum / whole - 1.0).abs() < 0.05, "{sum} {whole}");
        }
    }
}
