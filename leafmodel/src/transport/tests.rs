//! The paper's propositions, tested on grown leaves.

mod extremes;

use std::f64::consts::PI;

use proptest::prelude::*;

use super::cells::{Cell, NONE};
use super::cost::TransportSystem;
use super::growth::Growth;
use super::leaf::unfolded;
use super::*;
use properties::fixed;

impl TransportLeaf {
    /// The leaf without the cells that are dead at this share of its revenue; `deaths` is from
    /// [`TransportLeaf::deaths`].
    fn without_dead(&self, deaths: &[f64], share: f64) -> Self {
        let mut numbers = vec![NONE; self.cells().len()];
        let alive = (0..self.cells().len()).filter(|&v| v == 0 || deaths[v] < share);
        let kept: Vec<usize> = alive.collect();
        for (number, &v) in (0..).zip(&kept) {
            numbers[v] = number;
        }
        self.part(&kept, |v| self.parent(v).map_or(NONE, |p| numbers[p]))
    }
}

/// Sums of a few thousand products, each rounded.
const ROUNDING: f64 = 1e-10;

prop_compose! {
    /// Leaves of some dozens to some hundreds of cells.
    fn plans()(
        alpha in 0.52..0.9_f64,
        beta in 0.05..2.0_f64,
        size in 1.5..4.5_f64,
        steps in 1_u32..30,
        mirrored in any::<bool>(),
        noisy in any::<bool>(),
    ) -> TransportPlan {
        TransportPlan {
            alpha,
            beta,
            epsilon: size,
            ladder: if steps > 25 { Ladder::Events } else { Ladder::Equal(steps) },
            mirrored,
            noise: if noisy { 0.3 } else { 0.0 },
            ..TransportPlan::default()
        }
    }
}

/// `C_α` of Proposition 3.1.
fn c_alpha(alpha: f64) -> f64 {
    alpha * (1.0 + alpha) / (2.0 * libm::pow(4.0 * PI, 1.0 - alpha))
}

/// `R_ε` of section 3.2.
fn greatest_radius(plan: &TransportPlan) -> f64 {
    // The greatest revenue of a cell under uneven light.
    let epsilon = plan.epsilon * (1.0 + plan.noise);
    libm::pow(
        epsilon / c_alpha(plan.alpha),
        1.0 / (2.0 * plan.alpha - 1.0),
    )
}

/// Calls `look` for each application of `L` with the leaf before, `ε`, and the leaf after.
fn each_application(plan: &TransportPlan, mut look: impl FnMut(&Growth, f64, &Growth)) {
    let mut growth = plan.seedling(7);
    let steps = 6;
    for step in 1..=steps {
        let epsilon = 1.0 + (plan.epsilon - 1.0) * f64::from(step) / f64::from(steps);
        loop {
            let before = growth.clone();
            let came = growth.apply(epsilon).expect("below the limit");
            look(&before, epsilon, &growth);
            if came == 0 {
                break;
            }
        }
    }
}

proptest! {
    #![proptest_config(fixed(24))]

    #[test]
    fn proposition_3_1_expense_is_bounded_from_below(plan in plans()) {
        let (a, factor) = (plan.alpha, plan.alpha * (1.0 + plan.alpha) / 2.0);
        each_application(&plan, |before, _, after| {
            let farthest = before.tree.cells.iter().map(|c| c.length()).fold(0.0, f64::max);
            if after.cells() == before.cells() {
                return;
            }
            for offer in &after.offers {
                let distance = offer.cell.length();
                let least = factor * distance / libm::pow(before.cells() as f64, 1.0 - a);
                assert!(offer.expense >= least, "{offer:?} costs less than {least}");
                if distance > farthest {
                    let least = c_alpha(a) * libm::pow(distance, 2.0 * a - 1.0);
                    assert!(offer.expense >= least, "{offer:?} costs less than {least}");
                }
            }
        });
    }

    #[test]
    fn proposition_3_2_cost_rises_by_at_most_what_new_cells_earn(plan in plans()) {
        each_application(&plan, |before, epsilon, after| {
            let came = (after.cells() - before.cells()) as f64;
            let most = before.tree.cost() + epsilon * (1.0 + plan.noise) * came;
            assert!(after.tree.cost() <= most * (1.0 + ROUNDING));
        });
    }

    #[test]
    fn proposition_3_4_and_lemma_3_8_a_leaf_costs_at_most_what_it_earns(plan in plans()) {
        let leaf = plan.grow(3).expect("a good plan");
        let mut before = (0, 0.0);
        for stage in leaf.stages() {
            let earned = stage.epsilon * (1.0 + plan.noise);
            let came = (stage.cells() - before.0) as f64;
            prop_assert!(stage.cost <= (before.1 + earned * came) * (1.0 + ROUNDING));
            prop_assert!(stage.cost <= earned * stage.cells() as f64 * (1.0 + ROUNDING));
            before = (stage.cells(), stage.cost);
        }
    }

    #[test]
    fn proposition_3_2_leaves_stay_in_their_ball_and_lemma_3_10_bounds_their_measures(plan in plans()) {
        let leaf = plan.grow(5).expect("a good plan");
        let radius = greatest_radius(&plan);
        prop_assert!(leaf.cells().iter().all(|cell| cell.length() <= radius));
        let mass = leaf.cells().len() as f64;
        prop_assert!(mass <= PI * (radius + 1.0) * (radius + 1.0));
        let variation: f64 = (1..leaf.cells().len())
            .map(|v| {
                let p = leaf.parent(v).expect("only the root has none");
                f64::from(leaf.counts()[v]) * (leaf.cells()[v] - leaf.cells()[p]).length()
            })
            .sum();
        let a = plan.alpha;
        let epsilon = plan.epsilon * (1.0 + plan.noise);
        let most = epsilon * libm::pow(PI, 2.0 - a) * libm::pow(radius + 1.0, 4.0 - 2.0 * a);
        prop_assert!(variation <= most);
    }

    #[test]
    fn lemma_3_9_cells_hang_together_by_edges_and_corners(plan in plans()) {
        let leaf = plan.grow(8).expect("a good plan");
        let mut reached = vec![false; leaf.cells().len()];
        reached[0] = true;
        let mut open = vec![Cell::ROOT];
        while let Some(cell) = open.pop() {
            for (v, &other) in leaf.cells().iter().enumerate() {
                if !reached[v] && (other - cell).squared() <= 2 {
                    reached[v] = true;
                    open.push(other);
                }
            }
        }
        prop_assert!(reached.into_iter().all(|reached| reached));
    }

    #[test]
    fn corollary_3_12_a_leaf_of_larger_cells_and_larger_revenue_is_the_same_leaf(
        plan in plans(),
        enlargement in 0.01..50.0_f64,
    ) {
        let leaf = plan.grow(1).expect("a good plan");
        let larger = TransportPlan {
            cell: enlargement,
            epsilon: plan.epsilon * libm::pow(enlargement, 2.0 * plan.alpha - 1.0),
            ..plan
        };
        let image = larger.grow(1).expect("a good plan");
        prop_assert_eq!(leaf.cells(), image.cells());
        prop_assert_eq!(leaf.counts(), image.counts());
        let cost = leaf.cost() * libm::pow(enlargement, 2.0 * plan.alpha + 1.0);
        prop_assert!((image.cost() / cost - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn equation_3_9_what_comes_to_a_cell_is_what_leaves_it_and_what_it_takes(plan in plans()) {
        let leaf = plan.grow(2).expect("a good plan");
        let mut left = leaf.counts().to_vec();
        for v in 1..leaf.cells().len() {
            left[leaf.parent(v).expect("only the root has none")] -= leaf.counts()[v];
        }
        prop_assert!(left.iter().all(|&taken| taken == 1));
        prop_assert_eq!(leaf.counts()[0] as usize, leaf.cells().len());
    }

    #[test]
    fn even_light_gives_exact_mirror_images(plan in plans()) {
        let plan = TransportPlan { mirrored: true, noise: 0.0, ..plan };
        let leaf = plan.grow(1).expect("a good plan");
        prop_assert!(leaf.is_mirrored());
        let find = |cell: Cell| leaf.cells().iter().position(|&c| c == cell);
        for (v, &cell) in leaf.cells().iter().enumerate() {
            let image = find(cell.mirrored()).expect("an image");
            prop_assert_eq!(leaf.counts()[v], leaf.counts()[image]);
            let parent = leaf.parent(v).map(|p| leaf.cells()[p].mirrored());
            prop_assert_eq!(parent, leaf.parent(image).map(|p| leaf.cells()[p]));
        }
    }

    #[test]
    fn the_cost_kept_up_to_date_is_the_cost_by_definition_at_every_step(plan in plans()) {
        each_application(&plan, |_, _, after| {
            let (cells, parents, _) = unfolded(&after.tree);
            let system = TransportSystem::new(&cells, &parents, [plan.alpha, plan.beta, 1.0]);
            let (kept, defined) = (after.tree.cost(), system.cost());
            assert!((kept - defined).abs() <= ROUNDING * defined, "{kept} is not {defined}");
        });
    }
}

proptest! {
    #![proptest_config(fixed(6))]

    #[test]
    fn equation_3_3_exactly_the_cells_that_pay_are_added(plan in plans()) {
        // Mirrored leaves allow only edges that keep both sides alike, so this test uses unmirrored
        // ones.
        let plan = TransportPlan { mirrored: false, epsilon: plan.epsilon.min(2.5), ..plan };
        let light = plan.revenue(7);
        each_application(&plan, |before, epsilon, after| {
            let (cells, parents, _) = unfolded(&before.tree);
            let system = TransportSystem::new(&cells, &parents, [plan.alpha, plan.beta, 1.0]);
            let reach = 3 + cells.iter().map(|c| c.m.abs().max(c.n.abs())).max().unwrap_or(0);
            for cell in (-reach..=reach).flat_map(|m| (-reach..=reach).map(move |n| Cell::new(m, n))) {
                if cells.contains(&cell) {
                    continue;
                }
                let expense = system.expense(cell);
                let pays = expense <= epsilon * light.of(cell) * (1.0 + 1e-12);
                let came = after.tree.find(cell) != NONE;
                assert_eq!(pays, came, "{cell:?} costs {expense}");
                let offer = after.offers.iter().find(|offer| offer.cell == cell);
                if let (true, Some(offer)) = (came, offer) {
                    assert!((offer.expense / expense - 1.0).abs() < ROUNDING);
                }
            }
        });
    }
}

#[test]
fn lemma_3_11_expense_scales_with_the_cells() {
    let leaf = TransportPlan::default()
        .grow(1)
        .expect("a good plan")
        .at_stage(6);
    let (alpha, beta) = (0.6, 0.5);
    let parents = &leaf.stages()[6].parents;
    for enlargement in [0.25, 3.0, 17.0] {
        let system = |h: f64| TransportSystem::new(leaf.cells(), parents, [alpha, beta, h]);
        for cell in [Cell::new(0, 30), Cell::new(7, 3), Cell::new(-4, 9)] {
            let ratio = system(enlargement).expense(cell) / system(1.0).expense(cell);
            let expected = libm::pow(enlargement, 1.0 + 2.0 * alpha);
            assert!((ratio / expected - 1.0).abs() < ROUNDING);
        }
    }
}

#[test]
fn the_first_cell_comes_when_revenue_reaches_the_cost_of_one_cell_ahead() {
    for (alpha, cell) in [(0.3, 1.0), (0.6, 0.01), (0.75, 7.0), (0.9, 0.3)] {
        let first = libm::pow(cell, 2.0 * alpha - 1.0);
        let cells = |share: f64| {
            let plan = TransportPlan {
                alpha,
                cell,
                epsilon: first * share,
                ladder: Ladder::Equal(1),
                most_cells: 1000,
                ..TransportPlan::default()
            };
            plan.grow(0).map(|leaf| leaf.cells().len())
        };
        assert_eq!(cells(1.0 - 1e-9), Ok(1));
        assert!(cells(1.0).is_ok_and(|count| count == 2), "{:?}", cells(1.0));
    }
}

#[test]
fn remark_3_6_uneven_light_gives_another_leaf_for_each_seed_and_none_a_symmetric_one() {
    let plan = TransportPlan {
        noise: 0.3,
        ..TransportPlan::default()
    };
    let lean = |leaf: &TransportLeaf| {
        let image = |cell: &&Cell| !leaf.cells().contains(&cell.mirrored());
        leaf.cells().iter().filter(image).count()
    };
    let (one, other) = (plan.grow(1), plan.grow(2));
    assert_ne!(one, other);
    assert_eq!(one, plan.grow(1));
    assert!(one.is_ok_and(|leaf| lean(&leaf) > leaf.cells().len() / 20));
}

#[test]
fn remark_3_6_cells_die_from_the_margin_inwards_and_none_before_its_own_supplies() {
    let leaf = TransportPlan::default().grow(1).expect("a good plan");
    let deaths = leaf.deaths(50).expect("a good number");
    assert!(leaf.deaths(0).is_err());
    for v in 1..leaf.cells().len() {
        let p = leaf.parent(v).expect("only the root has none");
        assert!(p == 0 || deaths[p] <= deaths[v]);
        let image = leaf
            .cells()
            .iter()
            .position(|&c| c == leaf.cells()[v].mirrored());
        assert_eq!(Some(deaths[v]), image.map(|image| deaths[image]));
    }
    // As the revenue falls, the leaf shrinks and remains a valid system.
    let mut count = leaf.cells().len();
    for share in [0.95, 0.7, 0.4, 0.1] {
        let rest = leaf.without_dead(&deaths, share);
        assert!(rest.cells().len() < count && rest.counts()[0] as usize == rest.cells().len());
        count = rest.cells().len();
    }
}

/// `F`, by definition, of some cells of a leaf, ascending, whose parents are among them.
fn cost_of(leaf: &TransportLeaf, kept: &[usize]) -> f64 {
    let number = |v: usize| kept.binary_search(&v).expect("kept with what supplies it") as u32;
    let cells: Vec<Cell> = kept.iter().map(|&v| leaf.cells()[v]).collect();
    let parents: Vec<u32> = kept
        .iter()
        .map(|&v| leaf.parent(v).map_or(NONE, number))
        .collect();
    let TransportPlan {
        alpha, beta, cell, ..
    } = *leaf.plan();
    TransportSystem::new(&cells, &parents, [alpha, beta, cell]).cost()
}

#[test]
fn remark_3_6_living_tips_pay_for_their_transport_and_those_that_just_died_would_not() {
    const STEPS: u32 = 50;
    let cell = 2.0;
    let even = TransportPlan::default();
    let larger = TransportPlan {
        cell,
        epsilon: even.epsilon * libm::pow(cell, 2.0 * even.alpha - 1.0),
        noise: 0.3,
        ..even.clone()
    };
    for plan in [even, larger] {
        let leaf = plan.grow(1).expect("a good plan");
        let light = plan.revenue(1);
        let deaths = leaf.deaths(STEPS).expect("a good number");
        let (mut living, mut dead) = (0, 0);
        for step in [1, 9, 20, 33, 45] {
            let share = 1.0 - f64::from(step) / f64::from(STEPS);
            let earned =
                |v: usize| share * plan.epsilon * plan.cell * plan.cell * light.of(leaf.cells()[v]);
            let lives = |v: usize| v == 0 || deaths[v] < share;
            let supplies =
                |p: usize| (1..leaf.cells().len()).any(|v| lives(v) && leaf.parent(v) == Some(p));
            let kept: Vec<usize> = (0..leaf.cells().len()).filter(|&v| lives(v)).collect();
            assert_eq!(leaf.without_dead(&deaths, share).cells().len(), kept.len());
            let cost = cost_of(&leaf, &kept);
            // Each cost is a difference of rounded sums.
            let rounding = ROUNDING * cost;
            for &tip in kept[1..].iter().filter(|&&v| !supplies(v)) {
                let others: Vec<usize> = kept.iter().copied().filter(|&v| v != tip).collect();
                let expense = cost - cost_of(&leaf, &others);
                assert!(expense <= earned(tip) + rounding, "{tip} costs {expense}");
                living += 1;
            }
            // The last cell on each vein that died in this step: added back alone, it costs more
            // than its revenue, since it shares the way with fewer cells.
            let last =
                |&v: &usize| !lives(v) && deaths[v] == share && leaf.parent(v).is_some_and(lives);
            for v in (1..leaf.cells().len()).filter(last) {
                let mut more = kept.clone();
                more.insert(kept.partition_point(|&other| other < v), v);
                let expense = cost_of(&leaf, &more) - cost;
                assert!(expense > earned(v) - rounding, "{v} costs {expense}");
                dead += 1;
            }
        }
        assert!(living > 100 && dead > 20, "{living} live, {dead} died");
    }
}

/// Area over that of a circle whose diameter is the longest extent of the leaf.
fn roundness(leaf: &TransportLeaf) -> f64 {
    let outline = leaf.outline(1.0).expect("a margin");
    let mut longest = 0.0_f64;
    for p in outline.points() {
        for q in outline.points() {
            longest = longest.max((*p - *q).length_squared());
        }
    }
    4.0 * outline.area() / (PI * longest)
}

/// Spearman's rank correlation of a sequence with its own order, no ties.
fn rank_correlation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let rank = |value: f64| values.iter().filter(|&&other| other < value).count() as f64;
    let apart = |(i, &value): (usize, &f64)| (rank(value) - i as f64) * (rank(value) - i as f64);
    let sum: f64 = values.iter().enumerate().map(apart).sum();
    1.0 - 6.0 * sum / (n * (n * n - 1.0))
}

#[test]
fn remark_3_7_leaves_are_rounder_for_larger_alpha() {
    let alphas = [0.5, 0.525, 0.55, 0.575, 0.6, 0.625, 0.65, 0.675, 0.7, 0.725];
    let leaf = |alpha: f64, epsilon: f64| {
        let plan = TransportPlan {
            alpha,
            epsilon,
            ..TransportPlan::default()
        };
        plan.grow(0).expect("below the limit")
    };
    let same_revenue = alphas.map(|alpha| roundness(&leaf(alpha, 5.0)));
    // And at one size, about 500 cells, reached by halving intervals of revenue.
    let same_size = alphas.map(|alpha| {
        let (mut low, mut high) = (1.0, 16.0);
        for _ in 0..12 {
            let middle = 0.5 * (low + high);
            let plan = TransportPlan {
                alpha,
                epsilon: middle,
                most_cells: 500,
                ..TransportPlan::default()
            };
            if plan.grow(0).is_ok() {
                low = middle;
            } else {
                high = middle;
            }
        }
        roundness(&leaf(alpha, low))
    });
    // Ten ranks: above 0.56 is significant at 5 % (one-sided).
    let (by_revenue, by_size) = (
        rank_correlation(&same_revenue),
        rank_correlation(&same_size),
    );
    assert!(by_revenue > 0.75, "{by_revenue}: {same_revenue:?}");
    assert!(by_size > 0.75, "{by_size}: {same_size:?}");
}

#[test]
fn too_many_cells_are_refused_with_their_number_and_the_limit() {
    let plan = TransportPlan {
        alpha: 0.3,
        most_cells: 400,
        ..TransportPlan::default()
    };
    let message = plan.grow(0).expect_err("it never stops").to_string();
    assert!(
        message.contains("most_cells is 400") && message.contains("alpha is 0.3"),
        "{message}"
    );
}
