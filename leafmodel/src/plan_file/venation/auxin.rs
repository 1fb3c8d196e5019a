//! How to mend a plan of veins that grow towards auxin.

use crate::document::keys::Keys;
use crate::shape::growth::GrowthError;
use crate::venation::plan::PlanError;

/// Reports a plan that cannot be carried out, at the key to change.
pub(super) fn report(keys: &Keys<'_>, error: &PlanError) {
    let (index, key);
    let (path, help): (&[&str], &str) = match error {
        PlanError::OriginOffBlade { index: number, .. } => {
            index = number.to_string();
            (
                &["origins", &index],
                "places are shares of the midrib's length across and along it: [0, 0] is the base, [0, 1] the apex",
            )
        }
        PlanError::TooManySteps { .. } => {
            (&["growth", "*", "length_step_segments"], "use larger steps")
        }
        PlanError::Growth(GrowthError::NeverArrives { .. }) => {
            (&["growth", "*", "along"], "use higher rates along the leaf")
        }
        PlanError::Growth(
            GrowthError::KnotCount { .. }
            | GrowthError::BadPlace { .. }
            | GrowthError::BadRate { .. },
        ) => (&["growth"], "mend the growth functions"),
        PlanError::Architecture(error) => {
            key = [&["architecture"], error.key].concat();
            (&key, error.help)
        }
        PlanError::Incompatible {
            key: "architecture",
            ..
        } => (
            &["architecture"],
            "leave out one of the two; growth may be none, isogonic or anisotropic",
        ),
        PlanError::TooManyDarts { .. } => (
            &["darts_per_segment2"],
            "use fewer darts, or larger segments or steps",
        ),
        PlanError::OriginAtBase => (
            &["origins"],
            "leave out joined_origins, or the place [0, 0]",
        ),
        PlanError::OriginsMeet { .. } => (&["origins"], "veins start from different places"),
        PlanError::YoungLeaf { .. } => (
            &["growth", "*", "across"],
            "let tissue expand: rates above 0 across and along the leaf, of the same kind",
        ),
        PlanError::TooCurved { .. }
        | PlanError::Incompatible {
            key: "gaussian_curvature",
            ..
        } => (
            &["gaussian_curvature"],
            "use a value nearer to 0, or leave it out",
        ),
        // Ranges of single numbers are checked where they are read, and only closed patterns have
        // `free_endings`.
        PlanError::Range(_) | PlanError::StartsLonger { .. } | PlanError::Incompatible { .. } => {
            (&[], "change or leave out what the message names")
        }
    };
    let path = [&["venation", "*"], path].concat();
    keys.refuse(&path, error.to_string(), help);
}
