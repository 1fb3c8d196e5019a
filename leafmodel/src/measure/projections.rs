//! Lobes and teeth of a margin, counted as a botanist counts them.
//!
//! Lobes are local maxima along the margin of the distance from the midrib or, where primaries spread
//! like fingers, from the base; teeth are maxima of the height over the margin without its teeth. How
//! much one stands out is how far one has to come down from it before the margin rises to a greater
//! one (its persistence, as in topology).
//!
//! # Source
//!
//! \[ellis2009\] for the limit between lobe and tooth (an incision of a quarter of the way to the
//! midrib); the limit between a tooth and a gland or an unevenness is ours.

use glam::DVec2;

use super::margin::hull_perimeter;
use super::statistics::quantile;
use crate::numeric::Sets;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Evenly spaced points of the margin at which projections are looked for.
const SAMPLES: usize = 8192;

/// A pinnate lobe stands out by this share of its distance from the midrib.
const LOBE: f64 = 0.25;

/// A palmate lobe, which a primary feeds, by this share of its distance from the base.
const FED_LOBE: f64 = 0.05;

/// Points on either side over which the margin is evened out to take its teeth away.
const EVENED: usize = SAMPLES / 80;

/// What stands out less, share of the leaf's length, is no projection at all.
const UNEVEN: f64 = 1e-4;

/// A tooth stands out by this share of what nine tenths of all projections do not exceed.
const TOOTH: f64 = 0.35;

/// What lies so near to apex or base, share of the length, is these and no tooth.
const END: f64 = 0.03;

/// Lobes and teeth of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projections {
    /// Lobes, the terminal one included; 1 is an unlobed leaf.
    pub lobes: usize,
    /// Teeth on the right and on the left of the midrib, adaxial face up, base below. Lobes are
    /// none.
    pub teeth: [usize; 2],
    /// Teeth per cm of the margin's convex hull, ≥ 0.
    pub teeth_per_cm: f64,
}

/// A maximum along a closed curve.
#[derive(Clone, Copy)]
struct Peak {
    /// Which point.
    at: usize,
    /// Its height.
    height: f64,
    /// How much it stands out.
    prominence: f64,
}

/// Counts lobes and teeth. `network` tells whether primaries spread, and where they end.
pub(crate) fn projections(outline: &Outline, network: &VenationNetwork) -> Projections {
    let points = evenly(outline.points());
    let teeth = teeth(outline, &points);
    Projections {
        lobes: lobes(outline, &points, &primary_ends(network)),
        teeth,
        teeth_per_cm: 10.0 * (teeth[0] + teeth[1]) as f64 / hull_perimeter(outline),
    }
}

/// Distance to the right of the midrib's line.
fn across(outline: &Outline, p: DVec2) -> f64 {
    let midrib = (outline.apex() - outline.base()) / outline.length();
    -midrib.perp_dot(p - outline.base())
}

fn lobes(outline: &Outline, points: &[DVec2], primary_ends: &[DVec2]) -> usize {
    if primary_ends.len() > 2 {
        let radii: Vec<f64> = points.iter().map(|p| p.distance(outline.base())).collect();
        let mut tips = peaks(&radii);
        tips.retain(|tip| tip.prominence >= FED_LOBE * tip.height);
        let nearest = |end: &DVec2| {
            let squared = |tip: &&Peak| points[tip.at].distance_squared(*end);
            let tip = tips.iter().min_by(|a, b| squared(a).total_cmp(&squared(b)));
            tip.map(|tip| tip.at)
        };
        let mut fed: Vec<usize> = primary_ends.iter().filter_map(nearest).collect();
        fed.sort_unstable();
        fed.dedup();
        return fed.len().max(1);
    }
    let heights: Vec<f64> = points.iter().map(|p| across(outline, *p).abs()).collect();
    let is_lobe = |peak: &&Peak| peak.prominence >= LOBE * peak.height;
    let lateral = peaks(&heights).iter().filter(is_lobe).count();
    // An unlobed leaf has two: where it is widest on either side.
    if lateral > 2 { lateral + 1 } else { 1 }
}

/// Teeth on the right and on the left.
fn teeth(outline: &Outline, points: &[DVec2]) -> [usize; 2] {
    let n = points.len();
    let mut sum: DVec2 = (0..=2 * EVENED).map(|k| points[(n + k - EVENED) % n]).sum();
    let mut even = Vec::with_capacity(n);
    for i in 0..n {
        even.push(sum / (2 * EVENED + 1) as f64);
        sum += points[(i + 1 + EVENED) % n] - points[(i + n - EVENED) % n];
    }
    // Outlines run counter-clockwise: the outside is on the right.
    let outward = |i: usize| {
        let along = even[(i + EVENED / 2) % n] - even[(i + n - EVENED / 2) % n];
        -along.perp().normalize_or_zero()
    };
    let heights: Vec<f64> = (0..n)
        .map(|i| (points[i] - even[i]).dot(outward(i)))
        .collect();
    let (length, ends) = (outline.length(), [outline.base(), outline.apex()]);
    let mut found = peaks(&heights);
    found.retain(|peak| {
        let is_end = ends
            .iter()
            .any(|end| points[peak.at].distance(*end) < END * length);
        peak.prominence > UNEVEN * length && !is_end
    });
    let mut risen: Vec<f64> = found.iter().map(|peak| peak.prominence).collect();
    let typical = quantile(&mut risen, 0.9).unwrap_or(0.0);
    found.retain(|peak| peak.prominence >= TOOTH * typical);
    let right = |peak: &&Peak| across(outline, points[peak.at]) > 0.0;
    let right = found.iter().filter(right).count();
    [right, found.len() - right]
}

/// Where primaries end.
fn primary_ends(network: &VenationNetwork) -> Vec<DVec2> {
    let primaries = || network.edges().iter().filter(|edge| edge.order == 1);
    let mut goes_on = vec![false; network.nodes().len()];
    for edge in primaries() {
        goes_on[edge.from as usize] = true;
    }
    primaries()
        .filter(|edge| !goes_on[edge.to as usize])
        .map(|edge| network.nodes()[edge.to as usize].position)
        .collect()
}

/// All maxima along a closed curve of heights, by place.
fn peaks(heights: &[f64]) -> Vec<Peak> {
    let n = heights.len();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| heights[b].total_cmp(&heights[a]).then(a.cmp(&b)));
    // Islands that grow together as the water sinks; each knows its highest point.
    let (mut islands, mut is_out) = (Sets::new(n), vec![false; n]);
    let mut found = Vec::new();
    for &i in &order {
        is_out[i] = true;
        for j in [(i + n - 1) % n, (i + 1) % n] {
            let [a, b] = [i, j].map(|place| islands.leader(place as u32) as usize);
            if !is_out[j] || a == b {
                continue;
            }
            // A root is the highest point of its island, the earlier of two as high.
            let is_first = heights[a] > heights[b] || (heights[a] == heights[b] && a < b);
            let (high, low) = if is_first { (a, b) } else { (b, a) };
            if low != i {
                let prominence = heights[low] - heights[i];
                found.push(Peak {
                    at: low,
                    height: heights[low],
                    prominence,
                });
            }
            islands.attach(low as u32, high as u32);
        }
    }
    if let (Some(&highest), Some(&lowest)) = (order.first(), order.last()) {
        found.push(Peak {
            at: highest,
            height: heights[highest],
            prominence: heights[highest] - heights[lowest],
        });
    }
    found.retain(|peak| peak.prominence > 0.0);
    found.sort_by_key(|peak| peak.at);
    found
}

/// Points of a closed polygon at equal distances along it.
fn evenly(corners: &[DVec2]) -> Vec<DVec2> {
    let edge = |i: usize| corners[(i + 1) % corners.len()] - corners[i];
    let perimeter: f64 = (0..corners.len()).map(|i| edge(i).length()).sum();
    let (mut corner, mut passed) = (0, 0.0);
    let mut points = Vec::with_capacity(SAMPLES);
    for k in 0..SAMPLES {
        let along = perimeter * k as f64 / SAMPLES as f64;
        while corner + 1 < corners.len() && passed + edge(corner).length() <= along {
            passed += edge(corner).length();
            corner += 1;
        }
        let length = edge(corner).length().max(f64::MIN_POSITIVE);
        points.push(corners[corner] + edge(corner) * ((along - passed) / length).min(1.0));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::venation::network::{VeinEdge, VeinNode};

    /// Primaries from the base to the given places.
    fn veins(base: DVec2, ends: &[DVec2]) -> VenationNetwork {
        let nodes = std::iter::once(base).chain(ends.iter().copied());
        let nodes = nodes.map(|position| VeinNode { position, born: 0 });
        let edge = |to: u32| VeinEdge {
            from: 0,
            to,
            radius_from: 0.2,
            radius_to: 0.2,
            order: 1,
        };
        let edges = (1..=ends.len() as u32).map(edge).collect();
        VenationNetwork::from_parts(nodes.collect(), edges, 0.1).expect("a good network")
    }

    /// A margin `radius(angle)` around a point of the midrib at 30 mm, 60 mm long.
    fn leaf(radius: impl Fn(f64) -> f64, ends: &[DVec2]) -> (Outline, VenationNetwork) {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 2000.0 - std::f64::consts::FRAC_PI_2;
            let way = DVec2::new(libm::cos(angle), libm::sin(angle));
            DVec2::new(0.0, 30.0) + way * radius(angle)
        };
        let points: Vec<DVec2> = (0..2000).map(at).collect();
        let (base, apex) = (points[0], points[1000]);
        let outline = Outline::new(points, base, apex).expect("a good margin");
        (outline, veins(base, ends))
    }

    #[test]
    fn a_round_leaf_has_neither_lobes_nor_teeth() {
        let (outline, network) = leaf(|_| 30.0, &[DVec2::new(0.0, 60.0)]);
        let found = projections(&outline, &network);
        assert_eq!((found.lobes, found.teeth), (1, [0, 0]));
    }

    #[test]
    fn teeth_of_a_saw_are_counted_and_its_unevenness_is_not() {
        // Forty waves of 0.8 mm around, each with a ripple of a fortieth of that; base and apex lie
        // on waves.
        let wave = |a: f64| 30.0 + 0.8 * libm::cos(40.0 * a) + 0.02 * libm::cos(400.0 * a);
        let (outline, network) = leaf(wave, &[DVec2::new(0.0, 60.0)]);
        let found = projections(&outline, &network);
        assert_eq!((found.lobes, found.teeth), (1, [19, 19]));
        let round = 0.2 * std::f64::consts::PI * 30.8;
        assert!((found.teeth_per_cm * round / 38.0 - 1.0).abs() < 0.02);
    }

    #[test]
    fn lobes_that_primaries_feed_are_counted() {
        // Five lobes about the base, which lies in a sinus.
        let angle = |i: usize| std::f64::consts::PI * (i as f64 / 500.0 - 0.5);
        let radius = |a: f64| 30.0 + 10.0 * libm::cos(a * 5.0 - 2.5 * std::f64::consts::PI);
        let at = |a: f64| radius(a) * DVec2::new(libm::cos(a), libm::sin(a));
        let mut points = vec![DVec2::ZERO];
        points.extend((20..=980).map(|i| at(angle(i))));
        let tip = |k: f64| at(std::f64::consts::FRAC_PI_2 + k * std::f64::consts::TAU / 5.0);
        let outline = Outline::new(points, DVec2::ZERO, at(angle(500))).expect("a good margin");
        let count = |ends: &[f64]| {
            let ends: Vec<DVec2> = ends.iter().map(|&k| tip(k) * 0.98).collect();
            projections(&outline, &veins(DVec2::ZERO, &ends)).lobes
        };
        assert_eq!(count(&[-2.0, -1.0, 0.0, 1.0, 2.0]), 5);
        assert_eq!(count(&[-1.0, 0.0, 1.0]), 3);
    }
}
