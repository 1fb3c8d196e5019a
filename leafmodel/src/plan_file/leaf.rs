//! A leaf: the keys of a plan, and what belongs together in them.

use super::compound;
use crate::blade::senescence::AgeSource;
use crate::document::{Declared, Keys};
use crate::leaf::LeafPlan;
use crate::optics::Contents;
use crate::optics::contents_keys::{NEVER_TOGETHER, refuse_unknown_absorption};
use crate::shape::outline::Outline;

/// The keys of a leaf, and what belongs together in them.
pub fn leaf(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    plan.declare(keys);
    let tried = keys
        .is_whole("outline")
        .then(|| plan.outline.grow(1.0, plan.seed));
    let tried = tried.and_then(|tried| tried.map_err(|error| error.report(keys)).ok());
    if keys.is_whole("venation") {
        check_veins(plan, tried.as_ref(), keys);
    }
    check(plan, keys);
}

/// The keys of a leaf in the file of a preset, whose margin tests have tried.
pub(super) fn leaf_of_preset(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    plan.declare(keys);
    if keys.is_whole("venation") {
        check_veins(plan, None, keys);
    }
    check(plan, keys);
}

/// The keys of a leaf of which only margin and veins are wanted: its contents need not be said.
pub(super) fn veins_alone(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    if let Some(block) = keys.reader() {
        block.cx.is_partial.set(true);
    }
    leaf(plan, keys);
}

/// Checks veins that each of their numbers allows; `outline` is what the plan's has grown to, if it was tried.
fn check_veins(plan: &LeafPlan, outline: Option<&Outline>, keys: &Keys<'_>) {
    if let Err(error) = plan.venation.check(&plan.outline, outline) {
        error.report(keys);
    }
}

/// Reports what is allowed one by one and not together.
fn check(plan: &LeafPlan, keys: &Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    if let Some(senescence) = &plan.senescence
        && senescence.needs_cells()
        && !plan.has_cells()
    {
        let path: &[&str] = match senescence.source {
            AgeSource::Revenue { .. } => &["senescence", "revenue_share"],
            AgeSource::Day { .. } => &["senescence", "deaths_days"],
        };
        let problem = "no cell of this leaf earns any revenue: it is not a transport leaf";
        let help = "write [leaves.NAME.outline.transport] or [leaves.NAME.venation.transport], or leave senescence out";
        keys.refuse(path, problem.to_owned(), help);
    }
    compound::check(plan, keys);
    refuse_unknown_absorption(&plan.pigments, &plan.tissue.lamina, keys);
    let lamina = &plan.tissue.lamina;
    let dead = plan
        .senescence
        .as_ref()
        .map(|senescence| &senescence.contents);
    let mut parts = std::iter::once(lamina).chain(dead);
    if parts.any(Contents::mixes_betalains_and_anthocyanins) {
        // Reported where those contents are.
        return;
    }
    if let Some([anthocyanins, betalains]) = plan.anthocyanins_beside_betalains() {
        let message = format!(
            "this leaf holds anthocyanins (`{anthocyanins}`) and betalains (`{betalains}`), which never occur in the same plant"
        );
        keys.warn(NEVER_TOGETHER, message, Contents::NEVER_TOGETHER);
    }
}
