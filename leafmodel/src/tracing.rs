//! A picture of veins becomes a margin and a network with radii.
//!
//! - **In**: a [`Raster`] of a cleared leaf, a drawing or a mask, and [`Settings`].
//! - **Out**: [`Traced`]: an `Outline` and a `VenationNetwork` in millimetres, and what was
//!   found on the way, with places.
//! - **Always true**: the network is valid, its loops are the holes between the veins; the same
//!   picture gives the same bits on every machine and any number of threads.
//! - **Left out**: veins that are narrower than two pixels or as pale as the tissue beside them,
//!   veins that hide behind others: a line drawing is seen, not a leaf. Files and their formats.
//!
//! The steps, each a published one, stand in `docs/src/theory/tracing.md`: blade against
//! background, light made even, a level (\[otsu1979\] or \[sauvola2000\]), distances
//! (\[felzenszwalb2012\]), thinning in the order of distances (\[pudney1998\]), a graph, spurs and
//! crossings, radii across the veins, smooth lines, directions and orders.
//!
//! ```
//! use leafmodel::tracing::{Blade, Raster, Settings, trace};
//!
//! // A dark cross, 5 pixels wide, on a bright square that is the whole picture.
//! let dark = |at: usize| (48..53).contains(&(at % 101)) || (48..53).contains(&(at / 101));
//! let values = (0..101 * 101).map(|at| if dark(at) { 0.2 } else { 0.9 });
//! let picture = Raster::new(101, 101, values.collect())?;
//! let settings = Settings { blade: Blade::Frame, ..Settings::new(0.01) };
//! let traced = trace(&picture, &settings)?;
//! assert_eq!(traced.network.loops(), 0);
//! let radius = traced.network.edges()[0].radius_from;
//! assert!((radius - 0.025).abs() < 0.002, "{radius} mm");
//! # Ok::<(), leafmodel::tracing::TraceError>(())
//! ```

mod assembly;
mod components;
mod curves;
mod distance;
mod error;
mod findings;
mod frame;
mod graph;
mod grid;
mod light;
mod lines;
mod margin;
mod pruning;
mod radii;
mod settings;
mod silhouette;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod thinning;
mod through;
mod traced;

use glam::DVec2;

pub use self::error::TraceError;
pub use self::findings::{Finding, FindingKind};
use self::grid::Mask;
pub use self::grid::Raster;
pub use self::settings::{Blade, Ink, Settings, Threshold};
pub use self::traced::{Frame, Traced};

/// Traces the margin and the veins of a picture.
///
/// # Errors
///
/// [`TraceError`].
pub fn trace(picture: &Raster, settings: &Settings) -> Result<Traced, TraceError> {
    settings.check()?;
    let (width, height) = (picture.width(), picture.height());
    for (end, place) in [("base", settings.base_px), ("apex", settings.apex_px)] {
        let Some(DVec2 { x, y }) = place else {
            continue;
        };
        if !((0.0..=width as f64).contains(&x) && (0.0..=height as f64).contains(&y)) {
            return Err(TraceError::OffPicture {
                end,
                x,
                y,
                width,
                height,
            });
        }
    }
    let mut blade = match &settings.blade {
        Blade::Silhouette => silhouette::silhouette(picture)?,
        Blade::Of(other) => {
            if [other.width(), other.height()] != [width, height] {
                return Err(TraceError::OtherSize {
                    blade: [other.width(), other.height()],
                    veins: [width, height],
                });
            }
            silhouette::silhouette(other)?
        }
        Blade::Frame => Mask::new(width, height, |_, _| true),
    };
    let mut findings = Vec::new();
    let ink = light::ink(picture, &blade, settings)?;
    let hairlines = light::hairlines(picture, settings);
    let mut veins = Mask::new(width, height, |x, y| {
        let at = y * width + x;
        let is_vein = ink.values()[at] > 0.0 || hairlines.as_ref().is_some_and(|lines| lines[at]);
        is_vein && blade.cells[blade.cell(x, y)]
    });
    findings::clean(&mut veins, settings.speck_px, &mut findings);
    let mut squares = distance::squared_distances(&veins);
    let joint = if matches!(settings.blade, Blade::Frame) {
        None
    } else {
        let widest = f64::from(squares.iter().copied().max().unwrap_or(0)).sqrt();
        let joint = silhouette::take_off_petiole(&mut blade, &veins, widest);
        if joint.is_some() {
            for (vein, in_blade) in veins.cells.iter_mut().zip(&blade.cells) {
                *vein &= in_blade;
            }
            squares = distance::squared_distances(&veins);
        }
        joint
    };
    if veins.count() == 0 {
        return Err(TraceError::NoVeins(
            "no pixel of the blade is one of a vein".to_owned(),
        ));
    }
    let thin = thinning::thinned(veins, &squares);
    let graph = graph::graph_of(&thin, &squares);
    drop((thin, squares));
    let lines = lines::lines(graph, &ink, settings, &mut findings)?;
    frame::in_millimetres(&lines, &blade, joint, settings, findings)
}
