//! Veins: networks that grow towards auxin sources, with widths and orders.
//!
//! Auxin sources appear in the lamina away from veins, veins grow towards them, and sources that
//! veins have reached are used up. Meanwhile the lamina grows and makes room for more sources.
//! [`grow`] runs that loop, gives each vein its width and order, and returns the network.
//!
//! - **In**: an [`Outline`], an [`AuxinPlan`], a seed.
//! - **Out**: a [`VenationNetwork`] in millimetres, in the frame of the outline.
//! - **Always true**: every node lies inside the outline; every vein is connected to an origin; the
//!   network passes its own [`VenationNetwork::validate`]; the same input gives the same bits on
//!   every machine.
//! - **Left out**: feedback of the veins on the growth of the blade.
//!
//! # Source
//!
//! \[runions2005\]; `docs/src/theory/venation.md` says what the paper leaves open and what is done
//! here.
//!
//! ```
//! use glam::DVec2;
//! use leafmodel::shape::outline::Outline;
//! use leafmodel::venation::{self, plan::AuxinPlan};
//!
//! // A lozenge of 60 mm, and veins of 80 segments from base to apex.
//! let corners = [(0.0, 0.0), (18.0, 25.0), (0.0, 60.0), (-18.0, 25.0)].map(DVec2::from);
//! let margin = Outline::new(corners.to_vec(), corners[0], corners[2])?;
//! let plan = AuxinPlan { final_length: 80.0, darts_per_area: 0.01, ..AuxinPlan::default() };
//! let veins = venation::grow(&margin, &plan, 1)?;
//! assert_eq!(veins.segment_mm(), 60.0 / 80.0);
//!
//! // Sources that are used up from farther away leave a sparser net.
//! let sparse = AuxinPlan { kill_distance: 4.0, ..plan };
//! let sparse = venation::grow(&margin, &sparse, 1)?;
//! assert!(sparse.vein_length_mm() < veins.vein_length_mm());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arches;
pub mod architecture;
pub mod arcuate;
pub mod areole;
mod auxin;
mod bipolar;
mod carrying_out;
mod closed;
pub mod conformal_map;
mod fresh_nodes;
mod given;
mod grown;
mod horizon;
mod influence;
mod lamina;
mod lamina_clock;
mod length_queue;
mod lone;
pub mod network;
mod open;
pub(crate) mod order;
pub mod plan;
pub mod planar;
mod point_tree;
mod probe;
mod relative_neighbourhood;
mod simulation;
mod sources;
mod tension;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
pub(crate) mod topology;
mod urquhart;
mod veins;
pub(crate) mod width;

use glam::DVec2;

use self::auxin::waiting_darts;
#[cfg(test)]
pub(crate) use self::carrying_out::carry_out;
use self::carrying_out::{Watch, carry_out_from};
use self::given::GivenVeins;
use self::grown::Grown;
use self::lamina::Lamina;
use self::lamina_clock::LaminaClock;
use self::network::VenationNetwork;
use self::plan::check::incompatible;
use self::plan::{AuxinPlan, Growth};
use crate::not_grown::NotGrown;
use crate::shape::outline::Outline;

/// A leaf at one step of its development.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Number of steps done.
    pub step: u32,
    /// The margin at that step, mm, in its size at that step.
    pub outline: Outline,
    /// The veins at that step, mm, in their size at that step. A node keeps its number from stage
    /// to stage.
    pub network: VenationNetwork,
    /// The auxin sources that are there after that step, mm, in the order of their birth.
    pub sources: Vec<DVec2>,
}

/// Grows the veins of a leaf.
///
/// The length of a vein segment is the midrib's length over `plan.final_length`.
///
/// # Errors
///
/// [`NotGrown`] if the plan cannot be carried out on this outline.
///
/// # Source
///
/// \[runions2005\], sections 3 and 4.
pub fn grow(outline: &Outline, plan: &AuxinPlan, seed: u64) -> Result<VenationNetwork, NotGrown> {
    VeinGrowth::new(outline, plan, seed).network()
}

/// The growth of veins in an outline.
pub(crate) struct VeinGrowth<'a> {
    /// The margin of the full-grown leaf, mm.
    pub(crate) outline: &'a Outline,
    pub(crate) plan: &'a AuxinPlan,
    pub(crate) seed: u64,
    /// Main veins that are there before, in the frame of the full-grown outline. Finer veins grow around
    /// them. They move with the lamina as it grows, and a margin that grows alone finds them in
    /// place. They exclude an architecture.
    pub(crate) main: Option<&'a VenationNetwork>,
    /// Called after each step; growth ends with an error once it returns true.
    pub(crate) is_stopped: &'a dyn Fn() -> bool,
}

impl<'a> VeinGrowth<'a> {
    /// Growth from the base alone, which nobody stops.
    pub(crate) fn new(outline: &'a Outline, plan: &'a AuxinPlan, seed: u64) -> Self {
        Self {
            outline,
            plan,
            seed,
            main: None,
            is_stopped: &|| false,
        }
    }

    /// The veins of the full-grown leaf.
    ///
    /// # Errors
    ///
    /// As [`grow`], and one that [is a stop](NotGrown::is_stop).
    pub(crate) fn network(&self) -> Result<VenationNetwork, NotGrown> {
        Ok(self.develop(&[])?.0.network)
    }

    /// The state after each of `steps`, in their order; 0 is before the first. A step beyond the last gives the full-grown
    /// leaf.
    ///
    /// # Errors
    ///
    /// As [`VeinGrowth::network`].
    pub(crate) fn stages(&self, steps: &[u32]) -> Result<Vec<Stage>, NotGrown> {
        let (full_grown, mut stages) = self.develop(steps)?;
        stages.sort_by_key(|stage| stage.step);
        let at = |&step: &u32| {
            let found = stages.binary_search_by_key(&step, |stage| stage.step);
            found.map_or(&full_grown, |i| &stages[i]).clone()
        };
        Ok(steps.iter().map(at).collect())
    }

    /// The full-grown leaf, and the stages after those of `steps` that are reached.
    fn develop(&self, steps: &[u32]) -> Result<(Stage, Vec<Stage>), NotGrown> {
        let &Self {
            outline,
            plan,
            seed,
            main,
            is_stopped,
        } = self;
        plan.validate()?;
        if main.is_some() && plan.architecture.is_some() {
            let other = "an outline that brings its main veins";
            return Err(incompatible("architecture", other));
        }
        let blade = in_segments(outline, plan);
        let (lamina, clock) = prepared(&blade, plan)?;
        let segment_mm = outline.length() / plan.final_length;
        let given = main.map(|main| GivenVeins::new(main, outline.base(), segment_mm));
        let watch = Watch {
            steps,
            young: Vec::new(),
            is_stopped,
        };
        let (grown, young) = carry_out_from(plan, lamina, clock, given.as_ref(), seed, watch);
        if is_stopped() {
            return Err(NotGrown::stopped("growing the veins was stopped"));
        }
        let base = outline.base();
        let place = |&p: &DVec2| base + p * segment_mm;
        let stage = |grown: Grown| Stage {
            step: grown.steps,
            outline: outline.with_points(
                grown.margin.iter().map(place).collect(),
                base + grown.apex * segment_mm,
            ),
            sources: grown.live_sources.iter().map(place).collect(),
            network: grown.into_network(plan, segment_mm, base),
        };
        let full_grown = Stage {
            step: grown.steps,
            outline: outline.clone(),
            sources: grown.live_sources.iter().map(place).collect(),
            network: grown.into_network(plan, segment_mm, base),
        };
        Ok((full_grown, young.into_iter().map(stage).collect()))
    }
}

/// Checks that a plan can be carried out on an outline without doing it: refuses what [`grow`]
/// refuses.
///
/// # Errors
///
/// As [`grow`].
pub fn check(outline: &Outline, plan: &AuxinPlan) -> Result<(), NotGrown> {
    plan.validate()?;
    prepared(&in_segments(outline, plan), plan)?;
    Ok(())
}

/// The outline of the full-grown blade in segments, base at the origin.
fn in_segments(outline: &Outline, plan: &AuxinPlan) -> Outline {
    let segment_mm = outline.length() / plan.final_length;
    outline.moved_and_scaled(outline.base(), 1.0 / segment_mm)
}

/// The lamina and its clock. Refuses a plan that cannot be carried out on this blade.
fn prepared<'b>(
    blade: &'b Outline,
    plan: &AuxinPlan,
) -> Result<(Lamina<'b>, LaminaClock), NotGrown> {
    plan.validate_on(blade)?;
    let clock = LaminaClock::new(plan)?;
    let lamina = Lamina::new(plan, blade, clock.tissue_map(u32::MAX));
    check_young(&lamina, &clock)?;
    check_darts(plan, &lamina, &clock)?;
    Ok((lamina, clock))
}

/// Refuses plans that need too many darts.
fn check_darts(plan: &AuxinPlan, lamina: &Lamina, clock: &LaminaClock) -> Result<(), NotGrown> {
    let (low, high) = lamina.blade.bounds();
    let area = (high - low).x * (high - low).y * lamina.surplus();
    let steps = clock.last_growth_step();
    let per_step = plan.darts_per_area * area;
    AuxinPlan::validate_darts(match plan.growth {
        Growth::None => per_step,
        Growth::Isogonic { .. } => {
            // The mean of the squared size; the size grows linearly up to 1.
            let size = clock.size(0);
            per_step * (f64::from(steps) + 1.0) * (1.0 + size + size * size) / 3.0
        }
        Growth::Anisotropic { .. } => per_step * (f64::from(steps) + 1.0),
        Growth::Marginal { .. } => waiting_darts(plan, lamina, steps),
    })?;
    let free = plan.free_endings.map_or(0.0, |free| free.darts_per_area);
    AuxinPlan::validate_darts(free * area)
}

/// Refuses growth functions whose young leaf is far larger than the full-grown one or has no
/// extent.
fn check_young(lamina: &Lamina, clock: &LaminaClock) -> Result<(), NotGrown> {
    let Some(first) = clock.tissue_map(0) else {
        return Ok(());
    };
    let size = |(low, high): (DVec2, DVec2)| high - low;
    let mut young = lamina.clone();
    young.carry(first);
    AuxinPlan::validate_young(size(young.bounds_now()) / size(lamina.blade.bounds()))
}
