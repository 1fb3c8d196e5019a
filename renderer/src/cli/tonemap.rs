//! `lamina tonemap`: a picture to look at from an EXR, without rendering again.

use crate::cli::arguments::TonemapArguments;
use crate::cli::pictures;
use crate::cli::places::check_writable;
use crate::cli::terminal::{Failure, say};
use crate::image::ImageError;
use crate::image::display::FileKind;
use crate::scene::load::parse_picture;

pub(super) fn run(arguments: &TonemapArguments) -> Result<(), Failure> {
    let out = &arguments.out;
    let kind = FileKind::of(out)
        .ok_or_else(|| bad_at!(out, "the ending tells what is written: png or jpg"))?;
    let picture = pictures::read(&arguments.picture)?;
    // What the scene said when it was rendered; other programs' pictures say nothing.
    let scene = picture.text("lamina:scene").unwrap_or_default();
    let shown = format!("{} (lamina:scene)", arguments.picture.display());
    let display = parse_picture(scene, &shown, &arguments.overrides())?;
    display.check(kind).map_err(Failure::bad)?;
    check_writable(out)?;
    display.write(&picture, kind, out).map_err(|error| {
        if matches!(error, ImageError::File { .. }) {
            // The disk's fault, not the picture's: the error names the file that is written.
            return Failure::system(error);
        }
        let place = arguments.picture.display();
        bad!("{place}: {error}")
    })?;
    say(out.display());
    Ok(())
}
