//! How to mend an architecture that cannot be grown.

use crate::venation::architecture::ArchitectureError;

/// The key to change, and what to write instead.
pub(super) fn remedy(error: &ArchitectureError) -> (&'static [&'static str], &'static str) {
    match error {
        ArchitectureError::Range(_) => (&["architecture"], "use a number in range"),
        ArchitectureError::LateralPrimaries { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "name an angle for each lateral primary of one side, or choose another pattern",
        ),
        ArchitectureError::LateralCount { .. } => (
            &["architecture", "lateral_primaries"],
            "only parallelodromous and campylodromous leaves have a number of them",
        ),
        ArchitectureError::NoSecondaries { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use 0, or choose another pattern",
        ),
        ArchitectureError::PrimariesTooClose { .. } => (
            &["architecture"],
            "use fewer primaries or a wider fork_spacing, or a longer young leaf: \
             initial_length_segments",
        ),
        ArchitectureError::NotAscending { key: "span", .. } => (
            &["architecture", "secondaries", "span"],
            "write the lower place first",
        ),
        ArchitectureError::NotAscending { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "begin with the angle nearest to the midrib",
        ),
        ArchitectureError::TooFewTeeth { .. } => (
            &["architecture", "secondaries", "ending"],
            "give the outline teeth, use fewer pairs, or let the secondaries end inside the \
             margin: eucamptodromous or brochidodromous",
        ),
        ArchitectureError::TooFewSinuses { .. } => (
            &["architecture", "secondaries", "ending"],
            "give the outline lobes or teeth, use fewer pairs, or let the secondaries end inside \
             the margin: eucamptodromous or brochidodromous",
        ),
        ArchitectureError::NoBearers { .. } => (
            &["architecture", "secondaries", "agrophic"],
            "use \"absent\", or pinnate primaries with as many pairs",
        ),
        ArchitectureError::NoComb { .. } => (
            &["architecture", "secondaries", "agrophic"],
            "use \"absent\", a span that starts higher, or an outline that is wider or has more \
             teeth near its base",
        ),
        ArchitectureError::NoTertiaries => (
            &["architecture", "quaternaries", "course"],
            "use \"reticulate\", or percurrent tertiaries",
        ),
        ArchitectureError::QuaternariesTooClose { .. } => (
            &["architecture", "quaternaries", "spacing"],
            "use a wider spacing, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::TooManyPairs { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use fewer pairs, a wider span, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::NoWay { .. } => (
            &["architecture", "secondaries", "pairs"],
            "use fewer pairs, or a span that starts above the lateral primaries",
        ),
        ArchitectureError::TertiariesTooClose { .. }
        | ArchitectureError::NoRoomForQuaternaries { .. } => (
            &["architecture", "tertiaries", "spacing"],
            "use a wider spacing, or a longer young leaf: initial_length_segments",
        ),
        ArchitectureError::PrimariesOffBlade { .. } => (
            &["architecture", "lateral_primary_angles_deg"],
            "use smaller angles, or a greater part_at: higher up the blade is wider",
        ),
        ArchitectureError::MidribOffBlade => (
            &["architecture"],
            "leave the architecture out, or draw an outline that holds its midrib",
        ),
    }
}
