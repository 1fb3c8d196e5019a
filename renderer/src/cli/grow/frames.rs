//! A leaf at several times of its growth.

use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec2;
use leafmodel::leaf::{Lamina, LeafPlan, LeafStage};
use rayon::prelude::*;

use super::outputs::{Outputs, numbered};
use super::veins_file;
use crate::cli::{Failure, say};

/// Most nodes of all stages that are held at once: some gigabyte.
const MOST_NODES: usize = 10_000_000;
/// Most stages that are held at once; their files are made in parallel.
const MOST_STAGES: usize = 64;

/// Writes `count` stages, evenly spaced in steps, in every format that is asked for.
///
/// Each group of stages grows the leaf anew, which costs far less than to keep them all.
pub(super) fn write(
    plan: &LeafPlan,
    lamina: &Lamina,
    outputs: &Outputs,
    count: u32,
    pixels: u32,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    if plan.compound.is_some() {
        return Err(Failure::bad(
            "--frames shows how one blade grows, and this is a compound leaf: take its block `compound` out of the plan",
        ));
    }
    let no_stages = |error| Failure::bad(format!("--frames: {error}"));
    let steps = steps(plan.last_step(lamina).map_err(no_stages)?, count);
    let page = lamina.outline.bounds();
    let group = (MOST_NODES / lamina.network.nodes().len().max(1)).clamp(1, MOST_STAGES);
    for (index, group_steps) in steps.chunks(group).enumerate() {
        let stages = plan.stages(lamina, group_steps).map_err(no_stages)?;
        for (path, kind) in &outputs.staged {
            let draw = |stage: &LeafStage| {
                let outlines = std::slice::from_ref(&stage.outline);
                veins_file(*kind, page, outlines, &stage.network, pixels)
            };
            let files: Vec<Result<Vec<u8>, Failure>> = stages.par_iter().map(draw).collect();
            for (number, file) in files.into_iter().enumerate() {
                if stop.load(Ordering::Relaxed) {
                    return Err(Failure::Interrupted);
                }
                let path = numbered(path, index * group + number + 1);
                super::write(&path, &file?)?;
                say(path.display());
            }
        }
    }
    Ok(())
}

/// `count` steps from 0, before the first, to `last`; one alone is the last.
fn steps(last: u32, count: u32) -> Vec<u32> {
    let gaps = u64::from(count.saturating_sub(1));
    let step = |i: u64| match gaps {
        0 => last,
        // To the nearest step; halves up.
        _ => ((u64::from(last) * i * 2 + gaps) / (2 * gaps)) as u32,
    };
    (0..u64::from(count)).map(step).collect()
}

/// Corners of the page that all stages share.
pub(super) type Page = (DVec2, DVec2);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_even_and_end_with_the_last() {
        assert_eq!(steps(10, 1), [10]);
        assert_eq!(steps(10, 3), [0, 5, 10]);
        assert_eq!(steps(7, 3), [0, 4, 7]);
        assert_eq!(steps(2, 5), [0, 1, 1, 2, 2]);
        assert_eq!(steps(u32::MAX, 100_000).last(), Some(&u32::MAX));
    }
}
