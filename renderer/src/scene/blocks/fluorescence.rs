//! Wavelengths that excite fluorescence, which spectra must cover where a leaf fluoresces.

use leafmodel::document::keys::Keys;
use leafmodel::document::tree::{Node, Value};
use leafmodel::optics::fluorescence::EXCITED_NM;

/// From here on spectra must cover the wavelengths that excite too, if a leaf of the scene
/// fluoresces: light of these becomes light that the film sees.
pub(super) fn report_range(keys: &Keys<'_>) {
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
