//! The spectra of many leaves as CSV or as an array, never more than a few leaves at a time.

use std::io::{self, Write};

use leafmodel::optics::Contents;
use leafmodel::optics::prospect_d::Coefficients;
use rayon::prelude::*;

use crate::report::table::quoted;

/// Leaves that are computed at a time, 115 kB of text for each at all wavelengths.
const AT_A_TIME: usize = 64;

/// The leaves of a table.
pub(crate) struct Leaves {
    /// The name of the column that names them.
    pub(crate) column: String,
    pub(crate) names: Vec<String>,
    pub(crate) contents: Vec<Contents>,
}

/// A line for each wavelength of each leaf.
pub(crate) fn csv(
    leaves: &Leaves,
    wavelengths: &[f64],
    at: &[Coefficients],
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "{},wavelength_nm,R,T", quoted(&leaves.column))?;
    in_pieces(leaves, out, |name, contents| {
        let (mut text, name) = (Vec::new(), quoted(name));
        for (nm, at) in wavelengths.iter().zip(at) {
            let found = at.reflectance_transmittance(contents);
            writeln!(
                text,
                "{name},{nm},{},{}",
                found.reflectance, found.transmittance
            )?;
        }
        Ok(text)
    })
}

/// An `.npy` file: `float64[leaf, 2, wavelength]`, reflectance before transmittance.
///
/// # Source
///
/// Version 1.0 of the format, in `numpy.lib.format`.
pub(crate) fn npy(leaves: &Leaves, at: &[Coefficients], out: &mut impl Write) -> io::Result<()> {
    let shape = format!("({}, 2, {})", leaves.contents.len(), at.len());
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version, and the length of the header, with which it ends at a multiple of 64 bytes.
    out.write_all(b"\x93NUMPY\x01\x00\x76\x00")?;
    writeln!(out, "{header:<117}")?;
    in_pieces(leaves, out, |_, contents| {
        let found: Vec<_> = at
            .iter()
            .map(|at| at.reflectance_transmittance(contents))
            .collect();
        let reflected = found.iter().map(|found| found.reflectance);
        let all = reflected.chain(found.iter().map(|found| found.transmittance));
        Ok(all.flat_map(f64::to_le_bytes).collect())
    })
}

/// Writes the bytes of each leaf, in their order.
fn in_pieces(
    leaves: &Leaves,
    out: &mut impl Write,
    bytes: impl Fn(&str, &Contents) -> io::Result<Vec<u8>> + Sync,
) -> io::Result<()> {
    let chunks = leaves
        .names
        .chunks(AT_A_TIME)
        .zip(leaves.contents.chunks(AT_A_TIME));
    for (names, contents) in chunks {
        let leaves = names.par_iter().zip(contents);
        let pieces: io::Result<Vec<Vec<u8>>> = leaves
            .map(|(name, contents)| bytes(name, contents))
            .collect();
        for piece in pieces? {
            out.write_all(&piece)?;
        }
    }
    Ok(())
}
