//! What makes the margin of a leaf that of a specimen: teeth, base, apex, tips, unlike sides.

use super::contents::changed_contents;
use crate::document::keys::{Keys, Variant};
use crate::document::limits::Limits;
use crate::document::value_kind::{Flag, Integer, Number, Word};
use crate::shape::specimen::{ApexShape, Asymmetry, BaseShape, Specimen, SpecimenError};
use crate::shape::teeth::{TeethError, ToothForm, ToothWave};
use crate::shape::tips::{Gland, Point, Tip};
use crate::variant;

const FORMS: [(&str, ToothForm); 3] = [
    ("triangular", ToothForm::Triangular),
    ("crenate", ToothForm::Crenate),
    ("spinose", ToothForm::Spinose),
];

/// The kinds of tips.
const TIPS: [Variant<Tip>; 3] = [
    variant!("gland", Tip::Gland, gland, "A knob."),
    variant!("mucro", Tip::Mucro, point, "A short point, set off."),
    variant!("awn", Tip::Awn, point, "A bristle."),
];

/// The kinds of bases.
const BASES: [Variant<BaseShape>; 3] = [
    Variant {
        name: "cordate",
        about: "A sinus at the petiole.",
        new: || BaseShape::Cordate {
            depth: 0.08,
            width: 0.3,
        },
        is: |base| matches!(base, BaseShape::Cordate { .. }),
        declare: |base, keys| {
            if let BaseShape::Cordate { depth, width } = base {
                let limits = Number(Limits::closed(0.005, 0.5));
                let about = "How far lobes reach below the petiole, as a share of the length.";
                keys.key("depth", depth, limits, about);
                wide(width, keys, "Width of the sinus at the ends of the lobes.");
            }
        },
    },
    Variant {
        name: "cuneate",
        about: "A wedge.",
        new: || BaseShape::Cuneate {
            height: 0.1,
            width: 0.3,
        },
        is: |base| matches!(base, BaseShape::Cuneate { .. }),
        declare: |base, keys| {
            if let BaseShape::Cuneate { height, width } = base {
                let limits = Number(Limits::closed(0.005, 0.4));
                let about = "By how much the margin is raised at the upper end of the wedge.";
                keys.key("height", height, limits, about);
                wide(width, keys, "Width of the wedge at its upper end.");
            }
        },
    },
    Variant {
        name: "peltate",
        about: "The petiole is attached inside the blade.",
        new: || BaseShape::Peltate { inset: 0.2 },
        is: |base| matches!(base, BaseShape::Peltate { .. }),
        declare: |base, keys| {
            if let BaseShape::Peltate { inset } = base {
                let limits = Number(Limits::closed(0.005, 0.5));
                let about = "How far the blade reaches below the petiole.";
                keys.key("inset", inset, limits, about);
            }
        },
    },
];

/// The kinds of apices.
const APICES: [Variant<ApexShape>; 4] = [
    Variant {
        name: "acuminate",
        about: "Drawn out into a drip tip.",
        new: || ApexShape::Acuminate {
            length: 0.15,
            narrowing: 0.6,
        },
        is: |apex| matches!(apex, ApexShape::Acuminate { .. }),
        declare: |apex, keys| {
            if let ApexShape::Acuminate { length, narrowing } = apex {
                let limits = Number(Limits::closed(0.02, 0.6));
                let about = "Length of the tip, as a share of the leaf's.";
                keys.key("length", length, limits, about);
                let limits = Number(Limits::closed(0.05, 0.95));
                let about = "Share by which its end is narrower than the contour's.";
                keys.key("narrowing", narrowing, limits, about);
            }
        },
    },
    Variant {
        name: "emarginate",
        about: "A notch.",
        new: || ApexShape::Emarginate {
            depth: 0.08,
            width: 0.3,
        },
        is: |apex| matches!(apex, ApexShape::Emarginate { .. }),
        declare: |apex, keys| {
            if let ApexShape::Emarginate { depth, width } = apex {
                let limits = Number(Limits::closed(0.05, 0.4));
                notch(depth, width, limits, keys);
            }
        },
    },
    Variant {
        name: "retuse",
        about: "A shallow notch.",
        new: || ApexShape::Retuse {
            depth: 0.02,
            width: 0.2,
        },
        is: |apex| matches!(apex, ApexShape::Retuse { .. }),
        declare: |apex, keys| {
            if let ApexShape::Retuse { depth, width } = apex {
                let limits = Number(Limits::closed(0.002, 0.05));
                notch(depth, width, limits, keys);
            }
        },
    },
    variant!(
        "mucronate",
        ApexShape::Mucronate,
        point,
        "A short point, in which the midrib ends."
    ),
];

fn gland(gland: &mut Gland, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(1e-4, 0.05));
    let about = "Its diameter, as a share of the leaf's length.";
    keys.key("diameter", &mut gland.diameter, limits, about);
    keys.block("contents", "What it holds.", |keys| {
        changed_contents(&mut gland.contents, keys);
    });
}

fn point(point: &mut Point, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(1e-4, 0.2));
    let about = "How far it stands out, as a share of the leaf's length.";
    keys.key("length", &mut point.length, limits, about);
    let limits = Number(Limits::closed(1e-4, 0.1));
    let about = "Width of its foot, likewise.";
    keys.key("width", &mut point.width, limits, about);
}

fn wide(width: &mut f64, keys: &mut Keys<'_>, about: &'static str) {
    keys.key("width", width, Number(Limits::closed(0.02, 2.0)), about);
}

fn notch(depth: &mut f64, width: &mut f64, limits: Number, keys: &mut Keys<'_>) {
    let about = "How far the apex lies below the ends beside it, as a share of the length.";
    keys.key("depth", depth, limits, about);
    wide(width, keys, "Width of the notch between these ends.");
}

fn tip(tip: &mut Tip, keys: &mut Keys<'_>) {
    keys.kind(tip, &TIPS);
}

fn usual_tip() -> Tip {
    Tip::Mucro(Point::default())
}

/// The keys of a wave of teeth.
pub(super) fn teeth(wave: &mut ToothWave, keys: &mut Keys<'_>) {
    let share = Number(Limits::closed(0.0, 1.0));
    let count = Integer::within(1, 1000);
    keys.required(
        "per_side",
        &mut wave.per_side,
        count,
        "Teeth between base and apex, equally long along the margin.",
    );
    let limits = Number(Limits::closed(1e-6, 0.5));
    keys.required(
        "height",
        &mut wave.height,
        limits,
        "How far they stand out, as a share of the leaf's length.",
    );
    let limits = Number(Limits::closed(-1.0, 1.0));
    let about = "0 even triangles, 1 saw teeth that point to the apex, −1 to the base.";
    keys.key("lean", &mut wave.lean, limits, about);
    let about = "Share of the side from the base over which teeth rise to their height.";
    keys.key("fade_base", &mut wave.fade_base, share, about);
    let about = "Share of the side up to the apex over which they fall off.";
    keys.key("fade_apex", &mut wave.fade_apex, share, about);
    let about = "How their flanks run: straight, bulging, or hollow and drawn out into a spine.";
    keys.key("form", &mut wave.form, Word(&FORMS), about);
    let limits = || Number(Limits::closed(0.0, 0.5));
    let about = "Coefficient of variation of their lengths along the margin.";
    keys.key("spacing_cv", &mut wave.spacing_cv, limits(), about);
    let about = "Coefficient of variation of their heights.";
    keys.key("height_cv", &mut wave.height_cv, limits(), about);
    let about = "Whether they stand on the teeth of the wave before, as many on each.";
    keys.key("nested", &mut wave.nested, Flag, about);
    let about = "What ends each of them.";
    keys.optional_block("tip", &mut wave.tip, usual_tip, about, tip);
}

/// The keys of `outline` that bend any contour into that of a specimen.
pub(super) fn specimen(specimen: &mut Specimen, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(0.2, 5.0));
    let about = "Factor on the width of the contour.";
    keys.key("breadth", &mut specimen.breadth, limits, about);
    let about = "The base, where it is not the contour's.";
    let new = BASES[0].new;
    keys.optional_block("base", &mut specimen.base, new, about, |base, keys| {
        keys.kind(base, &BASES);
    });
    let limits = Number(Limits::closed(-0.3, 0.3));
    let about = "How much lower the right half of the blade begins than the left, as a share of \
        the length.";
    keys.key("oblique", &mut specimen.oblique, limits, about);
    let about = "The apex, where it is not the contour's.";
    let new = APICES[0].new;
    keys.optional_block("apex", &mut specimen.apex, new, about, |apex, keys| {
        keys.kind(apex, &APICES);
    });
    let about = "How left and right differ by chance.";
    keys.block("asymmetry", about, |keys| {
        let Asymmetry { width, bow, wander } = &mut specimen.asymmetry;
        let limits = Number(Limits::closed(0.0, 0.2));
        let about = "Standard deviation of (right − left) / (right + left) of the widths beside \
            the midrib.";
        keys.key("width", width, limits, about);
        let limits = Number(Limits::closed(0.0, 0.1));
        let about = "Standard deviation of how far the middle of the blade lies beside the line \
            from base to apex, over that line's length.";
        keys.key("bow", bow, limits, about);
        let limits = Number(Limits::closed(0.0, 0.02));
        let about = "How far places of the margin wander, as a share of the length.";
        keys.key("wander", wander, limits, about);
    });
    let about = "What ends pointed lobes and the apex.";
    keys.optional_block("lobe_tip", &mut specimen.lobe_tip, usual_tip, about, tip);
}

/// How to mend teeth.
pub(super) fn teeth_help(error: &TeethError) -> &'static str {
    match error {
        TeethError::NotNested { .. } => {
            "let per_side be a multiple of that of the wave before, or leave `nested` out"
        }
        TeethError::OutOfRange { .. }
        | TeethError::TooManyWaves { .. }
        | TeethError::NoSides
        | TeethError::NoMargin(_) => "make the teeth lower, or fewer",
    }
}

/// The key to change, and how, where a contour cannot have a base or apex.
pub(super) fn help(error: &SpecimenError) -> (&'static [&'static str], &'static str) {
    match error {
        SpecimenError::DeeperAlready { .. } => (
            &["outline", "base", "cordate", "depth"],
            "ask for a deeper sinus, or leave the base to the contour",
        ),
        SpecimenError::TooPointed { end: "base", .. } => (
            &["outline", "base", "cordate", "depth"],
            "ask for a shallower or wider sinus, or a contour with a rounder base",
        ),
        SpecimenError::TooPointed { .. } => (
            &["outline", "apex", "*", "depth"],
            "ask for a shallower or wider notch, or a contour with a rounder apex",
        ),
        SpecimenError::OutOfRange { .. } => (&["outline"], "keep to the range"),
        SpecimenError::NoMargin(_) => (&["outline", "asymmetry"], "ask for smaller differences"),
    }
}
