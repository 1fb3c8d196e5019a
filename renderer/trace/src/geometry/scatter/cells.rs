//! Things by the cell of space in which they are, so that what is near a place is found fast.

use std::collections::HashMap;

use glam::DVec3;

/// Things by cells of an edge, m.
#[derive(Clone, Debug)]
pub(super) struct Cells<T> {
    edge: f64,
    cells: HashMap<[i64; 3], Vec<T>>,
}

impl<T> Cells<T> {
    /// None yet.
    pub(super) fn of_edge(edge: f64) -> Self {
        Self {
            edge,
            cells: HashMap::new(),
        }
    }

    /// The edge of a cell, m.
    pub(super) fn edge(&self) -> f64 {
        self.edge
    }

    pub(super) fn add(&mut self, place: DVec3, thing: T) {
        let cell = self.cell(place);
        self.cells.entry(cell).or_default().push(thing);
    }

    /// What is in the cell of a place and in those around it.
    pub(super) fn around(&self, place: DVec3) -> impl Iterator<Item = &T> {
        let [x, y, z] = self.cell(place);
        let near = |n: i64| n.saturating_sub(1)..=n.saturating_add(1);
        near(x)
            .flat_map(move |x| near(y).flat_map(move |y| near(z).map(move |z| [x, y, z])))
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
    }

    fn cell(&self, place: DVec3) -> [i64; 3] {
        (place / self.edge).to_array().map(|x| x.floor() as i64)
    }
}
