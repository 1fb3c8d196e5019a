//! The unit of each measure and what it is, in one phrase, for tables.

/// Keys, units if they have any, and definitions of measures, then those of kinds of single values,
/// in the order of tables.
const DEFINITIONS: &str = include_str!("definitions.txt");

fn all() -> impl Iterator<Item = [&'static str; 3]> {
    DEFINITIONS.lines().filter_map(|line| {
        let (name, definition) = line.split_once(": ")?;
        let (key, unit) = name.split_once(' ').unwrap_or((name, ""));
        Some([key, unit, definition])
    })
}

/// Keys of measures, and of kinds of single values.
pub fn keys() -> impl Iterator<Item = &'static str> {
    all().map(|[key, ..]| key)
}

/// What a measure or a kind of single values is, in one phrase; empty for a key that there is not.
pub fn definition(key: &str) -> &'static str {
    let found = all().find(|[known, ..]| *known == key);
    found.map_or("", |[_, _, definition]| definition)
}

/// The unit of a measure or a kind of single values; empty for a number without one.
pub(super) fn unit(key: &str) -> &'static str {
    let found = all().find(|[known, ..]| *known == key);
    found.map_or("", |[_, unit, _]| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_of_measures_names_each_of_them() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/measures.md");
        let page = std::fs::read_to_string(page).expect("the book is part of the repository");
        assert_eq!(all().count(), DEFINITIONS.lines().count());
        for [key, _, definition] in all() {
            // A row may name several by their ends: `areole_area_mm2_mean`, `_median`.
            let stem = key.rsplit_once('_').map_or(key, |(stem, _)| stem);
            let end = &key[stem.len()..];
            let together =
                page.contains(&format!("`{stem}_")) && page.contains(&format!("`{end}`"));
            let in_formula = page.contains(&format!("\\text{{{}}}", key.replace('_', "\\\\_")));
            assert!(
                page.contains(&format!("`{key}`")) || together || in_formula,
                "{key} is not on the page"
            );
            assert!(!definition.is_empty(), "{key}");
        }
    }
}
