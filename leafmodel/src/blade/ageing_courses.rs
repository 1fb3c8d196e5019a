//! Courses of ageing by name.
//!
//! Half-lives, reaches and delays are estimates by eye. The remaining pigments are chosen so that
//! leaves end near the contents that `docs/src/theory/ageing.md` lists with their sources.

use super::ageing::{Course, Delay};
use crate::optics::Constituent::{Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water};
use crate::optics::Contents;

/// Yellow by unmasking of carotenoids: ginkgo, poplar, birch. No anthocyanin.
pub const YELLOW: Course = Course {
    onset: Delay {
        veins_days: 5.0,
        veins_reach_mm: 1.2,
        veins_order: 2,
        margin_days: 5.0,
        margin_reach_mm: 7.0,
        noise_days: 4.0,
        noise_scale_mm: 9.0,
        ..Delay::NONE
    },
    half_days: 9.0,
    steepness: 4.0,
    chlorophyll_rest: 0.8,
    labile_carotenoids: 0.3,
    persistence: 5.0,
    anthocyanins: 0.0,
    anthocyanin_days: 5.0,
    brown: 0.2,
    structure_factor: 1.1,
    water_factor: 0.85,
    dry_matter_factor: 0.9,
    death_day: 26.0,
    death: Delay {
        margin_days: 16.0,
        margin_reach_mm: 9.0,
        noise_days: 10.0,
        noise_scale_mm: 10.0,
        veins_days: 3.0,
        veins_reach_mm: 1.5,
        veins_order: 2,
        ..Delay::NONE
    },
    weathering: None,
};

/// Orange: some anthocyanin over carotenoids, as in sugar maple.
pub const ORANGE: Course = Course {
    anthocyanins: 4.0,
    brown: 0.12,
    chlorophyll_rest: 1.5,
    ..YELLOW
};

/// Scarlet, as in red maple.
pub const RED: Course = Course {
    anthocyanins: 15.0,
    labile_carotenoids: 0.45,
    brown: 0.1,
    chlorophyll_rest: 2.0,
    ..YELLOW
};

/// Purple-red, as in sweetgum: more anthocyanin, and more chlorophyll that stays.
pub const PURPLE: Course = Course {
    anthocyanins: 30.0,
    labile_carotenoids: 0.35,
    brown: 0.1,
    chlorophyll_rest: 6.0,
    ..YELLOW
};

/// Brown without much colour before, as in oak: tissue dies while it yellows.
pub const BROWN: Course = Course {
    death_day: 12.0,
    brown: 0.27,
    ..YELLOW
};

/// Courses by name.
pub const COURSES: [(&str, Course); 5] = [
    ("yellow", YELLOW),
    ("orange", ORANGE),
    ("red", RED),
    ("purple", PURPLE),
    ("brown", BROWN),
];

/// Contents of a dead, dry leaf (an estimate within the ranges of litter).
pub const LITTER: Contents = Contents::of(&[
    (Structure, 2.2),
    (Chlorophyll, 0.3),
    (Carotenoids, 1.0),
    (Brown, 1.1),
    (Water, 0.001),
    (DryMatter, 0.0045),
]);
