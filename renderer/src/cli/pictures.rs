//! `lamina compare`, `lamina info` and `lamina tonemap`: the contents of EXR files.

use std::path::Path;

use crate::cli::arguments::{CompareArguments, InfoArguments, TonemapArguments};
use crate::cli::needs;
use crate::cli::places::check_writable;
use crate::cli::terminal::{Failure, say};
use crate::image::colours::in_rec709;
use crate::image::display::FileKind;
use crate::image::{Attribute, ImageError, Picture, compare as numbers, openexr};
use crate::scene::load::parse_picture;

/// Times that the pixels of a picture are in memory while they are converted or compared.
const COPIES: f64 = 3.0;

/// The picture in a file, if the machine has memory for it.
fn read(path: &Path) -> Result<Picture, Failure> {
    let most = needs::most_bytes(None).map_or(u64::MAX, |most| (most / COPIES) as u64);
    openexr::read_within(path, most).map_err(Failure::bad)
}

pub(super) fn compare(arguments: &CompareArguments) -> Result<(), Failure> {
    let of = |path: &Path| {
        let converted = in_rec709(read(path)?);
        converted.map_err(Failure::at(path))
    };
    let (first, second) = (of(&arguments.first)?, of(&arguments.second)?);
    let comparison = numbers::compare(&first, &second);
    let [(width, height), (other_width, other_height)] = comparison.sizes;
    if (width, height) != (other_width, other_height) {
        bail!("the pictures have {width} × {height} and {other_width} × {other_height} pixels");
    }
    say(format!(
        "{:<28} {:>13} {:>13} {:>11} {:>12} {:>12}",
        "channel", "mean A", "mean B", "B/A - 1", "max |B - A|", "rmse"
    ));
    for channel in &comparison.channels {
        say(format!(
            "{:<28} {:>13.6e} {:>13.6e} {:>11.3e} {:>12.3e} {:>12.3e}",
            channel.name,
            channel.mean_a,
            channel.mean_b,
            channel.relative_difference,
            channel.max_abs_difference,
            channel.rmse
        ));
    }
    for (path, names) in [&arguments.first, &arguments.second]
        .into_iter()
        .zip(&comparison.missing)
    {
        if !names.is_empty() {
            say(format!("only in {}: {}", path.display(), names.join(", ")));
        }
    }
    say(if comparison.identical {
        "identical"
    } else {
        "different"
    });
    Ok(())
}

pub(super) fn info(arguments: &InfoArguments) -> Result<(), Failure> {
    let picture = read(&arguments.picture)?;
    say(format!("{} × {} pixels", picture.width, picture.height));
    for layer in &picture.layers {
        let finite = layer.data.iter().filter(|value| value.is_finite());
        let (mut least, mut most, mut sum) = (f32::INFINITY, f32::NEG_INFINITY, 0.0);
        for &value in finite {
            least = least.min(value);
            most = most.max(value);
            sum += f64::from(value);
        }
        say(format!(
            "{:<28} mean {:>12.6e}  from {least:>12.6e} to {most:>12.6e}",
            layer.name,
            sum / layer.data.len() as f64
        ));
    }
    for (name, attribute) in &picture.attributes {
        match attribute {
            Attribute::Text(text) => say(format!("{name} = {text}")),
            Attribute::Float(_)
            | Attribute::Double(_)
            | Attribute::Int(_)
            | Attribute::Matrix4(_)
            | Attribute::Chromaticities(_) => say(format!("{name} = {attribute:?}")),
        }
    }
    Ok(())
}

/// A picture to look at from an EXR, without rendering again.
pub(super) fn tonemap(arguments: &TonemapArguments) -> Result<(), Failure> {
    let out = &arguments.out;
    let kind = FileKind::of(out)
        .ok_or_else(|| bad_at!(out, "the ending tells what is written: png or jpg"))?;
    let picture = read(&arguments.picture)?;
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
