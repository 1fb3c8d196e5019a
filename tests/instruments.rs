//! Instruments against closed forms, PROSPECT and figures computed independently.

mod anchors;
mod arrangement;
mod brf;
mod canopy;
mod closed;
mod draws;
mod far;
mod fluorescence;
mod gonio;
mod layered;
mod slabs;
mod spectral;
mod sphere;
mod veined;

use std::path::Path;

use renderer::instruments::{Budget, Direction, InstrumentError, Row, read_out, sets_of};
use renderer::scene::description::Description;
use renderer::scene::load::parse_for_instruments;
use renderer::scene::world::{BuildOptions, World};

/// What every scene has and no instrument looks at.
const HEAD: &str = "format = 1\n\
    film.spectral = { size = [8, 8], spp = 1, bands_nm = [550] }\n\
    camera.orthographic = { position_m = [0, 0, 1], look_at_m = [0, 0, 0], up = [0, 1, 0], height_m = 1 }\n";

/// A scene from its text without the head, and what is built of it.
fn built(text: &str) -> (Description, World, Vec<usize>) {
    let text = format!("{HEAD}{text}");
    let loaded = parse_for_instruments(&text, "bench.toml", Path::new("."), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let (sampler, first) = sets_of(&scene).expect("there are instruments");
    let options = BuildOptions {
        wavelengths: Some(&sampler),
        ..BuildOptions::default()
    };
    let world = World::build_with(&scene, &options).expect("it can be built");
    (scene, world, first)
}

/// Whether figures are asked for at their full precision, with `LAMINA_ANCHORS=all`; `cargo full` alone
/// follows less light.
fn in_full() -> bool {
    std::env::var("LAMINA_ANCHORS").is_ok_and(|asked| asked == "all")
}

/// The figures of all instruments of a scene.
fn figures(text: &str, budget: &Budget) -> Result<Vec<Row>, InstrumentError> {
    figures_of(&built(text), budget)
}

/// The same of a scene that is built.
fn figures_of(
    (scene, world, first): &(Description, World, Vec<usize>),
    budget: &Budget,
) -> Result<Vec<Row>, InstrumentError> {
    let numbers = 0..scene.instruments.len();
    let rows = numbers.map(|number| {
        read_out(world, scene, number, first[number], budget).map(|found| found.rows)
    });
    rows.collect::<Result<Vec<_>, _>>()
        .map(|rows| rows.concat())
}

/// A number of rays.
fn rays(rays: u64) -> Budget {
    Budget {
        rays,
        error: None,
        seed: 1,
    }
}

/// The figures with a word, of a light and a wavelength.
fn of<'r>(
    rows: &'r [Row],
    quantity: &'r str,
    incidence: Direction,
    nm: f64,
) -> impl Iterator<Item = &'r Row> {
    rows.iter().filter(move |row| {
        row.quantity == quantity && row.incidence == incidence && row.wavelength_nm == Some(nm)
    })
}

/// Light along the normal.
const NORMAL: Direction = Direction::Beam(0.0);

#[test]
fn a_number_of_threads_changes_no_bit() {
    let text = format!(
        "{}\n[instruments.field.canopy]\nwithin_m = [0, 0, 1, 1]\nwavelengths_nm = [550, 800]\n\
         diffuse = true\nsoil = \"ground\"\ninstances = true\n\
         detector = {{ step_deg = 25, half_angle_deg = 2 }}\n",
        canopy::discs(0.05, 2.0, [0.0, 1.0])
    );
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let budget = Budget {
            error: Some(renderer::instruments::Target::Absolute(5e-3)),
            ..rays(1 << 16)
        };
        let found = pool
            .expect("there are threads")
            .install(|| figures(&text, &budget));
        found.expect("it can be measured")
    };
    let one = run(1);
    assert_eq!(one, run(3));
    assert!(one.iter().all(|row| row.error <= 5e-3));
}
