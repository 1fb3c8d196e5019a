//! The leaf BSDF of scenes fitted to the leaf of layers, and how far it is off by angle:
//! `cargo run --release -p lamina-renderer --example leaf_bsdf_fit -- [PRESET …]`.
//!
//! For each preset, three BSDFs stand beside the BRDF and BTDF of the layers:
//!
//! - `plates`: what a scene uses by default, the usual coats over R and T of PROSPECT-D;
//! - `shape`: the same coats over the layers' own R and T along the normal, so that only the angular
//!   shape differs;
//! - `fit`: index and roughness of the coat, one for both faces and all wavelengths, and the tissue's
//!   three numbers at each wavelength, by least squares.
//!
//! The layers' surface is smooth, so their gloss is a mirror's. BRDFs are compared without it and
//! without the coat's lobe; the share that is mirrored is compared with the coat's albedo.
//! The first tables are Markdown, as the book has them; `--csv` prints every figure instead.

use std::error::Error;
use std::f64::consts::PI;
use std::io::Write as _;

use glam::Vec3;
use leafmodel::optics::layers::{Bidirectional, Face, LayeredLeaf, Resolution};
use leafmodel::optics::{ProspectD, presets};
use renderer::bsdf::leaf::{Coat, LeafBsdf, Tissue, usual_abaxial_ratio};
use renderer::spectrum::Lanes;

/// A green, a pale, a red and a dead leaf.
const PRESETS: [&str; 4] = [
    "sun-green",
    "chlorotic",
    "red-maple-scarlet",
    "brown-litter",
];
const WAVELENGTHS_NM: [f64; 4] = [450.0, 550.0, 680.0, 800.0];
const INCIDENCES_DEG: [f64; 5] = [0.0, 20.0, 40.0, 60.0, 80.0];
const VIEWS_DEG: [f64; 9] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
/// What the tables of the book show of them.
const SHOWN_INCIDENCES: [usize; 3] = [0, 3, 4];
const SHOWN_VIEWS: [usize; 5] = [0, 3, 5, 7, 8];
const AZIMUTHS: usize = 12;
const RESOLUTION: usize = 14;
/// The usual coats of scenes: index, roughness of the adaxial and the abaxial face.
const USUAL: (f32, [f32; 2]) = (1.45, [0.3, 0.45]);

/// Which sides of a leaf light comes from and goes to.
#[derive(Clone, Copy, PartialEq)]
enum Pair {
    /// Back from the adaxial face.
    Adaxial,
    /// Back from the abaxial face.
    Abaxial,
    /// Through, lit on the adaxial face; lit on the other it is the same by reciprocity.
    Through,
}

const PAIRS: [(Pair, &str); 3] = [
    (Pair::Adaxial, "R adaxial"),
    (Pair::Abaxial, "R abaxial"),
    (Pair::Through, "T"),
];

impl Pair {
    /// The face that is lit.
    fn lit(self) -> (usize, Face) {
        match self {
            Self::Adaxial | Self::Through => (0, Face::First),
            Self::Abaxial => (1, Face::Last),
        }
    }
}

/// A table over incidences and views.
type Grid = [[f64; VIEWS_DEG.len()]; INCIDENCES_DEG.len()];

fn grid(of: impl Fn(usize, usize) -> f64) -> Grid {
    std::array::from_fn(|i| std::array::from_fn(|v| of(i, v)))
}

/// What the layers do at one wavelength: π times BRDF or BTDF, mean over azimuth.
struct Layers {
    factors: [Grid; 3],
    /// Root mean square over azimuths of the difference from their mean, over the mean.
    by_azimuth: [f64; 3],
    /// Share mirrored at each incidence, adaxial face.
    mirrored: [f64; INCIDENCES_DEG.len()],
    /// R along the normal of both faces and T, all light included.
    normal: [f64; 3],
    /// R and T of PROSPECT-D.
    plates: [f64; 2],
}

fn direction(angle_deg: f64, side: f64) -> Vec3 {
    let (sine, cosine) = libm::sincos(angle_deg.to_radians());
    Vec3::new(0.0, sine as f32, (side * cosine) as f32)
}

/// Projected solid angle of a step of directions around this one, over 2π.
fn weight(angle_deg: f64, step_deg: f64) -> f64 {
    let square = |deg: f64| {
        let sine = libm::sin(deg.clamp(0.0, 90.0).to_radians());
        sine * sine
    };
    0.5 * (square(angle_deg + 0.5 * step_deg) - square(angle_deg - 0.5 * step_deg))
}

fn weights() -> Grid {
    grid(|i, v| weight(INCIDENCES_DEG[i], 20.0) * weight(VIEWS_DEG[v], 10.0))
}

/// Weighted mean.
fn mean(weights: &Grid, of: impl Fn(usize, usize) -> f64) -> f64 {
    let (mut sum, mut all) = (0.0, 0.0);
    for (i, row) in weights.iter().enumerate() {
        for (v, weight) in row.iter().enumerate() {
            sum += weight * of(i, v);
            all += weight;
        }
    }
    sum / all
}

impl Layers {
    fn at(leaf: &LayeredLeaf, plates: [f64; 2], nm: f64) -> Result<Self, Box<dyn Error>> {
        let at = ProspectD::coefficients(nm)?;
        let cosine = |deg: f64| libm::cos(deg.to_radians());
        let all = Bidirectional::new(
            &leaf.stack(&at),
            Resolution::new(RESOLUTION),
            &INCIDENCES_DEG.map(cosine),
            &VIEWS_DEG.map(cosine),
        )?;
        let value = |pair: Pair, i, v, azimuth: Option<f64>| {
            let (_, face) = pair.lit();
            let leaving = match azimuth {
                Some(azimuth) => all.at(face, i, v, azimuth),
                None => all.mean(face, i, v),
            };
            match pair {
                Pair::Adaxial | Pair::Abaxial => leaving.reflected,
                Pair::Through => leaving.transmitted,
            }
        };
        let factors = PAIRS.map(|(pair, _)| grid(|i, v| value(pair, i, v, None)));
        let weights = weights();
        let by_azimuth = PAIRS.map(|(pair, _)| {
            let square = mean(&weights, |i, v| {
                let middle = value(pair, i, v, None);
                let off = |step: usize| {
                    let azimuth = 2.0 * PI * (step as f64 + 0.5) / AZIMUTHS as f64;
                    value(pair, i, v, Some(azimuth)) / middle - 1.0
                };
                (0..AZIMUTHS).map(|step| off(step) * off(step)).sum::<f64>() / AZIMUTHS as f64
            });
            square.sqrt()
        });
        let [adaxial, abaxial] = leaf.faces(&at, Resolution::new(RESOLUTION)).normal;
        Ok(Self {
            factors,
            by_azimuth,
            mirrored: std::array::from_fn(|i| all.unscattered(Face::First, i)[0]),
            normal: [adaxial.reflected, abaxial.reflected, adaxial.transmitted],
            plates,
        })
    }
}

/// The diffuse part of a leaf BSDF times π: what it scatters less what its coats alone do.
fn diffuse(coats: &[Coat; 2], tissue: Tissue<1>) -> [Grid; 3] {
    let black = Tissue::opaque(Lanes([0.0]));
    let [leaf, coat] = [tissue, black].map(|tissue| LeafBsdf::new(coats, tissue));
    PAIRS.map(|(pair, _)| {
        let [from, to] = match pair {
            Pair::Adaxial => [1.0, 1.0],
            Pair::Abaxial => [-1.0, -1.0],
            Pair::Through => [1.0, -1.0],
        };
        grid(|i, v| {
            // Away from the mirror's direction, where the coat's lobe would take the digits.
            let (wi, mut wo) = (
                direction(INCIDENCES_DEG[i], from),
                direction(VIEWS_DEG[v], to),
            );
            std::mem::swap(&mut wo.x, &mut wo.y);
            let [all, gloss] = [&leaf, &coat].map(|of| f64::from(of.eval(wo, wi).0[0]));
            PI * (all - gloss)
        })
    })
}

fn usual_coats() -> [Coat; 2] {
    let (eta, alpha) = USUAL;
    alpha.map(|alpha| Coat::new(eta, alpha, alpha))
}

/// The BSDF that a scene makes of R and T along the normal and the ratio of the faces' R.
fn of_normal(coats: &[Coat; 2], [r, t]: [f64; 2], ratio: Option<f64>) -> [Grid; 3] {
    let [r, t] = [r, t].map(|share| Lanes([share as f32]));
    let ratio = ratio.map_or_else(|| usual_abaxial_ratio(r, t), |ratio| Lanes([ratio as f32]));
    diffuse(coats, Tissue::new(coats, r, t, ratio))
}

/// A coat on both faces with the tissue under it that fits best at each wavelength.
struct Fit {
    eta: f32,
    alpha: f32,
    coats: [Coat; 2],
    factors: Vec<[Grid; 3]>,
    /// Mean square of relative deviations, gloss included.
    error: f64,
}

impl Fit {
    fn of(all: &[Layers], eta: f32, alpha: f32) -> Self {
        let coats = [(); 2].map(|()| Coat::new(eta, alpha, alpha));
        let weights = weights();
        // One unit of everything: the shape, of which the tissue chooses the amount.
        let shape = diffuse(&coats, Tissue::from_lanes([Lanes([1.0]); 4]));
        let mut error = 0.0;
        let mut factors = Vec::new();
        for layers in all {
            let fitted: [Grid; 3] = std::array::from_fn(|pair| {
                let (wanted, shape) = (&layers.factors[pair], &shape[pair]);
                // Least squares of relative deviations: the best amount is linear.
                let ratio = |i: usize, v: usize| shape[i][v] / wanted[i][v];
                let amount =
                    mean(&weights, ratio) / mean(&weights, |i, v| ratio(i, v) * ratio(i, v));
                error += mean(&weights, |i, v| {
                    let off = amount * ratio(i, v) - 1.0;
                    off * off
                });
                grid(|i, v| amount * shape[i][v])
            });
            factors.push(fitted);
            let albedo =
                |i: usize| f64::from(coats[0].albedo().at(direction(INCIDENCES_DEG[i], 1.0)));
            let sum: f64 = INCIDENCES_DEG.iter().map(|deg| weight(*deg, 20.0)).sum();
            for (i, mirrored) in layers.mirrored.iter().enumerate() {
                let off = albedo(i) / mirrored - 1.0;
                error += weight(INCIDENCES_DEG[i], 20.0) / sum * off * off;
            }
        }
        Self {
            eta,
            alpha,
            coats,
            factors,
            error,
        }
    }

    /// The best of a net of indices and roughnesses, made finer around the best three times.
    fn best(all: &[Layers]) -> Self {
        let (mut steps, mut best) = ([0.08_f32, 0.12], Self::of(all, 1.45, 0.3));
        for _ in 0..4 {
            let (eta, alpha) = (best.eta, best.alpha);
            for across in -3_i8..=3 {
                for along in -3_i8..=3 {
                    let eta = (eta + f32::from(across) * steps[0]).clamp(1.05, 2.5);
                    let alpha = (alpha + f32::from(along) * steps[1]).clamp(0.02, 1.0);
                    let tried = Self::of(all, eta, alpha);
                    if tried.error < best.error {
                        best = tried;
                    }
                }
            }
            steps = steps.map(|step| step / 3.0);
        }
        best
    }
}

fn rms(found: &Grid, wanted: &Grid) -> f64 {
    let weights = weights();
    mean(&weights, |i, v| {
        let off = found[i][v] / wanted[i][v] - 1.0;
        off * off
    })
    .sqrt()
}

/// Found over wanted less 1, %, and the difference of BRDF or BTDF, sr⁻¹, where it is greatest.
fn greatest(found: &Grid, wanted: &Grid) -> (f64, f64, usize, usize) {
    let mut most = (0.0_f64, 0.0, 0, 0);
    for i in 0..INCIDENCES_DEG.len() {
        for v in 0..VIEWS_DEG.len() {
            let off = found[i][v] / wanted[i][v] - 1.0;
            if off.abs() > most.0.abs() {
                most = (off, (found[i][v] - wanted[i][v]) / PI, i, v);
            }
        }
    }
    most
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let csv = words.iter().any(|word| word == "--csv");
    words.retain(|word| word != "--csv");
    if words.is_empty() {
        words = PRESETS.map(str::to_owned).to_vec();
    }
    let mut out = std::io::stdout().lock();
    if csv {
        writeln!(
            out,
            "preset,nm,pair,incidence_deg,view_deg,layers_per_sr,plates,shape,fit"
        )?;
    }
    for word in &words {
        let preset = presets::by_name(word).ok_or("there is no such preset")?;
        let leaf = LayeredLeaf::new(&preset.contents);
        let all: Vec<Layers> = WAVELENGTHS_NM
            .iter()
            .map(|&nm| {
                let plates =
                    ProspectD::coefficients(nm)?.reflectance_transmittance(&preset.contents);
                Layers::at(&leaf, [plates.reflectance, plates.transmittance], nm)
            })
            .collect::<Result<_, _>>()?;
        let fit = Fit::best(&all);
        let usual = usual_coats();
        let found: Vec<[[Grid; 3]; 3]> = all
            .iter()
            .zip(&fit.factors)
            .map(|(layers, fit)| {
                let [r_a, r_b, t] = layers.normal;
                let plates = of_normal(&usual, layers.plates, None);
                [plates, of_normal(&usual, [r_a, t], Some(r_b / r_a)), *fit]
            })
            .collect();
        if csv {
            for (nm, (layers, found)) in WAVELENGTHS_NM.iter().zip(all.iter().zip(&found)) {
                for (pair, (_, name)) in PAIRS.iter().enumerate() {
                    for (i, incidence) in INCIDENCES_DEG.iter().enumerate() {
                        for (v, view) in VIEWS_DEG.iter().enumerate() {
                            write!(out, "{word},{nm},{name},{incidence},{view}")?;
                            let values = found.iter().map(|of| of[pair][i][v]);
                            for value in std::iter::once(layers.factors[pair][i][v]).chain(values) {
                                write!(out, ",{:.6e}", value / PI)?;
                            }
                            writeln!(out)?;
                        }
                    }
                }
            }
            continue;
        }
        let (eta, alpha) = (fit.eta, fit.alpha);
        writeln!(
            out,
            "\n### `{word}`: fitted index {eta:.3}, roughness {alpha:.3}\n"
        )?;
        summary(&mut out, &all, &found)?;
        angles(&mut out, &all, &found)?;
        gloss(&mut out, &all, &[&usual[0], &usual[1], &fit.coats[0]])?;
    }
    Ok(())
}

/// Deviations over all angles.
fn summary(
    out: &mut impl std::io::Write,
    all: &[Layers],
    found: &[[[Grid; 3]; 3]],
) -> Result<(), Box<dyn Error>> {
    writeln!(
        out,
        "| nm | | rms: plates | shape | fit | by azimuth | greatest of fit, at incidence, view |"
    )?;
    writeln!(out, "| --- | --- | --- | --- | --- | --- | --- |")?;
    for (nm, (layers, found)) in WAVELENGTHS_NM.iter().zip(all.iter().zip(found)) {
        for (pair, (_, name)) in PAIRS.iter().enumerate() {
            let wanted = &layers.factors[pair];
            let [plates, shape, fit] = found.each_ref().map(|of| 100.0 * rms(&of[pair], wanted));
            let (off, absolute, i, v) = greatest(&found[2][pair], wanted);
            writeln!(
                out,
                "| {nm} | {name} | {plates:.1} % | {shape:.1} % | {fit:.1} % | {:.1} % | {:+.0} % ({absolute:+.1e} sr⁻¹), {}°, {}° |",
                100.0 * layers.by_azimuth[pair],
                100.0 * off,
                INCIDENCES_DEG[i],
                VIEWS_DEG[v],
            )?;
        }
    }
    Ok(())
}

/// Deviations by incidence and view at two wavelengths.
fn angles(
    out: &mut impl std::io::Write,
    all: &[Layers],
    found: &[[[Grid; 3]; 3]],
) -> Result<(), Box<dyn Error>> {
    writeln!(
        out,
        "\nThe layers' factor (π sr⁻¹): deviation of `shape` / of `fit`, %\n"
    )?;
    write!(out, "| nm | | incidence |")?;
    for v in SHOWN_VIEWS {
        write!(out, " {}° |", VIEWS_DEG[v])?;
    }
    writeln!(
        out,
        "\n| --- | --- | --- |{}",
        " --- |".repeat(SHOWN_VIEWS.len())
    )?;
    for of in [1, 3] {
        for (pair, (_, name)) in PAIRS.iter().enumerate() {
            for i in SHOWN_INCIDENCES {
                let (nm, incidence) = (WAVELENGTHS_NM[of], INCIDENCES_DEG[i]);
                write!(out, "| {nm} | {name} | {incidence}° |")?;
                for v in SHOWN_VIEWS {
                    let wanted = all[of].factors[pair][i][v];
                    let [shape, fit] =
                        [1, 2].map(|at| 100.0 * (found[of][at][pair][i][v] / wanted - 1.0));
                    write!(out, " {wanted:.3}: {shape:+.0} / {fit:+.0} |")?;
                }
                writeln!(out)?;
            }
        }
    }
    Ok(())
}

/// What is mirrored at 550 nm, beside the albedo of coats.
fn gloss(
    out: &mut impl std::io::Write,
    all: &[Layers],
    coats: &[&Coat; 3],
) -> Result<(), Box<dyn Error>> {
    writeln!(
        out,
        "\n| incidence | mirrored by layers, 550 nm | usual adaxial coat | usual abaxial coat | fitted coat |"
    )?;
    writeln!(out, "| --- | --- | --- | --- | --- |")?;
    for (i, incidence) in INCIDENCES_DEG.iter().enumerate() {
        let [adaxial, abaxial, fit] =
            coats.map(|coat| coat.albedo().at(direction(*incidence, 1.0)));
        let mirrored = all[1].mirrored[i];
        writeln!(
            out,
            "| {incidence}° | {mirrored:.4} | {adaxial:.4} | {abaxial:.4} | {fit:.4} |"
        )?;
    }
    Ok(())
}
