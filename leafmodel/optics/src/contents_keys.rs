//! The keys of `contents`: what tissue holds per area.

use crate::{Constituent, Contents, Pigments};
use document::keys::Keys;
use document::limits::Limits;
use document::value_kind::Number;

/// Code of the warning of pigments that never occur together.
pub const NEVER_TOGETHER: &str = "scene::betalains_and_anthocyanins";

/// The range of a content.
pub fn limits(constituent: Constituent) -> Limits {
    let [least, most] = constituent.range();
    Limits::closed(least, most)
}

/// The keys of contents. Those that every leaf has must be said; dry matter, or its parts.
pub fn contents(value: &mut Contents, keys: &mut Keys<'_>) {
    let has_parts = parts(value, keys) || keys.is_description();
    for (constituent, value) in value.iter_mut() {
        let (key, number) = (constituent.key(), Number(limits(constituent)));
        match constituent.if_left_out() {
            None if !(has_parts && constituent == Constituent::DryMatter) => {
                keys.required(key, value, number, constituent.meaning());
            }
            None | Some(_) => keys.key(key, value, number, constituent.meaning()),
        }
    }
    warn_of_mixture(value, keys, "this leaf holds");
}

/// The keys of contents, all optional: a missing one stays as it is.
pub fn changed_contents(value: &mut Contents, keys: &mut Keys<'_>) {
    parts(value, keys);
    for (constituent, value) in value.iter_mut() {
        let number = Number(limits(constituent));
        keys.key(constituent.key(), value, number, constituent.meaning());
    }
}

/// Whether a file gives parts of dry matter. Then they take the place of the whole.
fn parts(value: &mut Contents, keys: &Keys<'_>) -> bool {
    let parts = Constituent::DRY_MATTER_PARTS.map(|part| keys.has(part.key()));
    let has_parts = !keys.is_description() && parts.contains(&true);
    if has_parts {
        value[Constituent::DryMatter] = 0.0;
    } else if !keys.is_description() && keys.has(Constituent::DryMatter.key()) {
        for part in Constituent::DRY_MATTER_PARTS {
            value[part] = 0.0;
        }
    }
    has_parts
}

/// Reports contents of the block `contents` of which the block `pigments` does not say what they
/// absorb.
pub fn refuse_unknown_absorption(pigments: &Pigments, value: &Contents, keys: &Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    if let Some((of, problem, help)) = pigments.model.refusal(value) {
        keys.refuse(
            &["contents", of.key()],
            problem,
            &format!("{help} (`pigments.model`)"),
        );
    } else if let Some(problem) = pigments.lacks_extra(value) {
        let help = "write `pigments.extra.file`, the path of the table";
        keys.refuse(
            &["contents", Constituent::Extra.key()],
            problem.to_owned(),
            help,
        );
    }
}

/// Warns of betalains beside anthocyanins; `what` begins the sentence.
pub fn warn_of_mixture(contents: &Contents, keys: &Keys<'_>, what: &str) {
    if contents.mixes_betalains_and_anthocyanins() {
        let message =
            format!("{what} betalains and anthocyanins, which never occur in the same plant");
        keys.warn(NEVER_TOGETHER, message, Contents::NEVER_TOGETHER);
    }
}
