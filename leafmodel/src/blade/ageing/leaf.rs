//! Ageing, prepared for the millions of points of a map: each distance is looked up once, and terms
//! of a delay are added only until the result is decided.

use glam::DVec2;

use super::super::mottle::Mottle;
use super::super::weathering::Weathered;
use super::{Along, Course, Decay, Delay, Place};
use crate::numeric::smooth_step;
use crate::optics::{Constituent, Contents};
use crate::plane::distances::Distances;
use crate::random::{self, Use};
use crate::transport::DeathField;

/// The fields of distances that two delays need, each stored once.
#[derive(Clone, Debug)]
struct Surroundings {
    margin: Option<Distances>,
    /// Distances to veins up to the order that each delay names; `None` for the second if its order
    /// is that of the first.
    veins: [Option<Distances>; 2],
}

impl Surroundings {
    fn new(delays: [&Delay; 2], place: &Place<'_>) -> Self {
        let veins = |delay: &Delay| {
            (delay.veins_days != 0.0).then(|| place.vein_distances([1, delay.veins_order]))
        };
        let [first, second] = delays;
        let shared = first.veins_days != 0.0 && first.veins_order == second.veins_order;
        Self {
            margin: delays
                .iter()
                .any(|delay| delay.margin_days > 0.0)
                .then(|| place.margin_distances()),
            veins: [veins(first), if shared { None } else { veins(second) }],
        }
    }
}

/// The distances of one point, each looked up when first needed.
struct Near<'a> {
    of: &'a Surroundings,
    p: DVec2,
    margin: Option<f64>,
    veins: [Option<f64>; 2],
}

impl Near<'_> {
    fn margin(&mut self) -> f64 {
        let field = self.of.margin.as_ref();
        let at = || field.map_or(f64::INFINITY, |field| field.at(self.p));
        *self.margin.get_or_insert_with(at)
    }

    /// To the veins of the first delay or the second.
    fn veins(&mut self, which: usize) -> f64 {
        let which = if self.of.veins[which].is_some() {
            which
        } else {
            0
        };
        let field = self.of.veins[which].as_ref();
        let at = || field.map_or(f64::INFINITY, |field| field.at(self.p));
        *self.veins[which].get_or_insert_with(at)
    }
}

/// A [`Delay`] prepared for many points of one leaf.
#[derive(Clone, Debug)]
struct DelayField {
    delay: Delay,
    /// 0 for the onset, 1 for death.
    number: usize,
    along: Along,
    noise: Option<Mottle>,
    deaths: Option<DeathField>,
}

impl DelayField {
    fn new(
        delay: Delay,
        place: &Place<'_>,
        deaths: Option<&DeathField>,
        seed: u64,
        number: usize,
    ) -> Self {
        let noise_seed = random::bits(seed, Use::Ageing, number as u64);
        Self {
            delay,
            number,
            along: place.along(),
            noise: (delay.noise_days > 0.0).then(|| Mottle::new(noise_seed, delay.noise_scale_mm)),
            deaths: deaths.filter(|_| delay.deaths_days > 0.0).cloned(),
        }
    }

    /// Days, ≥ 0. If the delay is at least `enough`, any number of at least `enough` may be
    /// returned; all terms are ≥ 0.
    fn at(&self, near: &mut Near<'_>, enough: f64) -> f64 {
        let delay = &self.delay;
        let mut days = 0.0;
        if delay.tip_days != 0.0 {
            let along = self.along.at(near.p);
            days += if delay.tip_days > 0.0 {
                delay.tip_days * (1.0 - along)
            } else {
                -delay.tip_days * along
            };
        }
        if delay.margin_days > 0.0 {
            let inside = 1.0 - libm::exp(-near.margin() / delay.margin_reach_mm);
            days += delay.margin_days * inside;
        }
        if days >= enough {
            return days;
        }
        if delay.veins_days != 0.0 {
            let close = libm::exp(-near.veins(self.number) / delay.veins_reach_mm);
            days += if delay.veins_days > 0.0 {
                delay.veins_days * close
            } else {
                -delay.veins_days * (1.0 - close)
            };
        }
        if days >= enough {
            return days;
        }
        if let Some(noise) = self.noise {
            days += delay.noise_days * 0.5 * (1.0 + noise.at(near.p));
        }
        if let Some(deaths) = &self.deaths {
            days += delay.deaths_days * (1.0 - deaths.at(near.p));
        }
        days
    }
}

/// A leaf on a day of its course.
#[derive(Clone, Debug)]
pub(in super::super) struct AgeingLeaf {
    course: Course,
    decay: Decay,
    day: f64,
    /// Days from living to dead.
    blend: f64,
    dead: Contents,
    surroundings: Surroundings,
    onset: DelayField,
    death: DelayField,
    weathered: Option<Weathered>,
}

impl AgeingLeaf {
    pub(in super::super) fn new(
        course: &Course,
        day: f64,
        (blend, dead): (f64, Contents),
        place: &Place<'_>,
        deaths: Option<&DeathField>,
        seed: u64,
    ) -> Self {
        Self {
            course: *course,
            decay: Decay::new(course.steepness),
            day,
            blend,
            dead,
            surroundings: Surroundings::new([&course.onset, &course.death], place),
            onset: DelayField::new(course.onset, place, deaths, seed, 0),
            death: DelayField::new(course.death, place, deaths, seed, 1),
            weathered: course.weathering.map(|of| Weathered::new(of, seed)),
        }
    }

    fn near(&self, p: DVec2) -> Near<'_> {
        Near {
            of: &self.surroundings,
            p,
            margin: None,
            veins: [None; 2],
        }
    }

    pub(in super::super) fn dead_share(&self, p: DVec2) -> f64 {
        self.dead_share_at(&mut self.near(p))
    }

    fn dead_share_at(&self, near: &mut Near<'_>) -> f64 {
        let days = self.day - self.course.death_day;
        if days <= 0.0 {
            return 0.0;
        }
        smooth_step((days - self.death.at(near, days)) / self.blend)
    }

    pub(in super::super) fn contents(&self, living: Contents, p: DVec2) -> Contents {
        if self.day <= 0.0 {
            return living;
        }
        let near = &mut self.near(p);
        let age = self.day - self.onset.at(near, self.day);
        let aged = self.course.decayed(living, age, self.decay);
        let share = self.dead_share_at(near);
        if share <= 0.0 {
            return aged;
        }
        // Dead tissue holds no more chlorophyll and carotenoids than it had alive, and no less
        // brown.
        let weathered = self.weathered.as_ref();
        let mut dead =
            weathered.map_or(self.dead, |weathered| weathered.contents(self.dead, near.p));
        for pigment in [Constituent::Chlorophyll, Constituent::Carotenoids] {
            dead[pigment] = dead[pigment].min(aged[pigment]);
        }
        dead[Constituent::Brown] = dead[Constituent::Brown].max(aged[Constituent::Brown]);
        aged.towards(dead, share)
    }
}
