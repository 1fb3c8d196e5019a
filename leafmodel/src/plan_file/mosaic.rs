//! `mosaic`: cells of several types, and what each holds.

use glam::DVec3;

use super::control::{self, control};
use crate::document::declared::{Declared, Words};
use crate::document::error::DocumentError;
use crate::document::keys::{Keys, NamedList};
use crate::document::limits::Limits;
use crate::document::sections::Names;
use crate::document::tree::Entry;
use crate::document::value_kind::{MapOf, Number, Vector, Word};
use crate::document::values::rounded;
use crate::mosaic::control::CylinderControl;
use crate::mosaic::growth::{GrowthCourse, SurfaceGrowth};
use crate::mosaic::pattern::{LeafFaces, MosaicPattern};
use crate::mosaic::plan::{CellType, MosaicPlan};
use crate::optics::Contents;
use crate::optics::contents_keys::changed_contents;

/// Width of the blend between unlike cells where nothing is said, mm.
const BLEND_MM: f64 = 0.2;
/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;
const SHARE: Number = Number(Limits::closed(0.0, 1.0));

/// A mosaic of which nothing is said.
pub(super) fn usual() -> MosaicPattern {
    MosaicPattern {
        plan: MosaicPlan {
            types: Vec::new(),
            ..MosaicPlan::default()
        },
        contents: Vec::new(),
        blend_mm: BLEND_MM,
        faces: LeafFaces::Through,
    }
}

/// The keys of `mosaic`. `base` is what cells hold where they say nothing else.
pub(super) fn mosaic(pattern: &mut MosaicPattern, keys: &mut Keys<'_>, base: Contents) {
    pattern.plan.declare(keys);
    let limits = Number(Limits::closed(0.0, 100.0));
    let about = "Width over which unlike cells blend.";
    keys.key("blend_mm", &mut pattern.blend_mm, limits, about);
    let about = "Whether the pattern goes through the blade, or each face has cells of its own, \
        joined at the margin; the leaf then holds the mean of the two.";
    keys.key("faces", &mut pattern.faces, Word(Words::WORDS), about);
    let names = types(pattern, keys, base);
    controls(&mut pattern.plan.controls, keys, &names);
    growth(&mut pattern.plan.growth, keys);
}

/// `growth`; left out, the surface has its size from the start.
fn growth(growth: &mut SurfaceGrowth, keys: &mut Keys<'_>) {
    let mut grown = match *growth {
        SurfaceGrowth::None => None,
        SurfaceGrowth::Anisotropic { start, course } => Some((start, course)),
    };
    let new = || (DVec3::ONE, GrowthCourse::Linear);
    let about = "`start = [x, y, z]`, 0.01 to 10: size at the start over the final size; \
        `middle` (0 to 1) and `steepness` (1 to 100) make it logistic. Cells then divide as fast \
        as the surface makes room.";
    keys.optional_block("growth", &mut grown, new, about, |(start, course), keys| {
        let limits = Vector(Limits::closed(0.01, 10.0));
        let about = "Size at the start over the final size, along x, y and z.";
        keys.required("start", start, limits, about);
        let (mut middle, mut steepness) = match *course {
            GrowthCourse::Linear => (None, None),
            GrowthCourse::Logistic { middle, steepness } => (Some(middle), Some(steepness)),
        };
        let about = "When growth is fastest, as a share of the days; 0.5 beside a steepness.";
        keys.optional("middle", &mut middle, SHARE, about);
        let limits = Number(Limits::closed(1.0, 100.0));
        let about = "How sudden it is; 8 beside a middle.";
        keys.optional("steepness", &mut steepness, limits, about);
        *course = if middle.is_none() && steepness.is_none() {
            GrowthCourse::Linear
        } else {
            GrowthCourse::Logistic {
                middle: middle.unwrap_or(0.5),
                steepness: steepness.unwrap_or(8.0),
            }
        };
    });
    *growth = match grown {
        None => SurfaceGrowth::None,
        Some((start, course)) => SurfaceGrowth::Anisotropic { start, course },
    };
}

fn controls(controls: &mut Vec<CylinderControl>, keys: &mut Keys<'_>, types: &[String]) {
    let mut named: Vec<(String, CylinderControl)> = std::mem::take(controls)
        .into_iter()
        .zip(1..)
        .map(|(control, number)| (format!("control-{number}"), control))
        .collect();
    let list = NamedList {
        required: false,
        new: &|name: &str| (name.to_owned(), control::usual()),
        name_of: |(name, _): &(String, CylinderControl)| name,
    };
    let about = "Images round cylinders that steer cells.";
    keys.named("controls", &mut named, &list, about, |(_, one), keys| {
        control(one, keys, types);
    });
    *controls = named.into_iter().map(|(_, control)| control).collect();
}

/// A type of cell as it is written.
struct TypeKeys {
    name: String,
    share: f64,
    division_days: Option<f64>,
    /// By the names of other types.
    switching: Vec<(String, f64)>,
    adhesion: Vec<(String, f64)>,
    contents: Contents,
}

/// The types of cells; gives their names.
fn types(pattern: &mut MosaicPattern, keys: &mut Keys<'_>, base: Contents) -> Vec<String> {
    let names: Vec<String> = pattern
        .plan
        .types
        .iter()
        .map(|one| one.name.clone())
        .collect();
    let row = |values: &[f64]| {
        let named = names.iter().cloned().zip(values.iter().copied());
        named.filter(|(_, value)| *value != 0.0).collect::<Vec<_>>()
    };
    let held = pattern.plan.types.iter().zip(&pattern.contents);
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
    keys.named("types", &mut all, &list, about, |one, keys| {
        let about = "Probability that an initial cell is of it; all types together 1.";
        keys.required("initial_share", &mut one.share, SHARE, about);
        let limits = Number(Limits::above(0.0, 1e6));
        let about = "Mean time between divisions.";
        keys.optional("division_days", &mut one.division_days, limits, about);
        let about = "A table from types to the probability that a child is of it; the type \
            itself has the rest.";
        keys.key("switching", &mut one.switching, MapOf(SHARE), about);
        let about =
            "A table from types to α: 0 repels in full, 1 not at all; said once for a pair.";
        keys.key("adhesion", &mut one.adhesion, MapOf(SHARE), about);
        let about = "What differs from the leaf's `contents`.";
        let held = &mut one.contents;
        keys.block("contents", about, |keys| changed_contents(held, keys));
    });
    let names = all.iter().map(|one| one.name.clone()).collect();
    if keys.reader().is_some()
        && let Some((types, contents)) = together(&all, keys)
    {
        pattern.plan.types = types;
        pattern.contents = contents;
    }
    names
}

/// The types with their numbers for one another, or an error.
fn together(all: &[TypeKeys], keys: &Keys<'_>) -> Option<(Vec<CellType>, Vec<Contents>)> {
    let names = Names::of_list("type of cell", all.iter().map(|one| one.name.as_str()));
    let count = all.len();
    let mut whole = count > 0 && keys.is_sound();
    // Adhesion is said once for each pair.
    let mut adhesion: Vec<Vec<Option<f64>>> = vec![vec![None; count]; count];
    let mut types = Vec::new();
    for (index, one) in all.iter().enumerate() {
        let mut switching = vec![None; count];
        for (row, key, values) in [
            (&mut switching, "switching", &one.switching),
            (&mut vec![None; count], "adhesion", &one.adhesion),
        ] {
            for (name, value) in values {
                match find(&names, keys, [&one.name, key, name]) {
                    Some(other) => row[other] = Some(*value),
                    None => whole = false,
                }
            }
            if key == "adhesion" {
                for (other, value) in row.iter().enumerate() {
                    let there = adhesion[other][index];
                    if let (Some(value), Some(there)) = (value, there)
                        && *value != there
                    {
                        let problem = format!(
                            "adhesion to `{}` is {value} here and {there} there",
                            all[other].name
                        );
                        let help = "say it once, or the same in both";
                        keys.refuse(&["types", &one.name, key], problem, help);
                        whole = false;
                    }
                    adhesion[index][other] = *value;
                }
            }
        }
        let switching = complete(index, &switching, keys, &one.name);
        whole &= switching.is_some();
        types.push(CellType {
            name: one.name.clone(),
            division_days: one.division_days.unwrap_or(f64::INFINITY),
            initial_probability: one.share,
            switching: switching.unwrap_or_default(),
            adhesion: Vec::new(),
        });
    }
    if !whole {
        return None;
    }
    for (index, one) in types.iter_mut().enumerate() {
        one.adhesion = (0..count)
            .map(|other| adhesion[index][other].or(adhesion[other][index]))
            .map(Option::unwrap_or_default)
            .collect();
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
    Some((types, all.iter().map(|one| one.contents).collect()))
}

/// The number of the type that a row names.
fn find(names: &Names, keys: &Keys<'_>, [own, row, name]: [&str; 3]) -> Option<usize> {
    if let Some(index) = names.index_of(name) {
        return Some(index);
    }
    let block = keys.reader()?;
    let table = |entry: &'_ Entry| entry.node.table().cloned();
    let types = block.table.get("types").and_then(table);
    let own = types.and_then(|types| types.get(own).and_then(table));
    let row = own.and_then(|own| own.get(row).and_then(table));
    let at = row.and_then(|row| row.get(name).map(|entry| entry.key_at.clone()));
    names.find(block.cx, (name, &at.unwrap_or_else(|| block.at.clone())))
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
