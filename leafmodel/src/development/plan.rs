//! What a development is told. Lengths are those of the primordium, whose midrib is 1.

use crate::document::{Declared, Words};
/// The margin of the primordium, symmetric about its midrib.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Primordium {
    /// Greatest width of the primordium over its length.
    #[key("width", 0.02..=3.0)]
    pub width: f64,
    /// Where along its midrib the primordium is widest.
    #[key("widest_at", 0.05..=0.95)]
    pub widest_at: f64,
    /// How pointed its base is: 0.5 an ellipse, 1 a lens, 2 drawn out.
    #[key("taper_base", 0.2..=3.0)]
    pub taper_base: f64,
    /// How pointed its tip is.
    #[key("taper_tip", 0.2..=3.0)]
    pub taper_tip: f64,
}

/// In which sequence convergence points appear on the margin between those that are there.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Words)]
pub enum Sequence {
    /// From the tip to the base: each as near to the next one above as the spacing allows.
    Basipetal,
    /// From the base to the tip.
    Acropetal,
    /// In the middle of the widest gaps.
    Intercalary,
}

/// A wave of initiation: convergence points that appear while the leaf has some length, and what
/// becomes of the lobes or teeth at them.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Wave {
    /// Length of the leaf, in primordia, when the first may appear.
    #[key("from", 1.0..=1000.0)]
    pub from: f64,
    /// Length of the leaf after which none appears.
    #[key("until", 1.0..=1000.0)]
    pub until: f64,
    /// Least distance from other convergence points along the margin, in primordia.
    #[key("spacing", 0.01..=10.0)]
    pub spacing: f64,
    /// `basipetal` from the tip to the base, `acropetal` from the base to the tip, `intercalary` in
    /// the middle of gaps.
    #[key("sequence", word)]
    pub sequence: Sequence,
    /// The part of each side's margin where they appear: 0 the base, 1 the tip.
    #[key("zone", 0.0..=1.0)]
    pub zone: [f64; 2],
    /// What transport along veins costs over that through other tissue: with 0 veins join the
    /// nearest one squarely, with 1 they run to the base (palmate).
    #[key("transport", 0.0..=1.0)]
    pub transport: f64,
    /// How fast veins elongate, over the leaf, that end at the base of the margin.
    #[key("rate_base", 0.5..=1.5, at = 0)]
    /// The same of veins that end at its tip; between, in between.
    #[key("rate_tip", 0.5..=1.5, at = 1)]
    pub rates: [f64; 2],
    /// How much growth is held back between them: 0 an entire margin, 1 leaflets.
    #[key("hold", 0.0..=1.0)]
    pub hold: f64,
    /// How much of that applies below the lowest of them.
    #[key("hold_base", 0.0..=1.0)]
    pub hold_base: f64,
    /// How much of the margin between the uppermost and the tip is the terminal lobe's.
    #[key("terminal", 0.1..=0.9)]
    pub terminal: f64,
    /// Form of sinuses: 1 pointed, 2 rounded, 4 broad.
    #[key("sinus", 0.3..=8.0)]
    pub sinus: f64,
    /// Form of lobes and teeth: 1 pointed, 2 rounded, 4 broad.
    #[key("blunt", 0.3..=8.0)]
    pub blunt: f64,
    /// Where sinuses lie: 0 in the middle, towards 1 above the lower tooth, so that teeth point to
    /// the apex.
    #[key("lean", -0.9..=0.9)]
    pub lean: f64,
    /// How far veins arch towards the tip, in shares of their length.
    #[key("bow", -0.3..=0.3)]
    pub bow: f64,
    /// How much the angles of veins widen per e-fold of the leaf's length.
    #[key("splay", -0.3..=0.3)]
    pub splay: f64,
}

/// Everything that decides a development.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct DevelopmentPlan {
    /// What it starts from.
    #[key(flat)]
    pub primordium: Primordium,
    /// Length of the full-grown leaf, in primordia.
    #[key("growth", 1.1..=1000.0)]
    pub growth: f64,
    /// Where the leaf grows faster: 0 nowhere, towards 1 at the base, −1 at the tip.
    #[key("basal_growth", -0.9..=0.9)]
    pub basal_growth: f64,
    /// How unlike distances, lengths and angles are by chance; the leaf's `seed` decides.
    #[key("irregularity", 0.0..=1.0)]
    pub irregularity: f64,
    /// Points of the margin per length of the leaf, at least.
    #[key("resolution", 20..=400)]
    pub resolution: u32,
    /// Waves of initiation of convergence points, each with a vein of its own.
    #[key(
        "waves",
        list(
            most = 4,
            wanted = "a list of at most 4 waves, such as { spacing = 0.3, hold = 0.2 }"
        )
    )]
    pub waves: Vec<Wave>,
}

impl Default for Wave {
    /// Secondary veins of an entire blade, from the tip to the base.
    fn default() -> Self {
        Self {
            from: 1.0,
            until: 2.0,
            spacing: 0.3,
            sequence: Sequence::Basipetal,
            zone: [0.2, 0.9],
            transport: 0.5,
            rates: [1.0, 1.0],
            hold: 0.0,
            hold_base: 0.0,
            terminal: 0.6,
            sinus: 1.5,
            blunt: 1.5,
            lean: 0.0,
            bow: 0.03,
            splay: 0.0,
        }
    }
}

impl Default for Primordium {
    fn default() -> Self {
        Self {
            width: 0.5,
            widest_at: 0.45,
            taper_base: 0.7,
            taper_tip: 0.7,
        }
    }
}

impl Default for DevelopmentPlan {
    /// An entire, elliptic leaf with a midrib and no other vein.
    fn default() -> Self {
        Self {
            primordium: Primordium::default(),
            growth: 20.0,
            basal_growth: 0.0,
            waves: Vec::new(),
            irregularity: 0.3,
            resolution: 100,
        }
    }
}
