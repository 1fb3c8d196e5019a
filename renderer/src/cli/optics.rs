//! `lamina optics`: R and T of a leaf by PROSPECT as a table, and their colours; both faces of the
//! leaf as layers.

mod leaf;
mod table;

use std::fmt::Write as _;
use std::path::Path;

use leafmodel::optics::presets;
use serde_json::json;

use self::leaf::{Chosen, warn_of_mixtures};
use crate::checkpoint::PROGRAM;
use crate::cli::arguments::OpticsArguments;
use crate::cli::model;
use crate::cli::places::{check_writable, is_stdout, require_ending, write_and_say};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, say};
use crate::provenance::{Provenance, Settings};
use crate::report::optics::{angles, colour, figures, layers};

/// Options on which the files of other options do not depend.
const OF_ANGLES: [&str; 2] = ["nm", "photons"];

pub(super) fn run(arguments: &OpticsArguments, settings: &Settings) -> Result<(), Failure> {
    if arguments.list {
        let longest = presets::ALL.iter().map(|preset| preset.name.len()).max();
        for preset in presets::ALL {
            let width = longest.unwrap_or(0);
            say(format!("{:<width$}  {}", preset.name, preset.basis.word()));
        }
        return Ok(());
    }
    if arguments.figures {
        say(figures::table());
        return Ok(());
    }
    if let (Some(file), Some(out)) = (&arguments.table, &arguments.out) {
        return table::run(arguments, settings, file, out);
    }
    let chosen = leaf::choose(arguments)?;
    let files = [
        arguments.out.as_deref(),
        arguments.colour.as_ref().and_then(|file| file.as_deref()),
        arguments.layers.as_ref().and_then(|file| file.as_deref()),
        arguments.angles.as_deref(),
    ];
    let given: Vec<&Path> = files.into_iter().flatten().collect();
    if let Some((_, file)) = given
        .iter()
        .enumerate()
        .find(|(place, file)| given[..*place].contains(file))
    {
        return Err(Failure::written_twice(file));
    }
    let [out, _, layers_out, angles_out] = files;
    let tables = [
        ("--out", out),
        ("--layers", layers_out),
        ("--angles", angles_out),
    ];
    for (option, file) in tables {
        let file = file.filter(|file| !is_stdout(file));
        require_ending(file, "csv", &format!("{option} writes a table"))?;
    }
    require_ending(
        arguments.colour.iter().flatten(),
        "json",
        "--colour writes JSON",
    )?;
    for file in files.into_iter().flatten().filter(|file| !is_stdout(file)) {
        check_writable(file)?;
    }
    let contents = chosen.contents;
    warn_of_mixtures(&[contents]);
    if arguments.about {
        say(chosen.about());
    }
    let mut of_contents = settings.clone();
    of_contents.retain(|name, _| !OF_ANGLES.contains(&name.as_str()));
    let of = |option| Provenance::of("optics", option, &of_contents);
    if let Some(file) = &arguments.out {
        hand_over(file, &of("out"), &spectrum(&chosen))?;
    }
    match &arguments.layers {
        Some(Some(file)) => hand_over(
            file,
            &of("layers"),
            &layers::table(&contents, &chosen.line()),
        )?,
        Some(None) => say(layers::faces(&contents)),
        None => {}
    }
    if let Some(file) = &arguments.angles {
        let angles = angles::Angles::of(&contents, &arguments.nm);
        let _patience = Patience::about("following photons");
        let table = match arguments.photons {
            Some(photons) => angles.compared(photons, &chosen.line()),
            None => angles.table(&chosen.line()),
        };
        hand_over(file, &Provenance::of("optics", "angles", settings), &table)?;
    }
    if let Some(file) = &arguments.colour {
        let colours = colour::Colours::of(|nm| chosen.at(nm).reflectance_transmittance(&contents));
        match file {
            Some(file) => {
                let report = json!({
                    "program": PROGRAM,
                    "contents": chosen.json(),
                    "colours": colours.json(),
                });
                let report = of("colour").within(report);
                write_and_say(file, format!("{report:#}\n"))?;
            }
            None => say(colours.table()),
        }
    }
    eprintln!(
        "{}: {}",
        model::source(chosen.pigments.model),
        chosen.line()
    );
    Ok(())
}

/// Writes a table to a file or to the standard output.
fn hand_over(file: &Path, provenance: &Provenance, table: &str) -> Result<(), Failure> {
    let table = provenance.comment() + table;
    if is_stdout(file) {
        say(table.trim_end());
        return Ok(());
    }
    write_and_say(file, table)
}

/// R and T at every nanometre of PROSPECT's tables; a comment says what wrote it, of which leaf.
fn spectrum(chosen: &Chosen) -> String {
    let (model, leaf) = (chosen.pigments.model.title(), chosen.line());
    let mut table = format!("# Lamina {PROGRAM}, {model}: {leaf}\nwavelength_nm,R,T\n");
    for nm in 400..=2500 {
        let at = chosen.at(f64::from(nm));
        let optics = at.reflectance_transmittance(&chosen.contents);
        // As many digits as give back the number. Writing to a String cannot fail.
        let _ = writeln!(
            table,
            "{nm},{},{}",
            optics.reflectance, optics.transmittance
        );
    }
    table
}
