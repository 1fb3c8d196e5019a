//! `mosaic.types`: types of cells as a file says them, by name.

use super::plan::CellType;
use crate::document::sections::Names;
use crate::document::values::rounded;
use crate::document::{Declared, DocumentError, Keys, Limits, MapOf, NamedList, Number};
use crate::optics::Contents;
use crate::optics::contents_keys::changed_contents;

/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;
const SHARE: Number = Number(Limits::closed(0.0, 1.0));

/// A type of cell as it is written.
#[derive(Declared)]
struct TypeKeys {
    name: String,
    /// Probability that an initial cell is of it; all types together 1.
    #[key("initial_share", required, 0.0..=1.0)]
    share: f64,
    /// Mean time between divisions.
    #[key("division_days", above(0.0, 1e6))]
    division_days: Option<f64>,
    /// A table from types to the probability that a child is of it; the type itself has the rest.
    #[key("switching", MapOf(SHARE))]
    switching: Vec<(String, f64)>,
    /// A table from types to α: 0 repels in full, 1 not at all; said once for a pair.
    #[key("adhesion", MapOf(SHARE))]
    adhesion: Vec<(String, f64)>,
    /// What differs from the leaf's `contents`.
    #[key("contents", block, with = changed_contents)]
    contents: Contents,
}

/// The types of cells with what each holds; returns their names. `base` is what cells hold where they say
/// nothing else.
pub(super) fn types(
    (types, contents): (&mut Vec<CellType>, &mut Vec<Contents>),
    keys: &mut Keys<'_>,
    base: Contents,
) -> Vec<String> {
    let row = |values: &[f64]| {
        let names = types.iter().map(|one| one.name.clone());
        let named = names.zip(values.iter().copied());
        named.filter(|(_, value)| *value != 0.0).collect()
    };
    let held = types.iter().zip(&*contents);
    let mut all: Vec<TypeKeys> = held
        .map(|(one, contents)| TypeKeys {
            name: one.name.clone(),
            share: one.initial_probability,
            division_days: one.division_days.is_finite().then_some(one.division_days),
            switching: row(&one.switching),
            adhesion: row(&one.adhesion),
            contents: *contents,
        })
        .collect();
    let list = NamedList {
        required: true,
        new: &|name: &str| TypeKeys {
            name: name.to_owned(),
            share: 0.0,
            division_days: None,
            switching: Vec::new(),
            adhesion: Vec::new(),
            contents: base,
        },
        name_of: |one: &TypeKeys| &one.name,
    };
    let about = "The types of cells.";
    keys.named("types", &mut all, &list, about, TypeKeys::declare);
    if keys.reader().is_some()
        && let Some(whole) = together(&all, keys)
    {
        *types = whole;
        *contents = all.iter().map(|one| one.contents).collect();
    }
    all.into_iter().map(|one| one.name).collect()
}

/// The types with their numbers for one another, or an error.
fn together(all: &[TypeKeys], keys: &Keys<'_>) -> Option<Vec<CellType>> {
    let names = Names::of_list("type of cell", all.iter().map(|one| one.name.as_str()));
    let mut whole = !all.is_empty() && keys.is_sound();
    let mut rows = |key: &str, values: fn(&TypeKeys) -> &[(String, f64)]| {
        let row = |one: &TypeKeys| {
            let mut row = vec![None; all.len()];
            for (name, value) in values(one) {
                match find(&names, keys, [&one.name, key, name]) {
                    Some(other) => row[other] = Some(*value),
                    None => whole = false,
                }
            }
            row
        };
        all.iter().map(row).collect::<Vec<Vec<Option<f64>>>>()
    };
    let switching = rows("switching", |one| &one.switching);
    // Adhesion is said once for each pair.
    let adhesion = rows("adhesion", |one| &one.adhesion);
    for (index, one) in all.iter().enumerate() {
        for (other, earlier) in all[..index].iter().enumerate() {
            if let (Some(value), Some(there)) = (adhesion[index][other], adhesion[other][index])
                && value != there
            {
                let problem = format!(
                    "adhesion to `{}` is {value} here and {there} there",
                    earlier.name
                );
                let help = "say it once, or the same in both";
                keys.refuse(&["types", &one.name, "adhesion"], problem, help);
                whole = false;
            }
        }
    }
    let switching = switching.into_iter().zip(all).enumerate();
    let switching: Vec<_> = switching
        .map(|(index, (row, one))| complete(index, &row, keys, &one.name))
        .collect();
    if !whole || switching.contains(&None) {
        return None;
    }
    let sum: f64 = all.iter().map(|one| one.share).sum();
    if (sum - 1.0).abs() > ROUNDING {
        let error = DocumentError::Impossible {
            key: "initial_share".to_owned(),
            problem: format!(
                "the initial shares of the types sum to {}, not to 1",
                rounded(sum)
            ),
            help: "change them so that they sum to 1".to_owned(),
        };
        keys.report(&["types"], error);
        return None;
    }
    let types = all.iter().zip(switching).enumerate();
    let types = types.map(|(index, (one, switching))| CellType {
        name: one.name.clone(),
        division_days: one.division_days.unwrap_or(f64::INFINITY),
        initial_probability: one.share,
        switching: switching.unwrap_or_default(),
        adhesion: (0..all.len())
            .map(|other| adhesion[index][other].or(adhesion[other][index]))
            .map(Option::unwrap_or_default)
            .collect(),
    });
    Some(types.collect())
}

/// The number of the type that a row names.
fn find(names: &Names, keys: &Keys<'_>, [own, row, name]: [&str; 3]) -> Option<usize> {
    if let Some(index) = names.index_of(name) {
        return Some(index);
    }
    let block = keys.reader()?;
    let mut table = Some(block.table);
    for key in ["types", own, row] {
        table = table.and_then(|table| table.get(key)?.node.table());
    }
    let entry = table.and_then(|table| table.get(name));
    let at = entry.map_or(&block.at, |entry| &entry.key_at);
    names.find(block.cx, (name, at))
}

/// Probabilities of a child's type; what is not said is that it is its parent's.
fn complete(own: usize, said: &[Option<f64>], keys: &Keys<'_>, name: &str) -> Option<Vec<f64>> {
    let mut row: Vec<f64> = said.iter().map(|value| value.unwrap_or(0.0)).collect();
    let sum: f64 = row.iter().sum();
    if said[own].is_none() && sum <= 1.0 {
        row[own] = 1.0 - sum;
        return Some(row);
    }
    if (sum - 1.0).abs() <= ROUNDING {
        return Some(row);
    }
    let problem = format!("its probabilities sum to {}, not to 1", rounded(sum));
    let help = "change them so that they sum to 1, or leave the type itself out: it gets the rest";
    keys.refuse(&["types", name, "switching"], problem, help);
    None
}
