//! Which tooth or lobe each vein runs into.

use glam::DVec2;

use super::margin::Tip;

/// How much a tip that stands out as far as any counts against one at just the right place, in
/// squares of the spacing.
const PROMINENCE: f64 = 3.0;

/// What a tip costs that lies `away` from where it should, in spacings; great ones are preferred.
pub(crate) fn tip_cost(away: f64, tip: &Tip, highest: f64) -> f64 {
    away * away - PROMINENCE * tip.height / highest
}

/// A direction turned by `angle` to the right (side 1) or to the left (−1).
pub(crate) fn aside(ahead: DVec2, angle: f64, side: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle);
    DVec2::new(cos, -side * sin).rotate(ahead)
}

/// For each of `n` veins, in order, one of `m` tips; all different and in the same order, at the
/// least cost together. None if there are too few tips.
pub(crate) fn assign(n: usize, m: usize, cost: impl Fn(usize, usize) -> f64) -> Option<Vec<usize>> {
    if n > m {
        return None;
    }
    if n == 0 {
        return Some(Vec::new());
    }
    // best[i][t]: the first i + 1 served, the last of them by tip t.
    let mut best = vec![vec![f64::INFINITY; m]; n];
    let mut from = vec![vec![0; m]; n];
    for (t, best) in best[0].iter_mut().enumerate() {
        *best = cost(0, t);
    }
    for i in 1..n {
        let (mut least, mut at) = (f64::INFINITY, 0);
        for t in i..m {
            if best[i - 1][t - 1] < least {
                (least, at) = (best[i - 1][t - 1], t - 1);
            }
            best[i][t] = least + cost(i, t);
            from[i][t] = at;
        }
    }
    let mut tip = (n - 1..m).min_by(|&a, &b| best[n - 1][a].total_cmp(&best[n - 1][b]))?;
    let mut chosen = vec![tip; n];
    for i in (1..n).rev() {
        tip = from[i][tip];
        chosen[i - 1] = tip;
    }
    Some(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tips(places: &[(f64, f64)]) -> Vec<Tip> {
        let tip = |&(at, height): &(f64, f64)| Tip {
            place: DVec2::ZERO,
            at,
            height,
        };
        places.iter().map(tip).collect()
    }

    #[test]
    fn veins_run_into_the_nearest_tips_and_rather_into_great_ones() {
        let tips = tips(&[
            (0.1, 1.0),
            (0.18, 0.1),
            (0.22, 1.0),
            (0.3, 0.1),
            (0.33, 1.0),
        ]);
        let chosen = |wanted: &[f64]| {
            assign(wanted.len(), tips.len(), |i, t| {
                tip_cost((tips[t].at - wanted[i]) / 0.1, &tips[t], 1.0)
            })
        };
        assert_eq!(chosen(&[0.1, 0.2, 0.31]), Some(vec![0, 2, 4]));
        // Two want the same one: the other takes the next great one.
        assert_eq!(chosen(&[0.1, 0.1]), Some(vec![0, 2]));
        assert_eq!(chosen(&[0.1; 6]), None);
    }

    #[test]
    fn right_is_where_x_grows_on_a_leaf_that_points_up() {
        let right = aside(DVec2::Y, 30.0_f64.to_radians(), 1.0);
        assert!(right.x > 0.49 && right.y > 0.86, "{right}");
    }
}
