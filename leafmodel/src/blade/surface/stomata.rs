//! Stomata: how many a face has, of which size, and how they lie.

use super::super::tissue::TissueError;

/// The stomata of both faces: elliptic pits in the epidermis.
///
/// They number 5 to 1000 per mm² and are 10 to 80 µm long, and where there are more they are
/// smaller (Hetherington and Woodward 2003, Nature 424:901).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StomataPlan {
    /// Stomata per mm² of the adaxial and of the abaxial face, each 0 or 1 to 2000.
    pub per_mm2: [f64; 2],
    /// Length of a pit, µm, 5 to 120.
    pub length_um: f64,
    /// Its width over its length, 0.2 to 1.
    pub aspect: f64,
    /// Its depth below the outer wall, µm, 0 to 30.
    pub depth_um: f64,
    /// Distance between rows that run along the veins, µm, 20 to 1000; 0 if they lie scattered.
    pub row_um: f64,
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
    pub fn are_there(&self) -> bool {
        self.per_mm2.iter().any(|&density| density > 0.0) && self.depth_um > 0.0
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`TissueError`] for the first field out of range, by name.
    pub fn validate(&self) -> Result<(), TissueError> {
        let counted = |value: f64| value == 0.0 || (1.0..=2000.0).contains(&value);
        let row = self.row_um == 0.0 || (20.0..=1000.0).contains(&self.row_um);
        let [adaxial, abaxial] = self.per_mm2;
        let count = "0, or from 1 to 2000";
        let fields = [
            ("stomata.adaxial_per_mm2", adaxial, counted(adaxial), count),
            ("stomata.abaxial_per_mm2", abaxial, counted(abaxial), count),
            (
                "stomata.length_um",
                self.length_um,
                (5.0..=120.0).contains(&self.length_um),
                "from 5 to 120",
            ),
            (
                "stomata.aspect",
                self.aspect,
                (0.2..=1.0).contains(&self.aspect),
                "from 0.2 to 1",
            ),
            (
                "stomata.depth_um",
                self.depth_um,
                (0.0..=30.0).contains(&self.depth_um),
                "from 0 to 30",
            ),
            ("stomata.row_um", self.row_um, row, "0, or from 20 to 1000"),
        ];
        for (field, value, valid, text) in fields {
            TissueError::unless(valid, field, value, text)?;
        }
        Ok(())
    }
}
