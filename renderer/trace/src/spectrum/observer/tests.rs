use super::*;

fn camera(name: &str) -> Arc<Camera> {
    match Observer::by_name(name) {
        Some(Observer::Camera(camera)) => camera,
        other => panic!("{name}: {other:?}"),
    }
}

/// Linear sRGB of a spectrum, from 300 to 900 nm.
fn srgb(observer: &Observer, radiance: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for nm in (300..900).map(|nm| f64::from(nm) + 0.5) {
        for (sum, value) in sum.iter_mut().zip(observer.srgb_at(nm)) {
            *sum += value * radiance(nm);
        }
    }
    sum
}

#[test]
fn d65_has_the_same_white_by_every_observer() {
    let luminance = cie::xyz_of(cie::d65)[1];
    for name in Observer::names() {
        let observer = Observer::by_name(name).expect("it is shipped");
        assert_eq!(observer.name(), name);
        for value in srgb(&observer, |nm| 0.3 * cie::d65(nm) / luminance) {
            assert!((value / 0.3 - 1.0).abs() < 1e-3, "{name}: {value}");
        }
    }
    assert_eq!(Observer::by_name("nikon-d5000"), None);
}

#[test]
fn shipped_cameras_see_surfaces_nearly_as_the_eye_does() {
    // By numpy's least squares over the same set (`reference/run sensitivities`); a camera with
    // Foveon's three layers is farther from the eye.
    for (name, mean, greatest) in [
        ("nikon-d5100", 1.24, 4.51),
        ("canon-5d-mark-ii", 0.99, 3.68),
        ("sony-a7r-iii", 1.02, 3.81),
        ("sigma-sd1-merrill", 2.03, 5.97),
    ] {
        let fit = *camera(name).fit();
        assert!((fit.mean - mean).abs() < 0.02, "{name}: {}", fit.mean);
        assert!(
            (fit.greatest - greatest).abs() < 0.06,
            "{name}: {}",
            fit.greatest
        );
        for row in fit.matrix {
            assert!(
                (row.iter().sum::<f64>() - 1.0).abs() < 1e-12,
                "{name}: {row:?}"
            );
        }
    }
}

#[test]
fn a_camera_that_is_the_eye_gets_the_colours_of_the_eye() {
    // Any mixture of the CIE's functions that is nowhere negative, each in a unit of its own.
    let rows = (360..=830).map(f64::from).map(|nm| {
        let [x, y, z] = cie::observer(nm);
        (
            nm,
            [
                7.0 * (x + 0.3 * y),
                0.2 * (0.5 * x + y + 0.1 * z),
                z + 0.05 * y,
            ],
        )
    });
    let camera = Camera::new("eye", rows.collect()).expect("it is one");
    let fit = camera.fit();
    assert!(fit.greatest < 1e-3, "{fit:?}");
    let eye = Observer::Camera(Arc::new(camera));
    let red = |nm: f64| if nm < 600.0 { 0.1 } else { 0.9 };
    let (by_camera, by_eye) = (srgb(&eye, red), srgb(&Observer::Cie1931, red));
    for (one, other) in by_camera.into_iter().zip(by_eye) {
        assert!((one - other).abs() < 2e-3, "{by_camera:?} {by_eye:?}");
    }
}

#[test]
fn leaves_look_nearly_the_same_to_the_eye_and_to_a_camera() {
    use optics::{ProspectD, presets};
    let observer = Observer::by_name("canon-5d-mark-ii").expect("it is shipped");
    let white = fit_white();
    for name in ["sun-green", "birch-yellow"] {
        let contents = presets::by_name(name).expect("there is one").contents;
        let reflectance = |nm: f64| {
            let nm = nm.clamp(400.0, 780.0);
            let optics = ProspectD::coefficients_extrapolated(nm);
            optics.reflectance_transmittance(&contents).reflectance * cie::d65(nm)
                / cie::xyz_of(cie::d65)[1]
        };
        let [by_camera, by_eye] = [&observer, &Observer::Cie1931]
            .map(|observer| crate::spectrum::delta_e::lab(xyz(srgb(observer, reflectance)), white));
        let off = crate::spectrum::delta_e::ciede2000(by_camera, by_eye);
        assert!(off < 3.0, "{name}: {off}");
        assert!(off > 0.05, "{name}: the camera is not the eye");
    }
}

fn xyz(rgb: [f64; 3]) -> [f64; 3] {
    let to_srgb = glam::DMat3::from_cols_array_2d(&cie::XYZ_TO_SRGB).transpose();
    (to_srgb.inverse() * glam::DVec3::from_array(rgb)).to_array()
}

fn fit_white() -> [f64; 3] {
    xyz([1.0; 3])
}

#[test]
fn what_is_no_camera_is_refused() {
    let rows = |values: fn(f64) -> [f64; 3]| {
        let nm = (0..5).map(|i| 400.0 + 80.0 * f64::from(i));
        nm.map(|nm| (nm, values(nm))).collect::<Vec<_>>()
    };
    let refused = |rows| Camera::new("c", rows).expect_err("it is none");
    assert_eq!(refused(rows(|_| [1.0, 0.0, 1.0])), NotACamera::Blind("g"));
    assert_eq!(refused(rows(|nm| [1.0, nm, 2.0])), NotACamera::Dependent);
    assert_eq!(refused(rows(|_| [1.0; 3])), NotACamera::Dependent);
    assert_eq!(
        refused(rows(|nm| [1.0, 500.0 - nm, 2.0])),
        NotACamera::Negative
    );
    assert_eq!(refused(rows(|_| [f64::NAN; 3])), NotACamera::Negative);
    assert_eq!(refused(vec![(400.0, [1.0; 3])]), NotACamera::Disordered);
    let mut falling = rows(|nm| [nm, 1.0, 900.0 - nm]);
    falling.swap(1, 2);
    assert_eq!(refused(falling), NotACamera::Disordered);
}

#[test]
fn the_share_within_a_range_is_that_of_each_channel() {
    let rows = vec![
        (400.0, [1.0, 0.0, 1.0]),
        (500.0, [1.0, 1.0, 0.0]),
        (600.0, [1.0, 0.0, 0.0]),
    ];
    let camera = Camera::new("c", rows).expect("it is one");
    let [r, g, b] = camera.share_within([400.0, 500.0]);
    assert!((r - 0.5).abs() < 1e-9 && (g - 0.5).abs() < 1e-9 && (b - 1.0).abs() < 1e-9);
}
