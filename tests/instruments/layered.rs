//! A leaf through whose layers light is followed, by the renderer's own rays, against the ordinates of
//! leafmodel.

use std::path::Path;

use leafmodel::optics::layers::{Face, Incidence, LayeredLeaf, Ordinates, Resolution};
use leafmodel::optics::{ProspectD, presets};
use renderer::instruments::{Budget, Direction, Row, read_out, sets_of};
use renderer::scene::description::Material;
use renderer::scene::load::parse_for_instruments;
use renderer::scene::world::{BuildOptions, World};
use support::picture::{mean_of, picture_of};

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

/// The figures of a scene whose leaf has smooth faces, which no scene can ask for.
fn smooth(text: &str, budget: &Budget) -> Vec<Row> {
    let text = format!("{HEAD}{text}");
    let loaded = parse_for_instruments(&text, "bench.toml", Path::new("."), &[]);
    let mut scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let Material::Leaf { faces, .. } = &mut scene.materials[0].value else {
        panic!("the material is a leaf");
    };
    for coat in &mut faces.coats {
        (coat.alpha_across, coat.alpha_along) = (0.0, 0.0);
    }
    let (sampler, first) = sets_of(&scene).expect("there are instruments");
    let options = BuildOptions {
        wavelengths: Some(&sampler),
        ..BuildOptions::default()
    };
    let world = World::build_with(&scene, &options).expect("it can be built");
    read_out(&world, &scene, 0, first[0], budget).expect("it can be measured")
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
        let rows = smooth(&sphere(preset, nm), &rays(16384));
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
                    assert!(row.error < 3e-3, "{row:?}");
                    let z = (row.value - expected) / row.error;
                    greatest = greatest.max(z.abs());
                    assert!(z.abs() < 3.5, "{preset} {nm}: {row:?} for {expected}");
                }
            }
        }
    }
    eprintln!("greatest |z| {greatest:.2}");
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
        for channel in 0..2 {
            let mean = mean_of(&rendered, channel);
            assert!((mean - 1.0).abs() < 2e-3, "{alpha}: {mean}");
        }
    }
}
