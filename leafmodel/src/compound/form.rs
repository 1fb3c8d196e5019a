//! The arrangement of a compound leaf's leaflets, as given by a plan.

/// Leaflets, or pinnae, in two rows along a rachis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feather {
    /// Pairs, 1 to 200.
    pub pairs: u32,
    /// Whether there is a terminal one at the rachis' end (imparipinnate).
    pub terminal: bool,
    /// Length of the rachis from the first pair to its end, relative to its owner: see
    /// [`Arrangement`]; 0.01 to 100.
    pub rachis: f64,
    /// Shift of the left ones towards the tip as a share of the gap between pairs, 0 to 0.9: 0 is
    /// opposite, 0.5 alternate.
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

/// The arrangement of leaflets.
#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// In two rows along the rachis, whose length is relative to the largest leaflet's.
    Pinnate(Feather),
    /// All leaflets at the petiole's end.
    Palmate {
        /// Number of leaflets, 2 to 100.
        leaflets: u32,
        /// Angle between the two outermost, radians, 0.05 to 6.2.
        spread: f64,
        /// Size of the outermost and of the middle ones relative to the largest; 0.01 to 1, linear
        /// in the angle between.
        sizes: [f64; 2],
    },
    /// Pinnae along the rachis, leaflets along each pinna. The length of a pinna's rachis is
    /// relative to the largest leaflet and to the pinna's size, that of the main rachis to the
    /// rachis of the largest pinna.
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

/// The parameters of a compound leaf apart from its leaflets.
#[derive(Clone, Debug, PartialEq)]
pub struct CompoundForm {
    /// The arrangement of leaflets.
    pub arrangement: Arrangement,
    /// Length of the petiole, from the origin to the first pair or to the common insertion of all
    /// leaflets, relative to the largest leaflet, 0 to 100.
    pub petiole: f64,
    /// Length of petiolules relative to their leaflets, 0 to 10.
    pub petiolule: f64,
    /// Radius of the largest leaflet's stalk, mm, 0.001 to 100.
    pub stalk_radius_mm: f64,
    /// Number of different leaflets that are grown, 1 to 50; they are used in turn.
    pub variants: u32,
    /// Angle through which petiole and rachis bend from end to end, towards the abaxial side,
    /// radians, −6.2 to 6.2.
    pub curl: f64,
    /// Angle by which leaflets are raised about the axis that bears them, towards the adaxial side,
    /// radians, −1.4 to 1.4; multiplied by the sine of the angle of insertion.
    pub fold: f64,
    /// Largest random rotation of each leaflet about its midrib, radians, 0 to 1; that about the
    /// axis across it is half as large.
    pub tilt: f64,
    /// Standard deviation, from leaflet to leaflet and from pinna to pinna, of places along the axis
    /// in gaps between pairs, of angles relative to themselves and, half as much, of sizes; 0 to
    /// 0.25. Those that would come into each other's way stray less.
    pub irregularity: f64,
}

impl CompoundForm {
    /// A form with default values for all but the arrangement: no petiole, short stalks, all in one
    /// plane and without chance.
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
            irregularity: 0.0,
        }
    }

    /// The same form, all in one plane.
    #[must_use]
    pub(super) fn flattened(&self) -> Self {
        Self {
            curl: 0.0,
            fold: 0.0,
            tilt: 0.0,
            ..self.clone()
        }
    }
}
