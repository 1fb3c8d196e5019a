//! STEM.exr and STEM.png or STEM.jpg: their names, and what is written into them.

use std::path::{Path, PathBuf};

use crate::cli::terminal::Failure;
use crate::image::display::FileKind;
use crate::image::{ImageError, openexr};
use crate::integrator::caption::Caption;
use crate::integrator::develop::develop;
use crate::integrator::render::{Job, Rendered};

/// Endings of pictures that are not written; another one is part of a stem.
const OTHER_PICTURES: [&str; 13] = [
    "avif", "bmp", "dds", "gif", "hdr", "heic", "jp2", "jxl", "pfm", "tga", "tif", "tiff", "webp",
];

/// The stem given by `--out`, which may have one of these endings or that of a picture to look at,
/// and the ending of that picture.
pub(super) fn stem_of<'a>(out: &'a Path, endings: &[&str]) -> Result<(PathBuf, &'a str), Failure> {
    let text = out.as_os_str().as_encoded_bytes();
    if out.file_name().is_none() || text.ends_with(b"/") {
        bail!(
            "{} is a folder: name the pictures in it, for example --out {}",
            out.display(),
            out.join("leaf").display()
        );
    }
    let ending = out.extension().and_then(|ending| ending.to_str());
    if let Some(ending) = ending
        && OTHER_PICTURES.contains(&ending.to_ascii_lowercase().as_str())
    {
        bail_at!(
            out,
            "pictures are written as exr and png or jpg, not as {ending}"
        );
    }
    Ok(match (FileKind::of(out), ending) {
        (Some(_), Some(ending)) => (out.with_extension(""), ending),
        (None, Some(ending)) if endings.contains(&ending) => (out.with_extension(""), "png"),
        _ => (out.to_owned(), "png"),
    })
}

/// `stem` with an ending added, even if it already contains dots.
pub(super) fn with_ending(stem: &Path, ending: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

/// Writes the EXR, then the picture to look at, whose ending says its kind.
pub(super) fn write(
    caption: &Caption,
    job: &Job,
    rendered: &Rendered,
    [exr, shown]: [&Path; 2],
) -> Result<(), ImageError> {
    let picture = develop(caption, job, rendered);
    openexr::write(&picture, exr)?;
    caption.picture.write(&picture, kind_of(shown), shown)
}

/// The kind of the picture to look at.
pub(super) fn kind_of(shown: &Path) -> FileKind {
    FileKind::of(shown).unwrap_or(FileKind::Png)
}
