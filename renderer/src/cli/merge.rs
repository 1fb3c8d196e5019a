//! `lamina merge`: parts of a picture to STEM.exr and STEM.png.

use std::path::Path;

use crate::checkpoint::merge;
use crate::cli::arguments::MergeArguments;
use crate::cli::picture_files::{self, stem_of, with_ending};
use crate::cli::places::{Lock, check_outputs};
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, say};
use crate::integrator::layers::Layout;
use crate::integrator::render::{Ended, Rendered};
use crate::spectrum::WavelengthSampler;

pub(super) fn run(arguments: &MergeArguments) -> Result<(), Failure> {
    let signals = Signals::listen()?;
    let (stem, ending) = stem_of(&arguments.out, &["exr"])?;
    let [exr, shown] = ["exr", ending].map(|ending| with_ending(&stem, ending));
    let outputs: [&Path; 2] = [&exr, &shown];
    check_outputs(&outputs, &arguments.parts, "the command")?;
    let _lock = Lock::take(&exr, &signals)?;
    let (heading, begun) = merge(&arguments.parts).map_err(Failure::bad)?;
    let layout = Layout::new(&WavelengthSampler::new(&heading.caption.kind));
    let kind = picture_files::kind_of(&shown);
    heading.caption.picture.check(kind).map_err(Failure::bad)?;
    let rendered = Rendered::new(begun, layout, Ended::Samples);
    picture_files::write(&heading, &rendered, outputs).map_err(Failure::system)?;
    eprintln!(
        "{} parts, {} samples a pixel",
        arguments.parts.len(),
        heading.job.spp
    );
    for path in outputs {
        say(path.display());
    }
    note(rendered.notes());
    Ok(())
}
