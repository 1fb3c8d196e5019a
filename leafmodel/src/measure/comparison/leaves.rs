//! Distributions of groups of leaves, tested with the leaf as the unit.

use rayon::prelude::*;
use serde::Serialize;

use super::ranks::smallest_p;
use crate::measure::statistics::quantile;
use crate::random::{Use, below, bits};

/// Places at which cumulative curves are compared.
const PLACES: usize = 255;
/// Divisions up to which all are tried; beyond, so many are drawn.
const TRIED: f64 = 20_000.0;
/// How many are drawn, and the division found.
const DRAWN: u64 = 9_999;
/// Distances that differ by less are the same but for rounding.
const SAME: f64 = 1e-12;

/// The distance of two groups of leaves, and how often chance makes as large a one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Permuted {
    /// Greatest distance of the mean cumulative curves of both groups at the places of comparison,
    /// 0 to 1.
    pub distance: f64,
    /// Share of the divisions of all leaves into two groups of these sizes that are as far apart;
    /// `None` if a group has fewer than two leaves.
    #[serde(skip)]
    pub p: Option<f64>,
    /// Whether all divisions were tried; otherwise 9,999 were drawn.
    pub exact: bool,
    /// The smallest p that groups of these sizes can have.
    #[serde(rename = "smallest_p")]
    pub smallest: f64,
}

/// Do leaves of two groups have the same distribution of values? Values of each leaf must ascend;
/// leaves without values are left out.
///
/// The mean cumulative curve of a group counts each of its leaves once, however many values it has.
/// Curves are compared at 255 places, quantiles of all values with leaves of equal weight. Leaves as
/// a whole change groups, so that values within a leaf may depend on each other in any way. `None`
/// if a group has no leaf with values. One seed gives one result.
///
/// # Source
///
/// A permutation test (\[edgington2007\]) with the distance of Kolmogorov and Smirnov.
pub fn permuted_leaves(first: &[&[f64]], second: &[&[f64]], seed: u64) -> Option<Permuted> {
    let kept = |leaves: &[&'_ [f64]]| leaves.iter().filter(|leaf| !leaf.is_empty()).count();
    let [m, n] = [kept(first), kept(second)];
    if m == 0 || n == 0 {
        return None;
    }
    let leaves: Vec<&[f64]> = first.iter().chain(second).copied().collect();
    let leaves: Vec<&[f64]> = leaves.into_iter().filter(|leaf| !leaf.is_empty()).collect();
    let curves = curves(&leaves);
    let apart = |members: &[usize]| distance(&curves, members, leaves.len());
    let found: Vec<usize> = (0..m).collect();
    let distance = apart(&found);
    let is_far = |members: &[usize]| apart(members) >= distance - SAME;
    // With groups of one size each division has a mirror image that is as far apart.
    let share = if m == n { 1.0 } else { 0.5 };
    let smallest = share * smallest_p(m, n);
    let exact = 2.0 / smallest_p(m, n) <= TRIED;
    let p = (m > 1 && n > 1).then(|| {
        if exact {
            let all = divisions(m, leaves.len());
            let far = all.par_iter().filter(|members| is_far(members)).count();
            far as f64 / all.len() as f64
        } else {
            let drawn = |draw: u64| is_far(&drawn(seed, draw, m, leaves.len()));
            let far = (0..DRAWN)
                .into_par_iter()
                .filter(|draw| drawn(*draw))
                .count();
            (far + 1) as f64 / (DRAWN + 1) as f64
        }
    });
    Some(Permuted {
        distance,
        p,
        exact,
        smallest: if exact {
            smallest
        } else {
            1.0 / (DRAWN + 1) as f64
        },
    })
}

/// The cumulative curve of each leaf at the places of comparison.
fn curves(leaves: &[&[f64]]) -> Vec<Vec<f64>> {
    // As many quantiles of each leaf: then leaves weigh the same.
    let share = |i: usize| (i + 1) as f64 / (PLACES + 1) as f64;
    let of_leaf = |leaf: &&[f64]| {
        let mut values = leaf.to_vec();
        let quantiles = (0..PLACES).filter_map(|i| quantile(&mut values, share(i)));
        quantiles.collect::<Vec<f64>>()
    };
    let mut pooled: Vec<f64> = leaves.iter().flat_map(of_leaf).collect();
    let places: Vec<f64> = (0..PLACES)
        .filter_map(|i| quantile(&mut pooled, share(i)))
        .collect();
    let curve = |leaf: &&[f64]| {
        let below = |place: &f64| leaf.partition_point(|value| value <= place);
        let count = leaf.len() as f64;
        places
            .iter()
            .map(|place| below(place) as f64 / count)
            .collect()
    };
    leaves.iter().map(curve).collect()
}

/// Greatest distance of the mean curve of these leaves from that of all others.
fn distance(curves: &[Vec<f64>], members: &[usize], all: usize) -> f64 {
    let [m, n] = [members.len() as f64, (all - members.len()) as f64];
    let apart = (0..PLACES).map(|place| {
        let inside: f64 = members.iter().map(|leaf| curves[*leaf][place]).sum();
        let total: f64 = curves.iter().map(|curve| curve[place]).sum();
        (inside / m - (total - inside) / n).abs()
    });
    apart.fold(0.0, f64::max)
}

/// All ways to choose `count` of the numbers below `all`.
fn divisions(count: usize, all: usize) -> Vec<Vec<usize>> {
    let mut chosen: Vec<usize> = (0..count).collect();
    let mut found = vec![chosen.clone()];
    // The last number that can still rise does so, and those behind it follow.
    while let Some(rising) = (0..count).rev().find(|&i| chosen[i] < all - count + i) {
        chosen[rising] += 1;
        for i in rising + 1..count {
            chosen[i] = chosen[i - 1] + 1;
        }
        found.push(chosen.clone());
    }
    found
}

/// A random choice of `count` of the numbers below `all`.
fn drawn(seed: u64, draw: u64, count: usize, all: usize) -> Vec<usize> {
    let mut places: Vec<usize> = (0..all).collect();
    for i in 0..count {
        let counter = draw.wrapping_mul(all as u64).wrapping_add(i as u64);
        let random = bits(seed, Use::Permutation, counter);
        places.swap(i, i + below(random, all - i));
    }
    places.truncate(count);
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use properties::uniform;

    /// Leaves of 40 values that share a shift of their own, which may be large.
    fn leaves(number: u64, count: u64, shift: f64, own: f64) -> Vec<Vec<f64>> {
        let leaf = |leaf: u64| {
            let at = |i: u64| uniform(number, 91 + leaf, i);
            let base = shift + own * at(1000);
            let mut values: Vec<f64> = (0..40).map(|i| base + at(i)).collect();
            values.sort_unstable_by(f64::total_cmp);
            values
        };
        (0..count).map(leaf).collect()
    }

    fn tested(first: &[Vec<f64>], second: &[Vec<f64>]) -> Permuted {
        let slices = |leaves: &[Vec<f64>]| -> Vec<&'static [f64]> {
            let leak = |leaf: &Vec<f64>| &*Vec::leak(leaf.clone());
            leaves.iter().map(leak).collect()
        };
        permuted_leaves(&slices(first), &slices(second), 1).expect("leaves")
    }

    #[test]
    fn groups_of_leaves_far_apart_have_the_smallest_p() {
        let found = tested(&leaves(1, 4, 0.0, 0.1), &leaves(2, 5, 3.0, 0.1));
        // Not 1: none of the 255 places needs to lie in the gap.
        assert!(found.distance > 0.99 && found.exact, "{found:?}");
        // Only the division found is so far apart; its mirror image has other sizes.
        assert_eq!(found.p, Some(1.0 / 126.0));
        assert!((found.smallest - 1.0 / 126.0).abs() < 1e-15, "{found:?}");
        let few = tested(&leaves(1, 1, 0.0, 0.1), &leaves(2, 5, 3.0, 0.1));
        assert_eq!(few.p, None);
        assert_eq!(permuted_leaves(&[&[]], &[&[1.0]], 1), None);
    }

    #[test]
    fn leaves_of_one_kind_are_distinguished_as_often_as_promised_although_values_within_them_agree()
    {
        // Ten leaves in two groups, each with a shift of its own as large as the spread within.
        let (mut leafwise, mut pooled) = (0, 0);
        for number in 0..400_u64 {
            let [a, b] = [
                leaves(2 * number, 5, 0.0, 1.0),
                leaves(2 * number + 1, 5, 0.0, 1.0),
            ];
            let found = tested(&a, &b);
            leafwise += usize::from(found.p.is_some_and(|p| p <= 0.05));
            let pool = |leaves: Vec<Vec<f64>>| {
                let mut all = leaves.concat();
                all.sort_unstable_by(f64::total_cmp);
                all
            };
            let steps = super::super::kolmogorov_smirnov(&pool(a), &pool(b)).expect("values");
            pooled += usize::from(steps.p <= 0.05);
        }
        // Binomial with p = 0.05: 20 ± 4.4 of 400.
        assert!((6..=34).contains(&leafwise), "{leafwise} of 400");
        // The pooled test takes 200 values of 5 leaves for 200 leaves.
        assert!(pooled > 200, "{pooled} of 400");
    }

    #[test]
    fn drawn_divisions_agree_with_all_of_them() {
        let [a, b] = [leaves(5, 8, 0.0, 1.0), leaves(6, 9, 0.3, 1.0)];
        let drawn = tested(&a, &b);
        assert!(!drawn.exact);
        let slices: Vec<&[f64]> = a.iter().chain(&b).map(Vec::as_slice).collect();
        let curves = curves(&slices);
        let all = divisions(8, 17);
        assert_eq!(all.len(), 24310);
        let far = all
            .iter()
            .filter(|members| distance(&curves, members, 17) >= drawn.distance - SAME)
            .count();
        let exact = far as f64 / all.len() as f64;
        // Standard deviation of a share of 9,999 draws.
        let error = (exact * (1.0 - exact) / 9_999.0).sqrt();
        let p = drawn.p.expect("leaves");
        assert!((p - exact).abs() < 4.0 * error + 2e-4, "{p} is not {exact}");
    }
}
