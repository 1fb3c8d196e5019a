//! Leaves in other colours than summer's green: the contents of their tissues, each number with its
//! source.
//!
//! - **In**: the name of a preset.
//! - **Out**: its [`ColouredLeaf`]. The preset's plan is made from it, so that documented and grown
//!   numbers agree.
//! - **Always true**: every value lies within its range.
//! - **Left out**: the places of the colours (widths of margins, delays, parameters of mosaics).
//!   They are by eye unless the preset says otherwise.

mod autumn;
#[cfg(test)]
mod claims;
mod contours;
mod evergreen;
mod numbers;

use self::autumn::{BIRCH, GINKGO, OAK_LITTER, POPLAR, RED_MAPLE, SUGAR_MAPLE, SWEETGUM};
use self::evergreen::{ACER_VARIEGATED, AMARANTH, COTINUS, CROTON, IRON_CHLOROSIS, IVY};
use super::leaf_traits::{LeafTraits, Quantity};
use crate::leaf::LeafPlan;
use crate::optics::{Constituent, Contents, PerConstituent};

/// All of them, in the order of the book.
pub(super) static COLOURED: [ColouredLeaf; 13] = [
    GINKGO,
    BIRCH,
    POPLAR,
    SUGAR_MAPLE,
    RED_MAPLE,
    SWEETGUM,
    OAK_LITTER,
    COTINUS,
    ACER_VARIEGATED,
    IVY,
    IRON_CHLOROSIS,
    CROTON,
    AMARANTH,
];

/// The contents of a leaf whose colour is not summer's green.
#[derive(Clone, Copy, Debug)]
pub struct ColouredLeaf {
    /// Name of the preset.
    pub preset: &'static str,
    /// The species, in Latin, and which leaf of it.
    pub species: &'static str,
    /// The green leaf of the species; a tissue holds the same unless another value is given.
    pub green: &'static LeafTraits,
    /// Tissues whose contents differ from the green leaf's.
    pub tissues: &'static [Holding],
    /// The days of its ageing, if its colour comes from ageing.
    pub age: Option<Age>,
    /// Makes the plan.
    plan: fn(&Self) -> LeafPlan,
}

/// The contents of a tissue that differ from the green leaf's.
#[derive(Clone, Copy, Debug)]
pub struct Holding {
    /// The tissue: `turned` has aged and still lives, `dead` is litter; other names are places or
    /// types of cells.
    pub tissue: &'static str,
    /// The contents that differ.
    pub contents: PerConstituent<Option<Quantity>>,
}

/// The days of an ageing leaf.
#[derive(Clone, Copy, Debug)]
pub struct Age {
    /// Days since ageing began at the place that ages first.
    pub day: Quantity,
    /// Half-life of the chlorophyll, days.
    pub half_days: Quantity,
    /// Day on which the first tissue dies.
    pub death_day: Quantity,
}

/// The coloured leaf of a preset, if it has one.
pub fn coloured(preset: &str) -> Option<&'static ColouredLeaf> {
    COLOURED.iter().find(|leaf| leaf.preset == preset)
}

/// All of them, in the order of the book.
#[cfg(test)]
pub(crate) fn all_coloured() -> impl Iterator<Item = &'static ColouredLeaf> {
    COLOURED.iter()
}

impl ColouredLeaf {
    /// The plan of the leaf.
    pub(super) fn plan(&self) -> LeafPlan {
        (self.plan)(self)
    }

    /// The quantities that differ from the green leaf, with name and unit.
    pub fn quantities(&self) -> Vec<(String, &'static str, Quantity)> {
        let mut all = Vec::new();
        for Holding { tissue, contents } in self.tissues {
            for (constituent, quantity) in *contents {
                let Some(quantity) = quantity else { continue };
                let name = constituent.name().replace('_', " ");
                all.push((format!("{tissue}: {name}"), constituent.unit(), quantity));
            }
        }
        if let Some(age) = &self.age {
            for (name, quantity) in [
                ("day", age.day),
                ("half of chlorophyll gone", age.half_days),
                ("first tissue dies", age.death_day),
            ] {
                all.push((name.to_owned(), "days", quantity));
            }
        }
        all
    }

    /// The contents of a tissue; `None` if the table has no such tissue.
    pub fn held(&self, tissue: &str) -> Option<Contents> {
        let holding = self
            .tissues
            .iter()
            .find(|holding| holding.tissue == tissue)?;
        let green = self.green.contents();
        let held = |value, told: Option<Quantity>| told.map_or(value, |quantity| quantity.value);
        Some(Contents(green.zip_with(holding.contents, held)))
    }

    /// The contents of a tissue of the table.
    fn of(&self, tissue: &str) -> Contents {
        self.held(tissue)
            .expect("the table tells of all tissues that its plan asks for")
    }
}

impl Holding {
    /// A tissue with the contents of the green leaf.
    const fn new(tissue: &'static str) -> Self {
        Self {
            tissue,
            contents: PerConstituent::splat(None),
        }
    }

    const fn with(mut self, constituent: Constituent, quantity: Quantity) -> Self {
        self.contents = self.contents.with(&[(constituent, Some(quantity))]);
        self
    }

    const fn structure(self, quantity: Quantity) -> Self {
        self.with(Constituent::Structure, quantity)
    }

    const fn chlorophyll(self, quantity: Quantity) -> Self {
        self.with(Constituent::Chlorophyll, quantity)
    }

    const fn carotenoids(self, quantity: Quantity) -> Self {
        self.with(Constituent::Carotenoids, quantity)
    }

    const fn anthocyanins(self, quantity: Quantity) -> Self {
        self.with(Constituent::Anthocyanins, quantity)
    }

    const fn betacyanins(self, quantity: Quantity) -> Self {
        self.with(Constituent::Betacyanins, quantity)
    }

    const fn betaxanthins(self, quantity: Quantity) -> Self {
        self.with(Constituent::Betaxanthins, quantity)
    }

    const fn brown(self, quantity: Quantity) -> Self {
        self.with(Constituent::Brown, quantity)
    }

    const fn water(self, quantity: Quantity) -> Self {
        self.with(Constituent::Water, quantity)
    }

    const fn dry_matter(self, quantity: Quantity) -> Self {
        self.with(Constituent::DryMatter, quantity)
    }
}
