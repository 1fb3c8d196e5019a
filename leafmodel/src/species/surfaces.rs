//! Surfaces of species: relief of the faces, hairs, and roughness of the coats.
//!
//! Whether a species has hairs, where and of what direction, and whether its veins are impressed or
//! prominent, is told from memory of floras and was not looked up; heights, densities and all
//! roughness are by eye.

use crate::blade::hairs::{HairPlace, HairPlan};
use crate::blade::surface::SurfacePlan;
use crate::blade::surface::stomata::StomataPlan;
use crate::blade::unevenness::Unevenness;
use crate::optics::{Constituent, Contents};

/// Relief of the faces: groove above and ridge below over the diameter of a vein, bulge and its
/// width (mm), width of cells (µm) and their length over it.
struct Relief {
    preset: &'static str,
    veins: [f64; 2],
    bulge: [f64; 2],
    cells: [f64; 2],
}

const fn relief(preset: &'static str, veins: [f64; 2], bulge: [f64; 2], cells: [f64; 2]) -> Relief {
    Relief {
        preset,
        veins,
        bulge,
        cells,
    }
}

static RELIEFS: [Relief; 18] = [
    relief("poplar", [0.08, 0.35], [0.05, 0.7], [30.0, 1.0]),
    relief("cottonwood", [0.03, 0.35], [0.03, 0.6], [30.0, 1.0]),
    relief("aspen", [0.03, 0.30], [0.03, 0.6], [28.0, 1.0]),
    relief("maple", [0.14, 0.45], [0.14, 0.6], [32.0, 1.0]),
    relief("white-oak", [0.10, 0.40], [0.06, 0.7], [25.0, 1.0]),
    relief("red-oak", [0.08, 0.40], [0.06, 0.7], [25.0, 1.0]),
    // Its dichotomous veins stand out a little on both faces.
    relief("ginkgo", [-0.15, 0.15], [0.0, 1.0], [30.0, 3.0]),
    relief("birch", [0.15, 0.40], [0.12, 0.5], [28.0, 1.0]),
    relief("willow", [0.10, 0.35], [0.03, 0.5], [20.0, 1.3]),
    relief("cherry", [0.18, 0.50], [0.25, 0.8], [30.0, 1.0]),
    relief("sweetgum", [0.08, 0.40], [0.05, 0.7], [28.0, 1.0]),
    relief("alchemilla", [0.25, 0.55], [0.5, 1.0], [40.0, 1.0]),
    relief("ivy", [-0.03, 0.15], [0.04, 0.9], [35.0, 1.0]),
    relief("magnolia", [0.02, 0.25], [0.05, 0.8], [35.0, 1.0]),
    // Ribs over the veins of both faces, and rows of long cells.
    relief("grass", [-0.30, 0.30], [0.0, 1.0], [18.0, 8.0]),
    relief("orchid", [0.06, 0.15], [0.0, 1.0], [50.0, 2.0]),
    relief("trillium", [0.15, 0.30], [0.08, 1.0], [60.0, 1.2]),
    relief("croton", [0.05, 0.30], [0.06, 0.9], [30.0, 1.0]),
];

/// GGX roughness of the adaxial coat where it is not the usual one.
static COATS: [(&str, f64); 19] = [
    ("cottonwood", 0.3),
    ("aspen", 0.32),
    ("magnolia", 0.14),
    ("ivy", 0.22),
    ("croton", 0.2),
    ("orchid", 0.25),
    ("birch", 0.3),
    ("willow", 0.28),
    ("sweetgum", 0.25),
    ("alchemilla", 0.55),
    ("cherry", 0.45),
    ("ivy-variegated", 0.22),
    ("croton-variegated", 0.2),
    ("oak-litter", 0.5),
    ("birch-autumn", 0.3),
    ("sweetgum-autumn", 0.25),
    ("cotinus", 0.45),
    ("acer-variegated", 0.4),
    ("amaranth", 0.4),
];

/// The surface of a species' leaf, by the name of its traits' preset.
pub(super) fn surface(preset: &str) -> Option<SurfacePlan> {
    let relief = RELIEFS.iter().find(|relief| relief.preset == preset)?;
    Some(SurfacePlan {
        impressed: relief.veins[0],
        raised: relief.veins[1],
        bulge_mm: relief.bulge[0],
        bulge_width_mm: relief.bulge[1],
        vein_roughness: 0.15,
        dead_roughness: DEAD_ROUGHNESS,
        young_roughness: young_roughness(preset),
        cells_um: relief.cells[0],
        cell_elongation: relief.cells[1],
        cell_share: 0.2,
        bloom: bloom(preset),
        stomata: stomata(preset),
        ..SurfacePlan::SMOOTH
    })
}

/// Roughness of the coats over dead tissue beside their own, by eye: as cells collapse the wall over
/// them wrinkles.
const DEAD_ROUGHNESS: f64 = 0.35;

/// Roughness of the coats of a leaf that has just unfolded over that of the mature one. All by eye:
/// young leaves of poplars, birches and cherries are sticky with resin or shine with stretched
/// cuticle; those of oaks and willows are dull with wax or down, which wears off (crystals of wax on
/// oak erode within weeks, \[neinhuis1998\]).
fn young_roughness(preset: &str) -> f64 {
    match preset {
        "poplar" | "cottonwood" | "birch" | "cherry" => 0.55,
        "white-oak" | "red-oak" | "willow" | "alchemilla" => 1.15,
        _ => 0.7,
    }
}

/// Stomata per mm² of both faces, length (µm), rows (µm). Orders of magnitude from memory of
/// textbooks, not looked up, within the ranges that reviews give: 65 (pawpaw) to 909 (pin oak) a mm²
/// and 5 to 35 µm in shade leaves of Appalachian hardwoods (\[carpenter1975\]); 5 to 1000 a mm² and
/// 10 to 80 µm in all plants (\[hetherington2003\]).
static STOMATA: [(&str, [f64; 2], f64, f64); 17] = [
    ("poplar", [40.0, 170.0], 24.0, 0.0),
    ("cottonwood", [110.0, 160.0], 25.0, 0.0),
    ("maple", [0.0, 330.0], 16.0, 0.0),
    ("white-oak", [0.0, 500.0], 18.0, 0.0),
    ("red-oak", [0.0, 600.0], 17.0, 0.0),
    ("ginkgo", [0.0, 110.0], 35.0, 0.0),
    ("birch", [0.0, 170.0], 26.0, 0.0),
    ("willow", [20.0, 350.0], 20.0, 0.0),
    ("cherry", [0.0, 250.0], 22.0, 0.0),
    ("sweetgum", [0.0, 200.0], 22.0, 0.0),
    ("alchemilla", [30.0, 220.0], 22.0, 0.0),
    ("ivy", [0.0, 160.0], 26.0, 0.0),
    ("magnolia", [0.0, 300.0], 22.0, 0.0),
    // On both faces, in rows beside the veins.
    ("grass", [70.0, 60.0], 42.0, 110.0),
    ("orchid", [0.0, 40.0], 45.0, 0.0),
    ("trillium", [0.0, 60.0], 45.0, 0.0),
    ("croton", [10.0, 180.0], 24.0, 0.0),
];

/// The stomata of a species' leaf.
fn stomata(preset: &str) -> StomataPlan {
    let Some((_, per_mm2, length_um, row_um)) = STOMATA.iter().find(|s| s.0 == preset) else {
        return StomataPlan::NONE;
    };
    StomataPlan {
        per_mm2: *per_mm2,
        length_um: *length_um,
        row_um: *row_um,
        // Those of grasses are dumb-bells, long and narrow.
        aspect: if *row_um > 0.0 { 0.4 } else { 0.65 },
        depth_um: 0.09 * length_um,
    }
}

/// Optical thickness of the wax on the faces: leaves that floras call glaucous beneath. By eye.
fn bloom(preset: &str) -> [f64; 2] {
    match preset {
        "willow" => [0.0, 0.25],
        "aspen" | "sweetgum" | "maple" | "white-oak" => [0.0, 0.05],
        _ => [0.0, 0.0],
    }
}

/// How uneven the greens of a species' leaf are: variation from field to field and from patch to
/// patch, size of patches (mm), what tissue along primaries lacks and its reach (mm). By eye, and
/// more for thin leaves of a crown's shade and light than for evergreen ones. The silver birch is
/// left even, for the scenes in which it stands beside itself with other pigments.
static UNEVEN: [(&str, [f64; 5]); 13] = [
    ("poplar", [0.04, 0.04, 12.0, 0.06, 1.5]),
    ("cottonwood", [0.03, 0.04, 14.0, 0.06, 1.5]),
    ("aspen", [0.04, 0.04, 12.0, 0.07, 1.5]),
    ("maple", [0.06, 0.05, 16.0, 0.10, 2.0]),
    ("white-oak", [0.05, 0.05, 18.0, 0.10, 2.0]),
    ("red-oak", [0.05, 0.05, 18.0, 0.08, 2.0]),
    ("willow", [0.03, 0.03, 10.0, 0.08, 0.8]),
    ("cherry", [0.06, 0.04, 10.0, 0.10, 1.2]),
    ("sweetgum", [0.04, 0.04, 16.0, 0.06, 1.5]),
    ("alchemilla", [0.06, 0.04, 12.0, 0.08, 1.2]),
    ("ivy", [0.03, 0.05, 10.0, 0.15, 1.5]),
    ("magnolia", [0.03, 0.03, 25.0, 0.08, 2.0]),
    ("trillium", [0.03, 0.04, 20.0, 0.06, 1.5]),
];

/// The unevenness of a species' leaf, by the name of its traits' preset.
pub(super) fn unevenness(preset: &str) -> Option<Unevenness> {
    let (_, numbers) = UNEVEN.iter().find(|(name, _)| *name == preset)?;
    let [fields, patches, patch_mm, along_primaries, reach_mm] = *numbers;
    Some(Unevenness {
        fields,
        patches,
        patch_mm,
        along_primaries,
        reach_mm,
    })
}

/// Least relief of a mesh whose faces have a surface: a midrib is seen in outline.
const LEAST_MESHED: f64 = 0.1;

/// Height of veins over their diameter in the mesh of a species. The mesh is one sheet, so what it
/// raises below it sinks above: it has no more than the adaxial face should, and the map of slopes
/// has the rest.
pub(super) fn meshed_relief(preset: &str, relief: f64) -> f64 {
    match surface(preset) {
        Some(surface) => relief.min(surface.impressed.max(LEAST_MESHED)),
        None => relief,
    }
}

/// Roughness of the adaxial coat of a preset, if it is not the usual one.
pub fn adaxial_roughness(preset: &str) -> Option<f64> {
    let found = COATS.iter().find(|(name, _)| *name == preset);
    found.map(|(_, alpha)| *alpha)
}

/// The hairs of a species' leaf, by the name of its traits' preset; none for those that floras call
/// glabrous.
pub(super) fn hairs(preset: &str) -> Vec<HairPlan> {
    match preset {
        // Silky on both faces, more so below; long and flat on the face.
        "willow" => vec![HairPlan {
            adaxial_per_mm2: 8.0,
            abaxial_per_mm2: 30.0,
            length_mm: 0.7,
            diameter_um: 9.0,
            lean: 74_f64.to_radians(),
            bend: 12_f64.to_radians(),
            stray: 14_f64.to_radians(),
            ..kind("silk")
        }],
        // On the margin and on veins below; the leaf of A. mollis is softly hairy all over.
        "alchemilla" => vec![
            HairPlan {
                adaxial_per_mm2: 1.2,
                abaxial_per_mm2: 3.0,
                length_mm: 0.9,
                diameter_um: 14.0,
                lean: 30_f64.to_radians(),
                bend: 30_f64.to_radians(),
                stray: PI,
                ..kind("down")
            },
            HairPlan {
                fringe_per_mm: 6.0,
                length_mm: 1.1,
                diameter_um: 14.0,
                lean: 25_f64.to_radians(),
                bend: 15_f64.to_radians(),
                stray: 50_f64.to_radians(),
                ..kind("fringe")
            },
        ],
        // Softly hairy below, at least on the veins.
        "cherry" => vec![HairPlan {
            abaxial_per_mm2: 12.0,
            place: HairPlace::Veins,
            length_mm: 0.6,
            diameter_um: 11.0,
            lean: 40_f64.to_radians(),
            bend: 30_f64.to_radians(),
            stray: 70_f64.to_radians(),
            ..kind("down")
        }],
        // Hairs in the axils and on the veins below.
        "maple" | "birch" => vec![HairPlan {
            abaxial_per_mm2: 4.0,
            place: HairPlace::Veins,
            length_mm: 0.4,
            diameter_um: 10.0,
            lean: 40_f64.to_radians(),
            bend: 30_f64.to_radians(),
            stray: 70_f64.to_radians(),
            ..kind("down")
        }],
        _ => Vec::new(),
    }
}

const PI: f64 = std::f64::consts::PI;

/// A kind of dry, white hair.
fn kind(name: &str) -> HairPlan {
    HairPlan {
        name: name.to_owned(),
        adaxial_per_mm2: 0.0,
        abaxial_per_mm2: 0.0,
        fringe_per_mm: 0.0,
        place: HairPlace::All,
        length_mm: 0.5,
        length_spread: 0.3,
        diameter_um: 12.0,
        lean: 0.0,
        bend: 0.0,
        stray: 0.0,
        contents: Contents::of(&[(Constituent::Structure, 1.5)]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::declared::Declared;
    use crate::species::{PRESETS, find};

    #[test]
    fn every_species_has_a_surface_that_can_be_made() {
        for relief in &RELIEFS {
            let plan = find(relief.preset).expect("a preset").plan();
            let surface = plan.surface.expect("it has a surface");
            assert_eq!(surface.validate(), Ok(()));
            for hairs in &plan.hairs {
                assert_eq!(hairs.in_range(), Ok(()), "{}", relief.preset);
            }
        }
        for (name, per_mm2, ..) in STOMATA {
            let surface = surface(name).expect("it has a surface");
            assert_eq!(surface.stomata.per_mm2, per_mm2, "{name}");
            assert!(surface.stomata.are_there());
        }
        for (name, _) in COATS {
            assert!(PRESETS.iter().any(|preset| preset.name == name), "{name}");
        }
    }

    #[test]
    fn broad_leaves_are_uneven_by_a_few_hundredths() {
        for (name, _) in UNEVEN {
            let plan = find(name).expect("a preset").plan();
            let unevenness = plan.unevenness.expect("it is uneven");
            assert_eq!(unevenness.in_range(), Ok(()));
            for share in [unevenness.fields, unevenness.patches] {
                assert!((0.03..=0.08).contains(&share), "{name}: {share}");
            }
        }
    }

    #[test]
    fn croton_and_magnolia_are_glabrous_and_willow_is_silkier_below() {
        let hairs = |name: &str| find(name).expect("a preset").plan().hairs;
        assert!(hairs("croton").is_empty() && hairs("magnolia").is_empty());
        let silk = &hairs("willow")[0];
        assert!(silk.abaxial_per_mm2 > silk.adaxial_per_mm2 && silk.adaxial_per_mm2 > 0.0);
        assert!(
            hairs("alchemilla")
                .iter()
                .any(|kind| kind.fringe_per_mm > 0.0)
        );
    }
}
