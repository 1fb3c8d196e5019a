//! `mosaic.controls.NAME`: an image wrapped round a cylinder that steers cells.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::named_asset::{asset, bad_file};
use crate::document::sections::Names;
use crate::document::value_kind::{Integer, Number, Text, Vector, Word};
use crate::document::values::text_at;
use crate::mosaic::control::{ControlImage, CylinderControl, Steered};

const SHARE: Number = Number(Limits::closed(0.0, 1.0));
const FACTOR: Number = Number(Limits::closed(0.0, 1000.0));
const COORDINATES_MM: Vector = Vector(Limits::closed(-1e6, 1e6));
const IMAGES: [&str; 5] = ["picture", "stripes", "rings", "noise", "constant"];

/// A control of which nothing is said.
pub(super) fn usual() -> CylinderControl {
    CylinderControl {
        from: glam::DVec3::ZERO,
        to: glam::DVec3::ZERO,
        radius_mm: None,
        image: ControlImage::Constant(0.0),
        steers: Steered::Blocked,
    }
}

/// The keys of a control; `types` are the names of the cell types.
pub(super) fn control(control: &mut CylinderControl, keys: &mut Keys<'_>, types: &[String]) {
    let about = "Where the axis starts.";
    keys.required("from_mm", &mut control.from, COORDINATES_MM, about);
    let about = "Where the axis ends.";
    keys.required("to_mm", &mut control.to, COORDINATES_MM, about);
    let has_axis = keys.is_sound();
    let limits = Number(Limits::above(0.0, 1e6));
    let about = "Radius of the cylinder; left out, all between its ends.";
    keys.optional("radius_mm", &mut control.radius_mm, limits, about);
    image(&mut control.image, keys);
    steered(&mut control.steers, keys, types);
    if has_axis && control.from == control.to {
        let problem = "the axis has no length: it ends where it starts";
        let help = "let the axis run through the body from end to end";
        keys.refuse(&["to_mm"], problem.to_owned(), help);
    }
}

#[derive(Clone, Copy, PartialEq)]
enum What {
    InitialType,
    DivisionRate,
    Adhesion,
    Blocked,
}

fn steered(steers: &mut Steered, keys: &mut Keys<'_>, types: &[String]) {
    const WORDS: [(&str, What); 4] = [
        ("initial_type", What::InitialType),
        ("division_rate", What::DivisionRate),
        ("adhesion", What::Adhesion),
        ("blocked", What::Blocked),
    ];
    let (mut what, [mut kind, mut other], [mut low, mut high]) = match *steers {
        Steered::InitialType(kind) => (What::InitialType, [Some(kind), None], [0.0, 1.0]),
        Steered::DivisionRate { kind, low, high } => {
            (What::DivisionRate, [kind, None], [low, high])
        }
        Steered::Adhesion { pair, low, high } => (What::Adhesion, pair.map(Some), [low, high]),
        Steered::Blocked => (What::Blocked, [None; 2], [0.0, 1.0]),
    };
    let errors = keys.reader().map(|block| block.cx.error_count());
    let about = "What its grey values steer.";
    keys.required("steers", &mut what, Word(&WORDS), about);
    if keys.reader().is_some_and(|block| {
        Some(block.cx.error_count()) != errors || block.table.get("steers").is_none()
    }) {
        // Which keys belong here cannot be said.
        keys.leave(&["type", "other_type", "low", "high"]);
        return;
    }
    let all = keys.is_description();
    let named = matches!(what, What::InitialType | What::Adhesion);
    if all || what != What::Blocked {
        let about = "The type of cell; for `division_rate` left out, all.";
        type_of(&mut kind, keys, "type", types, named, about);
    }
    if all || what == What::Adhesion {
        let about = "The other type of cell, for `adhesion`.";
        type_of(&mut other, keys, "other_type", types, true, about);
    }
    if all || matches!(what, What::DivisionRate | What::Adhesion) {
        keys.key("low", &mut low, FACTOR, "Factor where the image is black.");
        keys.key("high", &mut high, FACTOR, "Factor where it is white.");
    }
    let kind_or_first = kind.unwrap_or_default();
    *steers = match what {
        What::InitialType => Steered::InitialType(kind_or_first),
        What::DivisionRate => Steered::DivisionRate { kind, low, high },
        What::Adhesion => Steered::Adhesion {
            pair: [kind_or_first, other.unwrap_or_default()],
            low,
            high,
        },
        What::Blocked => Steered::Blocked,
    };
}

/// The number of a type of cell by its name.
fn type_of(
    kind: &mut Option<u16>,
    keys: &mut Keys<'_>,
    key: &'static str,
    types: &[String],
    required: bool,
    about: &'static str,
) {
    const NAME: Text = Text("the name of a type");
    let mut name = kind.and_then(|kind| types.get(usize::from(kind)).cloned());
    if required && !keys.is_description() {
        let mut text = name.take().unwrap_or_default();
        keys.required(key, &mut text, NAME, about);
    } else {
        keys.optional(key, &mut name, NAME, about);
    }
    let Some(block) = keys.reader() else {
        return;
    };
    if let Some(entry) = block.table.get(key) {
        let names = Names::of_list("type of cell", types.iter().map(String::as_str));
        let written = text_at(block.cx, &entry.node, key);
        let found = written.and_then(|written| names.find(block.cx, written));
        *kind = found.map(|index| index as u16);
    }
}

fn image(image: &mut ControlImage, keys: &mut Keys<'_>) {
    let current = kind_of(image);
    let has_base = keys.base().is_some();
    for kind in keys.one_of(&IMAGES, Some(current)) {
        if kind != kind_of(image) || (keys.reader().is_some() && !has_base) {
            *image = usual_image(kind);
        }
        match (kind, image.clone()) {
            ("constant", ControlImage::Constant(mut value)) => {
                keys.required("constant", &mut value, SHARE, "The same value everywhere.");
                *image = ControlImage::Constant(value);
            }
            (kind, _) => {
                let about = match kind {
                    "picture" => "The grey of a PNG.",
                    "stripes" => {
                        "`count`, `share` (0.5), `waviness` (0), `bends` (4), `seed` \
                        (0): along the axis."
                    }
                    "rings" => "`count`, `share` (0.5): about it.",
                    _ => "Noise.",
                };
                keys.required_block(kind, about, &[], |keys| drawn(image, keys));
            }
        }
    }
}

fn kind_of(image: &ControlImage) -> &'static str {
    match image {
        ControlImage::Constant(_) => "constant",
        ControlImage::Picture { .. } => "picture",
        ControlImage::Stripes { .. } => "stripes",
        ControlImage::Rings { .. } => "rings",
        ControlImage::Noise { .. } => "noise",
    }
}

fn usual_image(kind: &str) -> ControlImage {
    match kind {
        "picture" => ControlImage::Picture {
            file: String::new(),
            width: 1,
            height: 0,
            values: Vec::new(),
        },
        "stripes" => ControlImage::Stripes {
            count: 1,
            share: 0.5,
            waviness: 0.0,
            bends: 4.0,
            seed: 0,
        },
        "rings" => ControlImage::Rings {
            count: 1,
            share: 0.5,
        },
        "noise" => ControlImage::Noise {
            around: 1,
            octaves: 1,
            threshold: None,
            seed: 0,
        },
        _ => ControlImage::Constant(0.0),
    }
}

fn drawn(image: &mut ControlImage, keys: &mut Keys<'_>) {
    const COUNT: Integer<u32> = Integer::within(1, 10_000);
    const SEED: Integer<u64> = Integer::within(0, u64::MAX);
    match image {
        ControlImage::Constant(_) => {}
        ControlImage::Picture {
            file,
            width,
            height,
            values,
        } => {
            let before = file.clone();
            keys.required("path", file, Text("the path of a PNG file"), "The picture.");
            if *file != before
                && keys.is_sound()
                && let Some((assets, found, at)) = asset(keys, "path", &["png"])
            {
                match assets.weights(&found) {
                    Ok(raster) => {
                        *width = raster.width;
                        *height = raster.values.len() / raster.width.max(1);
                        *values = raster.values.into_iter().map(f64::from).collect();
                    }
                    Err(error) => {
                        if let Some(block) = keys.reader() {
                            let problem = format!("cannot be read: {error}");
                            bad_file(block.cx, &at, file, &problem, "save it anew as a PNG");
                        }
                    }
                }
            }
        }
        ControlImage::Stripes {
            count,
            share,
            waviness,
            bends,
            seed,
        } => {
            keys.required("count", count, COUNT, "Stripes around.");
            keys.key("share", share, SHARE, "Share of the width that is white.");
            let room = Number(Limits::closed(0.0, (1.0 - *share) / 2.0));
            let about = "How far they wander, in distances of stripes.";
            keys.key("waviness", waviness, room, about);
            let limits = Number(Limits::closed(0.0, 1000.0));
            keys.key("bends", bends, limits, "Bends from end to end.");
            keys.key("seed", seed, SEED, "Seed of the bends.");
        }
        ControlImage::Rings { count, share } => {
            keys.required("count", count, COUNT, "Rings from end to end.");
            keys.key("share", share, SHARE, "Share of the height that is white.");
        }
        ControlImage::Noise {
            around,
            octaves,
            threshold,
            seed,
        } => {
            keys.required("around", around, COUNT, "Patches around.");
            let few = Integer::within(1, 10);
            keys.key("octaves", octaves, few, "Octaves of ever finer patches.");
            let about = "Noise above it is white, below black; left out, grey.";
            keys.optional("threshold", threshold, SHARE, about);
            keys.key("seed", seed, SEED, "Seed of the noise.");
        }
    }
}
