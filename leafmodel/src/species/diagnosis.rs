//! What floras count and measure on leaves of a species, held against a grown leaf.
//!
//! - **In**: the name of a preset that stands for a species, its plan, outline and veins.
//! - **Out**: [`Finding`]s: a trait, what was found, the range of a flora with its source.
//! - **Left out**: the net of fine veins, for which no flora gives numbers;
//!   `docs/src/theory/species.md` holds it against cleared leaves.

use super::leaf_traits::{LeafTraits, Provenance, Source, traits};
use crate::leaf::LeafPlan;
use crate::measure::description::{Description, describe};
use crate::measure::projections::{Projections, projections};
use crate::measure::{Measures, shape};
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// What can be counted or measured on a leaf with the naked eye and a ruler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Countable {
    WidthOverLength,
    PetioleMm,
    PetioleOverLength,
    Primaries,
    Pairs,
    Lobes,
    TeethASide,
    TeethPerCm,
}

/// A trait of a species and the range that a flora gives.
struct Known {
    preset: &'static str,
    what: Countable,
    range: [f64; 2],
    source: Source,
}

const fn known(
    preset: &'static str,
    what: Countable,
    range: [f64; 2],
    key: &'static str,
    says: &'static str,
) -> Known {
    let source = Source { key, says };
    Known {
        preset,
        what,
        range,
        source,
    }
}

use Countable::{
    Lobes, Pairs, PetioleMm, PetioleOverLength, Primaries, TeethASide, TeethPerCm, WidthOverLength,
};

/// By the order of the book. Where a flora puts rare extremes in brackets, they are left out,
/// except for a poplar's teeth: floras count those of early and of late leaves apart.
static KNOWN: &[Known] = &[
    known(
        "cottonwood",
        WidthOverLength,
        [0.8, 1.2],
        "fna7",
        "width 4/5 to 6/5 of the length",
    ),
    known(
        "cottonwood",
        PetioleMm,
        [30.0, 80.0],
        "fna7",
        "petiole (1–) 3–8 (–13) cm",
    ),
    known(
        "cottonwood",
        TeethASide,
        [5.0, 40.0],
        "fna7",
        "teeth a side 5–15 in early leaves, 25–40 in late ones",
    ),
    known(
        "aspen",
        TeethASide,
        [18.0, 30.0],
        "gleason1991",
        "short shoots: mostly 18–30 teeth a side",
    ),
    known(
        "aspen",
        PetioleMm,
        [30.0, 70.0],
        "tremuloides",
        "petiole 3–7 cm",
    ),
    known("maple", Lobes, [5.0, 5.0], "turkeyflora", "5-lobed"),
    known(
        "maple",
        Primaries,
        [5.0, 5.0],
        "turkeyflora",
        "5-lobed, a primary to each lobe",
    ),
    known(
        "maple",
        PetioleMm,
        [60.0, 200.0],
        "turkeyflora",
        "petiole 6–20 cm",
    ),
    known("white-oak", Lobes, [5.0, 9.0], "ps4910", "5–9 lobes"),
    known("red-oak", Lobes, [7.0, 11.0], "gleason1991", "7–11-lobed"),
    known(
        "ginkgo-leaf",
        PetioleMm,
        [30.0, 100.0],
        "ginkgoweb",
        "petiole 3–10 cm",
    ),
    known(
        "birch",
        Pairs,
        [6.0, 7.0],
        "turkeyflora",
        "6–7 pairs of lateral veins",
    ),
    known(
        "birch",
        PetioleOverLength,
        [1.0 / 3.0, 0.5],
        "turkeyflora",
        "petiole 2–3 times shorter than the blade",
    ),
    known(
        "willow",
        TeethPerCm,
        [7.0, 10.0],
        "gleason1991",
        "7–10 teeth to a centimetre of margin",
    ),
    known(
        "willow",
        PetioleMm,
        [3.0, 6.0],
        "gleason1991",
        "petioles 3–6 mm",
    ),
    known(
        "cherry-leaf",
        Pairs,
        [4.0, 7.0],
        "foc9",
        "4–7 secondary veins a side",
    ),
    known(
        "cherry-leaf",
        PetioleMm,
        [2.0, 8.0],
        "foc9",
        "petiole 2–8 mm",
    ),
    known(
        "sweetgum-leaf",
        Lobes,
        [3.0, 7.0],
        "britton1913",
        "deeply 3–7-lobed",
    ),
    known(
        "sweetgum-leaf",
        PetioleMm,
        [60.0, 100.0],
        "fna3",
        "petioles (44–) 60–100 (–150) mm",
    ),
    known("alchemilla-leaf", Lobes, [7.0, 9.0], "foc9", "7–9-lobed"),
    known(
        "alchemilla-leaf",
        PetioleMm,
        [100.0, 180.0],
        "foc9",
        "petiole 10–18 cm",
    ),
    known("ivy", Lobes, [3.0, 5.0], "agrobase", "3–5-lobed"),
    known(
        "ivy",
        PetioleMm,
        [25.0, 110.0],
        "agrobase",
        "petiole 2.5–11 cm",
    ),
    known(
        "croton",
        PetioleMm,
        [2.0, 25.0],
        "foc11",
        "petiole 0.2–2.5 cm",
    ),
];

/// A trait of a grown leaf beside what is known of its species.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    let Some(traits) = traits(preset) else {
        return Vec::new();
    };
    let leaf = Counted {
        plan,
        shape: shape(outline),
        description: describe(outline, network),
        projections: projections(outline, network),
    };
    let of_species = KNOWN.iter().filter(|known| known.preset == preset);
    let counted = of_species.filter_map(|known| leaf.finding(known));
    leaf.sizes(traits).into_iter().chain(counted).collect()
}

struct Counted<'a> {
    plan: &'a LeafPlan,
    shape: Measures,
    description: Description,
    projections: Projections,
}

impl Counted<'_> {
    /// What every species has.
    fn sizes(&self, traits: &LeafTraits) -> Vec<Finding> {
        let length = traits.length_mm;
        let length = ("length", "mm", "length_mm", length.range, length.from);
        let width = traits.width_mm;
        let width = ("width", "mm", "width_mm", width.range, width.from);
        let widest = traits.widest_at;
        let widest = ("widest at", "", "widest_at", widest.range, widest.from);
        let finding = |(name, unit, key, range, from)| {
            let found = self.shape.number(key)?;
            Some(Finding {
                name,
                unit,
                found,
                range,
                from,
            })
        };
        [length, width, widest]
            .into_iter()
            .filter_map(finding)
            .collect()
    }

    fn finding(&self, known: &Known) -> Option<Finding> {
        let petiole = self.plan.petiole.as_ref().map(|petiole| petiole.length);
        let [right, left] = self.description.secondaries;
        let mean = |[a, b]: [usize; 2]| 0.5 * (a + b) as f64;
        let (name, unit, found) = match known.what {
            WidthOverLength => (
                "width over length",
                "",
                self.shape.number("width_over_length")?,
            ),
            PetioleMm => ("petiole", "mm", petiole? * self.plan.length_mm),
            PetioleOverLength => ("petiole over blade", "", petiole?),
            Primaries => (
                "primary veins",
                "",
                (1 + self.description.lateral_primaries) as f64,
            ),
            Pairs => ("pairs of secondary veins", "", mean([right, left])),
            Lobes => ("lobes", "", self.projections.lobes as f64),
            TeethASide => ("teeth a side", "", mean(self.projections.teeth)),
            TeethPerCm => ("teeth per cm", "", self.projections.teeth_per_cm),
        };
        Some(Finding {
            name,
            unit,
            found,
            range: known.range,
            from: Provenance::Flora(known.source),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::leaf_traits::all;
    use crate::species::{find, grown_once};

    /// The preset that is the plant, where the species' own name is a figure of a paper.
    fn plant(species: &str) -> String {
        let organs = ["-leaf", "-blade", "-petal"];
        let names = organs.map(|organ| format!("{species}{organ}"));
        let named = names.into_iter().find(|name| find(name).is_some());
        named.unwrap_or_else(|| species.to_owned())
    }

    #[test]
    fn what_is_known_is_of_presets_that_stand_for_species() {
        for known in KNOWN {
            assert!(find(known.preset).is_some(), "{}", known.preset);
            assert!(traits(known.preset).is_some(), "{}", known.preset);
            assert!(known.range[0] <= known.range[1], "{}", known.source.says);
        }
    }

    #[test]
    fn every_countable_trait_lies_within_its_range_for_fifteen_of_seventeen_species() {
        let mut outside = Vec::new();
        let mut good = 0;
        for species in all() {
            let name = plant(species.preset);
            let plan = find(&name).expect("a preset").plan();
            let lamina = grown_once::lamina(&name);
            let found = findings(&name, &plan, &lamina.outline, &lamina.network);
            assert!(found.len() >= 3, "{name}");
            let out: Vec<&Finding> = found.iter().filter(|finding| !finding.is_in()).collect();
            good += usize::from(out.is_empty());
            let told = out
                .iter()
                .map(|f| format!("{name}: {} {} not in {:?}", f.name, f.found, f.range));
            outside.extend(told);
        }
        assert!(good >= 15, "{good}: {outside:#?}");
    }
}
