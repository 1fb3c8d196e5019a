//! What the tissue of a leaf scatters, whole or cut along its middle.

use optics::faces::USUAL_CONTRAST;

use crate::bsdf::coat::Coat;
use crate::bsdf::dust::between;
use crate::bsdf::leaf_shape::{LeafShape, MOST_SLANT, Passed};
use crate::spectrum::{Lanes, Table, WavelengthGrid, Wavelengths};

/// Reflectances and transmittances of the tissue for light along the normal that has passed the
/// coats, and how steeply what goes through falls off at a slant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue<const N: usize> {
    /// `r` of the adaxial and the abaxial face.
    reflectance: [Lanes<N>; 2],
    /// `t` of light that enters by the adaxial and by the abaxial face.
    transmittance: [Lanes<N>; 2],
    /// `q` of the adaxial and the abaxial face.
    steepness: [Lanes<N>; 2],
}

/// The tissue seen from one direction, with everything that does not depend on the direction of the
/// light: `f` without `1 − E` of either direction and without `1/π`.
#[derive(Clone, Debug)]
pub(super) struct TissueView<const N: usize> {
    /// Of what is sent back, by powers of `x` of the light.
    back: [Lanes<N>; 3],
    /// Of what is sent back, more onwards across the normal.
    onward: Lanes<N>,
    through: Lanes<N>,
    /// `q` of the other face.
    steepness: Lanes<N>,
    /// `δ`.
    forward: Lanes<N>,
    /// Fractions of what has passed the coat that are sent back and let through.
    pub(super) shares: [Lanes<N>; 2],
}

/// Abaxial over adaxial reflectance of a leaf of reflectance `R` and transmittance `T` of which
/// nothing else is known: `1 + 0.7 A² (3 − 2 A)` of its absorptance `A = 1 − R − T`, as
/// [`optics::faces::abaxial_ratio`] has it.
///
/// 1 for tissue that absorbs nothing, as 0.97 is measured at 800 nm; for green leaves within 5 % of
/// the means that Noda et al. measured at 450, 550, 680 and 800 nm. The abaxial face absorbs at
/// least 0.63 of what the adaxial one does, whatever `R` and `T`.
#[inline(always)]
pub fn usual_abaxial_ratio<const N: usize>(
    reflectance: Lanes<N>,
    transmittance: Lanes<N>,
) -> Lanes<N> {
    let mut ratio = Lanes::ONE;
    for lane in 0..N {
        let a = (1.0 - reflectance.0[lane] - transmittance.0[lane]).clamp(0.0, 1.0);
        ratio.0[lane] += USUAL_CONTRAST as f32 * a * a * (3.0 - 2.0 * a);
    }
    ratio
}

/// What is let through falls to nothing at most at grazing incidence.
const MOST_STEEPNESS: f32 = 0.95 / MOST_SLANT;
/// Mean of what is sent back more at a slant, over what is sent back along the normal, at most.
const MOST_SLANTING: f32 = 0.5;

/// The most that a leaf may let through to be cut in two: halves of one that lets all through would
/// be nothing.
const MOST_THROUGH: f32 = 0.999;

impl<const N: usize> Tissue<N> {
    /// The tissue of a leaf, from its reflectance `R` and transmittance `T` at normal incidence on
    /// the adaxial face and the ratio `ratio` of abaxial to adaxial reflectance.
    #[inline(always)]
    pub fn new(
        coats: &[Coat; 2],
        shape: &LeafShape,
        reflectance: Lanes<N>,
        transmittance: Lanes<N>,
        ratio: Lanes<N>,
    ) -> Self {
        let faces = [reflectance, ratio * reflectance];
        Self::of_faces(coats, shape, faces, transmittance)
    }

    /// The same, from the reflectances of the adaxial and of the abaxial face.
    #[inline(always)]
    pub fn of_faces(
        coats: &[Coat; 2],
        shape: &LeafShape,
        reflectance: [Lanes<N>; 2],
        transmittance: Lanes<N>,
    ) -> Self {
        let normal = coats.each_ref().map(|coat| coat.albedo.normal());
        let into = normal.map(|normal| 1.0 / (1.0 - normal));
        let passed = coats.each_ref().map(Coat::passed);
        let mut tissue = Self::opaque(Lanes::ZERO);
        for lane in 0..N {
            let t = transmittance.0[lane];
            let r = [0, 1].map(|f| ((reflectance[f].0[lane] - normal[f]) * into[f]).max(0.0));
            let t_ab = (t * into[0]).min(1.0);
            let mut q = shape.steepness(t_ab, r);
            for (face, q) in q.iter_mut().enumerate() {
                *q = q
                    .min(MOST_STEEPNESS)
                    .min(bound(r[face], t_ab, &passed[face]));
            }
            if shape.is_even() {
                // `p` of the faces are as what passes their coats along the normal.
                let means = [0, 1].map(|face| passed[face].mean * into[face]);
                let below = passed[0].through(q[0]) * means[0] / means[1];
                q[1] = steepness_for(below, &passed[1]);
                if below > 1.0 {
                    q[0] = steepness_for(means[1] / means[0], &passed[0]);
                }
            }
            let p = [0, 1].map(|f| passed[f].mean * passed[f].through(q[f]));
            let t_ab = t_ab.min(p[1] / p[0]);
            let t_ba = (t_ab * (p[0] / p[1])).min(1.0);
            let absorbed = (1.0 - reflectance[1].0[lane] - t).max(0.0) * into[1];
            let r = [
                r[0].min(1.0 - t_ab),
                (1.0 - t_ba - absorbed).max(0.0).min(1.0 - t_ba),
            ];
            for (face, t) in [t_ab, t_ba].into_iter().enumerate() {
                tissue.reflectance[face].0[lane] = r[face];
                tissue.transmittance[face].0[lane] = t;
                tissue.steepness[face].0[lane] = q[face];
            }
        }
        tissue
    }

    /// A body of which both sides send back the same share of what has passed their coat, and which
    /// lets nothing through.
    #[must_use]
    #[inline]
    pub fn opaque(reflectance: Lanes<N>) -> Self {
        Self {
            reflectance: [reflectance; 2],
            transmittance: [Lanes::ZERO; 2],
            steepness: [Lanes::ZERO; 2],
        }
    }

    /// `p` of a face in a lane: what passes of diffuse light from within.
    #[inline(always)]
    fn passed(&self, lane: usize, face: usize, passed: &Passed) -> f32 {
        passed.mean * passed.through(self.steepness[face].0[lane])
    }

    /// The same reflectances with the transmittance of light that entered elsewhere. Where both
    /// faces could not send back what they do and let so much through, they let less through.
    #[must_use]
    #[inline(always)]
    pub fn passing(mut self, coats: &[Coat; 2], transmittance: Lanes<N>) -> Self {
        let into = 1.0 / (1.0 - coats[0].albedo.normal());
        let passed = coats.each_ref().map(Coat::passed);
        let [r_a, r_b] = self.reflectance;
        for lane in 0..N {
            let [p_a, p_b] = [0, 1].map(|face| self.passed(lane, face, &passed[face]));
            let back = p_a / p_b;
            let most = (1.0 - r_a.0[lane]).min((1.0 - r_b.0[lane]) / back);
            let t_ab = (transmittance.0[lane] * into).min(most);
            self.transmittance[0].0[lane] = t_ab;
            self.transmittance[1].0[lane] = t_ab * back;
        }
        self
    }

    /// One face of the same leaf cut along its middle: what the face (0 adaxial, 1 abaxial) with
    /// half of the tissue scatters, so that both halves one over the other are the leaf. The cut
    /// has no coat.
    ///
    /// Each half scatters light from within as it does light from outside but for the coat, and
    /// absorbs as much of either; `docs/src/theory/leaf-bsdf.md`, "A closed blade".
    #[must_use]
    pub fn half(self, coats: &[Coat; 2], face: usize) -> Self {
        let passed = coats.each_ref().map(Coat::passed);
        let mut half = self;
        half.steepness[1 - face] = Lanes::ZERO;
        for lane in 0..N {
            let root = [0, 1].map(|face| self.passed(lane, face, &passed[face]).sqrt());
            let [k_a, k_b] = root.map(|root| 1.0 / root - root);
            let [r_a, r_b] = self.reflectance.map(|r| r.0[lane]);
            let t = (self.transmittance[0].0[lane] * self.transmittance[1].0[lane]).sqrt();
            let t = t.min(MOST_THROUGH);
            let rest = 1.0 / (1.0 - t * t);
            // Reflectances from within are s + q τ, and τ² = t (1 − σ_a σ_b).
            let [s_a, s_b] = [(r_a - t * r_b) * rest, (r_b - t * r_a) * rest];
            let [q_a, q_b] = [(k_a - t * k_b) * rest, (k_b - t * k_a) * rest];
            let square = 1.0 + t * q_a * q_b;
            let linear = 0.5 * t * (s_a * q_b + s_b * q_a);
            let constant = t * (s_a * s_b - 1.0);
            let root_of = (linear * linear - square * constant).max(0.0).sqrt();
            // Of the two forms of the root the one without a difference of equal numbers.
            let positive = if linear > 0.0 {
                -constant / (root_of + linear)
            } else {
                (root_of - linear) / square
            };
            // A face takes in no more than there is: the clearest of leaves cannot be cut exactly.
            let through = positive.min(root[0].min(root[1])).max(0.0);
            let [s, q, k] = [[s_a, s_b][face], [q_a, q_b][face], [k_a, k_b][face]];
            let within = (s + q * through).clamp(0.0, 1.0 - through * root[face]);
            let inwards = through / root[face];
            let outside = (within - k * through).clamp(0.0, (1.0 - inwards).max(0.0));
            half.reflectance[face].0[lane] = outside;
            half.reflectance[1 - face].0[lane] = within;
            half.transmittance[face].0[lane] = inwards;
            half.transmittance[1 - face].0[lane] = through * root[face];
        }
        half
    }

    /// Its numbers, to be stored in a table.
    pub fn to_lanes(self) -> [Lanes<N>; 6] {
        let [r_a, r_b] = self.reflectance;
        let [t_ab, t_ba] = self.transmittance;
        let [q_a, q_b] = self.steepness;
        [r_a, r_b, t_ab, t_ba, q_a, q_b]
    }

    /// The inverse of [`Tissue::to_lanes`].
    #[inline]
    pub(crate) fn from_lanes([r_a, r_b, t_ab, t_ba, q_a, q_b]: [Lanes<N>; 6]) -> Self {
        Self {
            reflectance: [r_a, r_b],
            transmittance: [t_ab, t_ba],
            steepness: [q_a, q_b],
        }
    }

    /// Fraction of diffuse light on a face that the leaf scatters below its coat.
    pub(super) fn diffuse(&self, shape: &LeafShape, side: usize, passed: &Passed) -> Lanes<N> {
        Lanes::from_fn(|lane| {
            let face = self.face(lane, shape, side, passed, 1.0);
            let t = self.transmittance[side].0[lane];
            face.r + face.mean + t * passed.through(self.steepness[side].0[lane])
        })
    }

    /// The same between layers on its faces that send back `sent` of diffuse light.
    pub(super) fn between(mut self, sent: [Lanes<N>; 2]) -> Self {
        let back = [0, 1].map(|side| {
            let sides = [side, 1 - side];
            let [r, t, sent] = [&self.reflectance, &self.transmittance, &sent]
                .map(|of| sides.map(|side| of[side]));
            between(r, t, sent)
        });
        self.reflectance = back.map(|(r, _)| r);
        self.transmittance = [0, 1].map(|side: usize| back[side].1[0]);
        self
    }

    /// What a face sends back at a slant, where `leaving` of what is let through leaves the other
    /// side's dust.
    #[inline(always)]
    fn face(
        &self,
        lane: usize,
        shape: &LeafShape,
        side: usize,
        passed: &Passed,
        leaving: f32,
    ) -> Slanting {
        let [r, t, q] =
            [&self.reflectance, &self.transmittance, &self.steepness].map(|of| of[side].0[lane]);
        let t = t * leaving;
        let absorbed = (1.0 - r - t).max(0.0);
        let [shallow, paired, onward] = shape.sent_back(side, r);
        let turned = (1.0 - absorbed) * t * q;
        let (slope, bend) = (2.0 * turned + absorbed * shallow, turned * q);
        let mean = slope * passed.slant - bend * passed.squared;
        // What is sent back of light along the normal is never less than nothing.
        let most = MOST_SLANTING * r;
        let scale = if mean > most { most / mean } else { 1.0 };
        Slanting {
            r,
            slope: slope * scale,
            bend: bend * scale,
            mean: mean * scale,
            paired,
            onward,
        }
    }

    /// The tissue seen by a face (0 adaxial, 1 abaxial) from the cosine within the leaf 1 − `x`,
    /// through coats that pass so much on this side and on the other; `leaving` of what is let
    /// through leaves the dust on the other.
    #[inline]
    pub(super) fn seen(
        &self,
        shape: &LeafShape,
        side: usize,
        [own, other]: [&Passed; 2],
        x: f32,
        leaving: f32,
    ) -> TissueView<N> {
        let mut view = TissueView {
            back: [Lanes::ZERO; 3],
            onward: Lanes::ZERO,
            through: Lanes::ZERO,
            steepness: self.steepness[1 - side],
            forward: Lanes::ZERO,
            shares: [Lanes::ZERO; 2],
        };
        let away = x - own.slant;
        let over = 1.0 / own.mean;
        for lane in 0..N {
            let face = self.face(lane, shape, side, own, leaving);
            let here = x * (face.slope - face.bend * x);
            let pair = face.paired * away;
            view.back[0].0[lane] = (face.r - face.mean + here - own.slant * pair) * over;
            view.back[1].0[lane] = (face.slope + pair) * over;
            view.back[2].0[lane] = -face.bend * over;
            view.onward.0[lane] = face.onward * over;
            let straight = 1.0 - self.steepness[side].0[lane] * x;
            let steep = straight * straight;
            let [t_own, t_other] = [side, 1 - side].map(|s| self.transmittance[s].0[lane]);
            let p_own = self.passed(lane, side, own);
            let p_other = self.passed(lane, 1 - side, other);
            // Alike in both directions, and within bounds from either side.
            view.through.0[lane] = (t_own / p_other).min(t_other / p_own) * steep;
            let adaxial = self.reflectance[0].0[lane] + self.transmittance[0].0[lane];
            view.forward.0[lane] = shape.forward((1.0 - adaxial).max(0.0));
            view.shares[0].0[lane] = face.r + here;
            view.shares[1].0[lane] = t_own * steep;
        }
        view
    }
}

/// What a face sends back: `r + h(x)`, with `h = slope x − bend x²`, and what depends on both
/// directions.
struct Slanting {
    r: f32,
    slope: f32,
    bend: f32,
    /// Mean of `h` over diffuse light.
    mean: f32,
    paired: f32,
    onward: f32,
}

impl<const N: usize> TissueView<N> {
    /// `f` of light that is sent back, from `x` of the light and from how far it goes on across the
    /// normal, −(ωₒ · ωᵢ) within the plane of the leaf.
    #[inline]
    pub(super) fn sent_back(&self, x: f32, across: f32) -> Lanes<N> {
        let [even, slope, bend] = self.back;
        even + (slope + bend * x) * x + self.onward * across
    }

    /// `f` of light that is let through.
    #[inline]
    pub(super) fn let_through(&self, x: f32, across: f32) -> Lanes<N> {
        let straight = Lanes::ONE - self.steepness * x;
        self.through * straight * straight * (Lanes::ONE + self.forward * across)
    }

    /// The same with all of it multiplied.
    #[inline]
    pub(super) fn scaled(mut self, back: Lanes<N>, through: Lanes<N>) -> Self {
        self.back = self.back.map(|of| of * back);
        self.onward *= back;
        self.through *= through;
        self
    }
}

/// `q` of a face such that what is let through less at a slant, and sent back instead, is less than
/// the face sends back along the normal.
#[inline(always)]
fn bound(r: f32, t: f32, passed: &Passed) -> f32 {
    let kept = 1.0 - (1.0 - r - t).max(0.0);
    let slanting = 2.0 * kept * t * passed.slant;
    if slanting > 0.0 {
        MOST_SLANTING * r / slanting
    } else {
        MOST_STEEPNESS
    }
}

/// `q` with which the mean of `(1 − q x)²` is this; 0 if it is more than 1.
#[inline(always)]
fn steepness_for(mean: f32, passed: &Passed) -> f32 {
    let [first, second] = [passed.slant, passed.squared];
    let root = (first * first - second * (1.0 - mean)).max(0.0).sqrt();
    ((first - root) / second).clamp(0.0, MOST_STEEPNESS)
}

impl Tissue<1> {
    /// Tabulates a uniform leaf at every wavelength of a grid.
    pub fn table(grid: &WavelengthGrid, at: impl Fn(&Wavelengths<1>) -> Self) -> Table {
        Table::new(grid, |nm| {
            let lanes = at(&Wavelengths::new([nm])).to_lanes();
            lanes.map(|lanes| lanes.0[0])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coats() -> [Coat; 2] {
        [Coat::new(1.45, 0.3, 0.3), Coat::new(1.38, 0.5, 0.4)]
    }

    fn sheet(coats: &[Coat; 2], r: f32, t: f32) -> Tissue<1> {
        let [r, t] = [Lanes([r]), Lanes([t])];
        Tissue::new(
            coats,
            &LeafShape::measured(),
            r,
            t,
            usual_abaxial_ratio(r, t),
        )
    }

    /// Leaves from nearly black to white, from opaque to clear.
    fn sheets(coats: &[Coat; 2]) -> impl Iterator<Item = Tissue<1>> {
        (0..=20).flat_map(move |i| {
            (0..=10).map(move |j| {
                let scattered = 0.05 * i as f32;
                let through = 0.1 * j as f32 * scattered;
                sheet(coats, scattered - through, through)
            })
        })
    }

    #[test]
    fn two_halves_one_over_the_other_are_the_leaf() {
        let coats = coats();
        let mut cut = 0;
        for leaf in sheets(&coats) {
            let [r_a, r_b, t_ab, t_ba, ..] = leaf.to_lanes().map(|lanes| lanes.0[0]);
            let [above, below] = [0, 1].map(|face| {
                let half = leaf.half(&coats, face);
                half.to_lanes().map(|lanes| lanes.0[0])
            });
            // A leaf that lets through more than it reflects times the other's R cannot be cut
            // exactly: no half reflects less than nothing.
            let t = (t_ab * t_ba).sqrt();
            if above[0] == 0.0 || below[1] == 0.0 || t > MOST_THROUGH {
                continue;
            }
            cut += 1;
            // Light between the halves meets the cut sides.
            let again = 1.0 / (1.0 - above[1] * below[0]);
            let found = [
                above[0] + above[2] * below[0] * above[3] * again,
                below[1] + below[3] * above[1] * below[2] * again,
                above[2] * below[2] * again,
                below[3] * above[3] * again,
            ];
            for (found, expected) in found.into_iter().zip([r_a, r_b, t_ab, t_ba]) {
                assert!(
                    (found - expected).abs() < 2e-5,
                    "{found} {expected} of {leaf:?}"
                );
            }
        }
        assert!(cut > 100, "{cut} of 231");
    }

    #[test]
    fn no_half_sends_out_more_than_comes_in_and_white_ones_send_out_all() {
        let coats = coats();
        for leaf in sheets(&coats) {
            for face in 0..2 {
                let [r_a, r_b, t_ab, t_ba, ..] = leaf.half(&coats, face).to_lanes();
                for (r, t) in [(r_a, t_ab), (r_b, t_ba)] {
                    let sum = r.0[0] + t.0[0];
                    assert!(r.0[0] >= 0.0 && t.0[0] >= 0.0);
                    assert!(sum <= 1.0 + 1e-5, "{sum} of {leaf:?}");
                }
            }
        }
        // What lets all through does so when it is cut.
        let clear = sheet(&coats, 0.0, 1.0);
        for face in 0..2 {
            let [_, _, t_ab, t_ba, ..] = clear.half(&coats, face).to_lanes();
            assert!(t_ab.0[0].max(t_ba.0[0]) > 0.9, "{clear:?}");
        }
        let white = sheet(&coats, 0.6, 0.4);
        for face in 0..2 {
            let [r_a, r_b, t_ab, t_ba, ..] = white.half(&coats, face).to_lanes();
            for (r, t) in [(r_a, t_ab), (r_b, t_ba)] {
                assert!((r.0[0] + t.0[0] - 1.0).abs() < 1e-3, "{r:?} {t:?}");
            }
        }
    }

    #[test]
    fn light_may_go_either_way() {
        // c(A, B) of a half, whose cut has no coat, is the same in both directions.
        let coats = coats();
        let passed = coats.each_ref().map(Coat::passed);
        for leaf in sheets(&coats) {
            for (face, passed) in passed.iter().enumerate() {
                let half = leaf.half(&coats, face);
                let [_, _, t_ab, t_ba, ..] = half.to_lanes();
                let passed = half.passed(0, face, passed);
                let (inwards, outwards) = if face == 0 {
                    (t_ab, t_ba)
                } else {
                    (t_ba, t_ab)
                };
                let (there, back) = (inwards.0[0], outwards.0[0] / passed);
                assert!((there - back).abs() < 1e-5, "{there} {back}");
            }
        }
    }
}
