//! What a development is told. Lengths are those of the primordium, whose midrib is 1.

/// The margin of the primordium, symmetric about its midrib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primordium {
    /// Its greatest width over its length, 0.02 to 3.
    pub width: f64,
    /// Where along the midrib it is widest, 0.05 to 0.95.
    pub widest_at: f64,
    /// How pointed the base is: 0.3 is nearly a box, 0.5 an ellipse, 1 a lens, 2 drawn out;
    /// 0.2 to 3.
    pub taper_base: f64,
    /// The same of the tip.
    pub taper_tip: f64,
}

/// In which sequence convergence points appear on the margin between those that are there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Length of the leaf when the first may appear, ≥ 1.
    pub from: f64,
    /// Length of the leaf after which none appears, above `from`.
    pub until: f64,
    /// Least distance along the margin from all other convergence points, 0.01 to 10.
    pub spacing: f64,
    /// In which sequence they appear.
    pub sequence: Sequence,
    /// The part of each side's margin where they appear, from the base (0) to the tip (1).
    pub zone: [f64; 2],
    /// What transport along veins costs over that through other tissue, 0 to 1: with 0 a vein
    /// joins the nearest one squarely, with 1 it runs to the base.
    pub transport: f64,
    /// How fast their veins elongate, over the leaf, where they arise at the base of the margin and
    /// at its tip; 0.5 to 1.5.
    pub rates: [f64; 2],
    /// How much growth is held back in the sinuses between them, 0 (not at all: an entire margin)
    /// to 1 (the margin keeps its distance from the veins: leaflets).
    pub hold: f64,
    /// How much of that applies between the base and the lowest of them, 0 to 1.
    pub hold_base: f64,
    /// How much of the margin between the uppermost of them and the leaf's tip belongs to the
    /// terminal lobe, 0.1 to 0.9.
    pub terminal: f64,
    /// How wide sinuses are: 1 pointed, 2 rounded, 4 broad; 0.3 to 8.
    pub sinus: f64,
    /// How blunt lobes are: 1 pointed, 2 rounded, 4 broad; 0.3 to 8.
    pub blunt: f64,
    /// Where sinuses lie between two points: 0 in the middle, towards 1 by the lower one, so that
    /// teeth point to the apex; −0.9 to 0.9.
    pub lean: f64,
    /// How far their veins arch, as a share of their length, −0.3 to 0.3; positive towards the tip.
    pub bow: f64,
    /// How much the angles of their veins with the parent's direction widen per e-fold of the
    /// leaf's length, −0.3 to 0.3.
    pub splay: f64,
}

/// Everything that decides a development.
#[derive(Clone, Debug, PartialEq)]
pub struct DevelopmentPlan {
    /// What it starts from.
    pub primordium: Primordium,
    /// How long the full-grown leaf is, in primordia, 1.1 to 1000.
    pub growth: f64,
    /// Where the midrib elongates: 0 evenly, towards 1 at the base, towards −1 at the tip; −0.9
    /// to 0.9.
    pub basal_growth: f64,
    /// Waves of initiation, at most 4.
    pub waves: Vec<Wave>,
    /// How irregular distances, rates and angles are, 0 to 1.
    pub irregularity: f64,
    /// Points of the margin per length of the leaf, 20 to 400.
    pub resolution: u32,
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
