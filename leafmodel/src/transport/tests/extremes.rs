//! Parameters near the ends of their ranges.

use super::*;

#[test]
fn whatever_the_parameters_leaves_hang_together_pay_and_have_margins() {
    let mut grown = 0;
    for alpha in [0.35, 0.5, 0.7, 0.97] {
        for beta in [0.01, 1.0, 20.0] {
            for epsilon in [2.5, 4.0, 10.0, 50.0] {
                for (steps, mirrored) in [(1, false), (7, true), (40, false)] {
                    let plan = TransportPlan {
                        alpha,
                        beta,
                        epsilon,
                        ladder: Ladder::Equal(steps),
                        mirrored,
                        most_cells: 2000,
                        ..TransportPlan::default()
                    };
                    match plan.grow(0) {
                        Ok(leaf) => grown += usize::from(is_sound(&leaf)),
                        Err(error) => {
                            assert!(error.to_string().contains("when most_cells is 2000"));
                        }
                    }
                }
            }
        }
    }
    assert!(grown > 50, "{grown}");
}

/// Always true; the assertions inside fail for an invalid leaf.
fn is_sound(leaf: &TransportLeaf) -> bool {
    let plan = leaf.plan();
    let count = leaf.cells().len();
    let mut cells: Vec<Cell> = leaf.cells().to_vec();
    cells.sort_unstable();
    let mut reached = vec![false; count];
    let mut open = vec![Cell::ROOT];
    while let Some(cell) = open.pop() {
        for near in cell.neighbours() {
            if let Ok(place) = cells.binary_search(&near)
                && !std::mem::replace(&mut reached[place], true)
            {
                open.push(near);
            }
        }
    }
    assert!(reached.into_iter().all(|reached| reached), "{plan:?}");
    let cost = leaf.system().cost();
    assert!((leaf.cost() - cost).abs() <= ROUNDING * cost, "{plan:?}");
    assert!(cost <= plan.epsilon * count as f64, "{plan:?}");
    let style = VeinStyle {
        base_radius_mm: 0.1,
        least_cells: 2,
    };
    assert!(
        leaf.outline(10.0).is_ok() && leaf.network(10.0, style).is_ok(),
        "{plan:?}"
    );
    true
}
