//! The BRF of canopies: closed forms with and without hot spot, reciprocity, fluxes, and two
//! estimators.

use std::f64::consts::PI;

use renderer::instruments::{Direction, Row};

use super::canopy::discs;
use super::{figures, of, rays};

/// The row of a detector, degrees.
pub(super) fn seen<'r>(
    rows: &'r [Row],
    quantity: &'static str,
    sun: Direction,
    nm: f64,
    view: [f64; 2],
) -> &'r Row {
    of(rows, quantity, sun, nm)
        .find(|row| row.view.map(|angles| angles.degrees()) == Some(view))
        .unwrap_or_else(|| panic!("{quantity} at {view:?} is measured"))
}

fn beam(angle_deg: f64) -> Direction {
    Direction::Beam(angle_deg.to_radians())
}

#[test]
fn lambertian_ground_alone_has_its_reflectance_in_every_direction() {
    let text = "[meshes.ground.rectangle]\nwidth_m = 3\nheight_m = 3\n\
        [materials.soil.diffuse]\nreflectance = 0.2\n\
        [objects.ground]\nmesh = \"ground\"\nmaterial = \"soil\"\n\
        [instruments.field.canopy]\nwithin_m = [-1, -1, 1, 1]\nwavelengths_nm = [550]\n\
        incidence_deg = [0, 50]\nazimuth_deg = 20\ndiffuse = true\n\
        detector = { step_deg = 15, relative_azimuth_deg = [0, 90] }\n";
    let rows = figures(text, &rays(1024)).expect("it can be measured");
    let factors: Vec<_> = rows.iter().filter(|row| row.view.is_some()).collect();
    assert_eq!(factors.len(), 3 * 11 * 2);
    for row in factors {
        let word = match row.incidence {
            Direction::Beam(_) => "brf",
            Direction::Diffuse => "hdrf",
        };
        assert_eq!(row.quantity, word);
        assert!((row.value - 0.2).abs() < 1e-6, "{row:?}");
    }
}

#[test]
fn two_lambertian_plates_have_the_same_factor_in_every_direction_by_either_estimator() {
    // What comes through the sheet and back: as in the fluxes of two plates.
    let (r, t, soil) = (0.4, 0.3, 0.2);
    let expected = r + t * soil * t / (1.0 - r * soil);
    for keys in ["", "estimator = \"count\", "] {
        let text = format!(
            "[meshes.sheet.rectangle]\nwidth_m = 4\nheight_m = 4\n\
             [materials.leaf.leaf]\nabaxial_ratio = 1\nadaxial = {{ eta = 1, alpha = 1 }}\n\
             abaxial = {{ eta = 1, alpha = 1 }}\n\
             [materials.leaf.leaf.measured]\nreflectance = {r}\ntransmittance = {t}\n\
             [materials.soil.diffuse]\nreflectance = {soil}\n\
             [objects.ground]\nmesh = \"sheet\"\nmaterial = \"soil\"\n\
             [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\nposition_m = [0, 0, 1]\n\
             [instruments.field.canopy]\nwithin_m = [-1, -1, 1, 1]\nwavelengths_nm = [550]\n\
             soil = \"ground\"\nincidence_deg = [0, 70]\n\
             detector = {{ {keys}zenith_deg = [-60, 0, 30], half_angle_deg = 20 }}\n"
        );
        let rows = figures(&text, &rays(1 << 16)).expect("it can be measured");
        for sun in [0.0, 70.0] {
            for zenith in [-60.0, 0.0, 30.0] {
                let row = seen(&rows, "brf", beam(sun), 550.0, [zenith, 0.0]);
                let off = (row.value - expected).abs();
                assert!(off < 4.0 * row.error + 1e-6, "{row:?} for {expected}");
                assert!(row.error < 1e-2, "{row:?}");
            }
        }
    }
}

/// A layer of small discs of faint leaves over black ground, of which what is scattered more than
/// once can be taken off: at 600 nm they scatter half of what they scatter at 700 nm.
fn faint(seed: u64) -> String {
    discs(0.0025, 1.0, [0.0, 1.0])
        .replace(
            "reflectance = 0.4\ntransmittance = 0.3",
            "reflectance = { table = [[600, 0.02], [700, 0.04]] }\n\
             transmittance = { table = [[600, 0.01], [700, 0.02]] }",
        )
        .replace("reflectance = 0.2", "reflectance = 0")
        .replace("seed = 4", &format!("seed = {seed}"))
}

/// Light that leaves of all directions, ρ and τ, without extent scatter once, as a BRF: the layer
/// has leaf area `lai`, `sun` and `view` are unit vectors to the light and to the detector. With
/// `is_hot`, what lets light in lets it out again.
///
/// Leaves of a spherical distribution hide half of their area, so that light gets as deep as
/// exp(-lai / 2μ). A leaf with normal n sends (ρ or τ) |n·s| |n·v| / π of the light's irradiance
/// into each solid angle; its mean over all normals is Γ / π with
/// Γ = (ρ + τ) (sin β − β cos β) / 3π + τ cos β / 3, β the angle by which light turns.
fn scattered_once(
    lai: f64,
    [rho, tau]: [f64; 2],
    sun: [f64; 3],
    view: [f64; 3],
    is_hot: bool,
) -> f64 {
    let turned: f64 = -(0..3).map(|axis| sun[axis] * view[axis]).sum::<f64>();
    let beta = libm::acos(turned.clamp(-1.0, 1.0));
    let gamma = (rho + tau) * (libm::sin(beta) - beta * libm::cos(beta)) / (3.0 * PI)
        + tau * libm::cos(beta) / 3.0;
    let ways = if is_hot {
        0.5 / sun[2]
    } else {
        0.5 / sun[2] + 0.5 / view[2]
    };
    gamma / (sun[2] * view[2]) * (1.0 - libm::exp(-lai * ways)) / ways
}

fn direction(zenith_deg: f64, azimuth_deg: f64) -> [f64; 3] {
    let (sin, cos) = libm::sincos(zenith_deg.to_radians());
    let (sin_azimuth, cos_azimuth) = libm::sincos(azimuth_deg.to_radians());
    [sin * cos_azimuth, sin * sin_azimuth, cos]
}

#[test]
#[ignore = "deep: 20 s"]
fn small_discs_scatter_once_as_the_turbid_layer_does_and_twice_as_much_into_the_hot_spot() {
    // Away from the sun, where a disc of half a hundredth hides nothing of what it has shaded, and in it.
    let views = [
        [-60.0, 0.0],
        [-30.0, 0.0],
        [0.0, 0.0],
        [60.0, 0.0],
        [-45.0, 90.0],
        [45.0, 90.0],
        [30.0, 0.0],
    ];
    let hot = [30.0, 0.0];
    let seeds = 6;
    let found: Vec<Vec<Row>> = (1..=seeds)
        .map(|seed| {
            let text = format!(
                "{}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\n\
                 wavelengths_nm = [600, 700]\nsoil = \"ground\"\nincidence_deg = [30]\n\
                 detector = {{ zenith_deg = [-60, -45, -30, 0, 30, 45, 60], \
                 relative_azimuth_deg = [0, 90] }}\n",
                faint(seed)
            );
            figures(&text, &rays(1 << 15)).expect("it can be measured")
        })
        .collect();
    let mut report = String::new();
    let mut worst = 0.0_f64;
    for view in views {
        let once: Vec<f64> = found
            .iter()
            .map(|rows| {
                let [low, high] =
                    [600.0, 700.0].map(|nm| seen(rows, "brf", beam(30.0), nm, view).value);
                // b = s w + m w²: at w and 2w, s w = 2 b(w) − b(2w) / 2.
                2.0 * low - 0.5 * high
            })
            .collect();
        let count = once.len() as f64;
        let mean = once.iter().sum::<f64>() / count;
        let squares: f64 = once.iter().map(|value| (value - mean).powi(2)).sum();
        let error = (squares / (count - 1.0) / count).sqrt();
        let is_hot = view == hot;
        let expected = scattered_once(
            1.0,
            [0.02, 0.01],
            direction(30.0, 0.0),
            direction(view[0], view[1]),
            is_hot,
        );
        let z = (mean - expected) / error;
        report += &format!("{view:?}: {mean:.6} for {expected:.6}, error {error:.1e}, z {z:+.2}\n");
        // Discs of a finite size hide a little of what they have shaded in any direction, in
        // proportion to their radius over the distance of the two ways: up to 0.6 % here.
        let off = ((mean - expected).abs() - 0.006 * expected).max(0.0) / error;
        worst = worst.max(off);
        assert!(error < 0.01 * expected, "{report}");
    }
    eprintln!("{report}");
    // Of 5 degrees of freedom, 10 standard errors are as rare as 4 of many.
    assert!(worst < 10.0, "{report}");
}

#[test]
fn sun_and_detector_may_change_places() {
    let text = format!(
        "{}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
         soil = \"ground\"\nincidence_deg = [20, 60]\nazimuth_deg = 35\n\
         detector = {{ zenith_deg = [20, 60] }}\n",
        discs(0.05, 2.0, [0.0, 1.0])
    );
    let rows = figures(&text, &rays(1 << 17)).expect("it can be measured");
    let there = seen(&rows, "brf", beam(20.0), 550.0, [60.0, 0.0]);
    let back = seen(&rows, "brf", beam(60.0), 550.0, [20.0, 0.0]);
    let error = there.error.hypot(back.error);
    assert!(
        (there.value - back.value).abs() < 4.0 * error,
        "{there:?} {back:?}"
    );
    assert!(error < 0.01 * there.value, "{there:?} {back:?}");
}

#[test]
fn the_factors_of_all_directions_make_the_reflected_flux() {
    // ∫ BRF cos θ dω / π is the mean over azimuths of ∫ BRF d(μ²): Gauss' five nodes of μ² in [0, 1].
    let nodes = [
        (0.046_910_077_030_668, 0.118_463_442_528_095),
        (0.230_765_344_947_158, 0.239_314_335_249_683),
        (0.5, 0.284_444_444_444_444),
        (0.769_234_655_052_842, 0.239_314_335_249_683),
        (0.953_089_922_969_332, 0.118_463_442_528_095),
    ];
    let zeniths: Vec<f64> = nodes
        .iter()
        .rev()
        .map(|(square, _)| libm::acos(f64::sqrt(*square)).to_degrees())
        .collect();
    let azimuths: Vec<f64> = (0..16).map(|i| 22.5 * f64::from(i)).collect();
    let text = format!(
        "{}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
         soil = \"ground\"\nincidence_deg = [40]\ndiffuse = true\n\
         detector = {{ zenith_deg = {zeniths:?}, relative_azimuth_deg = {azimuths:?} }}\n",
        discs(0.1, 1.5, [0.0, 0.5])
    );
    let rows = figures(&text, &rays(1 << 14)).expect("it can be measured");
    for (sun, word) in [(beam(40.0), "brf"), (Direction::Diffuse, "hdrf")] {
        let reflected = of(&rows, "reflected", sun, 550.0)
            .next()
            .expect("it is measured");
        let factors: Vec<f64> = of(&rows, word, sun, 550.0).map(|row| row.value).collect();
        assert_eq!(factors.len(), 5 * 16);
        let sum: f64 = factors
            .chunks(5)
            .flat_map(|of_azimuth| of_azimuth.iter().rev().zip(nodes))
            .map(|(factor, (_, weight))| factor * weight / 16.0)
            .sum();
        // The nodes take the peak of the hot spot to within about a hundredth.
        let off = (sum - reflected.value).abs();
        assert!(
            off < 0.01 * reflected.value + 4.0 * reflected.error,
            "{word}: {sum} for {reflected:?}"
        );
        assert!(reflected.error < 5e-3, "{reflected:?}");
    }
}

#[test]
fn counting_light_and_next_events_agree_on_coats_glass_and_the_hot_spot() {
    let text = |estimator: &str| {
        let discs = discs(0.1, 1.0, [0.2, 1.0]).replace(
            "abaxial_ratio = 1\nadaxial = { eta = 1, alpha = 1 }\nabaxial = { eta = 1, alpha = 1 }",
            "adaxial = { eta = 1.5, alpha = 0.2 }\nabaxial = { eta = 1.4, alpha = 0.3 }",
        );
        assert!(discs.contains("eta = 1.5"));
        format!(
            "{discs}[meshes.ball.sphere]\nradius_m = 0.15\n\
             [materials.glass.dielectric]\neta = 1.5\n\
             [objects.ball]\nmesh = \"ball\"\nmaterial = \"glass\"\nposition_m = [0.5, 0.5, 0.16]\n\
             [instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
             soil = \"ground\"\nincidence_deg = [30]\ndiffuse = true\n\
             detector = {{ estimator = \"{estimator}\", zenith_deg = [-60, -30, 0, 30, 60], \
             half_angle_deg = 10 }}\n"
        )
    };
    let [events, counted] = ["next-event", "count"]
        .map(|word| figures(&text(word), &rays(1 << 17)).expect("it can be measured"));
    let (mut worst, mut gain) = (0.0_f64, 0.0);
    for (event, count) in events.iter().zip(&counted) {
        if event.view.is_none() {
            assert_eq!(event, count);
            continue;
        }
        let error = event.error.hypot(count.error);
        worst = worst.max((event.value - count.value).abs() / error);
        gain += count.error / event.error / 10.0;
        assert!(error < 0.05 * count.value, "{event:?} {count:?}");
    }
    assert!(worst < 4.0, "{worst}");
    eprintln!("next events: errors {gain:.1} times less");
    assert!(gain > 2.0, "{gain}");
}
