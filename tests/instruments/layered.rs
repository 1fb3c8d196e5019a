//! A leaf through whose layers light is followed, by the renderer's own rays, against the ordinates of
//! leafmodel.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use leafmodel::optics::layers::{Face, Incidence, LayeredLeaf, Ordinates, Resolution};
use leafmodel::optics::{ProspectD, presets};
use renderer::film::Series;
use renderer::instruments::{Budget, Direction, Row, read_out, sets_of};
use renderer::integrator::render::{Job, render};
use renderer::scene::description::{Description, Material};
use renderer::scene::load::{parse, parse_for_instruments};
use renderer::scene::world::{BuildOptions, World};
use support::picture::{mean_and_error_of, mean_of, picture_of};

use super::{HEAD, figures, of, rays};

const SHEET: &str = "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n\
    [objects.sample]\nmesh = \"sheet\"\nmaterial = \"green\"\nposition_m = [0.3, 0.2, 0.1]\n\
    rotate_deg = [30, 20, 10]\n";

/// A leaf of a preset below a sphere for one wavelength.
fn sphere(preset: &str, nm: f64) -> String {
    format!(
        "{SHEET}[materials.green.leaf]\npreset = \"{preset}\"\noptics = \"layers\"\n\
         [instruments.ball.sphere]\nobject = \"sample\"\n\
         spot = {{ at_mm = [3, -20], diameter_mm = 20 }}\n\
         incidence_deg = [0, 60]\nwavelengths_nm = [{nm}]\n"
    )
}

/// Makes the faces of a scene's leaf smooth, which no scene can ask for.
fn smoothed(mut scene: Description) -> Description {
    let Material::Leaf(leaf) = &mut scene.materials[0].value else {
        panic!("the material is a leaf");
    };
    for coat in &mut leaf.faces.coats {
        (coat.alpha_across, coat.alpha_along) = (0.0, 0.0);
    }
    scene
}

/// The figures of a scene whose leaf has smooth faces.
fn smooth(text: &str, budget: &Budget) -> Vec<Row> {
    let text = format!("{HEAD}{text}");
    let loaded = parse_for_instruments(&text, "bench.toml", Path::new("."), &[]);
    let scene = loaded.unwrap_or_else(|errors| panic!("{errors}"));
    let scene = smoothed(scene.description);
    let (sampler, first) = sets_of(&scene).expect("there are instruments");
    let options = BuildOptions {
        wavelengths: Some(&sampler),
        ..BuildOptions::default()
    };
    let world = World::build_with(&scene, &options).expect("it can be built");
    let found = read_out(&world, &scene, 0, first[0], budget);
    found.expect("it can be measured").rows
}

#[test]
fn a_flat_leaf_reads_what_the_ordinates_of_its_layers_say_on_both_faces() {
    let mut greatest = 0.0_f64;
    for (preset, nm) in [
        ("sun-green", 550.0),
        ("sun-green", 800.0),
        ("red-maple-scarlet", 550.0),
        ("brown-litter", 680.0),
    ] {
        let contents = presets::by_name(preset).expect("a preset").contents;
        let at = ProspectD::coefficients(nm).expect("in the table");
        let stack = LayeredLeaf::new(&contents).stack(&at);
        let slanted = libm::cos(f64::to_radians(60.0));
        let solved = Ordinates::new(&stack, Resolution::new(16), &[1.0, slanted]).expect("solved");
        let rows = smooth(&sphere(preset, nm), &rays(4096));
        let cases = [
            (Direction::Beam(0.0), Incidence::NORMAL),
            (
                Direction::Beam(f64::to_radians(60.0)),
                Incidence::Directional { cosine: slanted },
            ),
            (Direction::Diffuse, Incidence::Lambertian),
        ];
        for (lit, incidence) in cases {
            for (word, face) in [("adaxial", Face::First), ("abaxial", Face::Last)] {
                let exact = &solved.fluxes(face, &[incidence]).expect("solved for")[0];
                let expected = [
                    ("reflectance", exact.reflected),
                    ("transmittance", exact.transmitted),
                ];
                for (quantity, expected) in expected {
                    let row = of(&rows, quantity, lit, nm)
                        .find(|row| row.face == Some(word))
                        .expect("it is measured");
                    assert!(row.error < 6e-3, "{row:?}");
                    let z = (row.value - expected) / row.error;
                    greatest = greatest.max(z.abs());
                    assert!(z.abs() < 3.5, "{preset} {nm}: {row:?} for {expected}");
                }
            }
        }
    }
    eprintln!("greatest |z| {greatest:.2}");
}

/// R and T of the layers of `sun-green` at normal incidence on the adaxial face.
fn exact(nm: f64) -> [f64; 2] {
    let contents = presets::by_name("sun-green").expect("a preset").contents;
    let at = ProspectD::coefficients(nm).expect("in the table");
    let stack = LayeredLeaf::new(&contents).stack(&at);
    let solved = Ordinates::new(&stack, Resolution::new(16), &[1.0]).expect("solved");
    let fluxes = solved.fluxes(Face::First, &[Incidence::NORMAL]);
    let flux = &fluxes.expect("solved for")[0];
    [flux.reflected, flux.transmitted]
}

#[test]
fn a_spectrum_in_steps_of_10_nm_is_that_of_the_ordinates_at_every_wavelength() {
    // Sets of eight wavelengths from one end of the range to the other.
    let text = sphere("sun-green", 550.0).replace("incidence_deg = [0, 60]", "incidence_deg = [0]");
    let range = "range_nm = [400, 2400]\nstep_nm = 100\nfaces = \"adaxial\"\ndiffuse = false\n";
    for wanted in [
        range.to_owned(),
        range
            .replace("[400, 2400]", "[480, 720]")
            .replace("100", "10"),
    ] {
        let rows = smooth(
            &text.replace("wavelengths_nm = [550]\n", &wanted),
            &rays(4096),
        );
        let (mut greatest, mut count) = (0.0_f64, 0);
        for row in rows.iter().filter(|row| row.quantity != "absorptance") {
            let nm = row.wavelength_nm.expect("there is one");
            let expected = exact(nm)[usize::from(row.quantity == "transmittance")];
            greatest = greatest.max(((row.value - expected) / row.error).abs());
            count += 1;
        }
        eprintln!("greatest |z| of {count}: {greatest:.2}");
        assert!(count >= 42, "{count}");
        // Of 50 figures whose errors have 31 degrees of freedom 0.3 % are beyond 4.5.
        assert!(greatest < 4.5, "{greatest}");
    }
}

#[test]
fn a_picture_of_eight_bands_has_the_reflectance_of_each() {
    let bands = [450.0, 550.0, 650.0, 680.0, 700.0, 720.0, 740.0, 800.0];
    let text = format!(
        "format = 1\n[film.spectral]\nsize = [16, 16]\nspp = 128\nbands_nm = {bands:?}\n\
         band_width_nm = 0\n[camera.perspective]\nposition_m = [0, 0, 0.3]\nlook_at_m = [0, 0, 0]\n\
         up = [0, 1, 0]\nvertical_fov_deg = 4\n[materials.blade.leaf]\npreset = \"sun-green\"\n\
         optics = \"layers\"\n[materials.black.diffuse]\nreflectance = 0\n\
         [meshes.plate.rectangle]\nwidth_m = 0.2\nheight_m = 0.2\n\
         [meshes.ground.rectangle]\nwidth_m = 100\nheight_m = 100\n\
         [objects.blade]\nmesh = \"plate\"\nmaterial = \"blade\"\n\
         [objects.ground]\nmesh = \"ground\"\nmaterial = \"black\"\nposition_m = [0, 0, -0.01]\n\
         [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n"
    );
    let loaded = parse(&text, "leaf.toml", Path::new("."), &[]);
    let scene = loaded.unwrap_or_else(|errors| panic!("{errors}"));
    let world = World::build(&smoothed(scene.description)).expect("it can be built");
    let pictures = (1..=12).map(|seed| {
        let job = Job {
            width: 16,
            height: 16,
            spp: 128,
            seed,
        };
        let rendered = render(&world, &job, &AtomicBool::new(false), &|_| ());
        rendered.expect("a small film fits")
    });
    let pictures: Vec<_> = pictures.collect();
    for (channel, nm) in bands.into_iter().enumerate() {
        let means: Vec<f64> = pictures.iter().map(|one| mean_of(one, channel)).collect();
        let (mean, error) = mean_and_error_of(&means);
        let [expected, _] = exact(nm);
        eprintln!("{nm} nm: {mean:.5} ± {error:.5} for {expected:.5}");
        // Of 8 figures whose errors have 11 degrees of freedom 1.2 % are beyond 4.
        assert!(
            (mean - expected).abs() < 4.0 * error,
            "{nm}: {mean} ± {error} for {expected}"
        );
        assert!(error < 0.02 * expected, "{nm}: {mean} ± {error}");
    }
}

#[test]
fn a_number_of_threads_changes_no_bit_of_a_leaf_of_layers() {
    let text = sphere("sun-green", 550.0);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let budget = rays(1024);
        let pool = pool.expect("there are threads");
        pool.install(|| figures(&text, &budget))
            .expect("it can be measured")
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(3));
}

/// A sheet that fills the picture, between two skies of radiance 1.
fn furnace(leaf: &str) -> String {
    format!(
        "format = 1\n\
         [film.spectral]\nsize = [8, 8]\nspp = 16\nbands_nm = [550, 800]\nband_width_nm = 0\n\
         [camera.perspective]\nposition_m = [0.3, -0.2, 1]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 4\n\
         [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n\
         [meshes.sheet.rectangle]\nwidth_m = 1\nheight_m = 1\n\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"white\"\n{leaf}"
    )
}

#[test]
fn a_leaf_of_layers_that_absorbs_nothing_is_lost_in_a_furnace() {
    for alpha in [0.02, 0.3, 0.9] {
        let leaf = format!(
            "[materials.white.leaf]\noptics = \"layers\"\n\
             adaxial = {{ alpha = {alpha} }}\nabaxial = {{ alpha = {alpha} }}\n\
             [materials.white.leaf.contents]\nstructure = 1.6\nchlorophyll_ug_per_cm2 = 0\n\
             carotenoids_ug_per_cm2 = 0\nwater_cm = 1e-6\ndry_matter_g_per_cm2 = 1e-7\n"
        );
        let rendered = picture_of(&furnace(&leaf), 3);
        let means = [0, 1].map(|channel| mean_of(&rendered, channel));
        // A way counts for each wavelength by how likely it would go it, and for all together as one.
        let mean = 0.5 * (means[0] + means[1]);
        assert!((mean - 1.0).abs() < 2e-3, "{alpha}: {mean}");
        for (channel, mean) in means.into_iter().enumerate() {
            let variances = rendered.film.variance(Series::Channel(channel));
            let error = variances.iter().sum::<f64>().sqrt() / variances.len() as f64;
            eprintln!("{alpha}, channel {channel}: {mean:.4} ± {error:.4}");
            assert!(
                (mean - 1.0).abs() < 4.0 * error && error < 0.02,
                "{alpha}: {mean} ± {error}"
            );
        }
        let alone = furnace(&leaf).replace("[550, 800]", "[800]");
        let mean = mean_of(&picture_of(&alone, 3), 0);
        assert!((mean - 1.0).abs() < 2e-3, "{alpha}, alone: {mean}");
    }
}
