//! `lamina render`: a scene file to STEM.exr and STEM.png or STEM.jpg.

mod keeping;
mod plan;
mod preview;
mod report;
mod viewer;

use std::ffi::{OsStr, OsString};
use std::path::Path;
use std::time::{Duration, Instant};

use self::keeping::Keeping;
use self::plan::{Files, Plan};
use self::preview::Preview;
use self::report::{Times, report, tell_samples, tell_speed};
use self::viewer::Viewer;
use crate::checkpoint::{self, Heading};
use crate::cli::arguments::{RenderArguments, SceneArguments};
use crate::cli::picture_files;
use crate::cli::progress::{Patience, Reporter};
use crate::cli::signals::Signals;
use crate::cli::{Failure, load_scene, needs, note, say, stats};
use crate::image::ImageError;
use crate::integrator::caption::Caption;
use crate::integrator::layers::Layout;
use crate::integrator::render::{Begun, Contact, Ended, Rendered, begin, go_on};
use crate::scene::description::Description;
use crate::scene::load;
use crate::scene::plant_cache::PlantCache;
use crate::scene::world::{BuildOptions, World};

pub(super) fn run(arguments: &RenderArguments, line: &[OsString]) -> Result<(), Failure> {
    let started = Instant::now();
    let signals = Signals::listen()?;
    let loaded = load_scene(&sized(arguments))?;
    let files = Files::of(arguments, &loaded, &signals)?;
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::system)?;
    // As many leaves grow at a time as there are threads.
    pool.install(|| needs::check(&loaded.description, arguments.memory))?;
    let mut plan = pool.install(|| Plan::of(arguments, &loaded, &files))?;
    let shown = files.preview(arguments)?;
    let viewer = viewer(arguments, &plan.heading)?;
    let scene = loaded.description;
    let job = plan.heading.job;
    let patience = Patience::building(scene.leaves.len(), arguments.memory);
    let world = pool.install(|| build_world(&scene, arguments, &patience))?;
    drop(patience);
    plan.heading.caption = Caption::of(&scene, &world.view, &world.light_colours);
    note(&world.notes);
    let build_seconds = started.elapsed().as_secs_f64();
    // It counts from where an earlier run ended.
    let spent = plan.before.as_ref().map(|begun| begun.elapsed);
    let time = arguments
        .time
        .map(|time| Duration::from_secs_f64(time) + spent.unwrap_or_default());
    signals.begin_work();
    let is_taken_up = plan.before.is_some();
    let keeping = Keeping::new(
        &files.checkpoint,
        [arguments.checkpoint.is_some(), is_taken_up],
        Duration::from_secs_f64(arguments.checkpoint_every),
        &plan.heading,
        &signals,
    );
    let layout = Layout::new(&world.wavelengths);
    let every = arguments
        .preview
        .map_or(preview::USUAL, Duration::from_secs_f64);
    let preview = Preview::new(&plan.heading, layout, every, shown, viewer);
    let tracing = Instant::now();
    let begun = match plan.before {
        Some(begun) => begun.up_to(&job).down_to(plan.heading.aim),
        None => pool
            .install(|| begin(&world, &job, plan.heading.aim, &signals.stop))
            .map_err(Failure::bad)?
            .from_sample(plan.first),
    };
    let begun = match plan.map {
        Some(map) => begun.by_map(map),
        None => begun,
    };
    let before = [begun.film.drawn(), begun.rays];
    let reporter = Reporter::new(time.map(|time| time.saturating_sub(begun.elapsed)));
    let (begun, ended) = pool.install(|| {
        let contact = Contact {
            stop: &signals.stop,
            progress: &|progress| reporter.tell(progress),
            is_due: &|| keeping.is_due() || preview.is_due(),
            keep: &|begun| {
                if keeping.is_due() {
                    keeping.keep(begun);
                }
                if preview.is_due() {
                    preview.show(begun);
                }
            },
        };
        go_on(&world, &job, begun, time, &contact)
    });
    reporter.finish();
    let times = Times {
        all: started.elapsed().as_secs_f64(),
        build: build_seconds,
        trace: tracing.elapsed().as_secs_f64(),
        before,
    };
    let traced = Traced {
        world: &world,
        heading: &plan.heading,
        files: &files,
        keeping: &keeping,
        preview: &preview,
        line,
        stats: arguments.stats.as_deref(),
    };
    pool.install(|| traced.finish(begun, ended, &times))
}

/// A render whose paths are traced.
struct Traced<'a> {
    world: &'a World,
    heading: &'a Heading,
    files: &'a Files,
    keeping: &'a Keeping<'a>,
    preview: &'a Preview<'a>,
    /// The command line.
    line: &'a [OsString],
    stats: Option<&'a Path>,
}

impl Traced<'_> {
    /// Writes and tells what was rendered.
    fn finish(&self, begun: Begun, ended: Ended, times: &Times) -> Result<(), Failure> {
        let drawn = begun.film.drawn();
        let is_interrupted = ended == Ended::Interrupted;
        if is_interrupted && drawn == 0 {
            eprintln!("interrupted before the first sample: nothing is written");
            return Err(Failure::Interrupted);
        }
        // What cannot be made again is kept first.
        let kept = if is_interrupted {
            self.keeping.save(&begun)
        } else {
            Ok(())
        };
        let layout = Layout::new(&self.world.wavelengths);
        let rendered = Rendered::new(begun, layout, ended);
        let written = self.write_pictures(&rendered);
        self.preview.show_last(&rendered.film);
        let stats = report(self, &rendered, times);
        let ended = rendered.ended;
        tell_speed(&rendered, times);
        tell_samples(&rendered);
        let rejected = rendered.film.rejected();
        let notes = rendered.notes();
        let begun = rendered.into_begun();
        let written = written.and_then(|()| match &self.files.pictures {
            // An interrupted part is its checkpoint.
            None if !is_interrupted => checkpoint::write(&self.files.part, self.heading, &begun),
            Some(_) | None => Ok(()),
        });
        written.map_err(|error| self.failed(&error, &begun, is_interrupted))?;
        if let Some(path) = self.stats {
            stats::write(path, &stats)?;
        }
        if is_interrupted {
            kept.map_err(|error| Failure::system(format!("no checkpoint: {error}")))?;
            if let Some(pictures) = &self.files.pictures {
                for path in pictures {
                    say(path.display());
                }
                eprintln!("interrupted: the pictures hold what was rendered until then");
            }
            eprintln!("{}", how_to_go_on(&self.files.checkpoint, self.line));
            return Err(Failure::Interrupted);
        }
        let goes_on = self
            .keeping
            .finish(&begun, ended)
            .map_err(Failure::system)?;
        for path in self.files.results() {
            say(path.display());
        }
        if goes_on {
            eprintln!("{}", how_to_go_on(&self.files.checkpoint, self.line));
        }
        note(notes);
        // More than one rejected sample in a million is not due to rounding.
        if rejected as f64 > 1e-6 * drawn as f64 {
            return Err(Failure::system(
                "too many samples were not finite; the picture is not to be trusted",
            ));
        }
        Ok(())
    }

    /// Writes the pictures, unless only a part of the samples was rendered.
    fn write_pictures(&self, rendered: &Rendered) -> Result<(), ImageError> {
        let Some([exr, shown]) = &self.files.pictures else {
            return Ok(());
        };
        let Heading { caption, job, .. } = self.heading;
        picture_files::write(caption, job, rendered, [exr, shown])
    }

    /// The result could not be written: nothing is lost as long as the sums can be kept anywhere.
    fn failed(&self, error: &ImageError, begun: &Begun, is_kept: bool) -> Failure {
        if !is_kept {
            // If this fails too, an earlier checkpoint may be there.
            let _ = self.keeping.save(begun);
        }
        let rest = self.keeping.file();
        let rest = rest.map(|file| format!("\n{}", how_to_go_on(file, self.line)));
        Failure::system(format!("{error}{}", rest.unwrap_or_default()))
    }
}

/// The scene with the size of its film, if the command line gives one.
fn sized(arguments: &RenderArguments) -> SceneArguments {
    let mut scene = arguments.scene.clone();
    let kind = load::film_kind(&scene.scene, &scene.overrides);
    if let (Some([width, height]), Some(kind)) = (arguments.size, kind) {
        let size = format!("film.{kind}.size=[{width}, {height}]");
        scene.overrides.push(size);
    }
    scene
}

/// The viewer that the command line names, before anything is grown for it.
fn viewer(arguments: &RenderArguments, heading: &Heading) -> Result<Option<Viewer>, Failure> {
    let Heading { caption, job, .. } = heading;
    let open = |address: &String| {
        Viewer::open(address, &caption.name, [job.width, job.height]).map_err(|error| {
            Failure::bad(format!(
                "--tev {address}: {error}: write HOST:PORT and start tev first, or leave out --tev"
            ))
        })
    };
    arguments.tev.as_ref().map(open).transpose()
}

fn build_world(
    scene: &Description,
    arguments: &RenderArguments,
    patience: &Patience,
) -> Result<World, Failure> {
    let cache = arguments.cache.as_deref().map(PlantCache::open);
    let cache = cache.transpose().map_err(Failure::bad)?;
    let options = BuildOptions {
        cache: cache.as_ref(),
        ..patience.options()
    };
    World::build_with(scene, &options).map_err(Failure::bad)
}

/// The command that goes on from a checkpoint.
fn how_to_go_on(checkpoint: &Path, line: &[OsString]) -> String {
    // A person who copies the command has no program behind its standard input.
    let words = line.iter().filter(|word| *word != "--end-with-stdin");
    let mut words: Vec<String> = words.map(|word| quoted(word)).collect();
    if !words.iter().any(|word| word == "--resume") {
        words.push("--resume".to_owned());
    }
    format!(
        "{} holds the samples; to go on:\n  {}",
        checkpoint.display(),
        words.join(" ")
    )
}

/// A word as a shell takes it.
fn quoted(word: &OsStr) -> String {
    let word = word.to_string_lossy();
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.into_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_to_go_on_is_one_that_a_shell_takes() {
        let line = [
            "lamina",
            "render",
            "my scene.toml",
            "-D",
            "a.b=\"it's\"",
            "--end-with-stdin",
            "",
        ];
        let line = line.map(OsString::from);
        let told = how_to_go_on(Path::new("x.checkpoint"), &line);
        let command = told.lines().nth(1).expect("it is the second line").trim();
        let expected = r#"lamina render 'my scene.toml' -D 'a.b="it'\''s"' '' --resume"#;
        assert_eq!(command, expected);
        let again = how_to_go_on(
            Path::new("x.checkpoint"),
            &["lamina", "--resume"].map(OsString::from),
        );
        assert!(again.ends_with("lamina --resume"), "{again}");
    }
}
