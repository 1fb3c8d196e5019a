//! Films of the pictures of a sweep.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::record::Record;
use crate::cli::arguments::SweepArguments;
use crate::cli::grow::films::{self, Films};
use crate::cli::grow::outputs::{Kind, numbered};
use crate::cli::places::{check_writable, write_and_say};
use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::drawing::Drawing;
use crate::image::animation::Timing;
use crate::scene::load::load;
use crate::sweep::{Sweep, Target};

/// The films that are asked for, checked before any task is done.
pub(super) fn planned(
    sweep: &Sweep,
    arguments: &SweepArguments,
) -> Result<Vec<(PathBuf, Kind)>, Failure> {
    let Some(first) = arguments.film.first() else {
        return Ok(Vec::new());
    };
    let Target::Scene(scene) = &sweep.target else {
        bail_at!(
            first,
            "a film shows the pictures of a scene; `lamina grow --frames` films a leaf"
        );
    };
    let mut films = Vec::new();
    for path in &arguments.film {
        let kind = Kind::of(path)?;
        if !kind.is_film() && kind != Kind::PNG {
            bail_at!(
                path,
                "the ending of a film is gif, apng, mp4, or png for numbered frames"
            );
        }
        let file = if kind == Kind::PNG {
            numbered(path, 1)
        } else {
            path.clone()
        };
        check_writable(&file)?;
        films.push((path.clone(), kind));
    }
    films::check(&films)?;
    let overrides: Vec<String> = sweep
        .fixed
        .iter()
        .cloned()
        .chain(sweep.task(0).overrides())
        .collect();
    // What is wrong with the scene is reported with all tasks.
    if let Ok(loaded) = load(scene, &overrides)
        && loaded.description.picture.is_metered()
    {
        eprintln!(
            "note: each frame is exposed by its own light, so that the film may flicker; \
             `exposure_ev` without `auto_exposure` and `grey_object` gives all frames one exposure"
        );
    }
    Ok(films)
}

/// Writes the films of tasks that are all done, whose files are in the folder `made`.
pub(super) fn write(
    planned: &[(PathBuf, Kind)],
    identities: &[u64],
    made: &Path,
    timing: Timing,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    if planned.is_empty() {
        return Ok(());
    }
    let mut films = Films::begun(planned, timing, identities.len() as u32);
    for (number, identity) in identities.iter().enumerate() {
        signals::check(stop)?;
        let record = Record::read(made, *identity).map_err(Failure::system)?;
        let file = record.and_then(|record| record.files.last().cloned());
        let file =
            file.ok_or_else(|| Failure::system(format!("the picture of task {number} is gone")))?;
        let picture = made.join(file);
        for (path, _) in planned.iter().filter(|(_, kind)| *kind == Kind::PNG) {
            let bytes = std::fs::read(&picture).map_err(Failure::system_at(&picture))?;
            write_and_say(&numbered(path, number + 1), &bytes)?;
        }
        films.push(&[frame(&picture)?])?;
    }
    films.finish(stop)
}

/// A picture on white.
fn frame(path: &Path) -> Result<Drawing, Failure> {
    let picture = image::open(path)
        .map_err(|error| Failure::system(format!("{}: {error}", path.display())))?;
    let picture = picture.to_rgba8();
    let over = |[colour, alpha]: [u8; 2]| {
        let [colour, alpha] = [colour, alpha].map(u32::from);
        ((colour * alpha + 255 * (255 - alpha) + 127) / 255) as u8
    };
    let (width, height) = picture.dimensions();
    let pixels = picture.pixels();
    let rgb = pixels.flat_map(|pixel| [0, 1, 2].map(|i| over([pixel[i], pixel[3]])));
    Ok(Drawing {
        width,
        height,
        rgb: rgb.collect(),
    })
}
