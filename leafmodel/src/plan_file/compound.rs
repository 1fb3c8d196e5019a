//! How to mend leaflets that are in each other's way.

use crate::compound::{Arrangement, CompoundError};
use crate::document::Keys;
use crate::leaf::LeafPlan;

/// Reports leaflets that are in each other's way, at the key to change; `keys` are the leaf's.
pub(super) fn check(plan: &LeafPlan, keys: &Keys<'_>) {
    let Some(form) = &plan.compound else {
        return;
    };
    let Err(error) = form.arrange(plan) else {
        return;
    };
    let (key, help) = match (&error, &form.arrangement) {
        (CompoundError::OnStalk { .. }, _) => (
            "petiolule",
            "let leaflets stand on longer stalks, or at wider angles",
        ),
        (CompoundError::RolledUp { .. }, _) => (
            "curl_deg",
            "use less curl, a longer petiole, or pinnae that do not reach beyond the main axis",
        ),
        (CompoundError::TooMany { .. }, Arrangement::Bipinnate { .. }) => {
            ("leaflets", "use fewer pairs, here or of pinnae")
        }
        (CompoundError::TooMany { .. } | CompoundError::Range(_), _) => {
            ("pairs", "use fewer pairs")
        }
        // Right before left: these two are opposite each other.
        (CompoundError::Overlap { first, second }, Arrangement::Pinnate(_))
            if first % 2 == 0 && second - first == 1 =>
        {
            (
                "angles_deg",
                "use wider angles, longer petiolules, or leaflets that are narrower at the base",
            )
        }
        (_, Arrangement::Pinnate(_)) => (
            "rachis",
            "use a longer rachis, or narrower or fewer leaflets",
        ),
        // All round, the last comes up to the first from the other side.
        (
            CompoundError::Overlap { first: 0, second },
            Arrangement::Palmate {
                leaflets, spread, ..
            },
        ) if second + 1 == *leaflets as usize && *spread > std::f64::consts::PI => (
            "spread_deg",
            "use a smaller spread, longer petiolules, or narrower leaflets",
        ),
        (_, Arrangement::Palmate { .. }) => (
            "spread_deg",
            "use a wider spread, longer petiolules, or narrower or fewer leaflets",
        ),
        (_, Arrangement::Bipinnate { .. }) => (
            "pinnae",
            "use a longer rachis, of pinnae or of their leaflets, or narrower or fewer leaflets",
        ),
    };
    keys.refuse(&["compound", "*", key], error.to_string(), help);
}
