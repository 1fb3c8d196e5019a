//! What the tissue of a leaf scatters, whole or cut along its middle.

use optics::faces::USUAL_CONTRAST;

use crate::bsdf::coat::Coat;
use crate::spectrum::{Lanes, Table, WavelengthGrid, Wavelengths};

/// Reflectances and transmittances of the tissue for light that has passed the coats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue<const N: usize> {
    /// `r` of the adaxial and the abaxial face.
    pub(super) reflectance: [Lanes<N>; 2],
    /// `t` of light that enters by the adaxial and by the abaxial face.
    pub(super) transmittance: [Lanes<N>; 2],
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

/// The most that a leaf may let through to be cut in two: halves of one that lets all through would
/// be nothing.
const MOST_THROUGH: f32 = 0.999;

impl<const N: usize> Tissue<N> {
    /// The tissue of a leaf, from its reflectance `R` and transmittance `T` at normal incidence on
    /// the adaxial face and the ratio `ratio` of abaxial to adaxial reflectance.
    #[inline(always)]
    pub fn new(
        coats: &[Coat; 2],
        reflectance: Lanes<N>,
        transmittance: Lanes<N>,
        ratio: Lanes<N>,
    ) -> Self {
        Self::of_faces(coats, [reflectance, ratio * reflectance], transmittance)
    }

    /// The same, from the reflectances of the adaxial and of the abaxial face.
    #[inline(always)]
    pub fn of_faces(
        coats: &[Coat; 2],
        [reflectance, abaxial]: [Lanes<N>; 2],
        transmittance: Lanes<N>,
    ) -> Self {
        let [normal_a, normal_b] = coats.each_ref().map(|coat| coat.albedo.normal());
        let [passed_a, passed_b] = coats.each_ref().map(Coat::through_mean);
        let most = (passed_b / passed_a).min(1.0);
        let (into_a, into_b) = (1.0 / (1.0 - normal_a), 1.0 / (1.0 - normal_b));
        let back = passed_a / passed_b;
        let mut tissue = Self {
            reflectance: [Lanes::ZERO; 2],
            transmittance: [Lanes::ZERO; 2],
        };
        for lane in 0..N {
            let (r, t) = (reflectance.0[lane], transmittance.0[lane]);
            let t_ab = (t * into_a).min(most);
            let t_ba = (t_ab * back).min(1.0);
            let r_a = ((r - normal_a) * into_a).max(0.0).min(1.0 - t_ab);
            let absorbed = (1.0 - abaxial.0[lane] - t).max(0.0) * into_b;
            let r_b = (1.0 - t_ba - absorbed).max(0.0).min(1.0 - t_ba);
            tissue.reflectance[0].0[lane] = r_a;
            tissue.reflectance[1].0[lane] = r_b;
            tissue.transmittance[0].0[lane] = t_ab;
            tissue.transmittance[1].0[lane] = t_ba;
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
        }
    }

    /// The same reflectances with the transmittance of light that entered elsewhere. Where both
    /// faces could not send back what they do and let so much through, they let less through.
    #[must_use]
    #[inline(always)]
    pub fn passing(mut self, coats: &[Coat; 2], transmittance: Lanes<N>) -> Self {
        let into = 1.0 / (1.0 - coats[0].albedo.normal());
        let back = coats[0].through_mean() / coats[1].through_mean();
        let [r_a, r_b] = self.reflectance;
        for lane in 0..N {
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
        let root = coats.each_ref().map(|coat| coat.through_mean().sqrt());
        let [k_a, k_b] = root.map(|root| 1.0 / root - root);
        let mut half = self;
        for lane in 0..N {
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
    pub fn to_lanes(self) -> [Lanes<N>; 4] {
        let [r_a, r_b] = self.reflectance;
        let [t_ab, t_ba] = self.transmittance;
        [r_a, r_b, t_ab, t_ba]
    }

    /// `r` of a face, and `t` of light that enters by it and by the other.
    pub(super) fn seen(&self, side: usize) -> (Lanes<N>, [Lanes<N>; 2]) {
        let t = [side, 1 - side].map(|face| self.transmittance[face]);
        (self.reflectance[side], t)
    }

    /// The inverse of [`Tissue::to_lanes`].
    #[inline]
    pub fn from_lanes([r_a, r_b, t_ab, t_ba]: [Lanes<N>; 4]) -> Self {
        Self {
            reflectance: [r_a, r_b],
            transmittance: [t_ab, t_ba],
        }
    }
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
        Coat::pair([Coat::new(1.45, 0.3, 0.3), Coat::new(1.38, 0.5, 0.4)])
    }

    fn sheet(coats: &[Coat; 2], r: f32, t: f32) -> Tissue<1> {
        let [r, t] = [Lanes([r]), Lanes([t])];
        Tissue::new(coats, r, t, usual_abaxial_ratio(r, t))
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
            let [r_a, r_b, t_ab, t_ba] = leaf.to_lanes().map(|lanes| lanes.0[0]);
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
                let [r_a, r_b, t_ab, t_ba] = leaf.half(&coats, face).to_lanes();
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
            let [_, _, t_ab, t_ba] = clear.half(&coats, face).to_lanes();
            assert!(t_ab.0[0].max(t_ba.0[0]) > 0.9, "{clear:?}");
        }
        let white = sheet(&coats, 0.6, 0.4);
        for face in 0..2 {
            let [r_a, r_b, t_ab, t_ba] = white.half(&coats, face).to_lanes();
            for (r, t) in [(r_a, t_ab), (r_b, t_ba)] {
                assert!((r.0[0] + t.0[0] - 1.0).abs() < 1e-3, "{r:?} {t:?}");
            }
        }
    }

    #[test]
    fn light_may_go_either_way() {
        // c(A, B) of a half, whose cut has no coat, is the same in both directions.
        let coats = coats();
        let passed = coats.each_ref().map(Coat::through_mean);
        for leaf in sheets(&coats) {
            for (face, passed) in passed.into_iter().enumerate() {
                let [_, _, t_ab, t_ba] = leaf.half(&coats, face).to_lanes();
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
