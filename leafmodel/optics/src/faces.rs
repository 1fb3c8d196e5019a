//! How much brighter the abaxial face of a leaf is than the adaxial one.
//!
//! PROSPECT's plates are alike, so its leaf has one reflectance. The rule here gives the other face
//! from what the leaf absorbs; `docs/src/theory/leaf-bsdf.md` says why, and how far it holds.

/// The contrast of green leaves: fitted to the means of \[noda2014\] at 450, 550, 680 and 800 nm,
/// within 5 %.
pub const USUAL_CONTRAST: f64 = 0.7;

/// Least and greatest contrast. Up to 1.8 the abaxial face never absorbs less than nothing, whatever
/// R and T; below 0 it is the darker one, as of a leaf that is red underneath.
pub const CONTRASTS: [f64; 2] = [-0.9, 1.8];

/// Abaxial over adaxial reflectance of a leaf with this absorptance, `1 − R − T` of light on the
/// adaxial face, 0 to 1: `1 + c A² (3 − 2 A)` with the contrast `c`. So the faces are alike where
/// nothing is absorbed, and the abaxial one is `1 + c` times as bright where all is.
pub fn abaxial_ratio(absorptance: f64, contrast: f64) -> f64 {
    1.0 + contrast * weight_of_contrast(absorptance)
}

/// How much of the contrast there is where so much is absorbed: `A² (3 − 2 A)`, 0 to 1.
pub(crate) fn weight_of_contrast(absorptance: f64) -> f64 {
    let a = absorptance.clamp(0.0, 1.0);
    a * a * (3.0 - 2.0 * a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_abaxial_face_never_absorbs_less_than_nothing() {
        for contrast in CONTRASTS {
            for i in 0..=100 {
                for j in 0..=100 - i {
                    let (r, t) = (f64::from(i) / 100.0, f64::from(j) / 100.0);
                    let abaxial = r * abaxial_ratio(1.0 - r - t, contrast);
                    assert!(abaxial >= 0.0 && abaxial + t <= 1.0 + 1e-12, "{r} {t}");
                }
            }
        }
    }
}
