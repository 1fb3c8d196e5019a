//! The 28 leaves of Young 2010, Figs. 3–9, by their parameters.
//!
//! - **Out**: a [`Form`] for each panel; `shape()` is its outline's [`GrowthForm`].
//! - **Left out**: the paper's model has only the veins that steer growth; the presets' venation is
//!   our own.

#[cfg(test)]
mod tests;

use super::green_leaf;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::shape::growth_form::{Axis, GrowthForm, HalfForm, VeinRow};
use crate::venation::plan::{AuxinPlan, Growth};

/// Rows of cells, the paper's typical value.
const ROWS: u16 = 150;

/// Rows, from 1, of the veins of Figs. 7 and 8, which the paper does not print. With veins some 30
/// rows apart, its paired values of `a` for `n` = 1 and 2 give equally deep notches.
const OAK_VEINS: [u16; 5] = [15, 45, 75, 105, 135];

/// Rows, from 1, and slopes of the splayed veins of Fig. 9, which the paper does not print either:
/// by eye.
const MAPLE_VEINS: [(u16, f64); 4] = [(31, -0.8), (64, 0.07), (97, 0.93), (130, 1.8)];

/// Secondary veins of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FormVeins {
    /// One slope for all rows and no lobes (Figs. 3–6).
    Slope(f64),
    /// Five veins of slope 0.7 a side (Figs. 7 and 8).
    Oak,
    /// Four splayed veins a side (Fig. 9).
    Maple,
}

/// One of the 28 forms. The letters are the paper's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// Name of the preset: `young-` and the figure's panel.
    pub name: &'static str,
    /// Its botanical term, and plants that have it, by the figure's caption and section IV.
    pub about: &'static str,
    /// `R`, axial over greatest lateral growth rate.
    pub rate_ratio: f64,
    /// `yd`, where lateral growth is fastest.
    pub widest_at: f64,
    /// `k`, exponent of the fall to both sides of `yd`.
    pub falloff: f64,
    /// `n`, exponent of the fall away from a vein: 1 for pointed, 2 for rounded lobes.
    pub lobe_exponent: f64,
    /// `a`, how fast growth falls off away from a vein: the greater, the deeper the sinuses.
    pub lobe_decay: f64,
    /// Where veins are, and their slopes `s`.
    pub veins: FormVeins,
}

/// An entire leaf from its name, description, `R`, `yd`, `k` and `s`.
const fn entire(
    name: &'static str,
    about: &'static str,
    [rate_ratio, widest_at, falloff, slope]: [f64; 4],
) -> Form {
    Form {
        name,
        about,
        rate_ratio,
        widest_at,
        falloff,
        lobe_exponent: 1.0,
        lobe_decay: 0.0,
        veins: FormVeins::Slope(slope),
    }
}

/// A dissected leaf of Figs. 7–9 from its name, description, veins, `n` and `a`.
const fn dissected(
    name: &'static str,
    about: &'static str,
    veins: FormVeins,
    lobe_exponent: f64,
    lobe_decay: f64,
) -> Form {
    Form {
        name,
        about,
        rate_ratio: 1.2,
        widest_at: 0.3,
        falloff: 3.0,
        lobe_exponent,
        lobe_decay,
        veins,
    }
}

/// All forms, in the order of the figures.
#[rustfmt::skip]
pub static FORMS: [Form; 28] = [
    entire("young-3a", "Fig. 3a: broadly ovate, R = 1.07; poplars", [1.07, 0.3, 2.5, 0.0]),
    entire("young-3b", "Fig. 3b: ovate, R = 1.2; poplars", [1.2, 0.3, 2.5, 0.0]),
    entire("young-3c", "Fig. 3c: broadly lanceolate, R = 1.5; willows", [1.5, 0.3, 2.5, 0.0]),
    entire("young-3d", "Fig. 3d: lanceolate, R = 1.71; willows", [1.71, 0.3, 2.5, 0.0]),
    entire("young-4a", "Fig. 4a: deltoid, widest at 0.1; birch, cocklebur", [1.2, 0.1, 2.5, 0.0]),
    entire("young-4b", "Fig. 4b: ovate, widest at 0.4; poplar, alder, elm", [1.2, 0.4, 2.5, 0.0]),
    entire("young-4c", "Fig. 4c: obovate, widest at 0.7; magnolia", [1.2, 0.7, 2.5, 0.0]),
    entire("young-4d", "Fig. 4d: obdeltoid, widest at 0.9; ginkgo", [1.2, 0.9, 2.5, 0.0]),
    entire("young-5a", "Fig. 5a: concave, k = 1; in no flora that the author looked through", [1.2, 0.5, 1.0, 0.0]),
    entire("young-5b", "Fig. 5b: rhombic, k = 1.5; Jodina rhombifolia", [1.2, 0.5, 1.5, 0.0]),
    entire("young-5c", "Fig. 5c: orbiculate, k = 3; oregano, blackberry", [1.2, 0.5, 3.0, 0.0]),
    entire("young-5d", "Fig. 5d: oblong, k = 9; buckthorn, fig", [1.2, 0.5, 9.0, 0.0]),
    entire("young-6a", "Fig. 6a: cordate or reniform, slope −1.5; arrowhead", [1.2, 0.5, 3.0, -1.5]),
    entire("young-6b", "Fig. 6b: deltoid, slope −0.7; morning glory", [1.2, 0.5, 3.0, -0.7]),
    entire("young-6c", "Fig. 6c: obdeltoid, slope 1.1", [1.2, 0.5, 3.0, 1.1]),
    entire("young-6d", "Fig. 6d: obcordate or winged, slope 3; bauhinias", [1.2, 0.5, 3.0, 3.0]),
    dissected("young-7a", "Fig. 7a: entire oak leaf; Quercus myrtifolia", FormVeins::Oak, 2.0, 0.0),
    dissected("young-7b", "Fig. 7b: serrated, rounded; Quercus chapmanii", FormVeins::Oak, 2.0, 0.0001),
    dissected("young-7c", "Fig. 7c: rounded lobes; Quercus alba", FormVeins::Oak, 2.0, 0.0003),
    dissected("young-7d", "Fig. 7d: dissected, rounded lobes; Quercus lobata", FormVeins::Oak, 2.0, 0.0008),
    dissected("young-8a", "Fig. 8a: entire oak leaf; Quercus myrtifolia", FormVeins::Oak, 1.0, 0.0),
    dissected("young-8b", "Fig. 8b: serrated, pointed; Quercus agrifolia", FormVeins::Oak, 1.0, 0.002),
    dissected("young-8c", "Fig. 8c: pointed teeth; Quercus engelmannii", FormVeins::Oak, 1.0, 0.004),
    dissected("young-8d", "Fig. 8d: dissected, pointed lobes; Quercus rubra", FormVeins::Oak, 1.0, 0.011),
    dissected("young-9a", "Fig. 9a: maple with narrow lobes; Acer elegantulum", FormVeins::Maple, 1.0, 0.03),
    dissected("young-9b", "Fig. 9b: maple with larger lobes; Acer campestre", FormVeins::Maple, 1.0, 0.01),
    dissected("young-9c", "Fig. 9c: maple with a nearly continuous margin; Acer conspicuum", FormVeins::Maple, 1.0, 0.002),
    dissected("young-9d", "Fig. 9d: maple without lobes; Acer caesium", FormVeins::Maple, 1.0, 0.0),
];

impl Form {
    /// The parameters of the growth algorithm.
    pub fn shape(&self) -> GrowthForm {
        let last = f64::from(ROWS - 1);
        let vein = |(row, slope): (u16, f64)| VeinRow::straight(f64::from(row - 1) / last, slope);
        let half = HalfForm {
            lobe_decay: self.lobe_decay,
            lobe_exponent: self.lobe_exponent,
            veins: match self.veins {
                FormVeins::Slope(slope) => vec![VeinRow::straight(0.5, slope)],
                FormVeins::Oak => OAK_VEINS.map(|row| vein((row, 0.7))).to_vec(),
                FormVeins::Maple => MAPLE_VEINS.map(vein).to_vec(),
            },
            ..HalfForm::entire(self.rate_ratio, self.widest_at, self.falloff)
        };
        let midrib = Axis {
            rows: usize::from(ROWS),
            ..half.into()
        };
        midrib.into()
    }

    /// The source of the numbers.
    pub(super) const fn source(&self) -> &'static str {
        match self.veins {
            FormVeins::Slope(_) => "outline: Young 2010; veins by eye",
            FormVeins::Oak => {
                "outline: Young 2010, five veins a side by what its values of a imply; veins by eye"
            }
            FormVeins::Maple => {
                "outline: Young 2010, four splayed veins a side by eye; veins by eye"
            }
        }
    }

    /// A green leaf 80 mm long with a closed net of veins.
    pub(super) fn plan(&self) -> LeafPlan {
        let venation = AuxinPlan {
            final_length: 350.0,
            source_birth_distance: 3.5,
            vein_birth_distance: 3.5,
            darts_per_area: 0.01,
            growth: Growth::Isogonic {
                initial_length: 50.0,
                length_step: 1.5,
            },
            murray_exponent: 2.3,
            veinlet_radius_mm: 0.015,
            ..AuxinPlan::default()
        };
        let outline = Contour::GrowthAlgorithm(self.shape()).into();
        green_leaf(80.0, 1, outline, venation)
    }
}
