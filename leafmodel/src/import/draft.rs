//! A network as a file tells it, before anything is checked.

use std::collections::BTreeMap;

use glam::DVec2;

use super::faults::Fault;
use super::fields::Unit;
use crate::document::source::quoted;
use crate::shape::outline::Outline;

/// Stands for a node that the file does not hold.
pub(super) const ABSENT: u32 = u32::MAX;

/// Nodes, edges and margins in the numbers of a file.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    /// Places of the nodes.
    pub(super) places: Vec<DVec2>,
    /// Names of the nodes in the file; empty if they are numbered from 0.
    pub(super) names: Vec<String>,
    /// Steps in which the nodes were born; empty if the file does not say.
    pub(super) born: Vec<u32>,
    /// The edges.
    pub(super) edges: Vec<DraftEdge>,
    /// Edges to nodes that the file does not hold: the edge's own place in the file, and the name
    /// of the node.
    pub(super) loose: Vec<(String, String)>,
    /// Places in the file of edges with radii that are no lengths, by the number of the edge.
    pub(super) bad_radii: BTreeMap<usize, String>,
    /// Corners of each margin, with base and apex where they are given.
    pub(super) margins: Vec<DraftMargin>,
    /// Whether edges have a direction.
    pub(super) is_directed: bool,
    /// Length of a vein segment, mm, if the file says so.
    pub(super) segment_mm: Option<f64>,
    /// Whether places have units.
    pub(super) place_units: Units,
    /// Whether radii have units.
    pub(super) radius_units: Units,
    /// Whether lengths have units; those without one are in that of the places.
    pub(super) length_units: Units,
    /// The margin that is taken instead of the file's.
    pub(super) given: Option<Outline>,
    /// Whether y points down.
    pub(super) is_y_down: bool,
    /// Points between the ends of edges, by the number of the edge, in the frame of the places.
    pub(super) courses: BTreeMap<u32, Vec<DVec2>>,
    /// Lengths of edges along their courses, by the number of the edge.
    pub(super) lengths: BTreeMap<u32, f64>,
    /// Millimetres of the last unit of a place.
    pub(super) place_mm: Option<f64>,
    /// What reading left out or changed.
    pub(super) remarks: Vec<Fault>,
}

/// Which lengths of one kind have units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Units {
    /// Whether some are in the file's own units.
    pub(super) some_lack: bool,
    /// Whether some have a unit.
    pub(super) some_have: bool,
}

impl Units {
    /// A length, millimetres where it has a unit.
    pub(super) fn millimetres(&mut self, value: f64, unit: Unit) -> f64 {
        match unit {
            Unit::Millimetres(factor) => {
                self.some_have = true;
                value * factor
            }
            Unit::OfTheFile => {
                self.some_lack = true;
                value
            }
        }
    }
}

/// An edge as a file tells it.
#[derive(Clone, Copy, Debug)]
pub(super) struct DraftEdge {
    /// Numbers of its nodes, or [`ABSENT`].
    pub(super) ends: [u32; 2],
    /// Radii at both ends, if the file says so.
    pub(super) radii: [Option<f64>; 2],
    /// Its order, if the file says so.
    pub(super) order: Option<u8>,
}

/// A margin as a file tells it.
#[derive(Clone, Debug, Default)]
pub(super) struct DraftMargin {
    pub(super) points: Vec<DVec2>,
    pub(super) base: Option<DVec2>,
    pub(super) apex: Option<DVec2>,
}

impl DraftEdge {
    /// A radius that is no length, if it has one.
    pub(super) fn bad_radius(&self) -> Option<f64> {
        let mut radii = self.radii.iter().flatten();
        radii.find(|r| !(r.is_finite() && **r > 0.0)).copied()
    }

    pub(super) fn between(from: u32, to: u32) -> Self {
        Self {
            ends: [from, to],
            radii: [None; 2],
            order: None,
        }
    }
}

impl Draft {
    /// How a node is called in the file.
    pub(super) fn name(&self, node: u32) -> String {
        let name = self.names.get(node as usize);
        name.map_or_else(|| node.to_string(), |name| quoted(name))
    }

    /// A length of a place, millimetres where it has a unit.
    pub(super) fn place_in(&mut self, value: f64, unit: Unit) -> f64 {
        if let Unit::Millimetres(factor) = unit {
            self.place_mm = Some(factor);
        }
        self.place_units.millimetres(value, unit)
    }
}
