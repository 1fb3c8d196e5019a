//! The order in which unknowns are eliminated: nested dissection by place.

use glam::DVec2;

use crate::plane::bounds;

/// Parts of so few nodes are not divided any more.
const SMALL: usize = 24;

/// An order of elimination that fills in little.
pub(super) fn order(places: &[DVec2], pipes: &[Pipe]) -> Vec<u32> {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); places.len()];
    for pipe in pipes
        .iter()
        .filter(|pipe| !pipe.ends.contains(&Pipe::GROUND))
    {
        let [a, b] = pipe.ends;
        around[a as usize].push(b);
        around[b as usize].push(a);
    }
    // Nodes that are gone stay in the lists of others; these are how many do not.
    let mut degrees: Vec<usize> = around.iter().map(Vec::len).collect();
    let mut order = Vec::with_capacity(places.len());
    let mut is_gone = vec![false; places.len()];
    let mut open: Vec<u32> = (0..places.len() as u32).rev().collect();
    while let Some(node) = open.pop() {
        if is_gone[node as usize] || degrees[node as usize] > 2 {
            continue;
        }
        is_gone[node as usize] = true;
        order.push(node);
        let mut near = std::mem::take(&mut around[node as usize]);
        near.retain(|&other| !is_gone[other as usize]);
        for &other in &near {
            degrees[other as usize] -= 1;
        }
        if let [a, b] = near[..] {
            let is_longer = around[a as usize].len() > around[b as usize].len();
            let (short, other) = if is_longer { (b, a) } else { (a, b) };
            if !around[short as usize].contains(&other) {
                for (one, other) in [(a, b), (b, a)] {
                    around[one as usize].push(other);
                    degrees[one as usize] += 1;
                }
            }
        }
        open.extend(
            near.into_iter()
                .filter(|&other| degrees[other as usize] <= 2),
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
    let (low, high) = bounds(nodes.iter().map(|&node| place(node)));
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

/// A pipe between two unknowns, or between one and a node at pressure 0 ([`Pipe::GROUND`]).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pipe {
    pub(crate) ends: [u32; 2],
    pub(crate) conductance: f64,
}

impl Pipe {
    /// Stands for a node at pressure 0.
    pub(crate) const GROUND: u32 = u32::MAX;
}
