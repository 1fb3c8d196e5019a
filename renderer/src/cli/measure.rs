//! `lamina measure`: measures of a network of veins from a file.

mod input;
mod report;

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use leafmodel::measure::Subject;

pub(super) use self::input::Input;
use self::report::Report;
pub(super) use self::report::{by_order, measured};
use crate::cli::arguments::MeasureArguments;
use crate::cli::progress::Patience;
use crate::cli::{Failure, places, say, trace};
use crate::image::atomic;

/// Most areoles that the bootstrap draws, which takes up to a minute of a processor.
const MOST_DRAWN: u64 = 2_000_000_000;

pub(super) fn run(arguments: &MeasureArguments) -> Result<(), Failure> {
    check_outputs(arguments)?;
    let _patience = Patience::about("measuring");
    let started = Instant::now();
    let input = Input::read(&arguments.file, &arguments.reading)?;
    let blade = input.blade(arguments.reading.area);
    for remark in input.remarks(blade) {
        eprintln!("{remark}");
    }
    let read_seconds = started.elapsed().as_secs_f64();
    let measuring = Instant::now();
    let subject = Subject::new(blade, &input.network, input.known);
    check_draws(arguments.bootstrap, subject.areoles().len())?;
    let report = Report::new(arguments, &input, &subject);
    let density = report.number("vein_density_mm_per_mm2");
    let scale = "--mm-per-unit, --mm-per-pixel, --area or --outline";
    if let Some(warning) = trace::implausible_density(density, scale) {
        eprintln!("{warning}");
    }
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

/// Fails if the bootstrap would take minutes.
fn check_draws(draws: u32, areoles: usize) -> Result<(), Failure> {
    let drawn = u64::from(draws) * areoles as u64;
    if drawn <= MOST_DRAWN {
        return Ok(());
    }
    Err(Failure::bad(format!(
        "--bootstrap {draws}: {areoles} areoles are drawn each time, {drawn} in all, more than the {MOST_DRAWN} \
         that are drawn: take {} or less",
        MOST_DRAWN / areoles as u64
    )))
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
        arguments.reading.nodes.as_ref(),
        arguments.reading.outline.as_ref(),
    ];
    let inputs: Vec<PathBuf> = read.into_iter().flatten().cloned().collect();
    let outputs = arguments.out.iter().chain(tables);
    let outputs: Vec<&Path> = outputs.map(PathBuf::as_path).collect();
    places::check_outputs(&outputs, &inputs, "the command")
}

pub(super) fn is_json(path: &Path) -> bool {
    has_ending(path, "json")
}

pub(super) fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|given| given.eq_ignore_ascii_case(ending))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    atomic::replace(path, |file| file.write_all(text.as_bytes())).map_err(Failure::system)?;
    say(path.display());
    Ok(())
}
