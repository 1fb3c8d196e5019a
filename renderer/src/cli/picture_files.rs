//! STEM.exr and STEM.png or STEM.jpg: their names, and what is written into them.

use std::path::{Path, PathBuf};

use crate::checkpoint::Heading;
use crate::cli::terminal::Failure;
use crate::image::display::FileKind;
use crate::image::{ImageError, openexr};
use crate::integrator::develop::develop;
use crate::integrator::render::{Ended, Rendered};
use crate::provenance::{Provenance, Settings};
use crate::scene::fingerprint::hexadecimal;

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
    heading: &Heading,
    rendered: &Rendered,
    [exr, shown]: [&Path; 2],
) -> Result<(), ImageError> {
    let caption = &heading.caption;
    let mut picture = develop(caption, &heading.job, rendered);
    picture
        .attributes
        .push(provenance(heading, rendered).attribute());
    openexr::write(&picture, exr)?;
    caption.picture.write(&picture, kind_of(shown), shown)
}

/// What determines a picture, besides the text of its scene.
fn provenance(heading: &Heading, rendered: &Rendered) -> Provenance {
    let [_, spp] = rendered.film.drawn_range();
    let mut settings = Settings::from([
        ("spp".to_owned(), vec![spp.to_string()]),
        ("seed".to_owned(), vec![heading.job.seed.to_string()]),
    ]);
    if let Some(noise) = &rendered.noise {
        settings.insert("noise".to_owned(), vec![noise.aim.to_string()]);
    }
    Provenance {
        scene: Some(hexadecimal(heading.scene)),
        // What ended by time has the bits of a render with as many samples.
        complete: rendered.map.is_none() && rendered.ended != Ended::Interrupted,
        ..Provenance::of("render", "out", &settings)
    }
}

/// The kind of the picture to look at.
pub(super) fn kind_of(shown: &Path) -> FileKind {
    FileKind::of(shown).unwrap_or(FileKind::Png)
}
