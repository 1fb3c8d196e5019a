//! Leaves of one plant: their plans in one file, or their margins and veins on one sheet.

use std::ops::RangeInclusive;
use std::sync::atomic::AtomicBool;

use leafmodel::plan_file::individuals_to_toml;

use super::choice::Chosen;
use super::grown::Grown;
use super::outputs::{Kind, Outputs, finish};
use crate::cli::terminal::Failure;
use crate::export::sheet::{Sheet, Specimen};
use crate::export::veins::VeinFormat;

/// Refuses files that hold one leaf only.
pub(super) fn check(outputs: &Outputs) -> Result<(), Failure> {
    let is_good = |kind: &Kind| matches!(*kind, Kind::Toml | Kind::SVG | Kind::PNG);
    if outputs.whole.is_empty() || !outputs.whole.iter().all(|(_, kind)| is_good(kind)) {
        bail!(
            "--individuals writes plans into one toml, or margins and veins side by side as svg or png: let --out end in one of \
             these; other files hold one leaf, such as `lamina grow FILE.toml#NAME` takes from the plans"
        );
    }
    Ok(())
}

/// Writes leaves 1 to `count` of a plant.
pub(super) fn write(
    chosen: &Chosen,
    outputs: &Outputs,
    count: u16,
    pixels: u32,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let (name, plan, preset) = (chosen.name.as_str(), &chosen.plan, chosen.preset);
    let numbers = 1..=u64::from(count);
    let mut sheet = None;
    for (path, kind) in &outputs.whole {
        let bytes = match *kind {
            Kind::Toml => individuals_to_toml(name, plan, preset, numbers.clone()).into_bytes(),
            Kind::Veins(format) => {
                let sheet = match &sheet {
                    Some(sheet) => sheet,
                    None => sheet.insert(drawn(chosen, numbers.clone(), stop)?),
                };
                if format == VeinFormat::Svg {
                    sheet.svg().into_bytes()
                } else {
                    sheet.png(pixels).map_err(Failure::bad)?
                }
            }
            Kind::Film(_) | Kind::Mp4 | Kind::Ply | Kind::Obj => continue,
        };
        finish(path, &bytes, stop)?;
    }
    Ok(())
}

/// Margins and veins of leaves of a plant.
fn drawn(
    chosen: &Chosen,
    numbers: RangeInclusive<u64>,
    stop: &AtomicBool,
) -> Result<Sheet, Failure> {
    let leaves = numbers.map(|number| {
        let plan = chosen.plan.individual(chosen.preset, number);
        let grown = Grown::new(&plan, false, stop)?;
        let lamina = grown.lamina();
        Ok(match grown.flat(&plan)? {
            Some(flat) => Specimen {
                bounds: flat.bounds(),
                outlines: flat.outlines,
                network: flat.network,
            },
            None => Specimen {
                bounds: lamina.outline.bounds(),
                outlines: vec![lamina.outline.clone()],
                network: lamina.network.clone(),
            },
        })
    });
    Ok(Sheet::new(leaves.collect::<Result<_, Failure>>()?))
}
