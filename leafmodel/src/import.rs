//! Networks of veins from files of other programs, and from our own.
//!
//! - **In**: the text of a file as `GraphML`, GML, JSON, `GeoJSON`, CSV, SVG or a list of neighbours.
//! - **Out**: [`Imported`]: a [`VenationNetwork`](crate::venation::network::VenationNetwork) in
//!   millimetres, the margin if the file holds one, which of radii and orders are known, and what is
//!   wrong with it, with places.
//! - **Always true**: what comes out is valid; a network that [`crate::export`] wrote comes back with
//!   its numbers, to the bit but for SVG, which is rounded.
//! - **Left out**: pictures.
//!
//! Names of columns and attributes are known with their units (`x_mm`, `radius_um`, `width (µm)`);
//! the book's page of measures lists them.
//!
//! ```
//! use leafmodel::import::{Format, Wanted, read};
//!
//! let table = "from_x_mm,from_y_mm,to_x_mm,to_y_mm,radius_um\n0,0,0,10,80\n0,10,4,14,40\n";
//! let draft = read(Format::Table, table, None)?;
//! let imported = draft.network(&Wanted::default())?;
//! assert_eq!(imported.network.edges().len(), 2);
//! assert_eq!(imported.network.edges()[0].radius_from, 0.08);
//! // The table's own directions lead away from the petiole, so there is nothing to tell.
//! assert!(imported.faults.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adjacency;
mod courses;
mod draft;
mod error;
mod faults;
mod fields;
mod geojson;
mod gml;
mod graph;
mod graphml;
mod json;
mod margins;
mod ready;
mod repair;
mod roots;
mod strokes;
mod tables;
#[cfg(test)]
mod tests;

pub use self::draft::Draft;
pub use self::error::ImportError;
pub use self::faults::{Fault, FaultKind};
pub use self::ready::{Imported, Wanted};
use crate::document::rows::Form;

/// A format of networks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `GraphML`.
    GraphMl,
    /// JSON: ours, or node-link lists, or `GeoJSON`.
    Json,
    /// Tables of edges, and of nodes.
    Table,
    /// Drawings: paths with stroke widths.
    Svg,
    /// GML.
    Gml,
    /// Lists of neighbours, as NEFI writes them.
    Neighbours,
}

impl Format {
    /// Endings of file names and their formats.
    pub const ENDINGS: [(&'static str, Self); 8] = [
        ("graphml", Self::GraphMl),
        ("json", Self::Json),
        ("geojson", Self::Json),
        ("csv", Self::Table),
        ("tsv", Self::Table),
        ("svg", Self::Svg),
        ("gml", Self::Gml),
        ("txt", Self::Neighbours),
    ];

    /// The format of files with an ending, in upper or lower case.
    pub fn of_ending(ending: &str) -> Option<Self> {
        let found = Self::ENDINGS
            .iter()
            .find(|(known, _)| ending.eq_ignore_ascii_case(known));
        found.map(|(_, format)| *format)
    }
}

/// Reads a network as its file tells it; `nodes` is the text of a table of nodes beside a table of
/// edges.
///
/// # Errors
///
/// [`ImportError`] if the text does not follow its format.
pub fn read(format: Format, text: &str, nodes: Option<&str>) -> Result<Draft, ImportError> {
    read_written(format, text, nodes, Form::default())
}

/// As [`read`], where more may be known of how tables are written.
///
/// # Errors
///
/// As [`read`].
pub fn read_written(
    format: Format,
    text: &str,
    nodes: Option<&str>,
    form: Form,
) -> Result<Draft, ImportError> {
    if is_blank(text) {
        return Err(ImportError::Empty);
    }
    let draft = match format {
        Format::GraphMl => graphml::read(text)?,
        Format::Json => json::read(text)?,
        Format::Table => tables::read(text, nodes, form)?,
        Format::Svg => strokes::read(text)?,
        Format::Gml => gml::read(text)?,
        Format::Neighbours => adjacency::read(text)?,
    };
    Ok(draft)
}

/// Reads the margins of a file as it tells them: of a drawing the path called `margin`, or else the
/// first path.
///
/// # Errors
///
/// [`ImportError`] if the text does not follow its format, or holds no margin.
pub fn read_margin(format: Format, text: &str) -> Result<Draft, ImportError> {
    if is_blank(text) {
        return Err(ImportError::Empty);
    }
    let draft = match format {
        Format::Svg => strokes::read_margin(text)?,
        Format::Json => json::read_margin(text)?,
        Format::GraphMl => graphml::read(text)?,
        Format::Table => tables::read(text, None, Form::default())?,
        Format::Gml => gml::read(text)?,
        Format::Neighbours => adjacency::read(text)?,
    };
    if !draft.has_margin() {
        return Err(ImportError::bad_margin("there is none"));
    }
    Ok(draft)
}

fn is_blank(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim().is_empty()
}
