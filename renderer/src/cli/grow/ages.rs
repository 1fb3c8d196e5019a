//! A leaf on several days of its ageing.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use leafmodel::blade::UvFrame;
use leafmodel::blade::contents_map::ContentsMap;
use leafmodel::blade::senescence::Senescence;
use leafmodel::grow_options::GrowOptions;
use leafmodel::leaf::{Lamina, LeafError, LeafPlan};

use super::drawings::has_caption;
use super::films::Films;
use super::maps;
use super::outputs::{Outputs, finish, numbered};
use crate::cli::arguments::CaptionedKinds;
use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::caption::{Note, captioned};
use crate::export::daylight::in_daylight;
use crate::export::drawing::Drawing;

/// Refuses plans of leaves that do not age by days.
pub(super) fn check(plan: &LeafPlan) -> Result<(), Failure> {
    if plan.compound.is_some() {
        bail!(
            "--ages shows how one blade ages, and this is a compound leaf: take its block `compound` out of the plan"
        );
    }
    let last = last_day(plan)?;
    if last > Senescence::LATEST_DAY {
        bail!(
            "--ages shows a leaf until all of it is dead, which is on day {last}; days go to {}: let `senescence.death_day` be \
             less, or `senescence.blend_days`, or the days by which its tissue comes later",
            Senescence::LATEST_DAY
        );
    }
    Ok(())
}

/// The day from which on all of the leaf is dead.
fn last_day(plan: &LeafPlan) -> Result<f64, Failure> {
    let senescence = plan.senescence.as_ref();
    let last = senescence.and_then(Senescence::last_day);
    last.ok_or_else(|| {
        bad!("--ages needs a leaf that ages by days: presets such as `birch-autumn` do, others with a block `senescence` that has `day`")
    })
}

/// `count` evenly spaced days from 0 to `last`; a single one is the last.
fn days(last: f64, count: u32) -> impl Iterator<Item = f64> {
    let gaps = f64::from(count.saturating_sub(1));
    (0..count).map(move |i| {
        if gaps > 0.0 {
            last * f64::from(i) / gaps
        } else {
            last
        }
    })
}

/// What is written for each day.
#[derive(Clone, Copy, Debug)]
pub(super) struct Written<'a> {
    /// Number of days.
    pub(super) count: u32,
    /// Pixels along the longer side of a picture.
    pub(super) pixels: u32,
    /// Kinds of pictures that have a caption.
    pub(super) captions: CaptionedKinds,
    /// Folder of the maps of contents, if they are asked for.
    pub(super) contents: Option<&'a Path>,
    /// Name of the leaf.
    pub(super) name: &'a str,
}

/// Writes the leaf on evenly spaced days, as pictures and as maps of contents.
pub(super) fn write(
    plan: &LeafPlan,
    lamina: &Lamina,
    outputs: &Outputs,
    written: Written<'_>,
    mut films: Films,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let Some(senescence) = plan.senescence else {
        return check(plan);
    };
    let is_stopped = || stop.load(Ordering::Relaxed);
    let failed = |error: LeafError| signals::failure(stop, error);
    // Cells do not change their type as they age.
    let pattern = GrowOptions::stopped_by(&is_stopped)
        .pattern(plan, lamina)
        .map_err(failed)?;
    let painted = |day: f64, map_size: u32| -> Result<ContentsMap, Failure> {
        let plan = LeafPlan {
            senescence: senescence.on_day(day),
            map_size,
            ..plan.clone()
        };
        signals::check(stop)?;
        plan.paint(lamina, pattern.as_ref()).map_err(failed)
    };
    let last = last_day(plan)?;
    // So wide that all frames have captions of one size.
    let digits = format!("{last:.1}").len();
    for (number, day) in days(last, written.count).enumerate() {
        if !outputs.staged.is_empty() {
            let map = painted(day, written.pixels.clamp(16, 8192))?;
            let picture = Drawing {
                width: map.width,
                height: map.height,
                rgb: in_daylight(&map, &plan.pigments, Some(lamina.intact())),
            };
            let across = UvFrame::around(lamina.intact().points()).size.x;
            let notes = [
                Note::ScaleBar {
                    pixels_per_mm: f64::from(map.width) / across,
                },
                Note::Text(format!("day {day:>digits$.1} of {last:.1}")),
            ];
            let drawn = |is_film| {
                if has_caption(written.captions, is_film) {
                    captioned(&picture, &notes)
                } else {
                    picture.clone()
                }
            };
            let pngs = outputs.staged.iter().filter(|(_, kind)| !kind.is_film());
            for (path, _) in pngs {
                let png = drawn(false).png().map_err(Failure::bad)?;
                finish(&numbered(path, number + 1), &png, stop)?;
            }
            films.push(&[drawn(true)])?;
        }
        if let Some(folder) = written.contents {
            let map = painted(day, plan.map_size)?;
            let file = format!("{}-{:04}", written.name, number + 1);
            maps::write(folder, &file, &map, lamina.intact(), Some(day), stop)?;
        }
        eprintln!("day {day:.1}");
    }
    films.finish(stop)
}

#[cfg(test)]
mod tests {
    use leafmodel::blade::senescence::AgeSource;
    use leafmodel::species::find;

    use super::*;

    #[test]
    fn days_are_even_from_summer_to_litter() {
        let found: Vec<f64> = days(60.0, 4).collect();
        assert_eq!(found, [0.0, 20.0, 40.0, 60.0]);
        assert_eq!(days(60.0, 1).collect::<Vec<f64>>(), [60.0]);
    }

    #[test]
    fn leaves_without_days_are_refused() {
        for (name, ages) in [
            ("birch-autumn", true),
            ("birch", false),
            ("xia-autumn", false),
            ("acer-variegated", false),
        ] {
            let plan = find(name).expect("a preset").plan();
            assert_eq!(check(&plan).is_ok(), ages, "{name}");
        }
    }

    #[test]
    fn a_leaf_that_dies_after_the_last_day_is_refused() {
        let mut plan = find("birch-autumn").expect("a preset").plan();
        let senescence = plan.senescence.as_mut().expect("it ages");
        let AgeSource::Day { course, .. } = &mut senescence.source else {
            panic!("{senescence:?}");
        };
        let later = course.death.most() + senescence.blend;
        course.death_day = Senescence::LATEST_DAY - later;
        assert!(check(&plan).is_ok());
        let senescence = plan.senescence.as_mut().expect("it ages");
        let AgeSource::Day { course, .. } = &mut senescence.source else {
            panic!("{senescence:?}");
        };
        course.death_day = Senescence::LATEST_DAY;
        plan.check_senescence().expect("a good plan");
        let failure = check(&plan);
        let Err(Failure::BadInput(message)) = &failure else {
            panic!("{failure:?}");
        };
        assert!(message.contains("days go to 10000"), "{message}");
    }
}
