//! Small pictures of scenes that are written in a test.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use renderer::integrator::render::{Halt, Job, Rendered, render_until};
use renderer::scene::load::parse;
use renderer::scene::world::World;

/// Builds the scene of a text.
///
/// # Panics
///
/// If the scene is refused: it is the test's own.
pub fn world_of(text: &str) -> (renderer::scene::description::Description, World) {
    let loaded = parse(text, "test.toml", Path::new("."), &[]);
    let description = match loaded {
        Ok(loaded) => loaded.description,
        Err(errors) => panic!("{errors}"),
    };
    let world = World::build(&description).expect("the test's own scene can be built");
    (description, world)
}

/// Renders the scene of a text with its own sample count and the given seed.
pub fn picture_of(text: &str, seed: u64) -> Rendered {
    picture_until(text, seed, &Halt::default())
}

/// The same, and what may end it before.
pub fn picture_until(text: &str, seed: u64, halt: &Halt) -> Rendered {
    let (description, world) = world_of(text);
    let job = Job {
        width: description.film.width,
        height: description.film.height,
        spp: description.film.spp,
        seed,
    };
    render_until(&world, &job, halt, &AtomicBool::new(false), &|_| ()).expect("a small film fits")
}

/// Mean of one channel over all pixels.
pub fn mean_of(rendered: &Rendered, channel: usize) -> f64 {
    let means = rendered.film.map(|pixel| pixel.mean(channel));
    means.iter().sum::<f64>() / means.len() as f64
}

/// Mean of one channel over all pixels and seeds, and the standard error of that mean from the
/// scatter over seeds.
///
/// Seeds are independent; samples within a picture are not, being of low discrepancy.
pub fn mean_and_error(text: &str, channel: usize, seeds: u64) -> (f64, f64) {
    let pictures: Vec<_> = (0..seeds).map(|seed| picture_of(text, seed)).collect();
    mean_and_error_in(&pictures, channel)
}

/// The same of the first `N` channels, from one picture per seed.
pub fn means_and_errors<const N: usize>(text: &str, seeds: u64) -> [(f64, f64); N] {
    let pictures: Vec<_> = (0..seeds).map(|seed| picture_of(text, seed)).collect();
    std::array::from_fn(|channel| mean_and_error_in(&pictures, channel))
}

fn mean_and_error_in(pictures: &[Rendered], channel: usize) -> (f64, f64) {
    let means: Vec<f64> = pictures
        .iter()
        .map(|picture| mean_of(picture, channel))
        .collect();
    mean_and_error_of(&means)
}

/// Mean of independent numbers and its standard error.
pub fn mean_and_error_of(means: &[f64]) -> (f64, f64) {
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|m| (m - mean) * (m - mean)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}
