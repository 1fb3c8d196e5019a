//! Fields over the blade as a texture.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec2;
use leafmodel::blade::UvFrame;
use leafmodel::leaf::{Lamina, LeafPlan};
use rayon::prelude::*;

use crate::cli::{Failure, say};
use crate::image::{Layer, Picture, openexr};

/// Writes the fields of a lamina over the texture coordinates of its blade, rows and columns as those of the maps of contents.
pub(super) fn write(
    path: &Path,
    plan: &LeafPlan,
    lamina: &Lamina,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let Some(fields) = plan.fields(lamina).map_err(Failure::bad)? else {
        return Err(Failure::bad(
            "--fields needs veins that are splines (venation.arcuate) or a transport leaf: others have no fields but their contents",
        ));
    };
    let frame = UvFrame::around(lamina.outline.points());
    let longer = frame.size.max_element();
    let texels_along = |side: f64| (f64::from(plan.map_size) * (side / longer)).ceil() as u32;
    let (width, height) = (texels_along(frame.size.x), texels_along(frame.size.y));
    let names = fields.names();
    let row = |row: u32| {
        let mut values = Vec::new();
        let mut channels = vec![Vec::with_capacity(width as usize); names.len()];
        if stop.load(Ordering::Relaxed) {
            return channels;
        }
        let v = (f64::from(row) + 0.5) / f64::from(height);
        for column in 0..width {
            let u = (f64::from(column) + 0.5) / f64::from(width);
            fields.at(frame.point(DVec2::new(u, v)), &mut values);
            for (channel, value) in channels.iter_mut().zip(&values) {
                channel.push(*value as f32);
            }
        }
        channels
    };
    let rows: Vec<Vec<Vec<f32>>> = (0..height).into_par_iter().map(row).collect();
    if stop.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    let layer = |(channel, name): (usize, &&str)| Layer {
        name: (*name).to_owned(),
        data: rows
            .iter()
            .flat_map(|row| row[channel].iter().copied())
            .collect(),
    };
    let picture = Picture {
        width,
        height,
        layers: names.iter().enumerate().map(layer).collect(),
        attributes: Vec::new(),
    };
    openexr::write(&picture, path).map_err(Failure::system)?;
    say(path.display());
    Ok(())
}
