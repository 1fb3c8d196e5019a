use proptest::prelude::*;

use super::*;
use properties::fixed;

/// Squared distances from a place to all nodes, computed as in the other modules.
fn squared(place: DVec2, nodes: &[DVec2]) -> Vec<f64> {
    nodes
        .iter()
        .map(|&n| (n - place).length_squared())
        .collect()
}

/// The node that is nearest without a tie and hides all others, by Eq. 2 as written.
fn only_neighbour(place: DVec2, nodes: &[DVec2]) -> Option<u32> {
    let away = squared(place, nodes);
    let nearest = (0..nodes.len()).min_by(|&a, &b| away[a].total_cmp(&away[b]))?;
    let hides = |other: usize| {
        let between = (nodes[other] - nodes[nearest]).length_squared();
        away[other] > away[nearest] && away[other] >= between
    };
    (0..nodes.len())
        .all(|other| other == nearest || hides(other))
        .then_some(nearest as u32)
}

/// Nodes in a line towards the sources, scattered, or on a lattice with ties.
fn nodes() -> impl Strategy<Value = Vec<DVec2>> {
    let scattered = proptest::collection::vec((0.0..40.0, 0.0..12.0), 1..60);
    (scattered, 0_u8..3).prop_map(|(points, kind)| {
        let points = points.into_iter().map(DVec2::from).enumerate();
        let place = |(i, p): (usize, DVec2)| match kind {
            0 => p,
            1 => p.floor(),
            _ => DVec2::new(20.0 + 0.05 * p.x, 0.4 * i as f64) + 0.1 * p,
        };
        points.map(place).collect()
    })
}

proptest! {
    #![proptest_config(fixed(600))]

    #[test]
    fn a_lone_source_drives_the_one_node_that_hides_all_others(
        nodes in nodes(), places in proptest::collection::vec((0.0..40.0, 0.0..40.0), 1..60),
        steps in 1_usize..8, near in 0.0..3.0, spacing in 0.2..6.0,
    ) {
        let places: Vec<DVec2> = places.into_iter().map(DVec2::from).collect();
        let (low, high) = (DVec2::ZERO, DVec2::splat(40.0));
        let mut tree = PointTree::new(low, high);
        let mut sources = LoneSources::new();
        let mut basins: Vec<Option<u32>> = vec![None; places.len()];
        let mut last = 0;
        for step in 1..=steps {
            let count = (nodes.len() * step).div_ceil(steps);
            for (id, &node) in nodes.iter().enumerate().take(count).skip(last) {
                tree.insert(id as u32, node);
            }
            let known = &nodes[..count];
            let fresh = FreshNodes::new(known, last as u32);
            let settled = |lone: Lone, basin| basins[lone.slot as usize] = Some(basin);
            let leaving = if fresh.is_empty() {
                Vec::new()
            } else {
                sources.notice(&fresh, &tree, near, settled)
            };
            for lone in leaving {
                basins[lone.slot as usize] = None;
            }
            last = count;
            sources.fit_cells(spacing / step as f64, |lone, basin| {
                basins[lone.slot as usize] = Some(basin);
            });
            // Sources are inserted at different steps; those that left may be inserted again.
            for (slot, &place) in places.iter().enumerate().filter(|(slot, _)| slot % steps < step) {
                if basins[slot].is_none() {
                    let lone = Lone { place, slot: slot as u32 };
                    sources.try_insert(lone, near, &tree, |lone, basin| {
                        basins[lone.slot as usize] = Some(basin);
                    });
                }
            }
            for (&place, basin) in places.iter().zip(&basins) {
                if let Some(basin) = *basin {
                    prop_assert_eq!(Some(sources.node(basin)), only_neighbour(place, known), "{}", place);
                    prop_assert!(squared(place, known).iter().all(|&away| away >= near * near));
                }
            }
        }
    }

    #[test]
    fn a_source_in_front_of_a_straight_row_of_nodes_is_lone(
        x in 5.0..35.0, y in 16.0..40.0, slope in -0.1..0.1,
    ) {
        // Of a row of nodes each source sees the foot of its perpendicular or the node beside it,
        // which hides the rest.
        let nodes: Vec<DVec2> = (0..400)
            .map(|i| 0.1 * f64::from(i))
            .map(|along| DVec2::new(along, 5.0 + slope * along))
            .collect();
        let mut tree = PointTree::new(DVec2::ZERO, DVec2::splat(40.0));
        for (id, &node) in nodes.iter().enumerate() {
            tree.insert(id as u32, node);
        }
        let place = DVec2::new(x, y);
        let mut sources = LoneSources::new();
        sources.fit_cells(2.0, |_, _| {});
        let is_lone = sources.try_insert(Lone { place, slot: 0 }, 3.0, &tree, |_, _| {});
        prop_assert_eq!(is_lone, only_neighbour(place, &nodes).is_some());
        prop_assert!(is_lone);
    }
}
