//! Networks that lie inside an areole of another.

use glam::DVec2;

use super::faces::Walks;
use super::{Areoles, OUTSIDE};

/// Takes the area enclosed by every separate network off the areole in which it lies, and notes
/// that its outside is there.
///
/// The areole in which a network lies is on the near side of the first other vein met from its
/// leftmost point towards −x; if the outside of that vein's network is met, it is where that one
/// lies. It reaches farther left, so from left to right everything is known in time.
pub(super) fn take_out(found: &mut Areoles, walks: &Walks) {
    let count = walks.outer.len();
    if count < 2 {
        return;
    }
    let Areoles {
        graph,
        chains,
        list,
        on_left,
        ..
    } = found;
    let component = |chain: u32| walks.component_of_joint[chains.ends[chain as usize][0] as usize];
    let mut leftmost = vec![DVec2::INFINITY; count];
    let mut chain_of = vec![0; graph.edges().len()];
    for chain in 0..chains.len() as u32 {
        let left = &mut leftmost[component(chain) as usize];
        for &p in chains.points(chain) {
            if p.x < left.x {
                *left = p;
            }
        }
        for &edge in chains.edges(chain) {
            chain_of[edge as usize] = chain;
        }
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| leftmost[a].x.total_cmp(&leftmost[b].x));
    for island in order {
        let (nodes, edges) = (graph.nodes(), graph.edges());
        let foreign = |edge: u32| component(chain_of[edge as usize]) as usize != island;
        let met = graph
            .grid()
            .first_to_the_left(nodes, edges, leftmost[island], foreign);
        let Some(edge) = met else { continue };
        let chain = chain_of[edge as usize];
        let along = chains.edges(chain).iter().position(|&e| e == edge);
        let along = along.expect("every edge lies on the vein that it was noted for");
        let points = chains.points(chain);
        // The half that runs downwards has +x on its left.
        let upwards = points[along].y < points[along + 1].y;
        let areole = on_left[(2 * chain + u32::from(upwards)) as usize];
        if areole == OUTSIDE {
            continue;
        }
        let outside = walks.outer[island] as usize;
        for &half in walks.halves(outside) {
            on_left[half as usize] = areole;
        }
        // A tree's area is 0 but for rounding.
        let area = &mut list[areole as usize].area_mm2;
        *area = (*area + walks.areas[outside].min(0.0)).max(f64::MIN_POSITIVE);
    }
}
