//! Adjacency in a network of directed edges.

use crate::buckets::Buckets;

/// The numbers of the edges that leave and enter each node.
pub(crate) struct Topology<'a> {
    edges: &'a [[u32; 2]],
    leaving: Buckets,
    entering: Buckets,
}

impl<'a> Topology<'a> {
    /// Sorts edges (from, to) by the nodes 0 to `count` − 1 at their ends.
    pub(crate) fn new(count: usize, edges: &'a [[u32; 2]]) -> Self {
        let by_end = |end: usize| {
            let ends = edges.iter().map(|edge| edge[end] as usize);
            Buckets::new(count, ends.zip(0..))
        };
        Self {
            edges,
            leaving: by_end(0),
            entering: by_end(1),
        }
    }

    /// The edge from, to.
    pub(crate) fn edge(&self, edge: u32) -> [u32; 2] {
        self.edges[edge as usize]
    }

    /// Edges that lead away from a node, ascending.
    pub(crate) fn leaving(&self, node: u32) -> &[u32] {
        self.leaving.list(node as usize)
    }

    /// Edges that lead to a node, ascending.
    pub(crate) fn entering(&self, node: u32) -> &[u32] {
        self.entering.list(node as usize)
    }

    /// Number of edges.
    pub(crate) fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.leaving.count()
    }

    /// All nodes, each after those that lead to it.
    ///
    /// # Errors
    ///
    /// The number of a node that cannot be placed because the edges contain a cycle.
    pub(crate) fn base_to_tip(&self) -> Result<Vec<u32>, usize> {
        let mut open: Vec<u32> = (0..self.nodes() as u32)
            .map(|node| self.entering(node).len() as u32)
            .collect();
        let mut order: Vec<u32> = (0..self.nodes() as u32)
            .filter(|&node| open[node as usize] == 0)
            .collect();
        let mut next = 0;
        while let Some(&node) = order.get(next) {
            next += 1;
            for &edge in self.leaving(node) {
                let to = self.edge(edge)[1];
                open[to as usize] -= 1;
                if open[to as usize] == 0 {
                    order.push(to);
                }
            }
        }
        match open.iter().position(|&open| open > 0) {
            Some(node) => Err(node),
            None => Ok(order),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_come_after_those_that_lead_to_them_and_circles_are_found() {
        let diamond = [[2, 1], [2, 3], [1, 0], [3, 0]];
        let topology = Topology::new(4, &diamond);
        assert_eq!(topology.base_to_tip(), Ok(vec![2, 1, 3, 0]));
        assert_eq!(topology.entering(0), [2, 3]);
        assert_eq!(topology.leaving(2), [0, 1]);
        let circle = [[0, 1], [1, 2], [2, 1]];
        assert_eq!(Topology::new(3, &circle).base_to_tip(), Err(1));
    }
}
