//! `lamina trace`: the margin and the veins of a picture as files.

use std::path::Path;
use std::time::Instant;

use glam::DVec2;
use leafmodel::measure::measure;
use leafmodel::tracing::{Blade, FindingKind, Ink, Raster, Settings, Threshold, Traced, trace};

use crate::cli::arguments::{ThresholdKind, TraceArguments};
use crate::cli::needs;
use crate::cli::needs::on_threads;
use crate::cli::places::{check_outputs, write_and_say, write_json};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, say};
use crate::export::overlay::draw_over;
use crate::export::veins::VeinFormat;
use crate::image::scan;
use crate::report::tracing::{drawn, implausible_density, json, note_on_length, of_findings};

/// Memory that tracing takes for a pixel, bytes; measured with pictures of 12 and 42 megapixels.
const BYTES_A_PIXEL: f64 = 60.0;

/// Side of the window of Sauvola's threshold, pixels, and how far its level lies below the mean, as
/// a share of it, unless flags say otherwise.
const WINDOW_PX: f64 = 61.0;
const SAUVOLA_K: f64 = 0.2;

/// The format of a file, by its ending.
fn format_of(path: &Path) -> Result<VeinFormat, Failure> {
    let format = VeinFormat::of(path).filter(|format| *format != VeinFormat::Csv);
    let what = "the ending tells what is written: svg, png, json, graphml or geojson";
    format.ok_or_else(|| bad_at!(path, "{what}"))
}

pub(super) fn run(arguments: &TraceArguments) -> Result<(), Failure> {
    let _patience = Patience::about("tracing");
    let started = Instant::now();
    let formats: Vec<VeinFormat> = arguments
        .out
        .iter()
        .map(|path| format_of(path))
        .collect::<Result<_, _>>()?;
    if arguments.mask && arguments.margin.is_none() && !arguments.cut_out {
        bail!(
            "a mask shows no blade: give its picture with --margin, or --cut-out if the whole \
             picture is blade"
        );
    }
    if arguments.threshold != ThresholdKind::Sauvola {
        let idle = [
            ("--window-px", arguments.window_px.is_some()),
            ("--sauvola-k", arguments.sauvola_k.is_some()),
        ];
        if let Some((flag, _)) = idle.into_iter().find(|(_, given)| *given) {
            bail!("{flag} goes with --threshold sauvola: give both or neither");
        }
    }
    let reports = [&arguments.measure, &arguments.overlay, &arguments.findings];
    let outputs = arguments.out.iter().chain(reports.into_iter().flatten());
    if outputs.clone().next().is_none() {
        bail!("nothing is to be written: give --out, --measure, --overlay or --findings");
    }
    let inputs = std::iter::once(arguments.picture.clone()).chain(arguments.margin.clone());
    check_outputs(outputs, &inputs.collect::<Vec<_>>(), "the command")?;
    on_threads(arguments.threads, || {
        carry_out(arguments, &formats, started)
    })
}

fn carry_out(
    arguments: &TraceArguments,
    formats: &[VeinFormat],
    started: Instant,
) -> Result<(), Failure> {
    let picture = read(&arguments.picture, arguments.memory)?;
    let settings = settings(arguments)?;
    let shown = arguments.picture.display();
    let traced = traced(&arguments.picture, &picture, &settings)?;
    let points = traced.outline.points().iter().copied();
    if let Some(note) = note_on_length(points, "--mm-per-pixel") {
        eprintln!("{note}");
    }
    let density = traced.network.vein_length_mm() / traced.outline.area();
    if let Some(warning) = implausible_density(Some(density), "--mm-per-pixel") {
        eprintln!("{warning}");
    }
    for (path, format) in arguments.out.iter().zip(formats) {
        let drawn = drawn(*format, &traced, arguments.size);
        write_and_say(path, drawn.map_err(Failure::bad)?)?;
    }
    if let Some(path) = &arguments.overlay {
        let drawing = draw_over(&picture, &traced, arguments.size);
        let drawing = drawing.and_then(|drawing| drawing.png());
        write_and_say(path, drawing.map_err(Failure::bad)?)?;
    }
    if let Some(path) = &arguments.findings {
        write_json(path, &json(&traced))?;
        say(path.display());
    }
    if let Some(path) = &arguments.measure {
        let exponent = arguments.murray_exponent;
        let measures = measure(&traced.outline, &traced.network, exponent);
        write_json(path, &measures.json())?;
        say(path.display());
        eprint!("{}", measures.table());
    }
    eprintln!(
        "{shown}: {} vein nodes, {} loops, {:.2} mm of vein, {:.2} s",
        traced.network.nodes().len(),
        traced.network.loops(),
        traced.network.vein_length_mm(),
        started.elapsed().as_secs_f64(),
    );
    Ok(())
}

/// What a picture shows, traced with the usual settings.
pub(super) fn with_usual_settings(picture: &Path, mm_per_pixel: f64) -> Result<Traced, Failure> {
    let raster = read(picture, None)?;
    traced(picture, &raster, &Settings::new(mm_per_pixel))
}

/// Traces a picture and tells what was found on the way.
fn traced(path: &Path, picture: &Raster, settings: &Settings) -> Result<Traced, Failure> {
    let traced = trace(picture, settings);
    let traced = traced.map_err(Failure::at(path))?;
    for finding in &traced.findings {
        if matches!(finding.kind, FindingKind::Moved { .. }) {
            eprintln!("warning: {finding}");
        }
    }
    for finding in of_findings(&traced.findings) {
        eprintln!("note: {finding}");
    }
    Ok(traced)
}

fn settings(arguments: &TraceArguments) -> Result<Settings, Failure> {
    let blade = match (&arguments.margin, arguments.cut_out) {
        (Some(path), _) => Blade::Of(read(path, arguments.memory)?),
        (None, true) => Blade::Frame,
        (None, false) => Blade::Silhouette,
    };
    let threshold = match (arguments.level, arguments.threshold) {
        _ if arguments.mask => Threshold::Level(0.5),
        (Some(level), _) => Threshold::Level(level),
        (None, ThresholdKind::Otsu) => Threshold::Otsu { even_light: true },
        (None, ThresholdKind::OtsuPlain) => Threshold::Otsu { even_light: false },
        (None, ThresholdKind::Sauvola) => Threshold::Sauvola {
            window_px: arguments.window_px.unwrap_or(WINDOW_PX),
            k: arguments.sauvola_k.unwrap_or(SAUVOLA_K),
        },
    };
    Ok(Settings {
        mm_per_pixel: arguments.mm_per_pixel,
        blade,
        veins: if arguments.bright {
            Ink::Bright
        } else {
            Ink::Dark
        },
        threshold,
        smoothing_px: arguments.smoothing_px,
        spur_radii: arguments.spur_radii,
        crossing_radii: arguments.crossing_radii,
        speck_px: arguments.speck_px as usize,
        segment_mm: arguments.segment_mm,
        base_px: arguments.base.map(DVec2::from),
        apex_px: arguments.apex.map(DVec2::from),
    })
}

/// A picture as grey values, if there is memory to trace it.
fn read(path: &Path, allowed: Option<f64>) -> Result<Raster, Failure> {
    let (width, height) = scan::size(path).map_err(Failure::bad)?;
    let pixels = f64::from(width) * f64::from(height);
    needs::compare(
        "tracing",
        &[(BYTES_A_PIXEL * pixels, "the picture")],
        allowed,
    )?;
    let picture = scan::read_grey(path).map_err(Failure::bad)?;
    if picture.attribute(scan::MORE_PAGES).is_some() {
        eprintln!(
            "note: {}: only the first page is read, and the file has more",
            path.display()
        );
    }
    let values = picture.layers.into_iter().next();
    let values = values.map_or_else(Vec::new, |layer| layer.data);
    Raster::new(picture.width as usize, picture.height as usize, values).map_err(Failure::at(path))
}
