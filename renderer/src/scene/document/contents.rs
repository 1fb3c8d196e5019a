//! `contents`: what a leaf holds per leaf area, PROSPECT-D's inputs and betalains.

use leafmodel::optics::{Constituent, Contents, PerConstituent};

use super::limits::Limits;
use super::reader::Block;

/// What a file may say of a constituent.
pub(crate) fn limits(constituent: Constituent) -> Limits {
    let [least, most] = constituent.range();
    Limits::closed(least, most)
}

/// Reads a block of contents.
pub(crate) fn read_contents(block: &Block<'_>) -> Option<Contents> {
    let read = PerConstituent::from_fn(|constituent| {
        let (key, limits) = (constituent.key(), limits(constituent));
        match constituent.if_left_out() {
            None => block.number(key, limits),
            Some(default) => Some(block.number_or(key, limits, default)),
        }
    });
    block.finish();
    let mut contents = Contents::NOTHING;
    for (constituent, value) in read {
        contents[constituent] = value?;
    }
    if contents.mixes_betalains_and_anthocyanins() {
        block.cx.warn(
            &block.at,
            "scene::betalains_and_anthocyanins",
            "this leaf holds betalains and anthocyanins, which never occur in the same plant"
                .to_owned(),
            Contents::NEVER_TOGETHER,
        );
    }
    Some(contents)
}

/// Reads a block of contents of which all may be left out, and are then those of `base`.
pub(crate) fn read_changed(block: &Block<'_>, base: Contents) -> Contents {
    let mut contents = base;
    for (constituent, value) in contents.iter_mut() {
        *value = block.number_or(constituent.key(), limits(constituent), *value);
    }
    block.finish();
    contents
}
