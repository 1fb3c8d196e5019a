//! The leaf that `lamina optics` computes, and the sources of its numbers.

use leafmodel::optics::presets::{self, Preset};
use leafmodel::optics::{
    Coefficients, Constituent, Contents, Model, PerConstituent, Pigments, ProspectD,
};
use serde_json::{Value, json};

use crate::cli::arguments::OpticsArguments;
use crate::cli::model;
use crate::cli::terminal::Failure;
use crate::report::table::in_columns;
use leafmodel::document::nearest::meant;

/// The default leaf.
const DEFAULT: Contents = Contents::of(&[
    (Constituent::Structure, 1.5),
    (Constituent::Chlorophyll, 40.0),
    (Constituent::Carotenoids, 8.0),
    (Constituent::Water, 0.01),
    (Constituent::DryMatter, 0.009),
]);

/// The default leaf in a model: without what the model does not have.
fn default_in(model: Model) -> Contents {
    let mut contents = DEFAULT;
    for (constituent, value) in contents.iter_mut() {
        if !model.takes(constituent) {
            *value = 0.0;
        }
    }
    if model.takes(Constituent::Proteins) {
        contents = contents.with(&[
            (Constituent::Proteins, 0.001),
            (Constituent::CarbonBased, 0.008),
        ]);
    }
    contents
}

/// The leaf, and the sources of its numbers.
pub(super) struct Chosen {
    pub(super) contents: Contents,
    /// What each of them absorbs.
    pub(super) pigments: Pigments,
    preset: Option<Preset>,
    given: PerConstituent<(&'static str, Option<f64>)>,
}

pub(super) fn choose(arguments: &OpticsArguments) -> Result<Chosen, Failure> {
    let preset = match &arguments.preset {
        Some(name) => Some(presets::by_name(name).ok_or_else(|| unknown_preset(name))?),
        None => None,
    };
    let given = arguments.numbers();
    let pigments = model::pigments(&arguments.model)?;
    let mut usual = preset.map_or_else(|| default_in(pigments.model), |preset| preset.contents);
    let is_given = |of: Constituent| given[of].1.is_some();
    if Constituent::DRY_MATTER_PARTS.into_iter().any(is_given) {
        // They take the place of a preset's dry matter.
        usual[Constituent::DryMatter] = 0.0;
    }
    let contents = Contents(usual.zip_with(given, |usual, (_, given)| given.unwrap_or(usual)));
    let contents = contents.checked().map_err(Failure::bad)?;
    if let Some(problem) = model::refusal(&pigments, &contents) {
        bail!("{problem}");
    }
    Ok(Chosen {
        contents,
        pigments,
        preset,
        given,
    })
}

fn unknown_preset(wanted: &str) -> Failure {
    let presets = presets::ALL.iter();
    let meant = meant(wanted, presets.map(|preset| (preset.name, preset.about)));
    let meant = meant.map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    bad!(
        "there is no preset `{}`{meant} (`lamina optics --list` names the presets)",
        wanted.escape_debug()
    )
}

impl Chosen {
    /// The constants at a wavelength in nm, with the end values outside of the tables.
    pub(super) fn at(&self, nm: f64) -> Coefficients {
        ProspectD::coefficients_of(&self.pigments, nm)
    }

    /// The name of a content's option, without dashes.
    pub(super) fn option(&self, of: Constituent) -> &'static str {
        self.given[of].0.trim_start_matches('-')
    }

    /// Whether an option gives a content.
    pub(super) fn is_given(&self, of: Constituent) -> bool {
        self.given[of].1.is_some()
    }

    /// The contents that the model has, and all others of which there is something.
    fn listed(&self) -> impl Iterator<Item = (Constituent, f64)> {
        let model = self.pigments.model;
        let is_listed =
            move |(of, value): &(Constituent, f64)| model.inputs().contains(of) || *value > 0.0;
        self.contents.into_iter().filter(is_listed)
    }

    /// Preset and numbers in a line.
    pub(super) fn line(&self) -> String {
        let mut words = Vec::new();
        words.extend(self.preset.map(|preset| preset.name.to_owned()));
        for (constituent, value) in self.listed() {
            words.push(format!("{} {value}", self.option(constituent)));
        }
        words.join(" ")
    }

    /// The contents by name.
    pub(super) fn json(&self) -> Value {
        let all = self.contents.into_iter();
        all.map(|(constituent, value)| (constituent.name().to_owned(), json!(value)))
            .collect()
    }

    /// Every number with its unit and source.
    pub(super) fn about(&self) -> String {
        let rows = self.listed().map(|(constituent, value)| {
            let unit = constituent.counted_in().to_owned();
            let basis = match (self.given[constituent], &self.preset) {
                ((option, Some(_)), _) => format!("given by {option}"),
                ((_, None), Some(preset)) => preset.basis_of(constituent).word().to_owned(),
                ((_, None), None) => "default of this command".to_owned(),
            };
            let what = constituent.words().to_owned();
            [what, value.to_string(), unit, basis]
        });
        let mut text = String::new();
        if let Some(preset) = self.preset {
            text += &format!("{}: {}\n", preset.name, preset.about);
        }
        text + &in_columns(["content", "value", "unit", "rests on"], rows)
    }
}

/// Warns of leaves that no plant has.
pub(super) fn warn_of_mixtures(leaves: &[Contents]) {
    let count = leaves
        .iter()
        .filter(|leaf| leaf.mixes_betalains_and_anthocyanins())
        .count();
    if count > 0 {
        let who = if leaves.len() == 1 {
            "this leaf holds".to_owned()
        } else {
            format!("{count} of {} leaves hold", leaves.len())
        };
        eprintln!(
            "warning: {who} betalains and anthocyanins, which never occur in the same plant: {}",
            Contents::NEVER_TOGETHER
        );
    }
}
