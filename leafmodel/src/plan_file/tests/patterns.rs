//! Ageing, layers and mosaics by chance.

use crate::blade::ageing::{Course, Delay};
use crate::blade::ageing_courses::{COURSES, LITTER};
use crate::blade::layers::{Change, Layer, Mode};
use crate::blade::masks::{Mask, RimWidth};
use crate::mosaic::pattern::{LeafFaces, MosaicPattern};
use crate::mosaic::plan::{CellType, MosaicPlan, RadiusRule};

use super::*;
use crate::optics::{Constituent, Contents};

pub(super) fn senescence() -> impl Strategy<Value = Option<Senescence>> {
    let blend = prop_oneof![Just(0.08), 0.001..1.0];
    let contents = (1.0..4.0, of_each(0.0..1.0)).prop_map(|(structure, rest)| {
        let mut held = Contents(rest).with(&[(Constituent::Structure, structure)]);
        held[Constituent::Carotenoids] *= 20.0;
        held
    });
    let aged = (0.0..1.0, blend, contents).prop_map(|(share, blend, contents)| Senescence {
        source: AgeSource::Revenue { share },
        blend,
        contents,
    });
    let days = (0.0..200.0, 0..5_usize, prop::array::uniform5(0.1..1.0)).prop_map(
        |(day, which, [a, b, c, d, e])| {
            let (_, course) = COURSES[which];
            let onset = Delay {
                veins_days: 40.0 * (a - b),
                veins_order: (1.0 + 19.0 * c) as u8,
                margin_days: 9.0 * d,
                tip_days: 30.0 * (c - e),
                noise_days: 12.0 * e,
                ..course.onset
            };
            let course = Course {
                onset,
                half_days: 20.0 * a,
                labile_carotenoids: b,
                anthocyanins: 30.0 * c,
                death_day: 90.0 * d,
                ..course
            };
            Senescence {
                source: AgeSource::Day { day, course },
                blend: 10.0 * e,
                contents: LITTER,
            }
        },
    );
    prop::option::of(prop_oneof![aged, days])
}

/// Of these there are small numbers.
const RARE: [Constituent; 5] = [
    Constituent::Brown,
    Constituent::Water,
    Constituent::DryMatter,
    Constituent::Proteins,
    Constituent::CarbonBased,
];
/// How small.
const BULK: f64 = 0.02;

fn mask() -> impl Strategy<Value = Mask> {
    let softness = || prop_oneof![Just(0.5), 0.001..9.0];
    let width = prop_oneof![
        (0.0..20.0).prop_map(RimWidth::Mm),
        (0.0..2.0).prop_map(RimWidth::HalfWidths)
    ];
    let wander = prop_oneof![Just(0.0), 0.0..1.0];
    prop_oneof![
        Just(Mask::Everywhere),
        (width, softness(), wander, 0.1..9.0).prop_map(
            |(width, softness_mm, wander, wander_scale_mm)| Mask::Margin {
                width,
                softness_mm,
                wander,
                wander_scale_mm,
            }
        ),
        (1_u8..20, 0_u8..9, 0.0..9.0, softness(), any::<bool>()).prop_map(
            |(first, more, width_mm, softness_mm, outside)| Mask::Veins {
                orders: [first, (first + more).min(20)],
                width_mm,
                softness_mm,
                outside,
            }
        ),
        (0.0..9.0, softness()).prop_map(|(width_mm, softness_mm)| Mask::Midrib {
            width_mm,
            softness_mm,
        }),
        (0.0..0.5, 0.51..1.0, any::<bool>()).prop_map(|(low, high, up)| {
            let (from, to) = if up { (low, high) } else { (high, low) };
            Mask::BaseToTip { from, to }
        }),
        (
            (0.01..50.0, -1.0..1.0, 0.001..2.0),
            prop::option::of(1_u32..300)
        )
            .prop_map(|((scale_mm, threshold, softness), repeat_cells)| {
                Mask::Noise {
                    scale_mm,
                    threshold,
                    softness,
                    repeat_cells,
                }
            }),
    ]
}

fn layer() -> impl Strategy<Value = Layer> {
    let modes = [Mode::Replace, Mode::Add, Mode::Multiply];
    let values = of_each(prop::option::of(1.0..10.0));
    let share = prop_oneof![Just(1.0), 0.0..1.0];
    (mask(), share, 0..3_usize, values, 0.0..40.0).prop_map(
        move |(mask, share, mode, mut values, chlorophyll)| {
            // One at least.
            values[Constituent::Chlorophyll] = Some(chlorophyll);
            for rare in RARE {
                values[rare] = values[rare].map(|value| BULK * value);
            }
            Layer {
                name: String::new(),
                mask,
                share,
                change: Change::Values {
                    mode: modes[mode],
                    values,
                },
            }
        },
    )
}

/// None to three layers with names of their own.
pub(super) fn layers_by_chance() -> impl Strategy<Value = Vec<Layer>> {
    prop::collection::vec(layer(), 0..4).prop_map(|mut layers| {
        for (number, layer) in layers.iter_mut().enumerate() {
            layer.name = format!("layer-{number}");
        }
        layers
    })
}

/// Perhaps a mosaic of one to three types. Shares are whole sixteenths, so that what is left to the
/// last is exact.
pub(super) fn mosaic_by_chance() -> impl Strategy<Value = Option<MosaicPattern>> {
    let sixteenths = || prop::array::uniform3(0_u32..6);
    let rows = prop::array::uniform3(sixteenths());
    let held = prop::array::uniform3(of_each(1.0..9.0));
    let numbers = (1..9000_usize, 0.0..90.0, 0.1..10.0, 0.0..5.0);
    let choices = (any::<bool>(), any::<bool>(), any::<bool>());
    let pattern = (1..4_usize, sixteenths(), rows, held, numbers, choices).prop_map(
        |(count, shares, rows, held, (initial_cells, days, radius_weight, blend_mm), choices)| {
            let part = |sixteenths: u32| f64::from(sixteenths) / 16.0;
            // The type itself, or the first, has the rest.
            let whole = |of: [u32; 3], own: usize| -> Vec<f64> {
                let others: u32 = (0..count).filter(|&i| i != own).map(|i| of[i]).sum();
                (0..count)
                    .map(|i| part(if i == own { 16 - others } else { of[i] }))
                    .collect()
            };
            let (daily, both, immortal) = choices;
            let initial = whole(shares, 0);
            let kind = |i: usize| CellType {
                name: format!("type-{i}"),
                division_days: if immortal && i == 0 {
                    f64::INFINITY
                } else {
                    0.5 + part(shares[i])
                },
                initial_probability: initial[i],
                switching: whole(rows[i], i),
                // Symmetric.
                adhesion: (0..count).map(|j| part(rows[i.min(j)][i.max(j)])).collect(),
            };
            MosaicPattern {
                plan: MosaicPlan {
                    initial_cells,
                    days,
                    radius_weight,
                    radius: if daily {
                        RadiusRule::Daily
                    } else {
                        RadiusRule::Initial
                    },
                    types: (0..count).map(kind).collect(),
                    ..MosaicPlan::default()
                },
                contents: held[..count]
                    .iter()
                    .map(|held| {
                        let mut held = Contents(*held);
                        for rare in RARE {
                            held[rare] *= BULK;
                        }
                        held
                    })
                    .collect(),
                blend_mm,
                faces: if both {
                    LeafFaces::Both
                } else {
                    LeafFaces::Through
                },
            }
        },
    );
    prop::option::of(pattern)
}
