//! The test of Mann and Whitney.

use serde::Serialize;

use super::noncentral::normal;

/// Values of both groups up to which all orders are counted: counts are then whole numbers below
/// 2⁵³, so that no sum rounds.
const COUNTED: usize = 50;

/// The test of Mann and Whitney, also called Wilcoxon's rank-sum test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ranks {
    /// Pairs in which the value of the second group is the larger one; a tie is half a pair.
    pub u: f64,
    /// Two-sided p, in [0, 1].
    #[serde(skip)]
    pub p: f64,
    /// Whether all orders were counted; otherwise p is that of a normal distribution.
    pub exact: bool,
}

/// Do values of one group tend to be larger than those of the other?
///
/// Up to 50 values in all, p is twice the share of all divisions of the values found into two
/// groups of these sizes whose `u` is as far out on its side, ties and all; at most 1. For more
/// values the normal distribution is taken, with corrections for ties and for continuity. `None`
/// if a group is empty.
///
/// # Source
///
/// \[mann1947\].
pub fn mann_whitney(first: &[f64], second: &[f64]) -> Option<Ranks> {
    if first.is_empty() || second.is_empty() {
        return None;
    }
    let (ranks, ties) = doubled_ranks(first, second);
    let [a, b] = [first.len() as f64, second.len() as f64];
    // Twice the sum of ranks of the second group.
    let sum: u64 = ranks[first.len()..].iter().sum();
    let u = 0.5 * sum as f64 - 0.5 * b * (b + 1.0);
    if ranks.len() <= COUNTED {
        let [below, above] = counted(&ranks, second.len(), sum as usize);
        let p = (2.0 * below.min(above)).min(1.0);
        return Some(Ranks { u, p, exact: true });
    }
    let all = a + b;
    let variance = a * b / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
    let off = ((u - 0.5 * a * b).abs() - 0.5).max(0.0);
    let p = if variance > 0.0 {
        (2.0 * normal(-off / variance.sqrt())).min(1.0)
    } else {
        1.0
    };
    let exact = false;
    Some(Ranks { u, p, exact })
}

/// The smallest p that [`mann_whitney`] can give for groups of these sizes without ties: 2 over the
/// number of divisions. With 3 and 3 leaves it is 0.1.
pub fn smallest_p(first: usize, second: usize) -> f64 {
    let (few, all) = (first.min(second), first + second);
    let divisions: f64 = (1..=few)
        .map(|i| (all - few + i) as f64 / i as f64)
        .product();
    (2.0 / divisions).min(1.0)
}

/// Twice the rank of each value, ties sharing theirs; and `Σ (t³ − t)` over ties of `t` values.
fn doubled_ranks(first: &[f64], second: &[f64]) -> (Vec<u64>, f64) {
    let all: Vec<f64> = first
        .iter()
        .chain(second)
        .map(|value| value + 0.0)
        .collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|a, b| all[*a].total_cmp(&all[*b]));
    let mut ranks = vec![0; all.len()];
    let (mut ties, mut before) = (0.0, 0);
    for tied in order.chunk_by(|a, b| all[*a] == all[*b]) {
        let count = tied.len() as u64;
        for &place in tied {
            ranks[place] = 2 * before + count + 1;
        }
        before += count;
        let size = count as f64;
        ties += size * size * size - size;
    }
    (ranks, ties)
}

/// Shares of all ways to choose `count` of these numbers whose sum is at most, and at least, `sum`.
fn counted(numbers: &[u64], count: usize, sum: usize) -> [f64; 2] {
    let most: usize = numbers.iter().map(|number| *number as usize).sum();
    // ways[n][s]: how many choices of n numbers have the sum s.
    let mut ways = vec![vec![0.0_f64; most + 1]; count + 1];
    ways[0][0] = 1.0;
    for &number in numbers {
        let number = number as usize;
        for chosen in (1..=count).rev() {
            let (fewer, more) = ways.split_at_mut(chosen);
            let from = &fewer[chosen - 1];
            for (way, from) in more[0][number..].iter_mut().zip(from) {
                *way += from;
            }
        }
    }
    let all: f64 = ways[count].iter().sum();
    let below: f64 = ways[count][..=sum].iter().sum();
    let above: f64 = ways[count][sum..].iter().sum();
    [below / all, above / all]
}

#[cfg(test)]
mod tests {
    use super::*;

    // Two groups, u, and p of scipy.stats.permutation_test((a, b), u, permutation_type='independent',
    // n_resamples=inf), which tries all divisions; SciPy 1.17.1.
    const RANKED: [(&[f64], &[f64], f64, f64); 4] = [
        (
            &[1.0, 2.0, 5.0, 7.0],
            &[3.0, 4.0, 6.0, 8.0, 9.0],
            15.0,
            0.2857142857142857,
        ),
        (
            &[1.0, 2.0, 2.0, 3.0, 5.0],
            &[2.0, 3.0, 3.0, 6.0],
            14.0,
            0.4126984126984127,
        ),
        (
            &[5.0, 5.0, 5.0],
            &[5.0, 6.0, 7.0, 7.0],
            10.5,
            0.22857142857142856,
        ),
        (
            &[0.3, 0.1, 0.7, 0.9, 0.2, 0.8],
            &[1.1, 0.4, 1.3, 0.5],
            18.0,
            0.2571428571428571,
        ),
    ];

    // Values of each ladder, the raise, u and p of scipy.stats.mannwhitneyu(method='asymptotic').
    const LADDERS: [(usize, usize, f64, f64); 3] = [
        (40, 1, 920.5, 0.24694899467800258),
        (60, 3, 2568.0, 5.3943801799299015e-05),
        (45, 5, 1644.0, 3.347617300960518e-07),
    ];

    #[test]
    fn permeabilities_come_out_as_published() {
        // Constants of water's diffusion at term and at 12 to 26 weeks (Hollander and Wolfe 1973,
        // p. 69), the example in R's manual: W = 35, one-sided p = 0.1272.
        let term = [0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46];
        let early = [1.15, 0.88, 0.90, 0.74, 1.21];
        let found = mann_whitney(&early, &term).expect("values");
        assert_eq!((found.u, found.exact), (35.0, true));
        assert!((0.5 * found.p - 0.1272).abs() < 5e-5, "{found:?}");
    }

    #[test]
    fn small_and_tied_samples_are_those_of_scipy() {
        for (first, second, u, p) in RANKED {
            let found = mann_whitney(first, second).expect("values");
            assert_eq!(found.u, u, "{first:?} {second:?}");
            assert!((found.p - p).abs() < 1e-12, "{found:?} is not {p}");
        }
    }

    #[test]
    fn the_normal_distribution_takes_over_where_counting_ends() {
        // Two equal ladders, one of them raised by 3 steps; ties throughout.
        let ladder = |count: usize, by: usize| -> Vec<f64> {
            (0..count)
                .map(|i| ((i * 7 + by) % 13 + by) as f64)
                .collect()
        };
        for (count, by, u, p) in LADDERS {
            let found = mann_whitney(&ladder(count, 0), &ladder(count, by)).expect("values");
            assert_eq!((found.u, found.exact), (u, false));
            assert!((found.p / p - 1.0).abs() < 1e-9, "{found:?} is not {p}");
        }
        assert_eq!(
            mann_whitney(&[1.0; 40], &[1.0; 40]).map(|found| found.p),
            Some(1.0)
        );
    }

    #[test]
    fn p_has_a_floor_that_is_reported() {
        assert_eq!(smallest_p(3, 3), 0.1);
        assert_eq!(smallest_p(1, 1), 1.0);
        let far = mann_whitney(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0, 7.0]).expect("values");
        assert!((far.p - smallest_p(3, 4)).abs() < 1e-15, "{far:?}");
        assert_eq!(far.u, 12.0);
        assert_eq!(mann_whitney(&[], &[1.0]), None);
    }
}
