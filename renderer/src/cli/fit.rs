//! `lamina fit`: what leaves hold, from their reflectance and transmittance.

mod input;

use leafmodel::optics::inversion::{self, Inversion};
use leafmodel::optics::prospect_d::{FIRST_NM, LAST_NM};
use leafmodel::optics::{Constituent, Contents};
use rayon::prelude::*;

use crate::cli::arguments::FitArguments;
use crate::cli::places::{check_outputs, is_json_not_csv, require_ending, write_and_say};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, say};
use crate::measured::series::retain;
use crate::measured::spectra::Leaf;
use crate::report::fit::{
    Fitted, Rounded, contents, covariances, fitted_spectra, human, report, shown, svg,
};

/// Least number of wavelengths from which contents can be told.
const LEAST_WAVELENGTHS: usize = 8;

pub(super) fn run(arguments: &FitArguments) -> Result<(), Failure> {
    let out = arguments.out.as_deref();
    let is_json = is_json_not_csv(out)?;
    let others = [
        (
            &arguments.spectra_out,
            "csv",
            "--spectra-out writes a table",
        ),
        (&arguments.plot, "svg", "--plot writes a drawing"),
        (
            &arguments.covariance_out,
            "csv",
            "--covariance-out writes a table",
        ),
    ];
    for (file, ending, what) in others {
        require_ending(file, ending, what)?;
    }
    let outputs = others.into_iter().filter_map(|(file, ..)| file.as_ref());
    let outputs = arguments.out.iter().chain(outputs);
    check_outputs(outputs, &input::files(arguments), "the command")?;
    let (free, fixed) = wanted(arguments)?;
    let range = arguments
        .range
        .as_deref()
        .map_or(Ok([FIRST_NM, LAST_NM]), parse_range)?;
    let mut leaves = input::leaves(arguments)?;
    let before: usize = leaves.iter().map(|leaf| leaf.nm.len()).sum();
    for leaf in &mut leaves {
        keep(leaf, range);
        if leaf.nm.len() < LEAST_WAVELENGTHS {
            let [low, high] = range;
            let (count, name) = (leaf.nm.len(), shown(leaf));
            bail_at!(
                input::files(arguments)[0],
                "{name} has {count} wavelengths from {low} to {high} nm, at least \
                 {LEAST_WAVELENGTHS} are needed"
            );
        }
    }
    let left_out = before - leaves.iter().map(|leaf| leaf.nm.len()).sum::<usize>();
    if left_out > 0 {
        let [low, high] = range;
        eprintln!("note: {left_out} values outside of {low} to {high} nm are left out");
    }
    let _patience = Patience::about("fitting");
    let fitted: Vec<Fitted<'_>> = leaves
        .par_iter()
        .map(|leaf| fit(leaf, &free, fixed))
        .collect::<Result<_, _>>()?;
    if let Some(file) = out {
        let text = if is_json {
            report(&fitted, &free)
        } else {
            contents(&fitted, &free)
        };
        write_and_say(file, text)?;
    }
    let texts = [fitted_spectra, svg, covariances];
    for ((file, ..), text) in others.into_iter().zip(texts) {
        if let Some(file) = file {
            write_and_say(file, text(&fitted))?;
        }
    }
    for fitted in &fitted {
        say_correlation(fitted);
    }
    if out.is_none() {
        say(human(&fitted, &free));
    }
    Ok(())
}

/// The contents that are looked for, and all others as they are known.
fn wanted(arguments: &FitArguments) -> Result<(Vec<Constituent>, Contents), Failure> {
    let named = |name: &str| {
        let found = Constituent::ALL.into_iter().find(|of| of.name() == name);
        found.ok_or_else(|| {
            let names = Constituent::ALL.map(Constituent::name).join(", ");
            let name = name.escape_debug();
            bad!("there is no content `{name}`; allowed are {names}")
        })
    };
    let mut free = if arguments.free.is_empty() {
        Inversion::PROSPECT_D.to_vec()
    } else {
        let free = arguments.free.iter().map(|name| named(name.trim()));
        free.collect::<Result<Vec<_>, _>>()?
    };
    let (mut fixed, mut known) = (Contents::NOTHING, Vec::new());
    for written in &arguments.fix {
        let (name, value) = written.split_once('=').unwrap_or((written, ""));
        let of = named(name.trim())?;
        let [low, high] = of.range();
        let value = value.trim().parse::<f64>().ok();
        let value = value
            .filter(|value| (low..=high).contains(value))
            .ok_or_else(|| bad!("--fix {written}: a number from {low} to {high} is needed"))?;
        if arguments.free.iter().any(|name| name.trim() == of.name()) {
            bail!("{} is both free and fixed", of.name());
        }
        fixed[of] = value;
        free.retain(|other| *other != of);
        known.push(of);
    }
    if let Some(twice) = (1..free.len()).find(|&i| free[..i].contains(&free[i])) {
        bail!("{} is free twice", free[twice].name());
    }
    let unknown = Inversion::PROSPECT_D.into_iter();
    let unknown = unknown.filter(|of| !free.contains(of) && !known.contains(of));
    let unknown: Vec<&str> = unknown.map(Constituent::name).collect();
    if !unknown.is_empty() {
        bail!(
            "neither free nor known: {}; name each by --free, or give it by --fix NAME=VALUE",
            unknown.join(", ")
        );
    }
    if free.is_empty() {
        bail!("every content is fixed: there is nothing to be found");
    }
    Ok((free, fixed))
}

fn parse_range(written: &str) -> Result<[f64; 2], Failure> {
    let ends = written.split_once("..").map(|(low, high)| [low, high]);
    let ends = ends.map(|ends| ends.map(|end| end.trim().parse::<f64>()));
    match ends {
        Some([Ok(low), Ok(high)]) if FIRST_NM <= low && low < high && high <= LAST_NM => {
            Ok([low, high])
        }
        _ => Err(bad!(
            "--range {written}: write it as 400..800, from {FIRST_NM} to {LAST_NM} nm"
        )),
    }
}

/// Keeps the wavelengths of a range.
fn keep(leaf: &mut Leaf, [low, high]: [f64; 2]) {
    let kept: Vec<bool> = leaf.nm.iter().map(|nm| (low..=high).contains(nm)).collect();
    for values in [
        &mut leaf.nm,
        &mut leaf.reflectance,
        &mut leaf.abaxial,
        &mut leaf.transmittance,
    ] {
        retain(values, &kept);
    }
    retain(&mut leaf.lines, &kept);
}

fn spectra(leaf: &Leaf) -> inversion::Spectra<'_> {
    let there = |values: &'_ Vec<f64>| !values.is_empty();
    inversion::Spectra {
        reflectance: there(&leaf.reflectance).then_some(&leaf.reflectance),
        abaxial: there(&leaf.abaxial).then_some(&leaf.abaxial),
        transmittance: there(&leaf.transmittance).then_some(&leaf.transmittance),
    }
}

fn fit<'a>(leaf: &'a Leaf, free: &[Constituent], fixed: Contents) -> Result<Fitted<'a>, Failure> {
    let inversion = Inversion::new(&leaf.nm, free, fixed).map_err(Failure::bad)?;
    Ok(Fitted {
        leaf,
        found: inversion.of(spectra(leaf)),
    })
}

/// Says that errors are wider because what is left is correlated.
fn say_correlation(Fitted { leaf, found }: &Fitted<'_>) {
    if let Some(correlation) = found.correlation {
        eprintln!(
            "note: {}: what is left is correlated over {:.3} nm, so that the values count as fewer: \
             errors are wider accordingly",
            leafmodel::document::source::quoted(shown(leaf)),
            Rounded(correlation.length_nm)
        );
    }
}

#[cfg(test)]
mod tests;
