//! `lamina fit` as written.

use std::path::PathBuf;

use clap::Args;

/// `lamina fit`: contents of leaves from their spectra.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct FitArguments {
    /// Table of spectra: wavelengths, and a column R, T or both for each leaf
    #[arg(value_name = "SPECTRA.csv")]
    pub spectra: PathBuf,
    /// Contents that are looked for: structure, chlorophyll, … [default: all of PROSPECT-D]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub free: Vec<String>,
    /// A content that is known: --fix water=0.012
    #[arg(long, value_name = "NAME=VALUE")]
    pub fix: Vec<String>,
    /// Wavelengths that count, nm; the default is all from 400 to 2500
    #[arg(long, value_name = "FROM..TO")]
    pub range: Option<String>,
    /// Contents of each leaf to write: csv or json
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Measured and fitted spectra to write, and what is left
    #[arg(long, value_name = "FILE.csv")]
    pub spectra_out: Option<PathBuf>,
    /// Drawing of measured and fitted spectra of the first leaves to write
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}
