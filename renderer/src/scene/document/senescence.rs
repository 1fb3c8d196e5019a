//! `[leaves.NAME.senescence]`: how far a leaf has aged.

use leafmodel::blade::ageing::{Course, Delay};
use leafmodel::blade::ageing_courses::{COURSES, LITTER, YELLOW};
use leafmodel::blade::senescence::{AgeSource, Senescence};

use super::contents::read_contents;
use super::limits::Limits;
use super::reader::Block;
use super::values::listed;
use crate::scene::error::SceneError;

/// Width of the transition from living to dead where nothing is said.
pub(crate) const BLEND: f64 = 0.08;

/// Days from living to dead where nothing is said.
pub(crate) const BLEND_DAYS: f64 = 4.0;

/// Reads the block; `None` where it is left out, or has an error. `earns` tells whether the leaf has cells that earn
/// anything, if that is known.
pub(super) fn read_senescence(leaf: &Block<'_>, earns: Option<bool>) -> Option<Senescence> {
    let block = leaf.optional_block("senescence")?;
    let read = match block.exactly_one(&["day", "revenue_share"]) {
        Some("day") => read_days(&block, block.number("day", Limits::closed(0.0, 1e4))),
        Some(_) => read_revenue(&block),
        // The other keys may still be wrong.
        None => read_days(&block, None),
    };
    block.finish();
    if let (Some(senescence), Some(false)) = (&read, earns)
        && senescence.needs_cells()
    {
        let key = match senescence.source {
            AgeSource::Revenue { .. } => "revenue_share",
            AgeSource::Day { .. } => "deaths_days",
        };
        let error = SceneError::Impossible {
            key: key.to_owned(),
            problem: "no cell of this leaf earns any revenue: it is not a transport leaf"
                .to_owned(),
            help: "write [leaves.NAME.outline.transport] or [leaves.NAME.venation.transport], or leave senescence out"
                .to_owned(),
        };
        let node = block.table.get(key);
        let at = node.map_or(&block.at, |entry| &entry.node.at);
        block.cx.error(at, error);
        return None;
    }
    read
}

fn read_revenue(block: &Block<'_>) -> Option<Senescence> {
    let share = block.number("revenue_share", Limits::closed(0.0, 1.0));
    let blend = block.number_or("blend", Limits::closed(0.001, 1.0), BLEND);
    let contents = block
        .block("contents", &[])
        .and_then(|inner| read_contents(&inner));
    Some(Senescence {
        source: AgeSource::Revenue { share: share? },
        blend,
        contents: contents?,
    })
}

fn read_days(block: &Block<'_>, day: Option<f64>) -> Option<Senescence> {
    let blend = block.number_or("blend_days", Limits::closed(0.001, 1e3), BLEND_DAYS);
    let named = block.optional_text("course");
    let mut course = match named {
        None => Some(YELLOW),
        Some((name, at)) => {
            let found = COURSES.iter().find(|(known, _)| *known == name);
            if found.is_none() {
                let error = SceneError::Impossible {
                    key: "course".to_owned(),
                    problem: format!("there is no course \"{}\"", name.escape_debug()),
                    help: format!("write one of {}", listed(COURSES.map(|(name, _)| name))),
                };
                block.cx.error(at, error);
            }
            found.map(|(_, course)| *course)
        }
    };
    let mut changed = course.unwrap_or(YELLOW);
    for (key, value, least, most) in numbers(&mut changed) {
        *value = block.number_or(key, Limits::closed(least, most), *value);
    }
    for (key, delay) in [("onset", &mut changed.onset), ("death", &mut changed.death)] {
        if let Some(inner) = block.optional_block(key) {
            let order = u64::from(delay.veins_order);
            delay.veins_order = inner.integer_or("veins_order", 1, 20, order) as u8;
            for (key, value, least, most) in delays(delay) {
                *value = inner.number_or(key, Limits::closed(least, most), *value);
            }
            inner.finish();
        }
    }
    if let Some(course) = &mut course {
        *course = changed;
    }
    let contents = match block.optional_block("contents") {
        Some(inner) if block.table.get("contents").is_some() => read_contents(&inner),
        Some(_) | None => Some(LITTER),
    };
    let source = AgeSource::Day {
        day: day?,
        course: course?,
    };
    Some(Senescence {
        source,
        blend,
        contents: contents?,
    })
}

/// The numbers of a course with their keys and ranges.
pub(super) fn numbers(course: &mut Course) -> [(&'static str, &mut f64, f64, f64); 12] {
    [
        ("half_days", &mut course.half_days, 0.1, 1e3),
        ("steepness", &mut course.steepness, 0.1, 50.0),
        (
            "chlorophyll_rest_ug_per_cm2",
            &mut course.chlorophyll_rest,
            0.0,
            1e3,
        ),
        (
            "labile_carotenoids",
            &mut course.labile_carotenoids,
            0.0,
            1.0,
        ),
        ("persistence", &mut course.persistence, 1.0, 100.0),
        (
            "anthocyanins_ug_per_cm2",
            &mut course.anthocyanins,
            0.0,
            1e3,
        ),
        ("anthocyanin_days", &mut course.anthocyanin_days, 0.1, 1e3),
        ("brown", &mut course.brown, 0.0, 100.0),
        ("structure_factor", &mut course.structure_factor, 1.0, 10.0),
        ("water_factor", &mut course.water_factor, 0.0, 1.0),
        ("dry_matter_factor", &mut course.dry_matter_factor, 0.0, 1.0),
        ("death_day", &mut course.death_day, 0.0, 1e4),
    ]
}

/// The real numbers of a delay with their keys and ranges.
pub(super) fn delays(delay: &mut Delay) -> [(&'static str, &mut f64, f64, f64); 8] {
    [
        ("veins_days", &mut delay.veins_days, -1e3, 1e3),
        ("veins_reach_mm", &mut delay.veins_reach_mm, 0.01, 1e3),
        ("margin_days", &mut delay.margin_days, 0.0, 1e3),
        ("margin_reach_mm", &mut delay.margin_reach_mm, 0.01, 1e3),
        ("tip_days", &mut delay.tip_days, -1e3, 1e3),
        ("noise_days", &mut delay.noise_days, 0.0, 1e3),
        ("noise_scale_mm", &mut delay.noise_scale_mm, 0.01, 1e3),
        ("deaths_days", &mut delay.deaths_days, 0.0, 1e3),
    ]
}
