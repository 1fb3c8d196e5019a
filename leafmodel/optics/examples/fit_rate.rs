//! How many leaves a minute are fitted: `cargo run --release -p leaf-optics --example fit_rate [LEAVES]`.
//!
//! Leaves by chance have R and T at each of 2101 wavelengths, with white noise and a ripple as of a
//! model that lacks something, so that the correlation of residuals is fitted too.

#![allow(clippy::print_stdout, reason = "an example prints what it finds")]

use std::error::Error;
use std::time::Instant;

use numerics::random::{bits_of, share};
use optics::inversion::{Inversion, Spectra};
use optics::{Contents, Model, Pigments, ProspectD};
use rayon::prelude::*;

/// Least and greatest contents, in the order of PROSPECT-D's inputs.
const RANGES: [[f64; 2]; 7] = [
    [1.2, 2.5],
    [2.0, 80.0],
    [2.0, 20.0],
    [0.0, 8.0],
    [0.0, 0.3],
    [0.004, 0.03],
    [0.002, 0.015],
];

fn main() -> Result<(), Box<dyn Error>> {
    let count = std::env::args()
        .nth(1)
        .map_or(Ok(400), |text| text.parse())?;
    let nm: Vec<f64> = (400..=2500).map(f64::from).collect();
    let leaves: Vec<[Vec<f64>; 2]> = (0..count).map(|leaf| measured(leaf, &nm)).collect();
    let started = Instant::now();
    let free = Model::ProspectD.inputs();
    let inversion = Inversion::new(&Pigments::default(), &nm, free, Contents::NOTHING)?;
    let fitted = leaves.par_iter().map(|[r, t]| {
        let found = inversion.of(Spectra {
            reflectance: Some(r),
            transmittance: Some(t),
            ..Spectra::default()
        });
        found.rms()
    });
    let rms: f64 = fitted.sum::<f64>() / count as f64;
    let minutes = started.elapsed().as_secs_f64() / 60.0;
    let (rate, threads) = (count as f64 / minutes, rayon::current_num_threads());
    println!("{rate:.0} leaves a minute on {threads} threads, mean rms {rms:.4}");
    Ok(())
}

/// R and T of a leaf by chance at these wavelengths.
fn measured(leaf: u64, nm: &[f64]) -> [Vec<f64>; 2] {
    let drawn = |number: u64| share(bits_of(leaf, number, 0));
    let mut numbers = 0..;
    let inputs = RANGES.map(|[low, high]| {
        let number = numbers.next().expect("they do not end");
        low + drawn(number) * (high - low)
    });
    let contents = Contents::prospect_d(inputs);
    let mut spectra = [Vec::new(), Vec::new()];
    for (place, &nm) in nm.iter().enumerate() {
        let found = ProspectD::coefficients_extrapolated(nm).reflectance_transmittance(&contents);
        let values = [found.reflectance, found.transmittance];
        for (which, (spectrum, value)) in (10..).zip(spectra.iter_mut().zip(values)) {
            let white = 0.008 * (share(bits_of(leaf, which, place as u64)) - 0.5);
            let ripple = 0.006 * (nm / 60.0 + 6.0 * drawn(which + 10)).sin();
            spectrum.push((value + white + ripple).clamp(0.001, 0.98));
        }
    }
    spectra
}
