//! `lamina fit`: what leaves hold, from their reflectance and transmittance.

mod input;

use leafmodel::optics::inversion::{self, Inversion, Prior};
use leafmodel::optics::prospect_d::{FIRST_NM, LAST_NM};
use leafmodel::optics::{Constituent, Contents, PerConstituent, Pigments};
use rayon::prelude::*;

use crate::cli::arguments::FitArguments;
use crate::cli::model;
use crate::cli::places::{check_outputs, is_json_not_csv, require_ending, write_and_say};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, say};
use crate::measured::series::retain;
use crate::measured::spectra::Leaf;
use crate::provenance::{Provenance, Settings};
use crate::report::fit::{
    Fitted, Rounded, contents, covariances, fitted_spectra, human, report, shown, svg,
};

/// Least number of wavelengths from which contents can be told.
const LEAST_WAVELENGTHS: usize = 8;

pub(super) fn run(arguments: &FitArguments, settings: &Settings) -> Result<(), Failure> {
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
    let question = Question::of(arguments)?;
    let free = &question.free;
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
    let fitted = question.answers(&leaves)?;
    let files = input::hashes(arguments);
    let of = |option| Provenance {
        files: files.clone(),
        ..Provenance::of("fit", option, settings)
    };
    if let Some(file) = out {
        let text = if is_json {
            report(&of("out"), &fitted, free, question.pigments.model)
        } else {
            of("out").comment() + &contents(&fitted, free)
        };
        write_and_say(file, text)?;
    }
    let [spectra_out, drawing, covariance_out] = others.map(|(file, ..)| file);
    if let Some(file) = spectra_out {
        write_and_say(file, of("spectra-out").comment() + &fitted_spectra(&fitted))?;
    }
    if let Some(file) = drawing {
        write_and_say(file, svg(&fitted))?;
    }
    if let Some(file) = covariance_out {
        write_and_say(file, of("covariance-out").comment() + &covariances(&fitted))?;
    }
    for fitted in &fitted {
        say_correlation(fitted);
    }
    if out.is_none() {
        say(human(&fitted, free));
    }
    Ok(())
}

/// What is looked for, and what is known.
struct Question {
    pigments: Pigments,
    free: Vec<Constituent>,
    fixed: Contents,
    priors: PerConstituent<Option<Prior>>,
}

impl Question {
    fn of(arguments: &FitArguments) -> Result<Self, Failure> {
        let pigments = model::pigments(&arguments.model)?;
        let inputs = pigments.model.inputs();
        let mut free = if arguments.free.is_empty() {
            inputs.to_vec()
        } else {
            let free = arguments.free.iter().map(|name| named(name.trim()));
            free.collect::<Result<Vec<_>, _>>()?
        };
        let (mut fixed, mut known) = (Contents::NOTHING, Vec::new());
        for written in &arguments.fix {
            let (of, value) = assigned(written)?;
            let [low, high] = of.range();
            let value = value.parse::<f64>().ok();
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
        let unknown = inputs.iter();
        let unknown = unknown.filter(|of| !free.contains(of) && !known.contains(of));
        let unknown: Vec<&str> = unknown.map(|of| of.name()).collect();
        if !unknown.is_empty() {
            bail!(
                "neither free nor known: {}; name each by --free, or give it by --fix NAME=VALUE",
                unknown.join(", ")
            );
        }
        if free.is_empty() {
            bail!("every content is fixed: there is nothing to be found");
        }
        let looked_for = free.iter().map(|&of| (of, 1.0));
        let held = fixed.with(&looked_for.collect::<Vec<_>>());
        if let Some(problem) = model::refusal(&pigments, &held) {
            bail!("{problem}");
        }
        let priors = priors(&arguments.prior, &free)?;
        Ok(Self {
            pigments,
            free,
            fixed,
            priors,
        })
    }

    /// What each leaf holds. Leaves at the same wavelengths share what depends on them alone.
    fn answers<'a>(&self, leaves: &'a [Leaf]) -> Result<Vec<Fitted<'a>>, Failure> {
        let mut inversions: Vec<Inversion> = Vec::new();
        let mut own = Vec::with_capacity(leaves.len());
        for leaf in leaves {
            let known = inversions.iter().rposition(|known| known.is_at(&leaf.nm));
            own.push(known.unwrap_or(inversions.len()));
            if known.is_none() {
                let new = Inversion::new(&self.pigments, &leaf.nm, &self.free, self.fixed);
                inversions.push(new.map_err(Failure::bad)?.with_priors(self.priors));
            }
        }
        let leaves = leaves.par_iter().zip(&own);
        let fitted = leaves.map(|(leaf, &own)| Fitted {
            leaf,
            found: inversions[own].of(spectra(leaf)),
        });
        Ok(fitted.collect())
    }
}

/// The content of a name.
fn named(name: &str) -> Result<Constituent, Failure> {
    let found = Constituent::ALL.into_iter().find(|of| of.name() == name);
    found.ok_or_else(|| {
        let names = Constituent::ALL.map(Constituent::name).join(", ");
        let name = name.escape_debug();
        bad!("there is no content `{name}`; allowed are {names}")
    })
}

/// A content, and what is written behind its `=`.
fn assigned(written: &str) -> Result<(Constituent, &str), Failure> {
    let (name, value) = written.split_once('=').unwrap_or((written, ""));
    Ok((named(name.trim())?, value.trim()))
}

/// What is known beforehand of contents that are looked for.
fn priors(
    written: &[String],
    free: &[Constituent],
) -> Result<PerConstituent<Option<Prior>>, Failure> {
    let mut priors = PerConstituent::splat(None);
    for written in written {
        let (of, value) = assigned(written)?;
        if !free.contains(&of) {
            bail!("--prior {written}: {} is not looked for", of.name());
        }
        if priors[of].is_some() {
            bail!("--prior {written}: {} has a prior already", of.name());
        }
        let pair = |by: &str| {
            let (first, second) = value.split_once(by)?;
            Some([first.trim().parse().ok()?, second.trim().parse().ok()?])
        };
        let [low, high] = of.range();
        let is_there = |value: f64| (low..=high).contains(&value);
        priors[of] = match (pair(".."), pair("+-").or_else(|| pair("±"))) {
            (Some([least, most]), _) if is_there(least) && is_there(most) && least < most => {
                Some(Prior::Within([least, most]))
            }
            (_, Some([mean, deviation])) if is_there(mean) && deviation > 0.0 => {
                Some(Prior::Normal { mean, deviation })
            }
            _ => bail!(
                "--prior {written}: write a mean and a standard deviation, {name}=MEAN+-SD, or a \
                 range, {name}=LEAST..MOST, from {low} to {high}",
                name = of.name()
            ),
        };
    }
    Ok(priors)
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
