//! Findings of a comparison as JSON, from which its page and its tables are made.

use leafmodel::measure::comparison::{Effect, Summary};
use serde_json::{Value, json};

use crate::checkpoint::PROGRAM;
use crate::comparison::Findings;
use crate::comparison::compared::{Contrast, SpreadContrast, Tested};

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
                "summary": found.map(summary),
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
                .map(|(pair, contrast)| contrast_json(findings, *pair, contrast))
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
                .map(|(pair, contrast)| spread_json(findings, *pair, contrast))
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

fn summary(found: Summary) -> Value {
    json!({
        "count": found.count,
        "mean": found.mean,
        "median": found.median,
        "standard_deviation": found.deviation,
        "mean_interval_95": found.interval,
    })
}

fn tested(tested: Option<Tested>) -> Value {
    let members = |found: Tested| json!({ "p": found.p, "holm": found.holm, "fdr": found.fdr });
    tested.map_or(Value::Null, members)
}

fn effect(effect: Option<Effect>) -> Value {
    let members = |found: Effect| json!({ "value": found.value, "interval_95": found.interval });
    effect.map_or(Value::Null, members)
}

fn contrast_json(findings: &Findings, pair: [usize; 2], contrast: &Contrast) -> Value {
    json!({
        "groups": pair.map(|group| &findings.groups[group]),
        "difference": contrast.difference,
        "difference_interval_95": contrast.welch.map(|welch| welch.interval),
        "ratio": contrast.ratio,
        "hedges_g": effect(contrast.g),
        "cliffs_delta": effect(contrast.delta),
        "welch": contrast.welch.map(|welch| json!({
            "t": welch.t,
            "degrees_of_freedom": welch.freedom,
            "tested": tested(contrast.means),
        })),
        "one_among_others": contrast.among.map(|among| json!({
            "t": among.t,
            "degrees_of_freedom": among.freedom,
            "tested": tested(contrast.means),
        })),
        "mann_whitney": contrast.ranks.map(|ranks| json!({
            "u": ranks.u,
            "exact": ranks.exact,
            "tested": tested(contrast.orders),
        })),
        "untested": contrast.untested,
    })
}

fn spread_json(findings: &Findings, pair: [usize; 2], contrast: &SpreadContrast) -> Value {
    json!({
        "groups": pair.map(|group| &findings.groups[group]),
        "leaves_permuted": contrast.leafwise.map(|found| json!({
            "distance": found.distance,
            "smallest_p": found.smallest,
            "exact": found.exact,
            "tested": tested(contrast.permuted),
        })),
        "as_if_independent": {
            "kolmogorov_smirnov": contrast.pooled.map(|steps| json!({
                "distance": steps.distance,
                "exact": steps.exact,
                "tested": tested(contrast.steps),
            })),
            "mann_whitney": contrast.ranks.map(|ranks| json!({
                "u": ranks.u,
                "exact": ranks.exact,
                "tested": tested(contrast.orders),
            })),
            "cliffs_delta": effect(contrast.delta),
        },
        "untested": contrast.untested,
    })
}
