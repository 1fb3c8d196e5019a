//! Margin and veins in the formats that show them.

use std::path::Path;

use clap::ValueEnum;
use glam::DVec2;
use leafmodel::export::{self, SvgStyle};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;

/// A format that shows margin and veins, by the ending of its files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "lower")]
pub(crate) enum VeinFormat {
    Svg,
    Png,
    Json,
    GraphMl,
    GeoJson,
    Csv,
}

impl VeinFormat {
    /// The format of a file, by its ending.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        Self::from_str(path.extension()?.to_str()?, false).ok()
    }

    /// The file of a leaf on a page between two corners, mm; nothing if it is a picture of pixels.
    pub(crate) fn text(
        self,
        page: (DVec2, DVec2),
        outlines: &[Outline],
        network: &VenationNetwork,
        style: SvgStyle,
    ) -> Option<String> {
        match self {
            Self::Svg => Some(export::svg_within(page, outlines, network, style)),
            Self::Png => None,
            Self::Json => Some(export::json(outlines, network, true)),
            Self::GraphMl => Some(export::graphml(network)),
            Self::GeoJson => Some(export::geojson(outlines, network)),
            Self::Csv => Some(export::table(network)),
        }
    }
}
