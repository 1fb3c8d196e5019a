//! The names of the blocks of a section.

use std::collections::BTreeMap;

/// The names of one section, in the file's order; a block's index is its place here.
#[derive(Debug)]
pub struct Names {
    pub(super) kind: &'static str,
    pub(super) in_order: Vec<String>,
    pub(super) index: BTreeMap<String, usize>,
    /// Whether the section may stand in the file under a misspelt name.
    pub(super) hidden: bool,
}

impl Names {
    /// Names that are no section.
    pub fn of_list<'n>(kind: &'static str, names: impl IntoIterator<Item = &'n str>) -> Self {
        let in_order: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let numbered = in_order.iter().enumerate();
        Self {
            kind,
            index: numbered
                .map(|(index, name)| (name.clone(), index))
                .collect(),
            in_order,
            hidden: false,
        }
    }

    /// The index of a name, if there is one.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
    }

    /// Whether the section has no block, and is not just misspelt.
    pub fn are_missing(&self) -> bool {
        self.in_order.is_empty() && !self.hidden
    }

    /// The name at an index.
    pub fn name(&self, index: usize) -> &str {
        self.in_order.get(index).map_or("", String::as_str)
    }
}

/// What one block of a section is called.
pub fn singular(section: &str) -> &'static str {
    match section {
        "leaves" => "leaf",
        "meshes" => "mesh",
        "materials" => "material",
        "objects" => "object",
        "lights" => "light",
        "solids" => "solid",
        "plants" => "plant",
        "media" => "medium",
        _ => "block",
    }
}
