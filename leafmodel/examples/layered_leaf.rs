//! What a leaf of layers does with light, by direction and by depth, as CSV:
//! `cargo run --release -p leafmodel --example layered_leaf -- [PRESET] [angles|depth]`.
//!
//! `angles`: reflectance and transmittance factors (1 for a perfect diffuser) of both faces by the
//! angle at which light leaves, lit along the normal; light that was never scattered is left out.
//! `depth`: the share of light absorbed per µm by distance from the adaxial face, lit on either.
//! Both at 450, 550, 680 and 800 nm; `sun-green` and `angles` if nothing is given.

use std::error::Error;
use std::io::Write as _;

use leafmodel::optics::layers::{Face, Incidence, LayeredLeaf, Ordinates, Resolution};
use leafmodel::optics::{ProspectD, presets};

const WAVELENGTHS_NM: [f64; 4] = [450.0, 550.0, 680.0, 800.0];
const ANGLES_DEG: [f64; 9] = [0.5, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
/// Of each layer.
const SLICES: usize = 10;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let preset = words.next().unwrap_or_else(|| "sun-green".to_owned());
    let preset = presets::by_name(&preset).ok_or("there is no such preset")?;
    let leaf = LayeredLeaf::new(&preset.contents);
    match words.next().as_deref() {
        None | Some("angles") => angles(&leaf),
        Some("depth") => depth(&leaf),
        Some(_) => Err("write angles or depth".into()),
    }
}

fn angles(leaf: &LayeredLeaf) -> Result<(), Box<dyn Error>> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "nm,lit,angle_deg,reflectance_factor,transmittance_factor"
    )?;
    // The normal comes first, for the light that falls in.
    let angles = [0.0].into_iter().chain(ANGLES_DEG);
    let cosines: Vec<f64> = angles
        .map(|angle: f64| libm::cos(angle.to_radians()))
        .collect();
    for nm in WAVELENGTHS_NM {
        let stack = leaf.stack(&ProspectD::coefficients(nm)?);
        let solved = Ordinates::new(&stack, Resolution::new(16), &cosines)?;
        for (lit, face) in [("adaxial", Face::First), ("abaxial", Face::Last)] {
            let leaving = solved.leaving(face, Incidence::NORMAL)?;
            for (angle, leaving) in ANGLES_DEG.iter().zip(&leaving[1..]) {
                let (back, through) = (leaving.reflected, leaving.transmitted);
                writeln!(out, "{nm},{lit},{angle},{back:.5},{through:.5}")?;
            }
        }
    }
    Ok(())
}

fn depth(leaf: &LayeredLeaf) -> Result<(), Box<dyn Error>> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "nm,lit,layer,depth_um,absorbed_per_um")?;
    for nm in WAVELENGTHS_NM {
        let at = ProspectD::coefficients(nm)?;
        for (lit, face) in [("adaxial", Face::First), ("abaxial", Face::Last)] {
            for slice in leaf.profile(&at, face, Incidence::NORMAL, SLICES)? {
                let density = slice.absorbed / slice.thickness_um;
                let (tissue, depth) = (slice.tissue.name(), slice.depth_um);
                writeln!(out, "{nm},{lit},{tissue},{depth:.2},{density:.3e}")?;
            }
        }
    }
    Ok(())
}
