//! `fluorescence = { … }` of leaves, grown or of a material.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::Number;
use leafmodel::optics::fluorescence::EXCITED_NM;

use crate::scene::description::Fluorescence;

impl Fluorescence {
    /// As in daylight.
    fn usual() -> Self {
        Self {
            quantum_efficiency: 0.01,
        }
    }
}

/// The block.
pub(super) fn fluorescence(of: &mut Option<Fluorescence>, keys: &mut Keys<'_>) {
    let about = "Chlorophyll fluorescence; left out, there is none.";
    let declare = |own: &mut Fluorescence, keys: &mut Keys<'_>| {
        let limits = Number(Limits::closed(1e-6, 1.0));
        keys.key(
            "quantum_efficiency",
            &mut own.quantum_efficiency,
            limits,
            "Photons emitted for each photon that chlorophyll absorbs: 0.005 to 0.02 in daylight, \
             more where photosynthesis is blocked.",
        );
    };
    keys.optional_block("fluorescence", of, Fluorescence::usual, about, declare);
}

/// From here on spectra must cover the wavelengths that excite too, if a leaf of the scene
/// fluoresces: light of these becomes light that the film sees.
pub(super) fn tell_range(keys: &Keys<'_>) {
    let Some(root) = keys.reader() else {
        return;
    };
    let sections = ["materials", "leaves"].into_iter();
    let mut sections = sections.filter_map(|name| root.node(name));
    if sections.any(fluoresces)
        && let Some([first, last]) = root.cx.range_nm.get()
    {
        let range = [first.min(EXCITED_NM[0]), last.max(EXCITED_NM[1])];
        root.cx.range_nm.set(Some(range));
        root.cx.needed_by.set("fluorescence");
    }
}

/// Whether there is a block of fluorescence in a table of a file.
fn fluoresces(node: &Node) -> bool {
    let Value::Table(table) = &node.value else {
        return false;
    };
    let mut entries = table.0.iter();
    entries.any(|entry| entry.key == "fluorescence" || fluoresces(&entry.node))
}
