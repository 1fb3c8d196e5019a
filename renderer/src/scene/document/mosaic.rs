//! `[leaves.NAME.mosaic]`: cells of several types, and what each holds.

mod control;

use glam::DVec3;
use leafmodel::mosaic::growth::{GrowthCourse, SurfaceGrowth};
use leafmodel::mosaic::pattern::{LeafFaces, MosaicPattern};
use leafmodel::mosaic::plan::{CellType, MosaicPlan, RadiusRule};
use leafmodel::optics::Contents;

use super::contents::read_changed;
use super::limits::Limits;
use super::names::Names;
use super::reader::Block;
use super::values::{number_at, rounded};
use crate::scene::error::SceneError;

/// Width of the blend between unlike cells where nothing is said, mm.
pub(crate) const BLEND_MM: f64 = 0.2;
/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;
const SHARE: Limits = Limits::closed(0.0, 1.0);

/// Reads `mosaic`; `None` where it is left out, or has an error. `base` is what cells hold where they say nothing else.
pub(super) fn read_mosaic(owner: &Block<'_>, base: Contents) -> Option<MosaicPattern> {
    // A survey of keys must not ask what the types of a mosaic that is not there are called.
    owner.entry("mosaic")?;
    let block = owner.optional_block("mosaic")?;
    let default = MosaicPlan::default();
    let cells = block.integer_or("cells", 1, 1_000_000, default.initial_cells as u64) as usize;
    let days = block.number("days", Limits::closed(0.0, 1e5));
    let weight = Limits::closed(0.1, 10.0);
    let radius_weight = block.number_or("radius_weight", weight, default.radius_weight);
    let relaxations = u64::from(default.relaxations_per_day);
    let relaxations = block.integer_or("relaxations_per_day", 1, 1000, relaxations) as u32;
    let step = block.number_or("step", SHARE, default.step);
    let before = u64::from(default.initial_relaxations);
    let initial_relaxations = block.integer_or("initial_relaxations", 0, 100_000, before) as u32;
    let initial_step = block.number_or("initial_step", SHARE, default.initial_step);
    let radius = match block.word("radius", &["initial", "daily"]) {
        Some("daily") => RadiusRule::Daily,
        Some(_) | None => RadiusRule::Initial,
    };
    let blend_mm = block.number_or("blend_mm", Limits::closed(0.0, 100.0), BLEND_MM);
    let faces = match block.word("faces", &["through", "both"]) {
        Some("both") => LeafFaces::Both,
        Some(_) | None => LeafFaces::Through,
    };
    let growth = read_growth(&block);
    let names = Names::of(&block, "types", "type of cell");
    let types = read_types(&block, &names, base);
    let controls = control::read_controls(&block, &names);
    block.finish();
    let (types, contents) = types?;
    Some(MosaicPattern {
        plan: MosaicPlan {
            initial_cells: cells,
            days: days?,
            radius_weight,
            relaxations_per_day: relaxations,
            step,
            initial_relaxations,
            initial_step,
            radius,
            types,
            controls: controls?,
            growth: growth?,
        },
        contents,
        blend_mm,
        faces,
    })
}

/// `growth`, which may be left out: the surface has its size from the start.
fn read_growth(mosaic: &Block<'_>) -> Option<SurfaceGrowth> {
    if mosaic.entry("growth").is_none() {
        return Some(SurfaceGrowth::None);
    }
    let block = mosaic.optional_block("growth")?;
    let start = block.numbers::<3>("start", Limits::closed(0.01, 10.0));
    let middle = block.optional_number("middle", SHARE);
    let steepness = block.optional_number("steepness", Limits::closed(1.0, 100.0));
    block.finish();
    let course = if middle.is_none() && steepness.is_none() {
        GrowthCourse::Linear
    } else {
        GrowthCourse::Logistic {
            middle: middle.unwrap_or(0.5),
            steepness: steepness.unwrap_or(8.0),
        }
    };
    start.map(|start| SurfaceGrowth::Anisotropic {
        start: DVec3::from_array(start),
        course,
    })
}

/// The types in the file's order, and what each holds.
fn read_types(
    mosaic: &Block<'_>,
    names: &Names<'_>,
    base: Contents,
) -> Option<(Vec<CellType>, Vec<Contents>)> {
    let section = mosaic.block("types", &[])?;
    let entries = &section.table.0;
    let count = entries.len();
    let (mut types, mut contents) = (Vec::new(), Vec::new());
    let mut whole = count > 0;
    // Adhesion is said once for each pair; here is where it was said first.
    let mut adhesion: Vec<Vec<Option<f64>>> = vec![vec![None; count]; count];
    for (index, entry) in entries.iter().enumerate() {
        let Some(block) = section.open(entry) else {
            whole = false;
            continue;
        };
        let share = block.number("initial_share", SHARE);
        let days = block.optional_number("division_days", Limits::above(0.0, 1e6));
        whole &= block.entry("division_days").is_none() || days.is_some();
        let switching = read_row(&block, "switching", names, count);
        let sticks = read_row(&block, "adhesion", names, count);
        let held = block
            .optional_block("contents")
            .map_or(base, |inner| read_changed(&inner, base));
        block.finish();
        let (Some(share), Some(switching), Some(sticks)) = (share, switching, sticks) else {
            whole = false;
            continue;
        };
        for (other, value) in sticks.into_iter().enumerate() {
            let Some(value) = value else { continue };
            if adhesion[other][index].is_some_and(|there| there != value) {
                impossible(
                    &block,
                    "adhesion",
                    format!(
                        "adhesion to `{}` is {value} here and {} there",
                        names.name(other),
                        adhesion[other][index].unwrap_or_default()
                    ),
                    "say it once, or the same in both",
                );
                whole = false;
            }
            adhesion[index][other] = Some(value);
        }
        let switching = complete(&block, index, &switching);
        whole &= switching.is_some();
        types.push(CellType {
            name: entry.key.clone(),
            division_days: days.unwrap_or(f64::INFINITY),
            initial_probability: share,
            switching: switching.unwrap_or_default(),
            adhesion: Vec::new(),
        });
        contents.push(held);
    }
    if !whole {
        return None;
    }
    for (index, kind) in types.iter_mut().enumerate() {
        kind.adhesion = (0..count)
            .map(|other| adhesion[index][other].or(adhesion[other][index]))
            .map(Option::unwrap_or_default)
            .collect();
    }
    let sum: f64 = types.iter().map(|kind| kind.initial_probability).sum();
    if (sum - 1.0).abs() > ROUNDING {
        impossible(
            &section,
            "initial_share",
            format!(
                "the initial shares of the types sum to {}, not to 1",
                rounded(sum)
            ),
            "change them so that they sum to 1",
        );
        return None;
    }
    Some((types, contents))
}

/// A table from names of types to shares; `None` at types that it does not name.
fn read_row(
    block: &Block<'_>,
    key: &'static str,
    names: &Names<'_>,
    count: usize,
) -> Option<Vec<Option<f64>>> {
    let mut row = vec![None; count];
    if block.entry(key).is_none() {
        return Some(row);
    }
    let table = block.optional_block(key)?;
    let mut whole = true;
    for entry in &table.table.0 {
        let name = (entry.key.as_str(), &entry.key_at);
        let value = number_at(block.cx, &entry.node, &entry.key, SHARE);
        match (names.find(block.cx, name), value) {
            (Some(index), Some(value)) => row[index] = Some(value),
            (Some(_) | None, Some(_) | None) => whole = false,
        }
    }
    whole.then_some(row)
}

/// Probabilities of a child's type; what is not said is that it is its parent's.
fn complete(block: &Block<'_>, own: usize, said: &[Option<f64>]) -> Option<Vec<f64>> {
    let mut row: Vec<f64> = said.iter().map(|value| value.unwrap_or(0.0)).collect();
    let sum: f64 = row.iter().sum();
    if said[own].is_none() && sum <= 1.0 {
        row[own] = 1.0 - sum;
        return Some(row);
    }
    if (sum - 1.0).abs() <= ROUNDING {
        return Some(row);
    }
    impossible(
        block,
        "switching",
        format!("its probabilities sum to {}, not to 1", rounded(sum)),
        "change them so that they sum to 1, or leave the type itself out: it gets the rest",
    );
    None
}

fn impossible(block: &Block<'_>, key: &'static str, problem: String, help: &str) {
    let at = block
        .table
        .get(key)
        .map_or(&block.at, |entry| &entry.key_at);
    let error = SceneError::Impossible {
        key: key.to_owned(),
        problem,
        help: help.to_owned(),
    };
    block.cx.error(at, error);
}
