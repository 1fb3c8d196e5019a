//! Limits of light: none is silent, and none is met by what has a closed form.

use std::path::Path;

use renderer::film::Series;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use renderer::spectrum::observer::Observer;
use support::picture::{mean_of, picture_of};

/// A picture of nothing but a sky; a scene has an object, which is behind the camera.
fn sky(film: &str, radiance: &str) -> String {
    format!(
        "format = 1\n{film}\n\
         [camera.orthographic]\nposition_m = [0, 0, 5]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\n\
         height_m = 1\n[meshes.speck.rectangle]\nwidth_m = 0.01\nheight_m = 0.01\n\
         [materials.speck.diffuse]\nreflectance = 0\n[objects.speck]\nmesh = \"speck\"\n\
         material = \"speck\"\nposition_m = [0, 0, 20]\n[lights.sky.constant]\nradiance_w_m2_sr_nm = {radiance}\n"
    )
}

/// A line of area 10 W m⁻² sr⁻¹ that begins and ends so far from its peak.
fn line(nm: f64, half_width: f64) -> String {
    let (top, first, last) = (10.0 / half_width, nm - half_width, nm + half_width);
    format!("{{ table = [[360, 0], [{first}, 0], [{nm}, {top}], [{last}, 0], [830, 0]] }}")
}

#[test]
fn a_line_narrower_than_a_set_of_wavelengths_is_recorded_whole_in_pictures() {
    let rgb = "[film.rgb]\nsize = [2, 2]\nspp = 256\nfilter_radius_px = 0";
    let bands =
        "[film.spectral]\nsize = [2, 2]\nspp = 256\nbands_nm = [500, 550]\nband_width_nm = 10";
    for nm in [550.0, 550.1, 550.2, 550.3, 589.3] {
        for half_width in [0.1, 0.005] {
            let rendered = picture_of(&sky(rgb, &line(nm, half_width)), 1);
            let seen = Observer::Cie1931.srgb_at(nm);
            let most = seen.iter().fold(0.0_f64, |most, seen| most.max(seen.abs()));
            for (channel, seen) in seen.into_iter().enumerate() {
                let found = mean_of(&rendered, channel);
                // What the observer sees changes by up to 0.4 % within a set.
                let off = (found - 10.0 * seen).abs();
                assert!(off < 0.04 * most, "{nm}, {half_width}: {found} for {seen}");
            }
            // A light that is dark at all bands is refused.
            if nm > 555.0 {
                continue;
            }
            let rendered = picture_of(&sky(bands, &line(nm, half_width)), 1);
            let expected = 1.0;
            let found = mean_of(&rendered, 1);
            // Wavelengths have single precision, 0.00003 nm on a slope of 1000 per nm.
            assert!(
                (found - expected).abs() < 1e-3,
                "{nm}, {half_width}: {found}"
            );
            assert_eq!(mean_of(&rendered, 0), 0.0);
        }
    }
}

/// Why a scene is refused.
fn refused(text: &str) -> String {
    let loaded = parse(text, "test.toml", Path::new("."), &[]);
    let description = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&description);
    world.map(|_| ()).expect_err("it is too bright").to_string()
}

#[test]
fn lights_brighter_than_a_film_records_are_refused_by_name_and_others_are_recorded() {
    let film = "[film.spectral]\nsize = [2, 2]\nspp = 32\nbands_nm = [485, 825]";
    for radiance in [
        "1e10",
        "{ table = [[300, 0], [824, 0], [825, 1e12], [2600, 0]] }",
    ] {
        let why = refused(&sky(film, radiance));
        assert!(why.starts_with("lights.sky: "), "{why}");
    }
    // Relative to 560 nm, a body of 100 K shines 10³⁶ times as brightly at 825 nm.
    let lamp = |kelvin: f64| {
        sky(film, "0").replace(
            "constant]\nradiance_w_m2_sr_nm = 0",
            &format!(
                "distant]\ntowards = [0, 0, 1]\nangular_diameter_deg = 1\n\
             irradiance_w_m2_nm = {{ blackbody_k = {kelvin} }}"
            ),
        )
    };
    let why = refused(&lamp(100.0));
    assert!(why.starts_with("lights.sky: at 8"), "{why}");
    assert!(World::build(&parsed(&lamp(2000.0))).is_ok());
    let bright = picture_of(&sky(film, "1e9"), 1);
    assert!((mean_of(&bright, 0) / 1e9 - 1.0).abs() < 1e-6);
    assert_eq!(bright.film.clamped(), 0);
    // Squares of so great values do not fit; a variance of 0 would be a lie.
    assert!(bright.film.overflowed() > 0);
    assert!(bright.film.variance(Series::Luminance)[0].is_infinite());
    let notes = bright.notes();
    assert!(
        notes.len() == 1 && notes[0].contains("variance"),
        "{notes:?}"
    );
}

#[test]
fn a_picture_too_dark_for_its_variance_says_so() {
    let film = "[film.spectral]\nsize = [2, 2]\nspp = 32\nbands_nm = [485, 825]";
    for (radiance, dark) in [("5e-6", true), ("2e-5", false)] {
        let notes = picture_of(&sky(film, radiance), 1).notes();
        let says = notes.iter().any(|note| note.contains("below 1e-5"));
        assert_eq!((says, notes.len()), (dark, usize::from(dark)), "{notes:?}");
    }
}

fn parsed(text: &str) -> renderer::scene::description::Description {
    let loaded = parse(text, "test.toml", Path::new("."), &[]);
    loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description
}

/// A white ball under a white sky: its radiance is 1.
fn furnace(integrator: &str) -> String {
    let film = "[film.spectral]\nsize = [8, 8]\nspp = 64\nbands_nm = [550]";
    sky(film, "1")
        + "[meshes.bowl.box]\nsize_m = [1, 1, 0.2]\n[materials.white.diffuse]\nreflectance = 1\n\
           [objects.one]\nmesh = \"bowl\"\nmaterial = \"white\"\nposition_m = [0, 0, -0.5]\n\
           [objects.two]\nmesh = \"bowl\"\nmaterial = \"white\"\nposition_m = [0, 0.6, 0]\n\
           rotate_deg = [80, 0, 0]\n[integrator]\nbranches = 1\nlit_branches = 1\n"
        + integrator
}

#[test]
fn paths_that_a_limit_cuts_are_counted_with_a_bound_of_the_light_that_is_missing() {
    let whole = picture_of(&furnace(""), 3);
    assert!((mean_of(&whole, 0) - 1.0).abs() < 1e-3);
    assert_eq!((whole.film.cut(), whole.notes().len()), (0, 0));
    for limit in [
        "max_depth = 1",
        "max_depth = 2",
        "max_events = 2",
        "max_events = 3",
    ] {
        let cut = picture_of(&furnace(limit), 3);
        let missing = 1.0 - mean_of(&cut, 0);
        assert!(missing > 0.001, "{limit}: {missing}");
        assert!(cut.film.cut() > 0, "{limit}");
        // In a furnace all that is cut would have found the bound itself.
        let bound = cut.film.missing();
        assert!((bound - missing).abs() < 2e-3, "{limit}: {missing} {bound}");
        let notes = cut.notes();
        assert!(
            notes.len() == 1 && notes[0].contains("max_depth"),
            "{notes:?}"
        );
    }
    let spot = "\n[lights.spot.spot]\nposition_m = [0, 0, 3]\nlook_at_m = [0, 0, 0]\n\
                cone_angle_deg = 20\nintensity_w_sr_nm = 1\n";
    let unbounded = picture_of(&(furnace("max_depth = 1") + spot), 3);
    assert!(unbounded.film.missing().is_infinite());
    // A small bright lamp: what is cut could have met it, so the bound is no help.
    let sun = "\n[lights.sun.distant]\ntowards = [0, 0, -1]\nangular_diameter_deg = 0.5\n\
               irradiance_w_m2_nm = 1\n";
    let notes = picture_of(&(furnace("max_depth = 1") + sun), 3).notes();
    let says = notes.len() == 1 && notes[0].contains("how much light is missing is not known");
    assert!(says, "{notes:?}");
}
