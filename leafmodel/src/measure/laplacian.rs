//! Symmetric systems of a plane graph: flows through pipes.
//!
//! `L p = q` with the Laplacian `L` of a graph with conductances and some nodes at pressure 0. It is
//! factored as `L = P (U D Uᵀ) Pᵀ` without square roots, up-looking along the elimination tree
//! (\[davis2005\]). Nodes with at most two neighbours go first, which fills in nothing; the rest is
//! dissected by place, as plane graphs allow (\[george1973\]). All pivots are sums of conductances,
//! so nothing cancels whatever their contrast.

use glam::DVec2;

/// Parts of so few nodes are not divided any more.
const SMALL: usize = 24;

/// Marks what is not there.
const NONE: u32 = u32::MAX;

/// A pipe between two unknowns, or between one and a node at pressure 0 ([`Pipe::GROUND`]).
#[derive(Clone, Copy, Debug)]
pub(super) struct Pipe {
    pub(super) ends: [u32; 2],
    pub(super) conductance: f64,
}

impl Pipe {
    /// Stands for a node at pressure 0.
    pub(super) const GROUND: u32 = NONE;
}

/// A factored Laplacian.
pub(super) struct Factored {
    /// Where each unknown stands in the order of elimination.
    rank: Vec<u32>,
    parent: Vec<u32>,
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
    pivots: Vec<f64>,
}

impl Factored {
    /// Factors the Laplacian of the unknowns at these places. Every unknown must be joined to ground
    /// by pipes of conductance above 0.
    pub(super) fn new(places: &[DVec2], pipes: &[Pipe]) -> Self {
        let count = places.len();
        let order = order(places, pipes);
        let mut rank = vec![0_u32; count];
        for (new, &old) in (0..).zip(&order) {
            rank[old as usize] = new;
        }
        let mut diagonal = vec![0.0; count];
        // Entries above the diagonal by column: the pipes to unknowns that were eliminated before.
        let mut starts = vec![0_usize; count + 1];
        let between = |pipe: &&Pipe| !pipe.ends.contains(&Pipe::GROUND);
        let ranks = |pipe: &Pipe| {
            let [a, b] = pipe.ends.map(|end| rank[end as usize]);
            (a.min(b), a.max(b))
        };
        for pipe in pipes {
            for end in pipe.ends.into_iter().filter(|end| *end != Pipe::GROUND) {
                diagonal[rank[end as usize] as usize] += pipe.conductance;
            }
        }
        for pipe in pipes.iter().filter(between) {
            starts[ranks(pipe).1 as usize + 1] += 1;
        }
        for column in 0..count {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut above = vec![(0_u32, 0.0); starts[count]];
        for pipe in pipes.iter().filter(between) {
            let (row, column) = ranks(pipe);
            let at = &mut next[column as usize];
            above[*at] = (row, -pipe.conductance);
            *at += 1;
        }
        let upper = Upper { starts, above, diagonal };
        let (parent, counts) = upper.tree();
        let mut starts = vec![0_usize; count + 1];
        for column in 0..count {
            starts[column + 1] = starts[column] + counts[column] as usize;
        }
        let mut factored = Self {
            rank,
            parent,
            rows: vec![0; starts[count]],
            values: vec![0.0; starts[count]],
            pivots: vec![0.0; count],
            starts,
        };
        factored.eliminate(&upper);
        factored
    }

    fn eliminate(&mut self, upper: &Upper) {
        let count = self.pivots.len();
        let mut filled = self.starts.clone();
        let mut row = vec![0.0; count];
        let mut seen = vec![NONE; count];
        let mut pattern = vec![0_u32; count];
        let mut way = Vec::new();
        for k in 0..count {
            seen[k] = k as u32;
            let mut top = count;
            for &(i, value) in upper.column(k) {
                row[i as usize] += value;
                let mut at = i;
                while seen[at as usize] != k as u32 {
                    way.push(at);
                    seen[at as usize] = k as u32;
                    at = self.parent[at as usize];
                }
                while let Some(at) = way.pop() {
                    top -= 1;
                    pattern[top] = at;
                }
            }
            let mut pivot = upper.diagonal[k];
            for &i in &pattern[top..] {
                let i = i as usize;
                let value = std::mem::take(&mut row[i]);
                for at in self.starts[i]..filled[i] {
                    row[self.rows[at] as usize] -= self.values[at] * value;
                }
                let share = value / self.pivots[i];
                pivot -= share * value;
                self.rows[filled[i]] = k as u32;
                self.values[filled[i]] = share;
                filled[i] += 1;
            }
            self.pivots[k] = pivot;
        }
    }

    /// The pressures for these inflows.
    pub(super) fn solve(&self, inflow: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; inflow.len()];
        for (old, &rank) in self.rank.iter().enumerate() {
            x[rank as usize] = inflow[old];
        }
        for column in 0..x.len() {
            let value = x[column];
            for at in self.starts[column]..self.starts[column + 1] {
                x[self.rows[at] as usize] -= self.values[at] * value;
            }
        }
        for column in (0..x.len()).rev() {
            let mut value = x[column] / self.pivots[column];
            for at in self.starts[column]..self.starts[column + 1] {
                value -= self.values[at] * x[self.rows[at] as usize];
            }
            x[column] = value;
        }
        self.rank.iter().map(|&rank| x[rank as usize]).collect()
    }

    /// The resistance between the ends of a pipe, along all ways: `bᵀ L⁻¹ b` with 1 and −1 at them.
    ///
    /// Only the ways from both ends to the root of the elimination tree are walked. `scratch` holds
    /// zeros, as many as unknowns, and does so afterwards.
    pub(super) fn resistance(&self, ends: [u32; 2], scratch: &mut [f64]) -> f64 {
        let mut open = std::collections::BTreeSet::new();
        for (end, sign) in ends.into_iter().zip([1.0, -1.0]) {
            if end != Pipe::GROUND {
                let rank = self.rank[end as usize];
                scratch[rank as usize] += sign;
                open.insert(rank);
            }
        }
        let mut sum = 0.0;
        while let Some(column) = open.pop_first() {
            let value = std::mem::take(&mut scratch[column as usize]);
            sum += value * value / self.pivots[column as usize];
            for at in self.starts[column as usize]..self.starts[column as usize + 1] {
                scratch[self.rows[at] as usize] -= self.values[at] * value;
            }
            if self.parent[column as usize] != NONE {
                open.insert(self.parent[column as usize]);
            }
        }
        sum
    }
}

/// The part of a matrix on and above the diagonal, by column.
struct Upper {
    starts: Vec<usize>,
    above: Vec<(u32, f64)>,
    diagonal: Vec<f64>,
}

impl Upper {
    fn column(&self, column: usize) -> &[(u32, f64)] {
        &self.above[self.starts[column]..self.starts[column + 1]]
    }

    /// The elimination tree, and the number of entries below each pivot.
    fn tree(&self) -> (Vec<u32>, Vec<u32>) {
        let count = self.diagonal.len();
        let (mut parent, mut counts) = (vec![NONE; count], vec![0_u32; count]);
        let mut seen = vec![NONE; count];
        for k in 0..count as u32 {
            seen[k as usize] = k;
            for &(i, _) in self.column(k as usize) {
                let mut at = i;
                while seen[at as usize] != k {
                    if parent[at as usize] == NONE {
                        parent[at as usize] = k;
                    }
                    counts[at as usize] += 1;
                    seen[at as usize] = k;
                    at = parent[at as usize];
                }
            }
        }
        (parent, counts)
    }
}

/// An order of elimination that fills in little.
fn order(places: &[DVec2], pipes: &[Pipe]) -> Vec<u32> {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); places.len()];
    for pipe in pipes.iter().filter(|pipe| !pipe.ends.contains(&Pipe::GROUND)) {
        let [a, b] = pipe.ends;
        around[a as usize].push(b);
        around[b as usize].push(a);
    }
    let mut order = Vec::with_capacity(places.len());
    let mut is_gone = vec![false; places.len()];
    let mut open: Vec<u32> = (0..places.len() as u32).rev().collect();
    while let Some(node) = open.pop() {
        if is_gone[node as usize] || around[node as usize].len() > 2 {
            continue;
        }
        is_gone[node as usize] = true;
        order.push(node);
        let near = std::mem::take(&mut around[node as usize]);
        for &other in &near {
            around[other as usize].retain(|&n| n != node);
        }
        if let [a, b] = near[..]
            && !around[a as usize].contains(&b)
        {
            around[a as usize].push(b);
            around[b as usize].push(a);
        }
        open.extend(near.into_iter().filter(|&other| around[other as usize].len() <= 2));
    }
    let core: Vec<u32> = (0..places.len() as u32).filter(|&n| !is_gone[n as usize]).collect();
    let mut side = vec![0_u8; places.len()];
    dissect(core, places, &around, &mut side, &mut order);
    order
}

/// Divides nodes by a line in the middle; those with neighbours beyond it come last.
fn dissect(
    mut nodes: Vec<u32>,
    places: &[DVec2],
    around: &[Vec<u32>],
    side: &mut [u8],
    order: &mut Vec<u32>,
) {
    if nodes.len() <= SMALL {
        order.extend(nodes);
        return;
    }
    let place = |node: u32| places[node as usize];
    let bounds = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = nodes.iter().fold(bounds, |(low, high), &n| (low.min(place(n)), high.max(place(n))));
    let axis = usize::from(high.y - low.y > high.x - low.x);
    let half = nodes.len() / 2;
    nodes.select_nth_unstable_by(half, |&a, &b| {
        place(a)[axis].total_cmp(&place(b)[axis]).then(a.cmp(&b))
    });
    let right = nodes.split_off(half);
    for &node in &right {
        side[node as usize] = 1;
    }
    let (between, left): (Vec<u32>, Vec<u32>) = nodes
        .into_iter()
        .partition(|&node| around[node as usize].iter().any(|&other| side[other as usize] == 1));
    for &node in &right {
        side[node as usize] = 0;
    }
    dissect(left, places, around, side, order);
    dissect(right, places, around, side, order);
    order.extend(between);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::chance::{bits as random_bits, share};

    fn uniform(seed: u64, purpose: u64, counter: u64) -> f64 {
        share(random_bits(seed, purpose, counter))
    }

    /// A square lattice of pipes whose conductances span many powers of ten; corner 0 is joined to
    /// ground.
    fn lattice(side: u32, seed: u64) -> (Vec<DVec2>, Vec<Pipe>) {
        let places = (0..side * side).map(|i| DVec2::new(f64::from(i % side), f64::from(i / side)));
        let mut pipes = vec![Pipe { ends: [0, Pipe::GROUND], conductance: 1.0 }];
        for i in 0..side * side {
            let more = [(i % side + 1 < side).then_some(i + 1), (i / side + 1 < side).then_some(i + side)];
            for other in more.into_iter().flatten() {
                let random = uniform(seed, 80, pipes.len() as u64);
                pipes.push(Pipe { ends: [i, other], conductance: libm::pow(10.0, 8.0 * random) });
            }
        }
        (places.collect(), pipes)
    }

    #[test]
    fn flows_balance_at_every_node_whatever_the_contrast() {
        for (side, seed) in [(1, 1), (2, 1), (7, 2), (30, 3)] {
            let (places, pipes) = lattice(side, seed);
            let inflow: Vec<f64> = (0..places.len() as u64).map(|i| uniform(seed, 81, i)).collect();
            let factored = Factored::new(&places, &pipes);
            let pressure = factored.solve(&inflow);
            // All that flows in leaves through the one pipe to ground.
            let all: f64 = inflow.iter().sum();
            assert!((pressure[0] - all).abs() < 1e-9 * all, "{} {all}", pressure[0]);
            // The dissipated power is the same by pipes and by inflows.
            let at = |end: u32| if end == Pipe::GROUND { 0.0 } else { pressure[end as usize] };
            let by_pipes: f64 = pipes
                .iter()
                .map(|pipe| pipe.conductance * (at(pipe.ends[0]) - at(pipe.ends[1])).powi(2))
                .sum();
            let by_nodes: f64 = inflow.iter().zip(&pressure).map(|(q, p)| q * p).sum();
            assert!((by_pipes / by_nodes - 1.0).abs() < 1e-6, "{by_pipes} {by_nodes}");
        }
    }

    #[test]
    fn the_resistance_between_neighbours_is_what_a_whole_solution_says() {
        let (places, pipes) = lattice(12, 5);
        let factored = Factored::new(&places, &pipes);
        let mut scratch = vec![0.0; places.len()];
        for pipe in &pipes[1..] {
            let [a, b] = pipe.ends;
            let mut inflow = vec![0.0; places.len()];
            (inflow[a as usize], inflow[b as usize]) = (1.0, -1.0);
            let pressure = factored.solve(&inflow);
            let expected = pressure[a as usize] - pressure[b as usize];
            let found = factored.resistance(pipe.ends, &mut scratch);
            assert!((found - expected).abs() <= 1e-6 * found, "{found} {expected}");
        }
        assert!(scratch.iter().all(|value| *value == 0.0));
        // Foster: in a connected graph the g R of all pipes add up to the number of unknowns.
        let sum: f64 = pipes
            .iter()
            .map(|pipe| pipe.conductance * factored.resistance(pipe.ends, &mut scratch))
            .sum();
        assert!((sum - 144.0).abs() < 1e-6, "{sum}");
    }
}
