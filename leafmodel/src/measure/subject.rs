//! What is measured: a network in a blade of which more or less is known.

use glam::DVec2;

use super::cost::{self, OrderRow};
use super::nesting::{self, Merge};
use crate::random::{Use, uniform};
use crate::shape::outline::Outline;
use crate::venation::areole::{Areoles, areoles};
use crate::venation::network::VenationNetwork;

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

    pub(super) fn area(self) -> Option<f64> {
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
