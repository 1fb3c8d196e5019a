//! Fields over the blade as a texture.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec2;
use leafmodel::blade::UvFrame;
use leafmodel::leaf::{Lamina, LeafPlan};
use rayon::prelude::*;

use crate::cli::signals;
use crate::cli::terminal::{Failure, say};
use crate::image::{Layer, Picture, openexr};

/// Refuses plans of leaves that have no fields.
pub(super) fn check(plan: &LeafPlan) -> Result<(), Failure> {
    plan.has_fields().then_some(()).ok_or_else(none)
}

fn none() -> Failure {
    bad!(
        "--fields needs veins that are splines (venation.arcuate) or a transport leaf (outline.transport or \
         venation.transport): others have no fields but their contents"
    )
}

/// Writes the fields of a lamina over the texture coordinates of its blade, with the rows and
/// columns of the maps of contents.
pub(super) fn write(
    path: &Path,
    plan: &LeafPlan,
    lamina: &Lamina,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let Some(fields) = plan.fields(lamina).map_err(Failure::bad)? else {
        return Err(none());
    };
    let frame = UvFrame::around(lamina.intact().points());
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
    signals::check(stop)?;
    let layer = |(channel, name): (usize, &&str)| {
        Layer::new(
            *name,
            rows.iter()
                .flat_map(|row| row[channel].iter().copied())
                .collect(),
        )
    };
    let picture = Picture::new([width, height], names.iter().enumerate().map(layer));
    openexr::write(&picture, path).map_err(Failure::system)?;
    say(path.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use leafmodel::species::find;

    use super::*;

    #[test]
    fn plans_are_refused_whose_leaves_have_no_fields_and_no_others() {
        let mut transport_and_auxin = find("xia-1").expect("a preset").plan();
        transport_and_auxin.venation = find("poplar").expect("a preset").plan().venation;
        let preset = |name: &str| find(name).expect("a preset").plan();
        for (plan, has_fields) in [
            (preset("xia-1"), true),
            (preset("arcuate"), true),
            (transport_and_auxin, true),
            (preset("poplar"), false),
        ] {
            let lamina = plan.grow_lamina().expect("a good plan");
            let fields = plan.fields(&lamina).expect("a good plan");
            assert_eq!(fields.is_some(), has_fields);
            assert_eq!(check(&plan).is_ok(), has_fields);
        }
    }
}
