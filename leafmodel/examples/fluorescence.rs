//! Emission spectra of leaves from pale to green: a table of published ratios, and a drawing of both
//! faces' spectra if a file is named.
//!
//! ```text
//! cargo run --release -p leafmodel --example fluorescence -- fluorescence.svg
//! ```

#![allow(clippy::print_stdout, reason = "an example prints what it finds")]

use std::error::Error;
use std::fmt::Write as _;

use leafmodel::optics::fluorescence::{
    EMITTED_NM, EmissionSpectrum, Leaf, energy_over_photons, matrices,
};
use leafmodel::optics::{Contents, Pigments};

const CHLOROPHYLL: [f64; 5] = [5.0, 10.0, 20.0, 40.0, 60.0];
const EXCITATIONS_NM: [f64; 3] = [440.0, 550.0, 630.0];
/// Both maxima, nm, and the wavelengths between them whose mean is the shoulder.
const RATIOS_NM: [f64; 8] = [690.0, 735.0, 700.0, 702.0, 704.0, 706.0, 708.0, 710.0];
const COLOURS: [&str; 5] = ["#c8c400", "#8fb80e", "#4f9a22", "#1f7434", "#0b4a2f"];

/// Energy for each unit of energy at 440 nm and each nanometre, of both faces.
type Spectra = [Vec<f64>; 2];

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| chlorophyll, µg/cm² | excitation, nm | F690/F735 lit | other face | F735/F700–710 lit | leaves, of emitted |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    let nm: Vec<f64> = (0..=105)
        .map(|i| EMITTED_NM[0] + 2.0 * f64::from(i))
        .collect();
    let mut drawn: Vec<Spectra> = Vec::new();
    for chlorophyll in CHLOROPHYLL {
        let carotenoids = 1.13 + 0.222 * chlorophyll;
        let leaf = Leaf {
            contents: Contents::new(1.5, chlorophyll, carotenoids, 0.0, 0.0, 0.01, 0.005)?,
            pigments: Pigments::default(),
            quantum_efficiency: 0.01,
            emission: EmissionSpectrum::default(),
        };
        let ratios = matrices(&leaf, &EXCITATIONS_NM, &RATIOS_NM);
        let whole = matrices(&leaf, &EXCITATIONS_NM, &nm);
        for (e, excitation) in EXCITATIONS_NM.into_iter().enumerate() {
            let of = |matrix: &[Vec<f64>], i: usize| {
                matrix[e][i] * energy_over_photons(excitation, RATIOS_NM[i])
            };
            let shoulder = (2..RATIOS_NM.len()).map(|i| of(&ratios.backward, i));
            let shoulder = shoulder.sum::<f64>() / (RATIOS_NM.len() - 2) as f64;
            let at = leafmodel::optics::ProspectD::coefficients(excitation)?;
            let optics = at.reflectance_transmittance(&leaf.contents);
            let absorbed = 1.0 - optics.reflectance - optics.transmittance;
            let share = leafmodel::optics::fluorescence::chlorophyll_share(&at, &leaf.contents);
            let left: f64 = whole.backward[e]
                .iter()
                .chain(&whole.forward[e])
                .sum::<f64>()
                * 2.0;
            println!(
                "| {chlorophyll} | {excitation} | {:.3} | {:.3} | {:.3} | {:.3} |",
                of(&ratios.backward, 0) / of(&ratios.backward, 1),
                of(&ratios.forward, 0) / of(&ratios.forward, 1),
                of(&ratios.backward, 1) / shoulder,
                left / (absorbed * share * leaf.quantum_efficiency),
            );
        }
        let energy = |row: &[f64]| -> Vec<f64> {
            let pairs = row.iter().zip(&nm);
            pairs
                .map(|(photons, nm)| photons * energy_over_photons(440.0, *nm))
                .collect()
        };
        drawn.push([energy(&whole.backward[0]), energy(&whole.forward[0])]);
    }
    if let Some(path) = std::env::args().nth(1) {
        std::fs::write(path, drawing(&nm, &drawn)?)?;
    }
    Ok(())
}

/// Two panels side by side, of the lit and of the other face.
fn drawing(nm: &[f64], drawn: &[Spectra]) -> Result<String, std::fmt::Error> {
    let (width, height) = (330.0, 250.0);
    let most = drawn
        .iter()
        .flatten()
        .flatten()
        .fold(0.0, |most, v| v.max(most));
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" height=\"330\" viewBox=\"0 0 800 330\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"800\" height=\"330\" fill=\"white\"/>\n",
    );
    for (panel, title) in ["lit face", "other face"].into_iter().enumerate() {
        let left = 50.0 + 375.0 * panel as f64;
        let x = |nm: f64| left + width * (nm - EMITTED_NM[0]) / (EMITTED_NM[1] - EMITTED_NM[0]);
        let y = |value: f64| 280.0 - height * value / (1.05 * most);
        writeln!(
            svg,
            "<path d=\"M{left},30 V280 H{}\" fill=\"none\" stroke=\"black\"/>",
            left + width
        )?;
        writeln!(
            svg,
            "<text x=\"{}\" y=\"24\" text-anchor=\"middle\">{title}</text>",
            left + 0.5 * width
        )?;
        for tick in [650, 685, 740, 800, 850] {
            let at = x(f64::from(tick));
            writeln!(
                svg,
                "<path d=\"M{at:.1},280 v5\" stroke=\"black\"/><text x=\"{at:.1}\" y=\"298\" text-anchor=\"middle\">{tick}</text>"
            )?;
        }
        writeln!(
            svg,
            "<text x=\"{}\" y=\"318\" text-anchor=\"middle\">wavelength, nm</text>",
            left + 0.5 * width
        )?;
        for (i, spectra) in drawn.iter().enumerate() {
            let colour = COLOURS[i];
            svg.push_str("<polyline fill=\"none\" stroke-width=\"1.6\" points=\"");
            for (nm, value) in nm.iter().zip(&spectra[panel]) {
                write!(svg, "{:.1},{:.1} ", x(*nm), y(*value))?;
            }
            writeln!(svg, "\" stroke=\"{colour}\"/>")?;
            let down = 50.0 + 16.0 * i as f64;
            let name = CHLOROPHYLL[i];
            writeln!(
                svg,
                "<text x=\"{}\" y=\"{down}\" text-anchor=\"end\" fill=\"{colour}\">{name} µg/cm²</text>",
                left + width
            )?;
        }
    }
    let top = 1.05 * most * 1e5;
    writeln!(
        svg,
        "<text x=\"14\" y=\"155\" text-anchor=\"middle\" transform=\"rotate(-90 14 155)\">energy over energy at 440 nm, 0 to {top:.1} · 10⁻⁵ nm⁻¹</text>"
    )?;
    svg.push_str("</svg>\n");
    Ok(svg)
}
