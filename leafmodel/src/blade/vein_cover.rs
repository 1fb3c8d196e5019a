//! The share of veins in the tissue at a point.

/// The share of veins in the tissue at a point, or in the mean around it where the picture of the
/// tissue is too coarse for the vein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinCover {
    /// 0 between veins to 1 over a fully developed one; finer veins reach less.
    pub weight: f64,
    /// Share of what `weight` is the mean of that lies in the vein, above 0 to 1: there the weight is
    /// `weight / share`, and beside it 0.
    pub share: f64,
    /// The weight by which chlorophyll and carotenoids change: above `weight` where `share` is below
    /// 1, since a little clear tissue lets more light through than its chlorophyll that is spread
    /// out would; as [`ContentsMap::paint`](super::contents_map::ContentsMap::paint) has it.
    pub greens: f64,
    /// `r / r_full − 1` on the axis of a vein of radius `r > r_full`, falling to 0 at its edge; 0
    /// elsewhere. With a [`VeinBody`](super::vein_body::VeinBody): layers as thick as the blade by
    /// which the vein is thicker.
    pub excess: f64,
}

impl VeinCover {
    /// No vein.
    pub const NONE: Self = Self::of(0.0, 0.0);

    /// A vein of this weight and excess all around the point.
    #[must_use]
    pub const fn of(weight: f64, excess: f64) -> Self {
        Self {
            weight,
            share: 1.0,
            greens: weight,
            excess,
        }
    }
}

/// Covers of several veins near one point, added up to that of all.
///
/// Of veins that are seen as they are the strongest counts. Of those that are averaged over a texel
/// each counts where the strongest is not: `w = w₁ + (1 − p₁) (w₂ + w₃ + …)`, with the share `p₁` of
/// the strongest. A piece of a vein whose end is nearer than its sides is left out of the sum, so that
/// pieces of one vein that follow one another count once.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Covers {
    strongest: Moments,
    is_beside: bool,
    beside: Moments,
    excess: f64,
}

/// Means of a weight and of its square.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    pub(super) mean: f64,
    pub(super) square: f64,
}

impl Moments {
    /// Share of the place over which a weight that is 0 elsewhere is spread evenly.
    fn share(self) -> f64 {
        if self.square > 0.0 {
            (self.mean * self.mean / self.square).min(1.0)
        } else {
            1.0
        }
    }
}

impl Covers {
    /// Adds a piece of a vein; `is_beside` if the point lies beside it and not beyond an end.
    pub(super) fn add(&mut self, weight: Moments, is_beside: bool, excess: f64) {
        if is_beside {
            self.beside.mean += weight.mean;
            self.beside.square += weight.square;
        }
        if weight.mean > self.strongest.mean {
            self.strongest = weight;
            self.is_beside = is_beside;
        }
        self.excess = self.excess.max(excess);
    }

    /// That of all.
    pub(super) fn all(self) -> VeinCover {
        let first = self.strongest;
        let outside = 1.0 - first.share();
        let own = if self.is_beside {
            first
        } else {
            Moments::default()
        };
        let with = |first: f64, beside: f64, own: f64| first + outside * (beside - own).max(0.0);
        let weight = with(first.mean, self.beside.mean, own.mean).min(1.0);
        let square = with(first.square, self.beside.square, own.square);
        let share = Moments {
            mean: weight,
            square: square.min(weight),
        }
        .share();
        VeinCover {
            share,
            ..VeinCover::of(weight, self.excess)
        }
    }
}
