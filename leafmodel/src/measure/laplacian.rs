//! Symmetric systems of a plane graph: flows through pipes.
//!
//! `L p = q` with the Laplacian `L` of a graph with conductances and some nodes at pressure 0. It is
//! factored without square roots; which entries fill in is found along the elimination tree
//! (\[davis2005\]). Nodes with at most two neighbours go first, which fills in nothing; the rest is
//! dissected by place, as plane graphs allow (\[george1973\]).
//!
//! What remains when a node is eliminated is the Laplacian of another graph: its neighbours `i`, `j`
//! are joined by `wᵢ wⱼ / d` more, with its conductances `w` to them and their sum `d`. So only
//! positive numbers are added, and no digit is lost whatever the contrast of the pipes; the same
//! holds of solutions for inflows that are not negative. The resistance between two unknowns has
//! inflows of both signs, in which digits may cancel.

mod dissection;
#[cfg(test)]
mod tests;

use glam::DVec2;

pub(super) use self::dissection::Pipe;
use self::dissection::order;
use crate::buckets::Buckets;

/// Marks what is not there.
const NONE: u32 = u32::MAX;

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
        let (parent, starts, rows) = pattern(count, &sorted(count, &between, 1));
        let mut factored = Self {
            rank,
            parent,
            shares: vec![0.0; rows.len()],
            rows,
            starts,
            pivots: vec![0.0; count],
        };
        factored.eliminate(&sorted(count, &between, 0), ground);
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

/// The other ends and conductances of pipes by their earlier end (0) or their later one (1).
type Sorted = Buckets<(u32, f64)>;

fn sorted(count: usize, pipes: &[([u32; 2], f64)], end: usize) -> Sorted {
    let others = pipes
        .iter()
        .map(|&(ends, conductance)| (ends[end] as usize, (ends[1 - end], conductance)));
    Buckets::new(count, others)
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
