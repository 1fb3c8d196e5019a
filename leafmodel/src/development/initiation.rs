//! Where convergence points appear, and where their veins join those that are there.

use glam::DVec2;

use super::margin::{Interval, Margin};
use super::plan::{Sequence, Wave};
use super::skeleton::{NO_NODE, Skeleton, bowed, pieces};
use crate::plane::segment::cross;

/// How near to the base a convergence point may appear, over the distance from another one.
const BASE_CLEARANCE: f64 = 0.4;

/// Growth held back by this share makes a sinus, in which no convergence point appears.
const SINUS: f64 = 0.15;

/// It begins where growth is held back by this share of what it is at its deepest.
const RIM: f64 = 0.6;

/// Where on the margin a convergence point appears, as a distance from the base along it. Auxin and
/// CUC2, which marks sinuses, keep each other away (\[bilsborough2011\]): none appears at the bottom
/// of a sinus, but on its flanks.
pub(super) fn place_in(
    interval: Interval,
    margin: &Margin,
    distances: &[f64],
    apex: usize,
    wave: &Wave,
    spacing: f64,
) -> Option<f64> {
    let whole = distances[distances.len() - 1];
    // Along the interval's side, from the base.
    let height = |i: usize| {
        if interval.is_right {
            distances[i]
        } else {
            whole - distances[i]
        }
    };
    let [lower, upper] = interval.lower_and_upper();
    let is_base = lower == 0 || lower + 1 == distances.len();
    let least = height(lower) + spacing * if is_base { BASE_CLEARANCE } else { 1.0 };
    let most = height(upper) - spacing;
    let [from, to] = wave.zone.map(|share| share * height(apex));
    let (least, most) = (least.max(from), most.min(to));
    if least > most {
        return None;
    }
    let place = match wave.sequence {
        Sequence::Basipetal => most,
        Sequence::Acropetal => least,
        Sequence::Intercalary => 0.5 * (least + most),
    };
    let [first, last] = interval.ends;
    let restraint = |i: usize| margin.points[i].restraint;
    let deepest = (first..=last).map(restraint).fold(0.0, f64::max);
    // Below the lowest point there is no sinus.
    let place = if is_base || deepest < SINUS {
        place
    } else {
        let is_flank = |&i: &usize| restraint(i) <= RIM * deepest;
        let flanks = (first..=last).filter(is_flank).map(height);
        flanks
            .filter(|at| (least..=most).contains(at))
            .min_by(|a, b| (a - place).abs().total_cmp(&(b - place).abs()))?
    };
    Some(if interval.is_right {
        place
    } else {
        whole - place
    })
}

/// A vein that has found its way.
pub(super) struct Canal {
    /// The node that it springs from.
    pub(super) origin: u32,
    /// Its points, the last at the margin.
    pub(super) way: Vec<DVec2>,
    /// 1 if it leaves to the right of the vein it springs from, −1 if to the left.
    pub(super) side: f64,
    /// The angle at which it leaves, radians, ≥ 0.
    pub(super) angle: f64,
}

/// The cheapest way from a point of the margin to the base, through tissue to a vein of an earlier
/// wave and along veins from there; nothing if other veins or the margin stand in every way.
pub(super) fn canal(
    skeleton: &Skeleton,
    margin: &Margin,
    point: DVec2,
    (number, wave): (usize, &Wave),
    bow: f64,
) -> Option<Canal> {
    let along = skeleton.distances();
    let mut ways: Vec<(f64, u32)> = (0..)
        .zip(&skeleton.nodes)
        .filter(|&(i, node)| {
            let vein = &skeleton.veins[node.vein as usize];
            vein.tip != i && vein.wave != Some(number)
        })
        .map(|(i, node)| {
            let through = (node.place - point).length();
            (through + wave.transport * along[i as usize], i)
        })
        .collect();
    ways.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let meets_vein = |origin: DVec2| {
        skeleton.nodes.iter().any(|node| {
            node.before != NO_NODE
                && cross(
                    origin,
                    point,
                    skeleton.nodes[node.before as usize].place,
                    node.place,
                )
        })
    };
    // A little inside, where the margin's own pieces do not count.
    let is_open = |origin: DVec2| {
        let inside = point.lerp(origin, 1e-3);
        !margin.is_crossed_by(origin, inside) && !meets_vein(origin)
    };
    let &(_, origin) = ways
        .iter()
        .find(|(_, i)| is_open(skeleton.nodes[*i as usize].place))?;
    let from = skeleton.nodes[origin as usize];
    let parent = if from.before == NO_NODE {
        DVec2::Y
    } else {
        from.place - skeleton.nodes[from.before as usize].place
    };
    let chord = point - from.place;
    let side = if parent.perp_dot(chord) < 0.0 {
        1.0
    } else {
        -1.0
    };
    let angle =
        libm::acos((parent.dot(chord) / (parent.length() * chord.length())).clamp(-1.0, 1.0));
    let count = pieces(chord.length() / skeleton.length());
    let bent = bowed(from.place, point, bow * side, count);
    let stays_inside = bent[..bent.len() - 1]
        .windows(2)
        .all(|piece| !margin.is_crossed_by(piece[0], piece[1]));
    let way = if stays_inside {
        bent
    } else {
        bowed(from.place, point, 0.0, count)
    };
    Some(Canal {
        origin,
        way,
        side,
        angle,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::development::plan::Primordium;

    #[test]
    fn points_between_lobes_appear_on_the_flanks_of_the_sinus_and_not_at_its_bottom() {
        let mut margin = Margin::new(&Primordium::default(), 200, 0);
        for (tip, share) in [(1, 0.3), (2, 0.8)] {
            let distances = margin.distances();
            let apex = distances[margin.apex(0)];
            margin.split(&distances, share * apex, tip);
        }
        let distances = margin.distances();
        let apex = margin.apex(0);
        let is_between = |part: &Interval| {
            let tips = part.ends.map(|end| margin.points[end].tip);
            tips == [1, 2]
        };
        let found = margin.intervals(0).into_iter().find(is_between);
        let interval = found.expect("it lies on the right");
        let wave = Wave {
            sequence: Sequence::Intercalary,
            zone: [0.0, 1.0],
            ..Wave::default()
        };
        let spacing = 0.06 * distances[apex];
        let place = |margin: &Margin| {
            let place = place_in(interval, margin, &distances, apex, &wave, spacing);
            place.expect("there is room")
        };
        let [from, to] = interval.ends.map(|end| distances[end]);
        let middle = 0.5 * (from + to);
        assert!((place(&margin) - middle).abs() < 1e-9, "an entire margin");
        let mut lobed = margin.clone();
        lobed.restrain(interval, 0, &wave, 0.35);
        let at = place(&lobed);
        let nearest = (interval.ends[0]..=interval.ends[1]).min_by(|&i, &j| {
            (distances[i] - at)
                .abs()
                .total_cmp(&(distances[j] - at).abs())
        });
        let restraint = lobed.points[nearest.expect("it has points")].restraint;
        assert!(restraint <= 0.35 * RIM, "{restraint} is held back there");
        assert!(
            (at - middle).abs() > 0.1 * (to - from),
            "{at} is near {middle}"
        );
        // Slight indentations between teeth are no sinuses.
        let mut toothed = margin.clone();
        toothed.restrain(interval, 0, &wave, 0.1);
        assert!((place(&toothed) - middle).abs() < 1e-9);
    }
}
