//! Outlines of the presets, drawn by eye after the figures' captions and the plants. They are not
//! measured.

use crate::leaf::outline_plan::{Contour, OutlinePlan};
use crate::shape::contour_curve::{ContourCurve, ControlPoint};
use crate::shape::specimen::Specimen;
use crate::shape::teeth::ToothWave;

/// A point of a contour: across and along, in shares of the midrib's length.
pub(super) type Place = (f64, f64);

/// A contour through `places`, smooth except at `corners` (numbers of places).
pub(super) fn curve(places: &[Place], corners: &[usize], mirrored: bool) -> Contour {
    let point = |(i, &(x, y)): (usize, &Place)| ControlPoint {
        place: [x, y],
        corner: corners.contains(&i),
    };
    Contour::Curve(ContourCurve {
        points: places.iter().enumerate().map(point).collect(),
        mirrored,
    })
}

/// A symmetrical contour with corners at base and apex only.
pub(super) fn pointed(places: &[Place]) -> Contour {
    curve(places, &[0, places.len() - 1], true)
}

/// At `degrees` from the midrib, `radius` from the base.
pub(super) fn polar(degrees: f64, radius: f64) -> Place {
    let angle = degrees.to_radians();
    (radius * libm::sin(angle), radius * libm::cos(angle))
}

/// The leaf of the parameter searches (Fig. 9a–h): lanceolate.
pub(super) fn lanceolate() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.10, 0.10),
        (0.185, 0.28),
        (0.20, 0.42),
        (0.155, 0.66),
        (0.07, 0.88),
        (0.0, 1.0),
    ])
    .into()
}

/// An egg with a pointed tip.
pub(super) fn ovate() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.16, 0.035),
        (0.27, 0.16),
        (0.30, 0.30),
        (0.25, 0.52),
        (0.13, 0.78),
        (0.045, 0.92),
        (0.0, 1.0),
    ])
    .into()
}

/// A poplar's: deltoid, with a drip tip.
pub(super) fn deltoid() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.13, -0.035),
        (0.30, 0.02),
        (0.405, 0.14),
        (0.385, 0.28),
        (0.27, 0.50),
        (0.13, 0.74),
        (0.05, 0.88),
        (0.0, 1.0),
    ])
    .into()
}

/// A ginkgo's: a fan whose margin has the same distance from the petiole everywhere.
pub(super) fn fan() -> OutlinePlan {
    let mut places = vec![(0.0, 0.0)];
    for radius in [0.3, 0.6, 0.9] {
        let spread = (1.0 - radius) / 0.7;
        places.push(polar(60.0 - 8.0 * spread * spread, radius));
    }
    places.push(polar(60.0, 0.985));
    let corner = places.len() - 1;
    places.extend((1..8).rev().map(|i| polar(7.5 * f64::from(i), 1.0)));
    places.push((0.0, 1.0));
    curve(&places, &[0, corner], true).into()
}

/// A lady's mantle's: round, with nine shallow lobes and fine teeth.
pub(super) fn lobed_round() -> OutlinePlan {
    let mut places = vec![(0.0, 0.0), polar(150.0, 0.34), polar(134.0, 0.54)];
    let mut corners = vec![0];
    let lobes = [(118.0, 0.62), (84.0, 0.80), (55.0, 0.92), (27.0, 0.985)];
    let bays = [(101.0, 0.60), (69.5, 0.735), (41.0, 0.83), (13.5, 0.89)];
    for ((lobe, reach), (bay, depth)) in lobes.into_iter().zip(bays) {
        places.push(polar(lobe + 6.0, 0.985 * reach));
        places.push(polar(lobe - 6.0, 0.985 * reach));
        corners.push(places.len());
        places.push(polar(bay, depth));
    }
    places.extend([polar(6.0, 0.99), (0.0, 1.0)]);
    OutlinePlan {
        contour: curve(&places, &corners, true),
        specimen: Specimen::default(),
        teeth: vec![teeth(36, 0.02, 0.6)],
    }
}

/// A sweetgum's: five pointed lobes about the petiole.
pub(super) fn star() -> OutlinePlan {
    let right = [
        (124.0, 0.22),
        (113.0, 0.46),
        (107.0, 0.70),
        (93.0, 0.54),
        (77.0, 0.40),
        (67.0, 0.52),
        (59.0, 0.72),
        (53.0, 0.93),
        (43.0, 0.72),
        (31.0, 0.50),
        (21.0, 0.45),
        (12.5, 0.62),
        (7.0, 0.82),
    ];
    let mut places = vec![(0.0, 0.0)];
    places.extend(right.map(|(degrees, radius)| polar(degrees, radius)));
    places.push((0.0, 1.0));
    OutlinePlan {
        contour: curve(&places, &[0, 3, 8, places.len() - 1], true),
        specimen: Specimen::default(),
        teeth: vec![teeth(60, 0.008, 0.5)],
    }
}

/// *Liquidambar styraciflua*: five broad, long-pointed lobes, parted by sinuses that reach a little
/// more than half-way to the petiole, finely toothed.
pub(super) fn sweetgum() -> OutlinePlan {
    let right = [
        (136.0, 0.12),
        (127.0, 0.27),
        (119.0, 0.46),
        (108.0, 0.70),
        (98.0, 0.57),
        (89.0, 0.44),
        (80.0, 0.375),
        (73.0, 0.44),
        (66.0, 0.58),
        (59.0, 0.73),
        (53.0, 0.91),
        (46.5, 0.74),
        (40.0, 0.60),
        (33.5, 0.48),
        (27.0, 0.41),
        (22.5, 0.50),
        (18.0, 0.63),
        (11.5, 0.78),
        (5.0, 0.91),
    ];
    let mut places = vec![(0.0, 0.0)];
    places.extend(right.map(|(degrees, radius)| polar(degrees, radius)));
    places.push((0.0, 1.0));
    OutlinePlan {
        contour: curve(&places, &[0, 4, 11, places.len() - 1], true),
        specimen: Specimen::default(),
        teeth: vec![teeth(70, 0.006, 0.5)],
    }
}

/// A toothed leaf with a lobe on one side (Fig. 13a).
pub(super) fn one_lobe() -> OutlinePlan {
    let places = [
        (0.0, 0.0),
        (0.10, 0.04),
        (0.21, 0.16),
        (0.27, 0.28),
        (0.30, 0.36),
        (0.40, 0.42),
        (0.47, 0.50),
        (0.455, 0.565),
        (0.36, 0.555),
        (0.27, 0.545),
        (0.225, 0.66),
        (0.14, 0.83),
        (0.06, 0.94),
        (0.0, 1.0),
        (-0.06, 0.94),
        (-0.14, 0.83),
        (-0.23, 0.64),
        (-0.285, 0.42),
        (-0.27, 0.24),
        (-0.19, 0.10),
        (-0.08, 0.03),
    ];
    OutlinePlan {
        contour: curve(&places, &[0, 4, 7, 9, 13], false),
        specimen: Specimen::default(),
        teeth: vec![teeth(9, 0.018, 0.6)],
    }
}

/// An orchid's: elliptic, nearly parallel-sided.
pub(super) fn elliptic() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.09, 0.06),
        (0.17, 0.22),
        (0.205, 0.45),
        (0.19, 0.65),
        (0.12, 0.86),
        (0.05, 0.96),
        (0.0, 1.0),
    ])
    .into()
}

/// A Nankin cherry's: obovate and finely toothed.
pub(super) fn obovate() -> OutlinePlan {
    OutlinePlan {
        contour: pointed(&[
            (0.0, 0.0),
            (0.07, 0.12),
            (0.18, 0.34),
            (0.255, 0.58),
            (0.24, 0.74),
            (0.14, 0.88),
            (0.05, 0.945),
            (0.0, 1.0),
        ]),
        specimen: Specimen::default(),
        teeth: vec![teeth(24, 0.012, 0.7)],
    }
}

/// A piece of a grass blade.
pub(super) fn strip() -> OutlinePlan {
    curve(
        &[(0.0, 0.0), (0.15, 0.0), (0.15, 1.0), (0.0, 1.0)],
        &[0, 1, 2, 3],
        true,
    )
    .into()
}

/// A whole grass blade: narrowed into the collar, where the sheath begins, parallel-sided, and
/// drawn out to a long point.
pub(super) fn linear() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.0075, 0.003),
        (0.012, 0.018),
        (0.0205, 0.05),
        (0.031, 0.11),
        (0.0385, 0.2),
        (0.042, 0.32),
        (0.041, 0.46),
        (0.0365, 0.59),
        (0.0305, 0.69),
        (0.0225, 0.795),
        (0.013, 0.895),
        (0.0055, 0.957),
        (0.0, 1.0),
    ])
    .into()
}

/// A ginkgo's as it grows: a fan with a wavy margin and a notch, at whose bottom the apex is.
pub(super) fn notched_fan() -> OutlinePlan {
    let mut places = vec![(0.0, 0.0)];
    for radius in [0.28, 0.56, 0.84] {
        let spread = (1.0 - radius) / 0.72;
        places.push(polar(63.0 - 9.0 * spread * spread, radius));
    }
    let right = [
        (62.5, 0.955),
        (57.0, 1.005),
        (50.0, 1.01),
        (42.0, 1.04),
        (33.0, 1.04),
        (24.0, 1.075),
        (15.0, 1.09),
        (7.0, 1.095),
        (2.5, 1.07),
    ];
    let corner = places.len();
    places.extend(right.map(|(degrees, radius)| polar(degrees, radius)));
    places.push((0.0, 1.0));
    let last = places.len() - 1;
    curve(&places, &[0, corner, last], true).into()
}

/// A trillium's petal.
pub(super) fn petal() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.10, 0.07),
        (0.22, 0.27),
        (0.26, 0.48),
        (0.22, 0.70),
        (0.11, 0.90),
        (0.0, 1.0),
    ])
    .into()
}

/// A trillium's green leaf: broadly ovate to rhombic, short-acuminate, narrowed to the base.
pub(super) fn bract() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.09, 0.06),
        (0.26, 0.21),
        (0.36, 0.37),
        (0.355, 0.52),
        (0.25, 0.71),
        (0.1, 0.87),
        (0.03, 0.95),
        (0.0, 1.0),
    ])
    .into()
}

/// A trillium's sepal: lanceolate.
pub(super) fn sepal() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.11, 0.03),
        (0.155, 0.22),
        (0.16, 0.42),
        (0.12, 0.68),
        (0.05, 0.9),
        (0.0, 1.0),
    ])
    .into()
}

/// Nearly circular: the leaf that grows out of a narrow one in Fig. 5.
pub(super) fn circular() -> OutlinePlan {
    curve(
        &[
            (0.0, 0.0),
            (0.2, 0.03),
            (0.40, 0.2),
            (0.47, 0.45),
            (0.40, 0.75),
            (0.2, 0.95),
            (0.0, 1.0),
        ],
        &[0],
        true,
    )
    .into()
}

/// A broad ellipse with a pointed tip.
pub(super) fn broad_elliptic() -> OutlinePlan {
    pointed(&[
        (0.0, 0.0),
        (0.10, 0.05),
        (0.21, 0.18),
        (0.26, 0.38),
        (0.24, 0.58),
        (0.14, 0.82),
        (0.05, 0.94),
        (0.0, 1.0),
    ])
    .into()
}

/// Round, with a shallow sinus at the petiole.
pub(super) fn orbicular() -> OutlinePlan {
    curve(
        &[
            (0.0, 0.0),
            (0.12, -0.06),
            (0.40, 0.05),
            (0.52, 0.4),
            (0.40, 0.78),
            (0.2, 0.95),
            (0.0, 1.0),
        ],
        &[0],
        true,
    )
    .into()
}

/// Teeth along the whole margin except its ends.
pub(super) fn teeth(per_side: u32, height: f64, lean: f64) -> ToothWave {
    ToothWave {
        per_side,
        height,
        lean,
        fade_base: 0.1,
        fade_apex: 0.1,
        ..ToothWave::default()
    }
}
