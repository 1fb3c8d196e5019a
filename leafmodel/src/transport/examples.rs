//! The examples of \[xia2007\] as plans.

use super::plan::{Ladder, TransportPlan};

/// The plan of Example 1 to 5; `None` for other numbers.
///
/// The paper prints all parameters of Examples 1 and 2. It prints none of Examples 3 (maple-like)
/// and 4 (mulberry-like); these were found by a search, and `docs/src/theory/transport-leaf.md`
/// compares the outcome with the paper's. Example 5 is a sweep over `α` at one `β`. This is one of
/// its members; the others are the same plan with another `alpha`.
pub fn example(number: usize) -> Option<TransportPlan> {
    let plan = |[alpha, beta, epsilon]: [f64; 3], steps| TransportPlan {
        alpha,
        beta,
        epsilon,
        ladder: Ladder::Equal(steps),
        ..TransportPlan::default()
    };
    match number {
        1 => Some(plan([0.6, 0.5, 5.0], 80)),
        2 => Some(plan([0.5, 0.8, 5.0], 80)),
        3 => Some(plan([0.64, 0.15, 6.0], 40)),
        4 => Some(plan([0.64, 0.5, 6.375], 20)),
        5 => Some(plan([0.65, 0.5, 5.0], 80)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::leaf::TransportLeaf;
    use super::*;

    fn grown(number: usize) -> TransportLeaf {
        let plan = example(number).expect("there is one");
        plan.grow(1).expect("a good plan")
    }

    /// Columns and rows of the smallest rectangle of cells around a leaf.
    fn size(leaf: &TransportLeaf) -> (f64, f64) {
        let extent = |along: fn(&super::super::Cell) -> i32| {
            let places = leaf.cells().iter().map(along);
            let low = places.clone().min().unwrap_or(0);
            f64::from(places.max().unwrap_or(0) - low + 1)
        };
        (extent(|cell| cell.m), extent(|cell| cell.n))
    }

    /// Prominence of each lobe as a share of the leaf's length, the largest first: from the tip, a
    /// local maximum of the distance from the root, back to the deeper sinus on the way to a lobe
    /// that reaches farther.
    fn lobes(leaf: &TransportLeaf) -> Vec<f64> {
        let outline = leaf.outline(1.0).expect("a margin");
        let (low, high) = outline.bounds();
        let far: Vec<f64> = outline
            .points()
            .iter()
            .map(|p| p.length() / (high.y - low.y))
            .collect();
        let count = far.len();
        let sinus = |tip: usize, step: usize| {
            let way = (1..count).map(|i| far[(tip + i * step) % count]);
            let nearer = way.take_while(|&d| d <= far[tip]);
            nearer.fold(far[tip], f64::min)
        };
        let mut lobes: Vec<f64> = (0..count)
            .filter(|&i| far[i] > far[(i + count - 1) % count] && far[i] >= far[(i + 1) % count])
            .map(|i| far[i] - sinus(i, 1).max(sinus(i, count - 1)))
            .collect();
        lobes.sort_by(|a, b| b.total_cmp(a));
        lobes
    }

    #[test]
    fn example_1_is_as_large_as_an_independent_program_had_it() {
        let leaf = grown(1);
        let count = leaf.cells().len() as f64;
        // An independent program gave 562 cells in 25 columns and 33 rows, and between 540 and 556
        // with finer and coarser steps.
        assert!((count / 562.0 - 1.0).abs() < 0.04, "{count}");
        assert_eq!(size(&leaf), (25.0, 33.0));
    }

    #[test]
    fn example_3_has_five_large_lobes_two_small_ones_and_mere_teeth_besides() {
        let lobes = lobes(&grown(3));
        assert!(lobes[4] > 0.07 && lobes[5] < 0.6 * lobes[4], "{lobes:.3?}");
        assert!(lobes[6] > 0.04 && lobes[7] < 0.5 * lobes[6], "{lobes:.3?}");
    }

    #[test]
    fn example_4_has_the_proportions_of_the_generated_leaf_of_figure_4() {
        let leaf = grown(4);
        let (width, length) = size(&leaf);
        let midrib = leaf.midrib();
        let tip = leaf.cells()[midrib[midrib.len() - 1]];
        // Share of the paper's figures (cm, of a leaf 4.5 cm long) by which ours may differ.
        let near = |ours: f64, paper: f64, share: f64| {
            assert!((ours / paper - 1.0).abs() < share, "{ours} for {paper}");
        };
        let cm = 4.5 / length;
        near(width * cm, 3.2, 0.03);
        near(leaf.cells().len() as f64 * cm * cm, 11.0, 0.03);
        near((f64::from(tip.n) + 1.0) * cm, 4.2, 0.06);
        let veins = leaf.secondaries();
        let right: Vec<f64> = veins
            .iter()
            .filter(|vein| vein.tip.m > 0)
            .map(|vein| vein.length * cm)
            .collect();
        assert_eq!((veins.len(), right.len()), (10, 5));
        let ratios = right.windows(2).map(|pair| pair[0] / pair[1]);
        near(ratios.sum::<f64>() / 4.0, 1.26, 0.03);
        for (ours, paper) in right.into_iter().zip([2.2, 2.0, 1.7, 1.2, 0.9]) {
            near(ours, paper, 0.32);
        }
    }
}
