//! `lamina compare` and `lamina info`: the contents of EXR files.

use std::path::Path;

use crate::cli::arguments::{CompareArguments, InfoArguments};
use crate::cli::needs;
use crate::cli::terminal::{Failure, say};
use crate::image::colours::in_rec709;
use crate::image::{Attribute, Picture, compare as numbers, openexr};

/// Times that the pixels of a picture are in memory while they are converted or compared.
const COPIES: f64 = 3.0;

/// The picture in a file, if the machine has memory for it.
pub(super) fn read(path: &Path) -> Result<Picture, Failure> {
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
