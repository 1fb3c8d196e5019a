//! Errors of a task where the sweep says what causes them.

use std::collections::BTreeSet;

use leafmodel::document::error::LocatedError;
use leafmodel::document::report::DocumentErrors;

use super::tasks::{Sweep, Task};

/// Most tasks whose errors are told.
const TOLD: usize = 20;

/// The errors of tasks, as far as they differ.
#[derive(Debug, Default)]
pub struct Refused {
    located: Vec<LocatedError>,
    /// Where something was told, and its code: the values of a range have one place.
    seen: BTreeSet<(usize, usize, &'static str)>,
    /// Errors that no setting alone causes, with the task.
    others: Vec<String>,
}

impl Refused {
    /// Takes in why the target refuses a task. Overrides were given in the order of
    /// [`Sweep::fixed`] and then of [`Task::overrides`].
    pub fn add(&mut self, sweep: &Sweep, task: &Task<'_>, errors: &DocumentErrors) {
        let mut others = Vec::new();
        for located in errors.errors() {
            let place = located.at.as_ref().and_then(|at| {
                // Number 0 is the target's text; overrides follow.
                let number = at.source.checked_sub(1 + sweep.fixed.len())?;
                let (key, cell) = task.settings.get(number)?;
                let text = &errors.sources().get(at.source)?.text;
                let is_value = text.find('=').is_some_and(|equals| at.span.start > equals);
                Some(if is_value { &cell.at } else { &key.at })
            });
            let Some(place) = place else {
                others.push(located.clone());
                continue;
            };
            let error = located.error.clone();
            let told = (place.source, place.span.start, error.code());
            if self.seen.insert(told) {
                let at = Some(place.clone());
                self.located.push(LocatedError { error, at });
            }
        }
        if !others.is_empty() && self.others.len() < TOLD {
            let settings: Vec<String> = task.overrides().collect();
            let sources = errors.sources().clone().into();
            let report = DocumentErrors::new(sources, others);
            let text = format!("task {}, {}:\n{report}", task.number, settings.join(" "));
            self.others.push(text);
        }
    }

    /// Whether there is any.
    pub fn is_empty(&self) -> bool {
        self.located.is_empty() && self.others.is_empty()
    }

    /// Whether enough are known to be told.
    pub fn is_enough(&self) -> bool {
        self.located.len() + self.others.len() >= TOLD
    }

    /// The whole report; `colour` adds terminal escapes.
    pub fn render(mut self, sweep: &Sweep, colour: bool) -> String {
        let mut text = self.others.join("\n\n");
        if !self.located.is_empty() {
            self.located.sort_by_key(|located| {
                let at = located.at.as_ref();
                at.map(|at| (at.source, at.span.start))
            });
            let sources = sweep.sources.clone().into();
            let report = DocumentErrors::new(sources, self.located);
            if !text.is_empty() {
                text.push_str("\n\n");
            }
            text.push_str(&report.render(colour));
        }
        text.push('\n');
        text
    }
}
