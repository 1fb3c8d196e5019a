//! The part of the report on single values.

use super::Findings;
use super::cells::{DASH, capital, key, pair_title, shown_tests, three, unit_words};
use super::compared::{Distribution, LEVEL, PROBES, Tested};
use super::figures;
use super::page::{figure, table};
use super::tables::ratio;
use super::words::shown_effect;
use crate::plot::{escaped, short};

/// Tables and curves.
pub(super) fn section(findings: &Findings) -> String {
    let all = &findings.compared.distributions;
    if all.is_empty() {
        return String::new();
    }
    let mut text = format!("<p>{}</p>\n", warning(findings));
    for (number, pair) in findings.compared.pairs.iter().enumerate() {
        text += &spread_table(findings, number, *pair);
    }
    text += if findings.is_single {
        "<p class=\"soft small\">Curves: the share of the values that are at most so large.</p>\n"
    } else {
        "<p class=\"soft small\">Curves: the share of the values that are at most so large; thin \
         lines are leaves, thick ones the means of groups.</p>\n"
    };
    text += "<div class=\"cards\">\n";
    for distribution in all {
        text += &format!(
            "<article class=\"card\" id=\"{}\">\n<h3>{}</h3>\n<p class=\"soft small\">{}{}</p>\n{}\
             </article>\n",
            distribution.kind,
            distribution.kind,
            escaped(&capital(distribution.definition)),
            unit_words(distribution.unit),
            figure(&figures::curves(findings, distribution), ""),
        );
    }
    text + "</div>\n"
}

/// What must be known to read these tests.
fn warning(findings: &Findings) -> &'static str {
    if findings.is_single {
        "Areoles and veins of one leaf are not independent of each other, and these are the values \
         of one leaf each. The tests take every value as if it were drawn by itself: a small p says \
         that these two networks differ, not that leaves of two kinds do. Distance and δ tell how \
         much."
    } else {
        "Areoles and veins of one leaf are not independent of each other. So whole leaves change \
         groups in the test that counts here. The last three columns pool the values of a group as \
         if each were independent; their p is far too small wherever leaves of a group differ, and \
         stands here only because others report it."
    }
}

fn spread_table(findings: &Findings, number: usize, pair: [usize; 2]) -> String {
    let [one, other] = pair.map(|group| format!("median of {}", key(findings, group)));
    let mut header = vec![
        "values".to_owned(),
        one,
        other,
        "ratio".to_owned(),
        "unit".to_owned(),
    ];
    let columns: &[&str] = if findings.is_single {
        &[
            "distance",
            "K–S p",
            "Holm",
            "FDR",
            "δ [95 %]",
            "M–W p",
            "Holm",
            "FDR",
        ]
    } else {
        &[
            "distance",
            "p",
            "Holm",
            "FDR",
            "pooled distance",
            "pooled K–S p",
            "pooled M–W p",
        ]
    };
    header.extend(columns.iter().map(|column| (*column).to_owned()));
    let mut rows = vec![header];
    let mut sure = Vec::new();
    for distribution in &findings.compared.distributions {
        let medians = pair.map(|group| distribution.medians[group]);
        let contrast = distribution.contrasts[number];
        let tested = findings.headline(&contrast);
        let mut row = vec![
            format!("<a href=\"#{0}\">{0}</a>", distribution.kind),
            spread_cell(findings, distribution, pair[0]),
            spread_cell(findings, distribution, pair[1]),
            three(ratio(medians)),
            escaped(distribution.unit),
            three(findings.distance(&contrast)),
        ];
        let mut tests = shown_tests(tested);
        if let (None, Some(why)) = (tested, contrast.untested) {
            tests[0] = escaped(why);
        }
        row.extend(tests);
        if findings.is_single {
            let delta = contrast.delta.map_or_else(
                || DASH.to_owned(),
                // An interval needs a number of values that means something.
                |effect| match distribution.kind {
                    PROBES => format!("{:.2}", effect.value),
                    _ => shown_effect(effect),
                },
            );
            row.push(delta);
            row.extend(shown_tests(contrast.orders));
        } else {
            let p = |tested: Option<Tested>| shown_tests(tested)[0].clone();
            row.push(three(contrast.pooled.map(|steps| steps.distance)));
            row.extend([p(contrast.steps), p(contrast.orders)]);
        }
        sure.push(tested.is_some_and(|tested| tested.holm <= LEVEL));
        rows.push(row);
    }
    let caption = format!(
        "{}: medians ({}), greatest distance of the cumulative curves, tests. Bold: p is at most \
         {LEVEL} after Holm's correction.",
        pair_title(findings, pair),
        if findings.is_single {
            "values"
        } else {
            "mean over leaves; leaves, values"
        }
    );
    table(&caption, "", &rows, &sure)
}

fn spread_cell(findings: &Findings, distribution: &Distribution, group: usize) -> String {
    let Some(median) = distribution.medians[group] else {
        return DASH.to_owned();
    };
    let count = distribution.counts[group];
    let leaves = distribution.leaves[group].len();
    let median = short(median, 4);
    if findings.is_single {
        format!("{median} ({count})")
    } else {
        format!("{median} ({leaves}, {count})")
    }
}
