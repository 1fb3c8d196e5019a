//! The main veins while the leaf develops: a tree of nodes that elongates and turns.

use glam::DVec2;

/// Stands for "no node".
pub(super) const NO_NODE: u32 = u32::MAX;

/// Pieces of the midrib.
const MIDRIB_PIECES: usize = 72;

/// Fewest pieces of any other vein.
const FEWEST_PIECES: usize = 6;

/// Most pieces of it.
const MOST_PIECES: usize = 24;

/// How fast parts of the midrib elongate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rates {
    pub(super) basal_growth: f64,
}

impl Rates {
    /// Elongation at a share of the midrib's length, but for a factor.
    fn along_midrib(self, share: f64) -> f64 {
        1.0 + self.basal_growth * (1.0 - 2.0 * share)
    }
}

/// A vein from its origin on another to its tip at the margin.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Vein {
    /// 1 for the midrib, else one more than that of the vein it springs from.
    pub(super) order: u8,
    /// The wave of initiation that brought it; nothing for the midrib.
    pub(super) wave: Option<usize>,
    /// The node of another vein that it springs from.
    pub(super) origin: u32,
    /// Its last node, at the margin.
    pub(super) tip: u32,
    /// How fast it elongates, over the rate at which the whole leaf does.
    pub(super) rate: f64,
    /// By how many radians per unit of the logarithm of the leaf's length it turns, anticlockwise.
    pub(super) turn: f64,
    /// The step in which it came.
    pub(super) born: u32,
}

/// A point of a vein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    /// Where it is; the base is the origin.
    pub(super) place: DVec2,
    /// The node before it on the way to the base.
    pub(super) before: u32,
    /// The vein of which it is a piece's end.
    pub(super) vein: u32,
}

/// What a step does to the tissue about a node: it moves there, is turned, and is enlarged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deformation {
    /// The node at the step's beginning.
    pub(super) from: DVec2,
    /// The node at its end.
    pub(super) to: DVec2,
    /// Length of the vein that this node stands for.
    pub(super) weight: f64,
    /// Cosine and sine of the turn.
    pub(super) turn: DVec2,
    /// By how much tissue is enlarged, as a logarithm.
    pub(super) growth: f64,
}

/// What lies between two places of the margin that veins lead to.
pub(super) struct Between {
    /// The nodes of the vein from which both ways part, from where the first leaves it to where the
    /// other does.
    pub(super) nodes: Vec<u32>,
    /// The ways from where they part.
    pub(super) ways: [Vec<u32>; 2],
}

/// All veins.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Skeleton {
    /// Base to tip: a node comes after the one before it.
    pub(super) nodes: Vec<Node>,
    /// In the order in which they came; the first is the midrib.
    pub(super) veins: Vec<Vein>,
}

impl Skeleton {
    /// The midrib of a primordium whose length is 1.
    pub(super) fn new() -> Self {
        let node = |i: usize| Node {
            place: DVec2::new(0.0, i as f64 / MIDRIB_PIECES as f64),
            before: if i == 0 { NO_NODE } else { i as u32 - 1 },
            vein: 0,
        };
        Self {
            nodes: (0..=MIDRIB_PIECES).map(node).collect(),
            veins: vec![Vein {
                order: 1,
                wave: None,
                origin: NO_NODE,
                tip: MIDRIB_PIECES as u32,
                rate: 1.0,
                turn: 0.0,
                born: 0,
            }],
        }
    }

    /// Length of the midrib.
    pub(super) fn length(&self) -> f64 {
        self.nodes[self.veins[0].tip as usize].place.y
    }

    /// Length of the way from the base to each node.
    pub(super) fn distances(&self) -> Vec<f64> {
        let mut distances = vec![0.0; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            if node.before != NO_NODE {
                let before = node.before as usize;
                let piece = (node.place - self.nodes[before].place).length();
                distances[i] = distances[before] + piece;
            }
        }
        distances
    }

    /// What lies between two veins, or one and the base ([`NO_NODE`]); `tips` are their last nodes.
    pub(super) fn between(&self, tips: [u32; 2]) -> Between {
        let [one, other] = tips.map(|tip| {
            let mut way = self.way_to_base(tip);
            way.reverse();
            way
        });
        let shared = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
        let parting = one[shared - 1];
        let vein = self.nodes[parting as usize].vein;
        let beyond = |way: &[u32]| -> Vec<u32> {
            let way = way[shared..].iter().copied();
            way.take_while(|&node| self.nodes[node as usize].vein == vein)
                .collect()
        };
        let mut nodes = vec![parting];
        // Veins from the base are the midrib's equals: none is the others' parent.
        if parting != 0 || tips.contains(&NO_NODE) {
            nodes = beyond(&one);
            nodes.reverse();
            nodes.push(parting);
            nodes.extend(beyond(&other));
        }
        let ways = [one, other].map(|way| way[shared - 1..].to_vec());
        Between { nodes, ways }
    }

    /// The nodes from one to the base.
    fn way_to_base(&self, node: u32) -> Vec<u32> {
        let mut way = Vec::new();
        let mut next = if node == NO_NODE { 0 } else { node };
        while next != NO_NODE {
            way.push(next);
            next = self.nodes[next as usize].before;
        }
        way
    }

    /// Adds a vein from the node `origin` through `way`, of which the last point is its tip.
    pub(super) fn add(&mut self, mut vein: Vein, way: &[DVec2]) -> u32 {
        let number = self.veins.len() as u32;
        let mut before = vein.origin;
        for &place in way {
            self.nodes.push(Node {
                place,
                before,
                vein: number,
            });
            before = self.nodes.len() as u32 - 1;
        }
        vein.tip = before;
        self.veins.push(vein);
        before
    }

    /// Grows by a step of the logarithm of the leaf's length, and tells what happens to the tissue
    /// about each node.
    pub(super) fn grow(&mut self, rates: Rates, step: f64) -> Vec<Deformation> {
        let elongation = self.midrib_elongation(rates);
        // What the tissue grows by where each vein springs from the midrib, itself or by others.
        let mut local: Vec<f64> = vec![1.0];
        for vein in &self.veins[1..] {
            let origin = vein.origin as usize;
            local.push(match self.nodes[origin].vein {
                0 => elongation[origin],
                other => local[other as usize],
            });
        }
        let mut deformations: Vec<Deformation> = Vec::with_capacity(self.nodes.len());
        // How far each node's piece is turned in all.
        let mut turns: Vec<f64> = vec![0.0; self.nodes.len()];
        let mut places: Vec<DVec2> = Vec::with_capacity(self.nodes.len());
        for (i, node) in self.nodes.iter().enumerate() {
            let vein = &self.veins[node.vein as usize];
            if node.before == NO_NODE {
                places.push(node.place);
                deformations.push(Deformation {
                    from: node.place,
                    to: node.place,
                    weight: self.nodes[1].place.y,
                    turn: DVec2::X,
                    growth: elongation[i] * step,
                });
                continue;
            }
            let before = node.before as usize;
            let piece = node.place - self.nodes[before].place;
            let starts = self.nodes[before].vein != node.vein;
            turns[i] = turns[before] + if starts { vein.turn * step } else { 0.0 };
            let (sin, cos) = libm::sincos(turns[i]);
            let turn = DVec2::new(cos, sin);
            let rate = local[node.vein as usize]
                * if node.vein == 0 {
                    elongation[i]
                } else {
                    vein.rate
                };
            let to = places[before] + turn.rotate(piece) * libm::exp(rate * step);
            places.push(to);
            deformations.push(Deformation {
                from: node.place,
                to,
                weight: piece.length(),
                turn,
                growth: rate * step,
            });
        }
        for (node, place) in self.nodes.iter_mut().zip(places) {
            node.place = place;
        }
        deformations
    }

    /// Elongation of each piece of the midrib, so that the whole elongates at the rate 1.
    fn midrib_elongation(&self, rates: Rates) -> Vec<f64> {
        let length = self.length();
        let raw = |place: DVec2| rates.along_midrib(place.y / length);
        let midrib = &self.nodes[..=self.veins[0].tip as usize];
        let total: f64 = midrib
            .windows(2)
            .map(|piece| raw(piece[1].place) * (piece[1].place.y - piece[0].place.y))
            .sum();
        midrib
            .iter()
            .map(|node| raw(node.place) * length / total)
            .collect()
    }
}

/// Points of a vein of so many pieces from `from`, exclusive, to `to`, that bows by `bow` of its length
/// to the right of its way.
pub(super) fn bowed(from: DVec2, to: DVec2, bow: f64, pieces: usize) -> Vec<DVec2> {
    let chord = to - from;
    let middle = from + chord * 0.5 - chord.perp() * (2.0 * bow);
    let point = |i: usize| {
        let t = i as f64 / pieces as f64;
        let u = 1.0 - t;
        from * (u * u) + middle * (2.0 * u * t) + to * (t * t)
    };
    let mut points: Vec<DVec2> = (1..pieces).map(point).collect();
    points.push(to);
    points
}

/// Pieces of a vein whose length is this share of the leaf's when it comes.
pub(super) fn pieces(share: f64) -> usize {
    ((share * 40.0) as usize).clamp(FEWEST_PIECES, MOST_PIECES)
}
