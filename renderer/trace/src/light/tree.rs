//! A light tree: chooses one light by the light that it may send to a point.
//!
//! - **In**: [`Emitter`]s, which bound the place, directions and intensity of each light; a
//!   [`Receiver`]; a random number.
//! - **Out**: the number of one light, and the probability of any light from any receiver.
//! - **Always true**: a light that can send light to the receiver, from either side, has a
//!   probability above zero; [`LightTree::probability`] is the probability with which
//!   [`LightTree::choose`] chooses. The probabilities from one receiver sum to 1 or less: the
//!   bounds of a node may suggest light where none of its lights shines, and then nothing is
//!   chosen.
//! - **Left out**: shadows, and the receiving surface's BSDF apart from the cosine.
//!
//! # Source
//!
//! \[conty2018\], with eight children per node, whose importances are computed together, and
//! without splitting: one light per choice.

mod build;
mod node;

pub use self::node::Emitter;
use self::node::{CHILD_BITS, IS_LIGHT, Node, WIDTH};
use crate::light::sample::Receiver;

/// A tree over lights that are numbered from 0.
#[derive(Clone, Debug)]
pub struct LightTree {
    /// The nodes; the root is the first.
    nodes: Box<[Node]>,
    /// For each light the path from the root to it: the index of a child per level, three bits
    /// each, from the lowest bits on.
    trails: Box<[u64]>,
}

impl LightTree {
    /// The tree of at least one light and fewer than 2³¹.
    pub fn new(lights: &[Emitter]) -> Self {
        let (nodes, trails) = build::build(lights);
        Self {
            nodes: nodes.into(),
            trails: trails.into(),
        }
    }

    /// Number of lights.
    pub fn len(&self) -> usize {
        self.trails.len()
    }

    /// Whether there are no lights, which is never the case.
    pub fn is_empty(&self) -> bool {
        self.trails.is_empty()
    }

    /// Rough irradiance that all lights together may cause at a receiver, W m⁻² nm⁻¹; zero only if
    /// it is dark there.
    pub fn importance(&self, receiver: &Receiver) -> f32 {
        self.nodes[0].importances(receiver).iter().sum()
    }

    /// Chooses a light by `u` in [0, 1), and returns its number and probability; `None` if no light
    /// shines there.
    pub fn choose(&self, receiver: &Receiver, u: f32) -> Option<(usize, f32)> {
        // Each level uses up some of the digits of `u`.
        let mut u = f64::from(u);
        let mut probability = 1.0;
        let mut node = &self.nodes[0];
        loop {
            let importances = node.importances(receiver);
            let sum: f32 = importances.iter().sum();
            if sum <= 0.0 {
                return None;
            }
            let target = u * f64::from(sum);
            let (mut chosen, mut below) = (0, 0.0);
            let mut up_to = 0.0;
            for (child, &importance) in importances.iter().enumerate() {
                // The last child with any importance takes what rounding leaves over.
                if importance > 0.0 && up_to <= target {
                    (chosen, below) = (child, up_to);
                }
                up_to += f64::from(importance);
            }
            probability *= importances[chosen] / sum;
            u = ((target - below) / f64::from(importances[chosen])).min(1.0 - f64::EPSILON);
            let child = node.child[chosen];
            if child & IS_LIGHT != 0 {
                return Some(((child & !IS_LIGHT) as usize, probability));
            }
            node = &self.nodes[child as usize];
        }
    }

    /// Probability with which a light is chosen.
    pub fn probability(&self, light: usize, receiver: &Receiver) -> f32 {
        let mut trail = self.trails[light];
        let mut probability = 1.0;
        let mut node = &self.nodes[0];
        loop {
            let importances = node.importances(receiver);
            let chosen = trail as usize % WIDTH;
            if importances[chosen] <= 0.0 {
                return 0.0;
            }
            probability *= importances[chosen] / importances.iter().sum::<f32>();
            trail >>= CHILD_BITS;
            let child = node.child[chosen];
            if child & IS_LIGHT != 0 {
                return probability;
            }
            node = &self.nodes[child as usize];
        }
    }
}

#[cfg(test)]
mod tests;
