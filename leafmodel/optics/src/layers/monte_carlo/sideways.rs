//! How far sideways light comes in layers.

use rayon::prelude::*;

use super::{BLOCK, Bins, Chance, Estimate, Face, Incidence, Stack, StackError, Walk};

/// How far from the place of its entry light leaves, in the unit of the thicknesses: mean squared
/// distances across the layers of what is sent back and of what is let through, weighted by what is
/// left of it. Light that is mirrored at the first face counts as sent back, at no distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Of what is sent back.
    pub reflected: Estimate,
    /// Of what is let through.
    pub transmitted: Estimate,
}

/// Follows photons, at least two, and tells how far sideways they come. `thickness` has an entry for
/// each layer.
///
/// # Errors
///
/// [`StackError::Direction`] if light falls in from a direction out of range.
///
/// # Panics
///
/// If there are not as many thicknesses as layers.
pub fn spread(
    stack: &Stack,
    thickness: &[f64],
    face: Face,
    incidence: Incidence,
    photons: u64,
    seed: u64,
) -> Result<Spread, StackError> {
    let incidence = incidence.checked()?;
    let mut layers = stack.layers().to_vec();
    assert_eq!(thickness.len(), layers.len(), "each layer has a thickness");
    let mut thickness = thickness.to_vec();
    if face == Face::Last {
        layers.reverse();
        thickness.reverse();
    }
    let walk = Walk {
        layers: &layers,
        thickness: Some(&thickness),
        incidence,
        bins: Bins::NONE,
    };
    // Sums of weights w, of w d², and of squares and products of both, for the error of a ratio.
    let blocks: Vec<[[f64; 5]; 2]> = (0..photons.max(2).div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let mut sums = [[0.0; 5]; 2];
            let mut tally = vec![0.0; walk.tallies()];
            for number in block * BLOCK..((block + 1) * BLOCK).min(photons.max(2)) {
                let mut beside = [0.0; 2];
                tally.fill(0.0);
                walk.photon_beside(&mut Chance::new(seed, number), &mut tally, &mut beside);
                let square = beside[0] * beside[0] + beside[1] * beside[1];
                for (sum, weight) in sums.iter_mut().zip(&tally) {
                    let far = weight * square;
                    let terms = [*weight, far, weight * weight, weight * far, far * far];
                    for (sum, term) in sum.iter_mut().zip(terms) {
                        *sum += term;
                    }
                }
            }
            sums
        })
        .collect();
    let mut total = [[0.0; 5]; 2];
    for block in &blocks {
        for (sum, more) in total.iter_mut().flatten().zip(block.iter().flatten()) {
            *sum += more;
        }
    }
    let [reflected, transmitted] = total.map(|[w, far, ww, wf, ff]| {
        let value = if w > 0.0 { far / w } else { 0.0 };
        // The variance of a ratio of sums, to first order.
        let variance = (ff - 2.0 * value * wf + value * value * ww).max(0.0);
        Estimate {
            value,
            standard_error: if w > 0.0 { variance.sqrt() / w } else { 0.0 },
        }
    });
    Ok(Spread {
        reflected,
        transmitted,
    })
}
