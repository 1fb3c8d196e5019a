//! Outlines of the coloured leaves whose species has no green preset. They are drawn by eye, not
//! measured.

use super::super::contours::{curve, pointed, polar, teeth};
use crate::leaf::outline_plan::OutlinePlan;
use crate::shape::specimen::Specimen;
use crate::shape::teeth::ToothWave;

/// A red maple's: three broad lobes and two small ones, shallow sharp sinuses, saw teeth.
pub(super) fn red_maple() -> OutlinePlan {
    let right = [
        (128.0, 0.16, false),
        (112.0, 0.27, false),
        (98.0, 0.37, false),
        (88.0, 0.50, true),
        (79.0, 0.43, false),
        (70.0, 0.43, true),
        (62.0, 0.54, false),
        (54.0, 0.66, false),
        (46.0, 0.84, true),
        (39.0, 0.70, false),
        (31.0, 0.58, false),
        (24.5, 0.535, true),
        (19.0, 0.62, false),
        (12.0, 0.74, false),
        (5.0, 0.90, false),
    ];
    let mut places = vec![(0.0, 0.0)];
    let mut corners = vec![0];
    for (degrees, radius, is_corner) in right {
        if is_corner {
            corners.push(places.len());
        }
        places.push(polar(degrees, radius));
    }
    corners.push(places.len());
    places.push((0.0, 1.0));
    OutlinePlan {
        contour: curve(&places, &corners, true),
        specimen: Specimen::default(),
        teeth: vec![ToothWave {
            fade_base: 0.2,
            fade_apex: 0.06,
            ..teeth(26, 0.014, 0.5)
        }],
    }
}

/// A smoke tree's: obovate to nearly round, entire.
pub(super) fn smoke_tree() -> OutlinePlan {
    curve(
        &[
            (0.0, 0.0),
            (0.07, 0.04),
            (0.24, 0.2),
            (0.36, 0.42),
            (0.395, 0.62),
            (0.335, 0.83),
            (0.19, 0.96),
            (0.06, 1.0),
            (0.0, 1.0),
        ],
        &[0],
        true,
    )
    .into()
}

/// A box elder's leaflet: oval with a drawn-out tip, a few coarse teeth beyond the middle.
pub(super) fn box_elder() -> OutlinePlan {
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.08, 0.035),
            (0.215, 0.17),
            (0.265, 0.36),
            (0.225, 0.57),
            (0.13, 0.78),
            (0.045, 0.93),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![ToothWave {
            fade_base: 0.45,
            fade_apex: 0.15,
            ..teeth(9, 0.026, 0.6)
        }],
    }
}

/// An amaranth's: a rhomb with rounded corners, drawn out at both ends.
pub(super) fn amaranth() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.03, 0.03),
        (0.115, 0.14),
        (0.225, 0.31),
        (0.245, 0.42),
        (0.185, 0.62),
        (0.10, 0.82),
        (0.04, 0.94),
        (0.0, 1.0),
    ])
    .into()
}
