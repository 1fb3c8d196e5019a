//! Adjacency in a network of directed edges.

/// The numbers of the edges that leave and enter each node.
pub(crate) struct Topology<'a> {
    edges: &'a [[u32; 2]],
    out_starts: Vec<u32>,
    out_edges: Vec<u32>,
    in_starts: Vec<u32>,
    in_edges: Vec<u32>,
}

impl<'a> Topology<'a> {
    /// Sorts edges (from, to) by the nodes 0 to `count` − 1 at their ends.
    pub(crate) fn new(count: usize, edges: &'a [[u32; 2]]) -> Self {
        let (out_starts, out_edges) = by_end(count, edges, 0);
        let (in_starts, in_edges) = by_end(count, edges, 1);
        Self {
            edges,
            out_starts,
            out_edges,
            in_starts,
            in_edges,
        }
    }

    /// The edge from, to.
    pub(crate) fn edge(&self, edge: u32) -> [u32; 2] {
        self.edges[edge as usize]
    }

    /// Edges that lead away from a node, ascending.
    pub(crate) fn leaving(&self, node: u32) -> &[u32] {
        list(&self.out_starts, &self.out_edges, node)
    }

    /// Edges that lead to a node, ascending.
    pub(crate) fn entering(&self, node: u32) -> &[u32] {
        list(&self.in_starts, &self.in_edges, node)
    }

    /// Number of edges.
    pub(crate) fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.out_starts.len() - 1
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

/// Counting sort of edges by one of their ends.
fn by_end(count: usize, edges: &[[u32; 2]], end: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; count + 1];
    for edge in edges {
        starts[edge[end] as usize + 1] += 1;
    }
    for node in 0..count {
        starts[node + 1] += starts[node];
    }
    let mut next = starts.clone();
    let mut sorted = vec![0; edges.len()];
    for (i, edge) in edges.iter().enumerate() {
        let at = &mut next[edge[end] as usize];
        sorted[*at as usize] = i as u32;
        *at += 1;
    }
    (starts, sorted)
}

fn list<'a>(starts: &[u32], edges: &'a [u32], node: u32) -> &'a [u32] {
    let node = node as usize;
    &edges[starts[node] as usize..starts[node + 1] as usize]
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
