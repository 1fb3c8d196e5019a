//! The slabs and half-spaces of `tests/data/transport_anchors.csv` by both ways that the library
//! has, beside the table's values, as CSV:
//! `cargo run --release -p leafmodel --example slab_anchors -- [PHOTONS]`.
//!
//! A row is one share of one layer: the anchor, ours by discrete ordinates and how far off it is,
//! ours by photons (2,000,000 if no number is given) with its standard error, and z, their
//! difference from the anchor in standard errors. The table has six decimals.

use std::error::Error;
use std::io::Write as _;

use leafmodel::optics::layers::{
    Bins, Face, Incidence, Layer, Ordinates, Phase, Resolution, Stack, follow,
};

const ANCHORS: &str = include_str!("../../tests/data/transport_anchors.csv");
const PHOTONS: u64 = 2_000_000;

fn main() -> Result<(), Box<dyn Error>> {
    let photons = match std::env::args().nth(1) {
        Some(text) => text.parse()?,
        None => PHOTONS,
    };
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "n,a,b,g,share,anchor,ordinates,off,photons,standard_error,z"
    )?;
    let rows = ANCHORS
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|row| matches!(row[0], "slab" | "semi"));
    for (seed, row) in (1..).zip(rows) {
        let [n, a, b] = [row[1], row[2], row[3]].map(str::parse::<f64>);
        // Half-spaces leave out the isotropic phase function's g.
        let g: f64 = if row[4].is_empty() {
            0.0
        } else {
            row[4].parse()?
        };
        let layer = Layer {
            index: n?,
            albedo: a?,
            depth: b?,
            phase: Phase::HenyeyGreenstein { g },
        };
        let stack = Stack::new(vec![layer])?;
        let solved = Ordinates::new(&stack, Resolution::FINE, &[1.0])?;
        for (incidence, names, columns) in [
            (Incidence::NORMAL, ["R1", "T1"], [10, 11]),
            (Incidence::Lambertian, ["Rd", "Td"], [12, 13]),
        ] {
            if row[columns[0]].is_empty() {
                continue;
            }
            let exact = solved.fluxes(Face::First, &[incidence])?.swap_remove(0);
            let found = follow(&stack, Face::First, incidence, Bins::NONE, photons, seed)?;
            let pairs = [
                (exact.reflected, found.reflected),
                (exact.transmitted, found.transmitted),
            ];
            for ((name, column), (exact, found)) in names.into_iter().zip(columns).zip(pairs) {
                let anchor: f64 = row[column].parse()?;
                let off = exact - anchor;
                let z = if found.standard_error > 0.0 {
                    (found.value - anchor) / found.standard_error
                } else {
                    0.0
                };
                writeln!(
                    out,
                    "{},{},{},{g},{name},{anchor:.6},{exact:.8},{off:.1e},{:.6},{:.6},{z:.2}",
                    row[1], row[2], row[3], found.value, found.standard_error
                )?;
            }
        }
    }
    Ok(())
}
