//! The commands that read tables of measurements, as written.

use std::path::PathBuf;

use clap::Args;

use super::model::ModelArguments;
use super::tables::{ReadingTablesArguments, word};
use crate::measured::known::{AngleUnit, Known, Measure, Overlap, ValueUnit};

/// `lamina fit`: contents of leaves from their spectra.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct FitArguments {
    /// Table of spectra: wavelengths, and for each leaf columns R, T, abaxial R or some of these
    #[arg(value_name = "SPECTRA.csv", required_unless_present_any = ["adaxial", "abaxial", "transmittance"])]
    pub spectra: Option<PathBuf>,
    /// Reflectance of one leaf's adaxial face instead: a file of one spectrum, as a table of two
    /// columns, ASCII export of an ASD, or .sig of an SVC
    #[arg(long, value_name = "FILE", conflicts_with = "spectra")]
    pub adaxial: Option<PathBuf>,
    /// Reflectance of its abaxial face
    #[arg(long, value_name = "FILE", conflicts_with = "spectra")]
    pub abaxial: Option<PathBuf>,
    /// Its transmittance
    #[arg(long, value_name = "FILE", conflicts_with = "spectra")]
    pub transmittance: Option<PathBuf>,
    /// How tables and files are read.
    #[command(flatten)]
    pub reading: ReadingTablesArguments,
    /// Unit of reflectance and transmittance: fraction or percent; by default found from the names of
    /// columns and the sizes of values
    #[arg(long, value_name = "UNIT", value_parser = |text: &str| word(text, &ValueUnit::ALL))]
    pub values: Option<ValueUnit>,
    /// What values are whose columns do not say it: reflectance, abaxial or transmittance; for tables
    /// whose columns are named by wavelengths, or by leaves
    #[arg(long, value_name = "WORD", value_parser = |text: &str| word(text, &Measure::ALL))]
    pub quantity: Option<Measure>,
    /// Where two detectors of a .sig file have measured: the first counts, the second, or each up to
    /// the middle [default: middle]
    #[arg(long, value_name = "WORD", value_parser = |text: &str| word(text, &Overlap::ALL))]
    pub overlap: Option<Overlap>,
    /// The number in bands that were masked; by default empty values, NA, NaN, -9999 and such
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    pub masked: Option<f64>,
    /// What one unit of each constituent absorbs.
    #[command(flatten)]
    pub model: ModelArguments,
    /// Contents that are looked for: structure, chlorophyll, … [default: all of the model]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub free: Vec<String>,
    /// A content that is known: --fix water=0.012
    #[arg(long, value_name = "NAME=VALUE")]
    pub fix: Vec<String>,
    /// What is known of a content beforehand: its mean and standard deviation, --prior
    /// chlorophyll=40+-10, or its range, --prior water=0.005..0.02
    #[arg(long, value_name = "NAME=PRIOR")]
    pub prior: Vec<String>,
    /// Wavelengths that count, nm; the default is all from 400 to 2500
    #[arg(long, value_name = "FROM..TO")]
    pub range: Option<String>,
    /// Contents of each leaf to write: csv or json
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Measured and fitted spectra to write, and what is left
    #[arg(long, value_name = "FILE.csv")]
    pub spectra_out: Option<PathBuf>,
    /// Covariances of the contents of each leaf to write; --out FILE.json holds them too
    #[arg(long, value_name = "FILE.csv")]
    pub covariance_out: Option<PathBuf>,
    /// Drawing of measured and fitted spectra of the first leaves to write
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl FitArguments {
    /// What is known of the files.
    pub fn known(&self) -> Known {
        Known {
            values: self.values,
            quantity: self.quantity,
            overlap: self.overlap,
            masked: self.masked,
            ..self.reading.known()
        }
    }
}

pub(super) const CHECK_BSDF_EXAMPLES: &str = "\
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
    #[arg(long, value_name = "UNIT", value_parser = |text: &str| word(text, &AngleUnit::ALL))]
    pub angles: Option<AngleUnit>,
    /// Reciprocal part and error of each row to write as csv, or figures as json
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}
