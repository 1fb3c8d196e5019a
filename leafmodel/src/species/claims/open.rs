//! Claims about open patterns.

use super::*;
use crate::venation::plan::Growth;

/// The free ends of the veins of a network.
fn tips(network: &VenationNetwork) -> Vec<DVec2> {
    let mut leads_on = vec![false; network.nodes().len()];
    for edge in network.edges() {
        leads_on[edge.from as usize] = true;
    }
    let ends = network.nodes().iter().zip(leads_on);
    ends.filter(|(_, on)| !on)
        .map(|(node, _)| node.position)
        .collect()
}

#[test]
fn fig_9i_growing_tips_follow_the_margin_of_a_slow_leaf() {
    // Median distance of the newest nodes from the margin at that time, over the leaf's length at
    // that time.
    let lag = |leaf: &Grown| -> Vec<f64> {
        let Growth::Marginal { length_step, .. } = leaf.auxin().growth else {
            panic!("the margin grows");
        };
        // When the leaf is a quarter, a half and three quarters of its final length.
        let final_length = leaf.auxin().final_length;
        let steps = [0.25, 0.5, 0.75].map(|share| (share * final_length / length_step) as u32);
        let median = |stage: &Stage| {
            let nodes = stage.network.nodes().iter();
            let young = nodes.filter(|node| node.born + 10 >= stage.step);
            let away = |p: DVec2| stage.outline.distance_to_margin(p) / stage.outline.length();
            let mut far: Vec<f64> = young.map(|node| away(node.position)).collect();
            far.sort_by(f64::total_cmp);
            far[far.len() / 2]
        };
        leaf.stages(&steps).iter().map(median).collect()
    };
    let slow = Grown::preset("runions-9i");
    // The same leaf grown ten times as fast: its tips fall behind.
    let mut veins = slow.auxin().clone();
    let Growth::Marginal { length_step, .. } = &mut veins.growth else {
        panic!("the margin grows");
    };
    *length_step *= 10.0;
    let (slow, fast) = (lag(&slow), lag(&slow.with_veins(veins)));
    assert!(slow.iter().all(|&lag| lag < 0.08), "{slow:?}");
    let mean = |lags: &[f64]| lags.iter().sum::<f64>() / lags.len() as f64;
    // No tip of this narrow leaf is far from the margin, so that the fast one cannot lag by much more.
    assert!(1.5 * mean(&slow) < mean(&fast), "{slow:?} {fast:?}");
}

#[test]
fn fig_10_ginkgo_veins_fork_in_two_so_that_the_gap_between_tips_stays() {
    let leaf = Grown::preset("ginkgo");
    let network = &leaf.network;
    assert_eq!(network.loops(), 0);
    // Number of veins that cross circles around the base.
    let crossing = |share: f64| {
        let radius = share * leaf.length();
        let crosses = |s: &VeinSegment| (s.from.length() < radius) != (s.to.length() < radius);
        network.segments().filter(crosses).count() as f64
    };
    let gaps = [0.3, 0.5, 0.7, 0.9].map(|share| share / crossing(share));
    let (narrow, wide) = (
        gaps.iter().copied().fold(f64::MAX, f64::min),
        gaps.iter().copied().fold(0.0, f64::max),
    );
    // Without forks the gap would grow threefold on the way.
    assert!(wide < 1.6 * narrow, "{gaps:?}");
    // Forks: both prongs leave to different sides of the vein's direction.
    let edges = network.edges();
    let at = |node: u32| network.nodes()[node as usize].position;
    let look = |mut node: u32| {
        for _ in 0..6 {
            let Some(next) = edges.iter().find(|e| e.from == node) else {
                break;
            };
            node = next.to;
        }
        at(node)
    };
    let mut deflections = Vec::new();
    for node in 1..network.nodes().len() as u32 {
        let prongs: Vec<u32> = edges
            .iter()
            .filter(|e| e.from == node)
            .map(|e| e.to)
            .collect();
        if let [a, b] = prongs[..] {
            let outward = at(node).normalize();
            let angle = |p: DVec2| {
                let way = p - at(node);
                libm::atan2(outward.perp_dot(way), outward.dot(way)).to_degrees()
            };
            let (a, b) = (angle(look(a)), angle(look(b)));
            deflections.push((a, b));
        }
    }
    let apart = deflections.iter().filter(|(a, b)| a * b < 0.0).count();
    let steep = deflections
        .iter()
        .filter(|(a, b)| a.abs().max(b.abs()) < 60.0)
        .count();
    assert!(deflections.len() > 20, "{}", deflections.len());
    assert!(
        steep * 10 > 6 * deflections.len(),
        "{steep} of {}",
        deflections.len()
    );
    assert!(
        apart * 2 > deflections.len(),
        "{apart} of {}",
        deflections.len()
    );
    // Veins reach the whole distal margin.
    let near = tips(network)
        .iter()
        .filter(|p| p.length() > 0.93 * leaf.length())
        .count();
    assert!(near as f64 > 0.6 * crossing(0.9), "{near}");
}

#[test]
fn fig_11_primaries_of_ladys_mantle_radiate_from_the_petiole() {
    let leaf = Grown::preset("alchemilla");
    let radius = 0.25 * leaf.length();
    let mut angles: Vec<f64> = leaf
        .major(3)
        .iter()
        .filter(|s| (s.from.length() < radius) != (s.to.length() < radius))
        .map(|s| libm::atan2(s.to.x, s.to.y).to_degrees())
        .collect();
    angles.sort_by(f64::total_cmp);
    let apart = angles
        .windows(2)
        .filter(|pair| pair[1] - pair[0] > 8.0)
        .count()
        + 1;
    assert!(apart >= 7, "{angles:?}");
    assert!(
        angles[0] < -90.0 && angles[angles.len() - 1] > 90.0,
        "{angles:?}"
    );
    let radial: f64 = leaf
        .major(2)
        .iter()
        .map(|s| {
            let way = s.to - s.from;
            way.dot(s.to.normalize()) / way.length()
        })
        .sum::<f64>()
        / leaf.major(2).len() as f64;
    assert!(radial > 0.8, "{radial}");
}

#[test]
fn fig_12_a_major_vein_runs_to_the_tip_of_every_lobe() {
    let leaf = Grown::preset("sweetgum");
    let length = leaf.length();
    for (degrees, radius) in [
        (0.0, 1.0),
        (53.0, 0.93),
        (-53.0, 0.93),
        (107.0, 0.70),
        (-107.0, 0.70),
    ] {
        let angle = f64::to_radians(degrees);
        let tip = DVec2::new(libm::sin(angle), libm::cos(angle)) * (radius * length);
        let near = |order: u8, within: f64| {
            leaf.major(order)
                .iter()
                .any(|s| (s.to - tip).length() < within * length)
        };
        assert!(near(12, 0.03), "no vein at the tip at {degrees} degrees");
        assert!(
            near(3, 0.3),
            "no major vein in the lobe at {degrees} degrees"
        );
    }
    assert_eq!(leaf.network.loops(), 0);
}

#[test]
fn fig_16_unseen_veinlets_widen_the_major_veins_only() {
    let leaf = Grown::preset("cherry");
    let bare = leaf.with_veins(AuxinPlan {
        unseen_veinlets: 0.0,
        ..leaf.auxin().clone()
    });
    assert_eq!(leaf.network.loops(), 0);
    assert_eq!(leaf.network.nodes(), bare.network.nodes());
    for (wide, thin) in leaf.network.edges().iter().zip(bare.network.edges()) {
        assert_eq!(wide.order, thin.order);
        assert!(wide.radius_to >= thin.radius_to);
        assert!(wide.order <= 2 || wide.radius_to == thin.radius_to);
    }
    let base = |g: &Grown| g.network.edges()[0].radius_from;
    assert!(base(&leaf) > 2.0 * base(&bare));
}
