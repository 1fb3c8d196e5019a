use proptest::prelude::*;

use super::*;
use properties::fixed;

/// Three numbers each of a wide sum and of two narrow ones, and one that is not summed.
const SUMS: [Sum; 10] = {
    let (wide, narrow) = (
        Sum::Wide { fraction_bits: 24 },
        Sum::Narrow { fraction_bits: 22 },
    );
    let rough = Sum::Narrow { fraction_bits: 20 };
    [
        wide,
        wide,
        wide,
        narrow,
        narrow,
        narrow,
        rough,
        rough,
        rough,
        Sum::First,
    ]
};

type Features = [f32; SUMS.len()];

const GREY: Features = [1.0, -2.0, 0.5, 0.0, 0.6, 0.8, 0.5, 0.25, 0.125, 7.0];

/// A film on which every pixel gets the samples of a list.
fn exposed(
    size: [u32; 2],
    numbers: &[u32],
    sample: impl Fn(u32, u32, u32) -> Sample + Sync,
) -> Film {
    let mut film = Film::new(size[0], size[1], &[0.25, 0.75], &SUMS).expect("a small film");
    film.expose(|block| {
        block.expose(numbers.len() as u32, |x, y, pixel| {
            for &number in numbers {
                let (values, features) = sample(x, y, number);
                pixel.add(number, &values, features.as_ref());
            }
        });
    });
    film
}

type Sample = ([f32; 2], Option<Features>);

/// All features of a pixel.
fn features(pixel: &Pixel<'_>) -> Option<[f64; SUMS.len()]> {
    let all: Option<Vec<f64>> = (0..SUMS.len())
        .map(|number| pixel.feature(number))
        .collect();
    all.map(|all| all.try_into().expect("as many as there are sums"))
}

#[test]
fn a_film_that_would_not_fit_is_refused_with_its_size() {
    for (width, height, channels) in [(1 << 20, 1 << 20, 3), (u32::MAX, u32::MAX, 32)] {
        let film = Film::new(width, height, &vec![1.0; channels], &SUMS);
        assert!(matches!(film, Err(FilmError::TooLarge { .. })));
    }
    assert!(matches!(
        Film::new(0, 5, &[1.0; 3], &SUMS),
        Err(FilmError::Empty { .. })
    ));
}

#[test]
fn a_pixel_takes_its_channels_an_error_a_count_and_its_sums() {
    let mut film = Film::new(512, 512, &[1.0; 3], &SUMS).expect("a small film");
    film.expose(|block| block.expose(1, |_, _, pixel| pixel.add::<0>(0, &[1.0; 3], None)));
    let of_halves = film
        .halves
        .iter()
        .map(|halves| size_of_val(&halves.sums[..]));
    let bytes = 3 * 32 + (1 + 3) * 7 + 3 * 3 + 4 + 3 * 8 + 7 * 4;
    assert_eq!(Film::bytes_per_pixel(3, &SUMS), bytes);
    assert_eq!(
        size_of_val(&film.moments[..])
            + size_of_val(&film.squares[..])
            + of_halves.sum::<usize>()
            + size_of_val(&film.wide[..])
            + size_of_val(&film.narrow[..]),
        bytes * 512 * 512
    );
}

#[test]
fn every_pixel_is_exposed_once_at_its_own_place() {
    for size in [[37, 23], [1, 1], [8, 16], [3, 50]] {
        let film = exposed(size, &[0], |x, y, _| ([x as f32, y as f32], None));
        for y in 0..size[1] {
            for x in 0..size[0] {
                let pixel = film.pixel(x, y);
                assert_eq!([pixel.mean(0), pixel.mean(1)], [f64::from(x), f64::from(y)]);
                assert_eq!(pixel.samples(), 1);
            }
        }
        assert_eq!(film.drawn(), u64::from(size[0] * size[1]));
        let columns = film.mean(0);
        assert!((0..size[1]).all(|y| columns[(y * size[0]) as usize] == 0.0));
    }
}

#[test]
fn a_film_has_as_many_features_as_it_was_made_with() {
    for sums in [&[][..], &[Sum::First], &SUMS[..3]] {
        let mut film = Film::new(11, 9, &[1.0], sums).expect("a small film");
        film.expose(|block| {
            block.expose(1, |_, _, pixel| {
                pixel.add(0, &[2.0], Some(&GREY));
            });
        });
        let pixel = film.pixel(10, 8);
        assert_eq!((pixel.mean(0), pixel.alpha()), (2.0, 1.0));
        for (number, value) in GREY[..sums.len()].iter().enumerate() {
            assert_eq!(pixel.feature(number), Some(f64::from(*value)));
        }
    }
}

#[test]
fn features_are_means_over_covered_samples_or_what_the_first_sample_met() {
    let mut other = GREY;
    (other[0], other[1], other[9]) = (3.0, 2.0, 10.0);
    let film = exposed([3, 1], &[0, 1, 2, 3], |x, _, number| {
        let met = match (x, number) {
            (0, 0) => Some(GREY),
            (0, 1) | (1, 3) => Some(other),
            _ => None,
        };
        ([0.0; 2], met)
    });
    let [first, second, third] = [0, 1, 2].map(|x| film.pixel(x, 0));
    assert_eq!(
        [first.alpha(), second.alpha(), third.alpha()],
        [0.5, 0.25, 0.0]
    );
    let mean = features(&first).expect("it is covered");
    assert_eq!(mean[..3], [2.0, 0.0, 0.5]);
    for (mean, exact) in mean[3..6].iter().zip(&GREY[3..6]) {
        let off = (mean - f64::from(*exact)).abs();
        assert!(
            off <= 0.5 / f64::from(1 << 22),
            "rounding takes half a unit, not {off}"
        );
    }
    let of_one = features(&second).expect("it is covered");
    assert_eq!(of_one[..3], [3.0, 2.0, 0.5]);
    assert_eq!(of_one[6..9], [0.5, 0.25, 0.125]);
    assert_eq!((mean[9], of_one[9]), (7.0, 0.0));
    assert_eq!(features(&third), None);
}

#[test]
fn coverage_counts_all_samples_and_features_the_first_of_them() {
    let numbers: Vec<u32> = (0..1000).collect();
    let film = exposed([1, 1], &numbers, |_, _, number| {
        // The extremes of what can be recorded, so that the sums show whether they fit.
        let place = if number < FEATURE_SAMPLES { -1e30 } else { 5.0 };
        let met = [place, place, place, 0.0, 0.0, 1.0, 1e30, 1e30, 1e30, 1e30];
        ([0.0; 2], (number % 4 != 3).then_some(met))
    });
    let pixel = film.pixel(0, 0);
    assert_eq!(pixel.alpha(), 0.75);
    let mean = features(&pixel).expect("it is covered");
    let far = -f64::from(1 << 26);
    assert_eq!(mean[..6], [far, far, far, 0.0, 0.0, 1.0]);
    assert!((mean[6] - 8.0).abs() < 1e-6);
    assert_eq!(mean[9], f64::from(i32::MAX));
}

#[test]
fn a_sample_that_is_not_finite_is_rejected_whole_and_a_huge_one_clamped() {
    let film = exposed([9, 1], &[0, 1, 2, 3], |x, _, number| {
        let values = match number {
            _ if x != 8 => [1.0; 2],
            0 => [1.0, f32::NAN],
            1 => [f32::INFINITY, 1.0],
            _ => [3.0, 1e30],
        };
        let mut met = GREY;
        if x == 8 && number == 3 {
            met[1] = f32::NAN;
        }
        (values, Some(met))
    });
    let pixel = film.pixel(8, 0);
    assert_eq!((film.rejected(), film.clamped(), film.drawn()), (3, 1, 36));
    assert_eq!((pixel.samples(), pixel.alpha()), (1, 1.0));
    assert_eq!((pixel.mean(0), pixel.mean(1)), (3.0, f64::from(1 << 30)));
    assert_eq!(film.pixel(7, 0).samples(), 4);
}

#[test]
fn sums_of_many_great_values_are_those_of_each_by_itself() {
    // The squares of so many would not fit into one run of values; 2²⁰ is no number for a run.
    let numbers: Vec<u32> = (0..20_000).collect();
    let value = |x: u32, number: u32| {
        if (x + number) % 3 == 2 {
            1_048_576.0
        } else {
            524_288.0
        }
    };
    let film = exposed([2, 1], &numbers, |x, _, number| {
        ([value(x, x * number), 524_288.0], None)
    });
    for x in 0..2 {
        let mut expected = [Moments::default(); 2];
        for &number in &numbers {
            expected[0].add(value(x, x * number));
            expected[1].add(524_288.0);
        }
        let place = 2 * x as usize;
        assert_eq!(film.moments[place..place + 2], expected);
    }
}

#[test]
fn the_errors_of_luminance_and_of_channels_are_those_of_means_of_batches() {
    // Samples of a batch are evenly spread, and channels err against one another: what varies from
    // batch to batch is all that luminance errs by.
    let values = |number: u32| {
        let of_batch = [1.0, 3.0, 2.0, 6.0][(number / BATCH) as usize % 4];
        let even = if number.is_multiple_of(2) { 4.0 } else { -4.0 };
        [of_batch + 3.0 * even, of_batch - even]
    };
    let film = |count: u32| {
        let numbers: Vec<u32> = (0..count).collect();
        exposed([9, 1], &numbers, |_, _, number| (values(number), None))
    };
    // Variance of 1, 3, 2, 6 with n − 1: 14/3.
    for (count, expected) in [
        (32, 2.0 / 2.0),
        (64, 14.0 / 3.0 / 4.0),
        (72, 14.0 / 3.0 / 4.0 * 64.0 / 72.0),
    ] {
        let film = film(count);
        let found = film.pixel(8, 0).variance(Series::Luminance);
        assert!((found - expected).abs() < 1e-6, "{count}: {found}");
        for channel in 0..2 {
            let pixel = film.pixel(8, 0);
            let found = pixel.variance(Series::Channel(channel));
            assert!((found - expected).abs() < 1e-6, "{count}: {found}");
        }
        assert!(film.pixel(8, 0).moments(0).variance_of_mean(count) > expected);
    }
    // One batch alone tells nothing: the bound by single samples, 0.25 · 12 + 0.75 · 4 by a mean.
    let found = film(16).pixel(0, 0).variance(Series::Luminance);
    assert!((found - 36.0 / 15.0).abs() < 1e-9, "{found}");
    let film = film(16);
    let pixel = film.pixel(0, 0);
    assert_eq!(
        pixel.variance(Series::Channel(1)),
        pixel.moments(1).variance_of_mean(16)
    );
    // A single channel is luminance itself, but for its scale.
    let mut one = Film::new(1, 1, &[0.5], &[]).expect("a small film");
    one.expose(|block| {
        block.expose(64, |_, _, pixel| {
            for number in 0..64 {
                let [value, _] = values(number);
                pixel.add(number, &[value], None::<&[f32; 0]>);
            }
        });
    });
    let found = one.pixel(0, 0).variance(Series::Channel(0));
    assert!((found - 14.0 / 3.0 / 4.0).abs() < 1e-6, "{found}");
}

#[test]
fn a_pixel_whose_samples_were_all_rejected_has_no_error() {
    let numbers: Vec<u32> = (0..64).collect();
    let film = exposed([1, 1], &numbers, |_, _, _| ([f32::NAN; 2], None));
    let pixel = film.pixel(0, 0);
    assert_eq!((pixel.samples(), pixel.luminance()), (0, 0.0));
    assert_eq!(pixel.variance(Series::Luminance), 0.0);
}

#[test]
fn luminance_beyond_what_is_stored_has_the_error_of_single_samples() {
    let numbers: Vec<u32> = (0..64).collect();
    let film = exposed([1, 1], &numbers, |_, _, number| {
        ([number as f32 * 1e3; 2], None)
    });
    let pixel = film.pixel(0, 0);
    let expected = pixel.moments(0).variance_of_mean(64);
    let found = pixel.variance(Series::Luminance);
    assert!(
        (found / expected - 1.0).abs() < 1e-9,
        "{found}, not {expected}"
    );
}

/// Any finite sample, now and then one that is not finite, with or without a feature.
fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let value = prop_oneof![9 => -1e4_f32..1e6, 1 => Just(f32::NAN), 1 => Just(3e10_f32)];
    let met = (-1e3_f32..1e3, -1.0_f32..1.0, 1_u16..9).prop_map(|(place, small, object)| {
        let object = f32::from(object);
        [
            place, -place, small, small, small, small, small, small, small, object,
        ]
    });
    let sample = ([value.clone(), value], prop::option::of(met));
    prop::collection::vec(sample, 1..40)
}

/// Adds another film's samples.
pub(super) fn added(film: &mut Film, other: &Film) {
    let rows: Vec<_> = (0..other.rows()).map(|row| other.packed_row(row)).collect();
    film.add_rows(|row, sums| sums.add(&rows[row]))
        .expect("rows of the same film");
    film.add_fault_counts(&other.fault_counts())
        .expect("the film has these pixels");
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn samples_in_any_order_and_grouping_give_the_same_film(
        samples in samples(),
        cuts in prop::collection::vec(0_u32..40, 2),
    ) {
        let of = |numbers: &[u32]| {
            exposed([3, 2], numbers, |x, _, number| samples[(number + x) as usize % samples.len()])
        };
        // Numbers around the last that records features.
        let first = FEATURE_SAMPLES - 20;
        let numbers: Vec<u32> = (0..1).chain(first..first + samples.len() as u32).collect();
        let whole = of(&numbers);
        let backwards: Vec<u32> = numbers.iter().rev().copied().collect();
        prop_assert_eq!(&whole, &of(&backwards));
        let low = cuts[0].min(cuts[1]) as usize % numbers.len();
        let high = (cuts[0].max(cuts[1]) as usize % numbers.len()).max(low);
        let parts = [&numbers[..low], &numbers[low..high], &numbers[high..]].map(of);
        let [mut left, mut middle, right] = parts.clone();
        added(&mut left, &parts[1]);
        added(&mut left, &right);
        prop_assert_eq!(&whole, &left);
        added(&mut middle, &right);
        added(&mut middle, &parts[0]);
        prop_assert_eq!(&whole, &middle);
    }
}
