//! The search for an equilibrium.

use glam::DVec3;

use super::sheet::Sheet;

/// Longest way of a control point in one step, in cells.
const LONGEST: f64 = 2.0;
/// Damping at the start, as a share of bending stiffness over the area of a cell.
const DAMPING: f64 = 0.01;
/// Shares of a step that are tried.
const HALVINGS: u32 = 5;

/// When a search ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Most steps.
    pub(crate) steps: usize,
    /// Relative fall of the energy over a step below which it ends.
    pub(crate) tolerance: f64,
}

/// Moves control points from `from` towards a minimum of the sheet's energy; with the energies at
/// the start and the end.
///
/// Damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963): the matrix leaves out the negative
/// part of the stiffness, so every step leads downhill, also off the saddle on which a flat sheet
/// under compression stands.
pub(crate) fn relaxed(sheet: &Sheet, from: &[DVec3], effort: Effort) -> (Vec<DVec3>, [f64; 2]) {
    let mut x = from.to_vec();
    let mut slope = vec![DVec3::ZERO; x.len()];
    let mut matrix = sheet.matrix();
    let mut step = vec![0.0; 3 * sheet.points()];
    let h = sheet.spacing();
    let mut damping = DAMPING * sheet.typical_bend / (h * h);
    let least = 1e-4 * damping;
    let start = sheet.energy(&x);
    let mut energy = start;
    let mut lowest_fall = 0;
    for _ in 0..effort.steps {
        sheet.slope(&x, &mut slope);
        sheet.stiffness(&x, damping, &mut matrix);
        if !matrix.factor() {
            damping *= 10.0;
            continue;
        }
        for (part, slope) in step.chunks_exact_mut(3).zip(&slope) {
            part.copy_from_slice(&(-*slope).to_array());
        }
        matrix.solve(&mut step);
        let longest = step
            .chunks_exact(3)
            .map(|d| DVec3::from_slice(d).length())
            .fold(0.0, f64::max);
        let mut share = (LONGEST * h / longest.max(1e-300)).min(1.0);
        let mut found = None;
        for halving in 0..HALVINGS {
            let tried: Vec<DVec3> = x
                .iter()
                .zip(step.chunks_exact(3))
                .map(|(&x, d)| x + share * DVec3::from_slice(d))
                .collect();
            let there = sheet.energy(&tried);
            if there < energy {
                found = Some((tried, there, halving));
                break;
            }
            share *= 0.4;
        }
        let Some((next, there, halvings)) = found else {
            if longest < 1e-6 * h {
                break;
            }
            damping *= 8.0;
            continue;
        };
        match halvings {
            0 => damping = (0.3 * damping).max(least),
            1 => {}
            _ => damping *= 3.0,
        }
        let fall = energy - there;
        x = next;
        energy = there;
        // Relative to what has been gained so far, since weight has no zero.
        let gained = (start - energy).max(f64::MIN_POSITIVE);
        if fall < effort.tolerance * gained {
            lowest_fall += 1;
            if lowest_fall == 3 {
                break;
            }
        } else {
            lowest_fall = 0;
        }
    }
    (x, [start, energy])
}
