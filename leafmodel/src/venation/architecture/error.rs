//! Why architectures cannot be grown.

use thiserror::Error;

use crate::document::ranges::RangeError;

/// Why an architecture cannot be grown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ArchitectureError {
    /// A number outside its range.
    #[error("architecture: {0}")]
    Range(#[from] RangeError),
    /// Lateral primaries where there are none, or none where there are some.
    #[error(
        "{pattern} venation has {wanted} lateral primaries a side; lateral_primary_angles_deg names {named}"
    )]
    LateralPrimaries {
        /// The pattern.
        pattern: &'static str,
        /// What it has.
        wanted: &'static str,
        /// How many are named.
        named: usize,
    },
    /// A number of lateral primaries that the pattern cannot have.
    #[error("{pattern} venation has {wanted} lateral_primaries a side, not {laterals}")]
    LateralCount {
        /// The pattern.
        pattern: &'static str,
        /// What it has.
        wanted: &'static str,
        /// How many are asked for.
        laterals: u32,
    },
    /// Secondaries between primaries that leave them no room.
    #[error("{pattern} venation has no secondaries between its primaries, not {pairs} pairs")]
    NoSecondaries {
        /// The pattern.
        pattern: &'static str,
        /// Pairs asked for.
        pairs: u32,
    },
    /// Primaries nearer to each other than vein segments are long.
    #[error(
        "primaries {apart:.2} segments of the young leaf apart, less than 3, cannot be told from each other"
    )]
    PrimariesTooClose {
        /// Segments between neighbours.
        apart: f64,
    },
    /// Angles or places that do not ascend.
    #[error("{key} does not ascend: {first} is followed by {second}")]
    NotAscending {
        /// Which list.
        key: &'static str,
        /// A number.
        first: f64,
        /// The next one.
        second: f64,
    },
    /// Secondaries that would run into teeth that are not there.
    #[error(
        "{ending} secondaries end in teeth or lobes: {pairs} pairs need as many a side, and the outline has {right} on the right and {left} on the left"
    )]
    TooFewTeeth {
        /// The ending.
        ending: &'static str,
        /// Pairs asked for.
        pairs: u32,
        /// Teeth and lobes on the right.
        right: usize,
        /// Teeth and lobes on the left.
        left: usize,
    },
    /// More secondaries than the young leaf has room for.
    #[error(
        "{pairs} pairs of secondaries lie {apart:.1} segments apart in the young leaf, less than 4; {fit} pairs fit"
    )]
    TooManyPairs {
        /// Pairs asked for.
        pairs: u32,
        /// Segments between neighbours.
        apart: f64,
        /// Pairs that fit.
        fit: u32,
    },
    /// Secondaries that lateral primaries or the margin leave no room for.
    #[error(
        "of {pairs} pairs of secondaries only {fit} on one side of the midrib have a way to the margin"
    )]
    NoWay {
        /// Pairs asked for.
        pairs: u32,
        /// Those that fit.
        fit: u32,
    },
    /// Tertiaries nearer to each other than vein segments are long.
    #[error(
        "tertiaries {apart:.2} segments of the young leaf apart, less than 2.5, cannot be told from each other; a spacing of {least:.4} or more can"
    )]
    TertiariesTooClose {
        /// Segments between neighbours.
        apart: f64,
        /// The least spacing that fits, share of the leaf's length.
        least: f64,
    },
    /// Lateral primaries that point away from the blade where they part from the midrib.
    #[error(
        "of {asked} lateral primaries only {fit} point into the blade where they part from the midrib"
    )]
    PrimariesOffBlade {
        /// Lateral primaries asked for.
        asked: usize,
        /// Those that fit.
        fit: usize,
    },
    /// A midrib that leaves the blade.
    #[error(
        "the straight way from base to apex leaves the blade: a midrib cannot be laid out on it"
    )]
    MidribOffBlade,
    /// Secondaries that would run into sinuses that are not there.
    #[error(
        "sinus secondaries end between teeth or lobes: {pairs} pairs need as many sinuses a side, and the outline has {right} on the right and {left} on the left"
    )]
    TooFewSinuses {
        /// Pairs asked for.
        pairs: u32,
        /// Sinuses on the right.
        right: usize,
        /// Sinuses on the left.
        left: usize,
    },
    /// Agrophic veins where no secondary can bear them.
    #[error("{kind} agrophic veins leave the {bearers} of pinnate venation; {there}")]
    NoBearers {
        /// Which agrophic veins.
        kind: &'static str,
        /// What would bear them.
        bearers: &'static str,
        /// What is there instead.
        there: String,
    },
    /// Agrophic veins that find no teeth or no room.
    #[error(
        "a comb of agrophic veins has 2 or more; {fit} of one {ending} comb find a way {to} outside its secondary"
    )]
    NoComb {
        /// How the secondaries end.
        ending: &'static str,
        /// Veins of the poorest comb.
        fit: usize,
        /// Where they would end.
        to: &'static str,
    },
    /// Quaternaries between tertiaries that are not laid out.
    #[error(
        "quaternaries that are laid out lie between percurrent tertiaries, and the tertiaries are reticulate"
    )]
    NoTertiaries,
    /// Tertiaries that leave quaternaries no room.
    #[error(
        "tertiaries {apart:.2} segments of the young leaf apart leave quaternaries no room, which takes 5; a spacing of {least:.4} or more does"
    )]
    NoRoomForQuaternaries {
        /// Segments between tertiaries.
        apart: f64,
        /// The least spacing of tertiaries that fits, share of the leaf's length.
        least: f64,
    },
    /// Quaternaries nearer to each other than vein segments are long.
    #[error(
        "quaternaries {apart:.2} segments of the young leaf apart, less than 2.5, cannot be told from each other; a spacing of {least:.4} or more can"
    )]
    QuaternariesTooClose {
        /// Segments between neighbours.
        apart: f64,
        /// The least spacing that fits, share of the leaf's length.
        least: f64,
    },
}
