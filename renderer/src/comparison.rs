//! Networks of veins, or groups of leaves, side by side: how each measure differs, and how sure that is.
//!
//! - **In**: leaves with their measures and single values, by group.
//! - **Out**: [`Findings`]: effects, tests with corrections, and what a person should know of them.
//! - **Always true**: no group is compared with a leaf of its own; each correction counts all tests of
//!   its kind.
//! - **Left out**: where leaves come from, and how findings are written.

pub(crate) mod compared;
pub(crate) mod leaves;

use self::compared::{Compared, SpreadContrast, Tested, limit};
use self::leaves::{Leaf, same};

/// Groups whose names are a title.
const MOST_NAMES: usize = 5;

/// What is compared, and how.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wanted {
    /// What the report is called.
    pub(crate) title: Option<String>,
    /// Measures and kinds of values that are compared; all without any.
    pub(crate) only: Vec<String>,
    /// Whether each group is compared with each, not all with the first.
    pub(crate) all_pairs: bool,
    /// Seed of the divisions of leaves that are drawn.
    pub(crate) seed: u64,
    /// Pairs of leaves that are drawn over each other.
    pub(crate) overlays: Vec<[usize; 2]>,
}

/// All that is known of leaves that were compared.
#[derive(Clone, Debug)]
pub(crate) struct Findings {
    pub(crate) title: String,
    /// Names of the groups; each network is one of its own where none were given.
    pub(crate) groups: Vec<String>,
    pub(crate) leaves: Vec<Leaf>,
    /// Whether each group is one leaf.
    pub(crate) is_single: bool,
    pub(crate) compared: Compared,
    /// Pairs of leaves that are drawn over each other.
    pub(crate) overlays: Vec<[usize; 2]>,
    /// What a person should know.
    pub(crate) notes: Vec<String>,
    /// Seed of the divisions of leaves that were drawn.
    pub(crate) seed: u64,
}

impl Findings {
    /// Compares leaves of groups with these names.
    ///
    /// # Errors
    ///
    /// Two leaves of one group that are the same, by number: they would count as two.
    pub(crate) fn new(
        groups: Vec<String>,
        leaves: Vec<Leaf>,
        wanted: Wanted,
    ) -> Result<Self, [usize; 2]> {
        let pairs = same(&leaves);
        let twice = |[one, other]: &[usize; 2]| leaves[*one].group == leaves[*other].group;
        if let Some(pair) = pairs.iter().copied().find(twice) {
            return Err(pair);
        }
        let compared = Compared::new(
            &leaves,
            groups.len(),
            wanted.all_pairs,
            &wanted.only,
            wanted.seed,
        );
        let title = wanted.title.unwrap_or_else(|| {
            if groups.len() > MOST_NAMES {
                format!("{} networks", leaves.len())
            } else {
                groups.join(", ")
            }
        });
        let mut findings = Self {
            title,
            is_single: leaves.len() == groups.len(),
            groups,
            leaves,
            compared,
            overlays: wanted.overlays,
            notes: Vec::new(),
            seed: wanted.seed,
        };
        findings.notes = findings.notes_of(&pairs);
        Ok(findings)
    }

    /// The test of a distribution that counts: with leaves as the unit, or, where networks are
    /// compared one by one, with single values.
    pub(crate) fn headline(&self, contrast: &SpreadContrast) -> Option<Tested> {
        if self.is_single {
            contrast.as_if_independent.kolmogorov_smirnov?.tested
        } else {
            contrast.leaves_permuted?.tested
        }
    }

    /// The distance that goes with it.
    pub(crate) fn distance(&self, contrast: &SpreadContrast) -> Option<f64> {
        if self.is_single {
            Some(
                contrast
                    .as_if_independent
                    .kolmogorov_smirnov?
                    .found
                    .distance,
            )
        } else {
            Some(contrast.leaves_permuted?.found.distance)
        }
    }

    /// How many leaves a group has.
    pub(crate) fn size(&self, group: usize) -> usize {
        let members = self.leaves.iter().filter(|leaf| leaf.group == group);
        members.count()
    }

    /// What a person should know of the comparison as a whole.
    fn notes_of(&self, same: &[[usize; 2]]) -> Vec<String> {
        let mut notes = Vec::new();
        for pair in same {
            let [one, other] = pair.map(|leaf| self.leaves[leaf].name.as_str());
            notes.push(format!("{one} and {other} are the same network"));
        }
        if self.is_single {
            notes.push(
                "each network stands for itself: tests of its areoles and veins tell whether two \
                 networks differ, not whether leaves of two kinds do; for that compare groups of leaves \
                 (--group)"
                    .to_owned(),
            );
        } else {
            let alone = (0..self.groups.len()).filter(|group| self.size(*group) == 1);
            notes.extend(alone.map(|group| {
                format!(
                    "{} is one leaf: nothing tells how leaves of its kind differ; it is tested \
                     as one leaf among those of a group, as if its kind spread as much",
                    self.groups[group]
                )
            }));
            for pair in &self.compared.pairs {
                let [one, other] = pair.map(|group| self.groups[group].as_str());
                let found = limit(self.size(pair[0]), self.size(pair[1]));
                notes.extend(found.map(|text| format!("{one} and {other}: {text}")));
            }
        }
        if !self.compared.absent.is_empty() {
            notes.push(format!("no leaf has {}", self.compared.absent.join(", ")));
        }
        notes
    }
}
