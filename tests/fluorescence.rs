//! Pictures of leaves that fluoresce, against the matrices of the leaf and against instruments.

use std::f64::consts::PI;
use std::path::Path;

use leafmodel::optics::fluorescence::{EmissionSpectrum, Leaf, energy_over_photons, matrices};
use leafmodel::optics::{Contents, Pigments};
use renderer::export::mitsuba;
use renderer::instruments::{Budget, Row, read_out, sets_of};
use renderer::scene::load::parse_for_instruments;
use renderer::scene::world::{BuildOptions, World};
use support::picture::{mean_and_error, mean_and_error_of, mean_of, picture_of, world_of};

const CONTENTS: [f64; 7] = [1.5, 40.0, 10.0, 0.0, 0.0, 0.01, 0.009];
const EFFICIENCY: f64 = 0.02;
const BANDS_NM: [f64; 3] = [685.0, 740.0, 800.0];
/// Irradiance or radiance of light that excites and is not seen.
const BLUE_TO_ORANGE: &str = "{ table = [[400, 1], [600, 2], [610, 0], [850, 0]] }";

fn blue_to_orange(nm: f64) -> f64 {
    match nm {
        nm if nm <= 600.0 => 1.0 + (nm - 400.0) / 200.0,
        nm if nm < 610.0 => 2.0 * (610.0 - nm) / 10.0,
        _ => 0.0,
    }
}

/// Energy that a leaf sends back and through of that light, for each unit of it.
fn emitted(emission: f64) -> [f64; 2] {
    let leaf = Leaf {
        contents: Contents::prospect_d(CONTENTS),
        pigments: Pigments::default(),
        quantum_efficiency: EFFICIENCY,
        emission: EmissionSpectrum::default(),
    };
    let step = 0.5;
    let excitations: Vec<f64> = (0..420).map(|i| 400.25 + step * f64::from(i)).collect();
    let found = matrices(&leaf, &excitations, &[emission]);
    [found.backward, found.forward].map(|matrix| {
        let sum = excitations.iter().zip(&matrix).map(|(nm, row)| {
            blue_to_orange(*nm) * energy_over_photons(*nm, emission) * row[0] * step
        });
        sum.sum()
    })
}

/// A leaf without coats, lying in the plane, of which a picture is taken.
fn scene(blocks: &str) -> String {
    let [n, cab, car, .., cw, cm] = CONTENTS;
    format!(
        "format = 1\n\
         [film.spectral]\nsize = [8, 8]\nspp = 64\nbands_nm = {BANDS_NM:?}\nband_width_nm = 0\n\
         [camera.perspective]\nposition_m = [0.3, -0.2, 1]\nlook_at_m = [0, 0, 0]\n\
         vertical_fov_deg = 4\n\
         [meshes.sheet.rectangle]\nwidth_m = 20\nheight_m = 20\n\
         [materials.green.leaf]\nfluorescence = {{ quantum_efficiency = {EFFICIENCY} }}\n\
         abaxial_ratio = 1\nadaxial = {{ eta = 1, alpha = 1 }}\nabaxial = {{ eta = 1, alpha = 1 }}\n\
         [materials.green.leaf.contents]\nstructure = {n}\nchlorophyll_ug_per_cm2 = {cab}\n\
         carotenoids_ug_per_cm2 = {car}\nwater_cm = {cw}\ndry_matter_g_per_cm2 = {cm}\n\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"green\"\n{blocks}"
    )
}

/// Mean and standard error of each band over all pixels and twelve seeds.
fn bands(text: &str) -> [(f64, f64); BANDS_NM.len()] {
    let pictures: Vec<_> = (0..12).map(|seed| picture_of(text, seed)).collect();
    std::array::from_fn(|channel| {
        let means: Vec<f64> = pictures.iter().map(|own| mean_of(own, channel)).collect();
        mean_and_error_of(&means)
    })
}

/// Asserts that each band of a picture has a radiance.
fn assert_radiance(what: &str, text: &str, expected: impl Fn(f64) -> f64) {
    for ((mean, error), nm) in bands(text).into_iter().zip(BANDS_NM) {
        let expected = expected(nm);
        eprintln!("{what}, {nm} nm: {mean:.4e} ± {error:.1e}, expected {expected:.4e}");
        assert!(
            error < 0.02 * expected,
            "the error hides what is to be seen"
        );
        assert!((mean - expected).abs() < 4.0 * error + 1e-4 * expected);
    }
}

#[test]
fn a_leaf_in_the_sun_shows_what_its_matrix_sends_back() {
    let sun = format!(
        "[lights.sun.distant]\nirradiance_w_m2_nm = {BLUE_TO_ORANGE}\nelevation_deg = 30\n\
         azimuth_deg = 40\n"
    );
    assert_radiance("sun", &scene(&sun), |nm| 0.5 * emitted(nm)[0] / PI);
}

#[test]
fn a_leaf_lit_from_everywhere_shows_what_both_matrices_send_out() {
    let sky = format!("[lights.sky.constant]\nradiance_w_m2_sr_nm = {BLUE_TO_ORANGE}\n");
    assert_radiance("sky", &scene(&sky), |nm| emitted(nm).iter().sum());
}

#[test]
fn a_leaf_without_the_block_is_black_in_light_of_other_wavelengths() {
    // Light that the film sees somewhere, or the scene is refused.
    let sky = "[lights.sky.constant]\nradiance_w_m2_sr_nm = { table = [[400, 1], [600, 2], \
        [610, 0], [790, 0], [850, 1]] }\n";
    let text = scene(sky);
    let key = format!("fluorescence = {{ quantum_efficiency = {EFFICIENCY} }}\n");
    let (mean, _) = mean_and_error(&text.replace(&key, ""), 1, 2);
    assert_eq!(mean, 0.0);
}

/// Two leaves one over the other in the sun, and an instrument over them.
fn two_leaves() -> String {
    scene(&format!(
        "[objects.below]\nmesh = \"sheet\"\nmaterial = \"green\"\nposition_m = [0, 0, -0.01]\n\
         [lights.sun.distant]\nirradiance_w_m2_nm = {BLUE_TO_ORANGE}\nelevation_deg = 30\n\
         azimuth_deg = 40\n\
         [instruments.field.canopy]\nwithin_m = [-1, -1, 1, 1]\nincidence_deg = [60]\n\
         wavelengths_nm = [550]\n\
         fluorescence = {{ spectrum = {BLUE_TO_ORANGE}, emission_nm = {BANDS_NM:?} }}\n"
    ))
}

/// The figures of the only instrument of a scene.
fn measured(text: &str, rays: u64) -> Vec<Row> {
    let loaded = parse_for_instruments(text, "two.toml", Path::new("."), &[]);
    let description = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let (sampler, first) = sets_of(&description).expect("there is an instrument");
    let options = BuildOptions {
        wavelengths: Some(&sampler),
        ..BuildOptions::default()
    };
    let world = World::build_with(&description, &options).expect("it can be built");
    let budget = Budget {
        rays,
        error: None,
        seed: 3,
    };
    let reading = read_out(&world, &description, 0, first[0], &budget);
    reading.expect("it can be measured").rows
}

#[test]
fn a_limit_that_no_path_reaches_changes_no_figure_of_fluorescence() {
    let text = two_leaves();
    let limited = format!("{text}[integrator]\nmax_events = 1000\n");
    assert_eq!(measured(&limited, 1 << 12), measured(&text, 1 << 12));
}

#[test]
fn two_leaves_one_over_the_other_look_as_the_instrument_measures_them() {
    let text = two_leaves();
    let rows = measured(&text, 1 << 18);
    for ((mean, error), nm) in bands(&text).into_iter().zip(BANDS_NM) {
        let own =
            |row: &&Row| row.quantity == "fluorescence_upwards" && row.wavelength_nm == Some(nm);
        let row = rows.iter().find(own).expect("it is measured");
        // The light of the instrument is counted by level area, and its leaves send out light evenly.
        let (measured, measured_error) = (0.5 * row.value / PI, 0.5 * row.error / PI);
        let one_leaf = 0.5 * emitted(nm)[0] / PI;
        let sum = error.hypot(measured_error);
        eprintln!(
            "{nm} nm: picture {mean:.4e} ± {error:.1e}, instrument {measured:.4e} ± \
             {measured_error:.1e}; one leaf {one_leaf:.4e}"
        );
        assert!(sum < 0.02 * mean && (mean - measured).abs() < 4.0 * sum + 1e-4 * mean);
        // The lower leaf adds more than the errors.
        assert!(nm < 700.0 || mean > one_leaf + 5.0 * sum);
    }
}

#[test]
fn a_grown_leaf_with_maps_fluoresces_in_pictures_of_the_same_bytes() {
    let text = format!(
        "format = 1\n\
         [film.spectral]\nsize = [8, 8]\nspp = 16\nbands_nm = {BANDS_NM:?}\nband_width_nm = 0\n\
         [camera.orthographic]\nposition_m = [0, 0.03, 1]\nlook_at_m = [0, 0.03, 0]\nup = [0, 1, 0]\n\
         height_m = 0.02\n\
         [leaves.birch]\npreset = \"birch\"\nmap_size = 256\nfluorescence = {{}}\n\
         [objects.leaf]\nleaf = \"birch\"\n\
         [lights.sky.constant]\nradiance_w_m2_sr_nm = {BLUE_TO_ORANGE}\n"
    );
    let [once, again] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let run = || {
            picture_of(&text, 5)
                .film
                .map(|pixel| pixel.mean(1).to_bits())
        };
        pool.expect("there are threads").install(run)
    });
    assert_eq!(once, again);
    let lit = once.iter().filter(|bits| f64::from_bits(**bits) > 0.0);
    assert!(lit.count() > 32);
}

#[test]
fn a_scene_that_fluoresces_is_not_exported_without_it() {
    let (scene, world) = world_of(&scene("[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n"));
    let folder = Path::new("never-written");
    let refused = mitsuba::write(&scene, &world, folder).expect_err("Mitsuba cannot show it");
    assert!(refused.to_string().contains("leave `fluorescence` out"));
    assert!(!folder.exists());
}
