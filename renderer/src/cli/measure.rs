//! `lamina measure`: measures of a network of veins from a file.

mod input;
mod report;

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use leafmodel::import::{Fault, FaultKind};
use leafmodel::measure::{Blade, Subject};
use leafmodel::shape::outline::Outline;

use self::input::Input;
use self::report::Report;
use crate::cli::arguments::MeasureArguments;
use crate::cli::{Failure, places, say};
use crate::image::atomic;

pub(super) fn run(arguments: &MeasureArguments) -> Result<(), Failure> {
    check_outputs(arguments)?;
    let started = Instant::now();
    let input = Input::read(arguments)?;
    tell_faults(arguments, &input.faults)?;
    let read_seconds = started.elapsed().as_secs_f64();
    let measuring = Instant::now();
    let blade = match input.outlines.as_slice() {
        [outline] => Blade::Margin(outline),
        [] => arguments.area.map_or(Blade::Unknown, Blade::Area),
        several => Blade::Area(several.iter().map(Outline::area).sum()),
    };
    tell_what_is_missing(&input, blade);
    let subject = Subject::new(blade, &input.network, input.known);
    let report = Report::new(arguments, &input, &subject);
    let seconds = measuring.elapsed().as_secs_f64();
    eprint!("{}", report.table());
    for path in &arguments.out {
        let text = if is_json(path) {
            report.json()
        } else {
            report.csv()
        };
        write(path, &text)?;
    }
    report.write_tables(arguments)?;
    let network = &input.network;
    eprintln!(
        "{}: {} nodes, {} edges, {} areoles; read in {read_seconds:.2} s, measured in {seconds:.2} s",
        arguments.file.display(),
        network.nodes().len(),
        network.edges().len(),
        subject.areoles().len(),
    );
    Ok(())
}

/// Fails if files cannot be written, are named twice or read, or end in what is not written.
fn check_outputs(arguments: &MeasureArguments) -> Result<(), Failure> {
    let tables = [
        &arguments.distributions,
        &arguments.structure_factor,
        &arguments.loop_tree,
        &arguments.cuts,
    ];
    let tables: Vec<&PathBuf> = tables.into_iter().flatten().collect();
    for path in &arguments.out {
        if !is_json(path) && !has_ending(path, "csv") {
            return Err(Failure::bad(format!(
                "{}: --out writes tables: let its name end in .csv or .json",
                path.display()
            )));
        }
    }
    for path in &tables {
        if !has_ending(path, "csv") {
            return Err(Failure::bad(format!(
                "{}: a table is written as csv: let its name end in .csv",
                path.display()
            )));
        }
    }
    let read = [
        Some(&arguments.file),
        arguments.nodes.as_ref(),
        arguments.outline.as_ref(),
    ];
    let inputs: Vec<PathBuf> = read.into_iter().flatten().cloned().collect();
    let outputs = arguments.out.iter().chain(tables);
    let outputs: Vec<&Path> = outputs.map(PathBuf::as_path).collect();
    places::check_outputs(&outputs, &inputs, "the command")
}

/// Tells what is wrong with a network; with `--strict` it is an error.
fn tell_faults(arguments: &MeasureArguments, faults: &[Fault]) -> Result<(), Failure> {
    let wrong = faults.iter().filter(|fault| !fault.kind.is_note());
    forbid(arguments, wrong.map(Fault::line))?;
    for fault in faults {
        let word = if fault.kind.is_note() {
            "note"
        } else {
            "warning"
        };
        eprintln!("{word}: {}", fault.line());
    }
    Ok(())
}

/// With `--strict`, fails if there is any of these lines about faults.
fn forbid(
    arguments: &MeasureArguments,
    wrong: impl Iterator<Item = String>,
) -> Result<(), Failure> {
    let lines: String = wrong.map(|line| format!("\n  {line}")).collect();
    if !arguments.strict || lines.is_empty() {
        return Ok(());
    }
    let file = arguments.file.display();
    Err(Failure::bad(format!(
        "{file}: is not without fault, as --strict asks:{lines}"
    )))
}

fn tell_what_is_missing(input: &Input, blade: Blade) {
    let is_told = |fault: &Fault| fault.kind == FaultKind::NoRadius;
    if !input.known.radii && !input.faults.iter().any(is_told) {
        eprintln!(
            "note: edges have no radius or width: measures of widths, and of vein orders that are not in the file, are \
             missing"
        );
    }
    if input.orders_found {
        eprintln!(
            "note: vein orders are not in the file; they are found from widths and branching"
        );
    }
    match blade {
        Blade::Margin(_) => {}
        Blade::Area(_) => {
            eprintln!(
                "note: without a margin, measures of the shape and distances to veins are missing"
            );
        }
        Blade::Unknown => eprintln!(
            "note: without a margin (--outline FILE.svg) or an area (--area MM2), measures of the shape, per area, and \
             distances to veins are missing"
        ),
    }
}

fn is_json(path: &Path) -> bool {
    has_ending(path, "json")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|given| given.eq_ignore_ascii_case(ending))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    atomic::replace(path, |file| file.write_all(text.as_bytes())).map_err(Failure::system)?;
    say(path.display());
    Ok(())
}
