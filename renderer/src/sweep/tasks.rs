//! A sweep and its tasks.

use std::path::PathBuf;

use leafmodel::document::source::Sources;

use super::values::{Axis, Cell, Key};

/// What is swept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// A scene file, which is rendered.
    Scene(PathBuf),
    /// A leaf as `lamina grow` takes it: a preset, `FILE.toml` or `FILE.toml#NAME`.
    Leaf(String),
}

/// A sweep: every row of each axis with every row of the others, under every seed.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What is swept.
    pub target: Target,
    /// Overrides that all tasks share.
    pub fixed: Vec<String>,
    /// Samples a pixel, instead of the scene's.
    pub spp: Option<u32>,
    /// Target noise, instead of the scene's.
    pub noise: Option<f64>,
    /// What was guessed about a table of rows, for people.
    pub notes: Vec<String>,
    /// Seeds; none stands for that of the target.
    pub(super) seeds: Vec<u64>,
    pub(super) axes: Vec<Axis>,
    pub(super) sources: Sources,
}

/// One setting of all keys.
#[derive(Clone, Debug)]
pub struct Task<'s> {
    /// Its number, from 0; the last seed and the last axis change fastest.
    pub number: usize,
    /// The keys with their values, in the sweep's order.
    pub settings: Vec<(&'s Key, &'s Cell)>,
    /// The seed, if the sweep has any.
    pub seed: Option<u64>,
}

impl Task<'_> {
    /// The settings as `key=value`.
    pub fn overrides(&self) -> impl Iterator<Item = String> {
        let settings = self.settings.iter();
        settings.map(|(key, cell)| format!("{}={}", key.path, cell.text))
    }
}

impl Sweep {
    /// The number of tasks, at least 1.
    #[expect(clippy::len_without_is_empty, reason = "a sweep has a task")]
    pub fn len(&self) -> usize {
        let rows = self.axes.iter().map(|axis| axis.rows.len());
        rows.product::<usize>() * self.seeds.len().max(1)
    }

    /// The keys that are varied.
    pub fn keys(&self) -> impl Iterator<Item = &Key> {
        self.axes.iter().flat_map(|axis| &axis.keys)
    }

    /// Whether seeds are varied.
    pub fn has_seeds(&self) -> bool {
        !self.seeds.is_empty()
    }

    /// Task number `number`, which is less than [`Sweep::len`].
    pub fn task(&self, number: usize) -> Task<'_> {
        let mut rest = number;
        let mut seed = None;
        if !self.seeds.is_empty() {
            seed = Some(self.seeds[rest % self.seeds.len()]);
            rest /= self.seeds.len();
        }
        let mut rows = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            rows.push(&axis.rows[rest % axis.rows.len()]);
            rest /= axis.rows.len();
        }
        let rows = rows.into_iter().rev();
        let settings = self.axes.iter().zip(rows);
        Task {
            number,
            settings: settings
                .flat_map(|(axis, row)| axis.keys.iter().zip(row))
                .collect(),
            seed,
        }
    }
}
