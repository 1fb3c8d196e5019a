//! The part of the report that says how it was done.

use super::cells::list;
use super::{Findings, leaves};
use crate::cli::arguments::CompareNetworksArguments;

/// Which tests stand in the report, and why.
pub(super) fn section(findings: &Findings, arguments: &CompareNetworksArguments) -> String {
    let [means, orders, spreads] = findings.compared.tests;
    let mut lines = vec![
        "Measures are those of <code>lamina measure</code>, with its definitions; differences are \
         the second less the first, ratios the second over the first."
            .to_owned(),
    ];
    if findings.is_single {
        lines.push(
            "One network each has no spread: measures are set side by side without a test."
                .to_owned(),
        );
        lines.push(format!(
            "Distributions are tested by Kolmogorov and Smirnov (any difference) and by Mann and \
             Whitney (which has the larger values), {spreads} tests each, of single values as if \
             they were independent. δ is Cliff's: the share of pairs in which the second value is \
             the larger one, less the share in which it is the smaller."
        ));
    } else {
        lines.push(
            "The leaf is the unit: each has one value of a measure, whatever the number of its \
             veins."
                .to_owned(),
        );
        lines.push(format!(
            "Means are compared by Welch's t-test, which does not take spreads as equal but means \
             of leaves as normal ({means} tests; where a group is one leaf, whether that leaf \
             belongs to the others, by the test of Crawford and Howell); ranks by the test of Mann \
             and Whitney, which needs no form of the distribution and counts all orders up to 50 \
             leaves ({orders} tests). \
             Look at one of them, chosen beforehand: Welch's for measures that spread evenly, the \
             other where single leaves stand far out."
        ));
        lines.push(
            "Hedges' g is the difference of means in pooled standard deviations, with its exact \
             correction for few leaves and an interval by the noncentral t-distribution; Cliff's δ \
             the share of pairs of leaves in which the second is larger, less that in which it is \
             smaller."
                .to_owned(),
        );
        lines.push(format!(
            "Distributions: the mean cumulative curves of both groups, and whole leaves changing \
             groups in all ways, or in 9,999 drawn ones where there are more than 20,000 (seed {}; \
             {spreads} tests).",
            arguments.seed
        ));
    }
    lines.push(
        "Each kind of test is corrected for the number of its tests in this report. Holm: the chance \
         that even one difference is told by accident stays below 5 % where all with p up to 0.05 \
         are told. FDR (Benjamini and Hochberg): of those that are told, 5 % are accidents on \
         average. Many measures say nearly the same, so both are rather too strict; name the few \
         that matter by <code>--only</code> before you look."
            .to_owned(),
    );
    lines.push(format!(
        "Not compared: {}.",
        leaves::LEFT_OUT
            .map(|key| format!("<code>{key}</code>"))
            .join(", ")
    ));
    list(lines.into_iter())
}
