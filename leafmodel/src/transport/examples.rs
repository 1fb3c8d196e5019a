//! The examples of \[xia2007\] as plans.

use super::plan::TransportPlan;

/// The plan of Example 1 to 5; none for other numbers.
///
/// Examples 1 and 2 are printed with all their parameters. Examples 3 (maple-like) and 4 (mulberry-like) are not: theirs were
/// searched for, and `docs/src/theory/transport-leaf.md` has the outcome beside the paper's. Example 5 is a sweep over `α` at one `β`;
/// this is its middle, and any other member is the same plan with another `alpha`.
pub fn example(number: usize) -> Option<TransportPlan> {
    let plan = |alpha, beta, epsilon| TransportPlan {
        alpha,
        beta,
        epsilon,
        ..TransportPlan::default()
    };
    match number {
        1 => Some(plan(0.6, 0.5, 5.0)),
        2 => Some(plan(0.5, 0.8, 5.0)),
        3 => Some(plan(0.64, 0.15, 6.0)),
        4 => Some(plan(0.6, 0.5, 5.0)),
        5 => Some(plan(0.65, 0.5, 7.0)),
        _ => None,
    }
}
