//! The sources of the figures behind the finer pigments and the leaf of layers.

use leafmodel::optics::Pigments;
use leafmodel::optics::layers::Anatomy;

use crate::report::table::in_columns;

/// Every figure with its unit, reliability and source.
pub(crate) fn table() -> String {
    let layers = Anatomy::figures().into_iter().map(|mut figure| {
        figure.of.insert_str(0, "leaf of layers, ");
        figure
    });
    let figures = Pigments::figures().into_iter().chain(layers).map(|figure| {
        [
            figure.of,
            figure.value.to_string(),
            figure.unit.to_owned(),
            figure.basis.word().to_owned(),
            figure.source.to_owned(),
        ]
    });
    in_columns(["figure", "value", "unit", "trust", "source"], figures)
}
