//! The measures of a leaf, in the order of tables.

use super::cost::OrderRow;
use super::entries::{Entry, Measures, Value};
use super::forks::Forks;
use super::hierarchy::Hierarchy;
use super::junctions::Junctions;
use super::nesting::Nesting;
use super::skeleton::Skeleton;
use super::statistics::{mean, median, mode, quantile, variation};
use super::structure::Structure;
use super::subject::{Known, Subject};
use super::supply::{OrderLoss, Supply};
use crate::measure::definitions;
use crate::measure::fourier;
use crate::measure::margin;
use crate::measure::nesting;
use crate::measure::spanning;
use crate::shape::outline::Outline;
use crate::venation::areole::{Areole, Areoles};
use crate::venation::network;
use crate::venation::network::VenationNetwork;

/// Distance from the margin, in segments, within which a vein counts as ending at the margin, not
/// as a free ending inside the blade.
pub(super) const MARGIN_SEGMENTS: f64 = 2.0;

/// Veins from this order on are minor veins.
pub(super) const FIRST_MINOR_ORDER: usize = 4;

/// Shares of a distribution that are told.
pub(super) const PERCENTILES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

pub(super) struct List {
    entries: Vec<Entry>,
    area: Option<f64>,
}

impl List {
    pub(super) fn new(area: Option<f64>) -> Self {
        Self {
            entries: Vec::new(),
            area,
        }
    }

    pub(super) fn measures(self) -> Measures {
        Measures {
            entries: self.entries,
        }
    }

    fn count(&mut self, key: &'static str, value: usize) {
        self.add(key, Value::Count(value as u64));
    }

    fn count_or_none(&mut self, key: &'static str, value: Option<usize>) {
        match value {
            Some(value) => self.count(key, value),
            None => self.number(key, None),
        }
    }

    fn number(&mut self, key: &'static str, value: Option<f64>) {
        // Adding 0 turns the negative zero of an empty sum into zero.
        let value = value.filter(|v| v.is_finite()).map(|v| v + 0.0);
        self.add(key, Value::Number(value));
    }

    fn list(&mut self, key: &'static str, value: Vec<f64>) {
        self.add(key, Value::List(value));
    }

    fn add(&mut self, key: &'static str, value: Value) {
        let unit = definitions::unit(key);
        self.entries.push(Entry { key, unit, value });
    }

    /// The distribution of some values: 5th, 25th, 50th, 75th and 95th percentile, or nothing
    /// without values.
    fn percentiles(&mut self, key: &'static str, values: &mut [f64]) {
        let all = PERCENTILES
            .iter()
            .filter_map(|&share| quantile(values, share));
        let all = all.collect();
        self.list(key, all);
    }

    /// A number divided by the area of the blade.
    fn per_area(&mut self, key: &'static str, value: f64) {
        self.number(key, self.area.map(|area| value / area));
    }

    pub(super) fn shape(&mut self, outline: Option<&Outline>) {
        let form = outline.map(|outline| {
            let (length, perimeter) = (outline.length(), outline.perimeter());
            let extent = margin::extent(outline);
            let (low, high) = extent.along;
            let area = outline.area();
            let round = 4.0 * std::f64::consts::PI * area / (perimeter * perimeter);
            let solidity = area / margin::hull_area(outline);
            [
                length,
                extent.width,
                extent.width / length,
                (high - low) / length,
                extent.widest / length,
                area,
                perimeter,
                round,
                solidity,
            ]
        });
        let keys = [
            "length_mm",
            "width_mm",
            "width_over_length",
            "extent_over_length",
            "widest_at",
            "area_mm2",
            "perimeter_mm",
            "circularity",
            "solidity",
        ];
        for (i, key) in keys.into_iter().enumerate() {
            self.number(key, form.map(|form| form[i]));
        }
        let series = outline.map(fourier::descriptors);
        self.list("elliptic_fourier", series.unwrap_or_default());
    }

    fn veins(&mut self, skeleton: &Skeleton, known: Known) {
        let lengths = skeleton.lengths_by_order();
        let total: f64 = lengths.iter().sum();
        let minor: f64 = lengths.iter().skip(FIRST_MINOR_ORDER - 1).sum();
        self.number("vein_length_mm", Some(total));
        self.per_area("vein_density_mm_per_mm2", total);
        let area = self.area.filter(|_| known.orders);
        let by_order = area.map(|area| lengths.iter().map(|length| length / area).collect());
        let by_order = by_order.unwrap_or_default();
        self.list("vein_density_mm_per_mm2_by_order", by_order);
        let share = (total > 0.0 && known.orders).then_some(minor / total);
        self.number("minor_vein_share", share);
    }

    fn distances(&mut self, distances: &[f64]) {
        self.number("vein_distance_mm_mean", mean(distances));
        self.number("vein_distance_mm_mode", mode(distances));
        let middle = median(&mut distances.to_vec());
        self.number("vein_distance_mm_median", middle);
    }

    fn areoles(&mut self, found: &Areoles) {
        let mut areas: Vec<f64> = found.iter().map(|a| a.area_mm2).collect();
        let mut round: Vec<f64> = found.iter().map(Areole::circularity).collect();
        let mut long: Vec<f64> = found.iter().map(|a| a.elongation).collect();
        self.count("areole_count", found.len());
        self.per_area("areoles_per_mm2", found.len() as f64);
        self.number("areole_area_mm2_mean", mean(&areas));
        self.number("areole_area_cv", variation(&areas));
        self.number("areole_area_mm2_median", median(&mut areas));
        self.number("areole_circularity_mean", mean(&round));
        self.number("areole_circularity_median", median(&mut round));
        self.number("areole_elongation_median", median(&mut long));
        self.percentiles("areole_area_mm2_percentiles", &mut areas);
        self.percentiles("areole_circularity_percentiles", &mut round);
        self.percentiles("areole_elongation_percentiles", &mut long);
    }

    fn free_endings(
        &mut self,
        outline: Option<&Outline>,
        network: &VenationNetwork,
        found: &Areoles,
    ) {
        let margin = MARGIN_SEGMENTS * network.segment_mm();
        // Without a margin only those in areoles are known to be inside.
        let is_inside =
            |tip| outline.is_some_and(|outline| outline.distance_to_margin(tip) > margin);
        let free: Vec<_> = found
            .free_endings()
            .filter(|f| f.areole.is_some() || is_inside(f.tip))
            .collect();
        let lengths: Vec<f64> = free.iter().map(|f| f.length_mm).collect();
        let inside = free.iter().filter(|f| f.areole.is_some()).count();
        let per_areole = (!found.is_empty()).then(|| inside as f64 / found.len() as f64);
        self.count("freely_ending_veinlet_count", free.len());
        self.per_area("freely_ending_veinlets_per_mm2", free.len() as f64);
        self.number("freely_ending_veinlets_per_areole", per_areole);
        self.number("freely_ending_veinlet_length_mm_mean", mean(&lengths));
    }

    fn forks(&mut self, forks: &Forks, known: Known) {
        let wide = |value: Option<f64>| value.filter(|_| known.radii);
        self.count("junction_count", forks.junctions);
        self.number("junction_degree_3_share", forks.degree_3_share);
        self.number("branching_angle_deg_median", forks.angle_deg);
        let [first, second] = [forks.wide_deg, forks.fine_deg].map(wide);
        self.number("branching_wide_deflection_deg_median", first);
        self.number("branching_fine_deflection_deg_median", second);
        self.number("murray_ratio_median", wide(forks.murray_ratio));
        self.number("murray_exponent_median", wide(forks.murray_exponent));
    }

    fn junctions(&mut self, found: Junctions, known: Known) {
        let wide = |value: Option<f64>| value.filter(|_| known.radii);
        self.list("junction_degree_shares", found.degree_shares);
        self.number("junction_bent_share", wide(found.bent_share));
        let angle = wide(found.largest_angle_deg);
        self.number("junction_largest_angle_deg_median", angle);
        let by_order = if known.radii && known.orders {
            found.exponents
        } else {
            Vec::new()
        };
        self.add("murray_exponent_by_order", Value::Orders(by_order));
    }

    fn nesting(&mut self, nesting: Option<Nesting>) {
        let (mean, weighted) = nesting
            .as_ref()
            .map_or((None, None), |n| (n.mean, n.weighted));
        self.number("loop_nesting", mean);
        self.number("loop_nesting_weighted", weighted);
        let strahler = nesting.map(|nesting| nesting.strahler as usize);
        self.count_or_none("loop_tree_strahler", strahler);
    }

    fn hierarchy(&mut self, veins: Option<Hierarchy>) {
        let counts = veins.as_ref().map(|veins| [veins.left, veins.right]);
        let veins = veins.unwrap_or_default();
        self.number("midrib_length_mm", veins.midrib_mm);
        self.count_or_none("secondary_vein_count_left", counts.map(|counts| counts[0]));
        self.count_or_none("secondary_vein_count_right", counts.map(|counts| counts[1]));
        self.number("secondary_spacing_mm_mean", veins.spacing_mm);
        self.number("secondary_spacing_cv", veins.spacing_cv);
        self.number("secondary_angle_deg_mean", veins.secondary_deg);
        self.number("tertiary_angle_deg_mean", veins.tertiary_deg);
    }
    fn supply(&mut self, found: Option<&Supply>) {
        let key = "conductance_mm3_per_s_mpa";
        self.number(key, found.map(|found| found.conductance));
        self.number("supplied_share", found.map(|found| found.supplied));
        self.number("bridge_share", found.map(|found| found.bridges));
        let cuts = found.map(|found| found.cuts.as_slice()).unwrap_or_default();
        let lost: Vec<f64> = cuts
            .iter()
            .filter(|cut| cut.cut_off == 0.0)
            .map(|cut| cut.lost)
            .collect();
        let off: Vec<f64> = cuts.iter().map(|cut| cut.cut_off).collect();
        self.number("conductance_lost_widest_mean", mean(&lost));
        self.number("cut_off_share_widest_mean", mean(&off));
        let orders = found
            .map(|found| found.orders.as_slice())
            .unwrap_or_default();
        let of = |value: &dyn Fn(&OrderLoss) -> Option<f64>| -> Vec<Option<f64>> {
            let last = orders.last().map_or(0, |loss| loss.order);
            let at = |order| orders.iter().find(|loss| loss.order == order);
            (1..=last).map(|order| at(order).and_then(value)).collect()
        };
        let (lost, off) = (of(&|loss| loss.lost), of(&|loss| Some(loss.cut_off)));
        self.add("conductance_lost_by_order", Value::Orders(lost));
        self.add("cut_off_share_by_order", Value::Orders(off));
    }
}

impl Subject<'_> {
    /// All measures; those that need what is not known are missing.
    pub fn measures(&self, murray_exponent: f64) -> Measures {
        let (found, known, outline) = (&self.found, self.known, self.blade.outline());
        let edges = network::ends(found.graph().edges());
        let skeleton = Skeleton::new(found.graph(), &edges, self.network.segment_mm());
        let mut list = List::new(self.blade.area());
        list.shape(outline);
        list.count("crossing_count", found.graph().crossings());
        list.number("blade_area_mm2", self.blade.area());
        list.veins(&skeleton, known);
        list.number("spanning_tree_ratio", spanning::ratio(found.chains()));
        let distances: Vec<f64> = self.distances().into_iter().map(|probe| probe.1).collect();
        list.distances(&distances);
        list.areoles(found);
        list.free_endings(outline, self.network, found);
        list.forks(&Forks::new(&skeleton, murray_exponent), known);
        list.junctions(Junctions::new(&skeleton), known);
        list.nesting(known.radii.then(|| nesting::nesting(found)));
        let hierarchy = outline.filter(|_| known.orders && known.radii);
        list.hierarchy(hierarchy.map(|outline| Hierarchy::new(&skeleton, outline.base())));
        list.measures()
    }

    /// Measures beyond those: what veins cost, how areoles lie, how loops are nested, and how water
    /// comes to them.
    ///
    /// `structure` and `supply` are those of [`Subject::structure`] and [`Subject::supply`], which
    /// take longer; without them their measures are missing.
    pub fn more_measures(
        &self,
        structure: Option<&Structure>,
        supply: Option<&Supply>,
    ) -> Measures {
        let mut list = List::new(self.blade.area());
        let rows = self.by_order();
        let sum = |value: fn(&OrderRow) -> f64| {
            let sum: f64 = rows.iter().map(value).sum();
            self.known.radii.then_some(sum)
        };
        let volume = sum(|row| row.volume_mm3);
        list.number("vein_surface_mm2", sum(|row| row.surface_mm2));
        list.number("vein_volume_mm3", volume);
        let per_area = volume
            .zip(self.blade.area())
            .map(|(volume, area)| volume / area);
        list.number("vein_volume_per_area_mm", per_area);
        let tree = self.known.radii.then(|| nesting::nesting(&self.found));
        list.number(
            "loop_tree_asymmetry",
            tree.as_ref().and_then(|tree| tree.asymmetry),
        );
        list.count_or_none("loop_tree_depth", tree.map(|tree| tree.depth as usize));
        list.count_or_none("centroid_count", structure.map(|found| found.count));
        list.number(
            "structure_factor_low",
            structure.and_then(|found| found.low),
        );
        let exponent = structure.and_then(|found| found.exponent);
        list.number("hyperuniformity_exponent", exponent.map(|pair| pair.0));
        list.number(
            "hyperuniformity_exponent_error",
            exponent.map(|pair| pair.1),
        );
        list.supply(supply);
        list.measures()
    }
}
