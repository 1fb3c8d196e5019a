//! The same leaf optics for inner loops: a few nanoseconds a wavelength.
//!
//! The formulae are those of [`super::plate`] and [`super::pile`], in `f32` and in a form without
//! branches, so that several wavelengths go side by side through the processor's vector units. The
//! transmissivity of a layer comes from a table, exponentials and logarithms from polynomials.
//! Functions are inlined into those that are compiled for the units of a machine.
//!
//! - **In**: [`PileLanes`], made once for some wavelengths; what a leaf holds.
//! - **Out**: `(R, T)` in `f32`, within 1e-6 of the exact model.
//! - **Always true**: R + T ≤ 1; the same bits for a lane alone and among others, on every machine.

mod elementary;
mod layer;

use super::constituent::Constituent;
use super::contents::Texel;
use super::prospect_d::Coefficients;
use elementary::{exp_minus_one, log_one_plus_ratio};
use layer::LayerTable;

/// Below this `1 − e^−2(α+mβ)` the pile is taken to be lossless. At such values the share absorbed
/// is far below `f32`.
const LOSSLESS: f32 = 1e-30;

/// Below this `t` nothing comes from below the first plate, and its square must stay in range.
const LEAST_T: f32 = 1e-15;

/// Numbers that [`PileLanes`] holds for a wavelength.
pub const CONSTANTS: usize = FACES + Constituent::ABSORBING.len();

/// Those of them that describe the faces of a plate.
const FACES: usize = 3;

/// Absorbing constituents of which most leaves have some. The others, behind them, are left out where
/// a leaf has none of them: the sum is the same to the bit.
const USUAL: usize = Constituent::DryMatter as usize;

/// Whether there is something of any of these.
#[inline(always)]
fn has_some(rare: &[f32]) -> bool {
    let mut bits = 0;
    for content in rare {
        bits |= content.to_bits();
    }
    bits != 0
}

/// What the faces of a plate do at `L` wavelengths, and what the constituents absorb there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PileLanes<const L: usize> {
    /// `t_av(40°)`, `t₁₂ = t_av(90°)`, `t₂₁ = t₁₂ / n²`, then what one unit of each constituent
    /// absorbs, in the order of [`Constituent::ABSORBING`].
    pub constants: [[f32; L]; CONSTANTS],
}

/// The constants of [`PileLanes`] at one wavelength.
pub fn constants(at: &Coefficients) -> [f32; CONSTANTS] {
    let faces: [f64; FACES] = [
        at.interface.t_av_40,
        at.interface.t_av_90,
        at.interface.transmissivity_from_inside(),
    ];
    let absorbed = Constituent::ABSORBING.map(|constituent| at.absorption[constituent]);
    let mut constants = [0.0; CONSTANTS];
    for (constant, value) in constants.iter_mut().zip(faces.into_iter().chain(absorbed)) {
        *constant = value as f32;
    }
    constants
}

impl<const L: usize> PileLanes<L> {
    /// For the wavelengths at which these constants hold.
    pub fn new(at: &[Coefficients; L]) -> Self {
        let mut lanes = Self {
            constants: [[0.0; L]; CONSTANTS],
        };
        for (lane, at) in at.iter().enumerate() {
            for (row, constant) in lanes.constants.iter_mut().zip(constants(at)) {
                row[lane] = constant;
            }
        }
        lanes
    }

    /// What contents absorb in all at each of the wavelengths, `Σ C K`; the structure does not
    /// count.
    #[inline(always)]
    pub fn absorption(&self, contents: &Texel) -> [f32; L] {
        let mut sum = [0.0; L];
        let (usual, rare) = contents.as_array()[1..].split_at(USUAL);
        let (usual_rows, rare_rows) = self.constants[FACES..].split_at(USUAL);
        for (row, content) in usual_rows.iter().zip(usual) {
            for lane in 0..L {
                sum[lane] += row[lane] * content;
            }
        }
        if has_some(rare) {
            for (row, content) in rare_rows.iter().zip(rare) {
                for lane in 0..L {
                    sum[lane] += row[lane] * content;
                }
            }
        }
        sum
    }

    /// `(R, T)` of a leaf with these contents at each of the wavelengths.
    #[inline(always)]
    pub fn reflectance_transmittance(&self, contents: &Texel) -> ([f32; L], [f32; L]) {
        let (structure, layers) = self.layers(contents);
        let (mut r, mut t) = ([0.0; L], [0.0; L]);
        for i in 0..L {
            (r[i], t[i]) = pile(self.faces(i), layers[i], structure);
        }
        (r, t)
    }

    /// [`PileLanes::reflectance_transmittance`] of some contents, and `T` of a leaf with its own
    /// contents at each of the wavelengths, in much less time than one after the other: each is a
    /// chain of operations that wait for one another.
    #[inline(always)]
    pub fn with_each(
        &self,
        contents: &Texel,
        each: &[&Texel; L],
    ) -> (([f32; L], [f32; L]), [f32; L]) {
        let (structures, layers_of_each) = self.layers_of_each(each);
        let (structure, layers) = self.layers(contents);
        let (mut r, mut t, mut t_of_each) = ([0.0; L], [0.0; L], [0.0; L]);
        for i in 0..L {
            (r[i], t[i]) = pile(self.faces(i), layers[i], structure);
            (_, t_of_each[i]) = pile(self.faces(i), layers_of_each[i], structures[i]);
        }
        ((r, t), t_of_each)
    }

    /// What the faces of a plate let through at one of the wavelengths.
    #[inline(always)]
    fn faces(&self, lane: usize) -> [f32; FACES] {
        let [lit, inwards, outwards, ..] = &self.constants;
        [lit[lane], inwards[lane], outwards[lane]]
    }

    /// The structure, and what a layer absorbs and lets through at each of the wavelengths.
    #[inline(always)]
    fn layers(&self, contents: &Texel) -> (f32, [(f32, f32); L]) {
        let structure = contents[Constituent::Structure];
        let per_plate = 1.0 / structure;
        let absorption = self.absorption(contents);
        let table = LayerTable::get();
        let mut layers = [(0.0, 0.0); L];
        for lane in 0..L {
            layers[lane] = table.absorbed_and_passed(absorption[lane] * per_plate);
        }
        (structure, layers)
    }

    /// The same for contents of its own at each of the wavelengths.
    #[inline(always)]
    fn layers_of_each(&self, contents: &[&Texel; L]) -> ([f32; L], [(f32, f32); L]) {
        let table = LayerTable::get();
        // First what lies about in memory, lane by lane; what follows goes side by side.
        let (mut structure, mut absorption) = ([0.0; L], [0.0; L]);
        for lane in 0..L {
            let [plates, held @ ..] = contents[lane].as_array();
            structure[lane] = *plates;
            let (usual, rare) = held.split_at(USUAL);
            let (usual_rows, rare_rows) = self.constants[FACES..].split_at(USUAL);
            for (row, content) in usual_rows.iter().zip(usual) {
                absorption[lane] += row[lane] * content;
            }
            if has_some(rare) {
                for (row, content) in rare_rows.iter().zip(rare) {
                    absorption[lane] += row[lane] * content;
                }
            }
        }
        let mut layers = [(0.0, 0.0); L];
        for lane in 0..L {
            layers[lane] = table.absorbed_and_passed(absorption[lane] / structure[lane]);
        }
        (structure, layers)
    }
}

/// `R`, `T` of `n` plates from the transmissivities of a plate's faces, and what a layer absorbs and
/// lets through.
///
/// The chain of operations that wait for one another is kept short: quotients are put off until one
/// division serves several.
#[inline(always)]
fn pile([t_lit, t_in, t_out]: [f32; FACES], (absorbed, tau): (f32, f32), n: f32) -> (f32, f32) {
    // One plate.
    let r_inside = 1.0 - t_out;
    let inside = r_inside * tau;
    let once = 1.0 / ((1.0 - inside) * (1.0 + inside));
    let passes = tau * t_out * once;
    let t_first = t_lit * passes;
    let r_first = (1.0 - t_lit) + inside * t_first;
    let t = t_in * passes;
    let r = (1.0 - t_in) + inside * t;
    let lost = t_in * absorbed * (1.0 + inside) * once;

    // The plates below, as in `pile::below`, where sinh α = s / r and sinh β = s / t. Where no light
    // passes, t is kept from zero: then β is huge, and nothing comes from below anyhow.
    let s2 = 0.25 * ((1.0 + r + t) * (1.0 + r - t) * ((1.0 - r + t) * lost));
    let s = s2.sqrt();
    let aside = 1.0 / ((r * r + s2).sqrt() + s);
    let fall = r * aside; // e^−α
    let one_minus_fall2 = 2.0 * s * aside;
    // e^β − 1 = (s + √(t² + s²)) / t − 1, without a difference of numbers that are nearly equal.
    let kept = if t > LEAST_T { t } else { LEAST_T };
    let both = (kept * kept + s2).sqrt() + kept;
    let beta = log_one_plus_ratio(s * (s + both), kept * both);
    let m = n - 1.0;
    let root = exp_minus_one(-m * beta); // e^−mβ − 1
    let y = 1.0 + root; // e^−mβ
    let one_minus_y2 = -root * (1.0 + y);
    let whole = one_minus_y2 + y * y * one_minus_fall2;
    let lossless = whole <= LOSSLESS;
    let back = if lossless { m * r } else { fall * one_minus_y2 };
    let through = if lossless { t } else { y * one_minus_fall2 };
    let of = if lossless { t + m * r } else { whole };

    // r and t of the plates below are `back / of` and `through / of`.
    let entering = t_first / (of - back * r);
    let reflectance = r_first + entering * (back * t);
    let transmittance = entering * through;
    let rest = 1.0 - reflectance;
    (
        reflectance,
        if transmittance < rest {
            transmittance
        } else {
            rest
        },
    )
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::pile::pile as exact_pile;
    use crate::{Contents, PerConstituent, ProspectD};
    use properties::fixed;

    /// A leaf of `n` plates each of which absorbs `k` at a wavelength, by one constituent alone.
    fn fast(nm: f64, k: f64, n: f64) -> (f32, f32) {
        let mut at = ProspectD::coefficients(nm).expect("in range");
        at.absorption[Constituent::Brown] = 1.0;
        let contents = PerConstituent::splat(0.0).with(&[
            (Constituent::Structure, n as f32),
            (Constituent::Brown, (k * n) as f32),
        ]);
        let (r, t) = PileLanes::new(&[at]).reflectance_transmittance(&contents);
        (r[0], t[0])
    }

    proptest! {
        #![proptest_config(fixed(4096))]

        #[test]
        fn the_fast_model_is_the_exact_one_within_1e_6(
            nm in 400.0..2500.0,
            log_k in -12.0..1.0,
            n in 1.0..4.0,
        ) {
            let k = 10f64.powf(log_k);
            let at = ProspectD::coefficients(nm).expect("in range");
            let exact = exact_pile(&at.interface, k, n);
            let (r, t) = fast(nm, k, n);
            prop_assert!((f64::from(r) - exact.reflectance).abs() <= 1e-6, "R {r}: {exact:?}");
            prop_assert!((f64::from(t) - exact.transmittance).abs() <= 1e-6, "T {t}: {exact:?}");
        }
    }

    #[test]
    fn lanes_with_their_own_contents_let_through_what_each_does_alone() {
        let at = [450.0, 550.0, 680.0].map(|nm| ProspectD::coefficients(nm).expect("in range"));
        let lanes = PileLanes::new(&at);
        let leaves = [(1.2, 60.0), (1.5, 20.0), (2.4, 5.0)].map(|(n, chlorophyll)| {
            PerConstituent::splat(0.0).with(&[
                (Constituent::Structure, n),
                (Constituent::Chlorophyll, chlorophyll),
            ])
        });
        let (own, each) = lanes.with_each(&leaves[0], &leaves.each_ref());
        assert_eq!(own, lanes.reflectance_transmittance(&leaves[0]));
        for lane in 0..3 {
            let alone = lanes.reflectance_transmittance(&leaves[lane]).1[lane];
            assert!((each[lane] - alone).abs() < 1e-6, "{} {alone}", each[lane]);
        }
    }

    #[test]
    fn what_few_leaves_have_absorbs_too_alone_and_among_others() {
        let at = [1500.0, 1700.0, 2300.0].map(|nm| {
            let mut at = ProspectD::coefficients(nm).expect("in range");
            at.absorption[Constituent::Extra] = 0.01;
            at
        });
        let pro = Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Water, 0.01),
            (Constituent::Proteins, 0.001),
            (Constituent::CarbonBased, 0.005),
            (Constituent::Extra, 20.0),
        ]);
        let texel = pro.to_texel();
        let ((r, t), each) = PileLanes::new(&at).with_each(&texel, &[&texel; 3]);
        for (lane, at) in at.iter().enumerate() {
            let exact = at.reflectance_transmittance(&pro);
            assert!(
                (f64::from(r[lane]) - exact.reflectance).abs() < 1e-6,
                "{lane}"
            );
            assert!(
                (f64::from(t[lane]) - exact.transmittance).abs() < 1e-6,
                "{lane}"
            );
            assert!((each[lane] - t[lane]).abs() < 1e-6, "{lane}");
            let bare = at.reflectance_transmittance(&pro.with(&[(Constituent::Extra, 0.0)]));
            assert!(bare.reflectance > exact.reflectance + 0.01, "{lane}");
        }
    }

    #[test]
    fn nothing_absorbed_means_all_comes_out() {
        for n in [1.0, 1.0 + 1e-6, 1.5, 3.7] {
            for k in [0.0, 1e-300, 1e-40, 1e-20] {
                let (r, t) = fast(800.0, k, n);
                assert!((r + t - 1.0).abs() < 1e-6, "N = {n}, K = {k}: {r} + {t}");
            }
        }
    }

    #[test]
    fn extreme_absorption_stays_finite() {
        for n in [1.0, 1.5, 40.0] {
            for k in [30.0, 128.0, 745.0, 1e4, 1e30] {
                let at = ProspectD::coefficients(1450.0).expect("in range");
                let (r, t) = fast(1450.0, k, n);
                let first = (1.0 - at.interface.t_av_40) as f32;
                assert!((r - first).abs() < 1e-6, "N = {n}, K = {k}: {r}");
                assert!((0.0..1e-10).contains(&t), "N = {n}, K = {k}: {t}");
            }
        }
    }

    #[test]
    fn lanes_together_are_the_lanes_alone() {
        let contents = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("valid");
        let contents = contents.to_texel();
        let at: [_; 8] = std::array::from_fn(|i| {
            ProspectD::coefficients(410.0 + 250.0 * i as f64).expect("in range")
        });
        let (r, t) = PileLanes::new(&at).reflectance_transmittance(&contents);
        for i in 0..8 {
            let alone = PileLanes::new(&[at[i]]).reflectance_transmittance(&contents);
            assert_eq!(
                (alone.0[0].to_bits(), alone.1[0].to_bits()),
                (r[i].to_bits(), t[i].to_bits())
            );
        }
    }

    #[test]
    fn the_greatest_error_over_the_range_is_reported() {
        let mut worst = [0.0_f64; 2];
        for step in 0..400 {
            let nm = 400.0 + 5.25 * f64::from(step);
            let at = ProspectD::coefficients(nm).expect("in range");
            for log_k in 0..130 {
                for n in [1.0, 1.2, 1.5, 2.0, 2.7, 4.0] {
                    let k = 10f64.powf(-12.0 + 0.1 * f64::from(log_k));
                    let exact = exact_pile(&at.interface, k, n);
                    let (r, t) = fast(nm, k, n);
                    worst[0] = worst[0].max((f64::from(r) - exact.reflectance).abs());
                    worst[1] = worst[1].max((f64::from(t) - exact.transmittance).abs());
                }
            }
        }
        eprintln!(
            "greatest error of R {:.2e}, of T {:.2e}",
            worst[0], worst[1]
        );
        assert!(worst[0] < 1e-6 && worst[1] < 1e-6, "{worst:?}");
    }
}
