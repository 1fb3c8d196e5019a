//! Margin and veins as text for other programs.
//!
//! - **In**: an [`Outline`](crate::shape::outline::Outline), or several of a compound leaf, and a
//!   [`VenationNetwork`](crate::venation::network::VenationNetwork).
//! - **Out**: [`svg`] to draw, [`graphml`] for graph programs, [`json`] with everything,
//!   [`geojson`] for programs that know maps, [`table`] for spreadsheets.
//! - **Always true**: lengths are millimetres, apex up; the same network gives the same bytes. All
//!   but `svg`, which is rounded to 10⁻⁴ mm, hold every number of a network in full, and
//!   [`crate::import`] reads it back.
//! - **Left out**: the blade in space, and tissue.
//!
//! ```
//! use leafmodel::export::{SvgStyle, graphml, svg};
//! use leafmodel::species;
//!
//! let lamina = species::find("poplar").ok_or("the poplar is a preset")?.plan().grow_lamina()?;
//! let style = SvgStyle { orders_in_colour: true, areoles: true };
//! let drawing = svg(&lamina.outline, &lamina.network, style);
//! assert!(drawing.ends_with("</svg>\n"));
//! // A node of the graph for each point of a vein.
//! let graph = graphml(&lamina.network);
//! assert_eq!(graph.matches("<node ").count(), lamina.network.nodes().len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod geojson;
mod graphml;
mod json;
pub mod runs;
mod svg;
mod table;
#[cfg(test)]
mod tests;

pub use self::geojson::geojson;
pub use self::graphml::graphml;
pub use self::json::json;
pub use self::svg::{SvgStyle, svg, svg_within};
pub use self::table::table;

/// Colours (sRGB) that tell vein orders apart on white, also for most colour-blind eyes (after
/// Okabe and Ito); finer orders than there are colours share the last.
pub const ORDER_COLOURS: [[u8; 3]; 7] = [
    [0, 0, 0],
    [213, 94, 0],
    [0, 114, 178],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [160, 150, 120],
];

/// Colour of a vein order, 1 or more.
pub fn order_colour(order: u8) -> [u8; 3] {
    let last = ORDER_COLOURS.len() - 1;
    ORDER_COLOURS[usize::from(order.max(1) - 1).min(last)]
}

/// What has written a file.
const SOFTWARE: &str = concat!("Lamina ", env!("CARGO_PKG_VERSION"));

/// A coordinate rounded to 10⁻⁴ mm, without trailing zeros.
fn rounded(value: f64) -> f64 {
    // Adding 0 turns −0 into 0.
    (value * 1e4).round() / 1e4 + 0.0
}
