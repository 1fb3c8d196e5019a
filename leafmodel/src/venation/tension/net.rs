//! The rounds of veins under tension.
//!
//! - **In**: nodes by place, so that what lies near in the blade lies near in memory; the edges.
//! - **Out**: where the nodes are after some steps.
//! - **Always true**: bits are those of one step after the other on one thread. Patches of nodes go
//!   through several steps at once, in the cache.

use std::ops::Range;

use glam::DVec2;
use rayon::prelude::*;

use crate::venation::network::VeinEdge;

/// Share of the way to balance for which a plan's round stands.
const QUARTER: f64 = 0.25;

/// Share of the way to balance that nodes go at a time. With 0.5 one edge in a hundred shrinks to a
/// tenth, and with 0.75 veins begin to cross; quarters take 1.6 times as long, and as many veins cross.
const STEP: f64 = 0.4;

/// The share of the way to balance that nodes go in each step of so many rounds: together as far.
pub(super) fn steps(rounds: u32) -> Vec<f64> {
    let way = QUARTER * f64::from(rounds);
    let whole = (way / STEP) as usize;
    let rest = way - STEP * whole as f64;
    let mut steps = vec![STEP; whole];
    steps.extend((rest > 1e-9).then_some(rest));
    steps
}

/// How many edges away what happens at a node is felt after these steps.
///
/// In a step a node goes a share of its way, as if that share of what it feels came from its
/// neighbours: so what is felt spreads like a walk of as many steps, of that variance each. Nine times
/// its standard deviation away less is left than a number has bits.
pub(super) fn reach(steps: &[f64]) -> u32 {
    let deviation = steps.iter().sum::<f64>().sqrt();
    (steps.len() as u32).min((9.0 * deviation).ceil() as u32)
}

/// Nodes of a patch. With what pulls at them they fill half a megabyte, a second cache.
const PATCH: usize = 8192;

/// Steps that a patch goes through at once. Around it as many edges are worked on by its neighbours
/// too.
const AT_ONCE: usize = 8;

/// Nodes by place, and what pulls at them.
pub(super) struct Net {
    pulls: PullsByPlace,
    is_free: Vec<bool>,
}

impl Net {
    /// The net of these edges. `places` are those of the nodes; `is_free` says of a place whether
    /// what is there moves.
    pub(super) fn new(places: &[u32], edges: &[VeinEdge], is_free: impl Fn(usize) -> bool) -> Self {
        Self {
            pulls: pulls_by_place(edges, places),
            is_free: (0..places.len()).map(is_free).collect(),
        }
    }

    /// Where what is at each place is after these steps; edges shorter than `shortest` do not pull.
    pub(super) fn after(&self, mut now: Vec<DVec2>, steps: &[f64], shortest: f64) -> Vec<DVec2> {
        let patches = self.patches(steps.len().min(AT_ONCE));
        let mut next = now.clone();
        for steps in steps.chunks(AT_ONCE) {
            let moved = next.par_chunks_mut(PATCH).zip(&patches);
            moved.for_each(|(next, patch)| patch.advance(&now, next, steps, shortest));
            std::mem::swap(&mut now, &mut next);
        }
        now
    }

    /// All places in patches of [`PATCH`], each with what lies at most `reach` edges from it.
    fn patches(&self, reach: usize) -> Vec<Patch> {
        let count = self.is_free.len();
        let patches = count.div_ceil(PATCH);
        let unknown = || vec![u32::MAX; count];
        (0..patches)
            .into_par_iter()
            .map_init(unknown, |local, number| {
                let first = number * PATCH;
                let own = first as u32..count.min(first + PATCH) as u32;
                self.patch(own, reach, local)
            })
            .collect()
    }

    /// A patch; `local` is [`u32::MAX`] for all places, before and after.
    fn patch(&self, own: Range<u32>, reach: usize, local: &mut [u32]) -> Patch {
        let mut places: Vec<u32> = own.collect();
        let own = places.len();
        let (mut rings, mut pulls) = (Vec::new(), PullsByPlace::default());
        let mut ring = 0..own;
        loop {
            // Those of one kind follow one another.
            places[ring.clone()].sort_by_key(|&place| self.kind(place));
            for (number, &place) in ring.clone().zip(&places[ring.clone()]) {
                local[place as usize] = number as u32;
            }
            if rings.len() == reach {
                break;
            }
            let from = ring.start;
            let ends = [Kind::OnePair, Kind::TwoPairs, Kind::More].map(|kind| {
                places[ring.clone()].partition_point(|&place| self.kind(place) <= kind)
            });
            rings.push(Ring {
                one_pair: from..from + ends[0],
                two_pairs: from + ends[0]..from + ends[1],
                more: from + ends[1]..from + ends[2],
            });
            let end = places.len();
            for i in ring {
                for &other in self.pulls.of(places[i]).iter().flat_map(|pulls| &pulls.to) {
                    if local[other as usize] == u32::MAX {
                        local[other as usize] = IN_NEXT_RING;
                        places.push(other);
                    }
                }
            }
            ring = end..places.len();
        }
        for &place in &places[..ring.start] {
            pulls.push(self.pulls.of(place).iter().map(|pulls| Pulls {
                to: pulls.to.map(|other| local[other as usize]),
                ..*pulls
            }));
        }
        for &place in &places {
            local[place as usize] = u32::MAX;
        }
        Patch {
            own,
            places,
            rings,
            pulls,
        }
    }

    fn kind(&self, place: u32) -> Kind {
        match (self.is_free[place as usize], self.pulls.of(place).len()) {
            (false, _) | (_, 0) => Kind::Held,
            (true, 1) => Kind::OnePair,
            (true, 2) => Kind::TwoPairs,
            (true, _) => Kind::More,
        }
    }
}

/// Of a place that is found, but has no number in its patch yet.
const IN_NEXT_RING: u32 = u32::MAX - 1;

/// How many pairs of pulls are on what lies at a place, if it moves.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    OnePair,
    TwoPairs,
    More,
    Held,
}

/// Places that go through several steps at once: their own, and what they feel in that time.
struct Patch {
    /// Number of its own places.
    own: usize,
    /// Own places, then those farther and farther away.
    places: Vec<u32>,
    /// Those 0, 1, 2 … edges away, without the farthest.
    rings: Vec<Ring>,
    /// What pulls at them.
    pulls: PullsByPlace,
}

/// What lies equally many edges from a patch and moves, by its pairs of pulls: where all have as many,
/// the processor need not guess how many come next.
struct Ring {
    one_pair: Range<usize>,
    two_pairs: Range<usize>,
    more: Range<usize>,
}

impl Patch {
    /// Writes where its own places, which follow one another in the net, are after these steps.
    fn advance(&self, before: &[DVec2], after: &mut [DVec2], steps: &[f64], shortest: f64) {
        let place = |place: &u32| before[*place as usize];
        let mut now: Vec<DVec2> = self.places.iter().map(place).collect();
        let mut next = now.clone();
        for (left, &step) in (0..steps.len()).rev().zip(steps) {
            // Farther ones have no effect on its own any more.
            for ring in &self.rings[..=left] {
                self.pull::<1>(ring.one_pair.clone(), &now, &mut next, [step, shortest]);
                self.pull::<2>(ring.two_pairs.clone(), &now, &mut next, [step, shortest]);
                for node in ring.more.clone() {
                    let pulls = self.pulls.of(node as u32);
                    next[node] = pulled(now[node], pulls, &now, [step, shortest]);
                }
            }
            std::mem::swap(&mut now, &mut next);
        }
        let first = self.places[..self.own].iter().min().copied().unwrap_or(0);
        for (&place, now) in self.places[..self.own].iter().zip(now) {
            after[(place - first) as usize] = now;
        }
    }

    /// One step of nodes that have as many pairs of pulls each.
    fn pull<const PAIRS: usize>(
        &self,
        nodes: Range<usize>,
        now: &[DVec2],
        next: &mut [DVec2],
        [step, shortest]: [f64; 2],
    ) {
        let pulls = &self.pulls.pulls[self.pulls.starts[nodes.start] as usize..];
        let (pulls, _) = pulls.as_chunks::<PAIRS>();
        let here = &now[nodes.clone()];
        for ((next, &here), pulls) in next[nodes].iter_mut().zip(here).zip(pulls) {
            *next = pulled(here, pulls, now, [step, shortest]);
        }
    }
}

/// Where a node goes in a step: a share of the way along Σ r w / l over Σ r / l, for ways w of
/// lengths l to the other ends of veins of radii r.
///
/// Numerator and denominator are kept times the product of the lengths, so that one division is left.
#[inline(always)]
fn pulled(here: DVec2, pulls: &[Pulls], now: &[DVec2], [step, shortest]: [f64; 2]) -> DVec2 {
    let (mut pull, mut sum, mut scale) = (DVec2::ZERO, 0.0, 1.0);
    for pair in pulls {
        let ways = pair.to.map(|other| now[other as usize] - here);
        let lengths = ways.map(DVec2::length);
        // Short ones are weighed with 0: a branch would keep the square roots apart.
        let weights = [0, 1].map(|i| {
            let pulls = f64::from(u8::from(lengths[i] >= shortest));
            pulls * pair.radius[i] * lengths[1 - i].max(shortest)
        });
        let lengths = lengths[0].max(shortest) * lengths[1].max(shortest);
        let way = ways[0] * weights[0] + ways[1] * weights[1];
        pull = pull * lengths + way * scale;
        sum = sum * lengths + (weights[0] + weights[1]) * scale;
        scale *= lengths;
    }
    if sum > 0.0 {
        here + pull * (step / sum)
    } else {
        here
    }
}

/// Two pulls on a node: the places at the other ends, and the radii of the veins. Square roots of a
/// pair take the time of one; a node within a vein has one pair.
#[derive(Clone, Copy)]
struct Pulls {
    to: [u32; 2],
    radius: [f64; 2],
}

/// The pulls on each place.
struct PullsByPlace {
    /// Where those of each place begin.
    starts: Vec<u32>,
    pulls: Vec<Pulls>,
}

impl Default for PullsByPlace {
    fn default() -> Self {
        Self {
            starts: vec![0],
            pulls: Vec::new(),
        }
    }
}

impl PullsByPlace {
    fn of(&self, place: u32) -> &[Pulls] {
        let place = place as usize;
        &self.pulls[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// Those of the next place.
    fn push(&mut self, pulls: impl Iterator<Item = Pulls>) {
        self.pulls.extend(pulls);
        self.starts.push(self.pulls.len() as u32);
    }
}

/// All pulls on each place in the order of `edges`; `places` are those of the nodes. Where there is no
/// second pull, the place itself stands, which does not pull.
fn pulls_by_place(edges: &[VeinEdge], places: &[u32]) -> PullsByPlace {
    let ends = |edge: &VeinEdge| [edge.from, edge.to].map(|node| places[node as usize]);
    let mut degrees = vec![0_u32; places.len()];
    for place in edges.iter().flat_map(ends) {
        degrees[place as usize] += 1;
    }
    let mut all = PullsByPlace::default();
    for (place, &degree) in (0..).zip(&degrees) {
        let none = Pulls {
            to: [place; 2],
            radius: [0.0; 2],
        };
        all.push(std::iter::repeat_n(none, degree.div_ceil(2) as usize));
    }
    let mut filled = vec![0_u32; places.len()];
    for edge in edges {
        let [from, to] = ends(edge);
        for (here, there) in [(from, to), (to, from)] {
            let number = filled[here as usize];
            filled[here as usize] += 1;
            let pair = &mut all.pulls[(all.starts[here as usize] + number / 2) as usize];
            pair.to[number as usize % 2] = there;
            pair.radius[number as usize % 2] = edge.radius_to;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_as_far_as_rounds() {
        for rounds in [0, 1, 2, 8, 40, 120, 1000] {
            let steps = steps(rounds);
            let way: f64 = steps.iter().sum();
            assert!(
                (way - QUARTER * f64::from(rounds)).abs() < 1e-9,
                "{rounds}: {way}"
            );
            assert!(steps.iter().all(|&step| step > 0.0 && step <= STEP));
        }
        assert_eq!((steps(8).len(), steps(120).len()), (5, 75));
        assert_eq!([8, 120].map(|rounds| reach(&steps(rounds))), [5, 50]);
    }

    #[test]
    fn patches_give_the_bits_of_one_step_after_the_other() {
        // A crooked net of more nodes than a patch has, some of which are held.
        let (wide, high) = (210_u32, 170_u32);
        let places: Vec<u32> = (0..wide * high).collect();
        assert!(places.len() > 2 * PATCH);
        let start: Vec<DVec2> = places
            .iter()
            .map(|&i| {
                let (x, y) = (f64::from(i % wide), f64::from(i / wide));
                let askew = DVec2::new(libm::sin(7.0 * x + y), libm::sin(3.0 * x - 5.0 * y));
                DVec2::new(x, y) + 0.3 * askew
            })
            .collect();
        let edge = |from, to| VeinEdge {
            from,
            to,
            radius_from: 1.0,
            radius_to: 1.0 + f64::from(from % 5),
            order: 1,
        };
        let edges: Vec<VeinEdge> = (0..wide * high)
            .flat_map(|i| {
                let right = (i % wide + 1 < wide && i % 7 != 3).then(|| edge(i, i + 1));
                let up = (i / wide + 1 < high && i % 3 != 1).then(|| edge(i + wide, i));
                [right, up].into_iter().flatten()
            })
            .collect();
        let shortest = 0.8;
        let steps = steps(31);
        assert!(steps.len() > 2 * AT_ONCE && steps[19] < 0.9 * STEP);
        let net = Net::new(&places, &edges, |place| place % 11 != 0);
        let mut at_node = vec![Vec::new(); places.len()];
        for edge in &edges {
            at_node[edge.from as usize].push((edge.to, edge.radius_to));
            at_node[edge.to as usize].push((edge.from, edge.radius_to));
        }
        let mut expected = start.clone();
        for step in &steps {
            let before = expected.clone();
            for (node, pulls) in at_node
                .iter()
                .enumerate()
                .filter(|(node, _)| node % 11 != 0)
            {
                let (mut pull, mut sum) = (DVec2::ZERO, 0.0);
                for &(other, radius) in pulls {
                    let way = before[other as usize] - before[node];
                    if way.length() >= shortest {
                        pull += way * (radius / way.length());
                        sum += radius / way.length();
                    }
                }
                if sum > 0.0 {
                    expected[node] = before[node] + pull * (step / sum);
                }
            }
        }
        let at_once = net.after(start.clone(), &steps, shortest);
        for (found, expected) in at_once.iter().zip(&expected) {
            assert!((*found - *expected).length() < 1e-11);
        }
        let one_by_one = steps.chunks(1);
        let one_by_one = one_by_one.fold(start, |now, step| net.after(now, step, shortest));
        assert_eq!(at_once, one_by_one);
    }
}
