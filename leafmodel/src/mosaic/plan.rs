//! The plan of a clonal mosaic.

use super::control::{CylinderControl, Steered};
use crate::grow_options::MOST_CELLS;
use crate::not_grown::{NotGrown, not_grown};

use super::growth::SurfaceGrowth;
use crate::document::{Declared, RangeError, Words};

/// Tolerance on sums of probabilities.
const TOLERANCE: f64 = 1e-6;
/// Greatest number of cells.
/// Expected number of cells over the greatest one at which a plan is refused beforehand, since the
/// actual number may be smaller.
const OVERCROWDED: f64 = 4.0;

/// Greatest number of pairs of cells in all relaxations together, about. A
/// processor gets through a few million of them a second, so that more would take an hour.
const MOST_PAIRS: f64 = 1e10;
/// Memory of the surface around an initial cell, bytes: its triangles are as fine as the initial
/// cells. Measured on a leaf with 20 000 and 100 000 of them.
const OF_A_FIRST_CELL: f64 = 12e3;
/// Memory of a cell of the grown mosaic, bytes; measured on a sphere on which 50 cells divided into
/// 26 000 and 102 000.
const OF_A_CELL: f64 = 3e3;

/// A kind of cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellType {
    /// Its name.
    pub name: String,
    /// Mean time between divisions, days, > 0; infinite if it never divides.
    pub division_days: f64,
    /// Share of the initial cells that are of this type, 0 to 1; over all types the sum is 1.
    pub initial_probability: f64,
    /// For each type the probability that a child is of it; the sum is 1.
    pub switching: Vec<f64>,
    /// For each type the adhesion of cells of both types, from 0 (full repulsion) to 1 (no
    /// repulsion). The matrix is symmetric.
    pub adhesion: Vec<f64>,
}

/// The number of cells from which the repulsion radius is computed.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Words)]
pub enum RadiusRule {
    /// The initial number: the radius stays the same while cells crowd.
    #[default]
    Initial,
    /// Each day's number, with that day's area.
    Daily,
}

/// A mosaic: cell types, and how long and by what rules they grow.
///
/// # Source
///
/// \[binsfeld2011\] gives the model and Table I; what it leaves open (`step`, the initial
/// relaxations, four relaxations a day, adhesion 0 between types) has the values that the authors'
/// program starts with.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct MosaicPlan {
    /// Cells at the start.
    #[key("cells", 1..=1_000_000)]
    pub initial_cells: usize,
    /// How long they divide and push one another.
    #[key("days", required, 0.0..=1e5)]
    pub days: f64,
    /// `w_r`: the repulsion radius over the root of the mean area of a cell, 0.1 to 10.
    #[key(
        "radius_weight", 0.1..=10.0,
        about = "W_r: the radius of repulsion over the root of a cell's mean area."
    )]
    pub radius_weight: f64,
    /// ρ.
    ///
    /// `ρ`: relaxation events a day
    #[key("relaxations_per_day", 1..=1000)]
    pub relaxations_per_day: u32,
    /// How far a cell moves for a force of 1, in radii.
    #[key("step", 0.0..=1.0)]
    pub step: f64,
    /// Relaxations before the first day.
    #[key("initial_relaxations", 0..=100_000)]
    pub initial_relaxations: u32,
    /// `step` in these.
    #[key("initial_step", 0.0..=1.0)]
    pub initial_step: f64,
    /// Which number of cells that area is of: those at the start, or those of the day.
    #[key("radius", word)]
    pub radius: RadiusRule,
    /// The types, one or more.
    pub types: Vec<CellType>,
    /// Cylinders that control the mosaic by place. Of several that control the same quantity, each
    /// acts on the result of the one before.
    pub controls: Vec<CylinderControl>,
    /// Growth of the surface.
    ///
    /// Without it, the surface has its final size from the start, and cells crowd.
    pub growth: Option<SurfaceGrowth>,
}

impl Default for MosaicPlan {
    /// The croton of the paper's Fig. 1.
    fn default() -> Self {
        Self {
            initial_cells: 2000,
            days: 35.0,
            radius_weight: 1.0,
            relaxations_per_day: 4,
            step: 0.066,
            initial_relaxations: 70,
            initial_step: 0.005,
            radius: RadiusRule::Initial,
            types: Self::two_types([10.0, 10.0], [0.5, 0.8], 0.1, 0.0),
            controls: Vec::new(),
            growth: None,
        }
    }
}

impl MosaicPlan {
    /// The paper's two types, foreground (0) and background (1), which do not adhere to one
    /// another.
    ///
    /// `division_days` and `adhesion` (`α_FF`, `α_BB`) are those of foreground and background,
    /// `initial_share` is that of the foreground, and `switching` the probability that a child of a
    /// background cell is foreground.
    pub fn two_types(
        division_days: [f64; 2],
        adhesion: [f64; 2],
        initial_share: f64,
        switching: f64,
    ) -> Vec<CellType> {
        vec![
            CellType {
                name: "foreground".into(),
                division_days: division_days[0],
                initial_probability: initial_share,
                switching: vec![1.0, 0.0],
                adhesion: vec![adhesion[0], 0.0],
            },
            CellType {
                name: "background".into(),
                division_days: division_days[1],
                initial_probability: 1.0 - initial_share,
                switching: vec![switching, 1.0 - switching],
                adhesion: vec![0.0, adhesion[1]],
            },
        ]
    }

    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first that is wrong.
    pub fn validate(&self) -> Result<(), NotGrown> {
        self.in_range()?;
        let count = self.types.len();
        if !(1..=1000).contains(&count) {
            return Err(not_grown!(
                "there are {count} cell types; a mosaic has 1 to 1000"
            ));
        }
        for kind in &self.types {
            kind.validate(count)?;
        }
        let initial = self.types.iter().map(|kind| kind.initial_probability);
        sums_to_one("the initial probabilities of the types", initial.sum())?;
        self.adhesion_is_symmetric()?;
        if let Some(growth) = &self.growth {
            growth.in_range()?;
        }
        for (number, control) in self.controls.iter().enumerate() {
            let part = format!("control {number} (from 0)");
            let checked = control.validate(count);
            checked.map_err(|error| NotGrown::of(&part, error))?;
        }
        self.has_room()
    }

    /// Refuses plans that are bound to end in too many cells, which may take minutes, or to take hours. The effect of controls and of the growth of the surface is not
    /// known beforehand.
    fn has_room(&self) -> Result<(), NotGrown> {
        if self.is_steered() {
            return Ok(());
        }
        for (number, kind) in self.types.iter().enumerate() {
            if self.cells_of(number, self.days) > OVERCROWDED * MOST_CELLS as f64 {
                return Err(not_grown!(
                    "cells of type \"{}\" divide every {} days: after {} days there would be \
                     more than {MOST_CELLS}; make the days fewer or the divisions rarer",
                    kind.name,
                    kind.division_days,
                    self.days
                ));
            }
        }
        let pairs = self.pairs();
        if pairs > MOST_PAIRS {
            return Err(not_grown!(
                "cells would push each other apart {pairs:.1e} times, at most 1e10 are allowed, \
                 which takes an hour; make the days fewer, the divisions rarer, or let `radius = \
                 \"daily\"` shrink their reach as they divide"
            ));
        }
        Ok(())
    }

    /// Whether the number of cells depends on controls or on the growth of the surface.
    fn is_steered(&self) -> bool {
        let steered = self.controls.iter().any(|control| match control.steers {
            Steered::DivisionRate { .. } | Steered::InitialType(_) | Steered::Switching { .. } => {
                true
            }
            Steered::Adhesion { .. } | Steered::Blocked => false,
        });
        steered || self.growth.is_some()
    }

    /// A lower estimate of the number of cells of a type after some days: only descendants of the
    /// same type, all dividing after the mean time (Poisson scatter makes them more) plus one
    /// relaxation. Each division turns one cell into 1 + s of the type.
    fn cells_of(&self, number: usize, days: f64) -> f64 {
        let kind = &self.types[number];
        let wait = kind.division_days + 1.0 / f64::from(self.relaxations_per_day);
        let times = libm::exp(days * libm::log1p(kind.switching[number]) / wait);
        self.initial_cells as f64 * kind.initial_probability * times
    }

    /// More cells than there will be: all divide as the fastest type does where controls let it
    /// divide most.
    pub(super) fn most_cells(&self) -> usize {
        if self.growth.is_some() {
            return MOST_CELLS;
        }
        let factors = self.controls.iter().map(|control| match control.steers {
            Steered::DivisionRate { low, high, .. } => low.max(high).max(1.0),
            Steered::InitialType(_)
            | Steered::Adhesion { .. }
            | Steered::Switching { .. }
            | Steered::Blocked => 1.0,
        });
        let fastest = self.types.iter().map(|kind| kind.division_days);
        let days = fastest.fold(f64::INFINITY, f64::min) / factors.product::<f64>();
        // Cells whose times are Poisson distributed grow by e^r a day with e^(−r) = 1 − ln 2 / days;
        // 0.8 leaves room.
        let growth = -libm::log1p(-(0.8 / days).min(1.0)) * self.days;
        (self.initial_cells as f64 * libm::exp(growth)).min(MOST_CELLS as f64) as usize
    }

    fn cells(&self, days: f64) -> f64 {
        (0..self.types.len()).fold(0.0, |sum, number| sum + self.cells_of(number, days))
    }

    /// About how many pairs of cells push each other apart in all: every cell sees those within the
    /// repulsion radius, and more of them the more divide while the radius stays.
    fn pairs(&self) -> f64 {
        let seen = std::f64::consts::PI * self.radius_weight * self.radius_weight;
        let of_a_day = |day: u32| {
            let cells = self.cells(f64::from(day).min(self.days));
            let crowding = match self.radius {
                RadiusRule::Initial => cells / self.initial_cells as f64,
                RadiusRule::Daily => 1.0,
            };
            cells * seen * crowding.max(1.0) * f64::from(self.relaxations_per_day)
        };
        (1..=self.days.ceil() as u32).fold(0.0, |sum, day| sum + of_a_day(day))
    }

    /// About how much memory the mosaic takes while it grows, bytes.
    pub fn memory_bytes(&self) -> f64 {
        let last = if self.is_steered() { 0.0 } else { self.days };
        let cells = self.cells(last).min(MOST_CELLS as f64);
        self.initial_cells as f64 * OF_A_FIRST_CELL + cells * OF_A_CELL
    }

    fn adhesion_is_symmetric(&self) -> Result<(), NotGrown> {
        for (i, first) in self.types.iter().enumerate() {
            for (j, second) in self.types.iter().enumerate().skip(i + 1) {
                let (there, back) = (first.adhesion[j], second.adhesion[i]);
                if there != back {
                    return Err(not_grown!(
                        "adhesion of \"{first}\" to \"{second}\" is {there}, of \"{second}\" to \
                         \"{first}\" {back}; the two have to be equal",
                        first = first.name,
                        second = second.name
                    ));
                }
            }
        }
        Ok(())
    }
}

impl CellType {
    fn validate(&self, types: usize) -> Result<(), NotGrown> {
        let name = &self.name;
        let in_range = |key: &str, value: f64, valid: bool, limits| {
            RangeError::unless(valid, &format!("{key} of type \"{name}\""), value, limits)
        };
        // Infinity is in the range: such cells never divide.
        let days = self.division_days;
        in_range("division_days", days, days > 0.0, "the positive numbers")?;
        let share = self.initial_probability;
        let good = (0.0..=1.0).contains(&share);
        in_range("initial_probability", share, good, "0 to 1")?;
        for (field, row) in [("switching", &self.switching), ("adhesion", &self.adhesion)] {
            if row.len() != types {
                return Err(not_grown!(
                    "{field} of type \"{name}\" has {length} numbers; there are {types} types",
                    name = name,
                    length = row.len()
                ));
            }
            for &value in row {
                in_range(field, value, (0.0..=1.0).contains(&value), "0 to 1")?;
            }
        }
        let sum = self.switching.iter().sum();
        sums_to_one(
            &format!("the switching probabilities of type \"{name}\""),
            sum,
        )
    }
}

fn sums_to_one(field: &str, sum: f64) -> Result<(), NotGrown> {
    if (sum - 1.0).abs() <= TOLERANCE {
        return Ok(());
    }
    Err(not_grown!(
        "{field} sum to {}, not to 1",
        (1e9 * sum).round() / 1e9
    ))
}
