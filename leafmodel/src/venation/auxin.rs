//! Placing of auxin sources by dart throwing (section 3.3).
//!
//! Diffuse growth throws darts at the whole lamina in every step until it ends, and a lamina that
//! does not grow gets darts in every step until there is no room left. Marginal growth brings new
//! tissue at the margin only: its darts are thrown beforehand at the full-grown leaf, and each
//! source appears when the margin passes over it.

use glam::DVec2;

use super::lamina::Lamina;
use super::lamina_clock::LaminaClock;
use super::plan::{AuxinPlan, FreeEndings, Growth};
use super::point_tree::PointTree;
use crate::random::{Use, uniform};

/// Number of darts per square of the birth distance beyond which further darts find almost no room.
const SATURATION: f64 = 20.0;

/// The supply of candidates for sources.
pub(crate) enum Darts {
    /// Thrown in each step.
    Thrown {
        /// Darts per unit area and step, `ρ`.
        per_area: f64,
        /// Expected number of darts so far; the actual number is this, rounded down.
        due: f64,
        /// Number of the next dart.
        next: u64,
        /// The last step in which darts are thrown; there are none after growth has ended.
        until: u32,
    },
    /// Thrown beforehand: (step of appearance, place), by step.
    Waiting(std::vec::IntoIter<(u32, DVec2)>),
}

impl Darts {
    /// The darts of a plan.
    pub(crate) fn new(plan: &AuxinPlan, lamina: &Lamina, clock: &LaminaClock, seed: u64) -> Self {
        let thrown = |until| Self::Thrown {
            per_area: plan.darts_per_area,
            due: 0.0,
            next: 0,
            until,
        };
        match plan.growth {
            Growth::None => thrown(u32::MAX),
            Growth::Isogonic { .. } | Growth::Anisotropic { .. } => {
                thrown(clock.last_growth_step())
            }
            Growth::Marginal { .. } => {
                let (low, high) = lamina.bounds_now();
                let count = waiting_darts(plan, lamina, clock.last_growth_step());
                let mut accepted = PointTree::new(low, high);
                let mut waiting = Vec::new();
                for number in 0..count as u64 {
                    let Some(dart) = dart([Use::DartX, Use::DartY], seed, number, lamina) else {
                        continue;
                    };
                    let spacing = plan.source_birth_distance * lamina.enlargement(dart);
                    if accepted.any_within(dart, spacing) {
                        continue;
                    }
                    accepted.insert(number as u32, dart);
                    if lamina.contains(dart) {
                        waiting.push((appearance(lamina.blade.points(), clock, dart), dart));
                    }
                }
                // The sort is stable, so darts that appear together keep their order.
                waiting.sort_by_key(|&(step, _)| step);
                Self::Waiting(waiting.into_iter())
            }
        }
    }

    /// Darts for free veinlet endings, all thrown at once.
    pub(crate) fn at_once(free: &FreeEndings, lamina: &Lamina, seed: u64) -> Self {
        let (low, high) = lamina.bounds_now();
        let size = high - low;
        let count = free.darts_per_area * size.x * size.y * lamina.surplus();
        let darts: Vec<(u32, DVec2)> = (0..count as u64)
            .filter_map(|number| dart([Use::FreeDartX, Use::FreeDartY], seed, number, lamina))
            .map(|dart| (0, dart))
            .collect();
        Self::Waiting(darts.into_iter())
    }

    /// Whether none are left.
    pub(crate) fn are_all_thrown(&self) -> bool {
        match self {
            Self::Thrown { .. } => false,
            Self::Waiting(waiting) => waiting.as_slice().is_empty(),
        }
    }

    /// Candidates of one step, to be called once for every step in turn. Candidates of diffuse
    /// growth have not been tested against each other and may lie outside the margin.
    pub(crate) fn of_step(
        &mut self,
        step: u32,
        unit: f64,
        seed: u64,
        lamina: &Lamina,
    ) -> Vec<DVec2> {
        match self {
            Self::Thrown {
                per_area,
                due,
                next,
                until,
            } => {
                if step > *until {
                    return Vec::new();
                }
                let (low, high) = lamina.bounds_now();
                let size = high - low;
                let before = *due;
                *due += *per_area * size.x * size.y * lamina.surplus() / (unit * unit);
                let count = due.floor() - before.floor();
                let first = *next;
                *next += count as u64;
                (first..*next)
                    .filter_map(|number| dart([Use::DartX, Use::DartY], seed, number, lamina))
                    .collect()
            }
            Self::Waiting(waiting) => {
                let ready = waiting.as_slice().partition_point(|&(at, _)| at <= step);
                waiting.take(ready).map(|(_, dart)| dart).collect()
            }
        }
    }
}

/// Number of darts for the whole of marginal growth. [`super::plan`] bounds it.
pub(crate) fn waiting_darts(plan: &AuxinPlan, lamina: &Lamina, steps: u32) -> f64 {
    let (low, high) = lamina.bounds_now();
    let size = high - low;
    let area = size.x * size.y * lamina.surplus();
    let wanted = plan.darts_per_area * area * (f64::from(steps) + 1.0);
    let spacing = plan.source_birth_distance;
    wanted.min(SATURATION * area / (spacing * spacing)).ceil()
}

/// Where dart `number` of a run lands: uniform over the rectangle around the lamina. On a curved
/// blade some darts are rejected (`None`), so that the others are uniform over the blade, not over
/// its map.
pub(crate) fn dart(uses: [Use; 2], seed: u64, number: u64, lamina: &Lamina) -> Option<DVec2> {
    let (low, high) = lamina.bounds_now();
    let u = DVec2::new(
        uniform(seed, uses[0], number),
        uniform(seed, uses[1], number),
    );
    let dart = low + u * (high - low);
    let enlargement = lamina.enlargement(dart);
    let share = 1.0 / (enlargement * enlargement * lamina.surplus());
    let kept = lamina.is_flat() || uniform(seed, Use::DartKept, number) < share;
    kept.then_some(dart)
}

/// The first step at which `p` is inside the margin, which grows by scaling about the origin.
///
/// Instead of scaling the margin, `p` is moved towards the base along its ray, from `p / σ_0` to
/// `p`. It is inside between the first and second crossing of the ray with the margin, counted from
/// outside, between the third and fourth, and so on.
pub(crate) fn appearance(margin: &[DVec2], clock: &LaminaClock, p: DVec2) -> u32 {
    let mut crossings: Vec<f64> = Vec::new();
    for (i, &a) in margin.iter().enumerate() {
        let b = margin[if i + 1 == margin.len() { 0 } else { i + 1 }];
        if (p.perp_dot(a) > 0.0) != (p.perp_dot(b) > 0.0) {
            crossings.push(a.perp_dot(b) / p.perp_dot(b - a));
        }
    }
    crossings.sort_by(|a, b| b.total_cmp(a));
    let last = clock.last_growth_step();
    for inside in crossings.chunks(2) {
        let step = first_step(last, |step| 1.0 / clock.size(step) < inside[0]);
        let end = inside.get(1).copied().unwrap_or(0.0);
        if step <= last && 1.0 / clock.size(step) > end {
            return step;
        }
    }
    last
}

/// The first step up to `last` for which `reached` is true, or `last + 1`. Once true, `reached`
/// must stay true.
fn first_step(last: u32, reached: impl Fn(u32) -> bool) -> u32 {
    let (mut low, mut high) = (0, last + 1);
    while low < high {
        let middle = low + (high - low) / 2;
        if reached(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::shape::outline::Outline;
    use crate::venation::plan::Growth;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(300))]

        #[test]
        fn a_source_appears_when_the_growing_margin_first_holds_it(
            radii in proptest::collection::vec(0.3..1.0, 5..14), x in -1.0..1.0, y in -1.0..1.0,
            initial in 5.0..40.0, length_step in 0.3..4.0,
        ) {
            // A lobed margin around a point beside the base, so that rays from the base cross it
            // several times.
            let n = radii.len();
            let corners = radii.iter().enumerate().map(|(i, r)| {
                let angle = std::f64::consts::TAU * i as f64 / n as f64;
                DVec2::new(20.0 + 50.0 * r * libm::cos(angle), 45.0 + 50.0 * r * libm::sin(angle))
            });
            let inside = DVec2::new(20.0, 45.0);
            let outline = Outline::new(corners.collect(), inside, inside + DVec2::Y);
            prop_assume!(outline.is_ok());
            let outline = outline.expect("just assumed");
            let plan = AuxinPlan {
                final_length: 100.0,
                growth: Growth::Marginal { initial_length: initial, length_step },
                ..AuxinPlan::default()
            };
            let clock = LaminaClock::new(&plan).expect("it grows");
            let p = inside + DVec2::new(x, y) * 50.0;
            prop_assume!(outline.contains(p));
            // For comparison, the margin of each step, scaled about the origin.
            let held = |step: &u32| outline.contains(p / clock.size(*step));
            let first = (0..=clock.last_growth_step()).find(held);
            prop_assert_eq!(Some(appearance(outline.points(), &clock, p)), first);
        }
    }
}
