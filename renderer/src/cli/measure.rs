//! `lamina measure`: measures of a network of veins from a file.

mod input;

use std::path::PathBuf;
use std::time::Instant;

use leafmodel::measure::Subject;

pub(super) use self::input::Input;
use crate::cli::arguments::MeasureArguments;
use crate::cli::places::{
    check_outputs, has_ending, is_json_not_csv, require_ending, write_and_say,
};
use crate::cli::progress::Patience;
use crate::cli::terminal::Failure;
use crate::report::measures::{Report, measured};
use crate::report::tracing::implausible_density;

/// Most areoles that the bootstrap draws, which takes up to a minute of a processor.
const MOST_DRAWN: u64 = 2_000_000_000;

pub(super) fn run(arguments: &MeasureArguments) -> Result<(), Failure> {
    check_files(arguments)?;
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
    let asked = [&arguments.structure_factor, &arguments.cuts].map(Option::is_some);
    let (measures, structure, supply) = measured(&subject, arguments.measuring.wanted(asked));
    let report = Report {
        file: arguments.file.display().to_string(),
        network: &input.network,
        known: input.known,
        faults: &input.faults,
        subject: &subject,
        measures,
        structure,
        supply,
        intervals: subject.confidence(arguments.bootstrap, arguments.seed),
    };
    let density = report.measures.number("vein_density_mm_per_mm2");
    let scale = "--mm-per-unit, --mm-per-pixel, --area or --outline";
    if let Some(warning) = implausible_density(density, scale) {
        eprintln!("{warning}");
    }
    let seconds = measuring.elapsed().as_secs_f64();
    eprint!("{}", report.table());
    for path in &arguments.out {
        let text = if has_ending(path, "json") {
            report.json()
        } else {
            report.csv()
        };
        write_and_say(path, text)?;
    }
    let tables: [(_, &dyn Fn() -> String); 4] = [
        (&arguments.distributions, &|| report.samples()),
        (&arguments.structure_factor, &|| report.structure_table()),
        (&arguments.loop_tree, &|| report.loops()),
        (&arguments.cuts, &|| report.cuts()),
    ];
    for (path, table) in tables {
        if let Some(path) = path {
            write_and_say(path, table())?;
        }
    }
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
    Err(bad!(
        "--bootstrap {draws}: {areoles} areoles are drawn each time, {drawn} in all, more than the {MOST_DRAWN} \
         that are drawn: take {} or less",
        MOST_DRAWN / areoles as u64
    ))
}

/// Fails if files cannot be written, are named twice or read, or end in what is not written.
fn check_files(arguments: &MeasureArguments) -> Result<(), Failure> {
    let tables = [
        &arguments.distributions,
        &arguments.structure_factor,
        &arguments.loop_tree,
        &arguments.cuts,
    ];
    let tables = tables.into_iter().flatten();
    for path in &arguments.out {
        is_json_not_csv(Some(path))?;
    }
    require_ending(tables.clone(), "csv", "a table is written as csv")?;
    let read = [
        Some(&arguments.file),
        arguments.reading.nodes.as_ref(),
        arguments.reading.outline.as_ref(),
    ];
    let inputs: Vec<PathBuf> = read.into_iter().flatten().cloned().collect();
    check_outputs(arguments.out.iter().chain(tables), &inputs, "the command")
}
