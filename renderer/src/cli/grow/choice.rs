//! The leaf to be grown: a preset or a leaf of a file.

use leafmodel::document::report::DocumentErrors;
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file::one_leaf::{LeafFile, LeafNotChosen, load_one_leaf};
use leafmodel::species;

use crate::cli::arguments::{GrowArguments, file_and_leaf};
use crate::cli::terminal::{Failure, colour};
use crate::scene::assets::DECODER;
use leafmodel::document::nearest::meant;

/// A leaf that is to be grown.
pub(super) struct Chosen {
    pub(super) name: String,
    pub(super) plan: LeafPlan,
    /// The preset from which it was made, if any.
    pub(super) preset: Option<&'static str>,
}

/// A leaf as a command line names it.
#[derive(Clone, Copy, Debug)]
pub(in crate::cli) struct Wish<'a> {
    /// A preset, or a file and the leaf in it.
    pub(in crate::cli) leaf: &'a str,
    /// Values of the file.
    pub(in crate::cli) overrides: &'a [String],
    /// Values of the leaf.
    pub(in crate::cli) settings: &'a [String],
    /// The seed, if it is not the leaf's own.
    pub(in crate::cli) seed: Option<u64>,
}

impl<'a> From<&'a GrowArguments> for Wish<'a> {
    fn from(arguments: &'a GrowArguments) -> Self {
        Self {
            leaf: arguments.leaf.as_deref().unwrap_or_default(),
            overrides: &arguments.overrides,
            settings: &arguments.set,
            seed: arguments.seed,
        }
    }
}

/// Why there is no leaf to grow.
pub(in crate::cli) enum NotChosen {
    /// Errors of the file or the settings, with their places.
    Document(DocumentErrors),
    /// Anything else.
    Failure(Failure),
}

/// The leaf with all its settings.
pub(super) fn choose(wish: Wish<'_>, veins_alone: bool) -> Result<Chosen, NotChosen> {
    let wanted = wish.leaf;
    let read = |file| {
        load_one_leaf(
            file,
            Some(&DECODER),
            veins_alone,
            wish.overrides,
            wish.settings,
        )
    };
    let preset = species::find(wanted);
    let chosen = if let Some(preset) = preset {
        let plan = preset.plan();
        read(LeafFile::Plan {
            name: preset.name,
            plan: &plan,
        })
    } else {
        let (path, leaf) = file_and_leaf(wanted);
        // A word that is not the name of a file is taken for a preset.
        if is_word(wanted) && !path.exists() {
            return Err(NotChosen::Failure(unknown_preset(wanted)));
        }
        read(LeafFile::File { path: &path, leaf })
    }?;
    let (chosen, warnings) = chosen;
    for warning in warnings {
        eprintln!("{}", warning.render(colour()));
    }
    let mut plan = chosen.value;
    plan.seed = wish.seed.unwrap_or(plan.seed);
    Ok(Chosen {
        name: chosen.name,
        plan,
        preset: preset.map(|preset| preset.name),
    })
}

/// Whether it looks like the name of a preset, not of a file.
pub(in crate::cli) fn is_word(wanted: &str) -> bool {
    !wanted.contains(['/', '\\', '.', '#'])
}

pub(in crate::cli) fn unknown_preset(wanted: &str) -> Failure {
    let presets = species::PRESETS.iter();
    let meant = meant(wanted, presets.map(|preset| (preset.name, preset.about())));
    let meant = meant.map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    bad!(
        "there is neither a preset nor a file `{}`{meant} (`lamina grow --list` names the presets)",
        wanted.escape_debug()
    )
}

impl From<LeafNotChosen> for NotChosen {
    fn from(error: LeafNotChosen) -> Self {
        match error {
            LeafNotChosen::Scene(errors) => Self::Document(errors),
            LeafNotChosen::WhichLeaf { .. }
            | LeafNotChosen::NoValue { .. }
            | LeafNotChosen::UnknownKey { .. }
            | LeafNotChosen::Ambiguous { .. } => Self::Failure(Failure::bad(error)),
        }
    }
}

impl From<NotChosen> for Failure {
    fn from(error: NotChosen) -> Self {
        match error {
            NotChosen::Document(errors) => errors.into(),
            NotChosen::Failure(failure) => failure,
        }
    }
}
