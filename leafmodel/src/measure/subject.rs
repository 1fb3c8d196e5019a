//! What is measured: a network in a blade of which more or less is known.

use glam::DVec2;

use super::cost::{self, OrderRow};
use super::forks::Forks;
use super::hierarchy::Hierarchy;
use super::junctions::Junctions;
use super::nesting::{self, Merge};
use super::skeleton::Skeleton;
use super::structure::Structure;
use super::supply::Supply;
use super::{List, Measures, spanning};
use crate::random::{Use, uniform};
use crate::shape::outline::Outline;
use crate::venation::areole::{Areoles, areoles};
use crate::venation::network::{self, VenationNetwork};

/// Number of points of the blade at which the distance to the nearest vein is measured.
pub(super) const PROBES: usize = 1 << 14;

/// What is known of the blade in which veins lie.
#[derive(Clone, Copy, Debug)]
pub enum Blade<'a> {
    /// Its margin.
    Margin(&'a Outline),
    /// Its area, mm², > 0: of a window of a leaf, or of several leaflets.
    Area(f64),
    /// Nothing: measures per area, and those of the shape, are missing.
    Unknown,
}

impl<'a> Blade<'a> {
    /// A blade with these margins; `area` (mm², > 0) where there is none.
    pub fn of(outlines: &'a [Outline], area: Option<f64>) -> Self {
        match outlines {
            [outline] => Self::Margin(outline),
            [] => area.map_or(Self::Unknown, Self::Area),
            several => Self::Area(several.iter().map(Outline::area).sum()),
        }
    }

    pub(super) fn outline(self) -> Option<&'a Outline> {
        match self {
            Self::Margin(outline) => Some(outline),
            Self::Area(_) | Self::Unknown => None,
        }
    }

    fn area(self) -> Option<f64> {
        match self {
            Self::Margin(outline) => Some(outline.area()),
            Self::Area(area) => Some(area),
            Self::Unknown => None,
        }
    }
}

/// Which numbers of a network are those of the leaf; others only hold the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// Whether radii are.
    pub radii: bool,
    /// Whether vein orders are.
    pub orders: bool,
}

impl Known {
    /// Everything is known.
    pub const ALL: Self = Self {
        radii: true,
        orders: true,
    };
}

/// A network that is measured, with its areoles.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    pub(super) blade: Blade<'a>,
    pub(super) network: &'a VenationNetwork,
    pub(super) known: Known,
    pub(super) found: Areoles,
}

impl<'a> Subject<'a> {
    /// Finds the areoles.
    pub fn new(blade: Blade<'a>, network: &'a VenationNetwork, known: Known) -> Self {
        let found = areoles(network);
        Self {
            blade,
            network,
            known,
            found,
        }
    }

    /// Its areoles.
    pub fn areoles(&self) -> &Areoles {
        &self.found
    }

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

    /// What the veins of each order cost; without known orders all stand in one row of order 0.
    /// Widths, surfaces and volumes mean nothing without known radii.
    pub fn by_order(&self) -> Vec<OrderRow> {
        let rows = cost::by_order(self.found.graph());
        if self.known.orders || rows.is_empty() {
            return rows;
        }
        let sum = |value: &dyn Fn(&OrderRow) -> f64| rows.iter().map(value).sum::<f64>();
        let length_mm = sum(&|row| row.length_mm);
        vec![OrderRow {
            order: 0,
            length_mm,
            width_mm: sum(&|row| row.width_mm * row.length_mm) / length_mm,
            surface_mm2: sum(&|row| row.surface_mm2),
            volume_mm3: sum(&|row| row.volume_mm3),
        }]
    }

    /// The tree of loops: its inner nodes, from the finest vein to the widest; none without radii.
    pub fn loop_tree(&self) -> Vec<Merge> {
        if self.known.radii {
            nesting::nesting(&self.found).merges
        } else {
            Vec::new()
        }
    }

    /// Hashed points of the blade and their distances to the nearest vein, mm; none without a
    /// margin.
    pub(super) fn distances(&self) -> Vec<(DVec2, f64)> {
        let Some(outline) = self.blade.outline() else {
            return Vec::new();
        };
        let (low, high) = outline.bounds();
        let probe = |i: u64| {
            let share = DVec2::new(uniform(0, Use::ProbeX, i), uniform(0, Use::ProbeY, i));
            low + share * (high - low)
        };
        // A blade that fills very little of its rectangle is measured at fewer points.
        (0..64 * PROBES as u64)
            .map(probe)
            .filter(|&p| outline.contains(p))
            .take(PROBES)
            .filter_map(|p| Some((p, self.found.graph().distance_to_vein(p)?)))
            .collect()
    }
}
