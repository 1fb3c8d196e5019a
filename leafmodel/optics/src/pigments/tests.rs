use super::*;
use crate::Constituent::{Anthocyanins, Betacyanins, Betaxanthins, Carotenoids, Chlorophyll};
use crate::betalains::{Betacyanin, Betaxanthin};
use crate::{PerConstituent, ProspectD};

fn at(pigments: &Pigments, nm: f64) -> PerConstituent<f64> {
    ProspectD::coefficients_of(pigments, nm).absorption
}

/// Whole nanometre of the greatest value in a range.
fn peak(range: std::ops::RangeInclusive<u32>, value: impl Fn(f64) -> f64) -> f64 {
    range
        .map(f64::from)
        .max_by(|a, b| value(*a).total_cmp(&value(*b)))
        .expect("a range with something in it")
}

fn only<const N: usize>(index: usize) -> [f64; N] {
    std::array::from_fn(|i| f64::from(u8::from(i == index)))
}

fn aglycones(shares: [f64; 6], shift_nm: f64, blue_fraction: f64) -> Pigments {
    Pigments {
        anthocyanins: Some(AnthocyaninMix {
            shift_nm,
            blue_fraction,
            shares,
        }),
        ..Pigments::default()
    }
}

#[test]
fn the_default_is_prospect_to_the_bit_and_so_is_pure_cyanidin() {
    let cyanidin = aglycones(only(1), 0.0, 0.0);
    for nm in 400..=2500 {
        let nm = f64::from(nm);
        let own = ProspectD::coefficients(nm).expect("in range");
        assert_eq!(ProspectD::coefficients_of(&Pigments::default(), nm), own);
        assert_eq!(ProspectD::coefficients_of(&cyanidin, nm), own, "{nm} nm");
    }
}

#[test]
fn chlorophylls_peak_where_they_do_in_ether_and_in_leaves_18_nm_further() {
    let of = |bands: bands::Bands, shift| move |nm: f64| bands.shape(nm, shift);
    assert!((peak(400..=500, of(chlorophyll::A, 0.0)) - 428.0).abs() <= 1.0);
    assert!((peak(600..=720, of(chlorophyll::A, 0.0)) - 661.0).abs() <= 1.0);
    assert!((peak(600..=720, of(chlorophyll::A, -400.0)) - 679.0).abs() <= 1.0);
    assert!((peak(400..=500, of(chlorophyll::B, 0.0)) - 453.0).abs() <= 1.0);
    assert!((peak(600..=720, of(chlorophyll::B, 0.0)) - 643.0).abs() <= 1.0);
    for bands in [chlorophyll::A, chlorophyll::B] {
        let top = (400..=500).map(|nm| bands.shape(f64::from(nm), 0.0));
        assert!((top.fold(0.0, f64::max) - 1.0).abs() < 0.02);
    }
}

#[test]
fn carotenoids_peak_where_they_do_in_methanol() {
    let nm = [449.0, 442.0, 448.0, 436.0, 468.0];
    for ((name, carotenoid), want) in Carotenoid::WORDS.iter().zip(nm) {
        let bands = carotenoid.in_solution();
        let got = peak(400..=520, |nm| bands.shape(nm, 0.0));
        assert!((got - want).abs() <= 2.0, "{name}: {got}");
    }
}

#[test]
fn anthocyanins_peak_at_their_aglycone_with_the_height_of_epsilon_over_mass() {
    let cyanidin = at(&Pigments::default(), 535.0)[Anthocyanins];
    for (index, (_, aglycone)) in Aglycone::WORDS.iter().enumerate() {
        let pigments = aglycones(only(index), 0.0, 0.0);
        let value = |nm: f64| at(&pigments, nm)[Anthocyanins];
        let got = peak(480..=600, value);
        assert!((got - aglycone.peak_nm()).abs() <= 1.0, "{got}");
        let height = aglycone.epsilon() / aglycone.molar_mass() / (26_900.0 / 449.4);
        assert!((value(got) / cyanidin / height - 1.0).abs() < 2e-3);
    }
    let moved = aglycones(only(1), 15.0, 0.0);
    assert!((peak(480..=640, |nm| at(&moved, nm)[Anthocyanins]) - 550.0).abs() <= 1.0);
    let blue = aglycones(only(1), 0.0, 1.0);
    assert!((peak(480..=640, |nm| at(&blue, nm)[Anthocyanins]) - 585.0).abs() <= 1.0);
}

#[test]
fn betalains_peak_where_their_class_does() {
    let pigments = Pigments {
        betalains: Betalains {
            betacyanin: Betacyanin::Amaranthine,
            betaxanthin: Betaxanthin::Vulgaxanthin,
            ..Betalains::default()
        },
        ..Pigments::default()
    };
    assert!((at(&pigments, 536.0)[Betacyanins] - 0.090).abs() < 5e-4);
    assert!((at(&pigments, 477.0)[Betaxanthins] - 0.163).abs() < 5e-4);
}

#[test]
fn a_mix_is_linear_in_its_shares() {
    let shares = [0.3, 0.4, 0.1, 0.1, 0.1];
    let mixed = CarotenoidMix::bands(shares);
    let of = |a_to_b, nm| ChlorophyllMix::bands(a_to_b).specific(nm, |_| f64::NAN);
    for nm in [420.0, 455.5, 490.0, 555.0] {
        let parts: f64 = (0..5)
            .map(|i| shares[i] * CarotenoidMix::bands(only(i)).specific(nm))
            .sum();
        let whole = mixed.specific(nm);
        assert!((whole - parts).abs() < 1e-15);
        // a/b = 3 is three parts of a and one of b; a/b = 1e6 still has a trace of b.
        let a = of(1e6, nm);
        let b = of(0.0, nm);
        let three = of(3.0, nm);
        assert!((three - (0.75 * a + 0.25 * b)).abs() < 1e-4 * three);
    }
}

#[test]
fn a_to_b_of_leaves_is_near_the_column_of_prospect() {
    let pigments = Pigments {
        chlorophyll: Some(ChlorophyllMix::bands(ChlorophyllMix::A_TO_B)),
        ..Pigments::default()
    };
    let rms = |range: std::ops::RangeInclusive<u32>| {
        let n = f64::from(range.end() - range.start() + 1);
        let squares: f64 = range
            .map(f64::from)
            .map(|nm| at(&pigments, nm)[Chlorophyll] - at(&Pigments::default(), nm)[Chlorophyll])
            .map(|off| off * off)
            .sum();
        (squares / n).sqrt()
    };
    let (red, blue) = (rms(600..=720), rms(400..=500));
    // Measured: 0.0157 and 0.0193 cm² µg⁻¹, of peaks of 0.07 and 0.09: bands in ether are narrower
    // than in leaves.
    assert!(red < 0.0165 && blue < 0.0203, "{red}, {blue}");
}

#[test]
fn at_the_usual_a_to_b_the_apportioned_column_is_prospects_to_the_bit() {
    let usual = Pigments {
        chlorophyll: Some(ChlorophyllMix::default()),
        ..Pigments::default()
    };
    for nm in 400..=2500 {
        let nm = f64::from(nm);
        assert_eq!(at(&usual, nm), at(&Pigments::default(), nm), "{nm} nm");
    }
}

#[test]
fn more_b_absorbs_more_where_b_does_and_less_at_the_red_peak_of_a() {
    let of = |a_to_b, nm| {
        let pigments = Pigments {
            chlorophyll: Some(ChlorophyllMix {
                a_to_b,
                ..ChlorophyllMix::default()
            }),
            ..Pigments::default()
        };
        at(&pigments, nm)[Chlorophyll]
    };
    let usual = ChlorophyllMix::A_TO_B;
    // b absorbs in the leaf near 461 and 660 nm, a near 435 and 679 nm.
    for (nm, more) in [(461.0, true), (655.0, true), (435.0, false), (679.0, false)] {
        assert_eq!(of(1.0, nm) > of(usual, nm), more, "{nm} nm");
        assert_eq!(of(9.0, nm) < of(usual, nm), more, "{nm} nm");
    }
    // Linear in the shares, finite and at least 0 to the end of the column.
    for nm in 400..=800 {
        let nm = f64::from(nm);
        let (a, b) = (of(1e6, nm), of(0.0, nm));
        assert!(
            a >= 0.0 && b >= 0.0 && a.is_finite() && b.is_finite(),
            "{nm} nm"
        );
        assert!(
            (of(3.0, nm) - (0.75 * a + 0.25 * b)).abs() <= 1e-5 * (a + b),
            "{nm} nm"
        );
    }
}

#[test]
fn bands_vanish_smoothly_beyond_the_range_of_their_data() {
    let pigments = Pigments {
        chlorophyll: Some(ChlorophyllMix::bands(3.0)),
        carotenoids: Some(CarotenoidMix::bands(only(4))),
        ..aglycones(only(5), 45.0, 0.3)
    };
    for nm in 800..=2500 {
        let k = at(&pigments, f64::from(nm));
        assert_eq!([k[Chlorophyll], k[Carotenoids], k[Anthocyanins]], [0.0; 3]);
    }
    // No step greater than what the steepest flank of a band makes in 1 nm.
    for nm in 400..800 {
        let (low, high) = (
            at(&pigments, f64::from(nm)),
            at(&pigments, f64::from(nm + 1)),
        );
        for (a, b) in [
            (low[Chlorophyll], high[Chlorophyll]),
            (low[Carotenoids], high[Carotenoids]),
            (low[Anthocyanins], high[Anthocyanins]),
        ] {
            assert!(a >= 0.0 && (a - b).abs() < 0.012, "{nm} nm: {a}, {b}");
        }
    }
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let path = |pigments: Pigments| pigments.in_range().expect_err("it is wrong").path;
    assert!(Pigments::default().in_range().is_ok());
    let chlorophyll = |mix| Pigments {
        chlorophyll: Some(mix),
        ..Pigments::default()
    };
    let solution = ChlorophyllMix::bands(3.0);
    for (mix, wanted) in [
        (ChlorophyllMix::bands(-1.0), "chlorophyll.a_to_b"),
        (
            ChlorophyllMix {
                packaging: 0.0,
                ..solution
            },
            "chlorophyll.packaging",
        ),
        (
            ChlorophyllMix {
                shift_per_cm: 4000.0,
                ..solution
            },
            "chlorophyll.shift_per_cm",
        ),
    ] {
        assert_eq!(path(chlorophyll(mix)), wanted);
    }
    let carotenoids = Some(CarotenoidMix::bands([1.5, 0.0, 0.0, 0.0, 0.0]));
    assert_eq!(
        path(Pigments {
            carotenoids,
            ..Pigments::default()
        }),
        "carotenoids.shares.beta_carotene"
    );
    let betalains = Betalains {
        packaging: f64::NAN,
        ..Betalains::default()
    };
    let packed = Pigments {
        betalains,
        ..Pigments::default()
    };
    assert_eq!(path(packed), "betalains.packaging");
    assert_eq!(path(aglycones(only(0), 46.0, 0.0)), "anthocyanins.shift_nm");
    assert_eq!(
        path(aglycones(only(0), 0.0, 1.1)),
        "anthocyanins.blue_fraction"
    );
}

#[test]
fn every_figure_has_a_source() {
    let figures = Pigments::figures();
    assert!(figures.len() > 25);
    for figure in figures {
        assert!(
            figure.value.is_finite() && !figure.source.is_empty(),
            "{figure:?}"
        );
    }
}
