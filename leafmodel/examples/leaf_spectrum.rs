//! From what a leaf holds to what it reflects and transmits, by PROSPECT-D, as CSV.
//!
//! `cargo run --release -p leafmodel --example leaf_spectrum -- [N Cab Car Canth Cbrown Cw Cm]`:
//! the model's seven inputs, plates, three pigments (µg cm⁻²), brown pigments, water (cm) and dry
//! matter (g cm⁻²); without them a green leaf. A row of the standard output holds reflectance,
//! transmittance and absorptance for light at near-normal incidence, at each nm from 400 to 2500.

use std::error::Error;
use std::io::Write as _;

use leafmodel::optics::{Contents, ProspectD};

const GREEN: [f64; 7] = [1.5, 40.0, 8.0, 0.0, 0.0, 0.01, 0.009];

fn main() -> Result<(), Box<dyn Error>> {
    let given = std::env::args().skip(1).map(|text| text.parse());
    let given: Vec<f64> = given.collect::<Result<_, _>>()?;
    let [
        n,
        chlorophyll,
        carotenoids,
        anthocyanins,
        brown,
        water,
        dry_matter,
    ] = match given.as_slice() {
        [] => GREEN,
        given => given.try_into().map_err(|_| "give all seven, or none")?,
    };
    let contents = Contents::new(
        n,
        chlorophyll,
        carotenoids,
        anthocyanins,
        brown,
        water,
        dry_matter,
    )?;

    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    writeln!(out, "wavelength_nm,reflectance,transmittance,absorptance")?;
    for nm in 400..=2500_u16 {
        let leaf = ProspectD::coefficients(f64::from(nm))?.reflectance_transmittance(&contents);
        let (r, t) = (leaf.reflectance, leaf.transmittance);
        writeln!(out, "{nm},{r:.6},{t:.6},{:.6}", 1.0 - r - t)?;
    }
    out.flush()?;
    Ok(())
}
