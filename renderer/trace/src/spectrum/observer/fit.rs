//! From a camera's raw channels to linear sRGB.
//!
//! No matrix does that exactly: a camera whose sensitivities are no linear combinations of the CIE's
//! sees other metamers. The matrix is the one that comes closest for the reflectances of 190 measured
//! surfaces under D65 and leaves white as it is: for each channel of sRGB least squares, of which the
//! sum of the row is 1.
//!
//! # Source
//!
//! \[finlayson1997\]; `docs/src/theory/spectra.md` derives it.

use std::sync::OnceLock;

use crate::spectrum::cie;
use crate::spectrum::delta_e::{ciede2000, lab};
use crate::spectrum::table::parse_shipped;

/// A matrix and what it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Linear sRGB of raw channels that are 1 for white, row by row; each row has the sum 1.
    pub matrix: [[f64; 3]; 3],
    /// Mean CIEDE2000 between the camera's and the CIE's colours of the training set under D65.
    pub mean: f64,
    /// The greatest.
    pub greatest: f64,
}

/// Number of surfaces of the training set.
const SURFACES: usize = 190;

/// Reflectances of the training set, nm.
fn training() -> &'static [(f64, [f64; SURFACES])] {
    static TABLE: OnceLock<Vec<(f64, [f64; SURFACES])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("../cameras/training.csv")))
}

/// Reflectances of the training set at a wavelength in nm; the end values hold outside of its
/// 380 to 780 nm.
pub fn reflectances(nm: f64) -> [f64; SURFACES] {
    let table = training();
    let step = table[1].0 - table[0].0;
    let place = ((nm - table[0].0) / step).clamp(0.0, (table.len() - 1) as f64);
    let below = (place as usize).min(table.len() - 2);
    let share = place - below as f64;
    let (low, high) = (&table[below].1, &table[below + 1].1);
    std::array::from_fn(|i| low[i] * (1.0 - share) + high[i] * share)
}

/// Wavelengths over which raw channels and colours are added up, nm, by steps of 1 nm.
const RANGE_NM: [u32; 2] = [300, 2500];

/// Determinant of the normal equations, as a share of the product of their diagonal, below which two
/// channels are one.
const LEAST_DETERMINANT: f64 = 1e-9;

impl Fit {
    /// The matrix of raw channels that are a function of the wavelength in nm and see D65 of Y = 1
    /// as 1 each; `None` if they are proportional to each other.
    pub(super) fn new(raw: impl Fn(f64) -> [f64; 3]) -> Option<Self> {
        let (mut seen, mut xyz) = (vec![[0.0; 3]; SURFACES], vec![[0.0; 3]; SURFACES]);
        let mut white = [0.0; 3];
        let mut balance = [0.0; 3];
        for nm in (RANGE_NM[0]..RANGE_NM[1]).map(|nm| f64::from(nm) + 0.5) {
            let (by_camera, by_eye) = (raw(nm), cie::observer(nm));
            if by_camera == [0.0; 3] && by_eye == [0.0; 3] {
                continue;
            }
            let light = cie::d65(nm);
            for (i, share) in reflectances(nm).into_iter().enumerate() {
                for channel in 0..3 {
                    seen[i][channel] += light * share * by_camera[channel];
                    xyz[i][channel] += light * share * by_eye[channel];
                }
            }
            for channel in 0..3 {
                balance[channel] += light * by_camera[channel];
                white[channel] += light * by_eye[channel];
            }
        }
        let luminance = white[1];
        let per_channel = |sums: &mut [f64; 3], unit: [f64; 3]| {
            for (value, unit) in sums.iter_mut().zip(unit) {
                *value /= unit;
            }
        };
        for (raw, xyz) in seen.iter_mut().zip(&mut xyz) {
            per_channel(raw, balance);
            per_channel(xyz, [luminance; 3]);
        }
        per_channel(&mut white, [luminance; 3]);
        let white_rgb = cie::srgb_from_xyz(white);
        let wanted: Vec<[f64; 3]> = xyz
            .iter()
            .map(|xyz| {
                let mut rgb = cie::srgb_from_xyz(*xyz);
                per_channel(&mut rgb, white_rgb);
                rgb
            })
            .collect();
        let matrix = white_preserving(&seen, &wanted)?;
        let mut fit = Self {
            matrix,
            mean: 0.0,
            greatest: 0.0,
        };
        let to_lab = |rgb: [f64; 3]| lab(xyz_of_srgb(rgb), xyz_of_srgb([1.0; 3]));
        for (seen, wanted) in seen.iter().zip(&wanted) {
            let off = ciede2000(to_lab(fit.srgb(*seen)), to_lab(*wanted));
            fit.mean += off / SURFACES as f64;
            fit.greatest = fit.greatest.max(off);
        }
        Some(fit)
    }

    /// Linear sRGB of raw channels.
    pub fn srgb(&self, raw: [f64; 3]) -> [f64; 3] {
        self.matrix
            .map(|row| row.iter().zip(raw).map(|(factor, raw)| factor * raw).sum())
    }
}

fn xyz_of_srgb(rgb: [f64; 3]) -> [f64; 3] {
    let to_srgb = glam::DMat3::from_cols_array_2d(&cie::XYZ_TO_SRGB).transpose();
    (to_srgb.inverse() * glam::DVec3::from_array(rgb)).to_array()
}

/// Rows whose sum is 1, by least squares: with `raw = (r, g, b)` and a row `(p, q, 1 − p − q)`, the
/// sum of `(p (r − b) + q (g − b) − (wanted − b))²` is least.
fn white_preserving(seen: &[[f64; 3]], wanted: &[[f64; 3]]) -> Option<[[f64; 3]; 3]> {
    let (mut rr, mut rg, mut gg) = (0.0, 0.0, 0.0);
    let mut right = [[0.0; 2]; 3];
    for ([r, g, b], wanted) in seen.iter().zip(wanted) {
        let (r, g) = (r - b, g - b);
        rr += r * r;
        rg += r * g;
        gg += g * g;
        for (right, wanted) in right.iter_mut().zip(wanted) {
            right[0] += r * (wanted - b);
            right[1] += g * (wanted - b);
        }
    }
    let determinant = rr * gg - rg * rg;
    let is_solvable = determinant > LEAST_DETERMINANT * rr * gg && determinant > 0.0;
    is_solvable.then(|| {
        right.map(|[r, g]| {
            let p = (r * gg - g * rg) / determinant;
            let q = (g * rr - r * rg) / determinant;
            [p, q, 1.0 - p - q]
        })
    })
}
