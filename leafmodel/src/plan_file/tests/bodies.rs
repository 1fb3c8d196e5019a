//! Tissue, form and stalks by chance.

use super::*;
use crate::blade::MarginThickness;
use crate::blade::hairs::{HairPlace, HairPlan};
use crate::blade::petiole::{Course, Section};
use crate::blade::stance::{Drying, MarginGrowth, Stance, Wilting};
use crate::blade::surface::SurfacePlan;
use crate::blade::surface::dust::DustPlan;
use crate::blade::surface::stomata::StomataPlan;
use crate::blade::unevenness::Unevenness;
use crate::optics::{Constituent, Contents, VeinFactors};

pub(super) fn tissue_and_form() -> impl Strategy<Value = (Tissue, BladeForm)> {
    let contents = (1.0..4.0, of_each(0.0..1.0)).prop_map(|(structure, rest)| {
        // PROSPECT-D has neither the parts of dry matter nor a table of its own.
        let mut held = Contents(rest).with(&[
            (Constituent::Structure, structure),
            (Constituent::Proteins, 0.0),
            (Constituent::CarbonBased, 0.0),
            (Constituent::Extra, 0.0),
        ]);
        held[Constituent::Chlorophyll] *= 80.0;
        held[Constituent::Carotenoids] *= 20.0;
        held
    });
    let tissue = (contents, prop::option::of(of_each(0.0..2.0)), 0.0..1.0_f64).prop_map(
        |(lamina, factors, mottle)| {
            let mut tissue = Tissue::of(lamina);
            if let Some(factors) = factors {
                tissue.vein_factors = VeinFactors(factors);
                tissue.mottle = mottle;
                tissue.sheath_width_mm = 0.1 + mottle;
            }
            tissue
        },
    );
    let form = (
        -80.0..80.0_f64,
        -355.0..355.0_f64,
        0.0..0.5,
        0.5..2.0,
        any::<bool>(),
    )
        .prop_map(|(fold, curl, ruffle, relief, plain)| {
            let default = BladeForm::nearly_flat(80.0);
            if plain {
                return default;
            }
            BladeForm {
                fold: fold.to_radians(),
                curl: curl.to_radians(),
                ruffle,
                pleat: (20.0 * ruffle).to_radians(),
                relief,
                margin: MarginThickness {
                    share: 1.0 - ruffle,
                    width_mm: 0.2 + relief,
                },
                closed: relief > 0.5,
                max_edge_mm: relief,
                ..default
            }
        });
    (tissue, form)
}

pub(super) fn feather() -> impl Strategy<Value = Feather> {
    (
        (
            1_u32..4,
            any::<bool>(),
            4.0..30.0,
            prop_oneof![Just(0.0), 0.1..0.9],
        ),
        prop::array::uniform2(50.0..110.0_f64),
        prop_oneof![Just([1.0; 3]), prop::array::uniform3(0.1..1.0)],
        prop_oneof![Just(0.0), -100.0..100.0_f64],
    )
        .prop_map(
            |((pairs, terminal, rachis, alternation), angles, sizes, turn)| Feather {
                pairs,
                terminal,
                rachis,
                alternation,
                angles: angles.map(f64::to_radians),
                sizes,
                turn: turn.to_radians(),
            },
        )
}

/// Nothing, a petiole, or the one or other compound leaf.
pub(super) fn petiole_or_compound()
-> impl Strategy<Value = (Option<PetiolePlan>, Option<CompoundForm>)> {
    let section =
        (0.0..0.8, 0.0..0.7, 0.0..2.0, 0.0..2.0).prop_map(|(groove, flatness, foot, head)| {
            Section {
                groove,
                flatness,
                foot,
                head,
            }
        });
    let angles = (
        -170.0..170.0_f64,
        -110.0..110.0_f64,
        -170.0..170.0_f64,
        -170.0..170.0_f64,
        0.0..55.0_f64,
    );
    let course =
        (angles, 0.02..1.0).prop_map(|((sag, neck, sway, twist, stray), neck_length)| Course {
            sag: sag.to_radians(),
            neck: neck.to_radians(),
            neck_length,
            sway: sway.to_radians(),
            twist: twist.to_radians(),
            stray: stray.to_radians(),
        });
    let petiole = (
        0.0..3.0,
        prop::option::of(0.01..2.0),
        -90.0..90.0_f64,
        course,
        section,
    );
    let petiole = petiole.prop_map(|(length, radius_mm, curl, course, section)| PetiolePlan {
        length,
        radius_mm,
        curl: curl.to_radians(),
        course,
        section,
    });
    let palmate = (
        2_u32..5,
        200.0..320.0_f64,
        prop_oneof![Just([1.0; 2]), Just([0.5, 0.9])],
    );
    let arrangement = prop_oneof![
        feather().prop_map(Arrangement::Pinnate),
        palmate.prop_map(|(leaflets, spread, sizes)| Arrangement::Palmate {
            leaflets,
            spread: spread.to_radians(),
            sizes,
        }),
        (feather(), feather(), 1.0..3.0).prop_map(|(pinnae, leaflets, stalk)| {
            Arrangement::Bipinnate {
                pinnae,
                leaflets,
                stalk,
            }
        }),
    ];
    let bends = prop_oneof![
        Just([0.0; 3]),
        (-300.0..300.0_f64, -70.0..70.0_f64, 0.0..50.0_f64).prop_map(|(a, b, c)| [a, b, c]),
    ];
    let stalks = (
        0.0..5.0,
        prop_oneof![Just(0.05), 0.1..2.0],
        prop_oneof![Just(0.4), 0.1..2.0],
    );
    let irregularity = prop_oneof![Just(0.0), 0.01..0.25];
    let compound = (arrangement, bends, stalks, 1_u32..5, irregularity).prop_map(
        |(arrangement, bends, (petiole, petiolule, stalk_radius_mm), variants, irregularity)| {
            let [curl, fold, tilt] = bends.map(f64::to_radians);
            CompoundForm {
                arrangement,
                petiole,
                petiolule,
                stalk_radius_mm,
                variants,
                curl,
                fold,
                tilt,
                irregularity,
            }
        },
    );
    prop_oneof![
        Just((None, None)),
        petiole.prop_map(|petiole| (Some(petiole), None)),
        compound.prop_map(|compound| (None, Some(compound))),
    ]
}

/// What has happened to a blade.
pub(super) fn stance() -> impl Strategy<Value = Stance> {
    let growth = (-0.3..1.0, 0.005..1.0).prop_map(|(excess, width)| MarginGrowth { excess, width });
    let drying = (
        0.0..1.0,
        0.0..0.4,
        0.0..1.0,
        -0.1..0.1,
        0.0..1.0,
        -170.0..170.0_f64,
    );
    let drying = drying.prop_map(|(share, shrinkage, along, faces, unevenness, bow)| Drying {
        share,
        shrinkage,
        along,
        faces,
        unevenness,
        bow: bow.to_radians(),
    });
    let wilting = (0.0..1.0, -90.0..90.0_f64);
    let wilting = wilting.prop_map(|(share, pitch)| Wilting {
        share,
        pitch: pitch.to_radians(),
    });
    let (growth, drying) = (prop::option::of(growth), prop::option::of(drying));
    (growth, drying, prop::option::of(wilting), any::<bool>()).prop_map(
        |(margin_growth, drying, wilting, on_ground)| Stance {
            margin_growth,
            drying,
            // A leaf on the ground is not held.
            wilting: wilting.filter(|_| !on_ground),
            on_ground,
        },
    )
}

/// Smooth faces, or any others.
pub(super) fn surface() -> impl Strategy<Value = Option<SurfacePlan>> {
    let veins = (-2.0..2.0, -2.0..2.0, 0.0..1.0);
    let bulge = (0.0..5.0, 0.05..100.0);
    let cells = (prop_oneof![Just(0.0), 5.0..500.0], 1.0..30.0, 0.0..1.0);
    let age = (0.0..1.0, 0.0..1.0, 0.2..1.5);
    let any = (veins, bulge, cells, age, stomata(), dust());
    let any = any.prop_map(|(veins, bulge, cells, age, stomata, dust)| SurfacePlan {
        dead_roughness: age.0,
        maturity: age.1,
        young_roughness: age.2,
        stomata,
        dust,
        impressed: veins.0,
        raised: veins.1,
        vein_roughness: veins.2,
        bulge_mm: bulge.0,
        bulge_width_mm: bulge.1,
        cells_um: cells.0,
        cell_elongation: cells.1,
        cell_share: cells.2,
        bloom: [bulge.0, veins.2],
    });
    prop::option::of(any)
}

fn stomata() -> impl Strategy<Value = StomataPlan> {
    let densities = [0, 1].map(|_| prop_oneof![Just(0.0), 1.0..2000.0]);
    let row = prop_oneof![Just(0.0), 20.0..1000.0];
    let any = (densities, 5.0..120.0, 0.2..1.0, 0.0..30.0, row);
    any.prop_map(
        |(per_mm2, length_um, aspect, depth_um, row_um)| StomataPlan {
            per_mm2,
            length_um,
            aspect,
            depth_um,
            row_um,
        },
    )
}

fn dust() -> impl Strategy<Value = DustPlan> {
    let grains = ([0.0..50.0, 0.0..50.0], 1.0..100.0, 0.1..1.5);
    let places = (0.0..1.0, 0.2..200.0, 0.0..10.0, 0.0..10.0, 0.05..50.0);
    (grains, places).prop_map(|(grains, places)| DustPlan {
        load_g_per_m2: grains.0,
        grain_um: grains.1,
        brightness: grains.2,
        patchiness: places.0,
        patch_mm: places.1,
        at_veins: places.2,
        at_margin: places.3,
        reach_mm: places.4,
    })
}

pub(super) fn unevenness() -> impl Strategy<Value = Option<Unevenness>> {
    let any = (0.0..0.3, 0.0..0.3, 0.5..500.0, 0.0..0.9, 0.05..100.0).prop_map(
        |(fields, patches, patch_mm, along_primaries, reach_mm)| Unevenness {
            fields,
            patches,
            patch_mm,
            along_primaries,
            reach_mm,
        },
    );
    prop::option::of(any)
}

/// No hairs, or one or two kinds.
pub(super) fn hairs() -> impl Strategy<Value = Vec<HairPlan>> {
    let places = [HairPlace::All, HairPlace::Veins, HairPlace::Between];
    let densities = [0.0..1000.0, 0.0..1000.0, 0.0..1000.0];
    let shape = (0.005..50.0, 0.0..1.0, 1.0..500.0);
    let angles = [0.0..89.0_f64, 0.0..120.0, 0.0..180.0];
    let one = (
        densities,
        prop::sample::select(places.to_vec()),
        shape,
        angles,
    );
    prop::collection::vec(one, 0..3).prop_map(|kinds| {
        let kinds = kinds.into_iter().zip(["down", "fringe"]);
        kinds
            .map(|((densities, place, shape, angles), name)| HairPlan {
                name: name.to_owned(),
                adaxial_per_mm2: densities[0],
                abaxial_per_mm2: densities[1],
                fringe_per_mm: densities[2],
                place,
                length_mm: shape.0,
                length_spread: shape.1,
                diameter_um: shape.2,
                lean: angles[0].to_radians(),
                bend: angles[1].to_radians(),
                stray: angles[2].to_radians(),
                contents: Contents::of(&[(Constituent::Structure, 1.5)]),
            })
            .collect()
    })
}
