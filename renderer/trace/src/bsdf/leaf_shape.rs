//! How what a leaf scatters depends on angle.
//!
//! Leaves of layers, followed by discrete ordinates, say how; the numbers here are fitted to ten of
//! them. `docs/src/theory/leaf-bsdf.md`, "By angle", has the formulae and what they are worth.

use optics::layers::DRY_BELOW;
use optics::{Constituent, Contents};

/// Refractive index within a leaf, PROSPECT-D's between 680 and 800 nm.
const INDEX: f32 = 1.45;
/// What 1 less the cosine within the leaf can be at most, `x` at grazing incidence.
pub(super) const MOST_SLANT: f32 = 0.275_9;
/// Structure N that is assumed of a leaf of which only spectra are known: a mesophyte's.
const USUAL_STRUCTURE: f64 = 1.6;

/// `x`: 1 less the cosine within the leaf of light that comes in at the cosine `mu`.
#[inline]
pub fn slant(mu: f32) -> f32 {
    1.0 - (1.0 - (1.0 - mu * mu) * (1.0 / (INDEX * INDEX)))
        .max(0.0)
        .sqrt()
}

/// What passes a coat of light that is alike from all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passed {
    /// Fraction that passes, `P`.
    pub mean: f32,
    /// Mean of `x` over what passes.
    pub slant: f32,
    /// Mean of `x²` over what passes.
    pub squared: f32,
}

impl Passed {
    /// From the means over diffuse light of the fraction that passes, of that times `x`, and times `x²`.
    pub(super) fn of_sums([passed, slant, squared]: [f32; 3]) -> Self {
        let over = if passed > 0.0 { 1.0 / passed } else { 0.0 };
        Self {
            mean: passed,
            slant: slant * over,
            squared: squared * over,
        }
    }

    /// Part of the way to another one.
    #[inline]
    pub(super) fn towards(self, other: Self, share: f32) -> Self {
        let mix = |from: f32, to: f32| from * (1.0 - share) + to * share;
        Self {
            mean: mix(self.mean, other.mean),
            slant: mix(self.slant, other.slant),
            squared: mix(self.squared, other.squared),
        }
    }

    /// `m`, the mean of `(1 − q x)²` over what passes.
    #[inline]
    pub(super) fn through(&self, steepness: f32) -> f32 {
        1.0 - steepness * (2.0 * self.slant - steepness * self.squared)
    }
}

/// `most · r / (r + half)` of a reflectance `r`.
#[derive(Clone, Copy, Debug)]
struct Saturating {
    most: f32,
    half: f32,
}

impl Saturating {
    const NONE: Self = Self {
        most: 0.0,
        half: 1.0,
    };

    #[inline]
    fn of(self, reflectance: f32) -> f32 {
        self.most * reflectance / (reflectance + self.half)
    }

    fn towards(self, other: Self, share: f32) -> Self {
        Self {
            most: self.most + (other.most - self.most) * share,
            half: self.half + (other.half - self.half) * share,
        }
    }
}

/// How the light depends on angle that a face sends back.
#[derive(Clone, Copy, Debug)]
struct FaceShape {
    /// More of light that comes in at a slant, since it is scattered nearer to the face.
    shallow: Saturating,
    /// More between two slanting directions.
    paired: Saturating,
    /// More onwards than back across the normal.
    onward: Saturating,
}

/// How what a leaf scatters depends on angle; the letters are those of the book.
#[derive(Clone, Copy, Debug)]
pub struct LeafShape {
    /// Steepness `q` of a leaf that lets the fraction `t` through, over `1 − t^⅛` and over `1 − t`.
    steepness: [f32; 2],
    /// How much steeper the darker face is than the other.
    contrast: f32,
    /// How much more light goes through onwards than back across the normal, and what is added to
    /// that where the leaf absorbs all.
    forward: [f32; 2],
    faces: [FaceShape; 2],
    /// Whether light along the normal goes through alike from both sides.
    is_even: bool,
}

const fn law(most: f32, half: f32) -> Saturating {
    Saturating { most, half }
}

const LIVING: LeafShape = LeafShape {
    steepness: [3.783, 0.0],
    contrast: 0.251,
    forward: [0.12, 0.094],
    faces: [
        FaceShape {
            shallow: law(0.036, 0.014),
            paired: law(0.92, 0.32),
            onward: law(0.054, 0.104),
        },
        FaceShape {
            shallow: law(0.655, 0.304),
            paired: law(1.42, 0.275),
            onward: law(0.089, 0.12),
        },
    ],
    is_even: false,
};

const DEAD: LeafShape = LeafShape {
    steepness: [0.0, 1.392],
    contrast: 0.0,
    forward: [0.079, 0.0],
    faces: [
        FaceShape {
            shallow: law(0.356, 0.01),
            paired: law(8.84, 1.0),
            onward: law(0.378, 0.708),
        },
        FaceShape {
            shallow: law(1.126, 0.235),
            paired: law(9.453, 1.0),
            onward: law(0.299, 0.407),
        },
    ],
    is_even: false,
};

impl LeafShape {
    /// Tissue that scatters evenly below its coats, as Lambert's law has it.
    pub const EVEN: Self = Self {
        steepness: [0.0; 2],
        contrast: 0.0,
        forward: [0.0; 2],
        faces: [FaceShape {
            shallow: Saturating::NONE,
            paired: Saturating::NONE,
            onward: Saturating::NONE,
        }; 2],
        is_even: false,
    };

    /// That of a leaf with these contents.
    ///
    /// Cells without water are empty, and scatter by their walls: below half as much water as dry
    /// matter the leaf is dead, from as much on it is alive, and between it is between.
    pub fn of(contents: &Contents) -> Self {
        let empty = DRY_BELOW * contents.all_dry_matter();
        let water = contents[Constituent::Water];
        let dead = if empty > 0.0 {
            ((2.0 * empty - water) / empty).clamp(0.0, 1.0)
        } else {
            0.0
        };
        LIVING
            .with_structure(contents[Constituent::Structure])
            .towards(&DEAD, dead as f32)
    }

    /// That of a leaf of which only spectra are known, which lets light along the normal through
    /// alike from both sides.
    pub fn measured() -> Self {
        Self {
            is_even: true,
            ..LIVING.with_structure(USUAL_STRUCTURE)
        }
    }

    /// The same where one side is a cut through the tissue.
    #[must_use]
    pub fn cut(mut self, side: usize) -> Self {
        self.faces[side] = Self::EVEN.faces[side];
        self
    }

    fn with_structure(mut self, structure: f64) -> Self {
        self.steepness[0] /= libm::sqrt(structure.max(1.0)) as f32;
        self
    }

    fn towards(self, other: &Self, share: f32) -> Self {
        let mix = |from: f32, to: f32| from + (to - from) * share;
        let face = |side: usize| {
            let (from, to) = (self.faces[side], other.faces[side]);
            FaceShape {
                shallow: from.shallow.towards(to.shallow, share),
                paired: from.paired.towards(to.paired, share),
                onward: from.onward.towards(to.onward, share),
            }
        };
        Self {
            steepness: [0, 1].map(|i| mix(self.steepness[i], other.steepness[i])),
            contrast: mix(self.contrast, other.contrast),
            forward: [0, 1].map(|i| mix(self.forward[i], other.forward[i])),
            faces: [face(0), face(1)],
            is_even: self.is_even,
        }
    }

    /// Whether light along the normal goes through alike from both sides.
    #[inline]
    pub(super) fn is_even(&self) -> bool {
        self.is_even
    }

    /// `q` of both faces of tissue that reflects `r` and lets `t` through, before any limit.
    #[inline]
    pub(super) fn steepness(&self, t: f32, [r_a, r_b]: [f32; 2]) -> [f32; 2] {
        let [steep, plain] = self.steepness;
        let both = steep * (1.0 - t.sqrt().sqrt().sqrt()) + plain * (1.0 - t);
        let sum = r_a + r_b;
        let unlike = if sum > 0.0 {
            self.contrast * (r_b - r_a) / sum
        } else {
            0.0
        };
        [both * (1.0 + unlike), both * (1.0 - unlike)]
    }

    /// `δ` where the fraction `absorbed` of light along the normal is absorbed.
    #[inline]
    pub(super) fn forward(&self, absorbed: f32) -> f32 {
        self.forward[0] + self.forward[1] * absorbed
    }

    /// `b`, `e` and `d` of a face that reflects `r`.
    #[inline]
    pub(super) fn sent_back(&self, side: usize, r: f32) -> [f32; 3] {
        let face = &self.faces[side];
        [face.shallow, face.paired, face.onward].map(|law| law.of(r))
    }
}
