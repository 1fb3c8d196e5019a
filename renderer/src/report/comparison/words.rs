//! What was found for a person: tables and sentences.

use leafmodel::measure::comparison::Effect;

use crate::comparison::Findings;
use crate::comparison::compared::{Contrast, LEVEL, Tested};
use crate::plot::short;
use crate::report::table::in_columns;

/// The name of a measure with its part.
pub(crate) fn label(key: &str, part: Option<usize>) -> String {
    part.map_or_else(|| key.to_owned(), |part| format!("{key} {part}"))
}

/// A p-value as people write it.
pub(crate) fn shown_p(p: f64) -> String {
    if p < 0.0001 {
        "< 0.0001".to_owned()
    } else if p < 0.01 {
        format!("{p:.4}")
    } else {
        format!("{p:.3}")
    }
}

fn dash() -> String {
    "–".to_owned()
}

/// A number with three decimals.
fn three(number: Option<f64>) -> String {
    number.map_or_else(dash, |number| format!("{number:.3}"))
}

/// The table for a person, a part for each pair.
pub(crate) fn text(findings: &Findings) -> String {
    let mut parts = Vec::new();
    for (number, pair) in findings.compared.pairs.iter().enumerate() {
        let names = pair.map(|group| findings.groups[group].as_str());
        if findings.compared.measures.is_empty() {
            parts.push(spreads(findings, number, *pair, names));
            continue;
        }
        parts.push(if findings.is_single {
            singles(findings, number, *pair, names)
        } else {
            grouped(findings, number, *pair, names)
        });
        parts.push(spreads(findings, number, *pair, names));
    }
    parts.retain(|part| !part.is_empty());
    parts.join("\n\n")
}

/// The test of means that there is between two groups.
pub(crate) fn test_of_means(findings: &Findings, pair: [usize; 2]) -> &'static str {
    if pair.into_iter().any(|group| findings.size(group) == 1) {
        "one among p"
    } else {
        "Welch p"
    }
}

fn singles(findings: &Findings, number: usize, pair: [usize; 2], names: [&str; 2]) -> String {
    let [first, second] = names;
    let rows = findings.compared.measures.iter().map(|measure| {
        let [one, other] = pair.map(|group| measure.summaries[group].map(|found| found.mean));
        let contrast = measure.contrasts[number];
        let four = |value: Option<f64>| value.map_or_else(dash, |value| short(value, 4));
        [
            label(measure.key, measure.part),
            four(one),
            four(other),
            four(contrast.difference),
            three(contrast.ratio),
            measure.unit.to_owned(),
        ]
    });
    in_columns(
        ["measure", first, second, "difference", "ratio", "unit"],
        rows,
    )
}

fn grouped(findings: &Findings, number: usize, pair: [usize; 2], names: [&str; 2]) -> String {
    let header = [
        "measure",
        names[0],
        names[1],
        "ratio",
        "g, 95 %",
        test_of_means(findings, pair),
        "Holm",
        "M–W p",
        "Holm",
    ];
    let rows = findings.compared.measures.iter().map(|measure| {
        let [one, other] = pair.map(|group| {
            measure.summaries[group].map_or_else(dash, |found| {
                let spread = found.deviation.map_or_else(dash, |sd| short(sd, 2));
                format!("{} ± {spread} ({})", short(found.mean, 4), found.count)
            })
        });
        let contrast = measure.contrasts[number];
        let p = |tested: Option<Tested>, of: fn(Tested) -> f64| {
            tested.map_or_else(dash, |tested| shown_p(of(tested)))
        };
        let untested = || contrast.untested.map_or_else(dash, str::to_owned);
        [
            label(measure.key, measure.part),
            one,
            other,
            three(contrast.ratio),
            contrast.hedges_g.map_or_else(untested, shown_effect),
            p(contrast.means(), |tested| tested.p),
            p(contrast.means(), |tested| tested.holm),
            p(contrast.orders(), |tested| tested.p),
            p(contrast.orders(), |tested| tested.holm),
        ]
    });
    in_columns(header, rows)
}

pub(crate) fn shown_effect(effect: Effect) -> String {
    let [low, high] = effect.interval;
    let two = |value: f64| {
        if value.abs() < 100.0 {
            short_fixed(value)
        } else {
            short(value, 3)
        }
    };
    format!("{} [{}, {}]", two(effect.value), two(low), two(high))
}

/// Two digits after the point, with a true minus.
fn short_fixed(value: f64) -> String {
    let text = format!("{value:.2}");
    match text.strip_prefix('-') {
        Some("0.00") => "0.00".to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

fn spreads(findings: &Findings, number: usize, pair: [usize; 2], names: [&str; 2]) -> String {
    if findings.compared.distributions.is_empty() {
        return String::new();
    }
    let test = if findings.is_single {
        "K–S p"
    } else {
        "leaves permuted p"
    };
    let medians = names.map(|name| format!("median of {name}"));
    let header = [
        "single values",
        &medians[0],
        &medians[1],
        "distance",
        test,
        "Holm",
        "unit",
    ];
    let rows = findings.compared.distributions.iter().map(|distribution| {
        let [one, other] = pair.map(|group| {
            distribution.medians[group].map_or_else(dash, |median| {
                format!("{} ({})", short(median, 4), distribution.counts[group])
            })
        });
        let contrast = distribution.contrasts[number];
        let tested = findings.headline(&contrast);
        let p = |of: fn(Tested) -> f64| {
            let none = || contrast.untested.map_or_else(dash, str::to_owned);
            tested.map_or_else(none, |tested| shown_p(of(tested)))
        };
        [
            distribution.kind.to_owned(),
            one,
            other,
            three(findings.distance(&contrast)),
            p(|tested| tested.p),
            tested.map_or_else(dash, |tested| shown_p(tested.holm)),
            distribution.unit.to_owned(),
        ]
    });
    in_columns(header, rows)
}

pub(crate) fn conclusions(findings: &Findings) -> Vec<String> {
    let compared = &findings.compared;
    let contrasts = || {
        compared
            .measures
            .iter()
            .flat_map(|measure| &measure.contrasts)
    };
    let spreads = || {
        compared
            .distributions
            .iter()
            .flat_map(|found| &found.contrasts)
    };
    let line = |what: &str, tests: Vec<Tested>| {
        let all = tests.len();
        let count =
            |of: fn(&Tested) -> f64| tests.iter().filter(|tested| of(tested) <= LEVEL).count();
        (all > 0).then(|| {
            format!(
                "{what}: p is at most {LEVEL} in {} of {all} tests, after Holm's correction in {}, \
                 after that of Benjamini and Hochberg in {}",
                count(|tested| tested.p),
                count(|tested| tested.holm),
                count(|tested| tested.fdr)
            )
        })
    };
    let lines = [
        line(
            if contrasts().any(|contrast| contrast.one_among_others.is_some()) {
                "means of leaves (Welch; a group of one leaf as one among the others)"
            } else {
                "means of leaves (Welch)"
            },
            contrasts().filter_map(Contrast::means).collect(),
        ),
        line(
            "ranks of leaves (Mann and Whitney)",
            contrasts().filter_map(Contrast::orders).collect(),
        ),
        line(
            if findings.is_single {
                "distributions, each value as if independent (Kolmogorov and Smirnov)"
            } else {
                "distributions, leaves permuted"
            },
            spreads()
                .filter_map(|contrast| findings.headline(contrast))
                .collect(),
        ),
    ];
    lines.into_iter().flatten().collect()
}
