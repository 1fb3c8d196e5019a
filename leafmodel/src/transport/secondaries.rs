//! Secondary veins and their lengths (Fig. 4 and its tables in \[xia2007\]).

use super::cells::Cell;
use super::leaf::TransportLeaf;
use crate::buckets::Buckets;

/// A lateral counts as a secondary vein if it supplies at least this share of the cells of the
/// greatest lateral. That is a quarter of its width, as for vein orders elsewhere.
const SHARE: f64 = 1.0 / 16.0;

/// A secondary vein. Lengths are in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Secondary {
    /// Cell of the midrib from which it leaves.
    pub from: Cell,
    /// Where it ends.
    pub tip: Cell,
    /// Its length along the cells, in cells.
    pub length: f64,
    /// How many cells it supplies.
    pub count: u32,
}

impl TransportLeaf {
    /// The secondary veins, from the base upwards.
    pub fn secondaries(&self) -> Vec<Secondary> {
        let midrib = self.midrib();
        let mut laterals: Vec<Secondary> = Vec::new();
        let children = self.children();
        for (i, &from) in midrib.iter().enumerate() {
            let next = midrib.get(i + 1);
            for &v in children.list(from).iter().filter(|v| Some(*v) != next) {
                let first = self.cells()[v] - self.cells()[from];
                let way = self.vein(&children, v, first, |_| true);
                let mut length = first.length();
                for pair in way.windows(2) {
                    length += (self.cells()[pair[1]] - self.cells()[pair[0]]).length();
                }
                laterals.push(Secondary {
                    from: self.cells()[from],
                    tip: self.cells()[way[way.len() - 1]],
                    length,
                    count: self.counts()[v],
                });
            }
        }
        let greatest = laterals.iter().map(|s| s.count).max().unwrap_or(0);
        laterals.retain(|s| f64::from(s.count) >= SHARE * f64::from(greatest));
        laterals
    }

    /// The cells of the midrib, from the root: the vein that starts at the root; in a mirrored leaf
    /// it stays on the axis.
    pub fn midrib(&self) -> Vec<usize> {
        let on_axis = |v: usize| !self.is_mirrored() || self.cells()[v].m == 0;
        self.vein(&self.children(), 0, Cell::UP, on_axis)
    }

    /// The vein that reaches `start` by `step`. It always goes on to the allowed cell with the
    /// largest `w^½ (1 + cos φ)`, with the deflection `φ`.
    fn vein(
        &self,
        children: &Buckets<usize>,
        start: usize,
        step: Cell,
        allowed: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let (mut vein, mut step) = (vec![start], step);
        loop {
            let here = vein[vein.len() - 1];
            let score = |v: usize| {
                let next = self.cells()[v] - self.cells()[here];
                let cosine = next.dot(step) as f64 / (next.length() * step.length());
                f64::from(self.counts()[v]).sqrt() * (1.0 + cosine)
            };
            let next = children
                .list(here)
                .iter()
                .copied()
                .filter(|&v| allowed(v))
                .max_by(|&a, &b| score(a).total_cmp(&score(b)));
            let Some(next) = next else { return vein };
            step = self.cells()[next] - self.cells()[here];
            vein.push(next);
        }
    }

    fn children(&self) -> Buckets<usize> {
        let count = self.cells().len();
        let children = (1..count).filter_map(|v| Some((self.parent(v)?, v)));
        Buckets::new(count, children)
    }
}
