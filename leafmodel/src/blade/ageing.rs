//! Ageing by the calendar: the day on which tissue at a place begins to age, and its contents on
//! each day after.
//!
//! A [`Delay`] gives the day on which a place begins to age; a [`Course`] gives its contents from
//! the number of days since. `docs/src/theory/ageing.md` has the equations and says of every number
//! whether it was measured or estimated.

use glam::DVec2;

use super::frame::UvFrame;
use super::weathering::Weathering;
use crate::document::Declared;
use crate::optics::{Constituent, Contents};
use crate::plane::distances::Distances;
use crate::venation::network::VeinSegment;

/// Chlorophyll, µg cm⁻², below which leaves make anthocyanin in autumn (\[lee2003\], abstract: nine
/// red-senescing species).
pub const ANTHOCYANIN_BELOW: f64 = 20.0;

/// Number of days by which something begins later at a place than at the first place: the sum of
/// all terms, each ≥ 0.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Delay {
    /// Highest order of veins that count.
    #[key("veins_order", 1..=20)]
    pub veins_order: u8,
    /// Days by which tissue at veins comes later.
    ///
    /// Delay of tissue at veins after tissue far from them; negative values mean before.
    #[key("veins_days", -1e3..=1e3)]
    pub veins_days: f64,
    /// Distance over which that falls to 1/e.
    #[key("veins_reach_mm", 0.01..=1e3)]
    pub veins_reach_mm: f64,
    /// Days by which the inside comes after the margin.
    #[key("margin_days", 0.0..=1e3)]
    pub margin_days: f64,
    /// Distance over which that rises to 1 − 1/e.
    #[key("margin_reach_mm", 0.01..=1e3)]
    pub margin_reach_mm: f64,
    /// The base comes later than the apex; negative: earlier.
    #[key("tip_days", -1e3..=1e3)]
    pub tip_days: f64,
    /// Days by which patches differ at most.
    #[key("noise_days", 0.0..=1e3)]
    pub noise_days: f64,
    /// Size of those patches.
    #[key("noise_scale_mm", 0.01..=1e3)]
    pub noise_scale_mm: f64,
    /// Cells of a transport leaf come in the order in which they would die for lack of revenue;
    /// needs one.
    #[key("deaths_days", 0.0..=1e3)]
    pub deaths_days: f64,
}

impl Delay {
    /// No delay: every place begins at once.
    pub const NONE: Self = Self {
        veins_days: 0.0,
        veins_reach_mm: 1.0,
        veins_order: 20,
        margin_days: 0.0,
        margin_reach_mm: 5.0,
        tip_days: 0.0,
        noise_days: 0.0,
        noise_scale_mm: 8.0,
        deaths_days: 0.0,
    };

    /// An upper bound of the delay at any place, days.
    pub fn most(&self) -> f64 {
        self.veins_days.abs()
            + self.margin_days
            + self.tip_days.abs()
            + self.noise_days
            + self.deaths_days
    }
}

/// How contents change with the days since tissue began to age.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Course {
    /// After which half of the chlorophyll is gone.
    #[key("half_days", 0.1..=1e3)]
    pub half_days: f64,
    /// How abruptly; small is nearly first-order decay.
    ///
    /// Steepness of that loss: the exponent of the logistic at `half_days`. Small values give
    /// nearly first-order decay.
    #[key("steepness", 0.1..=50.0)]
    pub steepness: f64,
    /// Chlorophyll that stays.
    #[key("chlorophyll_rest_ug_per_cm2", 0.0..=1e3)]
    pub chlorophyll_rest: f64,
    /// Share of carotenoids that goes with chlorophyll.
    #[key("labile_carotenoids", 0.0..=1.0)]
    pub labile_carotenoids: f64,
    /// How many times longer the others last.
    #[key("persistence", 1.0..=100.0)]
    pub persistence: f64,
    /// Made where less than 20 µg cm⁻² of chlorophyll is left.
    #[key("anthocyanins_ug_per_cm2", 0.0..=1e3)]
    pub anthocyanins: f64,
    /// In which all but 1/e of them is made.
    ///
    /// Time constant of the synthesis: after it all but 1/e is made. It starts once chlorophyll has
    /// fallen below [`ANTHOCYANIN_BELOW`].
    #[key("anthocyanin_days", 0.1..=1e3)]
    pub anthocyanin_days: f64,
    /// Brown pigments of tissue without chlorophyll that is still alive.
    #[key("brown", 0.0..=100.0)]
    pub brown: f64,
    /// What structure is multiplied by in the end.
    ///
    /// Factor on structure, on water, and on dry matter, where chlorophyll is gone.
    #[key("structure_factor", 1.0..=10.0)]
    pub structure_factor: f64,
    /// What water is multiplied by in the end.
    #[key("water_factor", 0.0..=1.0)]
    pub water_factor: f64,
    /// What dry matter is multiplied by in the end.
    #[key("dry_matter_factor", 0.0..=1.0)]
    pub dry_matter_factor: f64,
    /// When the first tissue dies.
    #[key("death_day", 0.0..=1e4)]
    pub death_day: f64,
    /// When tissue begins to age: days by which places differ.
    #[key("onset", block)]
    pub onset: Delay,
    /// When tissue dies: days by which places differ.
    #[key("death", block)]
    pub death: Delay,
    /// How dead tissue differs from leaf to leaf and from place to place; left out, it does not.
    #[key("weathering", block, default = Weathering::LITTER)]
    pub weathering: Option<Weathering>,
}

impl Course {
    /// Days after which chlorophyll has fallen from `start` to [`ANTHOCYANIN_BELOW`]; infinite if
    /// it never does.
    fn days_to_anthocyanin(&self, start: f64, decay: Decay) -> f64 {
        if start <= ANTHOCYANIN_BELOW {
            return 0.0;
        }
        if self.chlorophyll_rest >= ANTHOCYANIN_BELOW {
            return f64::INFINITY;
        }
        let share = (ANTHOCYANIN_BELOW - self.chlorophyll_rest) / (start - self.chlorophyll_rest);
        let odds = decay.scale / share - 1.0;
        self.half_days * (1.0 + libm::log(odds) / decay.steepness)
    }

    /// As [`Course::decayed`], with a decay of its own.
    #[cfg(test)]
    pub(crate) fn senescent(&self, living: Contents, age: f64) -> Contents {
        self.decayed(living, age, Decay::new(self.steepness))
    }

    /// Contents of tissue, still alive, `age` days after it began to age, with the decay of this course. For
    /// `age` ≤ 0 that is `living`.
    fn decayed(&self, living: Contents, age: f64, decay: Decay) -> Contents {
        if age <= 0.0 {
            return living;
        }
        let halves = age / self.half_days;
        let left = decay.left(halves);
        let green = living[Constituent::Chlorophyll];
        let rest = self.chlorophyll_rest.min(green);
        let chlorophyll = rest + (green - rest) * left;
        let persistent = decay.left(halves / self.persistence);
        let labile = self.labile_carotenoids;
        let mut aged = living;
        aged[Constituent::Chlorophyll] = chlorophyll;
        aged[Constituent::Carotenoids] *= labile * left + (1.0 - labile) * persistent;
        let anthocyanins = &mut aged[Constituent::Anthocyanins];
        if self.anthocyanins > *anthocyanins && chlorophyll < ANTHOCYANIN_BELOW {
            let since = age - self.days_to_anthocyanin(green, decay);
            if since > 0.0 {
                let made = 1.0 - libm::exp(-since / self.anthocyanin_days);
                *anthocyanins += (self.anthocyanins - *anthocyanins) * made;
            }
        }
        let brown = &mut aged[Constituent::Brown];
        *brown += (self.brown - *brown).max(0.0) * (1.0 - left);
        for (constituent, factor) in [
            (Constituent::Structure, self.structure_factor),
            (Constituent::Water, self.water_factor),
            (Constituent::DryMatter, self.dry_matter_factor),
            (Constituent::Proteins, self.dry_matter_factor),
            (Constituent::CarbonBased, self.dry_matter_factor),
        ] {
            aged[constituent] *= 1.0 + (factor - 1.0) * (1.0 - left);
        }
        aged
    }
}

/// A logistic that falls from 1, prepared for evaluation at many ages.
#[derive(Clone, Copy, Debug)]
struct Decay {
    steepness: f64,
    /// Factor that makes the curve 1 at the start.
    scale: f64,
}

impl Decay {
    fn new(steepness: f64) -> Self {
        Self {
            steepness,
            scale: 1.0 + libm::exp(-steepness),
        }
    }

    /// Share that is left after some multiple of the half time: 1 at 0, about ½ at 1, falling to 0.
    fn left(self, halves: f64) -> f64 {
        self.scale / (1.0 + libm::exp(self.steepness * (halves - 1.0)))
    }
}

/// The flat leaf on which ageing and masks are evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The box within which points may be queried.
    pub frame: &'a UvFrame,
    /// The margin, a closed polygon, mm.
    pub margin: &'a [DVec2],
    /// All veins.
    pub veins: &'a [VeinSegment],
    /// Where the midrib begins, mm.
    pub base: DVec2,
    /// Where the midrib ends, mm.
    pub apex: DVec2,
}

impl Place<'_> {
    /// Distances to the margin.
    pub(super) fn margin_distances(&self) -> Distances {
        Distances::around(self.margin)
    }

    /// Distances to the axes of veins of some orders.
    pub(super) fn vein_distances(&self, orders: [u8; 2]) -> Distances {
        let [first, last] = orders;
        let counts = self
            .veins
            .iter()
            .filter(|vein| (first..=last).contains(&vein.order));
        Distances::new(counts.map(|vein| [vein.from, vein.to]).collect())
    }

    /// 0 at the base to 1 at the apex.
    pub(super) fn along(&self) -> Along {
        let axis = self.apex - self.base;
        Along {
            base: self.base,
            axis: axis / axis.length_squared().max(f64::MIN_POSITIVE),
        }
    }
}

/// Where along the midrib a point lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along {
    base: DVec2,
    axis: DVec2,
}

impl Along {
    pub(super) fn at(self, p: DVec2) -> f64 {
        (p - self.base).dot(self.axis).clamp(0.0, 1.0)
    }
}

pub(super) mod leaf;

#[cfg(test)]
mod tests;
