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
    /// A light of the scene whose spectrum comes out white
    #[arg(long, value_name = "LIGHT")]
    white_light: Option<String>,
    /// The light that comes out white: d65, or a colour temperature in K
    #[arg(long, value_name = "WHITE")]
    white: Option<String>,
    /// How light becomes what a display shows: agx, standard, filmic or none
    #[arg(long, value_name = "TONE")]
    tone: Option<String>,
    /// Slope of agx at middle grey over its usual one
    #[arg(long, value_name = "FACTOR")]
    contrast: Option<String>,
    /// Whether a png has 16 bits a channel instead of 8
    #[arg(long, value_name = "true|false", num_args = 0..=1, default_missing_value = "true")]
    sixteen_bits: Option<String>,
    /// Whether a png has an alpha channel
    #[arg(long, value_name = "true|false", num_args = 0..=1, default_missing_value = "true")]
    alpha: Option<String>,
}

impl TonemapArguments {
    /// The flags as overrides of the scene. A flag that says what is white takes the place of
    /// whatever the scene said of that.
    pub fn overrides(&self) -> Vec<String> {
        let flags = [
            ("exposure_ev", &self.exposure_ev),
            ("auto_exposure", &self.auto_exposure),
            ("grey_object", &self.grey_object),
            ("tone", &self.tone),
            ("contrast", &self.contrast),
            ("sixteen_bits", &self.sixteen_bits),
            ("alpha", &self.alpha),
        ];
        let whites = [
            ("white", &self.white, "d65"),
            ("white_object", &self.white_object, ""),
            ("white_light", &self.white_light, ""),
        ];
        let is_said = whites
            .iter()
            .any(|(_, flag, _)| flag.as_ref().is_some_and(|value| !value.is_empty()));
        let whites = whites.into_iter().filter_map(|(key, flag, none)| {
            let value = flag.as_deref().or(is_said.then_some(none))?;
            Some((key, value))
        });
        let given = flags
            .into_iter()
            .filter_map(|(key, value)| Some((key, value.as_deref()?)));
        given
            .chain(whites)
            // Values are typed as in a file, where nothing is no value.
            .map(|(key, value)| (key, if value.is_empty() { "\"\"" } else { value }))
            .map(|(key, value)| format!("picture.{key}={value}"))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::TonemapArguments;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: TonemapArguments,
    }

    fn overrides(flags: &[&str]) -> Vec<String> {
        let line = ["tonemap", "in.exr", "--out", "out.png"];
        let line = Line::try_parse_from(line.iter().chain(flags));
        line.expect("the flags are right").arguments.overrides()
    }

    #[test]
    fn what_is_reported_of_white_takes_the_place_of_the_scenes() {
        assert_eq!(overrides(&[]), [""; 0]);
        assert_eq!(overrides(&["--tone", "agx"]), ["picture.tone=agx"]);
        let white = overrides(&["--white-light", "lamp"]);
        let expected = [
            "picture.white=d65",
            "picture.white_object=\"\"",
            "picture.white_light=lamp",
        ];
        assert_eq!(white, expected);
        // An empty name takes only that name away.
        assert_eq!(
            overrides(&["--white-object", ""]),
            ["picture.white_object=\"\""]
        );
    }
}
