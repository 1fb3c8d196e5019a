//! `lamina optics` as written.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use leafmodel::optics::{Constituent, PerConstituent};

use super::model::ModelArguments;
use super::numbers::number;
use super::tables::TableArguments;

/// `lamina optics`: a preset, PROSPECT's inputs and betalains, and what is to be written about them.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(group = ArgGroup::new("wanted").args(["list", "figures", "out", "colour", "layers", "angles", "about"]).required(true).multiple(true))]
#[command(group = ArgGroup::new("by_wavelength").args(["angles", "table"]))]
pub struct OpticsArguments {
    /// Start from the contents of a preset; numbers that are given take the place of its own
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Name the presets
    #[arg(long, exclusive = true)]
    pub list: bool,
    /// Print every figure behind the finer pigments and the leaf of layers, how far it can be trusted, and its source
    #[arg(long, exclusive = true)]
    pub figures: bool,
    /// Structure N, number of plates, at least 1 [default: 1.5]
    #[arg(long, value_parser = in_range(Constituent::Structure))]
    pub n: Option<f64>,
    /// Chlorophyll a + b, µg/cm² [default: 40]
    #[arg(long, value_parser = in_range(Constituent::Chlorophyll))]
    pub cab: Option<f64>,
    /// Carotenoids, µg/cm² [default: 8]
    #[arg(long, value_parser = in_range(Constituent::Carotenoids))]
    pub car: Option<f64>,
    /// Anthocyanins, µg/cm² [default: 0]
    #[arg(long, value_parser = in_range(Constituent::Anthocyanins))]
    pub ant: Option<f64>,
    /// Betacyanins (betanin), µg/cm²; not in PROSPECT-D [default: 0]
    #[arg(long, value_name = "BETACYANINS", value_parser = in_range(Constituent::Betacyanins))]
    pub betacyanins: Option<f64>,
    /// Betaxanthins (indicaxanthin), µg/cm²; not in PROSPECT-D [default: 0]
    #[arg(long, value_name = "BETAXANTHINS", value_parser = in_range(Constituent::Betaxanthins))]
    pub betaxanthins: Option<f64>,
    /// Brown pigments, PROSPECT's unit [default: 0]
    #[arg(long, value_parser = in_range(Constituent::Brown))]
    pub brown: Option<f64>,
    /// Water, cm [default: 0.01]
    #[arg(long, value_parser = in_range(Constituent::Water))]
    pub cw: Option<f64>,
    /// Dry matter, g/cm² [default: 0.009]
    #[arg(long, value_parser = in_range(Constituent::DryMatter))]
    pub cm: Option<f64>,
    /// Proteins, g/cm², in place of dry matter; prospect-pro [default: 0.001]
    #[arg(long, value_name = "PROTEINS", value_parser = in_range(Constituent::Proteins))]
    pub proteins: Option<f64>,
    /// Carbon-based constituents, g/cm², in place of dry matter; prospect-pro [default: 0.008]
    #[arg(long, value_name = "CBC", value_parser = in_range(Constituent::CarbonBased))]
    pub cbc: Option<f64>,
    /// What the table of --extra-absorption describes, µg/cm² [default: 0]
    #[arg(long, value_name = "EXTRA", value_parser = in_range(Constituent::Extra))]
    pub extra: Option<f64>,
    /// What each of them absorbs.
    #[command(flatten)]
    pub model: ModelArguments,
    /// A leaf in each row: columns are named as these options (`cab`) or as `lamina fit --out` names
    /// them (`chlorophyll_ug_per_cm2`), `leaf` or `id` names the leaf, and options or the preset
    /// give what has no column; --out is then `leaf,wavelength_nm,R,T`, or an `.npy` array
    #[arg(long, value_name = "LEAVES.csv", requires = "out", conflicts_with_all = ["colour", "layers", "angles", "about"])]
    pub table: Option<PathBuf>,
    /// How the table is written.
    #[command(flatten)]
    pub form: TableArguments,
    /// Table to write: `wavelength_nm,R,T`; `-` is the standard output; with --table also `.npy`,
    /// float64 by leaf, R and T, wavelength
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// Print the colours of R and T under D65 (XYZ by CIE 1931 2°, sRGB), or write them as JSON
    #[arg(long, value_name = "FILE.json", num_args = 0..=1)]
    pub colour: Option<Option<PathBuf>>,
    /// Print both faces of the leaf as five layers at 450, 550, 680 and 800 nm, beside PROSPECT-D and
    /// the rule by which scenes find the abaxial face, or write them, and what each layer absorbs, at
    /// every nanometre; `-` is the standard output
    #[arg(long, value_name = "FILE.csv", num_args = 0..=1, conflicts_with_all = ["model", "extra_absorption"])]
    pub layers: Option<Option<PathBuf>>,
    /// BRDF and BTDF of both faces of the leaf as five layers, by incidence, view and azimuth, as a
    /// table; `-` is the standard output
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["model", "extra_absorption"])]
    pub angles: Option<PathBuf>,
    /// Wavelengths of --angles [default: 450,550,680,800] or --table [default: each nanometre], 400 to
    /// 2500
    #[arg(long, value_name = "NM", value_delimiter = ',', requires = "by_wavelength", value_parser = in_table)]
    pub nm: Vec<f64>,
    /// Give means over ranges of directions in that table instead, beside what so many photons find,
    /// 1000 to 1000000000, with standard errors
    #[arg(long, value_name = "N", requires = "angles", value_parser = clap::value_parser!(u64).range(1000..=1_000_000_000))]
    pub photons: Option<u64>,
    /// Print every number with what it rests on
    #[arg(long)]
    pub about: bool,
}

impl OpticsArguments {
    /// The numbers that are given, with their options' names.
    pub fn numbers(&self) -> PerConstituent<(&'static str, Option<f64>)> {
        PerConstituent::from_fn(|constituent| match constituent {
            Constituent::Structure => ("--n", self.n),
            Constituent::Chlorophyll => ("--cab", self.cab),
            Constituent::Carotenoids => ("--car", self.car),
            Constituent::Anthocyanins => ("--ant", self.ant),
            Constituent::Betacyanins => ("--betacyanins", self.betacyanins),
            Constituent::Betaxanthins => ("--betaxanthins", self.betaxanthins),
            Constituent::Brown => ("--brown", self.brown),
            Constituent::Water => ("--cw", self.cw),
            Constituent::DryMatter => ("--cm", self.cm),
            Constituent::Proteins => ("--proteins", self.proteins),
            Constituent::CarbonBased => ("--cbc", self.cbc),
            Constituent::Extra => ("--extra", self.extra),
        })
    }
}

fn in_table(text: &str) -> Result<f64, String> {
    let refused = "write a wavelength from 400 to 2500 nm";
    number(
        text,
        |nm| (400.0..=2500.0).contains(&nm),
        ["not a number", refused],
    )
}

/// A number in the range of a constituent.
fn in_range(of: Constituent) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let [low, high] = of.range();
        let refused = format!("write a number from {low} to {high}");
        let messages = ["not a number".to_owned(), refused];
        number(text, |value| (low..=high).contains(&value), messages)
    }
}
