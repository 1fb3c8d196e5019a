//! Areoles: the regions that veins enclose.
//!
//! Areoles are the bounded faces of the plane graph of veins ([`PlaneGraph`]). The margin is not a
//! vein, so regions open towards it are not areoles. Faces are found by following veins from
//! junction to junction and turning to the next vein clockwise at each, which leads once around the
//! face on the left. The time is proportional to the size of the network.
//!
//! - **In**: a [`VenationNetwork`].
//! - **Out**: [`Areoles`], with corners, area, perimeter and shape of each, and the free veinlet
//!   endings.
//! - **Always true**: areas are above 0; the number of areoles is edges − nodes + components (of
//!   the graph after cutting), less those whose area is 0 up to rounding.
//! - **Left out**: the width of veins. Corners lie on their midlines.

pub(crate) mod chains;
mod faces;
mod islands;
#[cfg(test)]
mod tests;
mod veinlets;

use glam::DVec2;

pub(crate) use self::chains::Chains;
use super::network::VenationNetwork;
use super::planar::PlaneGraph;

/// Marks "in no areole" in lists of areole numbers.
pub(crate) const OUTSIDE: u32 = u32::MAX;

/// One region enclosed by veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Areole {
    /// Area, mm², > 0. Areas that other veins enclose inside it (a ring on a stalk, a separate
    /// network) are areoles of their own and not included.
    pub area_mm2: f64,
    /// Area inside the enclosing cycle of veins, mm², at least `area_mm2`.
    pub outline_area_mm2: f64,
    /// Length of the enclosing cycle of veins, mm. Veins that end inside do not count.
    pub perimeter_mm: f64,
    /// Longer over shorter axis of the ellipse that has the second moments of the enclosing
    /// polygon, 1 to 10⁶.
    pub elongation: f64,
    /// Centre of mass of the enclosing polygon, mm.
    pub centroid: DVec2,
}

impl Areole {
    /// How round the enclosing cycle is: `4π A/P²`, 1 for a circle, in (0, 1].
    pub fn circularity(&self) -> f64 {
        let disc = self.perimeter_mm * self.perimeter_mm / (4.0 * std::f64::consts::PI);
        self.outline_area_mm2 / disc
    }
}

/// A free ending: a vein from its free tip back to the first junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeEnding {
    /// Where it ends, mm.
    pub tip: DVec2,
    /// Length, mm, > 0.
    pub length_mm: f64,
    /// Number of the areole in which it lies, if any.
    pub areole: Option<usize>,
}

/// The areoles of a network.
#[derive(Clone, Debug)]
pub struct Areoles {
    graph: PlaneGraph,
    chains: Chains,
    list: Vec<Areole>,
    /// The directed halves of veins around areole `i`, counter-clockwise:
    /// `halves[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    halves: Vec<u32>,
    /// Areole on the left of each half, or [`OUTSIDE`].
    on_left: Vec<u32>,
}

/// Finds the areoles of a network.
pub fn areoles(network: &VenationNetwork) -> Areoles {
    let graph = PlaneGraph::new(network);
    let chains = Chains::new(&graph);
    let walks = faces::walks(&chains);
    let mut found = Areoles {
        list: Vec::new(),
        starts: vec![0],
        halves: Vec::new(),
        on_left: vec![OUTSIDE; 2 * chains.len()],
        graph,
        chains,
    };
    let mut cycles = faces::Cycles::new(&found.chains);
    for walk in walks.bounded() {
        let halves = walks.halves(walk);
        let Some(areole) = cycles.enclosing(&found.chains, halves, walks.areas[walk]) else {
            continue;
        };
        for &half in halves {
            found.on_left[half as usize] = found.list.len() as u32;
        }
        found.list.push(areole);
        found.halves.extend_from_slice(cycles.best());
        found.starts.push(found.halves.len() as u32);
    }
    islands::take_out(&mut found, &walks);
    found
}

impl Areoles {
    /// Number of areoles.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// All areoles, by number.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Areole> {
        self.list.iter()
    }

    /// Corners of areole `number`, counter-clockwise, the first not repeated, mm.
    ///
    /// # Panics
    ///
    /// If there is no such areole.
    pub fn polygon(&self, number: usize) -> impl Iterator<Item = DVec2> + '_ {
        let (start, end) = (self.starts[number], self.starts[number + 1]);
        self.halves[start as usize..end as usize]
            .iter()
            .flat_map(|&half| self.chains.corners(half))
    }

    /// All veins that end freely: from a node with one edge that is not an origin back to the first
    /// node with three or more edges.
    pub fn free_endings(&self) -> impl Iterator<Item = FreeEnding> + '_ {
        (0..self.chains.len() as u32).filter_map(|chain| {
            let at_end = |end: usize| self.chains.ends[chain as usize][end];
            let degree = |joint: u32| self.chains.leaving(joint).len();
            let end =
                (0..2).find(|&end| degree(at_end(end)) == 1 && degree(at_end(1 - end)) > 2)?;
            let (edges, points) = (self.chains.edges(chain), self.chains.points(chain));
            let (edge, tip) = if end == 0 {
                (edges[0], points[0])
            } else {
                (edges[edges.len() - 1], points[points.len() - 1])
            };
            let node = self.chains.joints[at_end(end) as usize];
            if self.graph.edges()[edge as usize].to != node {
                return None; // An origin: no vein leads to it.
            }
            let areole = self.on_left[2 * chain as usize];
            Some(FreeEnding {
                tip,
                length_mm: self.chains.lengths[chain as usize],
                areole: (areole != OUTSIDE).then_some(areole as usize),
            })
        })
    }

    /// The plane graph whose faces are the areoles.
    pub fn graph(&self) -> &PlaneGraph {
        &self.graph
    }

    pub(crate) fn chains(&self) -> &Chains {
        &self.chains
    }

    /// Numbers of the areoles on the left and on the right of a chain, or [`OUTSIDE`].
    pub(crate) fn beside(&self, chain: u32) -> [u32; 2] {
        let half = 2 * chain as usize;
        [self.on_left[half], self.on_left[half + 1]]
    }
}
