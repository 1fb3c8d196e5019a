//! The page of a comparison: one HTML file that needs no other.

use serde_json::json;

use super::overlay::{Alignment, MOST, NoMargin, overlay};
use super::words::{conclusions, label, test_of_means};
use super::{figures, json};
use crate::comparison::Findings;
use crate::comparison::compared::{LEVEL, PROBES};
use crate::comparison::leaves::LEFT_OUT;
use crate::report::page::page;

/// The page; `has_named_overlay` says whether a person has chosen what is drawn over each other.
///
/// # Errors
///
/// [`NoMargin`] if leaves cannot be aligned as is wanted.
pub(crate) fn html(
    findings: &Findings,
    align: Option<Alignment>,
    has_named_overlay: bool,
) -> Result<String, NoMargin> {
    let compared = &findings.compared;
    let mut shown = json::json(findings);
    let (leaves, all) = (&findings.leaves, "leaves");
    for (number, leaf) in leaves.iter().enumerate() {
        shown[all][number]["place"] = leaf.group.into();
    }
    for (number, measure) in compared.measures.iter().enumerate() {
        let entry = &mut shown["measures"][number];
        entry["label"] = label(measure.key, measure.part).into();
        entry["figure"] = figures::strip(findings, measure).into();
    }
    for (number, values) in compared.distributions.iter().enumerate() {
        let entry = &mut shown["distributions"][number];
        entry["figure"] = figures::curves(findings, values).into();
        for (place, pair) in compared.pairs.iter().enumerate() {
            entry["pairs"][place]["ratio"] = values.ratio(*pair).into();
        }
    }
    let pairs = compared.pairs.iter().enumerate().map(|(number, pair)| {
        let draw = if findings.is_single {
            figures::ratios
        } else {
            figures::effects
        };
        json!({
            "first": pair[0],
            "second": pair[1],
            "figure": draw(findings, number),
            "test_of_means": test_of_means(findings, *pair),
        })
    });
    let mut overlays = Vec::new();
    for pair in &findings.overlays {
        let leaves = pair.map(|leaf| &leaves[leaf]);
        if let Some(drawn) = overlay(leaves, align)? {
            let [one, other] = leaves.map(|leaf| leaf.name.as_str());
            overlays.push(json!({
                "one": one, "other": other, "figure": drawn.figure, "caption": drawn.caption,
            }));
        }
    }
    let more = json!({
        "title": findings.title,
        "is_single": findings.is_single,
        "conclusions": conclusions(findings),
        "pairs": pairs.collect::<Vec<_>>(),
        "overlays": overlays,
        "most_overlays": MOST,
        "has_more_overlays": !has_named_overlay && findings.groups.len() > MOST + 1,
        "level": LEVEL,
        "probes": PROBES,
        "left_out": LEFT_OUT,
        "seed": findings.seed,
    });
    Ok(page(include_str!("page.html"), &[&shown, &more]))
}
