//! The integrating sphere.

use renderer::instruments::Problem;

use super::{NORMAL, figures, of, rays};

const REFERENCE: &str = include_str!("../data/prospect_d_reference.csv");

/// The contents of the 33 leaves of the reference, each with its rows of wavelength, R and T.
fn leaves() -> Vec<([f64; 7], Vec<[f64; 3]>)> {
    let mut leaves: Vec<([f64; 7], Vec<[f64; 3]>)> = Vec::new();
    let lines = REFERENCE.lines();
    for line in lines.filter(|line| !line.starts_with('#') && !line.starts_with("case,")) {
        let numbers: Vec<f64> = line
            .split(',')
            .skip(1)
            .map(|figure| figure.parse().expect("a figure is a number"))
            .collect();
        let contents: [f64; 7] = numbers[..7].try_into().expect("seven contents");
        let row = [numbers[7], numbers[8], numbers[9]];
        match leaves.last_mut() {
            Some((last, rows)) if *last == contents => rows.push(row),
            Some(_) | None => leaves.push((contents, vec![row])),
        }
    }
    leaves
}

/// A sheet of a leaf with these contents and faces, askew, and a sphere over a part of it, to which
/// keys may be added.
fn sheet(name: &str, [n, cab, car, ant, brown, cw, cm]: [f64; 7], faces: &str) -> String {
    format!(
        "[materials.{name}.leaf]\n{faces}\n\
         [materials.{name}.leaf.contents]\nstructure = {n}\nchlorophyll_ug_per_cm2 = {cab}\n\
         carotenoids_ug_per_cm2 = {car}\nanthocyanins_ug_per_cm2 = {ant}\nbrown = {brown}\n\
         water_cm = {cw}\ndry_matter_g_per_cm2 = {cm}\n\
         [objects.{name}]\nmesh = \"sheet\"\nmaterial = \"{name}\"\nposition_m = [0.3, 0.2, 0.1]\n\
         rotate_deg = [30, 20, 10]\n\
         [instruments.{name}.sphere]\nobject = \"{name}\"\n\
         spot = {{ at_mm = [3, -20], diameter_mm = 20 }}\n"
    )
}

const SHEET: &str = "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n";

#[test]
fn a_sphere_over_a_uniform_leaf_reads_what_prospect_says() {
    let mut leaves = leaves();
    assert_eq!(leaves.len(), 33);
    if std::env::var("LAMINA_ANCHORS").is_err() {
        // Eleven of them in the core suite.
        leaves = leaves.into_iter().step_by(3).collect();
    }
    let mut text = SHEET.to_owned();
    for (number, (contents, _)) in leaves.iter().enumerate() {
        // A coat that alone reflects less than any of these leaves.
        let coat = "adaxial = { eta = 1.3, alpha = 0.4 }";
        text += &sheet(&format!("leaf{number}"), *contents, coat);
        text += "incidence_deg = [0]\ndiffuse = false\nfaces = \"adaxial\"\n";
    }
    let rows = figures(&text, &rays(8192)).expect("it can be measured");
    let mut greatest = 0.0_f64;
    for (number, (_, reference)) in leaves.iter().enumerate() {
        let name = format!("leaf{number}");
        let own: Vec<_> = rows
            .iter()
            .filter(|row| row.instrument == name)
            .cloned()
            .collect();
        for [nm, r, t] in reference {
            let expected = [
                ("reflectance", *r),
                ("transmittance", *t),
                ("absorptance", 1.0 - r - t),
            ];
            for (quantity, expected) in expected {
                let row = of(&own, quantity, NORMAL, *nm)
                    .next()
                    .expect("it is measured");
                let off = (row.value - expected).abs();
                greatest = greatest.max(off);
                assert!(off < 1e-3, "{name}: {row:?} for {expected}");
            }
        }
    }
    eprintln!("greatest deviation {greatest:.1e}");
}

#[test]
fn without_a_coat_any_light_and_either_face_see_the_same_leaf_and_nothing_is_lost() {
    let contents = [1.5, 40.0, 8.0, 1.0, 0.1, 0.01, 0.009];
    let bare =
        "abaxial_ratio = 1\nadaxial = { eta = 1, alpha = 1 }\nabaxial = { eta = 1, alpha = 1 }";
    let text = format!(
        "{SHEET}{}incidence_deg = [0, 30, 75]\nwavelengths_nm = [550, 800, 1650]\n",
        sheet("leaf", contents, bare)
    );
    let rows = figures(&text, &rays(1 << 16)).expect("it can be measured");
    assert_eq!(rows.len(), 3 * 2 * 4 * 3);
    for pair in rows.chunks(3) {
        let sum: f64 = pair.iter().map(|row| row.value).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{pair:?}");
    }
    for quantity in ["reflectance", "transmittance"] {
        for nm in [550.0, 800.0, 1650.0] {
            let same = || {
                let all = rows.iter();
                all.filter(|row| row.quantity == quantity && row.wavelength_nm == Some(nm))
            };
            let first = same().next().expect("it is measured");
            assert_eq!(same().count(), 8);
            for row in same() {
                let error = row.error.hypot(first.error).max(1e-7);
                assert!(
                    (row.value - first.value).abs() < 5.0 * error,
                    "{row:?} {first:?}"
                );
            }
        }
    }
}

#[test]
fn a_measured_leaf_with_unlike_coats_reads_as_measured_on_both_faces() {
    let text = format!(
        "{SHEET}[materials.oak.leaf]\nadaxial = {{ eta = 1.5, alpha = 0.1 }}\n\
         abaxial = {{ eta = 1.0 }}\n[materials.oak.leaf.measured]\nreflectance = 0.25\n\
         abaxial_reflectance = 0.30\ntransmittance = 0.5\n\
         [objects.oak]\nmesh = \"sheet\"\nmaterial = \"oak\"\n\
         [instruments.ball.sphere]\nobject = \"oak\"\nwavelengths_nm = [550]\ndiffuse = false\n\
         spot = {{ at_mm = [0, 0], diameter_mm = 10 }}\n"
    );
    let rows = figures(&text, &rays(1 << 14)).expect("it can be measured");
    for (face, quantity, expected) in [
        ("adaxial", "reflectance", 0.25),
        ("adaxial", "transmittance", 0.5),
        ("abaxial", "reflectance", 0.3),
        ("abaxial", "transmittance", 0.5),
    ] {
        let mut all = of(&rows, quantity, NORMAL, 550.0);
        let row = all
            .find(|row| row.face == Some(face))
            .expect("it is measured");
        let off = (row.value - expected).abs();
        assert!(off < 4.0 * row.error + 2e-4, "{row:?} for {expected}");
    }
}

#[test]
fn a_whole_body_that_absorbs_nothing_gives_all_its_light_back() {
    let text = "[meshes.ball.sphere]\nradius_m = 0.1\n[materials.white.diffuse]\nreflectance = 1\n\
        [objects.ball]\nmesh = \"ball\"\nmaterial = \"white\"\n\
        [instruments.ball.sphere]\nobject = \"ball\"\nwavelengths_nm = [550]\n";
    let rows = figures(text, &rays(1 << 14)).expect("it can be measured");
    for three in rows.chunks(3) {
        assert!(three[2].value.abs() < 1e-6, "{three:?}");
        // A Lambert sphere sends 5/6 of parallel light back into the half space from which it
        // comes; the rest of the deviation is that of 64 segments.
        if three[0].incidence == NORMAL {
            let off = (three[0].value - 5.0 / 6.0).abs();
            assert!(off < 4.0 * three[0].error + 2e-3, "{three:?}");
        } else {
            assert!(three[0].value > 0.6, "{three:?}");
        }
    }
}

#[test]
fn a_ball_of_glass_lets_all_light_go() {
    let text = "[meshes.ball.sphere]\nradius_m = 0.1\n[materials.glass.dielectric]\neta = 1.5\n\
        [objects.ball]\nmesh = \"ball\"\nmaterial = \"glass\"\n\
        [instruments.ball.sphere]\nobject = \"ball\"\nwavelengths_nm = [550]\n";
    let rows = figures(text, &rays(1 << 14)).expect("it can be measured");
    for row in rows.iter().filter(|row| row.quantity == "absorptance") {
        // What is left at last by roulette, which is right on average.
        assert!(row.value.abs() < 1e-3, "{row:?}");
    }
}

#[test]
fn spots_off_the_leaf_are_refused_with_their_place() {
    let text = |spot: &str| {
        format!(
            "{SHEET}[materials.paper.diffuse]\nreflectance = 0.5\n\
             [objects.paper]\nmesh = \"sheet\"\nmaterial = \"paper\"\n\
             [instruments.ball.sphere]\nobject = \"paper\"\nwavelengths_nm = [550]\nspot = {spot}\n"
        )
    };
    let refused = |spot: &str| {
        figures(&text(spot), &rays(1024))
            .expect_err("it is off")
            .to_string()
    };
    let off = refused("{ at_mm = [60, 0], diameter_mm = 1 }");
    assert_eq!(
        off,
        "bench.toml:15:1: the spot is off the object `paper`: `at_mm = [60, 0]` is no point of its \
         surface"
    );
    assert!(refused("{ at_uv = [0.5, 1.1], diameter_mm = 1 }").contains("`at_uv = [0.5, 1.1]`"));
    let partly = figures(&text("{ at_mm = [50, 0], diameter_mm = 4 }"), &rays(1024));
    let Some(Problem::NotCovered { share, .. }) = partly.err().map(|error| error.problem) else {
        panic!("half of it is off");
    };
    assert!((share - 50.0).abs() < 5.0, "{share} %");
}

#[test]
fn a_spot_by_texture_coordinates_is_the_one_at_their_place() {
    // At a corner of a strip, so that the share that is off depends on both coordinates.
    let share = |spot: &str| {
        let text = format!(
            "[meshes.strip.rectangle]\nwidth_m = 0.1\nheight_m = 0.05\n\
             [materials.paper.diffuse]\nreflectance = 0.5\n\
             [objects.paper]\nmesh = \"strip\"\nmaterial = \"paper\"\n\
             [instruments.ball.sphere]\nobject = \"paper\"\nwavelengths_nm = [550]\nspot = {spot}\n"
        );
        match figures(&text, &rays(1024)).map_err(|error| error.problem) {
            Err(Problem::NotCovered { share, .. }) => share,
            found => panic!("a part of it is off: {found:?}"),
        }
    };
    let by_place = share("{ at_mm = [49, 23], diameter_mm = 8 }");
    let by_uv = share("{ at_uv = [0.99, 0.96], diameter_mm = 8 }");
    assert!((by_place - by_uv).abs() < 0.3, "{by_place} {by_uv}");
    let swapped = share("{ at_uv = [0.96, 0.99], diameter_mm = 8 }");
    assert!((by_place - swapped).abs() > 2.0, "{by_place} {swapped}");
}

/// A white ball of 0.1 m with a spot on its pole.
fn spot_on_a_ball(faces: &str) -> String {
    format!(
        "[meshes.ball.sphere]\nradius_m = 0.1\n[materials.white.diffuse]\nreflectance = 1\n\
         [objects.ball]\nmesh = \"ball\"\nmaterial = \"white\"\n\
         [instruments.ball.sphere]\nobject = \"ball\"\nwavelengths_nm = [550]\ndiffuse = false\n\
         faces = \"{faces}\"\nspot = {{ at_mm = [0, 0], diameter_mm = 100 }}\n"
    )
}

#[test]
fn a_spot_on_a_ball_is_lit_from_outside_alone() {
    let rows = figures(&spot_on_a_ball("adaxial"), &rays(1 << 13)).expect("it can be measured");
    // A white surface at an angle θ sends (1 + cos θ) / 2 back into the half space of the port;
    // its mean over the disc, where sin² θ is even in [0, s].
    let s: f64 = 0.25;
    let cosine = (1.0 - (1.0 - s) * (1.0 - s).sqrt()) / (1.5 * s);
    let off = (rows[0].value - 0.5 * (1.0 + cosine)).abs();
    assert!(off < 4.0 * rows[0].error + 2e-3, "{rows:?}");
    // A ray that starts within the ball never leaves it.
    assert!(rows[2].value.abs() < 1e-5, "{rows:?}");
    for faces in ["both", "abaxial"] {
        let error = figures(&spot_on_a_ball(faces), &rays(1024)).expect_err("it is inside");
        assert!(
            matches!(error.problem, Problem::PortInside { .. }),
            "{error}"
        );
    }
}
