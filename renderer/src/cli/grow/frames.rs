//! A leaf at several times of its growth.

use std::sync::atomic::AtomicBool;

use leafmodel::blade::petiole::PetiolePlan;
use leafmodel::compound::FlatLeaf;
use leafmodel::leaf::{Lamina, LeafError, LeafPlan, LeafStage};
use rayon::prelude::*;

use super::drawings::Look;
use super::films::Films;
use super::outputs::{Kind, Outputs, numbered};
use crate::cli::places::write_and_say;
use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::drawing::{Drawing, Subject};

/// Greatest total number of nodes of stages in memory at once, about a gigabyte.
const MOST_NODES: usize = 10_000_000;
/// Greatest number of stages in memory at once; their files are made in parallel.
const MOST_STAGES: usize = 64;
/// Greatest number of frames of a film in memory at once, and of their bytes together.
const MOST_DRAWINGS: usize = 16;
const MOST_DRAWN_BYTES: u64 = 512 << 20;

/// Refuses plans of leaves that have no stages.
pub(super) fn check(plan: &LeafPlan) -> Result<(), Failure> {
    if plan.compound.is_some() {
        bail!(
            "--frames shows how one blade grows, and this is a compound leaf: take its block `compound` out of the plan"
        );
    }
    plan.check_stages().map_err(|error| no_stages(&error))
}

/// Refuses plans of leaves whose veins grow without auxin.
pub(super) fn check_sources(plan: &LeafPlan) -> Result<(), Failure> {
    if plan.venation.auxin().is_none() {
        bail!(
            "--sources shows the sources towards which veins grow, and those of this leaf do not: its venation has no `auxin`"
        );
    }
    Ok(())
}

fn no_stages(error: &LeafError) -> Failure {
    bad!("--frames: {error}")
}

/// A stage with its petiole, if the leaf has one. Its length and radius are reduced in proportion
/// to the leaf's length at that time.
fn with_petiole(plan: &LeafPlan, grown: &Lamina, stage: LeafStage) -> LeafStage {
    let Some(petiole) = &plan.petiole else {
        return stage;
    };
    let scale = stage.outline.length() / grown.outline.length();
    let mut young = plan.clone();
    // Before there are veins there is no midrib whose radius could be used.
    let radius = petiole.radius_on(&grown.outline, &grown.network);
    young.petiole = Some(PetiolePlan {
        radius_mm: Some(radius * scale),
        ..*petiole
    });
    let lamina = Lamina {
        outline: stage.outline,
        network: stage.network,
        developed: None,
        cells: None,
        filled: None,
        wounds: None,
    };
    let network = FlatLeaf::with_petiole(&young, &lamina).map(|flat| flat.network);
    LeafStage {
        network: network.unwrap_or(lamina.network),
        sources: stage.sources,
        outline: lamina.outline,
    }
}

/// Writes stages, as many as the films have frames, evenly spaced in steps, in every format that is
/// asked for.
///
/// The leaf is grown anew for each group of stages, which costs far less memory than keeping all.
pub(super) fn write(
    plan: &LeafPlan,
    lamina: &Lamina,
    outputs: &Outputs,
    look: &Look,
    mut films: Films,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    check(plan)?;
    let last_step = plan.last_step(lamina).map_err(|error| no_stages(&error))?;
    let look = &Look { last_step, ..*look };
    let steps = steps(last_step, films.count());
    let group = (MOST_NODES / lamina.network.nodes().len().max(1)).clamp(1, MOST_STAGES);
    for (index, group_steps) in steps.chunks(group).enumerate() {
        let stages = plan.stages(lamina, group_steps);
        let stages = stages.map_err(|error| no_stages(&error))?.into_iter();
        let stages = stages.map(|stage| with_petiole(plan, lamina, stage));
        let stages: Vec<LeafStage> = stages.collect();
        let staged = outputs.staged.iter();
        for (path, kind) in staged {
            let Kind::Veins(format) = *kind else { continue };
            let draw =
                |(stage, &step): (&LeafStage, &u32)| look.file(format, subject(stage), Some(step));
            let files: Vec<Result<Vec<u8>, Failure>> =
                stages.par_iter().zip(group_steps).map(draw).collect();
            for (number, file) in files.into_iter().enumerate() {
                signals::check(stop)?;
                write_and_say(&numbered(path, index * group + number + 1), file?)?;
            }
        }
        if !films.is_empty() {
            let draw =
                |(stage, &step): (&LeafStage, &u32)| look.drawn(true, subject(stage), Some(step));
            let numbered: Vec<(&LeafStage, &u32)> = stages.iter().zip(group_steps).collect();
            for few in numbered.chunks(drawings_at_once(look.pixels)) {
                let frames: Result<Vec<Drawing>, Failure> =
                    few.par_iter().map(|&stage| draw(stage)).collect();
                signals::check(stop)?;
                films.push(&frames?)?;
            }
        }
    }
    films.finish(stop)
}

/// How many frames of so many pixels along the longer side are drawn at once: each is drawn with
/// four bytes a pixel and kept with three.
fn drawings_at_once(pixels: u32) -> usize {
    let each = 7 * u64::from(pixels).pow(2);
    ((MOST_DRAWN_BYTES / each) as usize).clamp(1, MOST_DRAWINGS)
}

fn subject(stage: &LeafStage) -> Subject<'_> {
    Subject {
        outlines: std::slice::from_ref(&stage.outline),
        network: &stage.network,
        sources: &stage.sources,
    }
}

/// `count` steps from 0, before the first, to `last`; a single one is the last.
fn steps(last: u32, count: u32) -> Vec<u32> {
    let gaps = u64::from(count.saturating_sub(1));
    let step = |i: u64| match gaps {
        0 => last,
        // To the nearest step; halves up.
        _ => ((u64::from(last) * i * 2 + gaps) / (2 * gaps)) as u32,
    };
    (0..u64::from(count)).map(step).collect()
}

#[cfg(test)]
mod tests {
    use leafmodel::shape::teeth::ToothWave;
    use leafmodel::species::find;

    use super::*;

    fn preset(name: &str) -> LeafPlan {
        find(name).expect("a preset").plan()
    }

    #[test]
    fn what_is_refused_before_it_grows_is_what_has_no_stages_grown() {
        let mut splines = preset("xia-1");
        splines.venation = preset("arcuate").venation;
        let mut toothed = preset("xia-1");
        toothed.outline.teeth = vec![ToothWave {
            per_side: 5,
            height: 0.002,
            lean: 0.0,
            fade_base: 0.2,
            fade_apex: 0.2,
            ..ToothWave::default()
        }];
        let mut refused = 0;
        for plan in [preset("poplar"), preset("xia-1"), splines, toothed] {
            let lamina = plan.grow_lamina().expect("a good plan");
            let late = plan.last_step(&lamina).map_err(|error| no_stages(&error));
            let (early, late) = (check(&plan).err(), late.err());
            refused += u32::from(early.is_some());
            assert_eq!(format!("{early:?}"), format!("{late:?}"));
        }
        assert_eq!(refused, 2);
    }

    #[test]
    fn petioles_grow_with_their_leaves_and_end_as_the_grown_leaf_has_them() {
        let mut plan = preset("xia-1");
        plan.petiole = Some(PetiolePlan {
            length: 0.5,
            radius_mm: Some(0.4),
            curl: 0.0,
            course: leafmodel::blade::petiole::Course::STRAIGHT,
            section: leafmodel::blade::petiole::Section::default(),
        });
        let lamina = plan.grow_lamina().expect("a good plan");
        let last = plan.last_step(&lamina).expect("it grows");
        let stages = plan.stages(&lamina, &[0, last / 2, last]);
        let stages = stages.expect("it grows").into_iter();
        let stages: Vec<LeafStage> = stages
            .map(|stage| with_petiole(&plan, &lamina, stage))
            .collect();
        let whole = FlatLeaf::with_petiole(&plan, &lamina).expect("it has one");
        assert_eq!(stages[2].network, whole.network);
        for stage in stages {
            let stalk = stage.network.segments().find(|s| s.from.y < s.to.y);
            let stalk = stalk.expect("the stalk is the first vein");
            let length = stage.outline.length();
            assert!((stalk.from.distance(stalk.to) / length - 0.5).abs() < 1e-9);
            let radius = 0.4 * length / lamina.outline.length();
            assert!((stalk.radius_from - radius.max(1e-3)).abs() < 1e-12);
        }
    }

    #[test]
    fn steps_are_even_and_end_with_the_last() {
        assert_eq!(steps(10, 1), [10]);
        assert_eq!(steps(10, 3), [0, 5, 10]);
        assert_eq!(steps(7, 3), [0, 4, 7]);
        assert_eq!(steps(2, 5), [0, 1, 1, 2, 2]);
        assert_eq!(steps(u32::MAX, 100_000).last(), Some(&u32::MAX));
    }
}
