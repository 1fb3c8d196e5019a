//! The keys that are free, and leaves grown with values for them.

use std::sync::atomic::{AtomicBool, Ordering};

use leafmodel::document::written::Extent;
use leafmodel::grow_options::GrowOptions;
use leafmodel::inference::{Draw, Observation, Outcome, Parameter};
use leafmodel::leaf::LeafPlan;
use leafmodel::measure::measure;
use leafmodel::plan_file::leaf_to_toml;
use leafmodel::plan_file::one_leaf::{LeafFile, load_one_leaf};

use super::observed::Observed;
use crate::cli::arguments::FitVeinsArguments;
use crate::cli::grow::{self, Wish};
use crate::cli::terminal::Failure;
use crate::scene::assets::DECODER;

const GIB: f64 = 1024.0 * 1024.0 * 1024.0;

/// Ratio of areas from which on a leaf and its simulations are told to differ in size.
const UNLIKE: f64 = 1.2;

/// A leaf with free keys.
#[derive(Debug)]
pub(super) struct Grower {
    name: String,
    plan: LeafPlan,
    parameters: Vec<Parameter>,
    most_bytes: f64,
}

impl Grower {
    /// Chooses the leaf, and tries both ends of each range.
    pub(super) fn new(arguments: &FitVeinsArguments) -> Result<Self, Failure> {
        let (name, plan) = grow::named_plan(Wish {
            leaf: &arguments.leaf,
            overrides: &arguments.overrides,
            settings: &arguments.set,
            seed: None,
        })?;
        let mut grower = Self {
            name,
            plan,
            parameters: Vec::new(),
            most_bytes: arguments.memory * GIB,
        };
        let ranges: Vec<(&str, f64, f64)> = arguments
            .free
            .iter()
            .map(|word| range(word))
            .collect::<Result<_, _>>()?;
        for (key, low, high) in &ranges {
            let parameter = grower.parameter(key, *low, *high)?;
            grower.parameters.push(parameter);
        }
        grower.refuse_idle_keys()?;
        Ok(grower)
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The leaf as a file of all of its keys.
    pub(super) fn file(&self) -> String {
        leaf_to_toml(&self.name, &self.plan, Extent::All)
    }

    /// What a user should know of the leaf before it is grown.
    pub(super) fn notes(&self, observed: &Observed) -> Vec<String> {
        let mut notes = Vec::new();
        let grown = self.plan.grow_outline().ok().map(|outline| outline.area());
        if let (Some(grown), Some(measured)) = (grown, observed.area_mm2)
            && !(1.0 / UNLIKE..UNLIKE).contains(&(grown / measured))
        {
            notes.push(format!(
                "the leaf that was measured has {measured:.0} mm², those that are grown {grown:.0}: \
                 set length_mm, or give the leaf the outline of the other"
            ));
        }
        notes
    }

    /// The plan with these values.
    fn plan(&self, settings: &[String]) -> Result<LeafPlan, Failure> {
        let file = LeafFile::Plan {
            name: &self.name,
            plan: &self.plan,
        };
        let leaf = load_one_leaf(file, Some(&DECODER), true, &[], settings);
        let (leaf, _) = leaf.map_err(|error| Failure::from(grow::NotChosen::from(error)))?;
        Ok(leaf.value)
    }

    /// A free key, after both ends and a place between them have been tried.
    fn parameter(&self, key: &str, low: f64, high: f64) -> Result<Parameter, Failure> {
        let parameter = Parameter::new(key, low, high);
        let parameter =
            parameter.map_err(|error| bad!("--free {error}: write {key}=LO..HI with LO < HI"))?;
        let with = |value: f64| self.plan(&[setting(key, value)]);
        // Keys are looked up as those of --set.
        with(low).map_err(|failure| match failure {
            Failure::BadInput(text) => Failure::BadInput(text.replacen("--set ", "--free ", 1)),
            Failure::System(_) | Failure::Interrupted => failure,
        })?;
        with(high)?;
        // No multiple of a simple fraction: between whole numbers it is none.
        let between = low + 0.381_966 * (high - low);
        match with(between) {
            Ok(_) => Ok(parameter),
            // Whole ends were taken, and so is a whole number between them: the key is a count.
            Err(_) if with(between.round()).is_ok() => Ok(parameter.whole()),
            Err(failure) => Err(failure),
        }
    }

    /// Fails if a key changes nothing in the plan while all others stay: seeds, which each leaf
    /// gets, or one key written in two ways.
    fn refuse_idle_keys(&self) -> Result<(), Failure> {
        let at =
            |parameter: &Parameter, end: usize| setting(parameter.name(), parameter.range()[end]);
        for (index, free) in self.parameters.iter().enumerate() {
            let with = |end: usize| {
                let mut settings = vec![at(free, end)];
                let others = self.parameters.iter().enumerate();
                let others = others.filter(|(other, _)| *other != index);
                settings.extend(others.map(|(_, other)| at(other, 0)));
                let plan = self.plan(&settings)?;
                Ok::<_, Failure>(LeafPlan { seed: 0, ..plan })
            };
            if with(0)? == with(1)? {
                bail!(
                    "--free {}: the leaf does not change with it while the other free keys stay; \
                     each leaf has a seed of its own, and a key is free once",
                    free.name()
                );
            }
        }
        Ok(())
    }

    /// Grows a leaf and measures it; `None` if it was stopped.
    pub(super) fn outcome(
        &self,
        draw: &Draw,
        wanted: &[Observation],
        stop: &AtomicBool,
    ) -> Option<Outcome> {
        let is_stopped = || stop.load(Ordering::Relaxed);
        if is_stopped() {
            return None;
        }
        let outcome = self.grown(draw, wanted, &is_stopped);
        (!is_stopped()).then_some(outcome)
    }

    fn grown(&self, draw: &Draw, wanted: &[Observation], stop: &dyn Fn() -> bool) -> Outcome {
        let values = self.parameters.iter().zip(&draw.values);
        let settings: Vec<String> = values
            .map(|(parameter, value)| setting(parameter.name(), *value))
            .collect();
        let plan = self
            .plan(&settings)
            .map_err(|failure| first_line(&failure))?;
        let plan = LeafPlan {
            seed: draw.seed,
            ..plan
        };
        let bytes = plan.memory().map_err(|error| error.to_string())?.veins;
        if bytes > self.most_bytes {
            return Err(format!(
                "its veins need {:.1} GiB, more than --memory allows",
                bytes / GIB
            ));
        }
        let lamina = GrowOptions::stopped_by(stop).lamina(&plan);
        let lamina = lamina.map_err(|error| error.to_string())?;
        let exponent = plan.venation.murray_exponent();
        let measures = measure(&lamina.outline, &lamina.network, exponent);
        Ok(wanted.iter().map(|one| measures.number(&one.key)).collect())
    }
}

/// A value as `--set` takes it: the shortest text that reads back to the same bits.
fn setting(key: &str, value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        format!("{key}={value:.0}")
    } else {
        format!("{key}={value:?}")
    }
}

/// `KEY=LO..HI`.
fn range(word: &str) -> Result<(&str, f64, f64), Failure> {
    let refuse = |problem: String| {
        let word = word.escape_debug();
        bad!("--free {word}: {problem}; write KEY=LO..HI, as in kill_distance_segments=0.5..4")
    };
    let Some((key, ends)) = word.split_once('=') else {
        return Err(refuse("its range is missing".to_owned()));
    };
    let Some((low, high)) = ends.split_once("..") else {
        return Err(refuse(format!("{} is no range", ends.escape_debug())));
    };
    let key = key.trim();
    if key.is_empty() {
        return Err(refuse("its key is missing".to_owned()));
    }
    let number = |text: &str| match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) | Err(_) => Err(refuse(format!(
            "`{}` is no finite number",
            text.trim().escape_debug()
        ))),
    };
    let (low, high) = (number(low)?, number(high)?);
    if low >= high {
        return Err(refuse(format!("{low} is not less than {high}")));
    }
    Ok((key, low, high))
}

/// The first line of what a person would be told.
fn first_line(failure: &Failure) -> String {
    match failure {
        Failure::BadInput(text) | Failure::System(text) => {
            let line = text.lines().next().unwrap_or_default();
            line.trim_start_matches("error: ").to_owned()
        }
        Failure::Interrupted => "interrupted".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(word: &str) -> String {
        match range(word) {
            Err(Failure::BadInput(text)) => text,
            other => panic!("{word}: {other:?}"),
        }
    }

    #[test]
    fn ranges_are_read_or_refused_with_what_to_write() {
        let (key, low, high) = range("a.b = 1e-3 .. .5").expect("a range");
        assert_eq!((key, low, high), ("a.b", 1e-3, 0.5));
        assert!(refusal("kill").contains("its range is missing; write KEY=LO..HI"));
        assert!(refusal("kill=1").contains("1 is no range"));
        assert!(refusal("kill=1..nan").contains("`nan` is no finite number"));
        assert!(refusal("kill=..3").contains("`` is no finite number"));
        assert!(refusal("kill=3..3").contains("3 is not less than 3"));
        assert!(refusal("=3..4").contains("its key is missing"));
    }
}
