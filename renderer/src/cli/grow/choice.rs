//! Which leaf is to be grown: a preset or one of a file.

use leafmodel::species;

use crate::cli::Failure;
use crate::cli::arguments::{GrowArguments, file_and_leaf};
use crate::scene::description::{Leaf, Named};
use crate::scene::load::{LeafFile, LeafNotChosen, load_one_leaf};
use crate::scene::nearest::nearest;

/// The leaf with all its settings.
pub(super) fn choose(arguments: &GrowArguments) -> Result<Named<Leaf>, Failure> {
    let wanted = arguments.leaf.as_deref().unwrap_or_default();
    let read = |file| load_one_leaf(file, &arguments.overrides, &arguments.set);
    let mut chosen = if let Some(preset) = species::find(wanted) {
        let plan = preset.plan();
        read(LeafFile::Plan {
            name: preset.name,
            plan: &plan,
        })
    } else {
        let (path, leaf) = file_and_leaf(wanted);
        // What looks like a name and is no file was meant for a preset.
        if is_word(wanted) && !path.exists() {
            return Err(unknown_preset(wanted));
        }
        read(LeafFile::File { path: &path, leaf })
    }?;
    let plan = &mut chosen.value.plan;
    plan.seed = arguments.seed.unwrap_or(plan.seed);
    Ok(chosen)
}

/// Whether it looks like the name of a preset rather than a file's.
pub(super) fn is_word(wanted: &str) -> bool {
    !wanted.contains(['/', '\\', '.', '#'])
}

pub(super) fn unknown_preset(wanted: &str) -> Failure {
    let names = species::PRESETS.iter().map(|preset| preset.name);
    let meant =
        nearest(wanted, names).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    Failure::bad(format!(
        "there is neither a preset nor a file `{}`{meant} (`lamina grow --list` names the presets)",
        wanted.escape_debug()
    ))
}

impl From<LeafNotChosen> for Failure {
    fn from(error: LeafNotChosen) -> Self {
        match error {
            LeafNotChosen::Scene(errors) => errors.into(),
            LeafNotChosen::WhichLeaf { .. }
            | LeafNotChosen::NoValue { .. }
            | LeafNotChosen::UnknownKey { .. }
            | LeafNotChosen::Ambiguous { .. } => Self::bad(error),
        }
    }
}
