//! `lamina render`: a scene file to STEM.exr and STEM.png or STEM.jpg.

mod keeping;
mod pace;
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
use self::report::{Times, report_samples, report_speed, stats};
use self::viewer::Viewer;
use crate::checkpoint::{self, Heading};
use crate::cli::arguments::{RenderArguments, SceneArguments};
use crate::cli::building::{Building, load_on, preset_of};
use crate::cli::needs::{self, on_threads};
use crate::cli::picture_files;
use crate::cli::places::write_json;
use crate::cli::progress::Reporter;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, say};
use crate::image::ImageError;
use crate::integrator::caption::Caption;
use crate::integrator::layers::Layout;
use crate::integrator::render::{Begun, Contact, Ended, Rendered, begin, go_on};
use crate::scene::load::{self, Loaded};
use crate::scene::world::World;

pub(super) fn run(arguments: &RenderArguments, line: &[OsString]) -> Result<(), Failure> {
    let started = Instant::now();
    let signals = Signals::listen()?;
    let loaded = load_on(&sized(arguments), arguments.stage)?;
    let files = Files::of(arguments, &loaded, &signals)?;
    let command = RenderCommand {
        arguments,
        line,
        files: &files,
        signals: &signals,
        started,
    };
    on_threads(arguments.threads, || command.carry_out(loaded))
}

/// What a render was asked for.
struct RenderCommand<'a> {
    arguments: &'a RenderArguments,
    /// The command line.
    line: &'a [OsString],
    files: &'a Files,
    signals: &'a Signals,
    started: Instant,
}

/// A render whose paths are traced.
struct Traced<'a> {
    world: &'a World,
    heading: &'a Heading,
    keeping: &'a Keeping<'a>,
    preview: &'a Preview<'a>,
    times: Times,
}

impl RenderCommand<'_> {
    fn carry_out(&self, loaded: Loaded) -> Result<(), Failure> {
        let (arguments, files, signals) = (self.arguments, self.files, self.signals);
        // As many leaves grow at a time as there are threads.
        needs::check(&loaded.description, arguments.memory)?;
        let mut plan = Plan::of(arguments, &loaded, files)?;
        let shown = files.preview(arguments)?;
        let viewer = viewer(arguments, &plan.heading)?;
        let scene = loaded.description;
        let job = plan.heading.job;
        let building = Building {
            memory: arguments.memory,
            cache: Some(&arguments.cache),
            ..Building::default()
        };
        let world = building.world(&scene)?;
        plan.heading.caption = Caption::of(&scene, &world.view, &world.light_colours);
        note(&world.notes);
        let build_seconds = self.started.elapsed().as_secs_f64();
        // It counts from where an earlier run ended.
        let spent = plan.before.as_ref().map(|begun| begun.elapsed);
        let time = arguments.time.map(Duration::from_secs_f64);
        let time = time.map(|time| time + spent.unwrap_or_default());
        signals.begin_work();
        let is_taken_up = plan.before.is_some();
        let keeping = Keeping::new(
            &files.checkpoint,
            [arguments.checkpoint.is_some(), is_taken_up],
            Duration::from_secs_f64(arguments.checkpoint_every),
            &plan.heading,
            signals,
        );
        let layout = Layout::new(&world.wavelengths);
        let every = arguments.preview.map(Duration::from_secs_f64);
        let every = every.unwrap_or(preview::USUAL);
        let preview = Preview::new(&plan.heading, layout, every, shown, viewer);
        let tracing = Instant::now();
        let begun = match plan.before {
            Some(begun) => begun.up_to(&job).down_to(plan.heading.aim),
            None => begin(&world, &job, plan.heading.aim, &signals.stop)
                .map_err(Failure::bad)?
                .from_sample(plan.first),
        };
        let begun = match plan.map {
            Some(map) => begun.by_map(map),
            None => begun,
        };
        let before = [begun.film.drawn(), begun.rays];
        let reporter = Reporter::new(time.map(|time| time.saturating_sub(begun.elapsed)));
        let contact = Contact {
            stop: &signals.stop,
            progress: &|progress| reporter.report(progress),
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
        let (begun, ended) = go_on(&world, &job, begun, time, &contact);
        reporter.finish();
        let traced = Traced {
            world: &world,
            heading: &plan.heading,
            keeping: &keeping,
            preview: &preview,
            times: Times {
                all: self.started.elapsed().as_secs_f64(),
                build: build_seconds,
                trace: tracing.elapsed().as_secs_f64(),
                before,
            },
        };
        self.finish(&traced, begun, ended)
    }

    /// Writes and reports what was rendered.
    fn finish(&self, traced: &Traced<'_>, begun: Begun, ended: Ended) -> Result<(), Failure> {
        let Traced {
            world,
            heading,
            keeping,
            preview,
            times,
        } = traced;
        let drawn = begun.film.drawn();
        let is_interrupted = ended == Ended::Interrupted;
        if is_interrupted && drawn == 0 {
            eprintln!("interrupted before the first sample: nothing is written");
            return Err(Failure::Interrupted);
        }
        // What cannot be made again is kept first.
        let kept = if is_interrupted {
            keeping.save(&begun)
        } else {
            Ok(())
        };
        let rendered = Rendered::new(begun, Layout::new(&world.wavelengths), ended);
        let written = self.write_pictures(heading, &rendered);
        preview.show_last(&rendered.film);
        let mut stats = stats(&rendered, times);
        let words = self.line.iter().map(|word| quoted(word));
        stats["command"] = words.collect::<Vec<_>>().join(" ").into();
        stats["machine"] = [std::env::consts::ARCH, std::env::consts::OS]
            .join(" ")
            .into();
        stats["scene"] = heading.caption.name.as_str().into();
        stats["geometry_mib"] = (world.geometry.memory_bytes() as f64 / f64::from(1 << 20)).into();
        keeping.report(&mut stats);
        preview.report(&mut stats);
        let ended = rendered.ended;
        report_speed(&rendered, times);
        report_samples(&rendered);
        let rejected = rendered.film.rejected();
        let notes = rendered.notes();
        let begun = rendered.into_begun();
        let written = written.and_then(|()| match &self.files.pictures {
            // An interrupted part is its checkpoint.
            None if !is_interrupted => checkpoint::write(&self.files.part, heading, &begun),
            Some(_) | None => Ok(()),
        });
        written.map_err(|error| self.failed(&error, keeping, &begun, is_interrupted))?;
        if let Some(path) = &self.arguments.stats {
            write_json(path, &stats)?;
        }
        if is_interrupted {
            kept.map_err(|error| Failure::system(format_args!("no checkpoint: {error}")))?;
            if let Some(pictures) = &self.files.pictures {
                for path in pictures {
                    say(path.display());
                }
                eprintln!("interrupted: the pictures hold what was rendered until then");
            }
            eprintln!("{}", self.how_to_go_on(&self.files.checkpoint));
            return Err(Failure::Interrupted);
        }
        let goes_on = keeping.finish(&begun, ended).map_err(Failure::system)?;
        for path in self.files.results() {
            say(path.display());
        }
        if goes_on {
            eprintln!("{}", self.how_to_go_on(&self.files.checkpoint));
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
    fn write_pictures(&self, heading: &Heading, rendered: &Rendered) -> Result<(), ImageError> {
        let Some([exr, shown]) = &self.files.pictures else {
            return Ok(());
        };
        picture_files::write(heading, rendered, [exr, shown])
    }

    /// The result could not be written: nothing is lost as long as the sums can be kept anywhere.
    fn failed(
        &self,
        error: &ImageError,
        keeping: &Keeping<'_>,
        begun: &Begun,
        is_kept: bool,
    ) -> Failure {
        if !is_kept {
            // If this fails too, an earlier checkpoint may be there.
            let _ = keeping.save(begun);
        }
        let rest = keeping.file();
        let rest = rest.map(|file| format!("\n{}", self.how_to_go_on(file)));
        Failure::system(format_args!("{error}{}", rest.unwrap_or_default()))
    }

    fn how_to_go_on(&self, checkpoint: &Path) -> String {
        how_to_go_on(checkpoint, self.line)
    }
}

/// The scene with the size of its film, if the command line gives one.
fn sized(arguments: &RenderArguments) -> SceneArguments {
    let mut scene = arguments.scene.clone();
    let kind = match preset_of(&scene.scene) {
        Some(_) => Some("rgb".to_owned()),
        None => load::film_kind(&scene.scene, &scene.overrides),
    };
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
            bad!(
                "--tev {address}: {error}: write HOST:PORT and start tev first, or leave out --tev"
            )
        })
    };
    arguments.tev.as_ref().map(open).transpose()
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
