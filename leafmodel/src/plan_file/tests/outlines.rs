//! Outlines by chance.

use super::*;

pub(super) fn cubic() -> impl Strategy<Value = Contour> {
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

pub(super) fn transport() -> impl Strategy<Value = Contour> {
    let ladder = prop_oneof![
        Just(Ladder::Events),
        Just(Ladder::Equal(80)),
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

pub(super) fn development() -> impl Strategy<Value = Contour> {
    let usual = Wave::default();
    let wave = (0.1..0.5, 0.0..0.3, any::<bool>(), 0.0..0.9, 0.0..0.4).prop_map(
        move |(spacing, hold, from_base, transport, lean)| Wave {
            spacing,
            hold,
            sequence: if from_base {
                Sequence::Acropetal
            } else {
                Sequence::Intercalary
            },
            transport,
            lean,
            zone: [0.25, 0.75],
            rates: [1.0 - 0.05 * hold, 1.0],
            ..usual
        },
    );
    let form = (0.3..1.2, prop_oneof![Just(0.45), 0.3..0.7]);
    let waves = prop::collection::vec(wave, 0..3);
    (form, 4.0..12.0, waves, 0.0..0.5).prop_map(|((width, widest_at), growth, waves, chance)| {
        Contour::Development(DevelopmentPlan {
            primordium: Primordium {
                width,
                widest_at,
                ..Primordium::default()
            },
            growth,
            waves,
            irregularity: chance,
            resolution: 30,
            ..DevelopmentPlan::default()
        })
    })
}

pub(super) fn half_form() -> impl Strategy<Value = HalfForm> {
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
pub(super) fn bare_axis() -> impl Strategy<Value = Axis> {
    let left = prop::option::of((half_form(), any::<bool>()));
    let rows = prop_oneof![Just(150_usize), 3_usize..300];
    (rows, half_form(), left).prop_map(|(rows, right, left)| Axis {
        rows,
        left: left.map(|(left, alike)| if alike { right.clone() } else { left }),
        right,
        axes: Vec::new(),
    })
}

pub(super) fn growth_form() -> impl Strategy<Value = GrowthForm> {
    let rate = prop_oneof![Just(0.1), 0.01..1.0];
    let position = prop_oneof![Just(0.0), 0.0..0.6];
    let place = (position, -170_i32..170, any::<bool>(), 0.2..1.0);
    let secondary =
        (place, bare_axis(), 0_usize..4).prop_map(|(place, axis, alike)| (place, axis, alike));
    let axes = prop::collection::vec(secondary, 0..3);
    (rate, bare_axis(), axes, any::<bool>()).prop_map(|(axial_rate, midrib, axes, nested)| {
        let mut form = GrowthForm {
            axial_rate,
            ..midrib.into()
        };
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

pub(super) fn contour() -> impl Strategy<Value = Contour> {
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
            Contour::Curve(ContourCurve { mirrored, points })
        });
    let traced = (any::<bool>(), any::<bool>()).prop_map(|(named, turned)| {
        let id = named.then_some("kite");
        let mut contour = SvgContour::parse("leaf.svg", SVG, id).expect("a good file");
        if turned {
            contour.base = contour.points[1];
        }
        Contour::Svg(contour)
    });
    prop_oneof![grown, drawn, traced, cubic(), transport(), development()]
}

pub(super) fn teeth() -> impl Strategy<Value = Vec<ToothWave>> {
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
            ..ToothWave::default()
        });
    prop::collection::vec(wave, 0..3)
}

pub(super) fn specimen() -> impl Strategy<Value = Specimen> {
    let tip = || {
        let point =
            || (0.001..0.01, 0.001..0.01).prop_map(|(length, width)| Point { length, width });
        prop_oneof![
            (0.001..0.01, 0.0..30.0).prop_map(|(diameter, anthocyanins)| {
                let mut gland = Gland {
                    diameter,
                    ..Gland::default()
                };
                gland.contents[Constituent::Anthocyanins] = anthocyanins;
                Tip::Gland(gland)
            }),
            point().prop_map(Tip::Mucro),
            point().prop_map(Tip::Awn),
        ]
    };
    let base = (0.005..0.05, 0.1..1.0).prop_flat_map(|(depth, width)| {
        prop_oneof![
            Just(BaseShape::Cordate { depth, width }),
            Just(BaseShape::Cuneate {
                height: depth,
                width
            }),
            Just(BaseShape::Peltate { inset: depth }),
        ]
    });
    let apex = (0.05..0.3, 0.1..0.9).prop_flat_map(|(length, narrowing)| {
        let depth = 0.1 * length;
        prop_oneof![
            Just(ApexShape::Acuminate { length, narrowing }),
            Just(ApexShape::Retuse {
                depth,
                width: narrowing
            }),
            Just(ApexShape::Mucronate(Point {
                length: depth,
                width: depth
            })),
        ]
    });
    let usual = || prop_oneof![Just(0.0), 0.0..0.02];
    let any = (
        prop_oneof![Just(1.0), 0.5..2.0],
        prop::option::of(base),
        usual(),
        prop::option::of(apex),
        (usual(), usual(), usual()),
        prop::option::of(tip()),
    )
        .prop_map(
            |(breadth, base, oblique, apex, (width, bow, wander), lobe_tip)| Specimen {
                breadth,
                base,
                oblique,
                apex,
                asymmetry: Asymmetry { width, bow, wander },
                lobe_tip,
            },
        );
    prop_oneof![Just(Specimen::default()), any]
}

pub(super) fn damage() -> impl Strategy<Value = Option<Damage>> {
    let dieback = (0.0..0.9, 0.0..2.0, 0.1..10.0, 0.0..1.0, 0.0..5.0).prop_map(
        |(share, from_tip, vein_speed, unevenness, rim_mm)| Dieback {
            share,
            from_tip,
            vein_speed,
            unevenness,
            rim_mm,
        },
    );
    let tears = (0_u32..100, 0.5..500.0, 0.005..0.5, 0.0..0.3);
    let dieback = prop::option::of(dieback);
    let sizes = (0_u32..200, 0.1..100.0, 0_u32..50, 0.2..20.0, 0.0..10.0);
    let damage = (sizes, tears, dieback).prop_map(|(sizes, tears, dieback)| {
        let (holes, hole_mm, mines, mine_mm, rim_mm) = sizes;
        let (tears, tear_mm, tear_gape, tear_lift) = tears;
        Damage {
            hole_mm,
            mine_mm,
            tear_mm,
            tear_gape,
            tear_lift,
            rim_mm,
            holes,
            mines,
            tears,
            dieback,
            ..Damage::default()
        }
    });
    prop::option::of(damage)
}
