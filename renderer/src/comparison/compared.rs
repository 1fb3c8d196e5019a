//! What is different between groups of leaves, and how sure that is.

use std::collections::BTreeMap;

use leafmodel::measure::comparison::{
    Among, Effect, Permuted, Ranks, Steps, Summary, Welch, benjamini_hochberg, cliffs_delta,
    hedges_g, holm, kolmogorov_smirnov, mann_whitney, one_among, permuted_leaves, smallest_p,
    summary, welch,
};
use leafmodel::measure::definition;
use rayon::prelude::*;
use serde::Serialize;

use super::leaves::Leaf;

/// Numbers whose difference is a smaller share of them are the same.
const ROUNDING: f64 = 1e-12;

/// P-values up to this count.
pub(crate) const LEVEL: f64 = 0.05;

/// The kind of values that lie where the program has put points: their number means nothing.
pub(crate) const PROBES: &str = "vein_distance";

/// A p-value, and what is left of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Tested {
    pub(crate) p: f64,
    /// Corrected by Holm.
    pub(crate) holm: f64,
    /// Corrected by Benjamini and Hochberg.
    pub(crate) fdr: f64,
}

/// What a test has found, and its p-value if that counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Test<T> {
    #[serde(flatten)]
    pub(crate) found: T,
    pub(crate) tested: Option<Tested>,
}

impl<T> Test<T> {
    fn new(found: T, p: impl Into<Option<f64>>) -> Self {
        let tested = p.into().map(|p| Tested { p, holm: p, fdr: p });
        Self { found, tested }
    }
}

/// One measure in all groups.
#[derive(Clone, Debug)]
pub(crate) struct Measure {
    pub(crate) key: &'static str,
    /// Which part of a list: the vein order.
    pub(crate) part: Option<usize>,
    pub(crate) unit: &'static str,
    pub(crate) definition: &'static str,
    /// Leaf and value, by group.
    pub(crate) values: Vec<Vec<(usize, f64)>>,
    pub(crate) summaries: Vec<Option<Summary>>,
    /// In the order of the pairs.
    pub(crate) contrasts: Vec<Contrast>,
}

/// How a measure of one group differs from that of another.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Contrast {
    /// Of means: the second less the first.
    pub(crate) difference: Option<f64>,
    /// Its interval by Welch's test.
    difference_interval_95: Option<[f64; 2]>,
    /// Of means: the second over the first, if both have one sign.
    pub(crate) ratio: Option<f64>,
    pub(crate) welch: Option<Test<Welch>>,
    /// Where one of the groups is a single leaf: that leaf among those of the other.
    pub(crate) one_among_others: Option<Test<Among>>,
    pub(crate) mann_whitney: Option<Test<Ranks>>,
    pub(crate) hedges_g: Option<Effect>,
    pub(crate) cliffs_delta: Option<Effect>,
    /// Why there is no test.
    pub(crate) untested: Option<&'static str>,
}

impl Contrast {
    /// The test of means, of whichever kind there is.
    pub(crate) fn means(&self) -> Option<Tested> {
        let welch = self.welch.and_then(|test| test.tested);
        welch.or_else(|| self.one_among_others?.tested)
    }

    /// The test of ranks.
    pub(crate) fn orders(&self) -> Option<Tested> {
        self.mann_whitney?.tested
    }
}

/// All single values of a kind in all groups.
#[derive(Clone, Debug)]
pub(crate) struct Distribution {
    pub(crate) kind: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) definition: &'static str,
    /// Leaves that have values, by group.
    pub(crate) leaves: Vec<Vec<usize>>,
    /// How many values each group has.
    pub(crate) counts: Vec<usize>,
    /// The mean of the medians of a group's leaves.
    pub(crate) medians: Vec<Option<f64>>,
    pub(crate) contrasts: Vec<SpreadContrast>,
}

/// How values of one kind differ between two groups.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct SpreadContrast {
    /// Leaves as the unit.
    pub(crate) leaves_permuted: Option<Test<Permuted>>,
    pub(crate) as_if_independent: Pooled,
    /// Why there is no test.
    pub(crate) untested: Option<&'static str>,
}

/// All values of a group together, as if each were independent.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Pooled {
    pub(crate) kolmogorov_smirnov: Option<Test<Steps>>,
    pub(crate) mann_whitney: Option<Test<Ranks>>,
    pub(crate) cliffs_delta: Option<Effect>,
}

/// All that is found.
#[derive(Clone, Debug)]
pub(crate) struct Compared {
    /// Numbers of two groups each; the first is the one with which the second is compared.
    pub(crate) pairs: Vec<[usize; 2]>,
    pub(crate) measures: Vec<Measure>,
    pub(crate) distributions: Vec<Distribution>,
    /// Measures that no leaf has.
    pub(crate) absent: Vec<&'static str>,
    /// How many tests each correction counts: of means, orders, and distributions.
    pub(crate) tests: [usize; 3],
}

impl Compared {
    /// Compares all leaves; `only` these measures and kinds, if it names any.
    pub(crate) fn new(
        leaves: &[Leaf],
        groups: usize,
        all_pairs: bool,
        only: &[String],
        seed: u64,
    ) -> Self {
        let firsts = if all_pairs { groups } else { 1 };
        let pairs: Vec<[usize; 2]> = (0..firsts)
            .flat_map(|first| (first + 1..groups).map(move |second| [first, second]))
            .collect();
        let is_wanted = |key: &str| only.is_empty() || only.iter().any(|wanted| wanted == key);
        let (mut measures, absent) = gathered(leaves, groups, &is_wanted);
        let size = |group| leaves.iter().filter(|leaf| leaf.group == group).count();
        let sizes: Vec<usize> = (0..groups).map(size).collect();
        measures.par_iter_mut().for_each(|measure| {
            let contrast = |pair: &[usize; 2]| measure.contrast(*pair, &sizes);
            measure.contrasts = pairs.iter().map(contrast).collect();
        });
        let mut distributions = kinds(leaves, groups, &is_wanted);
        distributions.par_iter_mut().for_each(|distribution| {
            let contrast = |pair: &[usize; 2]| distribution.contrast(*pair, leaves, seed);
            distribution.contrasts = pairs.iter().map(contrast).collect();
        });
        let mut compared = Self {
            pairs,
            measures,
            distributions,
            absent,
            tests: [0; 3],
        };
        compared.correct();
        compared
    }

    /// Corrects the p-values of each kind of test for the number of such tests.
    fn correct(&mut self) {
        let (mut means, mut orders) = (Vec::new(), Vec::new());
        let measures = self.measures.iter_mut();
        for contrast in measures.flat_map(|measure| measure.contrasts.iter_mut()) {
            means.extend(tested(&mut contrast.welch));
            means.extend(tested(&mut contrast.one_among_others));
            orders.extend(tested(&mut contrast.mann_whitney));
        }
        let (mut permuted, mut steps, mut pooled_orders) = (Vec::new(), Vec::new(), Vec::new());
        let distributions = self.distributions.iter_mut();
        for contrast in distributions.flat_map(|distribution| distribution.contrasts.iter_mut()) {
            let pooled = &mut contrast.as_if_independent;
            permuted.extend(tested(&mut contrast.leaves_permuted));
            steps.extend(tested(&mut pooled.kolmogorov_smirnov));
            pooled_orders.extend(tested(&mut pooled.mann_whitney));
        }
        let spreads = permuted.len().max(steps.len());
        self.tests = [means.len(), orders.len(), spreads];
        for tests in [means, orders, permuted, steps, pooled_orders] {
            correct(tests);
        }
    }
}

fn tested<T>(test: &mut Option<Test<T>>) -> Option<&mut Tested> {
    test.as_mut()?.tested.as_mut()
}

fn correct(tests: Vec<&mut Tested>) {
    let p: Vec<f64> = tests.iter().map(|tested| tested.p).collect();
    let corrected = holm(&p).into_iter().zip(benjamini_hochberg(&p));
    for (tested, (holm, fdr)) in tests.into_iter().zip(corrected) {
        (tested.holm, tested.fdr) = (holm, fdr);
    }
}

/// All measures that a leaf has, in the order of tables; and those that none has.
fn gathered(
    leaves: &[Leaf],
    groups: usize,
    is_wanted: &dyn Fn(&str) -> bool,
) -> (Vec<Measure>, Vec<&'static str>) {
    let mut keys: Vec<&'static str> = Vec::new();
    let mut found: BTreeMap<(usize, Option<usize>), Measure> = BTreeMap::new();
    let rows = leaves.iter().enumerate();
    let rows = rows.flat_map(|(leaf, all)| all.rows.iter().map(move |row| (leaf, all.group, row)));
    for (leaf, group, row) in rows.filter(|(_, _, row)| is_wanted(row.key)) {
        let place = keys.iter().position(|key| *key == row.key);
        let place = place.unwrap_or_else(|| {
            keys.push(row.key);
            keys.len() - 1
        });
        let Some(value) = row.value else { continue };
        let measure = found.entry((place, row.part)).or_insert_with(|| Measure {
            key: row.key,
            part: row.part,
            unit: row.unit,
            definition: row.definition,
            values: vec![Vec::new(); groups],
            summaries: Vec::new(),
            contrasts: Vec::new(),
        });
        measure.values[group].push((leaf, value));
    }
    let absent = keys.iter().enumerate();
    let absent = absent.filter(|(place, _)| !found.keys().any(|(known, _)| known == place));
    let absent = absent.map(|(_, key)| *key).collect();
    let measures = found.into_values().map(|mut measure| {
        let of_group = |values: &Vec<(usize, f64)>| summary(&numbers(values));
        measure.summaries = measure.values.iter().map(of_group).collect();
        measure
    });
    (measures.collect(), absent)
}

fn numbers(values: &[(usize, f64)]) -> Vec<f64> {
    values.iter().map(|(_, value)| *value).collect()
}

impl Measure {
    /// Compares two groups that have so many leaves, whether or not these have the measure.
    fn contrast(&self, pair: [usize; 2], sizes: &[usize]) -> Contrast {
        let [first, second] = pair.map(|group| numbers(&self.values[group]));
        let means = pair.map(|group| self.summaries[group].map(|summary| summary.mean));
        let [Some(one), Some(other)] = means else {
            let untested = Some("missing in a group");
            return Contrast {
                untested,
                ..Contrast::default()
            };
        };
        let is_same = (other - one).abs() <= ROUNDING * one.abs().max(other.abs());
        let mut contrast = Contrast {
            difference: Some(if is_same { 0.0 } else { other - one }),
            ratio: (one * other > 0.0).then(|| other / one),
            ..Contrast::default()
        };
        let all = || first.iter().chain(&second);
        let greatest = all().fold(0.0, |greatest: f64, value| greatest.max(value.abs()));
        if first.len() + second.len() < 3 {
            contrast.untested = Some("one leaf each");
        } else if all().all(|value| (value - first[0]).abs() <= ROUNDING * greatest) {
            contrast.untested = Some("the same in all leaves");
        } else if sizes[pair[0]] == 1 {
            contrast.one_among_others =
                one_among(first[0], &second).map(|found| Test::new(found, found.p));
        } else if sizes[pair[1]] == 1 {
            contrast.one_among_others =
                one_among(second[0], &first).map(|found| Test::new(found, found.p));
        } else if first.len() < 2 || second.len() < 2 {
            contrast.untested = Some("one leaf of a group has it");
        } else {
            let welch = welch(&first, &second);
            contrast.difference_interval_95 = welch.map(|found| found.interval);
            contrast.welch = welch.map(|found| Test::new(found, found.p));
            let ranks = mann_whitney(&first, &second);
            contrast.mann_whitney = ranks.map(|found| Test::new(found, found.p));
            contrast.hedges_g = hedges_g(&first, &second);
            contrast.cliffs_delta = cliffs_delta(&first, &second);
        }
        if contrast.means().is_none() && contrast.orders().is_none() {
            contrast.untested = contrast.untested.or(Some("no spread"));
        }
        contrast
    }
}

/// All kinds of single values.
fn kinds(leaves: &[Leaf], groups: usize, is_wanted: &dyn Fn(&str) -> bool) -> Vec<Distribution> {
    let mut found: Vec<Distribution> = Vec::new();
    for (number, leaf) in leaves.iter().enumerate() {
        for values in leaf.samples.iter().filter(|values| is_wanted(values.kind)) {
            let place = found.iter().position(|known| known.kind == values.kind);
            let place = place.unwrap_or_else(|| {
                found.push(Distribution {
                    kind: values.kind,
                    unit: values.unit,
                    definition: definition(values.kind),
                    leaves: vec![Vec::new(); groups],
                    counts: vec![0; groups],
                    medians: Vec::new(),
                    contrasts: Vec::new(),
                });
                found.len() - 1
            });
            found[place].leaves[leaf.group].push(number);
            found[place].counts[leaf.group] += values.numbers.len();
        }
    }
    for distribution in &mut found {
        let median =
            |leaf: &usize| Some(summary(values(&leaves[*leaf], distribution.kind))?.median);
        let of_group = |members: &Vec<usize>| {
            let medians: Vec<f64> = members.iter().filter_map(median).collect();
            summary(&medians).map(|summary| summary.mean)
        };
        distribution.medians = distribution.leaves.iter().map(of_group).collect();
    }
    found
}

/// The values of a kind in a leaf, ascending; none if it has none.
pub(crate) fn values<'l>(leaf: &'l Leaf, kind: &str) -> &'l [f64] {
    let found = leaf.samples.iter().find(|values| values.kind == kind);
    found.map_or(&[], |values| &values.numbers)
}

impl Distribution {
    /// The second median over the first, if both have one sign.
    pub(crate) fn ratio(&self, pair: [usize; 2]) -> Option<f64> {
        let [first, second] = pair.map(|group| self.medians[group]);
        let (first, second) = (first?, second?);
        (first * second > 0.0).then(|| second / first)
    }

    fn contrast(&self, pair: [usize; 2], leaves: &[Leaf], seed: u64) -> SpreadContrast {
        let [first, second] = pair.map(|group| -> Vec<&[f64]> {
            let members = self.leaves[group].iter();
            members
                .map(|leaf| values(&leaves[*leaf], self.kind))
                .collect()
        });
        let mut contrast = SpreadContrast::default();
        let Some(leafwise) = permuted_leaves(&first, &second, seed) else {
            contrast.untested = Some("missing in a group");
            return contrast;
        };
        contrast.leaves_permuted = Some(Test::new(leafwise, leafwise.p));
        let [one, other] = [first.as_slice(), second.as_slice()].map(|leaves| {
            let mut all = leaves.concat();
            all.sort_unstable_by(f64::total_cmp);
            all
        });
        let steps = kolmogorov_smirnov(&one, &other);
        let pooled = &mut contrast.as_if_independent;
        pooled.cliffs_delta = cliffs_delta(&one, &other);
        if self.kind == PROBES {
            pooled.kolmogorov_smirnov = steps.map(|found| Test::new(found, None::<f64>));
            contrast.untested = Some("points are no sample");
            return contrast;
        }
        pooled.kolmogorov_smirnov = steps.map(|found| Test::new(found, found.p));
        let ranks = mann_whitney(&one, &other);
        pooled.mann_whitney = ranks.map(|found| Test::new(found, found.p));
        if first.len() + second.len() > 2 && leafwise.p.is_none() {
            contrast.untested = Some("a group of one leaf");
        }
        contrast
    }
}

/// What limits tests between groups of these sizes, in words; nothing where they can tell something.
pub(crate) fn limit(first: usize, second: usize) -> Option<String> {
    let floor = smallest_p(first, second);
    (first > 1 && second > 1 && floor > LEVEL).then(|| {
        format!(
            "with {first} and {second} leaves the test of Mann and Whitney cannot give a p below \
             {floor:.2}: it can show nothing here, whatever the leaves are like"
        )
    })
}
