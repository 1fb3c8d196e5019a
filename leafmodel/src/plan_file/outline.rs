//! `outline`: the margin of a leaf.

use std::fs;

use crate::document::context::{Context, QUOTED};
use crate::document::declared::Declared;
use crate::document::encoding::decoded;
use crate::document::keys::{BlockList, Keys, Variant};
use crate::document::limits::Limits;
use crate::document::named_asset::bad_file;
use crate::document::path::{Wanted, resolve};
use crate::document::source::{Place, escaped};
use crate::document::value_kind::{Numbers, Text};
use crate::document::values::text_at;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::shape::contour_curve::ContourCurve;
use crate::shape::growth_form::GrowthForm;
use crate::shape::outline::Outline;
use crate::shape::specimen::Specimen;
use crate::shape::svg_path::{SvgContour, SvgReading};
use crate::shape::teeth::ToothWave;
use crate::variant;

/// The kinds of contour.
pub(super) const KINDS: [Variant<Contour>; 6] = [
    Variant {
        name: "growth_algorithm",
        about: "Local growth rates bring it forth.",
        new: || Contour::GrowthAlgorithm(GrowthForm::default()),
        is: |contour| matches!(contour, Contour::GrowthAlgorithm(_)),
        declare: |contour, keys| {
            if let Contour::GrowthAlgorithm(form) = contour {
                form.declare(keys);
            }
        },
    },
    Variant {
        name: "curve",
        about: "A smooth curve through points.",
        new: || {
            Contour::Curve(ContourCurve {
                points: Vec::new(),
                mirrored: true,
            })
        },
        is: |contour| matches!(contour, Contour::Curve(_)),
        declare: |contour, keys| {
            if let Contour::Curve(curve) = contour {
                curve.declare(keys);
            }
        },
    },
    Variant {
        name: "svg",
        about: "A path of an SVG file.",
        new: || {
            Contour::Svg(SvgContour {
                file: String::new(),
                id: None,
                points: Vec::new(),
                base: [0.0; 2],
                apex: [0.0; 2],
            })
        },
        is: |contour| matches!(contour, Contour::Svg(_)),
        declare: |contour, keys| {
            if let Contour::Svg(svg) = contour {
                declare_svg(svg, keys);
            }
        },
    },
    variant!(
        "cubic",
        Contour::Cubic,
        Declared::declare,
        "Two cubic splines."
    ),
    variant!(
        "transport",
        Contour::Transport,
        Declared::declare,
        "A leaf that grows as the cheapest transport network."
    ),
    variant!(
        "development",
        Contour::Development,
        Declared::declare,
        "A leaf that develops from its margin."
    ),
];

/// The keys of `outline`.
pub(super) fn outline(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let waves = BlockList {
        most: 20,
        new: &ToothWave::default,
        wanted: "a list of at most 20 waves, such as { per_side = 20, height = 0.02 }",
        is_inside_itself: false,
    };
    let about = "Waves of teeth along the margin.";
    keys.blocks(
        "teeth",
        &mut plan.outline.teeth,
        &waves,
        about,
        ToothWave::declare,
    );
    // A contour of another kind than the preset's is not bent as that was.
    let is_other =
        |kind: &Variant<Contour>| keys.has(kind.name) && !(kind.is)(&plan.outline.contour);
    if KINDS.iter().any(is_other) {
        plan.outline.specimen = Specimen::default();
    }
    plan.outline.specimen.declare(keys);
    keys.kind(&mut plan.outline.contour, &KINDS);
}

fn declare_svg(contour: &mut SvgContour, keys: &mut Keys<'_>) {
    // Coordinates of the file.
    let place = || Numbers(Limits::closed(-1e9, 1e9));
    let before = contour.clone();
    let path = Text("the path of an SVG file");
    keys.required("path", &mut contour.file, path, "The file.");
    let about = "`id` of the path.";
    keys.optional("id", &mut contour.id, Text("the `id` of a path"), about);
    if keys.is_sound() && (contour.file != before.file || contour.id != before.id) {
        *contour = read_svg(contour, keys).unwrap_or(before);
    }
    let [base, apex] = if contour.points.is_empty() {
        [[0.0; 2]; 2]
    } else {
        SvgContour::ends_of(&contour.points)
    };
    for (key, end, usual, about) in [
        (
            "base",
            &mut contour.base,
            base,
            "Where the petiole is attached, `[x, y]` in the coordinates of the file (y down).",
        ),
        ("apex", &mut contour.apex, apex, "Where the midrib ends."),
    ] {
        let mut given = (*end != usual).then_some(*end);
        keys.optional(key, &mut given, place(), about);
        *end = given.unwrap_or(usual);
    }
}

fn read_svg(named: &SvgContour, keys: &Keys<'_>) -> Option<SvgContour> {
    const WANTED: Wanted = Wanted {
        endings: &["svg"],
        most_bytes: 16 << 20,
    };
    let block = keys.reader()?;
    let (path, at) = text_at(block.cx, block.node("path")?, "path")?;
    let file = resolve(block.cx, path, at, WANTED)?;
    let text = fs::read(file)
        .map_err(|error| format!("cannot be read: {error}"))
        .and_then(|bytes| {
            let decoded = decoded(&bytes).map_err(|error| error.to_string())?;
            Ok(decoded.text.into_owned())
        })
        .map_err(|problem| {
            (
                problem,
                "make it a readable text file, in UTF-8 for example",
            )
        });
    let parsed = text.and_then(|text| {
        let reading = SvgContour::read(path, &text, named.id.as_deref());
        reading.map_err(|error| (error.to_string(), error.help()))
    });
    match parsed {
        Ok(reading) => {
            warn_of_guesses(block.cx, at, &reading);
            Some(reading.contour)
        }
        Err((problem, help)) => {
            bad_file(block.cx, at, path, &problem, help);
            None
        }
    }
}

/// Least gap between the ends of a path, as a share of its extent, that is no rounding.
const GAP: f64 = 1e-3;

/// Tells what was done to a drawing to have a contour.
fn warn_of_guesses(cx: &Context, at: &Place, reading: &SvgReading) {
    let path = escaped(&reading.contour.file, 2 * QUOTED);
    if reading.passed_over > 0 {
        let message = format!(
            "\"{path}\" has {} paths that are drawn, of which the first is taken",
            reading.passed_over + 1
        );
        let help = "name the margin's path by its `id`";
        cx.warn(at, "scene::first_path", message, help);
    }
    if !reading.left_out.is_empty() {
        let message = format!(
            "of \"{path}\" the following is left out: {}",
            escaped(&reading.left_out.join("; "), 8 * QUOTED)
        );
        let help = "name the margin's path by its `id` if another one is meant";
        cx.warn(at, "scene::left_out_of_drawing", message, help);
    }
    if reading.gap > GAP {
        let message = format!(
            "the path in \"{path}\" is open; a straight line over {:.2} of its extent closes it",
            reading.gap
        );
        let help = "close the path in the drawing program if the margin goes on there";
        cx.warn(at, "scene::open_path", message, help);
    }
}

/// The outline at a length of 1 mm, or a report of why there is none; `keys` are the leaf's.
pub(super) fn tried(plan: &LeafPlan, keys: &Keys<'_>) -> Option<Outline> {
    match plan.outline.grow(1.0, plan.seed) {
        Ok(grown) => Some(grown),
        Err(error) => {
            error.report(keys);
            None
        }
    }
}
