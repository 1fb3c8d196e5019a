//! The keys of `contents`: what tissue holds per area.

use crate::{Constituent, Contents};
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

/// The keys of contents. Those that every leaf has must be said.
pub fn contents(value: &mut Contents, keys: &mut Keys<'_>) {
    for (constituent, value) in value.iter_mut() {
        let (key, number) = (constituent.key(), Number(limits(constituent)));
        match constituent.if_left_out() {
            None => keys.required(key, value, number, constituent.meaning()),
            Some(_) => keys.key(key, value, number, constituent.meaning()),
        }
    }
    warn_of_mixture(value, keys, "this leaf holds");
}

/// The keys of contents of which none must be said: what is not there stays as it is.
pub fn changed_contents(value: &mut Contents, keys: &mut Keys<'_>) {
    for (constituent, value) in value.iter_mut() {
        let number = Number(limits(constituent));
        keys.key(constituent.key(), value, number, constituent.meaning());
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
