//! Places of things: how many there may be, and why there are none.

use std::fmt;

use glam::{DAffine3, DMat3, DVec3};
use thiserror::Error;

/// Greatest number of things on one surface.
pub const MOST_THINGS: usize = 1 << 24;
/// Greatest number of things that come to rest on one surface.
pub const MOST_AT_REST: usize = 100_000;

/// How many things there may be, and why not more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Most {
    /// So many at any time.
    Ever(usize),
    /// So many fit into memory.
    InMemory(usize),
}

impl Most {
    /// As many as are possible where memory is no limit.
    pub const UNBOUND: Self = Self::Ever(MOST_THINGS);

    /// The number.
    pub fn things(self) -> usize {
        match self {
            Self::Ever(things) | Self::InMemory(things) => things,
        }
    }

    /// The lesser of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        if other.things() < self.things() {
            other
        } else {
            self
        }
    }
}

impl fmt::Display for Most {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ever(things) => write!(to, "the {things} that there may be"),
            Self::InMemory(things) => write!(
                to,
                "the {things} for which there is memory: make them fewer, or allow more memory with --memory"
            ),
        }
    }
}

/// Why things have no places.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ScatterError {
    /// The surface has no area in the rectangle, or nowhere faces up.
    #[error("`on`: the surface has no area there{}", if *.rests { " that faces up" } else { "" })]
    NoSurface {
        /// Whether only what faces up counts.
        rests: bool,
    },
    /// There is too little room, for the reason that occurred most often.
    #[error("there is room for {found} of {wanted}: {}", .why.remedy())]
    NoRoom {
        /// How many have a place.
        found: usize,
        /// How many are asked for.
        wanted: usize,
        /// What stood against most of the others.
        why: NoPlace,
    },
    /// More than there may be.
    #[error("`count` or `per_m2`: {wanted} are more than {most}")]
    TooMany {
        /// How many are asked for.
        wanted: f64,
        /// How many there may be.
        most: Most,
    },
    /// The density comes to nothing.
    #[error("`per_m2`: on {area} m² the density comes to none")]
    None {
        /// The area, m².
        area: f64,
    },
    /// The surface has too many triangles, with all its places.
    #[error("`on`: the surface has over {most} triangles in all its places")]
    TooFine {
        /// How many it may have.
        most: usize,
    },
    /// The cells of the pile would be too large for the smallest thing.
    #[error(
        "`settle`: over {width:.3} m of ground a thing of {radius:.5} m cannot be let down \
         accurately: choose a smaller rectangle, `within_m`"
    )]
    TooWide {
        /// Extent of the ground, m.
        width: f64,
        /// Radius of the smallest thing, m.
        radius: f64,
    },
}

/// Why a thing has no place at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPlace {
    /// Another is nearer than the least distance.
    Near,
    /// Nothing holds its centre of mass: it would tip over an edge.
    Edge,
    /// It finds no rest, or would slide.
    Steep,
}

impl NoPlace {
    pub(super) const ALL: [Self; 3] = [Self::Near, Self::Edge, Self::Steep];

    /// What to do about it.
    fn remedy(self) -> &'static str {
        match self {
            Self::Near => "the others would be nearer than `least_distance_mm`",
            Self::Edge => "the others would tip over an edge of what they lie on",
            Self::Steep => "the others find no rest, as on slopes over 35 degrees or edges",
        }
    }
}

/// A thing's shape and place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strewn {
    /// Index of its body.
    pub body: u32,
    /// From the frame of the body's shape to the world, m.
    pub to_world: DAffine3,
}

/// The smallest turn that takes +z to `up`, a unit vector.
pub(super) fn from_z(up: DVec3) -> DMat3 {
    if up.z < -1.0 + 1e-12 {
        return DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0));
    }
    let share = 1.0 / (1.0 + up.z);
    DMat3::from_cols(
        DVec3::new(1.0 - up.x * up.x * share, -up.x * up.y * share, -up.x),
        DVec3::new(-up.x * up.y * share, 1.0 - up.y * up.y * share, -up.y),
        up,
    )
}
