//! The plants of a scene, and why they do not grow.

use leafmodel::document::names::Named;

use crate::scene::authored::Plant;

/// Why a scene cannot be expanded.
#[derive(Debug)]
pub(in crate::scene) struct Fault {
    /// Where the file says what is wrong.
    pub(in crate::scene) path: Vec<String>,
    /// What is wrong.
    pub(in crate::scene) problem: String,
    /// What to do.
    pub(in crate::scene) help: &'static str,
}

impl Fault {
    pub(super) fn new(path: &[&str], problem: String, help: &'static str) -> Self {
        Self {
            path: path.iter().map(|&key| key.to_owned()).collect(),
            problem,
            help,
        }
    }
}

/// The plants of a scene, and which object is which.
pub(super) struct Planted {
    pub(super) plants: Vec<Named<Plant>>,
    /// Of each object of the file the plant that it is.
    pub(super) of_object: Vec<Option<usize>>,
}

/// Adds a block to a section; its number.
pub(super) fn add<T>(blocks: &mut Vec<Named<T>>, name: String, value: T) -> usize {
    blocks.push(Named { name, value });
    blocks.len() - 1
}
