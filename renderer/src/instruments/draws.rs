//! Figures as means over independent draws of the leaves.
//!
//! Each draw has leaves and rays of its own, so that figures of different draws are independent. With N
//! draws, figures v and their errors e by rays:
//!
//! - The variance of the mean is s² / N, where s² = Σ (v − v̄)² / (N − 1) is the variance between draws. It
//!   counts rays as well as leaves, because both differ from draw to draw.
//! - The part of the rays is Σ e² / N², since each draw knows its own from its batches.
//! - The part of the leaves is what remains, and 0 if nothing does: the estimate of a random effect by
//!   moments. The whole is the sum of both parts, and so never less than that of the rays, which many
//!   more batches tell.

use std::sync::atomic::{AtomicU64, Ordering};

use super::batches::{Budget, Effort, Target, Watch};
use super::error::{InstrumentError, Problem};
use super::row::{CutPaths, ErrorParts, Reading, Row};
use crate::geometry::scatter::seed_of_draw;
use crate::scene::description::Description;
use crate::scene::world::{BuildOptions, World};

/// Reads out draw after draw with `read_out`, until all are done or somebody ends it. The world is then that
/// of the first draw again.
pub(super) fn read_out_each(
    world: &mut World,
    (scene, number): (&Description, usize),
    effort: &Effort<'_>,
    options: &BuildOptions<'_>,
    read_out: impl Fn(&World, &Effort<'_>) -> Result<Reading, InstrumentError>,
) -> Result<Reading, InstrumentError> {
    let instrument = &scene.instruments[number].value;
    let wanted = instrument.realisations();
    let drawn = |draw: u32, world: &mut World| {
        let found = world.draw_again(scene, draw, options);
        found.map_err(|error| {
            let (draw, problem) = (draw + 1, error.to_string());
            Problem::NoDraw { draw, problem }.at(&instrument.at)
        })
    };
    let mut readings = Vec::new();
    // Rays of the draws before, and of this one.
    let (mut before, followed) = (0, AtomicU64::new(0));
    for draw in 0..wanted {
        if draw > 0 {
            drawn(draw, world)?;
        }
        let budget = Budget {
            seed: seed_of_draw(effort.budget.seed, draw),
            error: effort.budget.error.map(|target| target.of_each(wanted)),
            ..effort.budget
        };
        before += followed.swap(0, Ordering::Relaxed);
        let tell = |rays: u64| {
            followed.store(rays, Ordering::Relaxed);
            if let Some(watch) = effort.watch {
                (watch.tell)(before + rays);
            }
        };
        let watch = effort.watch.map(|watch| Watch {
            tell: &tell,
            ..*watch
        });
        let effort = Effort {
            budget,
            watch: watch.as_ref(),
        };
        readings.push(read_out(world, &effort)?);
        if effort.watch.is_some_and(Watch::is_over) {
            break;
        }
    }
    if readings.len() > 1 {
        drawn(0, world)?;
    }
    Ok(mean(readings))
}

impl Target {
    /// What is enough for each of several draws, so that their mean reaches the target.
    fn of_each(self, draws: u32) -> Self {
        let times = f64::from(draws).sqrt();
        match self {
            Self::Absolute(error) => Self::Absolute(times * error),
            Self::Relative(part) => Self::Relative(times * part),
        }
    }
}

/// The mean over draws, of the figures that all of them have.
fn mean(mut readings: Vec<Reading>) -> Reading {
    if readings.len() == 1 {
        return readings.remove(0);
    }
    let count = readings.len() as f64;
    let cuts = readings.iter().map(|reading| reading.cut);
    let cut = cuts.fold(CutPaths::NONE, |all, own| CutPaths {
        paths: all.paths + own.paths,
        at_most: all.at_most + own.at_most / count,
    });
    let mut rest: Vec<&[Row]> = readings.iter().map(|reading| &reading.rows[..]).collect();
    let mut rows = Vec::new();
    for row in &readings[0].rows {
        let of_draw = |rest: &mut &[Row]| {
            let place = rest.iter().position(|other| other.is_of_the_same(row))?;
            let found = &rest[place];
            *rest = &rest[place + 1..];
            Some((found.value, found.error))
        };
        let found: Option<Vec<_>> = rest.iter_mut().map(of_draw).collect();
        rows.extend(found.map(|found| of_draws(row, &found)));
    }
    let draws = readings.len() as u32;
    Reading { rows, cut, draws }
}

/// A row whose value is the mean of those of several draws, each with its error by rays.
fn of_draws(row: &Row, found: &[(f64, f64)]) -> Row {
    let count = found.len() as f64;
    let value = found.iter().map(|(value, _)| value).sum::<f64>() / count;
    let squares = found.iter().map(|(own, _)| (own - value).powi(2));
    let whole = squares.sum::<f64>() / (count - 1.0) / count;
    let by_rays = found.iter().map(|(_, error)| error * error).sum::<f64>() / (count * count);
    let by_draws = (whole - by_rays).max(0.0);
    Row {
        value,
        error: (by_rays + by_draws).sqrt(),
        parts: Some(ErrorParts {
            draws: found.len() as u32,
            by_rays: by_rays.sqrt(),
            by_draws: by_draws.sqrt(),
        }),
        ..row.clone()
    }
}
