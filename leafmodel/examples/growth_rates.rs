//! The growth rate curve beside the leaf that it brings forth (Fig. 2 of \[young2010\]), as CSV.
//!
//! `cargo run --release -p leafmodel --example growth_rates -- [young-3b]` writes for each row of
//! cells of the named form its place along the midrib, its lateral growth rate per step, and its
//! half width at maturity in lengths of the midrib.

use std::io::Write as _;

use leafmodel::shape::growth_form::Side;
use leafmodel::species::{Preset, find};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or("young-3b".to_owned());
    let plan = find(&name).map(Preset::plan);
    let form = plan.as_ref().and_then(|plan| plan.outline.growth_form());
    let form = form.ok_or("name one of the forms young-3a to young-9d")?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "place,rate,half_width")?;
    for row in form.row_growth(Side::Right)? {
        writeln!(out, "{},{},{}", row.place, row.rate, row.half_width)?;
    }
    Ok(())
}
