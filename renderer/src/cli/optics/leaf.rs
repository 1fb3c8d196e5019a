//! Which leaf `lamina optics` computes, and what each of its numbers rests on.

use leafmodel::optics::Contents;
use leafmodel::optics::presets::{self, Preset};
use serde_json::{Value, json};

use crate::cli::Failure;
use crate::cli::arguments::OpticsArguments;
use crate::cli::columns::in_columns;
use leafmodel::document::nearest::nearest;

/// A leaf of which nothing is said.
const DEFAULT: Contents = Contents {
    structure: 1.5,
    chlorophyll: 40.0,
    carotenoids: 8.0,
    anthocyanins: 0.0,
    betacyanins: 0.0,
    betaxanthins: 0.0,
    brown: 0.0,
    water: 0.01,
    dry_matter: 0.009,
};

/// What a number is, as a table says it, and what stands for its unit if it has none.
const ABOUT: [(&str, &str); Contents::COUNT] = [
    ("structure N", "plates"),
    ("chlorophyll a + b", ""),
    ("carotenoids", ""),
    ("anthocyanins", ""),
    ("betacyanins", ""),
    ("betaxanthins", ""),
    ("brown pigments", "PROSPECT's unit"),
    ("water", ""),
    ("dry matter", ""),
];

/// The leaf, and where its numbers are from.
pub(super) struct Chosen {
    pub(super) contents: Contents,
    preset: Option<Preset>,
    given: [(&'static str, Option<f64>); Contents::COUNT],
}

pub(super) fn choose(arguments: &OpticsArguments) -> Result<Chosen, Failure> {
    let preset = match &arguments.preset {
        Some(name) => Some(presets::by_name(name).ok_or_else(|| unknown_preset(name))?),
        None => None,
    };
    let given = arguments.numbers();
    let mut values = preset.map_or(DEFAULT, |preset| preset.contents).to_array();
    for (value, (_, given)) in values.iter_mut().zip(given) {
        *value = given.unwrap_or(*value);
    }
    let contents = Contents::from_array(values)
        .checked()
        .map_err(Failure::bad)?;
    Ok(Chosen {
        contents,
        preset,
        given,
    })
}

fn unknown_preset(wanted: &str) -> Failure {
    let names = presets::ALL.iter().map(|preset| preset.name);
    let meant =
        nearest(wanted, names).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    Failure::bad(format!(
        "there is no preset `{}`{meant} (`lamina optics --list` names the presets)",
        wanted.escape_debug()
    ))
}

impl Chosen {
    /// Preset and numbers in a line.
    pub(super) fn line(&self) -> String {
        let mut words = Vec::new();
        words.extend(self.preset.map(|preset| preset.name.to_owned()));
        for ((option, _), value) in self.given.iter().zip(self.contents.to_array()) {
            words.push(format!("{} {value}", option.trim_start_matches('-')));
        }
        words.join(" ")
    }

    /// The contents by name.
    pub(super) fn json(&self) -> Value {
        let values = Contents::NAMES.into_iter().zip(self.contents.to_array());
        values
            .map(|(name, value)| (name.to_owned(), json!(value)))
            .collect()
    }

    /// Every number with its unit and what it rests on.
    pub(super) fn about(&self) -> String {
        let head = ["content", "value", "unit", "rests on"].map(str::to_owned);
        let mut rows = vec![head];
        let values = self.contents.to_array();
        for (index, ((what, other), value)) in ABOUT.into_iter().zip(values).enumerate() {
            let unit = Contents::UNITS[index].to_owned() + other;
            let basis = match (self.given[index], &self.preset) {
                ((option, Some(_)), _) => format!("given by {option}"),
                ((_, None), Some(preset)) => preset.basis_of(index).word().to_owned(),
                ((_, None), None) => "default of this command".to_owned(),
            };
            rows.push([what.to_owned(), value.to_string(), unit, basis]);
        }
        let mut text = String::new();
        if let Some(preset) = self.preset {
            text += &format!("{}: {}\n", preset.name, preset.about);
        }
        text + &in_columns(&rows)
    }
}
