//! What floras count and measure on leaves of a species, held against a grown leaf.
//!
//! - **In**: the name of a preset that stands for a species, its plan, outline and veins.
//! - **Out**: [`Finding`]s: a trait, what was found, the range of a flora with its source.
//! - **Left out**: the net of fine veins, for which no flora gives numbers;
//!   `docs/src/theory/species.md` holds it against cleared leaves.

use super::traits::{Provenance, Quantity};
use super::{Preset, find};
use crate::leaf::LeafPlan;
use crate::measure::description::{Description, describe};
use crate::measure::projections::{Projections, projections};
use crate::measure::{Measures, shape};
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// A trait of a grown leaf beside what is known of its species.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What was counted or measured.
    pub name: &'static str,
    /// Its unit, empty for counts and ratios.
    pub unit: &'static str,
    /// What the grown leaf has.
    pub found: f64,
    /// What leaves of the species have.
    pub range: [f64; 2],
    /// Where the range is from.
    pub from: Provenance,
}

impl Finding {
    /// Whether the leaf is as the species in this, to a thousandth of the range's upper end.
    pub fn is_in(&self) -> bool {
        let [low, high] = self.range;
        let slack = 1e-3 * high.abs();
        (low - slack..=high + slack).contains(&self.found)
    }
}

/// Everything that is known of the species for which `preset` stands and can be counted on its
/// grown leaf; empty for a preset that stands for none.
pub fn findings(
    preset: &str,
    plan: &LeafPlan,
    outline: &Outline,
    network: &VenationNetwork,
) -> Vec<Finding> {
    let preset = find(preset);
    let traits = preset.and_then(Preset::traits);
    let green = traits.filter(|traits| !traits.is_coloured());
    let (Some(preset), Some(traits)) = (preset, green) else {
        return Vec::new();
    };
    let leaf = Counted {
        plan,
        shape: shape(outline),
        description: describe(outline, network),
        projections: projections(outline, network),
    };
    let sizes = SIZES.iter().filter_map(|(name, key)| {
        let found = leaf.shape.number(key)?;
        let size = traits.summer(name)?;
        Some(finding(name, found, size))
    });
    let counted = preset.counts().iter().filter_map(|count| {
        let (name, found) = leaf.count(&count.name)?;
        Some(finding(name, found, count))
    });
    sizes.chain(counted).collect()
}

/// What every species has, by the names of traits and of measures.
const SIZES: [(&str, &str); 3] = [
    ("length", "length_mm"),
    ("width", "width_mm"),
    ("widest at", "widest_at"),
];

fn finding(name: &'static str, found: f64, known: &Quantity) -> Finding {
    Finding {
        name,
        unit: known.unit,
        found,
        range: known.range,
        from: known.from.clone(),
    }
}

struct Counted<'a> {
    plan: &'a LeafPlan,
    shape: Measures,
    description: Description,
    projections: Projections,
}

impl Counted<'_> {
    /// What a flora counts under a name, as it is called in tables, and what this leaf has.
    fn count(&self, name: &str) -> Option<(&'static str, f64)> {
        let petiole = self.plan.petiole.as_ref().map(|petiole| petiole.length);
        let [right, left] = self.description.secondaries;
        let mean = |[a, b]: [usize; 2]| 0.5 * (a + b) as f64;
        let primaries = 1 + self.description.lateral_primaries;
        Some(match name {
            "width over length" => ("width over length", self.shape.number("width_over_length")?),
            "lobes" => ("lobes", self.projections.lobes as f64),
            "primaries" => ("primary veins", primaries as f64),
            "pairs" => ("pairs of secondary veins", mean([right, left])),
            "teeth per side" => ("teeth a side", mean(self.projections.teeth)),
            "teeth per cm" => ("teeth per cm", self.projections.teeth_per_cm),
            "petiole mm" => ("petiole", petiole? * self.plan.length_mm),
            "petiole over length" => ("petiole over blade", petiole?),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::{PRESETS, grown_once};

    #[test]
    fn what_floras_count_is_of_presets_that_are_species() {
        for preset in PRESETS.iter().filter(|preset| !preset.counts().is_empty()) {
            for count in preset.counts() {
                assert!(count.range[0] <= count.range[1], "{count:?}");
            }
        }
        for name in ["birch", "willow", "cherry-leaf", "alchemilla-leaf"] {
            assert!(find(name).expect("a preset").counts().len() >= 2, "{name}");
        }
    }

    #[test]
    fn every_countable_trait_lies_within_its_range_for_fifteen_of_seventeen_species() {
        let mut outside = Vec::new();
        let mut good = 0;
        // The plant itself, where the species' own name is a figure of a paper.
        let plants = PRESETS.iter().filter(|preset| {
            let is_figure = ["-leaf", "-blade", "-petal"]
                .iter()
                .any(|organ| find(&format!("{}{organ}", preset.name)).is_some());
            let green = preset.traits().is_some_and(|traits| !traits.is_coloured());
            green && !is_figure
        });
        for preset in plants {
            let name = preset.name;
            let lamina = grown_once::lamina(name);
            let found = findings(name, &preset.plan(), &lamina.outline, &lamina.network);
            assert!(found.len() >= 3, "{name}");
            let out: Vec<&Finding> = found.iter().filter(|finding| !finding.is_in()).collect();
            good += usize::from(out.is_empty());
            let reports = out
                .iter()
                .map(|f| format!("{name}: {} {} not in {:?}", f.name, f.found, f.range));
            outside.extend(reports);
        }
        assert!(good >= 15, "{good}: {outside:#?}");
    }
}
