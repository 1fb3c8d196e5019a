//! One wave of teeth: its numbers, and the form of a tooth.

use crate::document::{Declared, Words};
use crate::shape::tips::Tip;

/// One wave along each side of a margin.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct ToothWave {
    /// Teeth between base and apex, equally long along the margin.
    ///
    /// Teeth on each side, of equal length along the margin but for [`Self::spacing_cv`].
    #[key("per_side", required, 1..=1000)]
    pub per_side: u32,
    /// How far they stand out, as a share of the leaf's length.
    #[key("height", required, 1e-6..=0.5)]
    pub height: f64,
    /// 0 even triangles, 1 saw teeth that point to the apex, −1 to the base.
    ///
    /// Where the tip of a tooth points: 0 gives symmetric triangles; 1 gives saw teeth whose
    /// upright side faces the apex, −1 the base.
    #[key("lean", -1.0..=1.0)]
    pub lean: f64,
    /// Share of the side from the base over which teeth rise to their height.
    #[key("fade_base", 0.0..=1.0)]
    pub fade_base: f64,
    /// Share of the side up to the apex over which they fall off.
    #[key("fade_apex", 0.0..=1.0)]
    pub fade_apex: f64,
    /// How their flanks run: straight, bulging, or hollow and drawn out into a spine.
    #[key("form", word)]
    pub form: ToothForm,
    /// Coefficient of variation of their lengths along the margin.
    #[key("spacing_cv", 0.0..=0.5)]
    pub spacing_cv: f64,
    /// Coefficient of variation of their heights.
    #[key("height_cv", 0.0..=0.5)]
    pub height_cv: f64,
    /// Whether they stand on the teeth of the wave before, as many on each.
    #[key("nested")]
    pub nested: bool,
    /// What ends each of them.
    #[key("tip", block)]
    pub tip: Option<Tip>,
}

/// How the flanks of a tooth run.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Words)]
pub enum ToothForm {
    /// Straight: dentate, or serrate where teeth lean.
    #[default]
    Triangular,
    /// Bulging, with sharp notches.
    Crenate,
    /// Hollow, drawn out into a spine, with round notches.
    Spinose,
}

impl Default for ToothWave {
    /// One low triangle.
    fn default() -> Self {
        Self {
            per_side: 1,
            height: 0.01,
            lean: 0.0,
            fade_base: 0.0,
            fade_apex: 0.0,
            form: ToothForm::Triangular,
            spacing_cv: 0.0,
            height_cv: 0.0,
            nested: false,
            tip: None,
        }
    }
}

impl ToothForm {
    /// Points of a flank between its ends, as shares of it.
    fn bends(self) -> &'static [f64] {
        match self {
            Self::Triangular => &[],
            // Closer where it is steep.
            Self::Crenate => &[0.03, 0.12, 0.27, 0.45, 0.7],
            Self::Spinose => &[0.3, 0.5, 0.65, 0.8, 0.9],
        }
    }

    /// Height at a share of a flank.
    fn height(self, share: f64) -> f64 {
        match self {
            Self::Triangular => share,
            Self::Crenate => (share * (2.0 - share)).sqrt(),
            Self::Spinose => share * share * share,
        }
    }
}

impl ToothWave {
    /// Where a tooth is highest, as a share of it.
    pub(super) fn summit(&self) -> f64 {
        f64::midpoint(1.0, self.lean)
    }

    /// Height at a share of a tooth, over that of the tooth.
    pub(super) fn profile(&self, within: f64) -> f64 {
        let tip = self.summit();
        let rise = if within <= tip && tip > 0.0 {
            within / tip
        } else {
            1.0
        };
        let fall = if within >= tip && tip < 1.0 {
            (1.0 - within) / (1.0 - tip)
        } else {
            1.0
        };
        self.form.height(rise.min(fall))
    }

    /// Factor on the height at a share of the side.
    pub(super) fn faded(&self, height: f64, share: f64) -> f64 {
        let fade = |from_end: f64, over: f64| {
            if from_end < over {
                from_end / over
            } else {
                1.0
            }
        };
        height * fade(share, self.fade_base) * fade(1.0 - share, self.fade_apex)
    }

    /// Shares of a tooth at which it bends: its notch, its summit, and points of hollow or bulging
    /// flanks.
    pub(super) fn bends(&self) -> Vec<f64> {
        let tip = self.summit();
        let mut bends = vec![0.0, tip];
        for share in self.form.bends() {
            bends.extend((tip > 0.0).then_some(share * tip));
            bends.extend((tip < 1.0).then_some(1.0 - share * (1.0 - tip)));
        }
        bends
    }
}
