//! Builds the tree from the top down by the binned orientation heuristic of \[conty2018\].

use std::f32::consts::PI;
use std::ops::Range;

use glam::Vec3;

use super::node::{CHILD_BITS, Emitter, IS_LIGHT, Node, WIDTH};
use crate::light::sample::angle;

/// Number of bins along an axis.
const BINS: usize = 16;

/// From this level on sets are split into halves of equal number, so that the deepest trail fits
/// into 64 bits: 2³¹ lights need eleven more levels.
const HALVING_LEVEL: u32 = 10;

/// A light with the data used for splitting.
#[derive(Clone, Copy)]
struct Item {
    emitter: Emitter,
    number: u32,
}

/// Sums over a set of lights.
#[derive(Clone, Copy)]
struct Summary {
    low: Vec3,
    high: Vec3,
    intensity: f32,
    /// Axes weighted by intensity.
    axes: Vec3,
}

/// The nodes, and for each light the path from the root to it.
pub(super) fn build(lights: &[Emitter]) -> (Vec<Node>, Vec<u64>) {
    let items = lights.iter().zip(0..);
    let mut builder = Builder {
        items: items
            .map(|(&emitter, number)| Item { emitter, number })
            .collect(),
        nodes: Vec::new(),
        trails: vec![0; lights.len()],
    };
    builder.node(0..lights.len(), 0, 0);
    (builder.nodes, builder.trails)
}

struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    trails: Vec<u64>,
}

impl Builder {
    /// Builds the node over a range of lights; returns its number.
    fn node(&mut self, range: Range<usize>, level: u32, trail: u64) -> u32 {
        let number = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        for (k, part) in self.parts(range, level).into_iter().enumerate() {
            let trail = trail | (k as u64) << (CHILD_BITS * level);
            if let [item] = self.items[part.clone()] {
                self.trails[item.number as usize] = trail;
                self.nodes[number].set(k, &item.emitter, item.number | IS_LIGHT);
            } else {
                let bounds = around(&self.items[part.clone()]);
                let child = self.node(part, level + 1, trail);
                self.nodes[number].set(k, &bounds, child);
            }
        }
        number as u32
    }

    /// Splits a range into up to eight parts, each time the part that costs most.
    fn parts(&mut self, range: Range<usize>, level: u32) -> Vec<Range<usize>> {
        let cost = |items: &[Item]| match items {
            [] | [_] => -1.0,
            _ if level >= HALVING_LEVEL => items.len() as f32,
            _ => Summary::of(items).cost(),
        };
        let mut parts = vec![(cost(&self.items[range.clone()]), range)];
        while parts.len() < WIDTH {
            let dearest = (0..parts.len())
                .max_by(|&a, &b| parts[a].0.total_cmp(&parts[b].0))
                .expect("a node has lights");
            let (most, part) = parts[dearest].clone();
            if most < 0.0 {
                break;
            }
            let items = &mut self.items[part.clone()];
            let cut = part.start + cut(items, level >= HALVING_LEVEL);
            let halves = [part.start..cut, cut..part.end];
            let [first, second] = halves.map(|half| (cost(&self.items[half.clone()]), half));
            parts[dearest] = first;
            parts.push(second);
        }
        parts.into_iter().map(|(_, part)| part).collect()
    }
}

impl Summary {
    const EMPTY: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        intensity: 0.0,
        axes: Vec3::ZERO,
    };

    fn of(items: &[Item]) -> Self {
        items
            .iter()
            .fold(Self::EMPTY, |sum, item| sum.and(&Self::of_one(item)))
    }

    fn of_one(item: &Item) -> Self {
        let Emitter {
            center,
            radius,
            axis,
            intensity,
            ..
        } = item.emitter;
        Self {
            low: center - radius,
            high: center + radius,
            intensity,
            axes: axis * intensity,
        }
    }

    fn and(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            intensity: self.intensity + other.intensity,
            axes: self.axes + other.axes,
        }
    }

    /// Intensity times surface of the box times a measure of directions: 1 if all axes agree, 4 if
    /// they cancel out.
    ///
    /// It has the same extremes as the paper's measure `M_Ω` for surfaces, π and 4π, up to a
    /// factor. Between them it follows the length of the mean axis, which can be summed over bins.
    fn cost(&self) -> f32 {
        if self.intensity <= 0.0 {
            return 0.0;
        }
        let size = self.high - self.low;
        let surface = size.x * size.y + size.y * size.z + size.z * size.x;
        let agreement = self.axes.length() / self.intensity;
        self.intensity * surface * (4.0 - 3.0 * agreement)
    }
}

/// Splits at least two lights into two non-empty sets; returns the number of lights in the first.
fn cut(items: &mut [Item], halve: bool) -> usize {
    let (low, high) = items
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), item| {
            (low.min(item.emitter.center), high.max(item.emitter.center))
        });
    let size = high - low;
    let half = items.len() / 2;
    let longest = size.max_element();
    if longest <= 0.0 {
        return half;
    }
    let axis = (0..3).find(|&axis| size[axis] == longest).unwrap_or(0);
    if !halve && let Some((axis, bin)) = cheapest(items, low, size) {
        let (mut first, mut second) = (Vec::new(), Vec::new());
        for &item in &*items {
            if bin_of(&item, axis, low, size) < bin {
                first.push(item);
            } else {
                second.push(item);
            }
        }
        let count = first.len();
        items[..count].copy_from_slice(&first);
        items[count..].copy_from_slice(&second);
        return count;
    }
    items.select_nth_unstable_by(half, |a, b| {
        let [a_place, b_place] = [a, b].map(|item| item.emitter.center[axis]);
        a_place.total_cmp(&b_place).then(a.number.cmp(&b.number))
    });
    half
}

/// The axis, and the first bin of the second set, of the split with the least cost; `None` if no
/// split has a cost above 0.
fn cheapest(items: &[Item], low: Vec3, size: Vec3) -> Option<(usize, usize)> {
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|&axis| size[axis] > 0.0) {
        let mut bins = [Summary::EMPTY; BINS];
        let mut counts = [0; BINS];
        for item in items {
            let bin = bin_of(item, axis, low, size);
            bins[bin] = bins[bin].and(&Summary::of_one(item));
            counts[bin] += 1;
        }
        let mut above = [Summary::EMPTY; BINS];
        for bin in (0..BINS - 1).rev() {
            above[bin] = above[bin + 1].and(&bins[bin + 1]);
        }
        // The paper's regularisation, against thin slices of long sets.
        let thin = size.max_element() / size[axis];
        let (mut below, mut count) = (Summary::EMPTY, 0);
        for bin in 0..BINS - 1 {
            below = below.and(&bins[bin]);
            count += counts[bin];
            let cost = thin * (below.cost() + above[bin].cost());
            if count > 0 && count < items.len() && cost < least {
                (best, least) = (Some((axis, bin + 1)), cost);
            }
        }
    }
    // For points, or lights without power, all costs are 0.
    best.filter(|_| least > 0.0)
}

fn bin_of(item: &Item, axis: usize, low: Vec3, size: Vec3) -> usize {
    let place = (item.emitter.center[axis] - low[axis]) / size[axis];
    ((place * BINS as f32) as usize).min(BINS - 1)
}

/// Bounds around several lights.
fn around(items: &[Item]) -> Emitter {
    let summary = Summary::of(items);
    let center = 0.5 * (summary.low + summary.high);
    let farthest = |item: &Item| (item.emitter.center - center).length() + item.emitter.radius;
    let emitters = items.iter().map(|item| &item.emitter);
    // Unweighted: a faint light that looks elsewhere widens the spread as much as a bright one.
    let axis = emitters.clone().map(|emitter| emitter.axis).sum::<Vec3>();
    let (axis, spread) = match axis.try_normalize() {
        None => (Vec3::Z, PI),
        Some(axis) => {
            let spread = emitters
                .clone()
                .map(|emitter| angle(axis, emitter.axis) + emitter.spread)
                .fold(0.0, f32::max);
            (axis, spread.min(PI))
        }
    };
    Emitter {
        center,
        // Allows for rounding of coordinates that cancel in the differences.
        radius: items.iter().map(farthest).fold(0.0, f32::max) * (1.0 + 1e-5),
        axis,
        spread,
        reach: emitters
            .clone()
            .map(|emitter| emitter.reach)
            .fold(0.0, f32::max),
        intensity: summary.intensity,
    }
}
