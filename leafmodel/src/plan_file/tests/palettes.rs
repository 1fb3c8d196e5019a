//! Pigments by chance.

use crate::optics::betalains::{Betacyanin, Betalains, Betaxanthin};
use crate::optics::pigments::{AnthocyaninMix, CarotenoidMix, ChlorophyllBands, ChlorophyllMix};
use crate::optics::{Model, Pigments};
use proptest::prelude::*;

/// Shares that sum to 1, some of them 0.
fn shares<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    proptest::array::uniform(prop_oneof![Just(0_u32), 1_u32..10]).prop_map(|mut parts: [u32; N]| {
        parts[0] += u32::from(parts.iter().all(|part| *part == 0));
        let sum = f64::from(parts.iter().sum::<u32>());
        parts.map(|part| f64::from(part) / sum)
    })
}

pub(super) fn pigments() -> impl Strategy<Value = Pigments> {
    let factor = || prop_oneof![Just(0.41), Just(0.29), Just(0.5), 0.01..1.0];
    let chlorophyll = prop_oneof![
        Just(None),
        (0.0..9.0).prop_map(|a_to_b| Some(ChlorophyllMix {
            a_to_b,
            ..ChlorophyllMix::default()
        })),
        (0.0..9.0).prop_map(|a_to_b| Some(ChlorophyllMix::bands(a_to_b))),
        (0.0..9.0, -500.0..500.0, factor()).prop_map(|(a_to_b, shift_per_cm, packaging)| {
            Some(ChlorophyllMix {
                bands: ChlorophyllBands::Solution,
                a_to_b,
                shift_per_cm,
                packaging,
            })
        }),
    ];
    let carotenoids = prop_oneof![
        Just(None),
        shares().prop_map(|shares| Some(CarotenoidMix::bands(shares))),
        (shares(), -1500.0..0.0, factor()).prop_map(|(shares, shift_per_cm, packaging)| {
            Some(CarotenoidMix {
                shift_per_cm,
                packaging,
                shares,
            })
        }),
    ];
    let aglycones = prop_oneof![Just([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]), shares()];
    let numbers = (
        prop_oneof![Just(0.0), 0.0..45.0],
        prop_oneof![Just(0.0), 0.0..1.0],
    );
    let anthocyanins = prop_oneof![
        Just(None),
        (aglycones, numbers).prop_map(|(shares, (shift_nm, blue_fraction))| {
            Some(AnthocyaninMix {
                shift_nm,
                blue_fraction,
                shares,
            })
        }),
    ];
    let betacyanin = prop_oneof![Just(Betacyanin::Betanin), Just(Betacyanin::Amaranthine)];
    let betaxanthin = prop_oneof![
        Just(Betaxanthin::Indicaxanthin),
        Just(Betaxanthin::Vulgaxanthin)
    ];
    let betalains = (betacyanin, betaxanthin, factor());
    (chlorophyll, carotenoids, anthocyanins, betalains).prop_map(
        |(chlorophyll, carotenoids, anthocyanins, (betacyanin, betaxanthin, packaging))| Pigments {
            model: Model::default(),
            extra: None,
            chlorophyll,
            carotenoids,
            anthocyanins,
            betalains: Betalains {
                betacyanin,
                betaxanthin,
                packaging,
            },
        },
    )
}
