//! `unevenness`: greens that differ from place to place.

use crate::blade::unevenness::Unevenness;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::Number;

/// The keys of `unevenness`.
pub(super) fn unevenness(value: &mut Unevenness, keys: &mut Keys<'_>) {
    let number = |least, most| Number(Limits::closed(least, most));
    let about = "Coefficient of variation of chlorophyll from field to field between veins of the \
        first three orders.";
    keys.key("fields", &mut value.fields, number(0.0, 0.3), about);
    let about = "Coefficient of variation of chlorophyll from patch to patch.";
    keys.key("patches", &mut value.patches, number(0.0, 0.3), about);
    let about = "Size of the patches.";
    keys.key("patch_mm", &mut value.patch_mm, number(0.5, 500.0), about);
    let about = "Share of the chlorophyll that tissue at primaries lacks.";
    let share = number(0.0, 0.9);
    keys.key("along_primaries", &mut value.along_primaries, share, about);
    let about = "Distance from the axes of primaries over which that falls to 1/e.";
    keys.key("reach_mm", &mut value.reach_mm, number(0.05, 100.0), about);
}
