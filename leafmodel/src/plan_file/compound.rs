//! `petiole` and `compound`: stalks, and leaflets on them.

use crate::blade::petiole::{Course, PetiolePlan, Section};
use crate::compound::{Arrangement, CompoundError, CompoundForm, Feather};
use crate::document::keys::{Keys, Variant};
use crate::document::limits::Limits;
use crate::document::value_kind::{Degrees, DegreesList, Flag, Integer, Number, Numbers};
use crate::leaf::LeafPlan;

/// Radii of stalks, mm.
const RADII_MM: Number = Number(Limits::closed(0.001, 100.0));
/// Lengths of stalks in leaflets.
const LENGTHS: Number = Number(Limits::closed(0.01, 100.0));
/// Sizes in shares of the largest leaflet.
const SIZES: Limits = Limits::closed(0.01, 1.0);

/// A petiole of which nothing is said.
pub(super) fn usual_petiole() -> PetiolePlan {
    PetiolePlan {
        length: 0.0,
        radius_mm: None,
        curl: 0.0,
        course: Course::STRAIGHT,
        section: Section::default(),
    }
}

/// The keys of `petiole`.
pub(super) fn petiole(plan: &mut PetiolePlan, keys: &mut Keys<'_>) {
    let length = Number(Limits::closed(0.0, 10.0));
    keys.required(
        "length",
        &mut plan.length,
        length,
        "Length over the leaf's.",
    );
    let about = "Radius between its ends.";
    keys.optional("radius_mm", &mut plan.radius_mm, RADII_MM, about);
    let limits = Degrees(Limits::closed(-170.0, 170.0));
    keys.key(
        "curl_deg",
        &mut plan.curl,
        limits,
        "Angle by which it has bent towards the abaxial \
        side at its foot.",
    );
    course(&mut plan.course, keys);
    let section = &mut plan.section;
    let limits = Number(Limits::closed(0.0, 0.8));
    let about = "Depth of the groove along its adaxial side, over the radius.";
    keys.key("groove", &mut section.groove, limits, about);
    let limits = Number(Limits::closed(0.0, 0.7));
    let about = "How much narrower it is from side to side than if it were round, as an aspen's.";
    keys.key("flatness", &mut section.flatness, limits, about);
    let limits = Number(Limits::closed(0.0, 2.0));
    let about = "Thickening of its foot, over the radius.";
    keys.key("foot", &mut section.foot, limits, about);
    let limits = Number(Limits::closed(0.0, 2.0));
    let about = "Thickening below the blade (a pulvinus there), over the radius.";
    keys.key("head", &mut section.head, limits, about);
}

/// The keys of a petiole's course.
fn course(course: &mut Course, keys: &mut Keys<'_>) {
    let bends = Degrees(Limits::closed(-170.0, 170.0));
    let about = "Angle by which the blade's weight has bent it towards the abaxial side at its \
        foot; the bend grows towards the foot.";
    keys.key("sag_deg", &mut course.sag, bends, about);
    let limits = Degrees(Limits::closed(-110.0, 110.0));
    let about = "Angle by which it bends towards the abaxial side just before the blade; with an \
        opposite sag it is an S.";
    keys.key("neck_deg", &mut course.neck, limits, about);
    let limits = Number(Limits::closed(0.02, 1.0));
    let about = "Share of its length in which it does so.";
    keys.key("neck_length", &mut course.neck_length, limits, about);
    let about =
        "Angle by which it has bent to the right at its foot, adaxial side up, blade ahead.";
    keys.key("sway_deg", &mut course.sway, bends, about);
    let about = "Angle by which it is twisted between blade and foot; bends turn with it.";
    keys.key("twist_deg", &mut course.twist, bends, about);
    let limits = Degrees(Limits::closed(0.0, 55.0));
    let about = "Standard deviation, from leaf to leaf, of sag, sway, twist and of a wave in both \
        bends.";
    keys.key("stray_deg", &mut course.stray, limits, about);
}

/// A compound leaf of which nothing is said.
pub(super) fn usual_compound() -> CompoundForm {
    CompoundForm::new(palmate())
}

fn palmate() -> Arrangement {
    Arrangement::Palmate {
        leaflets: 2,
        spread: 1.0,
        sizes: [1.0; 2],
    }
}

fn rows() -> Feather {
    Feather {
        pairs: 1,
        terminal: true,
        rachis: 1.0,
        alternation: 0.0,
        angles: [1.0; 2],
        sizes: [1.0; 3],
        turn: 0.0,
    }
}

/// The kinds of `compound`, with the keys that all of them have.
const KINDS: [Variant<CompoundForm>; 3] = [
    Variant {
        name: "pinnate",
        about: "Leaflets in two rows along a rachis.",
        new: || CompoundForm::new(Arrangement::Pinnate(rows())),
        is: |form| matches!(form.arrangement, Arrangement::Pinnate(_)),
        declare: |form, keys| {
            if let Arrangement::Pinnate(rows) = &mut form.arrangement {
                feather(rows, keys);
            }
            stalks(form, keys);
        },
    },
    Variant {
        name: "palmate",
        about: "Leaflets from one point.",
        new: usual_compound,
        is: |form| matches!(form.arrangement, Arrangement::Palmate { .. }),
        declare: |form, keys| {
            if let Arrangement::Palmate {
                leaflets,
                spread,
                sizes,
            } = &mut form.arrangement
            {
                let count = Integer::within(2, 100);
                keys.required("leaflets", leaflets, count, "How many.");
                let limits = Degrees(Limits::closed(3.0, 355.0));
                let about = "Angle between the two outermost.";
                keys.required("spread_deg", spread, limits, about);
                let about = "Outermost and middle ones over the largest leaflet.";
                keys.key("sizes", sizes, Numbers(SIZES), about);
            }
            stalks(form, keys);
        },
    },
    Variant {
        name: "bipinnate",
        about: "Pinnae in two rows, each with leaflets in two rows.",
        new: || {
            CompoundForm::new(Arrangement::Bipinnate {
                pinnae: rows(),
                leaflets: rows(),
                stalk: 1.0,
            })
        },
        is: |form| matches!(form.arrangement, Arrangement::Bipinnate { .. }),
        declare: |form, keys| {
            if let Arrangement::Bipinnate {
                pinnae,
                leaflets,
                stalk,
            } = &mut form.arrangement
            {
                let about = "Length of the largest pinna's stalk, from the rachis to its first \
                    leaflets.";
                keys.required("stalk", stalk, LENGTHS, about);
                let about = "How pinnae stand on the rachis.";
                keys.required_block("pinnae", about, &[], |keys| feather(pinnae, keys));
                let about = "How leaflets stand on a pinna.";
                keys.required_block("leaflets", about, &[], |keys| feather(leaflets, keys));
            }
            stalks(form, keys);
        },
    },
];

/// The keys of `compound`.
pub(super) fn compound(form: &mut CompoundForm, keys: &mut Keys<'_>) {
    keys.kind(form, &KINDS);
}

fn stalks(form: &mut CompoundForm, keys: &mut Keys<'_>) {
    let angle = |most: f64| Degrees(Limits::closed(-most, most));
    let limits = Number(Limits::closed(0.0, 100.0));
    let about = "Length up to the first pair, or to where all leaflets stand.";
    keys.key("petiole", &mut form.petiole, limits, about);
    let limits = Number(Limits::closed(0.0, 10.0));
    let about = "Stalk of a leaflet over that leaflet's length.";
    keys.key("petiolule", &mut form.petiolule, limits, about);
    let about = "Radius of the largest leaflet's stalk; cross-sections of axes are sums of those \
        that they bear.";
    keys.key(
        "stalk_radius_mm",
        &mut form.stalk_radius_mm,
        RADII_MM,
        about,
    );
    let about = "Different leaflets that are grown, each from a seed of its own; they stand in \
        turn. Each has a mesh and a map.";
    keys.key(
        "variants",
        &mut form.variants,
        Integer::within(1, 50),
        about,
    );
    let about = "Angle through which petiole and rachis bend from end to end, towards the \
        abaxial side.";
    keys.key("curl_deg", &mut form.curl, angle(355.0), about);
    let about = "Angle by which leaflets are raised about the axis that bears them, times the \
        sine of the angle at which they stand on it.";
    keys.key("fold_deg", &mut form.fold, angle(80.0), about);
    let limits = Degrees(Limits::closed(0.0, 57.0));
    let about = "Largest angle by which each is turned by chance about its midrib, and half as \
        far across it.";
    keys.key("tilt_deg", &mut form.tilt, limits, about);
    let limits = Number(Limits::closed(0.0, 0.25));
    let about = "Standard deviation, from one to the next, of places along an axis in gaps between \
        pairs, of angles over themselves and, half as much, of sizes. Those that would come into \
        each other's way stray less.";
    keys.key("irregularity", &mut form.irregularity, limits, about);
}

/// The keys of two rows along a rachis.
fn feather(rows: &mut Feather, keys: &mut Keys<'_>) {
    keys.required(
        "rachis",
        &mut rows.rachis,
        LENGTHS,
        "Length from the first pair to the end, in leaflets; of `pinnae` over the largest \
            pinna's rachis.",
    );
    let pairs = Integer::within(1, 200);
    keys.required("pairs", &mut rows.pairs, pairs, "Pairs along the rachis.");
    keys.key(
        "terminal",
        &mut rows.terminal,
        Flag,
        "Whether one more stands at the end.",
    );
    let limits = Number(Limits::closed(0.0, 0.9));
    let about = "How far the left ones stand towards the tip, in gaps between pairs: 0 opposite, \
        0.5 alternate.";
    keys.key("alternation", &mut rows.alternation, limits, about);
    let limits = DegreesList(Limits::closed(3.0, 170.0));
    let about = "Angle from the rachis of the first pair and the last, linear between.";
    keys.required("angles_deg", &mut rows.angles, limits, about);
    let about = "First pair, one half-way, last, over the largest.";
    keys.key("sizes", &mut rows.sizes, Numbers(SIZES), about);
    let limits = Degrees(Limits::closed(-114.0, 114.0));
    let about = "Angle by which the rachis turns to the right from end to end.";
    keys.key("turn_deg", &mut rows.turn, limits, about);
}

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
        (CompoundError::OutOfRange { .. }, Arrangement::Bipinnate { .. }) => {
            ("leaflets", "use fewer pairs, here or of pinnae")
        }
        (CompoundError::OutOfRange { .. }, _) => ("pairs", "use fewer pairs"),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_in_degrees_lie_within_those_of_the_model() {
        for end in [-1.0_f64, 1.0] {
            let rows = Feather {
                angles: [3.0_f64, 170.0].map(f64::to_radians),
                turn: (114.0 * end).to_radians(),
                ..rows()
            };
            let palmate = |spread: f64| Arrangement::Palmate {
                leaflets: 2,
                spread: spread.to_radians(),
                sizes: [1.0; 2],
            };
            for arrangement in [Arrangement::Pinnate(rows), palmate(3.0), palmate(355.0)] {
                let form = CompoundForm {
                    curl: (355.0 * end).to_radians(),
                    fold: (80.0 * end).to_radians(),
                    tilt: 57.0_f64.to_radians(),
                    ..CompoundForm::new(arrangement)
                };
                form.validate().expect("all in range");
            }
        }
    }
}
