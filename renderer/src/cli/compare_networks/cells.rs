//! Pieces of the report: cells of tables and words, as HTML.

use super::Findings;
use super::compared::Tested;
use super::page::hue;
use super::words::shown_p;
use crate::plot::escaped;

/// What stands where there is nothing.
pub(super) const DASH: &str = "–";

/// A group's name beside its hue.
pub(super) fn key(findings: &Findings, group: usize) -> String {
    let name = escaped(&findings.groups[group]);
    format!("<span class=\"key b{}\"></span>{name}", hue(group))
}

pub(super) fn pair_title(findings: &Findings, pair: [usize; 2]) -> String {
    let [one, other] = pair.map(|group| key(findings, group));
    format!("{other} against {one}")
}

/// A sentence that begins with a capital letter.
pub(super) fn capital(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

pub(super) fn three(value: Option<f64>) -> String {
    value.map_or_else(|| DASH.to_owned(), |value| format!("{value:.3}"))
}

/// p, and p after both corrections.
pub(super) fn shown_tests(tested: Option<Tested>) -> [String; 3] {
    let cell = |p: f64| escaped(&shown_p(p));
    tested.map_or_else(
        || [DASH, DASH, DASH].map(str::to_owned),
        |tested| [tested.p, tested.holm, tested.fdr].map(cell),
    )
}

pub(super) fn unit_words(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(", in {}", escaped(unit))
    }
}

/// Items that are HTML already; nothing without any.
pub(super) fn list(items: impl Iterator<Item = String>) -> String {
    let items: String = items.map(|item| format!("<li>{item}</li>\n")).collect();
    if items.is_empty() {
        return items;
    }
    format!("<ul class=\"small\">\n{items}</ul>\n")
}
