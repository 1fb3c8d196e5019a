//! The optimiser against brute force.

use super::super::cost::TransportSystem;
use super::super::leaf::unfolded;
use super::super::plan::TransportPlan;
use super::*;

fn grown(plan: &TransportPlan, epsilon: f64) -> Tree {
    let mut growth = plan.seedling(1);
    growth.settle(epsilon).expect("below the limit");
    growth.tree
}

/// `F`, by definition and in cells, of cells with these parents; infinite if the parents form a
/// cycle.
fn cost(plan: &TransportPlan, cells: &[Cell], parents: &[u32]) -> f64 {
    for start in 0..cells.len() {
        let (mut v, mut steps) = (start, 0);
        while v != 0 && steps <= cells.len() {
            v = parents[v] as usize;
            steps += 1;
        }
        if steps > cells.len() {
            return f64::INFINITY;
        }
    }
    TransportSystem::new(cells, parents, [plan.alpha, plan.beta, 1.0]).cost()
}

/// `Q_v`: the cells shorter than two cells away from `v` or its parent.
fn admissible(cells: &[Cell], parents: &[u32], v: usize) -> Vec<u32> {
    let parent = cells[parents[v] as usize];
    let near = |u: Cell| (u - cells[v]).squared() < 4 || (u - parent).squared() < 4;
    (0..cells.len() as u32)
        .filter(|&u| u as usize != v && near(cells[u as usize]))
        .collect()
}

#[test]
fn no_single_parent_can_be_changed_to_make_a_leaf_cheaper() {
    for (alpha, beta, epsilon) in [(0.55, 0.5, 3.0), (0.7, 0.1, 4.0), (0.85, 1.5, 9.0)] {
        let plan = TransportPlan {
            alpha,
            beta,
            mirrored: false,
            ..TransportPlan::default()
        };
        let (cells, parents, _) = unfolded(&grown(&plan, epsilon));
        let now = cost(&plan, &cells, &parents);
        assert!(cells.len() > 30);
        for v in 1..cells.len() {
            for u in admissible(&cells, &parents, v) {
                let mut other = parents.clone();
                other[v] = u;
                let then = cost(&plan, &cells, &other);
                assert!(then >= now * (1.0 - 1e-10), "{v} from {u}: {then} < {now}");
            }
        }
    }
}

#[test]
fn no_pair_of_parents_can_be_changed_to_make_a_mirrored_leaf_cheaper() {
    let plan = TransportPlan {
        alpha: 0.6,
        ..TransportPlan::default()
    };
    let (cells, parents, _) = unfolded(&grown(&plan, 2.5));
    let image = |v: u32| {
        let cell = cells[v as usize].mirrored();
        cells.iter().position(|&c| c == cell).expect("an image") as u32
    };
    let now = cost(&plan, &cells, &parents);
    for v in (1..cells.len()).filter(|&v| cells[v].m > 0) {
        for u in admissible(&cells, &parents, v) {
            if cells[u as usize].m < 0 {
                continue;
            }
            let mut other = parents.clone();
            other[v] = u;
            other[image(v as u32) as usize] = image(u);
            let then = cost(&plan, &cells, &other);
            assert!(then >= now * (1.0 - 1e-10), "{v} from {u}: {then} < {now}");
        }
    }
}

#[test]
fn a_mirrored_leaf_is_hardly_dearer_than_changes_on_one_side_could_make_it() {
    for (alpha, beta, epsilon) in [(0.6, 0.5, 5.0), (0.64, 0.15, 4.0), (0.5, 0.8, 3.5)] {
        let plan = TransportPlan {
            alpha,
            beta,
            ..TransportPlan::default()
        };
        let mirrored = grown(&plan, epsilon);
        let (cells, parents, _) = unfolded(&mirrored);
        let mut free = Tree::new(alpha, beta, false);
        let system = TransportSystem::new(&cells, &parents, [alpha, beta, 1.0]);
        for v in system.root_to_tip().into_iter().skip(1) {
            free.add(cells[v], free.find(cells[parents[v] as usize]));
        }
        free.refresh();
        assert!((free.cost() / mirrored.cost() - 1.0).abs() < 1e-12);
        let mut optimiser = Optimiser::default();
        optimiser.run(&mut free);
        let saved = 1.0 - free.cost() / mirrored.cost();
        assert!((0.0..0.005).contains(&saved), "{saved}");
    }
}

#[test]
fn every_change_of_parent_saves_what_the_definition_says() {
    for mirrored in [false, true] {
        let plan = TransportPlan {
            mirrored,
            ..TransportPlan::default()
        };
        let mut tree = grown(&plan, 3.0);
        // Make it worse: give some cells their parent's parent where the turn allows it.
        let mut scratch = Vec::new();
        for v in (1..tree.count()).step_by(2) {
            let parent = tree.nodes[v as usize].parent;
            let before = tree.nodes[parent as usize].parent;
            if before != NONE && tree.may_join(tree.cells[before as usize], tree.cells[v as usize])
            {
                let spoilt = tree.clone();
                tree.reparent(v, before, &mut scratch);
                if tree.cost() == f64::INFINITY {
                    tree = spoilt;
                }
            }
        }
        let mut optimiser = Optimiser::default();
        let spoilt = tree.cost();
        let definition = |tree: &Tree| {
            let (cells, parents, _) = unfolded(tree);
            cost(&plan, &cells, &parents)
        };
        assert!((definition(&tree) / spoilt - 1.0).abs() < 1e-12);
        optimiser.stamps.resize(tree.nodes.len(), 0);
        optimiser.relative.resize(tree.nodes.len(), 0.0);
        let mut changes = 0;
        for v in (1..tree.count()).rev() {
            let before = definition(&tree);
            if let Some(u) = optimiser.better_parent(&tree, v) {
                tree.reparent(v, u, &mut scratch);
                let after = definition(&tree);
                assert!(after < before, "{v}: {after} is no saving on {before}");
                assert!((tree.cost() / after - 1.0).abs() < 1e-12);
                changes += 1;
            }
        }
        assert!(changes > 5);
    }
}

#[test]
fn cells_that_are_passed_over_would_have_kept_their_parents() {
    for (mirrored, beta) in [(false, 0.4), (true, 0.4), (true, 1.2)] {
        let plan = TransportPlan {
            beta,
            mirrored,
            ..TransportPlan::default()
        };
        let [mut passing, mut forgetful] = [plan.seedling(1), plan.seedling(1)];
        let mut passed_over = 0;
        while passing.apply(3.0).expect("below the limit") > 0 {
            let tree = &passing.tree;
            let mut fresh = Optimiser::default();
            fresh.stamps.resize(tree.nodes.len(), 0);
            fresh.relative.resize(tree.nodes.len(), 0.0);
            let better = (1..tree.count()).find(|&v| fresh.better_parent(tree, v).is_some());
            assert_eq!(better, None);
            passed_over += (1..tree.count())
                .filter(|&v| passing.optimiser.settled.has(v))
                .count();
            // One that looks at every cell after each step of growth comes to the same leaf.
            forgetful.optimiser = Optimiser::default();
            forgetful.apply(3.0).expect("below the limit");
            let parents = |tree: &Tree| {
                tree.nodes
                    .iter()
                    .map(|node| node.parent)
                    .collect::<Vec<_>>()
            };
            assert_eq!(parents(tree), parents(&forgetful.tree));
        }
        assert!(passed_over > 50, "{passed_over}");
    }
}

#[test]
fn small_leaves_cost_little_more_than_the_cheapest_of_all_systems() {
    // Six cells and the root: all choices of parents, 6⁶ including cycles.
    let plan = TransportPlan {
        mirrored: false,
        ..TransportPlan::default()
    };
    let tree = {
        let mut growth = plan.seedling(1);
        growth.settle(1.5).expect("below the limit");
        growth.tree
    };
    let (cells, parents, _) = unfolded(&tree);
    let count = cells.len().min(7);
    let cells = &cells[..count];
    assert!(
        parents[..count]
            .iter()
            .skip(1)
            .all(|&p| (p as usize) < count)
    );
    let ours = cost(&plan, cells, &parents[..count]);
    let mut best = f64::INFINITY;
    for code in 0..(count as u32).pow(count as u32 - 1) {
        let digit = |v: u32| code / (count as u32).pow(v - 1) % count as u32;
        let others: Vec<u32> = (0..count as u32)
            .map(|v| if v == 0 { NONE } else { digit(v) })
            .collect();
        if (1..count).all(|v| others[v] as usize != v) {
            best = best.min(cost(&plan, cells, &others));
        }
    }
    assert!(ours >= best * (1.0 - 1e-12));
    assert!(ours <= best * 1.02, "{ours} against {best}");
}
