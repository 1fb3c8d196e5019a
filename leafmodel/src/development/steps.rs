//! The loop: convergence points appear, veins canalise, veins and blade grow.

use super::check::of_wave;
use crate::not_grown::{NotGrown, not_grown};
use crate::random::{Use, uniform};

use super::initiation::{canal, place_in};
use super::margin::{Interval, Margin};
use super::plan::{DevelopmentPlan, Wave};
use super::skeleton::{NO_NODE, Rates, Skeleton, Vein};

/// Veins beside the midrib that a leaf may have.
pub(super) const MOST_VEINS: usize = 300;

/// Points that a margin may have.
pub(super) const MOST_POINTS: usize = 10_000;

/// Logarithm of the leaf's length that one step adds, at most.
const LONGEST_STEP: f64 = 0.025;

/// A leaf under way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Developing {
    seed: u64,
    irregularity: f64,
    pub(super) skeleton: Skeleton,
    pub(super) margin: Margin,
    /// Random numbers used.
    drawn: u64,
    /// Steps done.
    pub(super) step: u32,
}

impl Developing {
    pub(super) fn new(plan: &DevelopmentPlan, seed: u64) -> Self {
        let skeleton = Skeleton::new();
        let tip = skeleton.veins[0].tip;
        Self {
            seed,
            irregularity: plan.irregularity,
            margin: Margin::new(&plan.primordium, plan.resolution, tip),
            skeleton,
            drawn: 0,
            step: 0,
        }
    }

    /// Steps in all.
    pub(super) fn steps(plan: &DevelopmentPlan) -> u32 {
        libm::ceil(libm::log(plan.growth) / LONGEST_STEP) as u32
    }

    /// A number in [−1, 1] times the irregularity.
    fn chance(&mut self) -> f64 {
        let number = uniform(self.seed, Use::Development, self.drawn);
        self.drawn += 1;
        (2.0 * number - 1.0) * self.irregularity
    }

    /// One step.
    pub(super) fn advance(&mut self, plan: &DevelopmentPlan) -> Result<(), NotGrown> {
        let length = self.skeleton.length();
        for (number, wave) in plan.waves.iter().enumerate() {
            if (wave.from..=wave.until).contains(&length) {
                self.initiate(plan, number)?;
            }
        }
        let rates = Rates {
            basal_growth: plan.basal_growth,
        };
        let step = libm::log(plan.growth) / f64::from(Self::steps(plan));
        let deformations = self.skeleton.grow(rates, step);
        let length = self.skeleton.length();
        self.margin.carry(&self.skeleton, &deformations);
        let apex = self.margin.apex(self.skeleton.veins[0].tip);
        self.margin.clear_petiole(apex, length);
        self.margin.resample(self.longest_piece(plan));
        self.step += 1;
        if self.margin.points.len() > MOST_POINTS {
            let error = not_grown!(
                "the margin takes {} points, more than {MOST_POINTS}",
                self.margin.points.len()
            );
            let help = "use larger spacings, a lower resolution, or rates nearer to 1";
            return Err(error.mend("waves", help));
        }
        Ok(())
    }

    /// The longest piece of the margin: some for each distance between convergence points.
    fn longest_piece(&self, plan: &DevelopmentPlan) -> f64 {
        let length = self.skeleton.length();
        let fine = length / f64::from(plan.resolution);
        let of_wave = |wave: &Wave| {
            let last = wave.until.min(length);
            (length >= 0.9 * wave.from).then_some(wave.spacing / 14.0 * length / last)
        };
        plan.waves.iter().filter_map(of_wave).fold(fine, f64::min)
    }

    /// New convergence points where there is room.
    fn initiate(&mut self, plan: &DevelopmentPlan, number: usize) -> Result<(), NotGrown> {
        let wave = &plan.waves[number];
        let tip = self.skeleton.veins[0].tip;
        let mut skipped = 0;
        loop {
            // One at a time, for each changes the room that is left.
            let distances = self.margin.distances();
            let apex = self.margin.apex(tip);
            let spacing = wave.spacing * (1.0 + 0.35 * self.jitter());
            let mut places = self
                .margin
                .intervals(tip)
                .into_iter()
                .filter_map(|interval| {
                    let is_its = |end: usize| self.is_of_wave(end, number);
                    if !interval.continues(wave.sequence, is_its) {
                        return None;
                    }
                    let place = place_in(interval, &self.margin, &distances, apex, wave, spacing)?;
                    Some((interval, place))
                });
            let Some((interval, at)) = places.nth(skipped) else {
                return Ok(());
            };
            if self.skeleton.veins.len() > MOST_VEINS {
                let error = not_grown!(
                    "with a spacing of {} wave {number} brings more than {MOST_VEINS} convergence \
                     points",
                    wave.spacing
                );
                let help = "use a larger spacing, or end the wave earlier";
                return Err(of_wave(error, number, "spacing", help));
            }
            if !self.converge(plan, number, interval, &distances, at) {
                skipped += 1;
            }
        }
    }

    /// Whether a point of the margin is a convergence point of a wave.
    fn is_of_wave(&self, point: usize, wave: usize) -> bool {
        let tip = self.margin.points[point].tip;
        tip != NO_NODE && {
            let vein = self.skeleton.nodes[tip as usize].vein;
            self.skeleton.veins[vein as usize].wave == Some(wave)
        }
    }

    /// The random number of the next convergence point's distance, which stays until it is there.
    fn jitter(&self) -> f64 {
        let number = uniform(self.seed, Use::Development, self.drawn);
        (2.0 * number - 1.0) * self.irregularity
    }

    /// A convergence point and its vein; false if the vein finds no way.
    fn converge(
        &mut self,
        plan: &DevelopmentPlan,
        number: usize,
        interval: Interval,
        distances: &[f64],
        at: f64,
    ) -> bool {
        let wave = &plan.waves[number];
        let mut margin = self.margin.clone();
        let here = margin.split(distances, at, NO_NODE);
        let point = margin.points[here].place;
        let bow = wave.bow * (1.0 + 0.5 * self.jitter());
        let Some(canal) = canal(&self.skeleton, &margin, point, (number, wave), bow) else {
            return false;
        };
        // The number that the distance came from.
        self.drawn += 1;
        let whole = distances[distances.len() - 1];
        let apex = self.margin.apex(self.skeleton.veins[0].tip);
        let height = if interval.is_right {
            at / distances[apex]
        } else {
            (whole - at) / (whole - distances[apex])
        };
        let [low, high] = wave.rates;
        // What chance adds to its final length.
        let rest = libm::log(plan.growth / self.skeleton.length());
        let by_chance = libm::log(1.0 + 0.1 * self.chance()) / rest.max(LONGEST_STEP);
        let rate = low + (high - low) * height + by_chance;
        let angle = canal.angle * (1.0 + 0.5 * self.chance());
        let origin = self.skeleton.nodes[canal.origin as usize];
        let vein = Vein {
            // Those from the base are primaries like the midrib.
            order: if canal.origin == 0 {
                1
            } else {
                self.skeleton.veins[origin.vein as usize]
                    .order
                    .saturating_add(1)
            },
            wave: Some(number),
            origin: canal.origin,
            tip: NO_NODE,
            rate,
            turn: -canal.side * wave.splay * angle,
            born: self.step,
        };
        let tip = self.skeleton.add(vein, &canal.way);
        margin.points[here].tip = tip;
        self.margin = margin;
        let hold = [self.chance(), self.chance()]
            .map(|chance| (wave.hold * (1.0 + 0.25 * chance)).clamp(0.0, 1.0));
        let midrib = self.skeleton.veins[0].tip;
        let beside = self.margin.intervals(midrib);
        let beside = beside.into_iter().filter(|part| part.ends.contains(&here));
        for (part, hold) in beside.zip(hold) {
            self.margin.restrain(part, midrib, wave, hold);
        }
        true
    }
}
