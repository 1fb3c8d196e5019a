//! The version of PROSPECT, and a constituent of the user's own, as written.

use std::path::PathBuf;

use clap::Args;
use leafmodel::document::declared::Words;
use leafmodel::optics::Model;

use super::tables::word;

/// What one unit of each constituent absorbs.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct ModelArguments {
    /// Version of PROSPECT: prospect-d, prospect-pro (proteins and carbon-based constituents in place of
    /// dry matter), prospect-5 (no anthocyanins) or prospect-4 (chlorophyll, water, dry matter) [default:
    /// prospect-d]
    #[arg(long, value_name = "MODEL", value_parser = |text: &str| word(text, Model::WORDS))]
    pub model: Option<Model>,
    /// What a constituent of your own absorbs: a table with the columns `wavelength_nm` and
    /// `absorption_cm2_per_ug` or `absorption_cm2_per_g`, over 400 to 2500 nm
    #[arg(long, value_name = "TABLE.csv")]
    pub extra_absorption: Option<PathBuf>,
}
