//! The parameters of veins that are splines.

use crate::document::Declared;

/// Primary veins that fan out from the petiole beside the midrib.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct PalmateVeins {
    /// Primaries a side.
    #[key("per_side", required, 1..=12)]
    pub per_side: u32,
    /// How far down the margin they end: 1 spreads them evenly from base to tip.
    ///
    /// Distribution of their ends along the margin: 1 spreads them evenly from base to tip, smaller
    /// values gather them towards the tip.
    #[key("spread", required, 0.05..=1.0)]
    pub spread: f64,
    /// How much they bow outwards, in shares of half their length.
    #[key("bow", -0.8..=0.8)]
    pub bow: f64,
}

/// Parameters of the pattern. Lengths are in units of the leaf's length; the names are the
/// article's.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct ArcuatePlan {
    /// Veins: lateral veins a side of each primary.
    #[key("laterals", 1..=100)]
    pub veins: u32,
    /// Seed of their irregularity.
    #[key("seed", 0..=u32::MAX as u64)]
    pub seed: u32,
    /// How irregular they are.
    #[key("variation", 0.0..=1.0)]
    pub variation: f64,
    /// Width: half width of the midrib at the base. The default is the article's, where veins
    /// merge; a leaf's is about 0.006.
    #[key("width", 1e-4..=0.5)]
    pub width: f64,
    /// How far from veins the finer net reaches (field `net` only).
    #[key(
        "net_width",
        0.0..=1.0,
        about = "NWidth: how far from veins the finer net reaches (field `net` only)."
    )]
    pub net_width: f64,
    /// Squish: how end points are spread over the margin: 1 evenly (pinnate), 0 all at the tip
    /// (arcuate).
    #[key("squish", 0.0..=1.0)]
    pub squish: f64,
    /// Squish2: the same of control points.
    #[key("squish2", 0.0..=1.0)]
    pub squish2: f64,
    /// Squish3: the same of starting points on the midrib; 0 all near the base.
    #[key("squish3", 0.0..=1.0)]
    pub squish3: f64,
    /// Up: how far control points are from the midrib, over the margin's distance.
    #[key("up", 0.0..=2.0)]
    pub up: f64,
    /// Share of a vein's width that is left at its tip.
    ///
    /// Width of a vein at its tip as a share of that at its base Our extension; the article has 0.
    #[key("tip_width", 0.0..=1.0)]
    pub tip_width: f64,
    /// Primary veins from the base, beside the midrib.
    #[key("palmate", block, default = PalmateVeins { per_side: 1, spread: 0.5, bow: 0.0 })]
    pub palmate: Option<PalmateVeins>,
}

impl Default for ArcuatePlan {
    /// The article's defaults.
    fn default() -> Self {
        Self {
            veins: 7,
            seed: 42,
            variation: 0.0,
            width: 0.05,
            net_width: 0.25,
            squish: 0.5,
            squish2: 0.5,
            squish3: 0.5,
            up: 0.5,
            tip_width: 0.0,
            palmate: None,
        }
    }
}
