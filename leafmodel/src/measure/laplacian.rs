//! Symmetric systems of a plane graph: flows through pipes.
//!
//! `L p = q` with the Laplacian `L` of a graph with conductances and some nodes at pressure 0. It is
//! factored without square roots; which entries fill in is found along the elimination tree
//! (\[davis2005\]). Nodes with at most two neighbours go first, which fills in nothing; the rest is
//! dissected by place, as plane graphs allow (\[george1973\]).
//!
//! What remains when a node is eliminated is the Laplacian of another graph: its neighbours `i`, `j`
//! are joined by `wᵢ wⱼ / d` more, with its conductances `w` to them and their sum `d`. So only
//! positive numbers are added, and no digit is lost whatever the contrast of the pipes.

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
    /// Neighbours of a node when it is eliminated, ascending: `rows[starts[k]..starts[k + 1]]`.
    starts: Vec<usize>,
    rows: Vec<u32>,
    /// Shares of the node's conductances to these in their sum with that to ground.
    shares: Vec<f64>,
    /// That sum.
    pivots: Vec<f64>,
}

impl Factored {
    /// Factors the Laplacian of the unknowns at these places. Every unknown must be joined to ground
    /// by pipes of conductance above 0. `None` if a sum of conductances is not finite or vanishes.
    pub(super) fn new(places: &[DVec2], pipes: &[Pipe]) -> Option<Self> {
        let count = places.len();
        let order = order(places, pipes);
        let mut rank = vec![0_u32; count];
        for (new, &old) in (0..).zip(&order) {
            rank[old as usize] = new;
        }
        let mut ground = vec![0.0; count];
        let mut between = Vec::with_capacity(pipes.len());
        for pipe in pipes {
            match pipe.ends {
                [Pipe::GROUND, Pipe::GROUND] => {}
                [Pipe::GROUND, end] | [end, Pipe::GROUND] => {
                    ground[rank[end as usize] as usize] += pipe.conductance;
                }
                ends => {
                    let [a, b] = ends.map(|end| rank[end as usize]);
                    between.push(([a.min(b), a.max(b)], pipe.conductance));
                }
            }
        }
        let (parent, starts, rows) = pattern(count, &Sorted::new(count, &between, 1));
        let mut factored = Self {
            rank,
            parent,
            shares: vec![0.0; rows.len()],
            rows,
            starts,
            pivots: vec![0.0; count],
        };
        factored.eliminate(&Sorted::new(count, &between, 0), ground);
        let is_sound = |pivot: &f64| pivot.is_finite() && *pivot > 0.0;
        factored.pivots.iter().all(is_sound).then_some(factored)
    }

    /// Column by column, each from those eliminated before that have it as a neighbour.
    fn eliminate(&mut self, later: &Sorted, mut ground: Vec<f64>) {
        let count = self.pivots.len();
        let mut joined = vec![0.0; count];
        // Lists of earlier nodes by the next of their neighbours to be eliminated.
        let (mut first, mut next) = (vec![NONE; count], vec![NONE; count]);
        let mut at = self.starts.clone();
        for k in 0..count {
            for &(other, conductance) in later.list(k) {
                joined[other as usize] += conductance;
            }
            let mut earlier = first[k];
            while earlier != NONE {
                let m = earlier as usize;
                earlier = next[m];
                let (here, end) = (at[m], self.starts[m + 1]);
                let through = self.shares[here] * self.pivots[m];
                for i in here + 1..end {
                    joined[self.rows[i] as usize] += through * self.shares[i];
                }
                // What goes to ground from there is kept as a share too.
                ground[k] += self.shares[here] * ground[m];
                at[m] += 1;
                if at[m] < end {
                    let row = self.rows[at[m]] as usize;
                    next[m] = first[row];
                    first[row] = m as u32;
                }
            }
            let mine = self.starts[k]..self.starts[k + 1];
            let sum: f64 = self.rows[mine.clone()]
                .iter()
                .map(|&row| joined[row as usize])
                .sum();
            let pivot = sum + ground[k];
            self.pivots[k] = pivot;
            for i in mine.clone() {
                self.shares[i] = std::mem::take(&mut joined[self.rows[i] as usize]) / pivot;
            }
            if let Some(&row) = self.rows[mine].first() {
                next[k] = first[row as usize];
                first[row as usize] = k as u32;
            }
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
                x[self.rows[at] as usize] += self.shares[at] * value;
            }
        }
        for column in (0..x.len()).rev() {
            let mut value = x[column] / self.pivots[column];
            for at in self.starts[column]..self.starts[column + 1] {
                value += self.shares[at] * x[self.rows[at] as usize];
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
                scratch[self.rows[at] as usize] += self.shares[at] * value;
            }
            if self.parent[column as usize] != NONE {
                open.insert(self.parent[column as usize]);
            }
        }
        sum
    }
}

/// Pipes by one of their ends.
struct Sorted {
    starts: Vec<usize>,
    others: Vec<(u32, f64)>,
}

impl Sorted {
    /// Sorts by the earlier end (0) or by the later (1).
    fn new(count: usize, pipes: &[([u32; 2], f64)], end: usize) -> Self {
        let mut starts = vec![0_usize; count + 1];
        for (ends, _) in pipes {
            starts[ends[end] as usize + 1] += 1;
        }
        for node in 0..count {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut others = vec![(0_u32, 0.0); pipes.len()];
        for (ends, conductance) in pipes {
            let at = &mut next[ends[end] as usize];
            others[*at] = (ends[1 - end], *conductance);
            *at += 1;
        }
        Self { starts, others }
    }

    fn list(&self, node: usize) -> &[(u32, f64)] {
        &self.others[self.starts[node]..self.starts[node + 1]]
    }
}

/// The elimination tree, and the neighbours of each node when it is eliminated.
fn pattern(count: usize, earlier: &Sorted) -> (Vec<u32>, Vec<usize>, Vec<u32>) {
    let mut parent = vec![NONE; count];
    let mut counts = vec![0_usize; count];
    let mut seen = vec![NONE; count];
    // Twice the same walk: nodes are counted first, then listed.
    let mut starts = Vec::new();
    let mut rows = Vec::new();
    let mut filled = Vec::new();
    for is_counted in [false, true] {
        seen.fill(NONE);
        for k in 0..count as u32 {
            seen[k as usize] = k;
            for &(start, _) in earlier.list(k as usize) {
                let mut at = start;
                while seen[at as usize] != k {
                    if parent[at as usize] == NONE {
                        parent[at as usize] = k;
                    }
                    seen[at as usize] = k;
                    if is_counted {
                        let place: &mut usize = &mut filled[at as usize];
                        rows[*place] = k;
                        *place += 1;
                    } else {
                        counts[at as usize] += 1;
                    }
                    at = parent[at as usize];
                }
            }
        }
        if !is_counted {
            starts = vec![0_usize; count + 1];
            for node in 0..count {
                starts[node + 1] = starts[node] + counts[node];
            }
            rows = vec![0_u32; starts[count]];
            filled.clone_from(&starts);
        }
    }
    (parent, starts, rows)
}

/// An order of elimination that fills in little.
fn order(places: &[DVec2], pipes: &[Pipe]) -> Vec<u32> {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); places.len()];
    for pipe in pipes
        .iter()
        .filter(|pipe| !pipe.ends.contains(&Pipe::GROUND))
    {
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
        open.extend(
            near.into_iter()
                .filter(|&other| around[other as usize].len() <= 2),
        );
    }
    let core: Vec<u32> = (0..places.len() as u32)
        .filter(|&n| !is_gone[n as usize])
        .collect();
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
    let (low, high) = nodes.iter().fold(bounds, |(low, high), &n| {
        (low.min(place(n)), high.max(place(n)))
    });
    let axis = usize::from(high.y - low.y > high.x - low.x);
    let half = nodes.len() / 2;
    nodes.select_nth_unstable_by(half, |&a, &b| {
        place(a)[axis].total_cmp(&place(b)[axis]).then(a.cmp(&b))
    });
    let right = nodes.split_off(half);
    for &node in &right {
        side[node as usize] = 1;
    }
    let (between, left): (Vec<u32>, Vec<u32>) = nodes.into_iter().partition(|&node| {
        around[node as usize]
            .iter()
            .any(|&other| side[other as usize] == 1)
    });
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
        let mut pipes = vec![Pipe {
            ends: [0, Pipe::GROUND],
            conductance: 1.0,
        }];
        for i in 0..side * side {
            let more = [
                (i % side + 1 < side).then_some(i + 1),
                (i / side + 1 < side).then_some(i + side),
            ];
            for other in more.into_iter().flatten() {
                let random = uniform(seed, 80, pipes.len() as u64);
                pipes.push(Pipe {
                    ends: [i, other],
                    conductance: libm::pow(10.0, 8.0 * random),
                });
            }
        }
        (places.collect(), pipes)
    }

    #[test]
    fn flows_balance_at_every_node_whatever_the_contrast() {
        for (side, seed) in [(1, 1), (2, 1), (7, 2), (30, 3)] {
            let (places, pipes) = lattice(side, seed);
            let inflow: Vec<f64> = (0..places.len() as u64)
                .map(|i| uniform(seed, 81, i))
                .collect();
            let factored = Factored::new(&places, &pipes).expect("a sound system");
            let pressure = factored.solve(&inflow);
            // All that flows in leaves through the one pipe to ground.
            let all: f64 = inflow.iter().sum();
            assert!(
                (pressure[0] - all).abs() < 1e-12 * all,
                "{} {all}",
                pressure[0]
            );
            // The dissipated power is the same by pipes and by inflows.
            let at = |end: u32| {
                if end == Pipe::GROUND {
                    0.0
                } else {
                    pressure[end as usize]
                }
            };
            let by_pipes: f64 = pipes
                .iter()
                .map(|pipe| pipe.conductance * (at(pipe.ends[0]) - at(pipe.ends[1])).powi(2))
                .sum();
            let by_nodes: f64 = inflow.iter().zip(&pressure).map(|(q, p)| q * p).sum();
            assert!(
                (by_pipes / by_nodes - 1.0).abs() < 1e-6,
                "{by_pipes} {by_nodes}"
            );
        }
    }

    #[test]
    fn no_contrast_is_too_large_for_it() {
        let pipes = [
            Pipe {
                ends: [0, Pipe::GROUND],
                conductance: 1e-200,
            },
            Pipe {
                ends: [0, 1],
                conductance: 1.0,
            },
            Pipe {
                ends: [1, 2],
                conductance: 1e100,
            },
        ];
        let factored = Factored::new(&[DVec2::ZERO, DVec2::X, DVec2::Y], &pipes);
        let pressure = factored.expect("sums are finite").solve(&[0.0, 0.0, 1.0]);
        assert!(
            pressure.iter().all(|p| (p / 1e200 - 1.0).abs() < 1e-14),
            "{pressure:?}"
        );
        let endless = [Pipe {
            conductance: f64::INFINITY,
            ..pipes[0]
        }];
        assert!(Factored::new(&[DVec2::ZERO], &endless).is_none());
    }

    #[test]
    fn the_resistance_between_neighbours_is_what_a_whole_solution_says() {
        let (places, pipes) = lattice(12, 5);
        let factored = Factored::new(&places, &pipes).expect("a sound system");
        let mut scratch = vec![0.0; places.len()];
        for pipe in &pipes[1..] {
            let [a, b] = pipe.ends;
            let mut inflow = vec![0.0; places.len()];
            (inflow[a as usize], inflow[b as usize]) = (1.0, -1.0);
            let pressure = factored.solve(&inflow);
            let expected = pressure[a as usize] - pressure[b as usize];
            let found = factored.resistance(pipe.ends, &mut scratch);
            assert!(
                (found - expected).abs() <= 1e-6 * found,
                "{found} {expected}"
            );
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
