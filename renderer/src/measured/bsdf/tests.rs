use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;
use std::path::Path;

use super::*;

const HEAD: &str = "theta_i,phi_i,theta_o,phi_o,wavelength,value\n";

/// A table over the same polar angles for both directions, azimuths of the scattered one by 30°.
fn table(thetas: &[f64], f: impl Fn(Direction, Direction) -> f64) -> String {
    let mut text = HEAD.to_owned();
    for &theta_i in thetas {
        for &theta_o in thetas {
            for phi_o in (0..12).map(|i| 30.0 * f64::from(i)) {
                let [i, o] =
                    [(theta_i, 0.0), (theta_o, phi_o)].map(|(theta, phi)| Direction { theta, phi });
                _ = writeln!(text, "{theta_i},0,{theta_o},{phi_o},550,{}", f(i, o));
            }
        }
    }
    text
}

fn every(step: u32) -> Vec<f64> {
    (0..90 / step).map(|i| f64::from(i * step)).collect()
}

fn unit(direction: Direction) -> [f64; 3] {
    let (sin, cos) = libm::sincos(direction.theta.to_radians());
    let (y, x) = libm::sincos(direction.phi.to_radians());
    [sin * x, sin * y, cos]
}

/// GGX with correlated shadowing and a mirror that loses nothing: \[heitz2014\].
fn ggx(alpha: f64, i: Direction, o: Direction) -> f64 {
    let (i, o) = (unit(i), unit(o));
    let sum: Vec<f64> = i.iter().zip(&o).map(|(i, o)| i + o).collect();
    let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
    let cos = sum[2] / length;
    let a2 = alpha * alpha;
    let d = a2 / (PI * (cos * cos * (a2 - 1.0) + 1.0).powi(2));
    let lambda = |z: f64| 0.5 * ((1.0 + a2 * (1.0 - z * z) / (z * z)).sqrt() - 1.0);
    d / (1.0 + lambda(i[2]) + lambda(o[2])) / (4.0 * i[2] * o[2])
}

#[test]
fn a_lambertian_table_has_no_error_and_its_own_reflectance_at_every_angle() {
    let text = table(&every(15), |_, _| 0.4 / PI);
    let check = read(&text, &Known::default())
        .expect("a good table")
        .check();
    assert!(check.is_isotropic);
    let [band] = check.bands[..] else {
        panic!("one wavelength");
    };
    assert_eq!((band.rows, band.paired), (432, 432));
    assert_eq!(band.error_rms, 0.0);
    assert!((band.rms - 0.4 / PI).abs() < 1e-12);
    assert_eq!(check.energy.len(), 6);
    for energy in &check.energy {
        let reflected = energy.reflected.expect("rings are full");
        assert!((reflected - 0.4).abs() < 1e-12, "{energy:?}");
        assert_eq!(energy.transmitted, None);
    }
}

#[test]
fn a_btdf_is_lambertian_on_the_far_side_and_paired_with_light_from_there() {
    let mut text = HEAD.to_owned();
    for (theta_i, theta_o) in [(20, 160), (160, 20), (20, 120), (120, 20)] {
        for phi in [0, 90, 180, 270] {
            let value = 0.3 / PI;
            _ = writeln!(text, "{theta_i},0,{theta_o},{phi},550,{value}");
        }
    }
    let check = read(&text, &Known::default())
        .expect("a good table")
        .check();
    assert_eq!((check.bands[0].paired, check.bands[0].error_rms), (16, 0.0));
    for energy in check.energy {
        let transmitted = energy.transmitted.expect("rings are full");
        assert!((transmitted - 0.3).abs() < 1e-12, "{energy:?}");
        assert_eq!(energy.reflected, None);
    }
}

#[test]
fn ggx_is_reciprocal_and_its_albedo_is_that_of_a_fine_integral() {
    let alpha = 0.5;
    let text = table(&every(5), |i, o| ggx(alpha, i, o));
    let check = read(&text, &Known::default())
        .expect("a good table")
        .check();
    let band = check.bands[0];
    assert_eq!(band.paired, band.rows);
    assert!(band.error_rms < 1e-14 * band.rms, "{band:?}");
    for theta in [0.0, 30.0, 60.0] {
        let incident = Direction { theta, phi: 0.0 };
        // Midpoints in sin² θ and φ.
        let (rings, spokes) = (400, 400);
        let mut sum = 0.0;
        for ring in 0..rings {
            let sin2: f64 = (f64::from(ring) + 0.5) / f64::from(rings);
            let theta = libm::asin(sin2.sqrt()).to_degrees();
            for spoke in 0..spokes {
                let phi = 360.0 * (f64::from(spoke) + 0.5) / f64::from(spokes);
                sum += ggx(alpha, incident, Direction { theta, phi });
            }
        }
        let expected = PI * sum / f64::from(rings * spokes);
        let found = check.energy.iter().find(|e| e.incident.theta == theta);
        let found = found.and_then(|e| e.reflected).expect("it was measured");
        assert!(
            (found - expected).abs() < 0.01,
            "{theta}: {found} {expected}"
        );
    }
}

#[test]
fn what_breaks_reciprocity_is_found_in_size_and_place() {
    // Lambert times 1 + 0.1 sin θi: the error is ρ/π · 0.05 (sin θi − sin θo).
    let thetas = every(10);
    let value = 0.5 / PI;
    let sine = |direction: Direction| libm::sin(direction.theta.to_radians());
    let text = table(&thetas, |i, _| value * (1.0 + 0.1 * sine(i)));
    let check = read(&text, &Known::default())
        .expect("a good table")
        .check();
    let sines = thetas.iter().map(|theta| libm::sin(theta.to_radians()));
    let sines: Vec<f64> = sines.collect();
    let errors = sines
        .iter()
        .flat_map(|i| sines.iter().map(move |o| 0.05 * value * (i - o)));
    let squares = errors.map(|error| error * error).sum::<f64>() / 81.0;
    let band = check.bands[0];
    assert!((band.error_rms - squares.sqrt()).abs() < 1e-14, "{band:?}");
    let (worst, line) = band.worst.expect("there are pairs");
    let expected = 0.05 * value * sines[8];
    assert!((worst.abs() - expected).abs() < 1e-14, "{worst}");
    let at = &check.rows[line - 2].sample;
    assert_eq!(at.incident.theta.max(at.scattered.theta), 80.0);
    for row in &check.rows {
        let [i, o] = [row.sample.incident, row.sample.scattered].map(sine);
        let mean = value * (1.0 + 0.05 * (i + o));
        assert!((row.reciprocal - mean).abs() < 1e-14, "{row:?}");
    }
}

#[test]
fn azimuths_count_where_light_comes_from_several_and_from_the_light_where_not() {
    // Twisted: f depends on the sense of the azimuth, so it is not reciprocal.
    let text = table(&[30.0, 60.0], |_, o| {
        0.1 * (1.0 + 0.5 * libm::sin(o.phi.to_radians()))
    });
    let check = read(&text, &Known::default())
        .expect("a good table")
        .check();
    assert!((check.bands[0].error_rms - 0.05 * 0.5_f64.sqrt()).abs() < 1e-12);
    let anisotropic =
        format!("{HEAD}30,0,60,90,550,0.1\n60,90,30,0,550,0.3\n30,10,60,90,550,0.2\n");
    let check = read(&anisotropic, &Known::default())
        .expect("a good table")
        .check();
    assert!(!check.is_isotropic);
    let errors: Vec<Option<f64>> = check.rows.iter().map(|row| row.error).collect();
    assert!((errors[0].expect("a pair") + 0.1).abs() < 1e-12);
    assert_eq!(errors[2], None);
    assert_eq!(check.bands[0].paired, 2);
    assert_eq!(check.energy[0].reflected, None, "one azimuth tells nothing");
}

#[test]
fn radians_and_micrometres_are_recognised_and_reported() {
    let text = format!("{HEAD}0.5,0,1.0,3.14,0.55,0.1\n1.0,0,0.5,3.14,0.55,0.1\n");
    let table = read(&text, &Known::default()).expect("a good table");
    let notes: Vec<String> = table.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 2, "{notes:?}");
    assert!(
        notes[0].ends_with("taken for radians (if not, say --angles degrees)"),
        "{notes:?}"
    );
    assert!(
        notes[1].ends_with("taken for µm (if not, say --wavelengths nm)"),
        "{notes:?}"
    );
    assert!((table.samples[0].scattered.theta - 1.0_f64.to_degrees()).abs() < 1e-12);
    assert!(table.samples[0].scattered.theta < FRAC_PI_2.to_degrees());
    assert_eq!(table.samples[0].nm, 550.0);
}

#[test]
fn broken_tables_are_refused_with_line_and_value() {
    for (text, part) in [
        ("theta_i,phi_i\n".to_owned(), "has no column `theta_o`"),
        (HEAD.to_owned(), "no lines of numbers"),
        (
            format!("{HEAD}30,0,60,0,550,-0.1\n"),
            "line 2: value is -0.1",
        ),
        (
            format!("{HEAD}30,0,200,0,550,0.1\n"),
            "line 2: theta_i is 30°, theta_o 200°",
        ),
        (format!("{HEAD}30,0,60,0,550,x\n"), "line 2: value is \"x\""),
        (
            format!("{HEAD}30,0,60,0,0,0.1\n"),
            "line 2: wavelength is 0 nm",
        ),
        (
            format!("{HEAD}30,0,60,0,550,0.1\n40,0,60,0,550,0.1\n30,0,60,0,550,0.2\n"),
            "line 4: has the directions and wavelength of line 2",
        ),
        (
            format!("{HEAD}30,0,60,0,550\n"),
            "line 2: the line has 5 values, but there are 6 columns",
        ),
        (
            format!("{HEAD}# two\r\n30,0,60,0,550,0.1\r\n\r\n30,0,60,0,550,-1\r\n"),
            "line 5: value is -1",
        ),
    ] {
        let fault = read(&text, &Known::default()).expect_err(&text);
        let shown = fault.shown(Path::new("x.csv"), &text);
        assert!(shown.contains(part), "{text:?}: {shown}");
    }
}

#[test]
fn small_angles_are_degrees_if_they_are_whole_or_a_person_or_a_name_says_so() {
    let rows = "0,0,1,0,550,0.3\n1,0,0,0,550,0.3\n3,0,2,0,550,0.3\n2,0,3,0,550,0.3\n";
    let read = |text: &str, angles: Option<AngleUnit>| {
        let known = Known {
            angles,
            ..Known::default()
        };
        let table = read(text, &known).expect("a good table");
        let notes: Vec<String> = table.notes.iter().map(ToString::to_string).collect();
        (table.samples[2].incident.theta, notes)
    };
    let whole = format!("{HEAD}{rows}");
    let (theta, notes) = read(&whole, None);
    assert_eq!(theta, 3.0);
    assert!(
        notes[0].contains("taken for degrees (if not, say --angles radians)"),
        "{notes:?}"
    );
    let three = 3.0_f64.to_degrees();
    assert_eq!(read(&whole, Some(AngleUnit::Radians)), (three, vec![]));
    assert_eq!(read(&whole, Some(AngleUnit::Degrees)), (3.0, vec![]));
    let decimal = whole.replace("3,0,2", "3,0,1.5");
    assert_eq!(read(&decimal, None).0, three);
    assert_eq!(read(&decimal, Some(AngleUnit::Degrees)), (3.0, vec![]));
    let named = decimal.replace("theta_i,", "theta_i_deg,");
    assert_eq!(read(&named, None), (3.0, vec![]));
    let named = whole.replace("theta_i,", "theta_i_rad,");
    assert_eq!(read(&named, None), (three, vec![]));
    // Each in its own unit.
    let mixed = named.replace("theta_o", "theta_o_deg");
    let table = super::read(&mixed, &Known::default()).expect("a good table");
    assert_eq!(table.samples[2].incident.theta, three);
    assert_eq!(table.samples[2].scattered.theta, 2.0);
    // Degrees under a name, or with a flag, that says radians.
    let degrees = whole.replace("3,0,2,0", "3,0,30,0");
    let named = degrees.replace("theta_o,", "theta_o_rad,");
    for (text, angles, name) in [
        (&named, None, "theta_o_rad"),
        (&degrees, Some(AngleUnit::Radians), "theta_o"),
    ] {
        let known = Known {
            angles,
            ..Known::default()
        };
        let fault = super::read(text, &known).expect_err("no angle");
        let said = format!(
            "x.csv, line 4: {name} is 30 and in radians, so 1718.87°, allowed is up to 180°: if the \
             angles are degrees, say --angles degrees"
        );
        assert_eq!(fault.shown(std::path::Path::new("x.csv"), text), said);
    }
    let read = read(&named, Some(AngleUnit::Degrees));
    assert_eq!(read, (3.0, vec![]));
}

#[test]
fn tables_with_semicolons_and_decimal_commas_are_the_same_and_other_columns_are_named() {
    let text = table(&every(30), |_, _| 0.125);
    let plain = super::read(&text, &Known::default()).expect("a good table");
    let german = text.replace(',', ";").replace('.', ",");
    let mut found = super::read(&german, &Known::default()).expect("a good table");
    assert_eq!(found.samples, plain.samples);
    assert!(
        found.notes[0].to_string().contains("--decimal point"),
        "{:?}",
        found.notes
    );
    let more = text
        .replace("550,", "550,x,")
        .replace("wavelength,", "wavelength,remark,");
    found = super::read(&more, &Known::default()).expect("a good table");
    assert_eq!(found.samples, plain.samples);
    assert_eq!(
        found.notes[0].to_string(),
        "columns that are not read: remark"
    );
}
