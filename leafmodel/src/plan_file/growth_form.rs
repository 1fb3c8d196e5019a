//! How to mend a growth form that grows to no leaf.

use crate::document::keys::Keys;
use crate::shape::growth_form::{GrowthFormError, GrowthFormProblem, Side};
use crate::shape::outline::OutlineError;

/// Reports a form that each of its numbers allows and that grows to no leaf all the same; `keys`
/// are the leaf's.
pub(super) fn report(keys: &Keys<'_>, error: &GrowthFormError) {
    let (candidates, help): (&[&str], _) = match &error.problem {
        GrowthFormProblem::VeinOrder { .. } => (
            &["veins", "vein_count"],
            "put the veins farther apart, or use more `rows`",
        ),
        GrowthFormProblem::VeinsCross { .. } => (
            &["veins"],
            "change the slope as far as that, or put the veins farther apart",
        ),
        GrowthFormProblem::TooWide { .. } => (
            &["lateral_rates", "rate_ratio"],
            "use lower lateral rates, or a larger `rate_ratio`",
        ),
        GrowthFormProblem::Apart => (
            &["position"],
            "place the axis nearer to the middle of the blade, or widen its base",
        ),
        GrowthFormProblem::Range(_) => (&["axes"], "use fewer axes"),
        GrowthFormProblem::NoMargin(OutlineError::ShortMidrib { .. }) => (
            &["axes", "lateral_rates", "rate_ratio"],
            "use shorter axes, or lower lateral rates",
        ),
        GrowthFormProblem::NoMargin(_) => (
            &["veins", "axes"],
            "put the veins farther apart, with slopes that differ less",
        ),
    };
    let mut part = vec!["outline".to_owned(), "growth_algorithm".to_owned()];
    for number in &error.part.axes {
        part.extend(["axes".to_owned(), number.to_string()]);
    }
    let mut halves = Vec::new();
    if error.part.side == Side::Left {
        halves.push([part.clone(), vec!["left".to_owned()]].concat());
    }
    // What the left half does not have is written beside it.
    halves.push(part.clone());
    let paths = halves.iter().flat_map(|half| {
        candidates.iter().map(|key| {
            let half = half.iter().map(String::as_str);
            half.chain([*key]).collect::<Vec<&str>>()
        })
    });
    let there = paths.into_iter().find(|path| keys.has_path(path));
    let fallback: Vec<&str> = part
        .iter()
        .map(String::as_str)
        .chain([candidates[0]])
        .collect();
    keys.refuse(&there.unwrap_or(fallback), error.to_string(), help);
}
