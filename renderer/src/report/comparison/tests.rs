use leafmodel::measure::{Row, definition};

use super::{csv, html, json, words};
use crate::comparison::leaves::{Leaf, Values, same};
use crate::comparison::{Findings, Wanted};

/// A leaf of a group with some measures and areas of areoles.
fn leaf(group: usize, number: usize, rows: &[(&'static str, Option<f64>)], areas: &[f64]) -> Leaf {
    let row = |(key, value): &(&'static str, Option<f64>)| Row {
        key,
        part: None,
        value: *value,
        unit: "",
        definition: definition(key),
    };
    let samples = (!areas.is_empty()).then(|| Values {
        kind: "areole_area",
        unit: "mm²",
        numbers: areas.to_vec(),
    });
    Leaf {
        name: format!("<{group}&{number}>"),
        group,
        given: format!("{number}.svg"),
        nodes: 2,
        edges: 1,
        areoles: areas.len(),
        area_mm2: None,
        rows: rows.iter().map(row).collect(),
        samples: samples.into_iter().collect(),
        remarks: Vec::new(),
        shown: None,
    }
}

fn findings(groups: &[&str], leaves: Vec<Leaf>) -> Findings {
    let groups = groups.iter().map(|name| (*name).to_owned()).collect();
    let wanted = Wanted {
        title: Some("a test".to_owned()),
        seed: 1,
        ..Wanted::default()
    };
    Findings::new(groups, leaves, wanted).expect("leaves differ")
}

/// Every output, none of which may hold what is no number.
fn all_outputs(findings: &Findings) -> [String; 5] {
    let outputs = [
        html::html(findings, None, false).expect("nothing is drawn over each other"),
        csv::csv(findings),
        csv::values(findings),
        format!("{:#}", json::json(findings)),
        words::text(findings),
    ];
    for output in &outputs {
        let mut words = output.split(|letter: char| !letter.is_alphanumeric());
        assert!(
            !words.any(|word| word == "NaN" || word == "inf"),
            "{output}"
        );
    }
    outputs
}

#[test]
fn what_a_group_lacks_or_all_leaves_share_is_not_tested_and_no_test_is_counted() {
    let of = |value: f64, missing: Option<f64>| {
        [
            ("areole_count", Some(value)),
            ("loop_nesting", missing),
            ("length_mm", Some(70.0)),
            ("solidity", None),
        ]
    };
    let leaves = vec![
        leaf(0, 1, &of(30.0, Some(0.5)), &[1.0, 2.0, 4.0]),
        leaf(0, 2, &of(33.0, Some(0.6)), &[1.5, 2.5]),
        leaf(1, 3, &of(20.0, None), &[5.0, 6.0]),
        leaf(1, 4, &of(22.0, None), &[]),
    ];
    let findings = findings(&["near", "far"], leaves);
    let told: Vec<(&str, Option<&str>)> = findings
        .compared
        .measures
        .iter()
        .map(|measure| (measure.key, measure.contrasts[0].untested))
        .collect();
    let wanted = [
        ("areole_count", None),
        ("loop_nesting", Some("missing in a group")),
        ("length_mm", Some("the same in all leaves")),
    ];
    assert_eq!(told, wanted);
    assert_eq!(findings.compared.absent, ["solidity"]);
    assert_eq!(findings.compared.tests[..2], [1, 1]);
    // One test: nothing to correct.
    let tested = findings.compared.measures[0].contrasts[0]
        .means()
        .expect("a test");
    assert_eq!((tested.p, tested.p), (tested.holm, tested.fdr));
    // The leaf without areoles is no leaf of the distribution, and one leaf alone is not permuted.
    let spread = &findings.compared.distributions[0];
    assert_eq!((spread.leaves[1].len(), spread.counts[1]), (1, 2));
    assert_eq!(
        spread.contrasts[0]
            .leaves_permuted
            .and_then(|test| test.tested),
        None
    );
    let [html, csv, values, ..] = all_outputs(&findings);
    assert!(
        html.contains("&lt;0&amp;1&gt;") && !html.contains("<0&"),
        "names are no markup"
    );
    assert!(csv.contains("missing in a group"));
    // Four leaves with four measures each.
    assert_eq!(values.lines().count(), 17);
    let few = "with 2 and 2 leaves the test of Mann and Whitney cannot give a p below 0.33";
    assert!(
        findings.notes.iter().any(|note| note.contains(few)),
        "{:?}",
        findings.notes
    );
}

#[test]
fn corrections_count_the_tests_of_all_pairs() {
    let of = |group, number, value: f64| leaf(group, number, &[("areole_count", Some(value))], &[]);
    let leaves = (0..12).map(|number| {
        let group = number / 4;
        of(group, number, 10.0 * group as f64 + (3 * number % 4) as f64)
    });
    let findings = findings(&["a", "b", "c"], leaves.collect());
    assert_eq!(findings.compared.pairs, [[0, 1], [0, 2]]);
    assert_eq!(findings.compared.tests, [2, 2, 0]);
    let [near, far] = [0, 1].map(|pair| {
        let contrast = &findings.compared.measures[0].contrasts[pair];
        contrast.means().expect("groups of four")
    });
    // The smaller p times two, the other as it is.
    assert!(far.p < near.p);
    assert!((far.holm - 2.0 * far.p).abs() < 1e-15 && near.holm == near.p);
    all_outputs(&findings);
}

#[test]
fn one_leaf_is_tested_among_those_of_a_group_and_two_leaves_are_not() {
    let of = |group, number, value: f64| {
        leaf(
            group,
            number,
            &[("areole_count", Some(value))],
            &[value, value + 1.0],
        )
    };
    let among = findings(
        &["real", "grown"],
        vec![of(0, 1, 8.0), of(1, 2, 1.0), of(1, 3, 3.0), of(1, 4, 5.0)],
    );
    let contrast = &among.compared.measures[0].contrasts[0];
    // (8 − 3) / (2 √(1 + 1/3)) with 2 degrees of freedom.
    let t = contrast.one_among_others.expect("a group").found.t;
    assert!(
        (t - 5.0 / (2.0 * (4.0_f64 / 3.0).sqrt())).abs() < 1e-12,
        "{t}"
    );
    assert!(contrast.welch.is_none() && contrast.means().is_some() && contrast.orders().is_none());
    let [_, csv, .., text] = all_outputs(&among);
    assert!(text.contains("one among p"), "{text}");
    assert!(
        csv.lines().any(|line| line.contains("areole_count")),
        "{csv}"
    );
    let two = findings(&["a", "b"], vec![of(0, 1, 8.0), of(1, 2, 1.0)]);
    let contrast = &two.compared.measures[0].contrasts[0];
    assert_eq!(contrast.untested, Some("one leaf each"));
    assert_eq!(
        (contrast.difference, contrast.ratio),
        (Some(-7.0), Some(0.125))
    );
    // Two values each, all of the first larger: 2 of 6 divisions.
    let steps = two.compared.distributions[0].contrasts[0]
        .as_if_independent
        .kolmogorov_smirnov
        .and_then(|test| test.tested)
        .expect("values");
    assert!((steps.p - 2.0 / 6.0).abs() < 1e-15, "{steps:?}");
    all_outputs(&two);
}

#[test]
fn leaves_that_are_the_same_are_reported() {
    let of = |group, number, value: f64| leaf(group, number, &[("areole_count", Some(value))], &[]);
    let leaves = [of(0, 1, 3.0), of(0, 2, 4.0), of(1, 3, 3.0)];
    assert_eq!(same(&leaves), [[0, 2]]);
}
