//! Findings of a comparison as JSON, from which its page and its tables are made.

use serde::Serialize;
use serde_json::{Value, json};

use crate::checkpoint::PROGRAM;
use crate::comparison::Findings;

/// All numbers, and the values of each leaf.
pub(crate) fn json(findings: &Findings) -> Value {
    let compared = &findings.compared;
    let leaves = findings.leaves.iter().map(|leaf| {
        json!({
            "name": leaf.name,
            "group": findings.groups[leaf.group],
            "file": leaf.given,
            "nodes": leaf.nodes,
            "edges": leaf.edges,
            "areoles": leaf.areoles,
            "area_mm2": leaf.area_mm2,
            "remarks": leaf.remarks,
        })
    });
    let measures = compared.measures.iter().map(|measure| {
        let groups = measure.values.iter().zip(&measure.summaries).enumerate();
        let groups = groups.map(|(group, (values, found))| {
            let leaves = values.iter().map(
                |(leaf, value)| json!({ "leaf": findings.leaves[*leaf].name, "value": value }),
            );
            json!({
                "group": findings.groups[group],
                "summary": found,
                "values": leaves.collect::<Vec<_>>(),
            })
        });
        let contrasts = compared.pairs.iter().zip(&measure.contrasts);
        json!({
            "measure": measure.key,
            "part": measure.part,
            "unit": measure.unit,
            "definition": measure.definition,
            "groups": groups.collect::<Vec<_>>(),
            "pairs": contrasts
                .map(|(pair, contrast)| between(findings, *pair, contrast))
                .collect::<Vec<_>>(),
        })
    });
    let distributions = compared.distributions.iter().map(|distribution| {
        let contrasts = compared.pairs.iter().zip(&distribution.contrasts);
        let groups = distribution
            .counts
            .iter()
            .zip(&distribution.medians)
            .enumerate();
        let groups = groups.map(|(group, (count, median))| {
            json!({
                "group": findings.groups[group],
                "leaves": distribution.leaves[group].len(),
                "values": count,
                "median": median,
            })
        });
        json!({
            "kind": distribution.kind,
            "unit": distribution.unit,
            "definition": distribution.definition,
            "groups": groups.collect::<Vec<_>>(),
            "pairs": contrasts
                .map(|(pair, contrast)| between(findings, *pair, contrast))
                .collect::<Vec<_>>(),
        })
    });
    json!({
        "groups": findings.groups,
        "leaves": leaves.collect::<Vec<_>>(),
        "measures": measures.collect::<Vec<_>>(),
        "distributions": distributions.collect::<Vec<_>>(),
        "absent": compared.absent,
        "tests": {
            "welch": compared.tests[0],
            "mann_whitney": compared.tests[1],
            "distributions": compared.tests[2],
        },
        "notes": findings.notes,
        "program": PROGRAM,
    })
}

/// What was found between two groups, with their names.
fn between(findings: &Findings, pair: [usize; 2], contrast: &impl Serialize) -> Value {
    let mut found = json!(contrast);
    found["groups"] = json!(pair.map(|group| &findings.groups[group]));
    found
}
