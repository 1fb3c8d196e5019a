//! `[leaves.NAME.outline.svg]`: a margin from a path of an SVG file.

use std::fs;

use leafmodel::shape::svg_path::{SvgContour, SvgError};

use crate::scene::document::context::QUOTED;
use crate::scene::document::limits::Limits;
use crate::scene::document::path::{Wanted, resolve};
use crate::scene::document::reader::Block;
use crate::scene::error::SceneError;
use crate::scene::source::{Place, escaped};

/// Coordinates of the file.
const COORDINATES: Limits = Limits::closed(-1e9, 1e9);

/// Reads the block and the file that it names.
pub(super) fn read_svg(block: &Block<'_>) -> Option<SvgContour> {
    let path = block.text("path", "the path of an SVG file");
    let id = block.optional_text("id");
    let given = ["base", "apex"].map(|key| {
        let is_there = block.entry(key).is_some();
        (is_there, block.optional_numbers::<2>(key, COORDINATES))
    });
    block.finish();
    let contour = path.and_then(|(path, at)| read_file(block, path, at, id.map(|(id, _)| id)));
    let mut contour = contour?;
    for ((is_there, place), end) in given
        .into_iter()
        .zip([&mut contour.base, &mut contour.apex])
    {
        if is_there {
            *end = place?;
        }
    }
    Some(contour)
}

fn read_file(block: &Block<'_>, path: &str, at: &Place, id: Option<&str>) -> Option<SvgContour> {
    let wanted = Wanted {
        endings: &["svg"],
        most_bytes: 16 << 20,
    };
    let file = resolve(block.cx, path, at, wanted)?;
    let bad = |problem: String, help: &str| {
        let error = SceneError::BadFile {
            path: escaped(path, 2 * QUOTED),
            problem: escaped(&problem, 4 * QUOTED),
            help: help.to_owned(),
        };
        block.cx.error(at, error);
    };
    let text = match fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) => {
            bad(
                format!("cannot be read: {error}"),
                "make it a readable UTF-8 file",
            );
            return None;
        }
    };
    match SvgContour::parse(path, &text, id) {
        Ok(contour) => Some(contour),
        Err(error) => {
            bad(error.to_string(), help(&error));
            None
        }
    }
}

fn help(error: &SvgError) -> &'static str {
    match error {
        SvgError::NotXml { .. } => "save it as plain SVG",
        SvgError::NoPath => "draw the margin as one `<path>`, outside of `<defs>`",
        SvgError::NoSuchPath { .. } => {
            "look the path's `id` up in the file, or leave `id` out for the first path"
        }
        SvgError::BadAttribute { .. } => {
            "mend the attribute, or save the file anew from a drawing program"
        }
        SvgError::SeveralParts { .. } => "keep one closed curve, or name another path by its `id`",
        SvgError::TooLarge { .. } => "simplify the path",
    }
}
