//! Separate networks inside an areole of another network.

use glam::DVec2;

use super::faces::Walks;
use super::{Areoles, OUTSIDE};

/// Subtracts the area enclosed by every separate network from the areole in which it lies, and
/// marks that areole as the one on the network's outside.
///
/// A ray from the network's leftmost point towards −x meets the vein of another network first. The
/// areole is the one on the near side of that vein, or, if that side is the other network's
/// outside, the areole in which the other network lies. The other network reaches farther left, so
/// networks are dealt with from left to right.
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
        // A tree's area is 0 up to rounding.
        let area = &mut list[areole as usize].area_mm2;
        *area = (*area + walks.areas[outside].min(0.0)).max(f64::MIN_POSITIVE);
    }
}
