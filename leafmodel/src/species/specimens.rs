//! What the margins of the species' presets have that drawn contours lack: unlike sides, teeth that
//! differ, tips.
//!
//! Kinds (double teeth, glands, bristles, drawn-out or notched apices) are what floras say of the
//! species; amounts are by eye, and none was measured on a specimen. Presets that stand for a row
//! of Runions et al. 2005 keep their contours.

use crate::leaf::outline_plan::OutlinePlan;
use crate::shape::specimen::{ApexShape, Asymmetry, Specimen};
use crate::shape::teeth::{ToothForm, ToothWave};
use crate::shape::tips::{Gland, Point, Tip};

/// Sides that differ as those of most leaves do: 3 % of the width.
const USUAL: Asymmetry = Asymmetry {
    width: 0.03,
    bow: 0.008,
    wander: 0.004,
};

/// The same with lobes that stand at different heights to the left and to the right.
const LOBED: Asymmetry = Asymmetry {
    wander: 0.01,
    ..USUAL
};

/// A contour and its teeth as those of a specimen.
fn with(outline: OutlinePlan, asymmetry: Asymmetry, rest: Specimen) -> OutlinePlan {
    OutlinePlan {
        specimen: Specimen { asymmetry, ..rest },
        ..outline
    }
}

/// All waves of teeth changed.
fn toothed(outline: OutlinePlan, change: impl Fn(usize, ToothWave) -> ToothWave) -> OutlinePlan {
    let waves = outline.teeth.into_iter().enumerate();
    OutlinePlan {
        teeth: waves.map(|(i, wave)| change(i, wave)).collect(),
        ..outline
    }
}

/// Teeth of unequal length and height.
fn uneven(wave: ToothWave, spacing_cv: f64, height_cv: f64) -> ToothWave {
    ToothWave {
        spacing_cv,
        height_cv,
        ..wave
    }
}

fn drip_tip(length: f64, narrowing: f64) -> Specimen {
    Specimen {
        apex: Some(ApexShape::Acuminate { length, narrowing }),
        ..Specimen::default()
    }
}

/// Alike on both sides but for chance: entire leaves, and lobes without points.
pub(super) fn entire(outline: OutlinePlan) -> OutlinePlan {
    with(outline, USUAL, Specimen::default())
}

/// A dark gland of this diameter over the leaf's length.
fn gland(diameter: f64) -> Tip {
    Tip::Gland(Gland {
        diameter,
        ..Gland::default()
    })
}

/// A maple: lobes and their teeth are drawn out into fine points.
pub(super) fn maple(outline: OutlinePlan) -> OutlinePlan {
    let point = Point {
        length: 0.016,
        width: 0.014,
    };
    let drawn_out = Specimen {
        lobe_tip: Some(Tip::Mucro(point)),
        ..Specimen::default()
    };
    with(outline, LOBED, drawn_out)
}

/// Red oak: lobes and their teeth end in bristles.
pub(super) fn red_oak(outline: OutlinePlan) -> OutlinePlan {
    let bristle = Point {
        length: 0.009,
        width: 0.004,
    };
    let bristled = Specimen {
        lobe_tip: Some(Tip::Awn(bristle)),
        ..Specimen::default()
    };
    with(outline, USUAL, bristled)
}

/// Silver birch: double teeth, the lesser on the greater, and a drawn-out apex.
pub(super) fn birch(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |i, wave| ToothWave {
        nested: i > 0,
        ..uneven(wave, 0.1, if i > 0 { 0.25 } else { 0.15 })
    });
    with(outline, USUAL, drip_tip(0.17, 0.55))
}

/// Eastern cottonwood: coarse, rounded teeth that lean towards the apex, each with a gland.
pub(super) fn cottonwood(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |_, wave| ToothWave {
        form: ToothForm::Crenate,
        tip: Some(gland(0.004)),
        ..uneven(wave, 0.16, 0.2)
    });
    with(outline, USUAL, drip_tip(0.14, 0.3))
}

/// Quaking aspen: fine rounded teeth, each with a gland, and a short point.
pub(super) fn aspen(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |_, wave| ToothWave {
        form: ToothForm::Crenate,
        tip: Some(gland(0.003)),
        ..uneven(wave, 0.14, 0.2)
    });
    with(outline, USUAL, drip_tip(0.1, 0.3))
}

/// White willow: fine teeth, each with a gland, and a long point.
pub(super) fn willow(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |_, wave| ToothWave {
        tip: Some(gland(0.0022)),
        ..uneven(wave, 0.2, 0.2)
    });
    with(outline, USUAL, drip_tip(0.12, 0.3))
}

/// Nankin cherry: fine teeth, each with a gland, and a short drawn-out apex.
pub(super) fn cherry(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |_, wave| ToothWave {
        tip: Some(gland(0.004)),
        ..uneven(wave, 0.16, 0.2)
    });
    with(outline, USUAL, drip_tip(0.09, 0.2))
}

/// Teeth of unequal length and height on any contour: red maple, box elder.
pub(super) fn serrate(outline: OutlinePlan) -> OutlinePlan {
    let outline = toothed(outline, |_, wave| uneven(wave, 0.18, 0.22));
    with(outline, LOBED, Specimen::default())
}

/// Smoke tree: a rounded apex with a shallow notch.
pub(super) fn smoke_tree(outline: OutlinePlan) -> OutlinePlan {
    let notch = ApexShape::Retuse {
        depth: 0.012,
        width: 0.16,
    };
    let retuse = Specimen {
        apex: Some(notch),
        ..Specimen::default()
    };
    with(outline, USUAL, retuse)
}

/// Joseph's coat: the midrib ends in a short point.
pub(super) fn amaranth(outline: OutlinePlan) -> OutlinePlan {
    let mucro = ApexShape::Mucronate(Point {
        length: 0.012,
        width: 0.008,
    });
    let mucronate = Specimen {
        apex: Some(mucro),
        ..Specimen::default()
    };
    with(outline, USUAL, mucronate)
}
