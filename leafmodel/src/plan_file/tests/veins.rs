//! Venations by chance.

use super::*;

pub(super) fn growth() -> impl Strategy<Value = Growth> {
    let lengths = || (1.0..100.0, 0.1..10.0);
    let rates = || {
        prop::collection::vec(0.001..0.1, 1..5).prop_map(|rates| {
            let knot = |(i, rate)| [f64::from(i) / 7.0, rate];
            RateCurve::new((0..).zip(rates).map(knot).collect()).expect("good rates")
        })
    };
    prop_oneof![
        Just(Growth::None),
        lengths().prop_map(|(initial_length, length_step)| Growth::Marginal {
            initial_length,
            length_step
        }),
        lengths().prop_map(|(initial_length, length_step)| Growth::Isogonic {
            initial_length,
            length_step
        }),
        (1.0..50.0, rates(), rates()).prop_map(|(initial_length, across, along)| {
            Growth::Anisotropic {
                initial_length,
                across,
                along,
            }
        }),
    ]
}

pub(super) fn venation() -> impl Strategy<Value = VenationPlan> {
    let cells = (0.01..1.0, 1_u32..9).prop_map(|(base_radius_mm, least_cells)| {
        VenationPlan::Cells(VeinStyle {
            base_radius_mm,
            least_cells,
        })
    });
    prop_oneof![
        4 => auxin_plan().prop_map(VenationPlan::Auxin),
        2 => arcuate_plan().prop_map(VenationPlan::Arcuate),
        1 => cells,
        1 => filled_plan().prop_map(VenationPlan::Transport),
        1 => (0.01..1.0, 1.0..3.0).prop_map(|(base_radius_mm, murray_exponent)| {
            VenationPlan::Development(MainVeinStyle {
                base_radius_mm,
                murray_exponent,
            })
        }),
    ]
}

pub(super) fn filled_plan() -> impl Strategy<Value = FilledPlan> {
    let usual = FilledPlan::default();
    let alpha = prop_oneof![Just(usual.alpha), 0.1..0.9];
    let beta = prop_oneof![Just(usual.beta), 0.1..9.0];
    let cells_along = prop_oneof![Just(usual.cells_along), 4_u32..90];
    (alpha, beta, cells_along, 0.01..1.0, 1_u32..9).prop_map(
        |(alpha, beta, cells_along, base_radius_mm, least_cells)| FilledPlan {
            alpha,
            beta,
            cells_along,
            style: VeinStyle {
                base_radius_mm,
                least_cells,
            },
        },
    )
}

pub(super) fn arcuate_plan() -> impl Strategy<Value = ArcuatePlan> {
    let share = || prop_oneof![Just(0.5), 0.0..1.0];
    let palmate = prop::option::of((1_u32..12, 0.1..1.0, prop_oneof![Just(0.0), -0.5..0.5]));
    let shape = (share(), share(), share(), 0.0..2.0);
    let look = (0.001..0.1, share(), share(), share());
    ((1_u32..20, any::<u32>()), shape, look, palmate).prop_map(
        |((veins, seed), shape, look, palmate)| ArcuatePlan {
            veins,
            seed,
            variation: look.1,
            width: look.0,
            net_width: look.2,
            squish: shape.0,
            squish2: shape.1,
            squish3: shape.2,
            up: shape.3,
            tip_width: look.3,
            palmate: palmate.map(|(per_side, spread, bow)| PalmateVeins {
                per_side,
                spread,
                bow,
            }),
        },
    )
}

pub(super) fn auxin_plan() -> impl Strategy<Value = AuxinPlan> {
    let pattern = prop_oneof![
        Just(Pattern::Open),
        Just(Pattern::Closed(Neighbourhood::Relative)),
        Just(Pattern::Closed(Neighbourhood::Urquhart)),
        Just(Pattern::Closed(Neighbourhood::Bipolar)),
    ];
    let free = prop::option::of((0.5..9.0, 0.5..9.0, 0.01..5.0));
    let clearance = prop::option::of((0.01..0.5, 0.0..1.0, 0_u32..9));
    let numbers = (
        100.0..2000.0,
        0.01..50.0,
        0.01..50.0,
        any::<bool>(),
        1e-6..1.0,
    );
    let more = (
        0.5..4.0,
        1e-3..1.0,
        prop_oneof![Just(0.0), 0.0..100.0],
        prop_oneof![Just(0.0), -0.5..8.0],
        prop::option::of(1.0..4.0),
        (0.0..1.0, 0_u32..30),
    );
    let origins = prop_oneof![
        Just((Vec::new(), false)),
        Just((vec![[0.0, 0.0], [0.0, 0.25]], false)),
        Just((vec![[0.0, 0.1], [0.0, 0.25]], true)),
    ];
    (pattern, growth(), free, clearance, numbers, more, origins).prop_map(
        |(pattern, growth, free, clearance, numbers, more, origins)| {
            let (final_length, kill_distance, birth, same, darts_per_area) = numbers;
            let (murray_exponent, veinlet_radius_mm, unseen_veinlets, gaussian_curvature, ..) =
                more;
            let (.., murray_exponent_finest, (axis_along_vein, tension_rounds)) = more;
            let free = free.filter(|_| pattern != Pattern::Open);
            AuxinPlan {
                pattern,
                origins: origins.0,
                joined_origins: origins.1,
                final_length,
                kill_distance,
                source_birth_distance: birth,
                vein_birth_distance: if same { birth } else { birth * 1.5 },
                darts_per_area,
                // The two do not go together.
                gaussian_curvature: match growth {
                    Growth::None | Growth::Marginal { .. } | Growth::Isogonic { .. } => {
                        gaussian_curvature
                    }
                    Growth::Anisotropic { .. } => 0.0,
                },
                growth,
                murray_exponent,
                murray_exponent_finest,
                axis_along_vein: if pattern == Pattern::Open {
                    0.0
                } else {
                    axis_along_vein
                },
                tension_rounds: if pattern == Pattern::Open {
                    0
                } else {
                    tension_rounds
                },
                veinlet_radius_mm,
                unseen_veinlets,
                free_endings: free.map(|(birth_distance, kill_distance, darts_per_area)| {
                    FreeEndings {
                        birth_distance,
                        kill_distance,
                        darts_per_area,
                    }
                }),
                architecture: None,
                margin_clearance: clearance.map(|(distance, until, arches)| MarginClearance {
                    distance,
                    until,
                    arches: if pattern == Pattern::Open { 0 } else { arches },
                }),
            }
        },
    )
}
