//! `lamina tonemap`, as written.

use std::path::PathBuf;

use clap::Args;

/// `lamina tonemap`: the keys of `[picture]` as flags.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct TonemapArguments {
    /// The picture as rendered
    #[arg(value_name = "IN.exr")]
    pub picture: PathBuf,
    /// File to write: png or jpg
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Radiance is multiplied by 2 to this power, instead of the scene's
    #[arg(long, value_name = "EV", allow_hyphen_values = true)]
    exposure_ev: Option<String>,
    /// Whether light is brought to middle grey first; the exposure is then more or less than that
    #[arg(long, value_name = "true|false", num_args = 0..=1, default_missing_value = "true")]
    auto_exposure: Option<String>,
    /// An object that is brought to middle grey first, such as a grey card
    #[arg(long, value_name = "OBJECT")]
    grey_object: Option<String>,
    /// An object that comes out without colour, such as a grey card
    #[arg(long, value_name = "OBJECT")]
    white_object: Option<String>,
    /// The light that comes out white: d65, or a colour temperature in K
    #[arg(long, value_name = "WHITE")]
    white: Option<String>,
    /// How light becomes what a display shows: agx, standard, filmic or none
    #[arg(long, value_name = "TONE")]
    tone: Option<String>,
    /// Whether a png has 16 bits a channel instead of 8
    #[arg(long, value_name = "true|false", num_args = 0..=1, default_missing_value = "true")]
    sixteen_bits: Option<String>,
    /// Whether a png has an alpha channel
    #[arg(long, value_name = "true|false", num_args = 0..=1, default_missing_value = "true")]
    alpha: Option<String>,
}

impl TonemapArguments {
    /// The flags as overrides of the scene.
    pub fn overrides(&self) -> Vec<String> {
        let flags = [
            ("exposure_ev", &self.exposure_ev),
            ("auto_exposure", &self.auto_exposure),
            ("grey_object", &self.grey_object),
            ("white_object", &self.white_object),
            ("white", &self.white),
            ("tone", &self.tone),
            ("sixteen_bits", &self.sixteen_bits),
            ("alpha", &self.alpha),
        ];
        let given = flags
            .into_iter()
            .filter_map(|(key, value)| Some((key, value.as_ref()?)));
        given
            .map(|(key, value)| format!("picture.{key}={value}"))
            .collect()
    }
}
