//! The arrangement of a compound leaf's leaflets, as given by a plan.

use crate::document::{Declared, Degrees, Integer, Keys, Limits, Number, Numbers, Variant};
/// Leaflets, or pinnae, in two rows along a rachis.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Feather {
    /// Length from the first pair to the end, in leaflets; of `pinnae` over the largest pinna's
    /// rachis.
    ///
    /// Length of the rachis from the first pair to its end, relative to its owner: see
    /// [`Arrangement`].
    #[key("rachis", required, 0.01..=100.0)]
    pub rachis: f64,
    /// Pairs along the rachis.
    #[key("pairs", required, 1..=200)]
    pub pairs: u32,
    /// Whether one more stands at the end.
    ///
    /// Whether there is a terminal one at the rachis' end (imparipinnate).
    #[key("terminal")]
    pub terminal: bool,
    /// How far the left ones stand towards the tip, in gaps between pairs: 0 opposite, 0.5
    /// alternate.
    #[key("alternation", 0.0..=0.9)]
    pub alternation: f64,
    /// Angle from the rachis of the first pair and the last, linear between.
    ///
    /// Radians.
    #[key("angles_deg", required, degrees(3.0..=170.0))]
    pub angles: [f64; 2],
    /// First pair, one half-way, last, over the largest.
    ///
    /// Size of the first pair, of one half-way and of the last, relative to the largest leaflet,
    /// linear between.
    #[key("sizes", 0.01..=1.0)]
    pub sizes: [f64; 3],
    /// Angle by which the rachis turns to the right from end to end.
    ///
    /// Radians.
    #[key("turn_deg", degrees(-114.0..=114.0))]
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
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct CompoundForm {
    /// The arrangement of leaflets.
    pub arrangement: Arrangement,
    /// Length up to the first pair, or to where all leaflets stand.
    ///
    /// Length of the petiole, from the origin to the first pair or to the common insertion of all
    /// leaflets, relative to the largest leaflet
    #[key("petiole", 0.0..=100.0)]
    pub petiole: f64,
    /// Stalk of a leaflet over that leaflet's length.
    #[key("petiolule", 0.0..=10.0)]
    pub petiolule: f64,
    /// Radius of the largest leaflet's stalk; cross-sections of axes are sums of those that they
    /// bear.
    #[key("stalk_radius_mm", 0.001..=100.0)]
    pub stalk_radius_mm: f64,
    /// Different leaflets that are grown, each from a seed of its own; they stand in turn. Each has
    /// a mesh and a map.
    #[key("variants", 1..=50)]
    pub variants: u32,
    /// Angle through which petiole and rachis bend from end to end, towards the abaxial side.
    ///
    /// Radians.
    #[key("curl_deg", degrees(-355.0..=355.0))]
    pub curl: f64,
    /// Angle by which leaflets are raised about the axis that bears them, times the sine of the
    /// angle at which they stand on it.
    ///
    /// Radians.
    #[key("fold_deg", degrees(-80.0..=80.0))]
    pub fold: f64,
    /// Largest angle by which each is turned by chance about its midrib, and half as far across it.
    ///
    /// Radians.
    #[key("tilt_deg", degrees(0.0..=57.0))]
    pub tilt: f64,
    /// Standard deviation, from one to the next, of places along an axis in gaps between pairs, of
    /// angles over themselves and, half as much, of sizes. Those that would come into each other's
    /// way stray less.
    #[key("irregularity", 0.0..=0.25)]
    pub irregularity: f64,
}

/// Lengths of stalks in leaflets.
const LENGTHS: Number = Number(Limits::closed(0.01, 100.0));
/// Sizes in shares of the largest leaflet.
const SIZES: Limits = Limits::closed(0.01, 1.0);

fn palmate() -> Arrangement {
    Arrangement::Palmate {
        leaflets: 2,
        spread: 1.0,
        sizes: [1.0; 2],
    }
}

fn rows() -> Feather {
    Feather {
        pairs: 1,
        terminal: true,
        rachis: 1.0,
        alternation: 0.0,
        angles: [1.0; 2],
        sizes: [1.0; 3],
        turn: 0.0,
    }
}

/// The kinds of `compound`, with the keys that all of them have.
const KINDS: [Variant<CompoundForm>; 3] = [
    Variant {
        name: "pinnate",
        about: "Leaflets in two rows along a rachis.",
        new: || CompoundForm::new(Arrangement::Pinnate(rows())),
        is: |form| matches!(form.arrangement, Arrangement::Pinnate(_)),
        declare: |form, keys| {
            if let Arrangement::Pinnate(rows) = &mut form.arrangement {
                rows.declare(keys);
            }
            form.declare(keys);
        },
    },
    Variant {
        name: "palmate",
        about: "Leaflets from one point.",
        new: || CompoundForm::new(palmate()),
        is: |form| matches!(form.arrangement, Arrangement::Palmate { .. }),
        declare: |form, keys| {
            if let Arrangement::Palmate {
                leaflets,
                spread,
                sizes,
            } = &mut form.arrangement
            {
                let count = Integer::within(2, 100);
                keys.required("leaflets", leaflets, count, "How many.");
                let limits = Degrees(Limits::closed(3.0, 355.0));
                let about = "Angle between the two outermost.";
                keys.required("spread_deg", spread, limits, about);
                let about = "Outermost and middle ones over the largest leaflet.";
                keys.key("sizes", sizes, Numbers(SIZES), about);
            }
            form.declare(keys);
        },
    },
    Variant {
        name: "bipinnate",
        about: "Pinnae in two rows, each with leaflets in two rows.",
        new: || {
            CompoundForm::new(Arrangement::Bipinnate {
                pinnae: rows(),
                leaflets: rows(),
                stalk: 1.0,
            })
        },
        is: |form| matches!(form.arrangement, Arrangement::Bipinnate { .. }),
        declare: |form, keys| {
            if let Arrangement::Bipinnate {
                pinnae,
                leaflets,
                stalk,
            } = &mut form.arrangement
            {
                let about = "Length of the largest pinna's stalk, from the rachis to its first \
                    leaflets.";
                keys.required("stalk", stalk, LENGTHS, about);
                let about = "How pinnae stand on the rachis.";
                keys.required_block("pinnae", about, &[], |keys| pinnae.declare(keys));
                let about = "How leaflets stand on a pinna.";
                keys.required_block("leaflets", about, &[], |keys| leaflets.declare(keys));
            }
            form.declare(keys);
        },
    },
];

impl Default for CompoundForm {
    /// A compound leaf of which nothing is said.
    fn default() -> Self {
        Self::new(palmate())
    }
}

impl CompoundForm {
    /// The keys of `compound`: those of its kind, then those that all kinds have.
    pub(crate) fn keys(&mut self, keys: &mut Keys<'_>) {
        keys.kind(self, &KINDS);
    }

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
