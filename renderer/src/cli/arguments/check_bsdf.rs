//! `lamina check-bsdf` as written.

use std::path::PathBuf;

use clap::Args;

use super::tables::{ReadingTablesArguments, angles};
use crate::measured::known::AngleUnit;

pub(super) const EXAMPLES: &str = "\
Columns: theta_i, phi_i, theta_o, phi_o (degrees from and around the normal), wavelength (nm),
value (per steradian, without the cosine).
Examples:
  lamina check-bsdf leaf-brdf.csv
  lamina check-bsdf leaf-brdf.csv --out reciprocal.csv";

/// `lamina check-bsdf`: reciprocity and energy of a measured table over angles.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CheckBsdfArguments {
    /// Table of a BRDF, a BTDF or both
    #[arg(value_name = "TABLE.csv")]
    pub table: PathBuf,
    /// How the table is read.
    #[command(flatten)]
    pub reading: ReadingTablesArguments,
    /// Unit of angles: degrees or radians; by default found from the names of columns and the sizes of
    /// angles
    #[arg(long, value_name = "UNIT", value_parser = angles)]
    pub angles: Option<AngleUnit>,
    /// Reciprocal part and error of each row to write as csv, or figures as json
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}
