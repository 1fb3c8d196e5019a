//! Loops within loops (\[katifori2012\], \[ronellenfitsch2015\]).

use super::spanning::Sets;
use crate::venation::areole::{Areoles, OUTSIDE};

/// How loops are nested.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Nesting {
    /// Mean, over the inner nodes of the loop tree, of the areoles in the smaller branch over those
    /// in the larger; in (0, 1].
    pub(super) mean: Option<f64>,
    /// The same, weighted by the number of areoles below the node minus one.
    pub(super) weighted: Option<f64>,
    /// Strahler number of the loop tree: 0 without areoles, 1 for one.
    pub(super) strahler: u32,
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
        areoles[stays] = few + many;
        strahler[stays] = if strahler[stays] == strahler[goes] {
            strahler[stays] + 1
        } else {
            strahler[stays].max(strahler[goes])
        };
    }
    Nesting {
        mean: (inner > 0.0).then(|| ratios / inner),
        weighted: (weights > 0.0).then(|| weighted / weights),
        strahler: strahler.into_iter().max().unwrap_or(0),
    }
}
