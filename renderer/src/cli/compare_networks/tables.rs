//! What was found as CSV.

use csv::Writer;
use leafmodel::measure::comparison::Effect;

use super::Findings;
use super::compared::{Distribution, Measure, Tested};
use crate::cli::Failure;

/// Columns of the table of all numbers.
const COLUMNS: [&str; 55] = [
    "of",
    "measure",
    "part",
    "unit",
    "first",
    "second",
    "first_count",
    "second_count",
    "first_mean",
    "second_mean",
    "first_sd",
    "second_sd",
    "first_low",
    "first_high",
    "second_low",
    "second_high",
    "first_median",
    "second_median",
    "difference",
    "difference_low",
    "difference_high",
    "ratio",
    "hedges_g",
    "hedges_g_low",
    "hedges_g_high",
    "cliffs_delta",
    "cliffs_delta_low",
    "cliffs_delta_high",
    "welch_t",
    "welch_df",
    "welch_p",
    "welch_p_holm",
    "welch_p_fdr",
    "among_t",
    "among_df",
    "among_p",
    "among_p_holm",
    "among_p_fdr",
    "mann_whitney_u",
    "mann_whitney_p",
    "mann_whitney_p_holm",
    "mann_whitney_p_fdr",
    "mann_whitney_exact",
    "leafwise_distance",
    "leafwise_p",
    "leafwise_p_holm",
    "leafwise_p_fdr",
    "leafwise_exact",
    "ks_distance",
    "ks_p",
    "ks_p_holm",
    "ks_p_fdr",
    "ks_exact",
    "untested",
    "definition",
];

/// A row of the table, by column.
#[derive(Default)]
struct Cells(Vec<(&'static str, String)>);

impl Cells {
    fn text(&mut self, column: &'static str, text: impl Into<String>) {
        self.0.push((column, text.into()));
    }

    fn number(&mut self, column: &'static str, number: Option<f64>) {
        if let Some(number) = number {
            self.0.push((column, number.to_string()));
        }
    }

    fn tested(&mut self, columns: [&'static str; 3], tested: Option<Tested>) {
        let values = tested.map(|tested| [tested.p, tested.holm, tested.fdr]);
        for (place, column) in columns.into_iter().enumerate() {
            self.number(column, values.map(|values| values[place]));
        }
    }

    fn effect(&mut self, columns: [&'static str; 3], effect: Option<Effect>) {
        self.number(columns[0], effect.map(|effect| effect.value));
        self.number(columns[1], effect.map(|effect| effect.interval[0]));
        self.number(columns[2], effect.map(|effect| effect.interval[1]));
    }

    fn record(&self) -> Vec<&str> {
        let cell = |column: &&str| {
            let found = self.0.iter().find(|(known, _)| known == column);
            found.map_or("", |(_, text)| text.as_str())
        };
        COLUMNS.iter().map(cell).collect()
    }
}

/// A row for each measure, and each kind of single values, of each pair.
pub(super) fn csv(findings: &Findings) -> Result<Vec<u8>, Failure> {
    let mut table = Writer::from_writer(Vec::new());
    let told = |error: csv::Error| Failure::system(error);
    table.write_record(COLUMNS).map_err(told)?;
    for (number, pair) in findings.compared.pairs.iter().enumerate() {
        let names = pair.map(|group| findings.groups[group].clone());
        for measure in &findings.compared.measures {
            let cells = measure_cells(measure, number, *pair, &names);
            table.write_record(cells.record()).map_err(told)?;
        }
        for distribution in &findings.compared.distributions {
            let cells = distribution_cells(distribution, number, *pair, &names);
            table.write_record(cells.record()).map_err(told)?;
        }
    }
    table.into_inner().map_err(Failure::system)
}

fn measure_cells(measure: &Measure, number: usize, pair: [usize; 2], names: &[String; 2]) -> Cells {
    let mut cells = Cells::default();
    cells.text("of", "leaves");
    cells.text("measure", measure.key);
    cells.text(
        "part",
        measure
            .part
            .map(|part| part.to_string())
            .unwrap_or_default(),
    );
    cells.text("unit", measure.unit);
    cells.text("definition", measure.definition);
    let columns = [
        [
            "first",
            "first_count",
            "first_mean",
            "first_sd",
            "first_low",
            "first_high",
            "first_median",
        ],
        [
            "second",
            "second_count",
            "second_mean",
            "second_sd",
            "second_low",
            "second_high",
            "second_median",
        ],
    ];
    for ((columns, name), group) in columns.into_iter().zip(names).zip(pair) {
        let [who, count, mean, sd, low, high, median] = columns;
        let summary = measure.summaries[group];
        cells.text(who, name.as_str());
        cells.text(count, measure.values[group].len().to_string());
        cells.number(mean, summary.map(|summary| summary.mean));
        cells.number(sd, summary.and_then(|summary| summary.deviation));
        cells.number(low, summary.and_then(|summary| Some(summary.interval?[0])));
        cells.number(high, summary.and_then(|summary| Some(summary.interval?[1])));
        cells.number(median, summary.map(|summary| summary.median));
    }
    let contrast = measure.contrasts[number];
    cells.number("difference", contrast.difference);
    cells.number(
        "difference_low",
        contrast.welch.map(|welch| welch.interval[0]),
    );
    cells.number(
        "difference_high",
        contrast.welch.map(|welch| welch.interval[1]),
    );
    cells.number("ratio", contrast.ratio);
    cells.effect(["hedges_g", "hedges_g_low", "hedges_g_high"], contrast.g);
    let columns = ["cliffs_delta", "cliffs_delta_low", "cliffs_delta_high"];
    cells.effect(columns, contrast.delta);
    cells.number("welch_t", contrast.welch.map(|welch| welch.t));
    cells.number("welch_df", contrast.welch.map(|welch| welch.freedom));
    let welch = contrast.welch.and(contrast.means);
    cells.tested(["welch_p", "welch_p_holm", "welch_p_fdr"], welch);
    cells.number("among_t", contrast.among.map(|among| among.t));
    cells.number("among_df", contrast.among.map(|among| among.freedom));
    let among = contrast.among.and(contrast.means);
    cells.tested(["among_p", "among_p_holm", "among_p_fdr"], among);
    cells.number("mann_whitney_u", contrast.ranks.map(|ranks| ranks.u));
    cells.tested(ORDERS, contrast.orders);
    let exact = contrast.ranks.map(|ranks| ranks.exact.to_string());
    cells.text("mann_whitney_exact", exact.unwrap_or_default());
    cells.text("untested", contrast.untested.unwrap_or_default());
    cells
}

const ORDERS: [&str; 3] = [
    "mann_whitney_p",
    "mann_whitney_p_holm",
    "mann_whitney_p_fdr",
];

fn distribution_cells(
    distribution: &Distribution,
    number: usize,
    pair: [usize; 2],
    names: &[String; 2],
) -> Cells {
    let mut cells = Cells::default();
    cells.text("of", "single values");
    cells.text("measure", distribution.kind);
    cells.text("unit", distribution.unit);
    cells.text("definition", distribution.definition);
    let columns = [
        ["first", "first_count", "first_median"],
        ["second", "second_count", "second_median"],
    ];
    for (([who, count, median], name), group) in columns.into_iter().zip(names).zip(pair) {
        cells.text(who, name.as_str());
        cells.text(count, distribution.counts[group].to_string());
        cells.number(median, distribution.medians[group]);
    }
    let contrast = distribution.contrasts[number];
    let columns = ["cliffs_delta", "cliffs_delta_low", "cliffs_delta_high"];
    cells.number(columns[0], contrast.delta.map(|effect| effect.value));
    if contrast.orders.is_some() {
        cells.effect(columns, contrast.delta);
    }
    let medians = pair.map(|group| distribution.medians[group]);
    cells.number("difference", medians[0].zip(medians[1]).map(|(a, b)| b - a));
    cells.number("ratio", ratio(medians));
    cells.number(
        "leafwise_distance",
        contrast.leafwise.map(|found| found.distance),
    );
    cells.tested(
        ["leafwise_p", "leafwise_p_holm", "leafwise_p_fdr"],
        contrast.permuted,
    );
    let exact = contrast
        .permuted
        .and(contrast.leafwise)
        .map(|found| found.exact.to_string());
    cells.text("leafwise_exact", exact.unwrap_or_default());
    cells.number("ks_distance", contrast.pooled.map(|steps| steps.distance));
    cells.tested(["ks_p", "ks_p_holm", "ks_p_fdr"], contrast.steps);
    let exact = contrast
        .steps
        .and(contrast.pooled)
        .map(|steps| steps.exact.to_string());
    cells.text("ks_exact", exact.unwrap_or_default());
    cells.number("mann_whitney_u", contrast.ranks.map(|ranks| ranks.u));
    cells.tested(ORDERS, contrast.orders);
    let exact = contrast.ranks.map(|ranks| ranks.exact.to_string());
    cells.text("mann_whitney_exact", exact.unwrap_or_default());
    cells.text("untested", contrast.untested.unwrap_or_default());
    cells
}

/// The second over the first, if both have one sign.
pub(super) fn ratio([first, second]: [Option<f64>; 2]) -> Option<f64> {
    let (first, second) = (first?, second?);
    (first * second > 0.0).then(|| second / first)
}

/// A row for each measure of each leaf.
pub(super) fn values(findings: &Findings) -> Result<Vec<u8>, Failure> {
    let mut table = Writer::from_writer(Vec::new());
    let told = |error: csv::Error| Failure::system(error);
    let header = ["group", "leaf", "file", "measure", "part", "value", "unit"];
    table.write_record(header).map_err(told)?;
    for leaf in &findings.leaves {
        for row in &leaf.rows {
            let part = row.part.map(|part| part.to_string()).unwrap_or_default();
            let value = row.value.map(|value| value.to_string()).unwrap_or_default();
            let record = [
                findings.groups[leaf.group].as_str(),
                &leaf.name,
                &leaf.given,
                row.key,
                &part,
                &value,
                row.unit,
            ];
            table.write_record(record).map_err(told)?;
        }
    }
    table.into_inner().map_err(Failure::system)
}
