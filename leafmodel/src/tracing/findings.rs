//! What a picture makes one look twice at, with places.

use std::fmt;

use glam::DVec2;

use super::components::flip_small;
use super::grid::Mask;

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FindingKind {
    /// Dark spots too small to be veins were left out.
    Specks {
        /// How many; the place is that of the first.
        count: usize,
    },
    /// Holes in veins too small to be areoles were filled.
    Holes {
        /// How many; the place is that of the first.
        count: usize,
    },
    /// Spurs on veins were cut off.
    Spurs {
        /// How many.
        count: usize,
    },
    /// Veins that cross met at two points near each other, which are one now.
    Crossings {
        /// How many.
        count: usize,
    },
    /// Veins are narrower than two pixels there, so that some may be missing.
    Thin {
        /// Their length, mm; the place is where they are the thinnest.
        length_mm: f64,
    },
    /// A petiole was taken off the blade.
    Petiole,
    /// The base was not given.
    BaseGuessed {
        /// What it is taken to be.
        by: &'static str,
    },
    /// The base or the apex that was given is not at the margin, and was moved there.
    Moved {
        /// `base` or `apex`.
        end: &'static str,
        /// How far it was moved, mm; the place is where it was.
        by_mm: f64,
        /// Whether it was outside of the blade.
        is_outside: bool,
    },
    /// Veins that do not hang together with the base.
    Apart {
        /// Their length, mm.
        length_mm: f64,
    },
}

/// Something found while a picture was traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// What it is.
    pub kind: FindingKind,
    /// Where, pixels from the upper left corner of the picture; `None` for what is all over it.
    pub place_px: Option<DVec2>,
}

impl Finding {
    /// What was found at a place.
    pub(super) fn at(place_px: DVec2, kind: FindingKind) -> Self {
        Self {
            kind,
            place_px: Some(place_px),
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = match self.place_px {
            Some(DVec2 { x, y }) => format!("pixel ({x:.0}, {y:.0})"),
            None => "many places".to_owned(),
        };
        match self.kind {
            FindingKind::Specks { count } => {
                write!(f, "{count} specks were left out, the first at {at}")
            }
            FindingKind::Holes { count } => {
                write!(f, "{count} holes in veins were filled, the first at {at}")
            }
            FindingKind::Spurs { count } => write!(f, "{count} spurs on veins were cut off"),
            FindingKind::Crossings { count } => {
                write!(f, "{count} pairs of junctions were joined to crossings")
            }
            FindingKind::Thin { length_mm } => write!(
                f,
                "{length_mm:.2} mm of vein are narrower than two pixels, the thinnest at {at}: \
                 thinner veins cannot be seen at this size of pixels"
            ),
            FindingKind::Petiole => {
                write!(
                    f,
                    "a petiole was taken off; the base is where it meets the blade, {at} (if not, say \
                     lamina trace --base X,Y)"
                )
            }
            FindingKind::BaseGuessed { by } => write!(
                f,
                "the base is taken to be {by}, {at} (if not, say lamina trace --base X,Y)"
            ),
            FindingKind::Moved {
                end,
                by_mm,
                is_outside,
            } => write!(
                f,
                "the {end} that was given, {at}, lies {} the leaf: it is moved by {by_mm:.2} mm to the \
                 nearest place of the margin",
                if is_outside { "outside of" } else { "inside" }
            ),
            FindingKind::Apart { length_mm } => write!(
                f,
                "{length_mm:.2} mm of vein at {at} do not hang together with the base"
            ),
        }
    }
}

/// Leaves specks out and fills holes of at most `most` pixels.
pub(super) fn clean(veins: &mut Mask, most: usize, findings: &mut Vec<Finding>) {
    let specks = flip_small(veins, true, most);
    let holes = flip_small(veins, false, most);
    for (parts, kind) in [
        (
            &specks,
            FindingKind::Specks {
                count: specks.len(),
            },
        ),
        (&holes, FindingKind::Holes { count: holes.len() }),
    ] {
        if let Some(&(first, _)) = parts.first() {
            findings.push(Finding::at(veins.centre(first as usize), kind));
        }
    }
}
