//! How the leaflets of a compound leaf stand, as a plan says it.

/// Leaflets, or pinnae, in two rows along a rachis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feather {
    /// Pairs, 1 to 200.
    pub pairs: u32,
    /// Whether one more stands at the rachis' end (imparipinnate).
    pub terminal: bool,
    /// Length of the rachis from the first pair to its end, relative to its owner: see
    /// [`Arrangement`]; 0.01 to 100.
    pub rachis: f64,
    /// How far the left ones stand towards the tip, in shares of the gap between pairs: 0 opposite,
    /// 0.5 alternate; 0 to 0.9.
    pub alternation: f64,
    /// Angle from the rachis of the first pair and of the last, radians, 0.05 to 3; linear between.
    pub angles: [f64; 2],
    /// Size of the first pair, of one half-way and of the last, relative to the largest leaflet;
    /// 0.01 to 1, linear between.
    pub sizes: [f64; 3],
    /// Curvature of the rachis: the angle by which it turns to the right from end to end, radians,
    /// −2 to 2.
    pub turn: f64,
}

/// How leaflets stand.
#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// In two rows along the rachis, whose length is relative to the largest leaflet's.
    Pinnate(Feather),
    /// All at the petiole's end.
    Palmate {
        /// How many, 2 to 100.
        leaflets: u32,
        /// Angle between the two outermost, radians, 0.05 to 6.2.
        spread: f64,
        /// Size of the outermost and of the middle ones relative to the largest; 0.01 to 1, linear
        /// in the angle between.
        sizes: [f64; 2],
    },
    /// Twice feathered: pinnae along the rachis, leaflets along each pinna. Rachides of pinnae are
    /// relative to the largest leaflet and to the pinna's size, the main one to the rachis of the
    /// largest pinna.
    Bipinnate {
        /// Pinnae along the rachis.
        pinnae: Feather,
        /// Leaflets along a pinna.
        leaflets: Feather,
        /// Length of a pinna's stalk, from the rachis to its first leaflets, relative to the
        /// largest leaflet and to the pinna's size; 0.01 to 100.
        stalk: f64,
    },
}

/// Everything that makes a leaf the largest leaflet of a compound one.
#[derive(Clone, Debug, PartialEq)]
pub struct CompoundForm {
    /// How leaflets stand.
    pub arrangement: Arrangement,
    /// Petiole, from the origin to the first pair, or to where all leaflets stand; relative to the
    /// largest leaflet, 0 to 100.
    pub petiole: f64,
    /// Stalks of leaflets (petiolules) relative to the leaflet, 0 to 10.
    pub petiolule: f64,
    /// Radius of the largest leaflet's stalk, mm, 0.001 to 100.
    pub stalk_radius_mm: f64,
    /// How many different leaflets are grown, 1 to 50; they stand in turn.
    pub variants: u32,
    /// Angle through which petiole and rachis bend from end to end, towards the abaxial side,
    /// radians, −6.2 to 6.2.
    pub curl: f64,
    /// Angle by which leaflets are raised about the axis that bears them, towards the adaxial side,
    /// radians, −1.4 to 1.4; times the sine of the angle at which they stand on it.
    pub fold: f64,
    /// Largest angle by which each leaflet is turned by chance about its midrib, and half as far
    /// across it, radians, 0 to 1.
    pub tilt: f64,
}

impl CompoundForm {
    /// A form of which only the arrangement is said: no petiole, short stalks, all in one plane.
    pub fn new(arrangement: Arrangement) -> Self {
        Self {
            arrangement,
            petiole: 0.0,
            petiolule: 0.05,
            stalk_radius_mm: 0.4,
            variants: 3,
            curl: 0.0,
            fold: 0.0,
            tilt: 0.0,
        }
    }
}
