use leafmodel::blade::petiole::PetiolePlan;
use leafmodel::compound::{Arrangement, CompoundForm, Feather};
use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::optics::Pigments;
use leafmodel::optics::betalains::{Betacyanin, Betaxanthin};
use leafmodel::optics::pigments::{AnthocyaninMix, CarotenoidMix, ChlorophyllMix};
use leafmodel::shape::contour_curve::{ContourCurve, ControlPoint};
use leafmodel::shape::cubic_margin::CubicMargin;
use leafmodel::shape::growth::RateCurve;
use leafmodel::shape::growth_form::{
    Axis, GrowthForm, HalfForm, LateralGrowth, SecondaryAxis, VeinRow,
};
use leafmodel::shape::svg_path::SvgContour;
use leafmodel::shape::teeth::ToothWave;
use leafmodel::transport::{FilledPlan, Ladder, TransportPlan, VeinStyle};
use leafmodel::venation::arcuate::{ArcuatePlan, PalmateVeins};
use leafmodel::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::*;
use crate::scene::document::outline::STEPS;
use crate::scene::load::{leaf_to_toml, parse_leaves};

const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\">\
    <path d=\"M0 0H9V9Z\"/><path id=\"kite\" d=\"M5 9 C6 8 6 7 5 5 L4 7 Z\"/></svg>";

fn ovate() -> GrowthForm {
    HalfForm::entire(1.2, 0.3, 3.0).into()
}

fn plain() -> LeafPlan {
    LeafPlan {
        length_mm: 80.0,
        seed: 0,
        outline: Contour::GrowthAlgorithm(ovate()).into(),
        venation: AuxinPlan::default().into(),
        tissue: default_tissue(Contents::from_array([
            1.5, 40.0, 9.0, 0.0, 0.0, 0.0, 0.0, 0.01, 0.006,
        ])),
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        form: default_form(80.0),
        petiole: None,
        compound: None,
        pigments: Pigments::default(),
        map_size: 1024,
    }
}

fn cubic() -> impl Strategy<Value = Contour> {
    (20.0..110.0, 0.1..0.8, 20.0..110.0, 0.1..0.8).prop_map(
        |(angle1_deg, length1, angle2_deg, length2)| {
            Contour::Cubic(CubicMargin {
                angle1_deg,
                length1,
                angle2_deg,
                length2,
            })
        },
    )
}

fn transport() -> impl Strategy<Value = Contour> {
    let ladder = prop_oneof![
        Just(Ladder::Events),
        Just(Ladder::Equal(STEPS)),
        (1_u32..30).prop_map(Ladder::Equal),
    ];
    let numbers = (
        0.55..0.9,
        0.1..2.0,
        1.5..3.0,
        prop_oneof![Just(1.0), 0.5..2.0],
    );
    let light = (any::<bool>(), prop_oneof![Just(0.0), 0.1..0.5], 1.0..9.0);
    (numbers, ladder, light, 5000_usize..20_001).prop_map(
        |((alpha, beta, epsilon, cell), ladder, (mirrored, noise, noise_cells), most_cells)| {
            Contour::Transport(TransportPlan {
                alpha,
                beta,
                epsilon,
                cell,
                ladder,
                mirrored,
                noise,
                noise_cells,
                most_cells,
            })
        },
    )
}

fn half_form() -> impl Strategy<Value = HalfForm> {
    let peak = (1.0..2.0, 0.1..0.9, 0.5..9.0).prop_map(|(rate_ratio, widest_at, falloff)| {
        LateralGrowth::Peak {
            rate_ratio,
            widest_at,
            falloff,
        }
    });
    let knots = prop::collection::vec(-0.01..0.09, 1..4);
    let curve = knots.prop_map(|rates| {
        let knot = |(i, rate)| [f64::from(i) / 3.0, rate];
        let knots = (0..).zip(rates).map(knot).collect();
        LateralGrowth::Curve(RateCurve::new(knots).expect("good rates"))
    });
    let decay = prop_oneof![Just(0.0), 0.0..0.01];
    let exponent = prop_oneof![Just(2.0), 0.5..3.0];
    let bend = prop_oneof![Just(0.0), -1.0..1.0];
    let lateral = prop_oneof![peak, curve];
    (lateral, decay, exponent, 0_usize..4, bend).prop_map(
        |(lateral, lobe_decay, lobe_exponent, veins, bend)| {
            let vein = |i: usize| VeinRow {
                position: (i as f64 + 0.5) / 4.0,
                slope: 0.6,
                bend,
            };
            HalfForm {
                lateral,
                lobe_decay,
                lobe_exponent,
                veins: (0..veins).map(vein).collect(),
            }
        },
    )
}

/// An axis of a symmetrical leaf or an unlike one, without axes on it.
fn bare_axis() -> impl Strategy<Value = Axis> {
    let left = prop::option::of((half_form(), any::<bool>()));
    let rows = prop_oneof![Just(150_usize), 3_usize..300];
    (rows, half_form(), left).prop_map(|(rows, right, left)| Axis {
        rows,
        left: left.map(|(left, alike)| if alike { right.clone() } else { left }),
        right,
        axes: Vec::new(),
    })
}

fn growth_form() -> impl Strategy<Value = GrowthForm> {
    let rate = prop_oneof![Just(0.1), 0.01..1.0];
    let position = prop_oneof![Just(0.0), 0.0..0.6];
    let place = (position, -170_i32..170, any::<bool>(), 0.2..1.0);
    let secondary =
        (place, bare_axis(), 0_usize..4).prop_map(|(place, axis, alike)| (place, axis, alike));
    let axes = prop::collection::vec(secondary, 0..3);
    (rate, bare_axis(), axes, any::<bool>()).prop_map(|(axial_rate, midrib, axes, nested)| {
        let mut form = GrowthForm { axial_rate, midrib };
        for ((position, angle_deg, paired, length), mut axis, alike) in axes {
            // Some have much of their parent's.
            if alike > 0 {
                axis.right = form.midrib.right.clone();
            }
            if alike > 1 {
                axis.rows = form.midrib.rows;
            }
            if alike > 2 {
                axis.right.veins.clear();
            }
            let secondary = SecondaryAxis {
                position,
                angle: f64::from(angle_deg).to_radians(),
                paired,
                length,
                axis,
            };
            match form.midrib.axes.last_mut().filter(|_| nested) {
                Some(last) => last.axis.axes.push(secondary),
                None => form.midrib.axes.push(secondary),
            }
        }
        form
    })
}

fn contour() -> impl Strategy<Value = Contour> {
    let grown = growth_form().prop_map(Contour::GrowthAlgorithm);
    let drawn = (
        prop::collection::vec((0.05..0.5, any::<bool>()), 1..6),
        any::<bool>(),
    )
        .prop_map(|(widths, mirrored)| {
            let step = 1.0 / (widths.len() + 1) as f64;
            let point = |place, corner| ControlPoint { place, corner };
            let heights = (1..).map(|i| f64::from(i) * step);
            let right = widths
                .iter()
                .zip(heights)
                .map(|(&(x, corner), y)| point([x, y], corner));
            let ends = [point([0.0, 0.0], false), point([0.0, 1.0], true)];
            let mut points: Vec<ControlPoint> = std::iter::once(ends[0])
                .chain(right)
                .chain([ends[1]])
                .collect();
            if !mirrored {
                points.push(point([-0.3, 0.5], false));
            }
            Contour::Curve(ContourCurve { points, mirrored })
        });
    let traced = (any::<bool>(), any::<bool>()).prop_map(|(named, turned)| {
        let id = named.then_some("kite");
        let mut contour = SvgContour::parse("leaf.svg", SVG, id).expect("a good file");
        if turned {
            contour.base = contour.points[1];
        }
        Contour::Svg(contour)
    });
    prop_oneof![grown, drawn, traced, cubic(), transport()]
}

fn growth() -> impl Strategy<Value = Growth> {
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

fn venation() -> impl Strategy<Value = VenationPlan> {
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
    ]
}

fn filled_plan() -> impl Strategy<Value = FilledPlan> {
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

fn arcuate_plan() -> impl Strategy<Value = ArcuatePlan> {
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

fn auxin_plan() -> impl Strategy<Value = AuxinPlan> {
    let pattern = prop_oneof![
        Just(Pattern::Open),
        Just(Pattern::Closed(Neighbourhood::Relative)),
        Just(Pattern::Closed(Neighbourhood::Urquhart)),
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
    );
    let origins = prop_oneof![
        Just((Vec::new(), false)),
        Just((vec![[0.0, 0.0], [0.0, 0.25]], false)),
        Just((vec![[0.0, 0.1], [0.0, 0.25]], true)),
    ];
    (pattern, growth(), free, clearance, numbers, more, origins).prop_map(
        |(pattern, growth, free, clearance, numbers, more, origins)| {
            let (final_length, kill_distance, birth, same, darts_per_area) = numbers;
            let (murray_exponent, veinlet_radius_mm, unseen_veinlets, gaussian_curvature) = more;
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
                veinlet_radius_mm,
                unseen_veinlets,
                free_endings: free.map(|(birth_distance, kill_distance, darts_per_area)| {
                    FreeEndings {
                        birth_distance,
                        kill_distance,
                        darts_per_area,
                    }
                }),
                margin_clearance: clearance.map(|(distance, until, arches)| MarginClearance {
                    distance,
                    until,
                    arches: if pattern == Pattern::Open { 0 } else { arches },
                }),
            }
        },
    )
}

fn teeth() -> impl Strategy<Value = Vec<ToothWave>> {
    let share = || prop_oneof![Just(0.0), 0.0..1.0];
    let wave = (
        1_u32..20,
        0.0001..0.005,
        prop_oneof![Just(0.0), -1.0..1.0],
        share(),
        share(),
    )
        .prop_map(|(per_side, height, lean, fade_base, fade_apex)| ToothWave {
            per_side,
            height,
            lean,
            fade_base,
            fade_apex,
        });
    prop::collection::vec(wave, 0..3)
}

fn senescence() -> impl Strategy<Value = Option<Senescence>> {
    let blend = prop_oneof![Just(BLEND), 0.001..1.0];
    let contents = (1.0..4.0, prop::array::uniform8(0.0..1.0)).prop_map(|(structure, rest)| {
        let [a, b, c, d, e, f, g, h] = rest;
        Contents::from_array([structure, a, b * 20.0, c, d, e, f, g, h])
    });
    let aged = (0.0..1.0, blend, contents).prop_map(|(share, blend, contents)| Senescence {
        source: AgeSource::Revenue { share },
        blend,
        contents,
    });
    prop::option::of(aged)
}

fn tissue_and_form() -> impl Strategy<Value = (Tissue, BladeForm)> {
    let contents = (1.0..4.0, prop::array::uniform8(0.0..1.0)).prop_map(|(structure, rest)| {
        let [a, b, c, d, e, f, g, h] = rest;
        Contents::from_array([structure, a * 80.0, b * 20.0, c, d, e, f, g, h])
    });
    let tissue = (
        contents,
        prop::option::of(prop::array::uniform8(0.0..2.0)),
        0.0..1.0_f64,
    )
        .prop_map(|(lamina, factors, mottle)| {
            let mut tissue = default_tissue(lamina);
            if let Some([a, b, c, d, e, f, g, h]) = factors {
                tissue.vein_factors = Contents::from_array([1.3, a, b, c, d, e, f, g, h]);
                tissue.mottle = mottle;
                tissue.sheath_width_mm = 0.1 + mottle;
            }
            tissue
        });
    let form = (
        -80.0..80.0_f64,
        -355.0..355.0_f64,
        0.0..0.5,
        0.5..2.0,
        any::<bool>(),
    )
        .prop_map(|(fold, curl, ruffle, relief, plain)| {
            let default = default_form(80.0);
            if plain {
                return default;
            }
            BladeForm {
                fold: fold.to_radians(),
                curl: curl.to_radians(),
                ruffle,
                relief,
                max_edge_mm: relief,
                ..default
            }
        });
    (tissue, form)
}

fn feather() -> impl Strategy<Value = Feather> {
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
fn petiole_or_compound() -> impl Strategy<Value = (Option<PetiolePlan>, Option<CompoundForm>)> {
    let petiole = (0.0..3.0, prop::option::of(0.01..2.0), -90.0..90.0_f64);
    let petiole = petiole.prop_map(|(length, radius_mm, curl)| PetiolePlan {
        length,
        radius_mm,
        curl: curl.to_radians(),
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
    let compound = (arrangement, bends, stalks, 1_u32..5).prop_map(
        |(arrangement, bends, (petiole, petiolule, stalk_radius_mm), variants)| {
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
            }
        },
    );
    prop_oneof![
        Just((None, None)),
        petiole.prop_map(|petiole| (Some(petiole), None)),
        compound.prop_map(|compound| (None, Some(compound))),
    ]
}

/// Shares that sum to 1, some of them 0.
fn shares<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    proptest::array::uniform(prop_oneof![Just(0_u32), 1_u32..10]).prop_map(|mut parts: [u32; N]| {
        parts[0] += u32::from(parts.iter().all(|part| *part == 0));
        let sum = f64::from(parts.iter().sum::<u32>());
        parts.map(|part| f64::from(part) / sum)
    })
}

pub(in super::super) fn pigments() -> impl Strategy<Value = Pigments> {
    let factor = || prop_oneof![Just(0.41), Just(0.29), Just(0.5), 0.01..1.0];
    let chlorophyll = prop_oneof![
        Just(ChlorophyllMix::Prospect),
        (0.0..9.0).prop_map(|a_to_b| ChlorophyllMix::Apportioned { a_to_b }),
        (0.0..9.0).prop_map(ChlorophyllMix::bands),
        (0.0..9.0, -500.0..500.0, factor()).prop_map(|(a_to_b, shift_per_cm, packaging)| {
            ChlorophyllMix::Bands {
                a_to_b,
                shift_per_cm,
                packaging,
            }
        }),
    ];
    let carotenoids = prop_oneof![
        Just(CarotenoidMix::Prospect),
        shares().prop_map(CarotenoidMix::bands),
        (shares(), -1500.0..0.0, factor()).prop_map(|(shares, shift_per_cm, packaging)| {
            CarotenoidMix::Bands {
                shares,
                shift_per_cm,
                packaging,
            }
        }),
    ];
    let aglycones = prop_oneof![Just([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]), shares()];
    let numbers = (
        prop_oneof![Just(0.0), 0.0..45.0],
        prop_oneof![Just(0.0), 0.0..1.0],
    );
    let anthocyanins = prop_oneof![
        Just(AnthocyaninMix::Prospect),
        (aglycones, numbers).prop_map(|(shares, (shift_nm, blue_fraction))| {
            AnthocyaninMix::Aglycones {
                shares,
                shift_nm,
                blue_fraction,
            }
        }),
    ];
    let betacyanin = prop_oneof![Just(Betacyanin::Betanin), Just(Betacyanin::Amaranthine)];
    let betaxanthin = prop_oneof![
        Just(Betaxanthin::Indicaxanthin),
        Just(Betaxanthin::Vulgaxanthin)
    ];
    let betalains = (betacyanin, betaxanthin, factor());
    (chlorophyll, carotenoids, anthocyanins, betalains).prop_map(
        |(chlorophyll, carotenoids, anthocyanins, (betacyanins, betaxanthins, packaging))| {
            Pigments {
                chlorophyll,
                carotenoids,
                anthocyanins,
                betacyanins,
                betaxanthins,
                betalain_packaging: packaging,
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    #[test]
    fn a_written_plan_reads_back_to_the_same(
        contour in contour(), teeth in teeth(), venation in venation(), (tissue, form) in tissue_and_form(),
        pigments in pigments(), seed in any::<u64>(), map_size in 16_u32..8192, senescence in senescence(), stalks in petiole_or_compound(),
    ) {
        let outline = OutlinePlan { contour, teeth };
        let (petiole, compound) = stalks;
        let plan = LeafPlan { length_mm: 80.0, seed, outline, venation, tissue, layers: Vec::new(), mosaic: None, senescence, form, petiole, compound, pigments, map_size };
        // Only cells that earn anything die when they do not.
        let plan = LeafPlan { senescence: plan.senescence.filter(|_| plan.check_senescence().is_ok()), ..plan };
        // What cannot be grown is refused by the reader, as it should be.
        prop_assume!(plan.check_lamina().is_ok());
        // It tries the outline at 1 mm, where teeth on a ragged margin may just touch.
        prop_assume!(plan.outline.grow(1.0, seed).is_ok());
        prop_assume!(plan.compound.as_ref().is_none_or(|form| form.arrange(&plan).is_ok()));
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("leaf.svg"), SVG).expect("the folder was just made");
        let text = leaf_to_toml("beech", &plan);
        let leaves = match parse_leaves(&text, "beech", folder.path(), &[]) {
            Ok(leaves) => leaves,
            Err(errors) => return Err(TestCaseError::fail(format!("{errors}\n{text}"))),
        };
        prop_assert_eq!(&leaves[0].value.plan, &plan, "{}", text);
        prop_assert_eq!(leaf_to_toml("beech", &leaves[0].value.plan), text);
    }

    #[test]
    fn whole_degrees_stay_whole(angle in -355..355_i32) {
        prop_assert_eq!(degrees(f64::from(angle).to_radians()), f64::from(angle));
    }
}

#[test]
fn layers_and_days_read_back_to_the_same() {
    use leafmodel::blade::ageing_courses::{COURSES, LITTER};
    use leafmodel::blade::layers::{Change, Layer, Mode};
    use leafmodel::blade::masks::{Mask, RimWidth};

    let folder = tempfile::tempdir().expect("a folder");
    let mut number = 0;
    let mut layer = |mask, mode, share| {
        number += 1;
        let mut values = [None; Contents::COUNT];
        values[number] = Some(0.25);
        values[6] = Some(1.0);
        Layer {
            name: format!("layer-{number}"),
            mask,
            share,
            change: Change::Values { mode, values },
        }
    };
    let rim = |width| Mask::Margin {
        width,
        softness_mm: 0.7,
        wander: 0.4,
        wander_scale_mm: 8.0,
    };
    let layers = vec![
        layer(Mask::Everywhere, Mode::Replace, 1.0),
        layer(rim(RimWidth::Mm(3.0)), Mode::Add, 0.5),
        layer(rim(RimWidth::HalfWidths(0.3)), Mode::Multiply, 0.25),
        layer(
            Mask::Veins {
                orders: [2, 4],
                width_mm: 0.6,
                softness_mm: 0.5,
                outside: true,
            },
            Mode::Multiply,
            1.0,
        ),
        layer(
            Mask::Midrib {
                width_mm: 2.0,
                softness_mm: 1.0,
            },
            Mode::Replace,
            1.0,
        ),
        layer(Mask::BaseToTip { from: 0.9, to: 0.1 }, Mode::Replace, 1.0),
        layer(
            Mask::Noise {
                scale_mm: 3.0,
                threshold: -0.2,
                softness: 0.5,
            },
            Mode::Replace,
            0.0,
        ),
    ];
    for (name, mut course) in COURSES {
        course.half_days = 12.5;
        course.onset.tip_days = -3.0;
        course.death.veins_order = 3;
        let plan = LeafPlan {
            layers: layers.clone(),
            senescence: Some(Senescence {
                source: AgeSource::Day { day: 21.5, course },
                blend: 6.0,
                contents: Contents {
                    brown: 0.8,
                    ..LITTER
                },
            }),
            ..plain()
        };
        let text = leaf_to_toml("beech", &plan);
        let leaves = parse_leaves(&text, "beech", folder.path(), &[]);
        let leaves = leaves.unwrap_or_else(|errors| panic!("{name}: {errors}\n{text}"));
        assert_eq!(leaves[0].value.plan, plan, "{text}");
        // By its name alone.
        let named = text.replace("day = 21.5", &format!("day = 21.5\ncourse = \"{name}\""));
        assert!(parse_leaves(&named, "beech", folder.path(), &[]).is_ok());
    }
}

#[test]
fn pictures_of_layers_are_read_and_written_back_by_their_paths() {
    use leafmodel::blade::layers::Change;
    use leafmodel::blade::masks::Mask;

    use crate::export::mitsuba::map_picture;
    use crate::image::{openexr, portable_network};
    use crate::material::contents_texture::ContentsTexture;

    let folder = tempfile::tempdir().expect("a folder");
    let grey = [0, 0, 0, 51, 51, 51, 255, 255, 255, 102, 102, 102];
    portable_network::write(&folder.path().join("rim.png"), 2, 2, &grey).expect("a picture");
    let texels = vec![[2.0, 30.0, 8.0, 2.0, 1.0, 3.0, 0.5, 0.02, 0.01]; 6];
    let map = map_picture(&ContentsTexture::new(3, 2, texels.clone()));
    openexr::write(&map, &folder.path().join("map.exr")).expect("a map");
    let text = leaf_to_toml("beech", &plain())
        + "[leaves.beech.layers.all]\nmap = \"map.exr\"\n\
           [leaves.beech.layers.rim]\nimage = { file = \"rim.png\" }\ncontents = { brown = 1 }\n\
           [leaves.beech.layers.part]\nimage = { file = \"map.exr\", channel = \"brown\" }\ncontents = { brown = 1 }\n";
    let read = |text: &str| match parse_leaves(text, "beech", folder.path(), &[]) {
        Ok(mut leaves) => leaves.remove(0).value.plan,
        Err(errors) => panic!("{errors}\n{text}"),
    };
    let plan = read(&text);
    let [all, rim, part] = plan.layers.as_slice() else {
        panic!("three layers: {:?}", plan.layers);
    };
    assert!(matches!(&all.change, Change::Map(map) if map.texels == texels));
    // As written, not as light; the lowest row first.
    let share = |byte: u8| [f32::from(byte) / 255.0];
    let weights = [255, 102, 0, 51].map(share);
    assert!(matches!(&rim.mask, Mask::Picture(picture) if picture.texels == weights));
    assert!(matches!(&part.mask, Mask::Picture(picture) if picture.texels == [[0.5]; 6]));
    assert_eq!(read(&leaf_to_toml("beech", &plan)), plan);
}

#[test]
fn a_mosaic_with_all_that_it_can_have_reads_back_to_the_same() {
    use leafmodel::mosaic::pattern::LeafFaces;

    let folder = tempfile::tempdir().expect("a folder");
    let grey = [0, 0, 0, 51, 51, 51, 255, 255, 255, 102, 102, 102];
    crate::image::portable_network::write(&folder.path().join("g.png"), 2, 2, &grey)
        .expect("a picture");
    let mosaic = r#"
[leaves.beech.mosaic]
cells = 300
days = 12.5
radius_weight = 2
relaxations_per_day = 3
step = 0.05
initial_relaxations = 20
initial_step = 0.01
radius = "daily"
blend_mm = 0.4
faces = "both"
growth = { start = [0.3, 0.2, 1], middle = 0.4, steepness = 6 }
[leaves.beech.mosaic.types.yellow]
initial_share = 0.25
division_days = 6
adhesion = { yellow = 0.5, white = 0.2 }
contents = { chlorophyll_ug_per_cm2 = 3, betaxanthins_ug_per_cm2 = 2 }
[leaves.beech.mosaic.types.green]
initial_share = 0.5
division_days = 9
switching = { yellow = 0.125 }
[leaves.beech.mosaic.types.white]
initial_share = 0.25
[leaves.beech.mosaic.controls.a]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
radius_mm = 20
steers = "initial_type"
type = "yellow"
stripes = { count = 5, share = 0.3, waviness = 0.1 }
[leaves.beech.mosaic.controls.b]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "division_rate"
low = 0.5
rings = { count = 4 }
[leaves.beech.mosaic.controls.c]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "adhesion"
type = "yellow"
other_type = "green"
noise = { around = 3, octaves = 2, threshold = 0.5, seed = 7 }
[leaves.beech.mosaic.controls.d]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "blocked"
picture = { path = "g.png" }
[leaves.beech.mosaic.controls.e]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "division_rate"
type = "green"
constant = 0.5
"#;
    let read = |text: &str| match parse_leaves(text, "beech", folder.path(), &[]) {
        Ok(mut leaves) => leaves.remove(0).value.plan,
        Err(errors) => panic!("{errors}\n{text}"),
    };
    let plan = read(&(leaf_to_toml("beech", &plain()) + mosaic));
    let pattern = plan.mosaic.as_ref().expect("it has a mosaic");
    assert_eq!(pattern.validate(), Ok(()));
    assert_eq!(pattern.faces, LeafFaces::Both);
    let [yellow, green, white] = pattern.plan.types.as_slice() else {
        panic!("three types: {:?}", pattern.plan.types);
    };
    assert_eq!(green.switching, [0.125, 0.875, 0.0]);
    assert_eq!((white.adhesion[0], yellow.adhesion[2]), (0.2, 0.2));
    assert_eq!(white.division_days, f64::INFINITY);
    assert_eq!(pattern.contents[0].betaxanthins, 2.0);
    assert_eq!(pattern.contents[1], plan.tissue.lamina);
    assert_eq!(pattern.plan.controls.len(), 5);
    assert_eq!(read(&leaf_to_toml("beech", &plan)), plan);
}

#[test]
fn what_has_its_default_is_left_out() {
    assert_eq!(
        leaf_to_toml("beech", &plain()),
        "format = 1

[leaves.beech]
length_mm = 80

[leaves.beech.outline.growth_algorithm]
rate_ratio = 1.2
widest_at = 0.3
falloff = 3

[leaves.beech.venation.closed]
final_length_segments = 350
kill_distance_segments = 1
birth_distance_segments = 2
darts_per_segment2 = 0.0002
veinlet_radius_mm = 0.02

[leaves.beech.venation.closed.growth.isogonic]
initial_length_segments = 11.5
length_step_segments = 0.9

[leaves.beech.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
"
    );
}
