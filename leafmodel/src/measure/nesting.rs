//! Loops within loops (\[katifori2012\], \[ronellenfitsch2015\]).

use crate::numeric::Sets;
use crate::venation::areole::{Areoles, OUTSIDE};

/// How loops are nested.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Nesting {
    /// Mean, over the inner nodes of the loop tree, of the areoles in the smaller branch over those
    /// in the larger; in (0, 1].
    pub(super) mean: Option<f64>,
    /// The same, weighted by the number of areoles below the node minus one.
    pub(super) weighted: Option<f64>,
    /// Strahler number of the loop tree: 0 without areoles, 1 for one.
    pub(super) strahler: u32,
    /// Mean, over the inner nodes with three areoles or more, of `|r − s| / (r + s − 2)` for `r` and
    /// `s` areoles in the two branches (\[vanpelt1992\]): 0 for halves, 1 where one areole after another
    /// is added.
    pub(super) asymmetry: Option<f64>,
    /// Greatest number of inner nodes on a way from the root of a tree to a leaf.
    pub(super) depth: u32,
    /// The inner nodes, from the first vein removed to the last.
    pub(super) merges: Vec<Merge>,
}

/// Two loops that become one: an inner node of the tree of loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merge {
    /// The nodes that become one: areoles by their numbers, then merges in turn.
    pub branches: [u32; 2],
    /// Number of areoles below.
    pub areoles: u32,
    /// Mean radius of the vein that parted them, mm.
    pub radius_mm: f64,
    /// Strahler number.
    pub strahler: u32,
}

/// Removes veins, finest first, and records which loops merge.
///
/// Veins are removed from junction to junction, in the order of their mean radius, equal ones in
/// the order of their numbers. Veins towards the outside stay, so groups of areoles that share no
/// vein have separate trees; all trees are counted together.
pub(super) fn nesting(found: &Areoles) -> Nesting {
    let chains = found.chains();
    let mut order: Vec<(u64, u32)> = (0..chains.len() as u32)
        .filter(|&chain| {
            let [left, right] = found.beside(chain);
            left != right && left != OUTSIDE && right != OUTSIDE
        })
        // Radii are above 0, so their bits are in the order of their values.
        .map(|chain| (chains.radii[chain as usize].to_bits(), chain))
        .collect();
    order.sort_unstable();
    let mut loops = Sets::new(found.len());
    let mut areoles = vec![1_u32; found.len()];
    let mut strahler = vec![1_u32; found.len()];
    let (mut ratios, mut weighted, mut weights, mut inner) = (0.0, 0.0, 0.0, 0.0);
    let (mut skew, mut skewed) = (0.0, 0.0);
    let mut depth = vec![0_u32; found.len()];
    let mut node: Vec<u32> = (0..found.len() as u32).collect();
    let mut merges = Vec::new();
    for (_, chain) in order {
        let [left, right] = found.beside(chain);
        let Some((stays, goes)) = loops.join(left, right) else {
            continue; // It ended freely inside a loop by then.
        };
        let (stays, goes) = (stays as usize, goes as usize);
        let (few, many) = (
            areoles[stays].min(areoles[goes]),
            areoles[stays].max(areoles[goes]),
        );
        let ratio = f64::from(few) / f64::from(many);
        let weight = f64::from(few + many) - 1.0;
        ratios += ratio;
        inner += 1.0;
        weighted += weight * ratio;
        weights += weight;
        if few + many > 2 {
            skew += f64::from(many - few) / f64::from(few + many - 2);
            skewed += 1.0;
        }
        areoles[stays] = few + many;
        depth[stays] = 1 + depth[stays].max(depth[goes]);
        strahler[stays] = if strahler[stays] == strahler[goes] {
            strahler[stays] + 1
        } else {
            strahler[stays].max(strahler[goes])
        };
        let branches = [node[stays], node[goes]];
        node[stays] = (found.len() + merges.len()) as u32;
        merges.push(Merge {
            branches,
            areoles: few + many,
            radius_mm: chains.radii[chain as usize],
            strahler: strahler[stays],
        });
    }
    Nesting {
        mean: (inner > 0.0).then(|| ratios / inner),
        weighted: (weights > 0.0).then(|| weighted / weights),
        strahler: strahler.into_iter().max().unwrap_or(0),
        asymmetry: (skewed > 0.0).then(|| skew / skewed),
        depth: depth.into_iter().max().unwrap_or(0),
        merges,
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::venation::areole::areoles;
    use crate::venation::testing::wide;

    /// A row of squares whose walls have these radii.
    fn row(walls: &[f64]) -> Nesting {
        let mut places = Vec::new();
        let mut edges = Vec::new();
        for column in 0..walls.len() as u32 + 2 {
            let (low, high) = (2 * column, 2 * column + 1);
            places.extend([0.0, 1.0].map(|y| DVec2::new(f64::from(column), y)));
            let inner = column
                .checked_sub(1)
                .and_then(|wall| walls.get(wall as usize));
            edges.push((low, high, inner.copied().unwrap_or(9.0), 1));
            if column > 0 {
                edges.extend([(low - 2, low, 9.0, 1), (high - 2, high, 9.0, 1)]);
            }
        }
        nesting(&areoles(&wide(&places, &edges)))
    }

    #[test]
    fn halves_are_even_and_a_chain_is_as_uneven_as_can_be() {
        // Seven walls between eight squares.
        let halves = row(&[1.0, 2.0, 1.1, 3.0, 1.2, 2.1, 1.3]);
        assert_eq!(
            (halves.asymmetry, halves.depth, halves.strahler),
            (Some(0.0), 3, 4)
        );
        assert_eq!(halves.mean, Some(1.0));
        let chain = row(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(
            (chain.asymmetry, chain.depth, chain.strahler),
            (Some(1.0), 7, 2)
        );
        // 1/1, 1/2 … 1/7.
        let harmonic: f64 = (1..=7).map(|n| 1.0 / f64::from(n)).sum();
        assert!((chain.mean.expect("merges") - harmonic / 7.0).abs() < 1e-15);
        assert_eq!(chain.merges.len(), 7);
        assert_eq!(chain.merges[6].areoles, 8);
        assert_eq!(chain.merges[6].radius_mm, 7.0);
        // Each node but the root is a branch of one other.
        let mut below: Vec<u32> = chain
            .merges
            .iter()
            .flat_map(|merge| merge.branches)
            .collect();
        below.sort_unstable();
        assert_eq!(below, (0..14).collect::<Vec<u32>>());
    }
}
