//! `lamina check-bsdf`: what of a measured BRDF or BTDF is reciprocal, and how much light it has.

use crate::cli::arguments::CheckBsdfArguments;
use crate::cli::places::{check_outputs, is_json_not_csv, write_and_say};
use crate::cli::terminal::{Failure, note, say};
use crate::cli::texts::text_of;
use crate::measured::bsdf;
use crate::report::bsdf_check::{human, report, rows};

/// A surface that sends out more than this share of the light is not told from one of 1: sums over
/// rings of a few degrees are that uncertain.
const MOST_ENERGY: f64 = 1.01;

pub(super) fn run(arguments: &CheckBsdfArguments) -> Result<(), Failure> {
    let out = arguments.out.as_deref();
    let is_json = is_json_not_csv(out)?;
    let file = &arguments.table;
    check_outputs(&arguments.out, std::slice::from_ref(file), "the command")?;
    let text = text_of(file)?;
    let mut known = arguments.reading.known();
    known.angles = arguments.angles;
    let table =
        bsdf::read(&text, &known).map_err(|fault| Failure::bad(fault.shown(file, &text)))?;
    note(&table.notes);
    let check = table.check();
    if check.is_isotropic {
        eprintln!("note: light comes from one azimuth: the surface is taken to be isotropic");
    }
    for energy in check.energy.iter().filter(|e| e.total() > MOST_ENERGY) {
        eprintln!(
            "warning: {:.3} of the light from {}° is sent out at {} nm, more than comes in",
            energy.total(),
            energy.incident.theta,
            energy.nm
        );
    }
    if check.bands.iter().all(|band| band.paired == 0) {
        eprintln!(
            "warning: no row has a partner with its directions exchanged: reciprocity is not tested"
        );
    }
    if let Some(out) = out {
        let text = if is_json {
            report(&check)
        } else {
            rows(&check)
        };
        write_and_say(out, text)?;
    } else {
        say(human(&check));
    }
    Ok(())
}
