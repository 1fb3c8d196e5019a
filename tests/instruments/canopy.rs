//! Fluxes of canopies that repeat themselves.

use renderer::instruments::{Direction, Problem, notes};

use super::{NORMAL, built, figures, figures_of, of, rays};

/// Discs afloat over ground.
pub(super) fn discs(radius: f64, lai: f64, [low, high]: [f64; 2]) -> String {
    format!(
        "[meshes.disc.disc]\nradius_m = {radius}\n\
         [meshes.ground.rectangle]\nwidth_m = 3\nheight_m = 3\n\
         [materials.leaf.leaf]\nabaxial_ratio = 1\nadaxial = {{ eta = 1, alpha = 1 }}\n\
         abaxial = {{ eta = 1, alpha = 1 }}\n\
         [materials.leaf.leaf.measured]\nreflectance = 0.4\ntransmittance = 0.3\n\
         [materials.soil.diffuse]\nreflectance = 0.2\n\
         [objects.ground]\nmesh = \"ground\"\nmaterial = \"soil\"\nposition_m = [0, 0, -{radius}]\n\
         [objects.leaves]\nmesh = \"disc\"\nmaterial = \"leaf\"\n\
         volume = {{ within_m = [0, 0, {low}, 1, 1, {high}], lai = {lai}, seed = 4 }}\n"
    )
}

/// A sheet of a two-sided Lambertian leaf over ground, one metre up, and a canopy of both.
fn sheet(width: f64, keys: &str) -> String {
    format!(
        "[meshes.sheet.rectangle]\nwidth_m = {width}\nheight_m = {width}\n\
         [materials.leaf.leaf]\nabaxial_ratio = 1\nadaxial = {{ eta = 1, alpha = 1 }}\n\
         abaxial = {{ eta = 1, alpha = 1 }}\n\
         [materials.leaf.leaf.measured]\nreflectance = 0.4\ntransmittance = 0.3\n\
         [materials.soil.diffuse]\nreflectance = 0.2\n\
         [meshes.ground.rectangle]\nwidth_m = 4\nheight_m = 4\n\
         [objects.ground]\nmesh = \"ground\"\nmaterial = \"soil\"\n\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\nposition_m = [0, 0, 1]\n{keys}"
    )
}

#[test]
fn a_level_leaf_over_soil_has_the_fluxes_of_two_plates() {
    let text = sheet(
        4.0,
        "[instruments.field.canopy]\nwithin_m = [-1, -1, 1, 1]\nwavelengths_nm = [550]\n\
         soil = \"ground\"\nincidence_deg = [0, 70]\ndiffuse = true\nlayers_m = [0.5]\n",
    );
    let rows = figures(&text, &rays(1 << 17)).expect("it can be measured");
    let (r, t, soil) = (0.4, 0.3, 0.2);
    let arriving = t / (1.0 - r * soil);
    let reflected = r + arriving * soil * t;
    for incidence in [
        NORMAL,
        Direction::Beam(70_f64.to_radians()),
        Direction::Diffuse,
    ] {
        for (quantity, expected) in [
            ("reflected", reflected),
            ("arriving_at_soil", arriving),
            ("absorbed_by_soil", arriving * (1.0 - soil)),
            ("absorbed", 1.0 - reflected - arriving * (1.0 - soil)),
            ("uncollided", 0.0),
            ("transmitted", 0.0),
        ] {
            let row = of(&rows, quantity, incidence, 550.0)
                .next()
                .expect("it is measured");
            let off = (row.value - expected).abs();
            assert!(off < 4.0 * row.error + 1e-6, "{row:?} for {expected}");
            assert!(row.error < 2e-3, "{row:?}");
        }
        let of_all = ["reflected", "transmitted", "absorbed_by_soil", "absorbed"];
        let sum: f64 = of_all
            .into_iter()
            .flat_map(|quantity| of(&rows, quantity, incidence, 550.0))
            .map(|row| row.value)
            .sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        let layers: Vec<_> = of(&rows, "absorbed_in_layer", incidence, 550.0).collect();
        assert_eq!(layers[0].part.as_deref(), Some("below 0.5 m"));
        assert_eq!((layers.len(), layers[0].value), (2, 0.0));
    }
}

#[test]
fn what_crosses_the_border_of_the_box_is_whole_and_shades_as_much_as_anywhere() {
    // A leaf of 0.6 by 0.6 m in a box of 2 by 2 m, whose middle is a corner, a side or the middle of
    // the box.
    let sun = Direction::Beam(40_f64.to_radians());
    for corner in [[-1.0, -1.0], [0.0, 0.0], [-0.2, 0.0], [-0.1, -1.7]] {
        let [x, y] = corner;
        let text = sheet(
            0.6,
            &format!(
                "[instruments.field.canopy]\nwithin_m = [{x}, {y}, {}, {}]\nwavelengths_nm = [550]\n\
                 soil = \"ground\"\nincidence_deg = [0, 40]\nazimuth_deg = 25\n",
                x + 2.0,
                y + 2.0
            ),
        );
        let rows = figures(&text, &rays(1 << 16)).expect("it can be measured");
        for incidence in [NORMAL, sun] {
            let row = of(&rows, "uncollided", incidence, 550.0)
                .next()
                .expect("it is measured");
            let off = (row.value - (1.0 - 0.09)).abs();
            assert!(off < 4.0 * row.error, "{corner:?}: {row:?}");
            assert!(row.error < 1e-3, "{corner:?}: {row:?}");
        }
    }
}

#[test]
fn a_gap_is_seen_as_often_as_leaves_at_random_leave_it() {
    // exp(−G LAI / cos θ) of many small discs; the deviation of one set of discs is that of about
    // 1 / (π r²) independent places.
    let text = format!(
        "{}[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
         soil = \"ground\"\nincidence_deg = [0, 60]\n",
        discs(0.005, 1.0, [0.0, 1.0])
    );
    let rows = figures(&text, &rays(1 << 15)).expect("it can be measured");
    for (angle, cosine) in [(0.0_f64, 1.0), (60.0, 0.5)] {
        let incidence = Direction::Beam(angle.to_radians());
        let row = of(&rows, "uncollided", incidence, 550.0)
            .next()
            .expect("it is measured");
        let expected = libm::exp(-0.5 / cosine);
        let of_places = (0.14 * std::f64::consts::PI).sqrt() * 0.005;
        let error = row.error.hypot(of_places);
        assert!(
            (row.value - expected).abs() < 4.0 * error,
            "{row:?} for {expected}"
        );
    }
}

#[test]
#[ignore = "deep: 50,000 discs, 35 s of a processor"]
fn what_lies_outside_the_box_is_not_in_it() {
    // Discs over 4 by 4 m, and a box of a quarter of them: as many leave a gap, but for the
    // deviation of places, as above.
    let text = |within: &str| {
        let discs = discs(0.01, 1.0, [0.0, 1.0])
            .replace("width_m = 3\nheight_m = 3", "width_m = 10\nheight_m = 10")
            .replace(
                "within_m = [0, 0, 0, 1, 1, 1]",
                "within_m = [0, 0, 0, 4, 4, 1]",
            );
        assert!(discs.contains("4, 4, 1]") && discs.contains("= 10"));
        format!(
            "{discs}[instruments.field.canopy]\nwithin_m = {within}\nwavelengths_nm = [550]\n\
             soil = \"ground\"\nincidence_deg = [0, 40]\n"
        )
    };
    let scenes = ["[0, 0, 4, 4]", "[1, 1, 3, 3]"].map(|within| built(&text(within)));
    let [whole, quarter] = scenes
        .each_ref()
        .map(|scene| figures_of(scene, &rays(1 << 15)).expect("it can be measured"));
    for incidence in [NORMAL, Direction::Beam(40_f64.to_radians())] {
        let [all, part] = [&whole, &quarter].map(|rows| {
            of(rows, "uncollided", incidence, 550.0)
                .next()
                .expect("it is measured")
        });
        let of_places = (0.14 * std::f64::consts::PI).sqrt() * 0.01 / 2.0;
        let error = all.error.hypot(part.error).hypot(of_places);
        assert!(
            (all.value - part.value).abs() < 4.0 * error,
            "{all:?} {part:?}"
        );
        assert!(error < 6e-3, "{all:?} {part:?}");
    }
    let [none, notes] = scenes.map(|(scene, world, _)| notes(&world, &scene, 0));
    // The first note says that errors hold for one draw.
    assert_eq!((none.len(), notes.len()), (1, 2), "{none:?} {notes:?}");
    let left_out = "parts of the object `leaves` stand outside `within_m` and are left out";
    assert!(notes[1].ends_with(left_out), "{notes:?}");
}

#[test]
fn a_wall_on_a_side_of_the_box_lets_nothing_by() {
    // Black walls of 1 by 1 m, 1 m apart: of even light, √2 − 1 comes through between them.
    let wall = |name: &str, x: f64| {
        format!(
            "[objects.{name}]\nmesh = \"wall\"\nmaterial = \"black\"\n\
             position_m = [{x}, 0.5, 0.5]\nrotate_deg = [0, 90, 0]\n"
        )
    };
    let text = |walls: String| {
        format!(
            "[meshes.wall.rectangle]\nwidth_m = 1\nheight_m = 1\n\
             [materials.black.diffuse]\nreflectance = 0\n{walls}\
             [instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
             diffuse = true\n"
        )
    };
    let both = wall("west", 0.0) + &wall("east", 1.0);
    for walls in [wall("west", 0.0), wall("middle", 0.5), both] {
        let rows = figures(&text(walls), &rays(1 << 16)).expect("it can be measured");
        for quantity in ["uncollided", "transmitted"] {
            let row = of(&rows, quantity, Direction::Diffuse, 550.0)
                .next()
                .expect("it is measured");
            let off = (row.value - (2_f64.sqrt() - 1.0)).abs();
            assert!(off < 4.0 * row.error + 1e-5, "{row:?}");
            assert!(row.error < 2e-3, "{row:?}");
        }
    }
}

#[test]
fn without_leaves_the_figures_are_those_of_bare_soil() {
    let floating = |lai: f64| discs(0.05, lai, [0.0, 1.0]);
    let strewn = |amount: &str| {
        let keys = format!(
            "[objects.strewn]\nmesh = \"sheet\"\nmaterial = \"leaf\"\n\
             scatter = {{ on = \"ground\", {amount} }}\n"
        );
        let text = sheet(0.1, &keys);
        let at = text.find("[objects.leaf]").expect("there is a leaf");
        let end = text
            .find("[objects.strewn]")
            .expect("there are strewn ones");
        text[..at].to_owned() + &text[end..]
    };
    let alone = floating(1.0);
    let alone = &alone[..alone.find("[objects.leaves]").expect("there are leaves")];
    let instrument = "[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550]\n\
        soil = \"ground\"\nincidence_deg = [0, 50]\ndiffuse = true\ndetector = { zenith_deg = [-60, 0] }\n";
    for (leaves, text) in [
        (1, floating(0.0)),
        (1, strewn("count = 0")),
        (1, strewn("per_m2 = 0")),
        (0, alone.to_owned()),
    ] {
        let built = built(&(text + instrument));
        let notes = notes(&built.1, &built.0, 0);
        assert!(notes[0].contains("bare soil"), "{notes:?}");
        let rows = figures_of(&built, &rays(1 << 12)).expect("it can be measured");
        for row in &rows {
            let expected = match row.quantity {
                "reflected" | "brf" | "hdrf" => 0.2,
                "uncollided" | "arriving_at_soil" => 1.0,
                "absorbed_by_soil" => 0.8,
                "absorbed" | "transmitted" => 0.0,
                other => panic!("{other} is not expected"),
            };
            assert!((row.value - expected).abs() < 1e-6, "{row:?}");
        }
        assert_eq!(of(&rows, "absorbed", NORMAL, 550.0).count(), leaves);
    }
}

#[test]
fn a_canopy_without_anything_and_soil_that_is_too_small_are_refused() {
    let bare = sheet(
        0.1,
        "[instruments.field.canopy]\nwithin_m = [-0.3, -0.3, 0.2, 0.2]\nsoil = \"leaf\"\n",
    );
    // Light meets the ground, which is not the soil, where the leaf is not.
    let found = figures(&bare, &rays(1024));
    assert!(
        matches!(&found, Err(error) if matches!(error.problem, Problem::SoilTooSmall { .. })),
        "{found:?}"
    );
    let beside = "[meshes.ground.rectangle]\nwidth_m = 4\nheight_m = 4\n\
        [materials.soil.diffuse]\nreflectance = 0.2\n\
        [objects.ground]\nmesh = \"ground\"\nmaterial = \"soil\"\n\
        [instruments.field.canopy]\nwithin_m = [5, 0, 6, 1]\nsoil = \"ground\"\n";
    let error = figures(beside, &rays(1024)).expect_err("there is nothing");
    assert_eq!(
        error.to_string(),
        "bench.toml:12:14: nothing lies in `within_m`: move the box, or add soil or leaves to the scene"
    );
}

#[test]
fn a_canopy_under_a_dome_far_wider_than_its_box_is_refused() {
    let dome = |radius: f64| {
        let keys = format!(
            "[meshes.dome.sphere]\nradius_m = {radius}\n[objects.dome]\nmesh = \"dome\"\n\
             material = \"soil\"\n[instruments.field.canopy]\nwithin_m = [-0.5, -0.5, 0.5, 0.5]\n\
             soil = \"ground\"\nwavelengths_nm = [550]\n"
        );
        figures(&sheet(4.0, &keys), &rays(1024))
    };
    let error = dome(1e6).expect_err("a dome of 1,000 km over a box of 1 m");
    let text = error.to_string();
    assert!(
        text.starts_with("bench.toml:") && text.contains("more than 1000 times the smaller side")
            && text.ends_with(
                "(1 m); the tallest is of the object `dome`: widen the box, or leave that object out of the scene"
            ),
        "{text}"
    );
    dome(400.0).expect("800 times as high as wide");
}
