//! The description of a preset and the sources of its numbers.

use leafmodel::species;
use leafmodel::species::colours::{ColouredLeaf, coloured};
use leafmodel::species::diagnosis::Finding;
use leafmodel::species::leaf_traits::{LeafTraits, Provenance, Quantity, traits};

use super::choice::{is_word, unknown_preset};
use crate::cli::arguments::file_and_leaf;
use crate::cli::{Failure, say};
use crate::report::table::in_columns;

/// Prints a preset's description and, if it stands for a species, the table of its traits.
pub(super) fn tell(name: &str) -> Result<(), Failure> {
    let (path, _) = file_and_leaf(name);
    let preset = species::find(name).ok_or_else(|| {
        if is_word(name) && !path.exists() {
            unknown_preset(name)
        } else {
            Failure::bad(format!(
                "--about tells of presets, and `{}` is a file's name (`lamina grow --list` names the presets)",
                name.escape_debug()
            ))
        }
    })?;
    say(preset.name);
    say(format!("  {}", preset.about));
    say(format!("  source: {}", preset.source));
    if let Some(traits) = traits(preset.name) {
        say(table(traits.species, green(traits)));
    }
    if let Some(leaf) = coloured(preset.name) {
        say(table(leaf.species, in_colour(leaf)));
    }
    Ok(())
}

/// Trait, value, range, provenance.
type Row = [String; 4];

fn row(name: &str, unit: &str, q: Quantity) -> Row {
    let value = with_unit(&number(q.value), unit);
    [name.to_owned(), value, range(q.range), told(q.from)]
}

/// The traits of a leaf in summer.
fn green(traits: &LeafTraits) -> Vec<Row> {
    let values = traits
        .quantities()
        .map(|(name, unit, q)| row(name, unit, q));
    let spans = traits.spans().map(|(name, unit, span)| {
        let value = if unit.is_empty() {
            "as drawn".to_owned()
        } else {
            format!("as drawn, {unit}")
        };
        [name.to_owned(), value, range(span.range), told(span.from)]
    });
    values.into_iter().chain(spans).collect()
}

/// The traits of the green leaf, then what differs.
fn in_colour(leaf: &ColouredLeaf) -> Vec<Row> {
    let mut rows = green(leaf.green);
    let quantities = leaf.quantities().into_iter();
    rows.extend(quantities.map(|(name, unit, q)| row(&name, unit, q)));
    rows
}

/// The species, and rows with a heading.
fn table(species: &str, mut rows: Vec<Row>) -> String {
    rows.insert(0, ["trait", "value", "range", "from"].map(str::to_owned));
    format!("  {species}\n{}", in_columns(&rows))
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
            told(finding.from),
        ]
    };
    let heading = ["trait", "found", "range", "", "from"].map(str::to_owned);
    let rows: Vec<[String; 5]> = std::iter::once(heading)
        .chain(found.iter().map(row))
        .collect();
    in_columns(&rows)
}

fn told(from: Provenance) -> String {
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

    #[test]
    fn a_table_tells_value_range_and_source_of_each_trait() {
        let text = table("", green(traits("ginkgo").expect("a species")));
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
    fn a_leaf_in_colour_tells_of_its_green_before_what_differs() {
        let rows = in_colour(coloured("birch-autumn").expect("a leaf"));
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
