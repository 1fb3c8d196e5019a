//! What becomes of dead tissue: leaves and patches turn unlike browns, rain leaches and sun bleaches
//! them, fungi leave spots.
//!
//! All amounts are estimates by eye; `docs/src/theory/ageing.md` says what they rest on.

use glam::DVec2;

use super::mottle::Mottle;
use crate::document::Declared;
use crate::optics::{Constituent, Contents};
use crate::random::{self, Use};

/// How dead tissue differs from leaf to leaf and from place to place.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Weathering {
    /// Leaves hold up to e to the power of this more or less brown.
    ///
    /// How far leaves differ: the brown of a leaf is multiplied by `e^x`, with an even `x` within ±
    /// this, drawn by the seed.
    #[key("leaves", 0.0..=3.0)]
    pub leaves: f64,
    /// The same for patches within a leaf.
    #[key("patches", 0.0..=3.0)]
    pub patches: f64,
    /// Size of patches.
    ///
    /// Size of those patches and of bleached ones
    #[key("patch_scale_mm", 0.01..=1e3)]
    pub patch_scale_mm: f64,
    /// About the share of dead tissue that rain and sun have bleached.
    #[key("bleached", 0.0..=1.0)]
    pub bleached: f64,
    /// Dark spots of fungi.
    #[key("spots_per_cm2", 0.0..=1e3)]
    pub spots_per_cm2: f64,
    /// Their mean radius.
    #[key("spot_radius_mm", 0.01..=100.0)]
    pub spot_radius_mm: f64,
}

/// What is left of brown pigments in bleached tissue: about what brings oak litter to the grey of
/// the second year.
const BLEACHED: f64 = 0.3;
/// Factor on the brown pigments of a spot.
const SPOT: f64 = 2.6;
/// Width of a bleached patch's edge in the noise's own unit.
const EDGE: f64 = 0.5;

impl Weathering {
    /// Numbers for litter on the ground.
    pub const LITTER: Self = Self {
        leaves: 0.35,
        patches: 0.45,
        patch_scale_mm: 9.0,
        bleached: 0.15,
        spots_per_cm2: 1.0,
        spot_radius_mm: 0.5,
    };
}

/// The weathering of one leaf.
#[derive(Clone, Debug)]
pub(super) struct Weathered {
    of: Weathering,
    seed: u64,
    /// Factor on the brown of the whole leaf.
    whole: f64,
    /// Noise above this is bleached.
    threshold: f64,
    patches: Mottle,
    bleached: Mottle,
    /// Outline of spots.
    ragged: Mottle,
    /// Side of the squares that hold one spot each, mm.
    square: f64,
}

impl Weathered {
    pub(super) fn new(of: Weathering, seed: u64) -> Self {
        let seed = random::bits(seed, Use::Weathering, 0);
        let even = |number| 2.0 * random::uniform(seed, Use::Weathering, number) - 1.0;
        let noise =
            |number, scale_mm| Mottle::new(random::bits(seed, Use::Weathering, number), scale_mm);
        let bleached = (of.bleached * libm::exp2(even(2))).min(1.0);
        Self {
            of,
            seed,
            whole: libm::exp(of.leaves * even(1)),
            threshold: 1.0 - 2.0 * bleached,
            patches: noise(3, of.patch_scale_mm),
            bleached: noise(4, 1.7 * of.patch_scale_mm),
            ragged: noise(5, 0.8 * of.spot_radius_mm),
            square: 10.0 / of.spots_per_cm2.max(1e-9).sqrt(),
        }
    }

    /// Contents of dead tissue at a point (mm), where `dead` are those of litter.
    pub(super) fn contents(&self, mut dead: Contents, p: DVec2) -> Contents {
        let patch = libm::exp(self.of.patches * self.patches.at(p));
        let bleached = if self.of.bleached > 0.0 {
            let t = ((self.bleached.at(p) - self.threshold) / EDGE + 0.5).clamp(0.0, 1.0);
            1.0 + (BLEACHED - 1.0) * t * t * (3.0 - 2.0 * t)
        } else {
            1.0
        };
        let spot = 1.0 + (SPOT - 1.0) * self.spot(p);
        dead[Constituent::Carotenoids] *= bleached;
        dead[Constituent::Brown] *= self.whole * patch * bleached * spot;
        dead
    }

    /// 1 within a spot, 0 outside.
    fn spot(&self, p: DVec2) -> f64 {
        if self.of.spots_per_cm2 == 0.0 {
            return 0.0;
        }
        let corner = (p / self.square).floor();
        let mut most: f64 = 0.0;
        for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
            let cell = corner + DVec2::new(f64::from(i), f64::from(j));
            // Columns and rows below zero wrap, which serves as well.
            let number =
                (((cell.x as i64 as u64) << 32) ^ (cell.y as i64 as u64 & 0xffff_ffff)) << 2;
            let draw = |k| random::uniform(self.seed, Use::WeatheringSpot, number | k);
            let middle = (cell + DVec2::new(draw(0), draw(1))) * self.square;
            // Most spots are small: radii from 0.3 to 3 times the mean, few large.
            let radius = self.of.spot_radius_mm * 0.3 * libm::exp(2.3 * draw(2) * draw(2));
            let ragged = 1.0 + 0.35 * self.ragged.at(p);
            let t = 2.0 * (1.0 - p.distance(middle) / (radius * ragged));
            most = most.max(t.clamp(0.0, 1.0));
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::ageing_courses::LITTER;

    fn browns(weathering: Weathering, seed: u64) -> Vec<f64> {
        let leaf = Weathered::new(weathering, seed);
        (0..60)
            .flat_map(|i| (0..60).map(move |j| DVec2::new(f64::from(i), f64::from(j)) * 0.9))
            .map(|p| leaf.contents(LITTER, p)[Constituent::Brown])
            .collect()
    }

    fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / values.len() as f64
    }

    const NOTHING: Weathering = Weathering {
        leaves: 0.0,
        patches: 0.0,
        bleached: 0.0,
        spots_per_cm2: 0.0,
        ..Weathering::LITTER
    };

    #[test]
    fn without_any_of_it_all_dead_tissue_is_alike() {
        let brown = LITTER[Constituent::Brown];
        assert!(browns(NOTHING, 3).iter().all(|&value| value == brown));
    }

    #[test]
    fn leaves_differ_by_their_seed_and_within_bounds() {
        let own = Weathering {
            leaves: 0.5,
            ..NOTHING
        };
        let brown = LITTER[Constituent::Brown];
        let of: Vec<f64> = (0..40).map(|seed| browns(own, seed)[0] / brown).collect();
        let bound = libm::exp(0.5);
        assert!(
            of.iter()
                .all(|&factor| factor >= 1.0 / bound && factor <= bound)
        );
        let (low, high) = of
            .iter()
            .fold((9.0_f64, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
        assert!(high / low > 2.0, "{low} to {high}");
    }

    #[test]
    fn patches_bleaching_and_spots_each_change_brown_their_way() {
        let brown = LITTER[Constituent::Brown];
        let patchy = browns(
            Weathering {
                patches: 0.4,
                ..NOTHING
            },
            5,
        );
        assert!(
            patchy.iter().any(|&b| b > 1.15 * brown) && patchy.iter().any(|&b| b < 0.85 * brown)
        );
        let pale = browns(
            Weathering {
                bleached: 0.4,
                ..NOTHING
            },
            5,
        );
        assert!(pale.iter().all(|&b| b <= brown) && mean(&pale) < 0.9 * brown);
        let spotted = browns(
            Weathering {
                spots_per_cm2: 4.0,
                spot_radius_mm: 0.8,
                ..NOTHING
            },
            5,
        );
        let dark = spotted.iter().filter(|&&b| b > 1.5 * brown).count();
        assert!(spotted.iter().all(|&b| b >= brown));
        assert!((20..1500).contains(&dark), "{dark} of 3600");
    }

    #[test]
    fn numbers_out_of_range_are_refused_by_name() {
        let field = |bad: Weathering| bad.in_range().expect_err("out of range").path;
        assert_eq!(Weathering::LITTER.in_range(), Ok(()));
        assert_eq!(
            field(Weathering {
                leaves: f64::NAN,
                ..NOTHING
            }),
            "leaves"
        );
        assert_eq!(
            field(Weathering {
                bleached: 1.1,
                ..NOTHING
            }),
            "bleached"
        );
    }
}
