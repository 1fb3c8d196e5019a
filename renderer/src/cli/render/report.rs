//! What a render reports about itself: times, samples, speed.

use serde_json::{Value, json};

use crate::cli::needs;
use crate::integrator::render::{Ended, Rendered};

/// Times of a render, seconds.
pub(super) struct Times {
    pub(super) all: f64,
    pub(super) build: f64,
    pub(super) trace: f64,
    /// Paths and rays of earlier runs, from which this one went on.
    pub(super) before: [u64; 2],
}

impl Times {
    pub(super) fn millions_per_second(&self, count: u64) -> f64 {
        count as f64 * 1e-6 / self.trace
    }
}

/// The times and sums in the output of `--stats`.
pub(super) fn stats(rendered: &Rendered, times: &Times) -> Value {
    let film = &rendered.film;
    let [paths_before, rays_before] = times.before;
    let pixels = f64::from(film.width()) * f64::from(film.height());
    json!({
        "seconds": times.all,
        "build_seconds": times.build,
        "trace_seconds": times.trace,
        "peak_mib": needs::peak_mib(),
        "threads": rayon::current_num_threads(),
        "spp": film.drawn() as f64 / pixels,
        "spp_range": film.drawn_range(),
        "noise": rendered.noise.and_then(|noise| noise.reached),
        "ended": ended(rendered.ended),
        "rays": rendered.rays,
        "roulette_below": rendered.effort.roulette_below,
        "branches": rendered.effort.branches,
        "lit_branches": rendered.effort.lit_branches,
        "light_samples": rendered.effort.light_samples,
        "sample_skies": rendered.effort.sample_skies,
        "paths": film.drawn(),
        "mrays_per_s": times.millions_per_second(rendered.rays - rays_before),
        "mpaths_per_s": times.millions_per_second(film.drawn() - paths_before),
        "rejected_samples": film.rejected(),
        "clamped_values": film.clamped(),
        "unknown_variances": film.overflowed(),
        "cut_paths": film.cut(),
        // No number of JSON is infinite.
        "missing_at_most": Some(film.missing()).filter(|missing| missing.is_finite()),
        "interrupted": rendered.ended == Ended::Interrupted,
        "resumed_paths": paths_before,
    })
}

/// Prints times and speed.
pub(super) fn report_speed(rendered: &Rendered, times: &Times) {
    let [paths_before, rays_before] = times.before;
    let paths = rendered.film.drawn() - paths_before;
    eprintln!(
        "{:.1} s in all: {:.1} s to build, {:.1} s for {:.2} million paths ({:.2} Mpaths/s, {:.2} Mrays/s)",
        times.all,
        times.build,
        times.trace,
        paths as f64 * 1e-6,
        times.millions_per_second(paths),
        times.millions_per_second(rendered.rays - rays_before)
    );
}

/// Prints the number of samples per pixel if it was not given.
pub(super) fn report_samples(rendered: &Rendered) {
    let [fewest, most] = rendered.film.drawn_range();
    let pixels = f64::from(rendered.film.width()) * f64::from(rendered.film.height());
    let mean = rendered.film.drawn() as f64 / pixels;
    if let Some(noise) = rendered.noise {
        let reached = noise.reached.map_or_else(
            || "noise not known from so few".to_owned(),
            |reached| format!("noise {reached:.4}, aimed at {}", noise.aim),
        );
        eprintln!("{fewest} to {most} samples a pixel, {mean:.1} on average; {reached}");
    } else if rendered.map.is_some() {
        let is_over = rendered.ended == Ended::Time;
        let over = if is_over {
            ", then the time was over"
        } else {
            ""
        };
        eprintln!("{fewest} to {most} samples a pixel by the map, {mean:.1} on average{over}");
    } else if rendered.ended == Ended::Time {
        eprintln!("{most} samples a pixel, then the time was over");
    }
}

/// The reason why a render ended, in one word.
fn ended(ended: Ended) -> &'static str {
    match ended {
        Ended::Samples => "samples",
        Ended::Noise => "noise",
        Ended::Time => "time",
        Ended::Interrupted => "interrupt",
    }
}
