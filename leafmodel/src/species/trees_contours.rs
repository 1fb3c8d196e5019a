//! Outlines of the trees and shrubs of `trees`, drawn by eye after the plants, not measured.

use super::contours::{curve, pointed, polar, teeth};
use crate::leaf::outline_plan::OutlinePlan;
use crate::shape::specimen::Specimen;
use crate::shape::teeth::ToothWave;

/// A maple's: five lobes about the petiole, each with shoulders and pointed teeth (Norway and sugar
/// maple).
pub(super) fn maple() -> OutlinePlan {
    let right = [
        (150.0, 0.10, false),
        (140.0, 0.26, false),
        (122.0, 0.44, true),
        (114.0, 0.40, false),
        (104.0, 0.47, true),
        (92.0, 0.44, false),
        (86.0, 0.40, false),
        (78.0, 0.50, false),
        (72.0, 0.66, true),
        (64.0, 0.64, false),
        (55.0, 0.90, true),
        (49.0, 0.70, false),
        (43.0, 0.73, true),
        (37.0, 0.55, false),
        (30.0, 0.44, false),
        (25.0, 0.52, false),
        (21.0, 0.70, true),
        (16.0, 0.68, false),
        (11.0, 0.82, true),
        (7.5, 0.80, false),
    ];
    lobed(&right)
}

/// An ivy's: five shallow lobes, a heart at the petiole.
pub(super) fn ivy() -> OutlinePlan {
    let right = [
        (158.0, 0.14, false),
        (142.0, 0.25, false),
        (124.0, 0.36, false),
        (114.0, 0.43, true),
        (102.0, 0.40, false),
        (91.0, 0.42, false),
        (79.0, 0.53, false),
        (66.0, 0.68, true),
        (55.0, 0.58, false),
        (42.0, 0.52, false),
        (30.0, 0.57, false),
        (16.0, 0.72, false),
        (7.0, 0.88, false),
    ];
    lobed(&right)
}

/// A contour about the petiole through places in polar coordinates, base and apex left out.
fn lobed(right: &[(f64, f64, bool)]) -> OutlinePlan {
    let mut places = vec![(0.0, 0.0)];
    let mut corners = vec![0];
    for &(degrees, radius, is_corner) in right {
        if is_corner {
            corners.push(places.len());
        }
        places.push(polar(degrees, radius));
    }
    corners.push(places.len());
    places.push((0.0, 1.0));
    curve(&places, &corners, true).into()
}

/// A white oak's: rounded lobes on both sides, widest above the middle.
pub(super) fn white_oak() -> OutlinePlan {
    let places = [
        (0.0, 0.0),
        (0.035, 0.06),
        (0.07, 0.14),
        (0.15, 0.20),
        (0.19, 0.25),
        (0.15, 0.285),
        (0.085, 0.30),
        (0.10, 0.345),
        (0.22, 0.42),
        (0.28, 0.49),
        (0.25, 0.535),
        (0.13, 0.535),
        (0.10, 0.56),
        (0.15, 0.62),
        (0.27, 0.71),
        (0.29, 0.77),
        (0.24, 0.80),
        (0.13, 0.775),
        (0.115, 0.80),
        (0.15, 0.86),
        (0.17, 0.93),
        (0.12, 0.965),
        (0.05, 0.965),
        (0.0, 1.0),
    ];
    curve(&places, &[0], true).into()
}

/// A red oak's: lobes with bristle-pointed teeth.
pub(super) fn red_oak() -> OutlinePlan {
    let places = [
        (0.0, 0.0),
        (0.04, 0.05),
        (0.10, 0.10),
        (0.16, 0.145),
        (0.21, 0.20),
        (0.14, 0.215),
        (0.085, 0.25),
        (0.12, 0.31),
        (0.21, 0.345),
        (0.33, 0.43),
        (0.27, 0.46),
        (0.29, 0.52),
        (0.20, 0.50),
        (0.11, 0.50),
        (0.10, 0.53),
        (0.15, 0.58),
        (0.25, 0.62),
        (0.34, 0.72),
        (0.26, 0.72),
        (0.25, 0.78),
        (0.17, 0.735),
        (0.095, 0.74),
        (0.085, 0.77),
        (0.12, 0.82),
        (0.19, 0.91),
        (0.115, 0.89),
        (0.06, 0.91),
        (0.0, 1.0),
    ];
    curve(&places, &[0, 4, 9, 11, 17, 19, 24, 27], true).into()
}

/// An eastern cottonwood's: a triangle as wide as long with a cut-off base, coarse leaning teeth
/// and a drawn-out tip.
pub(super) fn cottonwood() -> OutlinePlan {
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.17, -0.012),
            (0.36, 0.02),
            (0.47, 0.11),
            (0.465, 0.22),
            (0.37, 0.41),
            (0.235, 0.61),
            (0.115, 0.79),
            (0.04, 0.91),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![ToothWave {
            per_side: 24,
            height: 0.016,
            lean: 0.55,
            fade_base: 0.42,
            fade_apex: 0.25,
            ..ToothWave::default()
        }],
    }
}

/// A quaking aspen's: nearly round with a rounded base and a short point, finely toothed.
pub(super) fn aspen() -> OutlinePlan {
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.17, -0.005),
            (0.33, 0.05),
            (0.435, 0.16),
            (0.465, 0.3),
            (0.435, 0.46),
            (0.35, 0.62),
            (0.235, 0.76),
            (0.125, 0.87),
            (0.045, 0.945),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![ToothWave {
            per_side: 24,
            height: 0.011,
            lean: 0.5,
            fade_base: 0.2,
            fade_apex: 0.12,
            ..ToothWave::default()
        }],
    }
}

/// A silver birch's: a triangle with rounded lower corners, doubly toothed.
pub(super) fn birch() -> OutlinePlan {
    // There are no teeth at the base and small ones towards the apex.
    let wave = |per_side, height, lean, fade_base, fade_apex| ToothWave {
        per_side,
        height,
        lean,
        fade_base,
        fade_apex,
        ..ToothWave::default()
    };
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.08, 0.012),
            (0.23, 0.07),
            (0.33, 0.17),
            (0.35, 0.26),
            (0.29, 0.41),
            (0.185, 0.62),
            (0.085, 0.82),
            (0.03, 0.94),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![
            wave(10, 0.024, 0.15, 0.45, 0.35),
            wave(40, 0.01, 0.4, 0.4, 0.2),
        ],
    }
}

/// A white willow's: narrow, finely toothed.
pub(super) fn willow() -> OutlinePlan {
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.022, 0.04),
            (0.058, 0.17),
            (0.083, 0.38),
            (0.074, 0.58),
            (0.042, 0.80),
            (0.016, 0.92),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![teeth(76, 0.0035, 0.7)],
    }
}

/// A magnolia's: a large ellipse, widest above the middle, with a short point.
pub(super) fn magnolia() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.06, 0.06),
        (0.15, 0.24),
        (0.215, 0.46),
        (0.225, 0.64),
        (0.165, 0.84),
        (0.07, 0.955),
        (0.0, 1.0),
    ])
    .into()
}

/// A croton's: an ellipse with a point.
pub(super) fn croton() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.035, 0.045),
        (0.098, 0.19),
        (0.15, 0.38),
        (0.16, 0.54),
        (0.135, 0.72),
        (0.075, 0.88),
        (0.028, 0.96),
        (0.0, 1.0),
    ])
    .into()
}
