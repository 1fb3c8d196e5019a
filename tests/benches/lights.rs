//! Error and time of scenes with one, sixteen and a thousand lamps.
//!
//! `cargo bench -p lamina-benches --bench lights [-- NAME…]` renders each scene with several seeds on one
//! thread and prints the error of a picture (variance over seeds ÷ mean², the worst hundredth of
//! the pixels left out), the rays of a path, the processor's time that a picture took, and the
//! efficiency 1 ÷ (error × seconds), of which more is better.

use std::io::Write;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use renderer::integrator::render::{Job, render};
use renderer::scene::load::parse;
use renderer::scene::world::World;

/// Pixels along each side.
const SIDE: u32 = 96;
/// Samples a pixel.
const SPP: u32 = 16;
/// Pictures from which the variance is estimated.
const SEEDS: u64 = 12;

fn main() {
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with('-'))
        .collect();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{:<28} {:>10} {:>10} {:>10} {:>12}",
        "scene", "relMSE", "rays/path", "seconds", "efficiency"
    )
    .expect("the terminal takes a line");
    for (name, text) in scenes() {
        if wanted.is_empty() || wanted.iter().any(|part| name.contains(part.as_str())) {
            let Measured {
                error,
                rays,
                seconds,
            } = measure(&text);
            let efficiency = 1.0 / (error * seconds);
            writeln!(
                out,
                "{name:<28} {error:>10.5} {rays:>10.3} {seconds:>10.3} {efficiency:>12.1}"
            )
            .expect("the terminal takes a line");
        }
    }
}

/// Leaves over a floor, under lamps of which there are few or many, small or large.
fn scenes() -> Vec<(&'static str, String)> {
    vec![
        (
            "one square lamp, near",
            hall(&square(1.2, [0.3, -0.2, 1.3])),
        ),
        ("one square lamp, far", hall(&square(1.0, [1.0, -2.0, 6.0]))),
        ("one ball of 960 triangles", hall(&ball(32))),
        ("one ball of 16,128 triangles", hall(&ball(128))),
        (
            "square lamp and sky",
            hall(&(square(0.6, [0.3, -0.2, 1.3]) + SKY)),
        ),
        ("16 lamps", hall(&grid(4, 0.4))),
        ("1,000 lamps", hall(&grid(32, 0.05))),
    ]
}

/// A floor with forty leaves standing about, a band in each of the visible and the near infrared.
fn hall(lamps: &str) -> String {
    let mut text = format!(
        "format = 1\n[film.spectral]\nsize = [{SIDE}, {SIDE}]\nspp = {SPP}\nbands_nm = [450, 550, 650, 850]\n\
         band_width_nm = 0\n[camera.perspective]\nposition_m = [0, -5, 2.2]\nlook_at_m = [0, 0, 0.4]\n\
         vertical_fov_deg = 42\n\
         [materials.floor.diffuse]\nreflectance = 0.3\n[materials.black.diffuse]\nreflectance = 0\n\
         [materials.leaf.leaf]\nabaxial_ratio = 1\nadaxial = {{ eta = 1.45, alpha = 0.3 }}\n\
         abaxial = {{ eta = 1.45, alpha = 0.5 }}\n[materials.leaf.leaf.measured]\n\
         reflectance = {{ table = [[450, 0.05], [550, 0.14], [650, 0.06], [850, 0.48]] }}\n\
         transmittance = {{ table = [[450, 0.01], [550, 0.12], [650, 0.04], [850, 0.46]] }}\n\
         [meshes.floor.rectangle]\nwidth_m = 40\nheight_m = 40\n[meshes.blade.rectangle]\nwidth_m = 0.4\nheight_m = 0.7\n\
         [objects.floor]\nmesh = \"floor\"\nmaterial = \"floor\"\n"
    );
    for i in 0..40 {
        let (x, y, z) = (spread(i, 0) - 0.5, spread(i, 1) - 0.5, spread(i, 2));
        let (tilt, turn) = (360.0 * spread(i, 3), 360.0 * spread(i, 4));
        text += &format!(
            "[objects.leaf-{i}]\nmesh = \"blade\"\nmaterial = \"leaf\"\nposition_m = [{}, {}, {}]\n\
             rotate_deg = [{tilt}, 0, {turn}]\n",
            3.6 * x,
            3.0 * y,
            0.35 + 0.6 * z
        );
    }
    text + lamps
}

/// The place of point `i` along axis number `axis`: a Kronecker sequence on the roots of primes.
fn spread(i: usize, axis: usize) -> f64 {
    let roots = [2.0_f64, 3.0, 5.0, 7.0, 11.0].map(f64::sqrt);
    ((i + 1) as f64 * roots[axis]).fract()
}

/// A square lamp that shines down.
fn square(side: f64, position: [f64; 3]) -> String {
    let radiance = 10.0 / (side * side);
    format!(
        "[meshes.square.rectangle]\nwidth_m = {side}\nheight_m = {side}\n[objects.square]\nmesh = \"square\"\n\
         material = \"black\"\nposition_m = {position:?}\nrotate_deg = [180, 0, 0]\n[lights.square.area]\n\
         object = \"square\"\nradiance_w_m2_sr_nm = {radiance}\n"
    )
}

/// A shining ball of triangles.
fn ball(segments: u32) -> String {
    format!(
        "[meshes.ball.sphere]\nradius_m = 0.3\nsegments = {segments}\n[objects.ball]\nmesh = \"ball\"\n\
         material = \"black\"\nposition_m = [0.3, -0.2, 1.5]\n[lights.ball.area]\nobject = \"ball\"\n\
         radiance_w_m2_sr_nm = 10\n"
    )
}

/// `side`² lamps (of 1,024 the first 1,000) over the floor, turned all ways and of power from 1 to
/// 10.
fn grid(side: usize, width: f64) -> String {
    let mut text = format!("[meshes.lamp.rectangle]\nwidth_m = {width}\nheight_m = {width}\n");
    for i in 0..(side * side).min(1000) {
        let [x, y] = [i % side, i / side].map(|k| (k as f64 + 0.5) / side as f64 - 0.5);
        let (z, tilt) = (
            1.3 + 0.8 * spread(i, 2),
            180.0 + 120.0 * (spread(i, 3) - 0.5),
        );
        let radiance = 20.0 / (width * width * (side * side) as f64) * 10_f64.powf(spread(i, 0));
        text += &format!(
            "[objects.lamp-{i}]\nmesh = \"lamp\"\nmaterial = \"black\"\nposition_m = [{}, {}, {z}]\n\
             rotate_deg = [{tilt}, 0, {}]\n[lights.lamp-{i}.area]\nobject = \"lamp-{i}\"\n\
             radiance_w_m2_sr_nm = {radiance}\n",
            12.0 * x,
            12.0 * y,
            360.0 * spread(i, 4)
        );
    }
    text
}

/// A sky with a bright side, of the scene's own folder.
const SKY: &str = "[lights.sky.environment]\npath = \"evening.png\"\nscale = 0.3\n";

/// What a picture costs and is worth.
struct Measured {
    /// Mean relative variance of a pixel.
    error: f64,
    /// Rays a path.
    rays: f64,
    /// Processor's time, s.
    seconds: f64,
}

fn measure(text: &str) -> Measured {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/first-leaf");
    let loaded = parse(text, "bench.toml", &folder, &[]).expect("the bench writes its scenes well");
    let world = World::build(&loaded.description).expect("the bench writes its scenes well");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("one thread can be had");
    let pixels = (SIDE * SIDE) as usize;
    let (mut sums, mut squares) = (vec![0.0; pixels], vec![0.0; pixels]);
    let (mut seconds, mut rays) = (0.0, 0);
    for seed in 0..SEEDS {
        let job = Job {
            width: SIDE,
            height: SIDE,
            spp: SPP,
            seed,
        };
        let (rendered, time) = pool.install(|| {
            let start = processor_seconds();
            let wall = Instant::now();
            let rendered = render(&world, &job, &AtomicBool::new(false), &|_| ());
            let time = match (start, processor_seconds()) {
                (Some(start), Some(end)) => end - start,
                _ => wall.elapsed().as_secs_f64(),
            };
            (rendered.expect("a small film fits"), time)
        });
        seconds += time / SEEDS as f64;
        rays += rendered.rays;
        let sums = sums.iter_mut().zip(&mut squares);
        let values =
            (rendered.film).map(|pixel| (0..4).map(|band| pixel.mean(band)).sum::<f64>() / 4.0);
        for ((sum, square), value) in sums.zip(values) {
            *sum += value;
            *square += value * value;
        }
    }
    let count = SEEDS as f64;
    let mut errors: Vec<f64> = sums
        .iter()
        .zip(&squares)
        .filter(|(sum, _)| **sum > 0.0)
        .map(|(sum, square)| {
            let mean = sum / count;
            (square / count - mean * mean) * count / (count - 1.0) / (mean * mean)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors.truncate(errors.len() * 99 / 100);
    Measured {
        error: errors.iter().sum::<f64>() / errors.len() as f64,
        rays: rays as f64 / (SEEDS * u64::from(SIDE * SIDE * SPP)) as f64,
        seconds,
    }
}

/// Time that the processor spent on this thread, s, where the system tells.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}
