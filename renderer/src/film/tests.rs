use proptest::prelude::*;

use super::*;

const GREY: Feature = Feature {
    position: [1.0, -2.0, 0.5],
    normal: [0.0, 0.6, 0.8],
    albedo: [0.5, 0.25, 0.125],
    object: 6,
};

/// A film on which every pixel gets the samples of a list.
fn exposed(
    size: [u32; 2],
    numbers: &[u32],
    sample: impl Fn(u32, u32, u32) -> Sample + Sync,
) -> Film {
    let mut film = Film::new(size[0], size[1], 2, true).expect("a small film");
    film.expose(|block| {
        block.expose(numbers.len() as u32, |x, y, pixel| {
            for &number in numbers {
                let (values, feature) = sample(x, y, number);
                pixel.add(number, &values, feature.as_ref());
            }
        });
    });
    film
}

type Sample = ([f32; 2], Option<Feature>);

#[test]
fn a_film_that_would_not_fit_is_refused_with_its_size() {
    for (width, height, channels) in [(1 << 20, 1 << 20, 3), (u32::MAX, u32::MAX, 32)] {
        let film = Film::new(width, height, channels, true);
        assert!(matches!(film, Err(FilmError::TooLarge { .. })));
    }
    assert!(matches!(
        Film::new(0, 5, 3, true),
        Err(FilmError::Empty { .. })
    ));
}

#[test]
fn a_pixel_of_colour_takes_at_most_160_bytes() {
    let of_its_block = size_of::<u32>() as f64 / f64::from(BLOCK_SIDE * BLOCK_SIDE);
    let film = Film::new(512, 512, 3, true).expect("a small film");
    assert!(Film::bytes_a_pixel(3, true) as f64 + of_its_block <= 160.0);
    assert_eq!(
        size_of_val(&film.moments[..])
            + size_of_val(&film.positions[..])
            + size_of_val(&film.surfaces[..])
            + size_of_val(&film.albedos[..]),
        Film::bytes_a_pixel(3, true) * 512 * 512
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
fn a_film_without_albedo_records_the_rest() {
    let mut film = Film::new(11, 9, 1, false).expect("a small film");
    film.expose(|block| {
        block.expose(1, |_, _, pixel| pixel.add(0, &[2.0], Some(&GREY)));
    });
    let pixel = film.pixel(10, 8);
    assert_eq!((pixel.mean(0), pixel.alpha()), (2.0, 1.0));
    assert_eq!(pixel.position(), Some([1.0, -2.0, 0.5]));
    assert_eq!(pixel.albedo(), [0.0; 3]);
}

#[test]
fn features_are_means_over_covered_samples_and_the_object_is_the_first_samples() {
    let other = Feature {
        position: [3.0, 2.0, 0.5],
        object: 9,
        ..GREY
    };
    let film = exposed([2, 1], &[0, 1, 2, 3], |x, _, number| {
        let feature = match (x, number) {
            (0, 0) => Some(GREY),
            (0, 1) | (1, 3) => Some(other),
            _ => None,
        };
        ([0.0; 2], feature)
    });
    let (first, second) = (film.pixel(0, 0), film.pixel(1, 0));
    assert_eq!((first.alpha(), second.alpha()), (0.5, 0.25));
    assert_eq!(first.position(), Some([2.0, 0.0, 0.5]));
    assert_eq!(second.position(), Some([3.0, 2.0, 0.5]));
    let normal = first.normal();
    for (mean, exact) in normal.into_iter().zip(GREY.normal) {
        let off = (mean - f64::from(exact)).abs();
        assert!(
            off <= 0.5 / f64::from(1 << 22),
            "rounding takes half a unit, not {off}"
        );
    }
    assert_eq!(second.albedo(), [0.5, 0.25, 0.125]);
    assert_eq!((first.object(), second.object()), (7, 0));
}

#[test]
fn coverage_counts_all_samples_and_features_the_first_of_them() {
    let numbers: Vec<u32> = (0..1000).collect();
    let film = exposed([1, 1], &numbers, |_, _, number| {
        // The extremes of what can be recorded, so that the sums show whether they fit.
        let place = if number < FEATURE_SAMPLES { -1e30 } else { 5.0 };
        let feature = Feature {
            position: [place; 3],
            normal: [0.0, 0.0, 1.0],
            albedo: [1e30; 3],
            object: 0,
        };
        ([0.0; 2], (number % 4 != 3).then_some(feature))
    });
    let pixel = film.pixel(0, 0);
    assert_eq!(pixel.alpha(), 0.75);
    let far = -f64::from(1 << 30);
    assert_eq!(pixel.position(), Some([far; 3]));
    assert_eq!(pixel.normal(), [0.0, 0.0, 1.0]);
    assert!((pixel.albedo()[0] - 8.0).abs() < 1e-6);
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
        let nowhere = Feature {
            position: [f32::NAN; 3],
            ..GREY
        };
        let feature = if x == 8 && number == 3 { nowhere } else { GREY };
        (values, Some(feature))
    });
    let pixel = film.pixel(8, 0);
    assert_eq!((film.rejected(), film.clamped(), film.drawn()), (3, 1, 36));
    assert_eq!((pixel.samples(), pixel.alpha()), (1, 1.0));
    assert_eq!((pixel.mean(0), pixel.mean(1)), (3.0, f64::from(1 << 30)));
    assert_eq!(film.pixel(7, 0).samples(), 4);
}

/// Any finite sample, now and then one that is not finite, with or without a feature.
fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let value = prop_oneof![9 => -1e4_f32..1e6, 1 => Just(f32::NAN), 1 => Just(3e10_f32)];
    let feature = (-1e3_f32..1e3, -1.0_f32..1.0, 0_u32..9).prop_map(|(place, small, object)| {
        let (position, normal, albedo) = ([place, -place, small], [small; 3], [small; 3]);
        Feature {
            position,
            normal,
            albedo,
            object,
        }
    });
    let sample = ([value.clone(), value], prop::option::of(feature));
    prop::collection::vec(sample, 1..40)
}

proptest! {
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
        left.merge(&parts[1]);
        left.merge(&right);
        prop_assert_eq!(&whole, &left);
        middle.merge(&right);
        middle.merge(&parts[0]);
        prop_assert_eq!(&whole, &middle);
    }
}
