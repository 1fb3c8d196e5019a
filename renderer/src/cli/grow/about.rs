//! The description of a preset and the sources of its numbers.

use leafmodel::species;
use leafmodel::species::diagnosis::Finding;
use leafmodel::species::traits::{Provenance, Quantity, Traits};

use super::choice::{is_word, unknown_preset};
use crate::cli::arguments::file_and_leaf;
use crate::cli::terminal::{Failure, say};
use crate::report::table::in_columns;

/// Prints a preset's description and, if it stands for a species, the table of its traits.
pub(super) fn tell(name: &str) -> Result<(), Failure> {
    let (path, _) = file_and_leaf(name);
    let preset = species::find(name).ok_or_else(|| {
        if is_word(name) && !path.exists() {
            unknown_preset(name)
        } else {
            bad!(
                "--about tells of presets, and `{}` is a file's name (`lamina grow --list` names the presets)",
                name.escape_debug()
            )
        }
    })?;
    say(preset.name);
    say(format!("  {}", preset.about()));
    say(format!("  source: {}", preset.source()));
    if let Some(traits) = preset.traits() {
        say(table(traits));
    }
    Ok(())
}

/// Trait, value, range, provenance.
type AboutRow = [String; 4];

fn row(quantity: &Quantity) -> AboutRow {
    let Quantity { name, unit, .. } = quantity;
    let value = match quantity.value {
        Some(value) => with_unit(&number(value), unit),
        None if unit.is_empty() => "as drawn".to_owned(),
        None => format!("as drawn, {unit}"),
    };
    [
        name.clone(),
        value,
        range(quantity.range),
        told(&quantity.from),
    ]
}

/// The species, and rows with a heading: the traits of the leaf in summer, then what differs.
fn table(traits: &Traits) -> String {
    let rows = in_columns(["trait", "value", "range", "from"], rows(traits));
    format!("  {}\n{rows}", traits.species)
}

fn rows(traits: &Traits) -> impl Iterator<Item = AboutRow> {
    traits.summer.iter().chain(&traits.differs).map(row)
}

/// What was found on a grown leaf beside what is known of its species.
pub(super) fn findings_table(found: &[Finding]) -> String {
    let row = |finding: &Finding| {
        let verdict = if finding.is_in() { "in" } else { "out" };
        [
            finding.name.to_owned(),
            with_unit(&number(finding.found), finding.unit),
            range(finding.range),
            verdict.to_owned(),
            told(&finding.from),
        ]
    };
    in_columns(
        ["trait", "found", "range", "", "from"],
        found.iter().map(row),
    )
}

fn told(from: &Provenance) -> String {
    format!("{}: {}", from.word(), from.words())
}

fn range([low, high]: [f64; 2]) -> String {
    format!("{} to {}", number(low), number(high))
}

fn with_unit(value: &str, unit: &str) -> String {
    format!("{value} {unit}").trim_end().to_owned()
}

/// Four significant digits without trailing zeros.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let whole_digits = libm::floor(libm::log10(value.abs())) as i32 + 1;
    let decimals = usize::try_from(4 - whole_digits).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn traits(name: &str) -> &'static Traits {
        let preset = species::find(name).expect("a preset");
        preset.traits().expect("a species")
    }

    #[test]
    fn a_table_lists_value_range_and_source_of_each_trait() {
        let text = table(traits("ginkgo"));
        let chlorophyll = text
            .lines()
            .find(|line| line.trim_start().starts_with("chlorophyll"));
        let row = chlorophyll.expect("it has a row");
        for part in [
            "48 µg/cm²",
            "43.5 to 77",
            "measured: ",
            "[lichtenthaler2023]",
        ] {
            assert!(row.contains(part), "{part} is not in {row}");
        }
    }

    #[test]
    fn a_leaf_in_colour_reports_its_green_before_what_differs() {
        let rows: Vec<AboutRow> = rows(traits("birch-autumn")).collect();
        let at = |name: &str| rows.iter().position(|row| row[0] == name);
        let (green, turned) = (at("chlorophyll"), at("turned: chlorophyll"));
        assert!(green.expect("it has a row") < turned.expect("it has a row"));
        let brown = &rows[at("turned: brown").expect("it has a row")];
        assert_eq!(brown[1], "0.33");
        assert!(brown[3].ends_with("[noda2014]"), "{}", brown[3]);
        assert_eq!(rows[at("day").expect("it has a row")][1], "24 days");
    }

    #[test]
    fn numbers_have_four_digits_and_no_empty_ones() {
        let told = [0.0088, 120.0, 14.006, 0.130_64, 1500.0].map(number);
        assert_eq!(told, ["0.0088", "120", "14.01", "0.1306", "1500"]);
    }
}
