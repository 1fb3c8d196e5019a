use optics::{ProspectD, presets};

use super::*;
use crate::spectrum::cie;

#[test]
fn bands_count_by_their_mean_or_a_quarter_of_the_brightest_without_lanes_beyond() {
    let bands = [500.0, 700.0].map(|center_nm| Band {
        center_nm,
        width_nm: 10.0,
    });
    let sampler = WavelengthSampler::new(&FilmKind::Spectral {
        bands: bands.to_vec(),
    });
    let seen = |lanes| sampler.brightness(&sampler.draw::<4>(0.5, 0), &Lanes(lanes));
    assert_eq!(seen([3.0, 3.0, 100.0, 0.0]), 3.0);
    assert_eq!(seen([7.0, 1.0, 0.0, 0.0]), 4.0);
    assert_eq!(seen([0.0, 0.0, 1.0, 1.0]), 0.0);
    let one_of_eight: [f32; 8] = std::array::from_fn(|i| if i == 5 { 1.0 } else { 0.0 });
    assert_eq!(seen_by_bands(&one_of_eight), 0.25);
}

#[test]
fn the_mean_over_drawn_wavelengths_is_the_colour_of_the_spectrum() {
    let sampler = WavelengthSampler::rgb([360.0, 830.0], &Observer::Cie1931);
    let spectrum = |nm: f32| 0.2 + (nm - 360.0) / 400.0;
    let mut mean = [0.0_f64; 3];
    let draws = ROWS;
    for i in 0..draws {
        let wavelengths = sampler.draw::<8>((i as f32 + 0.5) / draws as f32, 0);
        let radiance = Lanes::from_fn(|lane| spectrum(wavelengths.nm[lane]));
        let mut rgb = [0.0; 3];
        sampler.film_values(&wavelengths, &radiance, &mut rgb);
        for (sum, value) in mean.iter_mut().zip(rgb) {
            *sum += f64::from(value) / draws as f64;
        }
    }
    let expected = cie::srgb_from_xyz(cie::xyz_of(|nm| f64::from(spectrum(nm as f32))));
    for (value, reference) in mean.iter().zip(expected) {
        assert!(
            (value - reference).abs() < 1e-4,
            "{mean:?} against {expected:?}"
        );
    }
}

#[test]
fn what_the_film_sees_of_a_share_is_that_share_and_nothing_of_what_the_eye_does_not_see() {
    let sampler = WavelengthSampler::rgb([400.0, 2500.0], &Observer::Cie1931);
    let (mut even, mut infrared) = (0.0, 0.0);
    for row in 0..ROWS {
        let wavelengths = sampler.draw::<8>((row as f32 + 0.5) / ROWS as f32, 0);
        even += sampler.brightness(&wavelengths, &Lanes::splat(0.25)) / ROWS as f32;
        let beyond = |lane: usize| f32::from(wavelengths.nm[lane] > 780.0);
        infrared += sampler.brightness(&wavelengths, &Lanes::from_fn(beyond)) / ROWS as f32;
    }
    // The greatest of three sums, each of which scatters around the share.
    assert!((0.25..0.26).contains(&even), "{even}");
    assert!(infrared < 1e-4, "{infrared}");
}

#[test]
fn every_set_of_wavelengths_sees_nearly_the_colour_of_light_that_passed_two_green_leaves() {
    let sampler = WavelengthSampler::rgb([400.0, 780.0], &Observer::Cie1931);
    let green = presets::by_name("sun-green")
        .expect("there is one")
        .contents;
    let spectrum = |nm: f32| {
        let optics =
            ProspectD::coefficients_extrapolated(f64::from(nm)).reflectance_transmittance(&green);
        (optics.transmittance * optics.transmittance * cie::d65(f64::from(nm))) as f32
    };
    let seen: Vec<[f32; 3]> = (0..ROWS)
        .map(|row| {
            let wavelengths = sampler.draw::<8>((row as f32 + 0.5) / ROWS as f32, 0);
            let radiance = Lanes(wavelengths.nm.map(spectrum));
            let mut rgb = [0.0; 3];
            sampler.film_values(&wavelengths, &radiance, &mut rgb);
            rgb
        })
        .collect();
    let mean = |f: &dyn Fn(&[f32; 3]) -> f32| seen.iter().map(f).sum::<f32>() / ROWS as f32;
    for channel in 0..2 {
        let middle = mean(&|rgb| rgb[channel]);
        let variance = mean(&|rgb| (rgb[channel] - middle).powi(2));
        let relative = variance.sqrt() / middle;
        // With a density like x̄ + ȳ + z̄ it would be 0.39 for red.
        assert!(relative < 0.2, "channel {channel}: {relative}");
    }
}

#[test]
fn the_kind_of_a_film_says_how_many_wavelengths_a_path_carries() {
    let bands = |count: usize| FilmKind::Spectral {
        bands: (0..count)
            .map(|number| Band {
                center_nm: 400.0 + 10.0 * number as f64,
                width_nm: 10.0,
            })
            .collect(),
    };
    let range_nm = [400.0, 780.0];
    // Three bands are three channels, as colour is, and need half its lanes.
    for (kind, channels, lanes) in [
        (
            FilmKind::Rgb {
                range_nm,
                observer: Observer::Cie1931,
            },
            3,
            8,
        ),
        (bands(1), 1, 4),
        (bands(3), 3, 4),
        (bands(4), 4, 4),
        (bands(5), 5, 8),
        (bands(9), 9, 16),
        (bands(17), 17, 32),
        (bands(32), 32, 32),
        (bands(33), 33, 32),
    ] {
        let sampler = WavelengthSampler::new(&kind);
        assert_eq!(sampler.channels(), channels);
        assert_eq!(sampler.grid().lanes(), lanes, "{kind:?}");
    }
}

#[test]
fn lists_of_wavelengths_become_packets_one_behind_the_other() {
    let long: Vec<f64> = (0..11).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
    let (sampler, first) = WavelengthSampler::of_lists(8, &[&long, &[900.0]]);
    assert_eq!((first, sampler.grid().rows()), (vec![0, 2], 3));
    assert_eq!(sampler.range_nm(), [400.0, 900.0]);
    assert_eq!(sampler.grid().set::<8>(0).nm[7], 470.0);
    let second = sampler.grid().set::<8>(1);
    assert_eq!(second.nm[..4], [480.0, 490.0, 500.0, 500.0]);
    assert_eq!(sampler.grid().set::<8>(2).nm, [900.0; 8]);
    // A spectrum that is tabulated for them has its values there.
    let mut spectrum = crate::spectrum::Spectrum::from(crate::spectrum::Curve::from_points(&[
        (400.0, 0.0),
        (500.0, 1.0),
    ]));
    spectrum.tabulate(sampler.grid());
    assert!((spectrum.lanes(&second).0[1] - 0.9).abs() < 1e-6);
}

#[test]
fn a_band_film_records_the_radiance_itself() {
    let bands = vec![
        Band {
            center_nm: 450.0,
            width_nm: 10.0,
        },
        Band {
            center_nm: 900.0,
            width_nm: 0.0,
        },
    ];
    let sampler = WavelengthSampler::new(&FilmKind::Spectral { bands });
    let wavelengths = sampler.draw::<4>(0.25, 0);
    // The centre of the 65th of 256 shares of the band; lanes beyond the bands hold them again.
    assert_eq!(wavelengths.nm, [447.519_53, 900.0, 447.519_53, 900.0]);
    let mut values = [0.0; 2];
    sampler.film_values(
        &wavelengths,
        &Lanes::from_fn(|i| i as f32 + 1.0),
        &mut values,
    );
    assert_eq!(values, [1.0, 2.0]);
}

#[test]
fn more_bands_than_lanes_are_carried_in_groups() {
    let bands: Vec<Band> = (0..70)
        .map(|number| Band {
            center_nm: 400.0 + 10.0 * f64::from(number),
            width_nm: 10.0,
        })
        .collect();
    let sampler = WavelengthSampler::new(&FilmKind::Spectral {
        bands: bands.clone(),
    });
    assert_eq!((sampler.groups(), sampler.grid().rows()), (3, 3 * ROWS));
    let mut values = [0.0; 70];
    for group in 0..3 {
        let wavelengths = sampler.draw::<32>(0.999_999, group);
        sampler.film_values(&wavelengths, &Lanes(wavelengths.nm), &mut values);
        let all = Lanes::splat(1.0);
        let seen = [32.0, 32.0, 6.0][group];
        assert_eq!(sampler.sum_of_seen(&wavelengths, &all), seen);
        // Lanes beyond the last band do not count.
        let beyond = Lanes::from_fn(|lane| f32::from(lane >= 6));
        let brightness = sampler.brightness(&wavelengths, &beyond);
        assert_eq!(brightness == 0.0, group == 2);
    }
    // Each band has the wavelength of its own last share.
    for (value, band) in values.iter().zip(&bands) {
        let last = band.center_nm + 5.0 * (1.0 - 1.0 / ROWS as f64);
        assert!((f64::from(*value) - last).abs() < 1e-4, "{value} {last}");
    }
    let recorded = sampler.recorded(&|share| f64::from(share.nm));
    for (value, band) in recorded.iter().zip(&bands) {
        assert!((value - band.center_nm).abs() < 1e-4, "{value}");
    }
}
