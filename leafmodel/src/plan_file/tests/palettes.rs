//! Pigments by chance.

use crate::optics::Pigments;
use crate::optics::betalains::{Betacyanin, Betaxanthin};
use crate::optics::pigments::{AnthocyaninMix, CarotenoidMix, ChlorophyllMix};
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
