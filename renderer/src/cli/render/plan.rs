//! What is to be rendered into which files, from the command line, the scene and a checkpoint.

use std::path::{Path, PathBuf};

use crate::checkpoint::{self, Heading, PROGRAM};
use crate::cli::arguments::RenderArguments;
use crate::cli::picture_files::{kind_of, stem_of, with_ending};
use crate::cli::places::{Lock, check_outputs};
use crate::cli::signals::Signals;
use crate::cli::terminal::Failure;
use crate::image::atomic::{Destination, destination};
use crate::image::openexr;
use crate::integrator::caption::Caption;
use crate::integrator::render::{Begun, Job};
use crate::integrator::sample_map::SampleMap;
use crate::scene::load::Loaded;

/// The channel of a picture with the number of samples of each pixel.
const SAMPLES: &str = "samples.Y";

/// The files that a render writes.
#[derive(Debug)]
pub(super) struct Files {
    /// The pictures; `None` if only a part of the samples is rendered.
    pub(super) pictures: Option<[PathBuf; 2]>,
    /// The sums of a part.
    pub(super) part: PathBuf,
    pub(super) checkpoint: PathBuf,
    /// Keep other programs away as long as they live.
    _locks: Vec<Lock>,
}

impl Files {
    /// The files, after checking that they can be written, are written once and are not read.
    pub(super) fn of(
        arguments: &RenderArguments,
        loaded: &Loaded,
        signals: &Signals,
    ) -> Result<Self, Failure> {
        let is_part = arguments.samples.is_some();
        let endings = if is_part {
            &["exr", "part"][..]
        } else {
            &["exr"]
        };
        let (stem, ending) = match &arguments.out {
            Some(out) => stem_of(out, endings)?,
            None => (PathBuf::from(&loaded.description.name), "png"),
        };
        let [exr, shown, part, checkpoint] =
            ["exr", ending, "part", "checkpoint"].map(|ending| with_ending(&stem, ending));
        let display = &loaded.description.picture;
        display.check(kind_of(&shown)).map_err(Failure::bad)?;
        let checkpoint = arguments.checkpoint.clone().unwrap_or(checkpoint);
        let mut outputs: Vec<&Path> = if is_part {
            vec![&part]
        } else {
            vec![&exr, &shown]
        };
        outputs.push(&checkpoint);
        outputs.extend(arguments.stats.as_deref());
        let mut inputs = loaded.inputs.clone();
        inputs.push(arguments.scene.scene.clone());
        inputs.extend(arguments.samples_map.clone());
        let reader = match arguments.samples_map {
            Some(_) => "the render",
            None => "the scene",
        };
        check_outputs(&outputs, &inputs, reader)?;
        // The picture to look at and the statistics go with the first output.
        let mut locks = Vec::new();
        for output in [outputs[0], &checkpoint] {
            locks.extend(Lock::take(output, signals)?);
        }
        Ok(Self {
            pictures: (!is_part).then_some([exr, shown]),
            part,
            checkpoint,
            _locks: locks,
        })
    }

    /// The picture that is written before it is done, if that is asked for.
    pub(super) fn preview(&self, arguments: &RenderArguments) -> Result<Option<&Path>, Failure> {
        let (Some([_, shown]), Some(_)) = (&self.pictures, arguments.preview) else {
            return Ok(None);
        };
        // What is written into a pipe cannot be written anew.
        if matches!(destination(shown), Ok(Destination::Stream)) {
            bail!(
                "--preview writes a file anew, but {} is none: leave out --preview",
                shown.display()
            );
        }
        Ok(Some(shown))
    }

    /// The files that hold the result.
    pub(super) fn results(&self) -> Vec<&Path> {
        match &self.pictures {
            Some(pictures) => pictures.iter().map(PathBuf::as_path).collect(),
            None => vec![&self.part],
        }
    }
}

/// What is to be rendered, and what of it has been.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) heading: Heading,
    /// Number of the first sample.
    pub(super) first: u32,
    /// Samples by block, if they are not the same everywhere.
    pub(super) map: Option<SampleMap>,
    /// What an earlier run left.
    pub(super) before: Option<Begun>,
}

impl Plan {
    pub(super) fn of(
        arguments: &RenderArguments,
        loaded: &Loaded,
        files: &Files,
    ) -> Result<Self, Failure> {
        let path = &files.checkpoint;
        let before = match (arguments.resume, path.exists()) {
            (true, true) => Some(checkpoint::read(path).map_err(Failure::bad)?),
            (true, false) => {
                eprintln!(
                    "note: there is no checkpoint {}: starting from the first sample",
                    path.display()
                );
                None
            }
            (false, true) => {
                eprintln!(
                    "note: {} is there from an earlier render; --resume would go on from it, this one starts anew",
                    path.display()
                );
                None
            }
            (false, false) => None,
        };
        let kept = before.as_ref().map(|(heading, _)| heading);
        let film = &loaded.description.film;
        let first = arguments.samples.map_or(0, |samples| samples.first);
        let size = [film.width, film.height];
        let map = arguments.samples_map.as_deref();
        let map = map.map(|path| read_map(path, size)).transpose()?;
        // What the command line leaves open is as it was; blocks that have more than a map names
        // keep them.
        let most = map.as_ref().map(|map| {
            let drawn = before.as_ref().map(|(_, begun)| begun.film.drawn_range());
            map.most().max(drawn.map_or(0, |[_, most]| most))
        });
        let spp = arguments.spp.or(most).or(kept.map(|kept| kept.job.spp));
        let aim = match (arguments.noise, kept) {
            // 0 on the command line switches off the scene's setting.
            (Some(noise), _) => Some(noise).filter(|&noise| noise > 0.0),
            (None, _) if map.is_some() => None,
            (None, Some(kept)) => kept.aim,
            (None, None) => film.noise,
        };
        let heading = Heading {
            program: PROGRAM.to_owned(),
            scene: loaded.fingerprint().map_err(Failure::bad)?,
            job: Job {
                width: film.width,
                height: film.height,
                spp: match arguments.samples {
                    Some(samples) => samples.end,
                    None => spp.unwrap_or(film.spp),
                },
                seed: (arguments.seed)
                    .or(kept.map(|kept| kept.job.seed))
                    .unwrap_or(film.seed),
            },
            whole: arguments.samples.and(arguments.spp),
            aim,
            // The focus on an object is known when that has grown, the colours of lights when their
            // pictures are read.
            caption: Caption::of(&loaded.description, &loaded.description.camera.view, &[]),
        };
        check_part(arguments, &heading)?;
        if let Some((kept, begun)) = &before {
            check_same(path, kept, begun, &heading, first)?;
        }
        Ok(Self {
            heading,
            first,
            map,
            before: before.map(|(_, begun)| begun),
        })
    }
}

/// The map of samples in a file, of a picture of this size.
fn read_map(path: &Path, [width, height]: [u32; 2]) -> Result<SampleMap, Failure> {
    let told = |what: &str| bad!("--samples-map {}: {what}", path.display());
    let picture = openexr::read(path).map_err(|error| bad!("--samples-map {error}"))?;
    if [picture.width, picture.height] != [width, height] {
        return Err(told(&format!(
            "it has {} × {} pixels; the picture has {width} × {height}",
            picture.width, picture.height
        )));
    }
    let Some(samples) = picture.layer(SAMPLES) else {
        return Err(told(&format!("it has no channel {SAMPLES}")));
    };
    SampleMap::new(width, &samples.data).map_err(|error| told(&format!("{SAMPLES}: {error}")))
}

/// Whether the samples asked for can be a part of a picture.
fn check_part(arguments: &RenderArguments, heading: &Heading) -> Result<(), Failure> {
    let Some(samples) = arguments.samples else {
        return Ok(());
    };
    if heading.aim.is_some() {
        bail!(
            "--samples {samples} renders a part, but noise can only be judged on a whole picture: add --noise 0"
        );
    }
    match arguments.spp {
        Some(spp) if samples.end > spp => Err(bad!(
            "--samples {samples} goes beyond the {spp} samples of --spp"
        )),
        Some(_) | None => Ok(()),
    }
}

/// Whether a render may go on from a checkpoint.
fn check_same(
    path: &Path,
    kept: &Heading,
    begun: &Begun,
    wanted: &Heading,
    first: u32,
) -> Result<(), Failure> {
    let path = path.display();
    // What had enough samples for one noise goes on to a lower one, or to all samples.
    let aim = match (kept.aim, wanted.aim) {
        (Some(kept), Some(wanted)) => Some(kept.min(wanted)),
        (_, None) => None,
        (None, Some(_)) => kept.aim,
    };
    let kept = &Heading {
        aim,
        ..kept.clone()
    };
    if let Some(what) = kept.difference(wanted) {
        bail!("{path} is {what}: render without --resume, or name another --checkpoint");
    }
    let [_, most] = begun.film.drawn_range();
    let (start, reached) = (begun.first, begun.first + most);
    if start != first {
        bail!(
            "{path} holds samples from number {start}, not {first}: give --samples {start}..{}, or another --checkpoint",
            kept.job.spp
        );
    }
    if reached > wanted.job.spp {
        bail!(
            "{path} holds the samples up to {reached} already, more than {}: ask for as many or more",
            wanted.job.spp
        );
    }
    Ok(())
}
