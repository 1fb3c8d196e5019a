//! What is measured: files of networks, their margins, and which of them are understood.

use std::path::Path;

use leafmodel::import::{self, Draft, Fault, FaultKind, Format, ImportError, Imported, Wanted};
use leafmodel::measure::{Blade, Known};
use leafmodel::shape::outline::Outline;
use leafmodel::tracing::{Finding, FindingKind};
use leafmodel::venation::network::VenationNetwork;

use crate::cli::arguments::{MeasureArguments, ReadingArguments, TableArguments};
use crate::cli::terminal::Failure;
use crate::cli::texts::text_of;
use crate::cli::trace;
use crate::report::tracing::note_on_length;

/// Endings of pictures, which are no networks; the first [`READ`] of them can be traced.
const PICTURES: [&str; 8] = ["png", "tif", "tiff", "jpg", "jpeg", "bmp", "webp", "exr"];

/// How many of them can be.
const READ: usize = 5;

/// A network that is ready to be measured.
#[derive(Debug)]
pub(in crate::cli) struct Input {
    pub(in crate::cli) network: VenationNetwork,
    pub(in crate::cli) outlines: Vec<Outline>,
    pub(in crate::cli) known: Known,
    pub(in crate::cli) orders_found: bool,
    pub(in crate::cli) faults: Vec<Fault>,
}

/// How a file becomes a network.
enum InputKind {
    /// It holds one.
    Network(Format),
    /// It shows one.
    Picture,
}

impl InputKind {
    fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path
            .extension()
            .and_then(|ending| ending.to_str())
            .unwrap_or_default();
        if let Some(format) = Format::of_ending(ending) {
            return Ok(Self::Network(format));
        }
        if PICTURES
            .iter()
            .any(|picture| ending.eq_ignore_ascii_case(picture))
        {
            return Ok(Self::Picture);
        }
        let shown = path.display();
        Err(bad!(
            "{shown}: the ending tells the format of a network: {}; or of a picture: {}",
            MeasureArguments::endings(),
            PICTURES[..READ].join(", ")
        ))
    }
}

impl Input {
    /// Reads a network, or traces a picture; with `strict`, fails if anything is wrong with it.
    pub(in crate::cli) fn read(path: &Path, arguments: &ReadingArguments) -> Result<Self, Failure> {
        match InputKind::of(path)? {
            InputKind::Network(format) => Self::of_network(path, arguments, format),
            InputKind::Picture => Self::of_picture(path, arguments),
        }
    }

    /// What is known of the blade, where `area` may say how large it is.
    pub(in crate::cli) fn blade(&self, area: Option<f64>) -> Blade<'_> {
        Blade::of(&self.outlines, area)
    }

    /// What a person should know of it: faults, and what could not be understood.
    pub(in crate::cli) fn remarks(&self, blade: Blade) -> Vec<String> {
        let told = |fault: &Fault| {
            let word = if fault.kind.is_note() {
                "note"
            } else {
                "warning"
            };
            format!("{word}: {}", fault.line())
        };
        let mut remarks: Vec<String> = self.faults.iter().map(told).collect();
        let places = self.network.nodes().iter().map(|node| node.position);
        remarks.extend(note_on_length(places, "--mm-per-unit"));
        let mut note = |text: &str| remarks.push(format!("note: {text}"));
        let is_reported = |fault: &Fault| fault.kind == FaultKind::NoRadius;
        if !self.known.radii && !self.faults.iter().any(is_reported) {
            note(
                "edges have no radius or width: measures of widths, and of vein orders that are \
                 not in the file, are missing",
            );
        }
        if self.orders_found {
            note("vein orders are not in the file; they are found from widths and branching");
        }
        match blade {
            Blade::Margin(_) => {}
            Blade::Area(_) => {
                note("without a margin, measures of the shape and distances to veins are missing");
            }
            Blade::Unknown => note(
                "without a margin (--outline FILE.svg) or an area (--area MM2), measures of the \
                 shape, per area, and distances to veins are missing",
            ),
        }
        remarks
    }

    /// The network that a picture shows, traced with the usual settings.
    fn of_picture(path: &Path, arguments: &ReadingArguments) -> Result<Self, Failure> {
        let shown = path.display();
        let Some(mm_per_pixel) = arguments.mm_per_unit else {
            bail!(
                "{shown}: a picture is measured with --mm-per-pixel, which is 25.4 over the dots \
                 per inch of a scan"
            );
        };
        let foreign = [
            ("--nodes", arguments.nodes.is_some()),
            ("--outline", arguments.outline.is_some()),
            ("--area", arguments.area.is_some()),
            ("--root", arguments.root.is_some()),
            ("--y-down", arguments.y_down),
            ("--separator", arguments.form.separator.is_some()),
            ("--decimal", arguments.form.decimal.is_some()),
        ];
        if let Some((flag, _)) = foreign.into_iter().find(|(_, given)| *given) {
            bail!("{shown}: {flag} goes with a network; lamina trace has flags for pictures");
        }
        let traced = trace::with_usual_settings(path, mm_per_pixel)?;
        let wrong = traced.findings.iter().filter(|finding| is_fault(finding));
        forbid(path, arguments, wrong.map(ToString::to_string))?;
        Ok(Self {
            network: traced.network,
            outlines: vec![traced.outline],
            known: Known::ALL,
            orders_found: true,
            faults: Vec::new(),
        })
    }

    fn of_network(
        path: &Path,
        arguments: &ReadingArguments,
        format: Format,
    ) -> Result<Self, Failure> {
        if arguments.nodes.is_some() && format != Format::Table {
            bail_at!(path, "--nodes goes with a table of edges, a csv or tsv");
        }
        if arguments.form != TableArguments::default() && format != Format::Table {
            bail_at!(
                path,
                "--separator and --decimal go with a table, a csv or tsv"
            );
        }
        let nodes = arguments.nodes.as_deref().map(text_of).transpose()?;
        let text = text_of(path)?;
        let told = |error: ImportError| bad_at!(path, "{error}");
        let form = arguments.form.form();
        let draft = import::read_written(format, &text, nodes.as_deref(), form).map_err(told)?;
        drop((text, nodes));
        if arguments.area.is_some() && draft.has_margin() {
            bail_at!(
                path,
                "holds a margin, which gives the area: leave out --area"
            );
        }
        let own = arguments
            .outline
            .as_deref()
            .map(|path| margin(path, arguments))
            .transpose()?;
        let draft = match own {
            Some(own) => draft.within(own),
            None => draft,
        };
        let Imported {
            network,
            outlines,
            known,
            orders_found,
            faults,
        } = draft.network(&wanted(arguments)).map_err(told)?;
        let wrong = faults.iter().filter(|fault| !fault.kind.is_note());
        forbid(path, arguments, wrong.map(Fault::line))?;
        Ok(Self {
            network,
            outlines,
            known,
            orders_found,
            faults,
        })
    }
}

/// With `--strict`, fails if there is any of these lines about faults.
fn forbid(
    path: &Path,
    arguments: &ReadingArguments,
    wrong: impl Iterator<Item = String>,
) -> Result<(), Failure> {
    let lines: String = wrong.map(|line| format!("\n  {line}")).collect();
    if !arguments.strict || lines.is_empty() {
        return Ok(());
    }
    let file = path.display();
    Err(bad!(
        "{file}: is not without fault, as --strict asks:{lines}"
    ))
}

/// Whether what tracing found may make measures wrong.
fn is_fault(finding: &Finding) -> bool {
    match finding.kind {
        FindingKind::Apart { .. } | FindingKind::Thin { .. } => true,
        FindingKind::Specks { .. }
        | FindingKind::Holes { .. }
        | FindingKind::Spurs { .. }
        | FindingKind::Crossings { .. }
        | FindingKind::Petiole
        | FindingKind::BaseGuessed { .. }
        | FindingKind::Moved { .. } => false,
    }
}

fn wanted(arguments: &ReadingArguments) -> Wanted {
    Wanted {
        mm_per_unit: arguments.mm_per_unit,
        root: arguments.root.map(Into::into),
        y_down: arguments.y_down,
    }
}

/// The margin in a file of its own.
fn margin(path: &Path, arguments: &ReadingArguments) -> Result<Outline, Failure> {
    let shown = path.display();
    let format = match InputKind::of(path)? {
        InputKind::Network(format @ (Format::Svg | Format::Json)) => format,
        InputKind::Network(Format::GraphMl | Format::Table | Format::Gml | Format::Neighbours)
        | InputKind::Picture => {
            bail!("{shown}: a margin is read from svg, json or geojson");
        }
    };
    let told = |error: ImportError| bad!("{shown}: {error}");
    let text = text_of(path)?;
    let draft: Draft = import::read_margin(format, &text).map_err(told)?;
    let wanted = wanted(arguments);
    let mut outlines = draft.outlines(&wanted).map_err(told)?;
    match (outlines.len(), outlines.pop()) {
        (1, Some(outline)) => Ok(outline),
        (count, _) => Err(bad!("{shown}: holds {count} margins; name a file with one")),
    }
}
