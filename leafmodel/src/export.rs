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
mod text;

pub use self::geojson::geojson;
pub use self::graphml::graphml;
pub use self::json::json;
pub use self::svg::{ORDER_COLOURS, SvgStyle, order_colour, svg, svg_within};
pub use self::table::table;
