//! Plants that have a preset only in colours other than summer's green.

use super::sources::{
    ACER_NEGUNDO, ACER_RUBRUM, ACER_SACCHARUM, AMARANTHUS, COTINUS, LITTLE_ANTHOCYANIN, by_eye,
    carotenoids, chlorophyll, dry_matter, flora, flora_span, structure, thickness, water,
    width_by_eye,
};
use super::{BRIGHT_VEINS, LeafTraits, Lie, Quantity, VeinLook};

const SUGAR_MAPLE_CHLOROPHYLL: Quantity = chlorophyll(42.0);
/// Sugar maple.
pub(in crate::species) static SUGAR_MAPLE: LeafTraits = LeafTraits {
    preset: "sugar-maple-autumn",
    species: "Acer saccharum",
    length_mm: flora(95.0, [76.2, 152.4], ACER_SACCHARUM),
    width_mm: width_by_eye([80.0, 160.0], "about as wide as long; no flora says"),
    widest_at: width_by_eye([0.2, 0.8], "lobed; no flora says"),
    thickness_mm: thickness(0.16),
    structure: structure(1.4),
    chlorophyll: SUGAR_MAPLE_CHLOROPHYLL,
    carotenoids: carotenoids(SUGAR_MAPLE_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0085),
    dry_matter: dry_matter(0.0055),
    lie: Lie::new(5.0, 24.0, [0.022, 3.0], 0.6),
    veins: BRIGHT_VEINS,
};

const RED_MAPLE_CHLOROPHYLL: Quantity = chlorophyll(40.0);
/// Red maple.
pub(in crate::species) static RED_MAPLE: LeafTraits = LeafTraits {
    preset: "red-maple-autumn",
    species: "Acer rubrum",
    length_mm: flora(80.0, [50.8, 101.6], ACER_RUBRUM),
    width_mm: width_by_eye([50.0, 100.0], "about as wide as long; no flora says"),
    widest_at: width_by_eye([0.2, 0.8], "lobed; no flora says"),
    thickness_mm: thickness(0.17),
    structure: structure(1.5),
    chlorophyll: RED_MAPLE_CHLOROPHYLL,
    carotenoids: carotenoids(RED_MAPLE_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.0088),
    dry_matter: dry_matter(0.0058),
    lie: Lie::new(7.0, 20.0, [0.012, 2.5], 0.6),
    veins: BRIGHT_VEINS,
};

const COTINUS_CHLOROPHYLL: Quantity = chlorophyll(35.0);
/// Smoke tree: its chlorophyll and carotenoids are those of the purple cultivar.
pub(in crate::species) static SMOKE_TREE: LeafTraits = LeafTraits {
    preset: "cotinus",
    species: "Cotinus coggygria, purple-leaved",
    length_mm: flora(62.0, [30.0, 80.0], COTINUS),
    width_mm: flora_span([25.0, 60.0], COTINUS),
    widest_at: width_by_eye([0.45, 0.75], "broadly elliptic to obovate"),
    thickness_mm: thickness(0.22),
    structure: structure(1.7),
    chlorophyll: COTINUS_CHLOROPHYLL,
    carotenoids: carotenoids(COTINUS_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.010),
    dry_matter: dry_matter(0.006),
    lie: Lie::new(9.0, 14.0, [0.008, 2.5], 0.6),
    veins: VeinLook {
        pigments: 0.2,
        full_over_finest: 5.0,
        sheath_over_finest: 5.0,
    },
};

const BOX_ELDER_CHLOROPHYLL: Quantity = chlorophyll(33.0);
/// Box elder: one of its leaflets.
pub(in crate::species) static BOX_ELDER: LeafTraits = LeafTraits {
    preset: "acer-variegated",
    species: "Acer negundo 'Variegatum' (the largest leaflet)",
    length_mm: flora(75.0, [50.0, 100.0], ACER_NEGUNDO),
    width_mm: width_by_eye([25.0, 60.0], "oval, says the flora"),
    widest_at: width_by_eye([0.25, 0.6], "oval, says the flora"),
    thickness_mm: thickness(0.16),
    structure: structure(1.4),
    chlorophyll: BOX_ELDER_CHLOROPHYLL,
    carotenoids: carotenoids(BOX_ELDER_CHLOROPHYLL),
    anthocyanins: LITTLE_ANTHOCYANIN,
    water: water(0.009),
    dry_matter: dry_matter(0.0045),
    lie: Lie::new(10.0, 24.0, [0.014, 2.5], 0.6),
    veins: VeinLook {
        pigments: 0.3,
        full_over_finest: 5.0,
        sheath_over_finest: 5.0,
    },
};

const AMARANTH_CHLOROPHYLL: Quantity = chlorophyll(32.0);
/// Joseph's coat, a leaf near the top of the shoot.
pub(in crate::species) static AMARANTH: LeafTraits = LeafTraits {
    preset: "amaranth",
    species: "Amaranthus tricolor, a leaf near the top",
    length_mm: flora(95.0, [40.0, 100.0], AMARANTHUS),
    width_mm: flora_span([20.0, 70.0], AMARANTHUS),
    widest_at: width_by_eye([0.25, 0.6], "ovate-rhombic"),
    thickness_mm: thickness(0.24),
    structure: structure(1.5),
    chlorophyll: AMARANTH_CHLOROPHYLL,
    carotenoids: carotenoids(AMARANTH_CHLOROPHYLL),
    anthocyanins: by_eye(0.0, [0.0, 0.1], "its order makes betalains in their place"),
    water: water(0.017),
    dry_matter: dry_matter(0.004),
    lie: Lie::new(12.0, 34.0, [0.02, 3.0], 0.9),
    veins: VeinLook {
        pigments: 0.45,
        full_over_finest: 6.0,
        sheath_over_finest: 5.0,
    },
};
