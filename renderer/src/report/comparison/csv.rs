//! Findings of a comparison as CSV.

use serde_json::{Value, json};

use super::json;
use crate::comparison::Findings;
use crate::report::table::{Table, cell};

/// Columns of the table of all numbers, and where each is found in what [`row`] makes of a measure
/// or of a kind of single values.
const COLUMNS: [(&str, &[&str]); 55] = [
    ("of", &["/of"]),
    ("measure", &["/entry/measure", "/entry/kind"]),
    ("part", &["/entry/part"]),
    ("unit", &["/entry/unit"]),
    ("first", &["/first/group"]),
    ("second", &["/second/group"]),
    ("first_count", &["/first/values"]),
    ("second_count", &["/second/values"]),
    ("first_mean", &["/first/summary/mean"]),
    ("second_mean", &["/second/summary/mean"]),
    ("first_sd", &["/first/summary/standard_deviation"]),
    ("second_sd", &["/second/summary/standard_deviation"]),
    ("first_low", &["/first/summary/mean_interval_95/0"]),
    ("first_high", &["/first/summary/mean_interval_95/1"]),
    ("second_low", &["/second/summary/mean_interval_95/0"]),
    ("second_high", &["/second/summary/mean_interval_95/1"]),
    ("first_median", &["/first/summary/median", "/first/median"]),
    (
        "second_median",
        &["/second/summary/median", "/second/median"],
    ),
    ("difference", &["/pair/difference"]),
    ("difference_low", &["/pair/difference_interval_95/0"]),
    ("difference_high", &["/pair/difference_interval_95/1"]),
    ("ratio", &["/pair/ratio"]),
    ("hedges_g", &["/pair/hedges_g/value"]),
    ("hedges_g_low", &["/pair/hedges_g/interval_95/0"]),
    ("hedges_g_high", &["/pair/hedges_g/interval_95/1"]),
    ("cliffs_delta", &["/pair/cliffs_delta/value"]),
    ("cliffs_delta_low", &["/pair/cliffs_delta/interval_95/0"]),
    ("cliffs_delta_high", &["/pair/cliffs_delta/interval_95/1"]),
    ("welch_t", &["/pair/welch/t"]),
    ("welch_df", &["/pair/welch/degrees_of_freedom"]),
    ("welch_p", &["/pair/welch/tested/p"]),
    ("welch_p_holm", &["/pair/welch/tested/holm"]),
    ("welch_p_fdr", &["/pair/welch/tested/fdr"]),
    ("among_t", &["/pair/one_among_others/t"]),
    ("among_df", &["/pair/one_among_others/degrees_of_freedom"]),
    ("among_p", &["/pair/one_among_others/tested/p"]),
    ("among_p_holm", &["/pair/one_among_others/tested/holm"]),
    ("among_p_fdr", &["/pair/one_among_others/tested/fdr"]),
    ("mann_whitney_u", &["/pair/mann_whitney/u"]),
    ("mann_whitney_p", &["/pair/mann_whitney/tested/p"]),
    ("mann_whitney_p_holm", &["/pair/mann_whitney/tested/holm"]),
    ("mann_whitney_p_fdr", &["/pair/mann_whitney/tested/fdr"]),
    ("mann_whitney_exact", &["/pair/mann_whitney/exact"]),
    ("leafwise_distance", &["/pair/leaves_permuted/distance"]),
    ("leafwise_p", &["/pair/leaves_permuted/tested/p"]),
    ("leafwise_p_holm", &["/pair/leaves_permuted/tested/holm"]),
    ("leafwise_p_fdr", &["/pair/leaves_permuted/tested/fdr"]),
    ("leafwise_exact", &["/pair/leaves_permuted/exact"]),
    ("ks_distance", &["/pair/kolmogorov_smirnov/distance"]),
    ("ks_p", &["/pair/kolmogorov_smirnov/tested/p"]),
    ("ks_p_holm", &["/pair/kolmogorov_smirnov/tested/holm"]),
    ("ks_p_fdr", &["/pair/kolmogorov_smirnov/tested/fdr"]),
    ("ks_exact", &["/pair/kolmogorov_smirnov/exact"]),
    ("untested", &["/pair/untested"]),
    ("definition", &["/entry/definition"]),
];

/// A row for each measure, and each kind of single values, of each pair.
pub(crate) fn csv(findings: &Findings) -> String {
    let mut table = Table::of(COLUMNS.map(|(name, _)| name));
    let all = json::json(findings);
    let entries = |of: &str| all[of].as_array().into_iter().flatten();
    for (number, pair) in findings.compared.pairs.iter().enumerate() {
        for entry in entries("measures") {
            let contrast = &entry["pairs"][number];
            add(&mut table, "leaves", entry, *pair, contrast);
        }
        let kinds = findings.compared.distributions.iter();
        for (entry, values) in entries("distributions").zip(kinds) {
            let mut contrast = entry["pairs"][number].clone();
            if let (Value::Object(all), Value::Object(pooled)) = (
                &mut contrast,
                entry["pairs"][number]["as_if_independent"].clone(),
            ) {
                all.extend(pooled);
            }
            // What was not tested is neither exact nor has an interval.
            for test in ["leaves_permuted", "kolmogorov_smirnov"] {
                if contrast[test]["tested"].is_null() {
                    contrast[test]["exact"] = Value::Null;
                }
            }
            if contrast["mann_whitney"].is_null() {
                contrast["cliffs_delta"]["interval_95"] = Value::Null;
            }
            let medians = pair.map(|group| values.medians[group]);
            let difference = medians[0].zip(medians[1]).map(|(one, other)| other - one);
            contrast["difference"] = difference.into();
            contrast["ratio"] = values.ratio(*pair).into();
            add(&mut table, "single values", entry, *pair, &contrast);
        }
    }
    table.text()
}

/// Adds the row of what was found between two groups.
fn add(table: &mut Table, of: &str, entry: &Value, pair: [usize; 2], contrast: &Value) {
    let [first, second] = pair.map(|group| &entry["groups"][group]);
    let row = json!({
        "of": of, "entry": entry, "first": first, "second": second, "pair": contrast,
    });
    table.row(COLUMNS.map(|(_, places)| {
        let mut found = places.iter().filter_map(|place| row.pointer(place));
        match found.next() {
            None | Some(Value::Null) => String::new(),
            Some(Value::String(text)) => text.clone(),
            Some(Value::Array(values)) => values.len().to_string(),
            Some(Value::Number(number)) if number.is_f64() => cell(number.as_f64()),
            Some(other) => other.to_string(),
        }
    }));
}

/// A row for each measure of each leaf.
pub(crate) fn values(findings: &Findings) -> String {
    let mut table = Table::new("group,leaf,file,measure,part,value,unit");
    for leaf in &findings.leaves {
        for row in &leaf.rows {
            table.row([
                findings.groups[leaf.group].as_str(),
                &leaf.name,
                &leaf.given,
                row.key,
                &cell(row.part),
                &cell(row.value),
                row.unit,
            ]);
        }
    }
    table.text()
}
