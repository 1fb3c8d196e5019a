//! Trees and shrubs of temperate lands.

use super::sources::{
    ACER, ASPEN_FLORA, BETULA, FNA_POPULUS, GINKGO_FLORA, LIQUIDAMBAR, LITTLE_ANTHOCYANIN,
    MAGNOLIA_FLORA, PRUNUS, QUERCUS_ALBA, QUERCUS_RUBRA, SALIX, by_eye, carotenoids, chlorophyll,
    dry_matter, flora, flora_span, measured, related, structure, thickness, water, width_by_eye,
};
use super::{BRIGHT_VEINS, BURIED_VEINS, LeafTraits, Lie, Quantity, VeinLook};

const POPLAR_CHLOROPHYLL: Quantity = chlorophyll(42.0);
/// Eastern cottonwood, the species of the poplar preset.
pub(in crate::species) static POPLAR: LeafTraits = cottonwood("poplar");
/// The same for the preset with a poplar's own veins and teeth.
pub(in crate::species) static COTTONWOOD: LeafTraits = cottonwood("cottonwood");

const fn cottonwood(preset: &'static str) -> LeafTraits {
    LeafTraits {
        preset,
        species: "Populus deltoides",
        length_mm: flora(70.0, [30.0, 90.0], FNA_POPULUS),
        width_mm: flora_span([30.0, 90.0], FNA_POPULUS),
        widest_at: flora_span([0.0, 0.4], FNA_POPULUS),
        thickness_mm: thickness(0.21),
        structure: structure(1.6),
        chlorophyll: POPLAR_CHLOROPHYLL,
        carotenoids: carotenoids(POPLAR_CHLOROPHYLL),
        anthocyanins: LITTLE_ANTHOCYANIN,
        water: water(0.0115),
        dry_matter: dry_matter(0.0075),
        lie: Lie::new(6.0, 18.0, [0.012, 2.5], 0.6),
        veins: BRIGHT_VEINS,
    }
}

const ASPEN_CHLOROPHYLL: Quantity = chlorophyll(40.0);
/// Quaking aspen, a leaf of a short shoot.
pub(in crate::species) static ASPEN: LeafTraits = LeafTraits {
    preset: "aspen",
    species: "Populus tremuloides",
    length_mm: flora(50.0, [30.0, 100.0], ASPEN_FLORA),
    width_mm: flora_span([30.0, 100.0], ASPEN_FLORA),
    widest_at: flora_span([0.1, 0.5], ASPEN_FLORA),
    thickness_mm: thickness(0.18),
    structure: structure(1.5),
    chlorophyll: ASPEN_CHLOROPHYLL,
    carotenoids: carotenoids(ASPEN_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0098),
    dry_matter: dry_matter(0.0068),
    lie: Lie::new(6.0, 14.0, [0.012, 2.5], 0.6),
    veins: BRIGHT_VEINS,
};

const MAPLE_CHLOROPHYLL: Quantity = measured(
    42.0,
    [0.5, 54.0],
    "gitelson1996",
    "0.6 to 60 nmol/cm² (900 g/mol) in maple and chestnut leaves from yellow to dark green",
);
/// Norway maple.
pub(in crate::species) static MAPLE: LeafTraits = LeafTraits {
    preset: "maple",
    species: "Acer platanoides",
    length_mm: flora(90.0, [60.0, 130.0], ACER),
    width_mm: flora_span([80.0, 140.0], ACER),
    widest_at: width_by_eye([0.2, 0.8], "lobed; no flora says"),
    thickness_mm: thickness(0.16),
    structure: structure(1.4),
    chlorophyll: MAPLE_CHLOROPHYLL,
    carotenoids: carotenoids(MAPLE_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0085),
    dry_matter: dry_matter(0.0055),
    lie: Lie::new(5.0, 16.0, [0.02, 3.0], 0.6),
    veins: BRIGHT_VEINS,
};

const WHITE_OAK_CHLOROPHYLL: Quantity = chlorophyll(45.0);
/// White oak.
pub(in crate::species) static WHITE_OAK: LeafTraits = LeafTraits {
    preset: "white-oak",
    species: "Quercus alba",
    length_mm: flora(140.0, [101.6, 215.9], QUERCUS_ALBA),
    width_mm: flora_span([50.8, 114.3], QUERCUS_ALBA),
    widest_at: flora_span([0.5, 0.95], QUERCUS_ALBA),
    thickness_mm: related(
        0.16,
        [0.1306, 0.3065],
        "appalachian1981",
        "sun leaves of oaks: from 131 µm in Quercus alba to 307 µm in Q. stellata",
    ),
    structure: structure(1.55),
    chlorophyll: WHITE_OAK_CHLOROPHYLL,
    carotenoids: carotenoids(WHITE_OAK_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.008),
    dry_matter: dry_matter(0.0078),
    lie: Lie::new(7.0, 22.0, [0.015, 2.5], 0.7),
    veins: BRIGHT_VEINS,
};

const RED_OAK_CHLOROPHYLL: Quantity = chlorophyll(48.0);
/// Northern red oak.
pub(in crate::species) static RED_OAK: LeafTraits = LeafTraits {
    preset: "red-oak",
    species: "Quercus rubra",
    length_mm: flora(160.0, [100.0, 200.0], QUERCUS_RUBRA),
    width_mm: width_by_eye(
        [80.0, 150.0],
        "the flora gives no width; lobes little longer than the body is wide",
    ),
    widest_at: width_by_eye([0.3, 0.85], "lobed; no flora says"),
    thickness_mm: thickness(0.2),
    structure: structure(1.6),
    chlorophyll: RED_OAK_CHLOROPHYLL,
    carotenoids: carotenoids(RED_OAK_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0105),
    dry_matter: dry_matter(0.0085),
    lie: Lie::new(6.0, 20.0, [0.012, 2.5], 0.6),
    veins: BRIGHT_VEINS,
};

const GINKGO_CHLOROPHYLL: Quantity = measured(
    48.0,
    [43.5, 77.0],
    "lichtenthaler2023",
    "435 to 770 mg/m² in trees that were not pruned",
);
/// Ginkgo, a leaf of a short shoot.
pub(in crate::species) static GINKGO: LeafTraits = LeafTraits {
    preset: "ginkgo",
    species: "Ginkgo biloba",
    length_mm: by_eye(
        45.0,
        [30.0, 80.0],
        "so long that the width is as floras say",
    ),
    width_mm: flora_span([50.0, 80.0], GINKGO_FLORA),
    widest_at: width_by_eye([0.4, 1.0], "a fan"),
    thickness_mm: thickness(0.3),
    structure: structure(1.8),
    chlorophyll: GINKGO_CHLOROPHYLL,
    carotenoids: carotenoids(GINKGO_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0145),
    dry_matter: dry_matter(0.0088),
    lie: Lie::new(1.5, 4.0, [0.006, 4.0], 0.3),
    veins: VeinLook {
        pigments: 0.35,
        full_over_finest: 3.0,
        sheath_over_finest: 3.0,
    },
};

const BIRCH_CHLOROPHYLL: Quantity = chlorophyll(34.0);
/// Silver birch.
pub(in crate::species) static BIRCH: LeafTraits = LeafTraits {
    preset: "birch",
    species: "Betula pendula",
    length_mm: flora(55.0, [30.0, 70.0], BETULA),
    width_mm: flora_span([25.0, 55.0], BETULA),
    widest_at: flora_span([0.0, 0.4], BETULA),
    thickness_mm: thickness(0.17),
    structure: structure(1.45),
    chlorophyll: BIRCH_CHLOROPHYLL,
    carotenoids: carotenoids(BIRCH_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0085),
    dry_matter: dry_matter(0.0065),
    lie: Lie::new(9.0, 20.0, [0.01, 2.5], 0.7),
    veins: BRIGHT_VEINS,
};

const WILLOW_CHLOROPHYLL: Quantity = chlorophyll(42.0);
/// White willow.
pub(in crate::species) static WILLOW: LeafTraits = LeafTraits {
    preset: "willow",
    species: "Salix alba",
    length_mm: flora(95.0, [40.0, 150.0], SALIX),
    width_mm: flora_span([10.0, 25.0], SALIX),
    widest_at: flora_span([0.2, 0.65], SALIX),
    thickness_mm: thickness(0.2),
    structure: structure(1.65),
    chlorophyll: WILLOW_CHLOROPHYLL,
    carotenoids: carotenoids(WILLOW_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0115),
    dry_matter: dry_matter(0.0082),
    lie: Lie::new(14.0, 40.0, [0.004, 3.0], 0.6),
    veins: BRIGHT_VEINS,
};

const CHERRY_CHLOROPHYLL: Quantity = chlorophyll(40.0);
/// Nanking cherry.
pub(in crate::species) static CHERRY: LeafTraits = LeafTraits {
    preset: "cherry",
    species: "Prunus tomentosa",
    length_mm: flora(58.0, [20.0, 70.0], PRUNUS),
    width_mm: flora_span([10.0, 35.0], PRUNUS),
    widest_at: flora_span([0.35, 0.75], PRUNUS),
    thickness_mm: thickness(0.22),
    structure: structure(1.55),
    chlorophyll: CHERRY_CHLOROPHYLL,
    carotenoids: carotenoids(CHERRY_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.011),
    dry_matter: dry_matter(0.0072),
    lie: Lie::new(10.0, 24.0, [0.01, 3.0], 0.9),
    veins: VeinLook {
        pigments: 0.2,
        full_over_finest: 5.0,
        sheath_over_finest: 5.0,
    },
};

const SWEETGUM_CHLOROPHYLL: Quantity = chlorophyll(46.0);
/// Sweetgum.
pub(in crate::species) static SWEETGUM: LeafTraits = LeafTraits {
    preset: "sweetgum",
    species: "Liquidambar styraciflua",
    length_mm: by_eye(90.0, [50.0, 180.0], "shorter than wide, says the flora"),
    width_mm: flora_span([76.0, 229.0], LIQUIDAMBAR),
    widest_at: width_by_eye([0.2, 0.7], "lobed; no flora says"),
    thickness_mm: thickness(0.2),
    structure: structure(1.6),
    chlorophyll: SWEETGUM_CHLOROPHYLL,
    carotenoids: carotenoids(SWEETGUM_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.011),
    dry_matter: dry_matter(0.0078),
    lie: Lie::new(4.0, 14.0, [0.01, 2.5], 0.5),
    veins: BRIGHT_VEINS,
};

const MAGNOLIA_CHLOROPHYLL: Quantity = chlorophyll(72.0);
/// Southern magnolia.
pub(in crate::species) static MAGNOLIA: LeafTraits = LeafTraits {
    preset: "magnolia",
    species: "Magnolia grandiflora",
    length_mm: flora(170.0, [120.0, 250.0], MAGNOLIA_FLORA),
    width_mm: flora_span([60.0, 120.0], MAGNOLIA_FLORA),
    widest_at: flora_span([0.35, 0.7], MAGNOLIA_FLORA),
    thickness_mm: measured(
        0.52,
        [0.47, 0.57],
        "buckley2017",
        "521 µm; a range of 50 µm about it",
    ),
    structure: structure(2.2),
    chlorophyll: MAGNOLIA_CHLOROPHYLL,
    carotenoids: carotenoids(MAGNOLIA_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.027),
    dry_matter: dry_matter(0.017),
    lie: Lie::new(12.0, 28.0, [0.008, 2.5], 0.35),
    veins: BURIED_VEINS,
};
