use super::*;
use crate::spectrum::recorded::FilmKind;
use crate::spectrum::{Curve, WavelengthSampler};

/// The mean of a function by a response, from 2000 points within each pair of rows.
fn fine_mean(response: &Response, of: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut all) = (0.0, 0.0);
    for pair in response.rows().windows(2) {
        let (low, high) = (pair[0], pair[1]);
        for step in 0..2000 {
            let place = (f64::from(step) + 0.5) / 2000.0;
            let nm = low.0 + place * (high.0 - low.0);
            let weight = (low.1 + place * (high.1 - low.1)) * (high.0 - low.0);
            sum += weight * of(nm);
            all += weight;
        }
    }
    sum / all
}

/// A spectrum like a leaf's: an edge of 30 nm in the red, and a band of water.
fn leaf_like(nm: f64) -> f64 {
    let edge = 1.0 / (1.0 + ((715.0 - nm) / 12.0).exp());
    let water = 1.0 - 0.6 * (-((nm - 1940.0) / 90.0).powi(2)).exp();
    0.05 + 0.45 * edge * water
}

#[test]
fn shipped_sensors_have_the_middles_and_widths_that_are_published() {
    for (sensor, count, band, middle, width) in [
        ("sentinel-2a", 13, "B2", 492.4, 66.0),
        ("sentinel-2a", 13, "B8", 832.8, 106.0),
        ("sentinel-2a", 13, "B12", 2202.4, 175.0),
        ("sentinel-2b", 13, "B8A", 864.0, 22.0),
        ("sentinel-2c", 10, "B4", 666.5, 30.4),
        ("landsat-8", 9, "B5", 864.6, 28.0),
        ("landsat-9", 9, "B4", 654.3, 37.0),
        ("modis-terra", 7, "B1", 645.8, 48.0),
        ("prisma-like", 225, "420.0", 420.0, 12.0),
        ("enmap-like", 235, "1010.0", 1010.0, 12.5),
    ] {
        let found = Sensor::by_name(sensor).expect("it is shipped");
        assert_eq!(found.bands().len(), count, "{sensor}");
        let band = found.bands().iter().find(|own| own.name() == band);
        let Band {
            center_nm,
            width_nm,
        } = band.expect("it has the band").outline;
        assert!((center_nm - middle).abs() < 0.06, "{sensor}: {center_nm}");
        // ESA and USGS give whole nanometres.
        assert!((width_nm - width).abs() < 2.0, "{sensor}: {width_nm}");
        let [low, high] = found.range_nm();
        assert!(400.0 <= low && high <= 2500.0, "{sensor}: {low} to {high}");
    }
    let about = Sensor::shipped().map(|(name, _)| Sensor::by_name(name));
    assert!(about.into_iter().all(|sensor| sensor.is_some()));
}

#[test]
fn what_a_band_records_is_the_mean_by_its_response() {
    let points = (360_u32..=2500).map(f64::from);
    let curve: Vec<_> = points.map(|nm| (nm, leaf_like(nm))).collect();
    let curve = Curve::from_points(&curve);
    for (name, _) in Sensor::shipped() {
        let sensor = Sensor::by_name(name).expect("it is shipped");
        let sampler = WavelengthSampler::new(&FilmKind::Sensor(sensor.clone().into()));
        let recorded = sampler.recorded(&|share| curve.over(share).into());
        assert_eq!(recorded.len(), sensor.bands().len());
        for (found, band) in recorded.iter().zip(sensor.bands()) {
            let line = |nm: f64| {
                let share = nm.fract();
                leaf_like(nm.floor()) * (1.0 - share) + leaf_like(nm.ceil()) * share
            };
            let expected = fine_mean(band, line);
            // Curves are tabulated as f32, and in the tails of responses parts are some nanometres wide.
            let off = (found - expected).abs();
            assert!(off < 1e-5, "{name} {}: {found} {expected}", band.name());
        }
    }
}

#[test]
fn parts_of_a_response_keep_its_middle_even_with_leaks_far_from_the_band() {
    let rows = vec![
        (400.0, 0.001),
        (640.0, 0.001),
        (650.0, 1.0),
        (670.0, 0.2),
        (680.0, 0.0),
        (900.0, 0.0),
        (2000.0, 0.002),
    ];
    let response = Response::new("leaky".to_owned(), rows).expect("it is a response");
    let shares = response.shares(256);
    assert_eq!(shares.len(), 256);
    for power in 0..=1 {
        let mean: f64 = shares
            .iter()
            .map(|share| {
                let [low, high] = share.edges_nm;
                (0.5 * (low + high)).powi(power)
            })
            .sum();
        let expected = fine_mean(&response, |nm| nm.powi(power));
        let off = (mean / 256.0 / expected - 1.0).abs();
        assert!(off < 1e-6, "{power}: {} {expected}", mean / 256.0);
    }
    let rises = |pair: &[Share]| pair[0].edges_nm[1] <= pair[1].edges_nm[0] + 1e-9;
    assert!(shares.windows(2).all(rises));
}

#[test]
fn a_box_has_the_shares_of_a_band_of_its_width() {
    let rows = vec![(645.0, 3.0), (675.0, 3.0)];
    let sensor = Sensor::new("box", vec![("red".to_owned(), rows)]).expect("it is a sensor");
    let bands = sensor.boxes();
    assert_eq!((bands[0].center_nm, bands[0].width_nm), (660.0, 30.0));
    let of = |kind| WavelengthSampler::new(&kind);
    let sampler = of(FilmKind::Sensor(sensor.into()));
    let by_box = of(FilmKind::Spectral { bands });
    for (share, of_box) in sampler.grid().shares().zip(by_box.grid().shares()) {
        assert!((share.nm - of_box.nm).abs() < 1e-4);
        let ends = share.edges_nm.iter().zip(of_box.edges_nm);
        assert!(ends.into_iter().all(|(a, b)| (a - b).abs() < 1e-6));
    }
}

#[test]
fn what_is_no_sensor_is_refused() {
    let of = |rows: &[(f64, f64)]| Sensor::new("x", vec![("B1".to_owned(), rows.to_vec())]);
    let name = || "B1".to_owned();
    assert_eq!(of(&[(400.0, 1.0)]), Err(NotASensor::Disordered(name())));
    let falling = [(410.0, 1.0), (400.0, 1.0)];
    assert_eq!(of(&falling), Err(NotASensor::Disordered(name())));
    let negative = [(400.0, 1.0), (410.0, -0.1)];
    assert_eq!(of(&negative), Err(NotASensor::Negative(name())));
    let blind = [(400.0, 0.0), (410.0, 0.0)];
    assert_eq!(of(&blind), Err(NotASensor::Blind(name())));
    assert_eq!(Sensor::new("x", Vec::new()), Err(NotASensor::Empty));
    let rows = vec![(400.0, 1.0), (410.0, 1.0)];
    let twice = ["a", "b"].map(|name| (name.to_owned(), rows.clone()));
    let same = Sensor::new("x", twice.to_vec());
    assert_eq!(same, Err(NotASensor::Same("a".to_owned(), "b".to_owned())));
}
