//! What the optics of a leaf cost: `cargo bench -p lamina-benches --bench optics`.
//!
//! One thread, one leaf after the other of a list whose contents all differ, so time ÷ elements is
//! the time of a leaf: R and T by the exact model at one wavelength, and at the wavelengths of a
//! path, 8 of a colour picture and 32 of as many bands, at each level of instructions that runs here.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use leafmodel::optics::pigments::Pigments;
use leafmodel::optics::{Constituent, Contents, ProspectD, Texel};
use renderer::material::palette::{Palette, Palettes};
use renderer::simd::Level;
use renderer::spectrum::observer::Observer;
use renderer::spectrum::recorded::{Band, FilmKind};
use renderer::spectrum::{WavelengthSampler, Wavelengths};

const LEAVES: usize = 256;

fn optics(criterion: &mut Criterion) {
    let leaves: Vec<Contents> = (0..LEAVES).map(leaf).collect();
    let texels: Vec<Texel> = leaves.iter().map(|leaf| leaf.to_texel()).collect();
    let mut group = criterion.benchmark_group("R and T of a leaf");
    group.throughput(Throughput::Elements(LEAVES as u64));
    group.bench_function("exact, one wavelength", |bencher| {
        let at = ProspectD::coefficients(550.0).expect("in range");
        bencher.iter(|| {
            for leaf in &leaves {
                black_box(at.reflectance_transmittance(black_box(leaf)));
            }
        });
    });
    let colour = FilmKind::Rgb {
        range_nm: [400.0, 780.0],
        observer: Observer::Cie1931,
    };
    let bands = (0..32).map(|number| Band {
        center_nm: 400.0 + 10.0 * f64::from(number),
        width_nm: 10.0,
    });
    let bands = FilmKind::Spectral {
        bands: bands.collect(),
    };
    let (eight, palette_of_eight) = drawn::<8>(&colour);
    let (many, palette_of_many) = drawn::<32>(&bands);
    for level in Level::all() {
        let palette = palette_of_eight.clone().at_level(level);
        group.bench_function(BenchmarkId::new("8 wavelengths", level.name()), |bencher| {
            bencher.iter(|| each(&palette, &eight, &texels));
        });
        let palette = palette_of_many.clone().at_level(level);
        group.bench_function(BenchmarkId::new("32 bands", level.name()), |bencher| {
            bencher.iter(|| each(&palette, &many, &texels));
        });
    }
    group.finish();
}

/// Wavelengths of a path of this film, and the palette that knows them.
fn drawn<const N: usize>(film: &FilmKind) -> (Wavelengths<N>, Palette) {
    let sampler = WavelengthSampler::new(film);
    let palette = Palettes::on(sampler.grid()).of(&Pigments::default());
    (sampler.draw(0.3, 0), palette)
}

fn each<const N: usize>(palette: &Palette, wavelengths: &Wavelengths<N>, leaves: &[Texel]) {
    for leaf in leaves {
        black_box(palette.reflectance_transmittance(wavelengths, black_box(leaf)));
    }
}

/// Leaves from young to thick and dark.
fn leaf(number: usize) -> Contents {
    let share = number as f64 / LEAVES as f64;
    Contents::of(&[
        (Constituent::Structure, 1.2 + share),
        (Constituent::Chlorophyll, 5.0 + 70.0 * share),
        (Constituent::Carotenoids, 2.0 + 12.0 * share),
        (Constituent::Anthocyanins, 3.0 * (1.0 - share)),
        (Constituent::Water, 0.006 + 0.01 * share),
        (Constituent::DryMatter, 0.003 + 0.004 * share),
    ])
}

criterion_group!(benches, optics);
criterion_main!(benches);
