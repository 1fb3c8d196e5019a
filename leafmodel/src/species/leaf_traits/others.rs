//! Climbers, herbs and houseplants, and a petal.

use super::sources::{
    ALCHEMILLA_FLORA, CODIAEUM, HEDERA, LITTLE_ANTHOCYANIN, PHRAGMITES, TRILLIUM_FLORA, by_eye,
    carotenoids, chlorophyll, dry_matter, flora, flora_span, related, structure, thickness, water,
    width_by_eye,
};
use super::{BRIGHT_VEINS, BURIED_VEINS, HOMOBARIC_VEINS, LeafTraits, Lie, Quantity, VeinLook};

const ALCHEMILLA_CHLOROPHYLL: Quantity = chlorophyll(36.0);
/// Lady's mantle.
pub(in crate::species) static ALCHEMILLA: LeafTraits = LeafTraits {
    preset: "alchemilla",
    species: "Alchemilla vulgaris in the wide sense",
    length_mm: flora(45.0, [30.0, 50.0], ALCHEMILLA_FLORA),
    width_mm: flora_span([60.0, 80.0], ALCHEMILLA_FLORA),
    widest_at: width_by_eye([0.0, 0.6], "orbicular, about the petiole"),
    thickness_mm: thickness(0.2),
    structure: structure(1.5),
    chlorophyll: ALCHEMILLA_CHLOROPHYLL,
    carotenoids: carotenoids(ALCHEMILLA_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0105),
    dry_matter: dry_matter(0.0055),
    lie: Lie::new(8.0, 8.0, [0.03, 4.0], 0.8),
    veins: BRIGHT_VEINS,
};

const IVY_CHLOROPHYLL: Quantity = chlorophyll(58.0);
/// Ivy, a leaf of a climbing shoot.
pub(in crate::species) static IVY: LeafTraits = LeafTraits {
    preset: "ivy",
    species: "Hedera helix",
    length_mm: flora(65.0, [30.0, 100.0], HEDERA),
    width_mm: flora_span([30.0, 100.0], HEDERA),
    widest_at: width_by_eye([0.1, 0.6], "lobed; no flora says"),
    thickness_mm: related(
        0.3,
        [0.25, 0.35],
        "buckley2017",
        "302 µm in Hedera canariensis; a range of 50 µm about it",
    ),
    structure: structure(1.9),
    chlorophyll: IVY_CHLOROPHYLL,
    carotenoids: carotenoids(IVY_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.019),
    dry_matter: dry_matter(0.0092),
    lie: Lie::new(3.0, 10.0, [0.012, 2.5], 0.4),
    veins: HOMOBARIC_VEINS,
};

const GRASS_CHLOROPHYLL: Quantity = chlorophyll(45.0);
/// Common reed: a piece of its blade.
pub(in crate::species) static GRASS: LeafTraits = LeafTraits {
    preset: "grass",
    species: "Phragmites australis (a piece of a blade)",
    length_mm: by_eye(60.0, [10.0, 500.0], "a piece, as long as it takes"),
    width_mm: flora_span([10.0, 30.0], PHRAGMITES),
    widest_at: width_by_eye([0.0, 1.0], "a piece has parallel sides"),
    thickness_mm: thickness(0.2),
    structure: structure(1.5),
    chlorophyll: GRASS_CHLOROPHYLL,
    carotenoids: carotenoids(GRASS_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0105),
    dry_matter: dry_matter(0.0062),
    lie: Lie::new(16.0, 45.0, [0.004, 2.0], 0.5),
    veins: VeinLook {
        pigments: 0.3,
        full_over_finest: 4.0,
        sheath_over_finest: 4.0,
    },
};

const ORCHID_CHLOROPHYLL: Quantity = chlorophyll(40.0);
/// A thin-leaved orchid; the figure names no species.
pub(in crate::species) static ORCHID: LeafTraits = LeafTraits {
    preset: "orchid",
    species: "Orchidaceae, thin-leaved",
    length_mm: by_eye(120.0, [50.0, 300.0], "no species is named"),
    width_mm: width_by_eye([20.0, 100.0], "no species is named"),
    widest_at: width_by_eye([0.35, 0.65], "elliptic"),
    thickness_mm: thickness(0.28),
    structure: structure(1.6),
    chlorophyll: ORCHID_CHLOROPHYLL,
    carotenoids: carotenoids(ORCHID_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.016),
    dry_matter: dry_matter(0.006),
    lie: Lie::new(9.0, 35.0, [0.012, 2.0], 0.7),
    veins: VeinLook {
        pigments: 0.3,
        full_over_finest: 5.0,
        sheath_over_finest: 5.0,
    },
};

const TRILLIUM_CHLOROPHYLL: Quantity = by_eye(
    0.1,
    [0.0, 1.0],
    "white petals hold next to none; no figure for the species",
);
/// White trillium, a petal.
pub(in crate::species) static TRILLIUM: LeafTraits = LeafTraits {
    preset: "trillium",
    species: "Trillium grandiflorum (a petal)",
    length_mm: flora(55.0, [30.0, 80.0], TRILLIUM_FLORA),
    width_mm: width_by_eye([20.0, 50.0], "broad, says the flora"),
    widest_at: width_by_eye([0.3, 0.7], "elliptic to obovate"),
    thickness_mm: by_eye(0.25, [0.1, 0.4], "no figure for the species"),
    structure: by_eye(
        2.5,
        [1.5, 4.0],
        "as white as a petal looks: much air between cells",
    ),
    chlorophyll: TRILLIUM_CHLOROPHYLL,
    carotenoids: by_eye(
        0.08,
        [0.0, 1.0],
        "white petals hold next to none; no figure for the species",
    ),
    anthocyanins: by_eye(
        0.0,
        [0.0, 1.0],
        "white petals hold next to none; no figure for the species",
    ),
    water: by_eye(0.018, [0.005, 0.04], "no figure for the species"),
    dry_matter: by_eye(0.0018, [0.0005, 0.004], "no figure for the species"),
    lie: Lie::new(14.0, 55.0, [0.035, 2.5], 0.4),
    veins: VeinLook {
        pigments: 3.0,
        full_over_finest: 5.0,
        sheath_over_finest: 5.0,
    },
};

const CROTON_CHLOROPHYLL: Quantity = chlorophyll(48.0);
/// Croton, a green one.
pub(in crate::species) static CROTON: LeafTraits = LeafTraits {
    preset: "croton",
    species: "Codiaeum variegatum",
    length_mm: flora(150.0, [50.0, 300.0], CODIAEUM),
    width_mm: flora_span([5.0, 80.0], CODIAEUM),
    widest_at: flora_span([0.35, 0.65], CODIAEUM),
    thickness_mm: thickness(0.36),
    structure: structure(2.0),
    chlorophyll: CROTON_CHLOROPHYLL,
    carotenoids: carotenoids(CROTON_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.02),
    dry_matter: dry_matter(0.0085),
    lie: Lie::new(8.0, 30.0, [0.012, 2.5], 0.4),
    veins: BURIED_VEINS,
};
