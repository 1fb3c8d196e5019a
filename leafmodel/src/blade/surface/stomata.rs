//! Stomata: how many a face has, of which size, and how they lie.

use crate::document::{Declared, Keys, RangeError};

/// The stomata of both faces: elliptic pits in the epidermis.
///
/// They number 5 to 1000 per mm² and are 10 to 80 µm long, and where there are more they are
/// smaller (Hetherington and Woodward 2003, Nature 424:901).
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = refuse_few)]
pub struct StomataPlan {
    /// Stomata per mm² of the adaxial face, away from veins: 0 for none, else from 1.
    #[key("adaxial_per_mm2", 0.0..=2000.0, at = 0)]
    /// Stomata per mm² of the abaxial face. Most leaves have 50 to 500 there.
    #[key("abaxial_per_mm2", 0.0..=2000.0, at = 1)]
    pub per_mm2: [f64; 2],
    /// Length of a pit. Where there are more stomata they are smaller.
    #[key("length_um", 5.0..=120.0)]
    pub length_um: f64,
    /// Width of a pit over its length.
    #[key("aspect", 0.2..=1.0)]
    pub aspect: f64,
    /// Depth of a pit.
    #[key("depth_um", 0.0..=30.0)]
    pub depth_um: f64,
    /// Distance between rows that run along the veins, as in grasses: 0 if stomata lie scattered,
    /// else from 20.
    #[key("row_um", 0.0..=1000.0)]
    pub row_um: f64,
}

fn refuse_few(plan: &mut StomataPlan, keys: &mut Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    let help = "rows of stomata are some 50 to 300 µm apart; write 0 for scattered ones";
    keys.refuse_gap("row_um", plan.row_um, [20.0, 1000.0], help);
    let help = "leaves have 5 to 1000 a mm²; write 0 for none";
    let [adaxial, abaxial] = plan.per_mm2;
    keys.refuse_gap("adaxial_per_mm2", adaxial, [1.0, 2000.0], help);
    keys.refuse_gap("abaxial_per_mm2", abaxial, [1.0, 2000.0], help);
}

impl StomataPlan {
    /// Faces without stomata.
    pub const NONE: Self = Self {
        per_mm2: [0.0; 2],
        length_um: 25.0,
        aspect: 0.6,
        depth_um: 2.0,
        row_um: 0.0,
    };

    /// Whether a face has any.
    pub(crate) fn are_there(&self) -> bool {
        self.per_mm2.iter().any(|&density| density > 0.0) && self.depth_um > 0.0
    }

    /// Checks the numbers that are 0 or from a least value on.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for the first field out of range, by name.
    pub(super) fn validate(&self) -> Result<(), RangeError> {
        let [adaxial, abaxial] = self.per_mm2;
        let counted = |value: f64| value == 0.0 || value >= 1.0;
        let count = "0, or 1 to 2000";
        RangeError::unless(counted(adaxial), "stomata.adaxial_per_mm2", adaxial, count)?;
        RangeError::unless(counted(abaxial), "stomata.abaxial_per_mm2", abaxial, count)?;
        let valid = self.row_um == 0.0 || self.row_um >= 20.0;
        RangeError::unless(valid, "stomata.row_um", self.row_um, "0, or 20 to 1000")
    }
}
