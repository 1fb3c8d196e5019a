//! The developed leaf: what it was grown from, and its margin and main veins at any step.

use super::network::MainVeinStyle;
use super::plan::DevelopmentPlan;
use super::steps::Developing;
use crate::document::Declared;
use crate::not_grown::NotGrown;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// A leaf that has developed from its margin.
#[derive(Clone, Debug, PartialEq)]
pub struct DevelopedLeaf {
    plan: DevelopmentPlan,
    seed: u64,
    grown: Developing,
}

/// A main vein of a developed leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MainVein {
    /// 1 for the midrib and others from the base, else one more than the vein it springs from.
    pub order: u8,
    /// The wave of initiation that brought it, from 0; nothing for the midrib.
    pub wave: Option<usize>,
    /// The step in which its convergence point appeared.
    pub born: u32,
    /// Where it ends on the margin, mm.
    pub tip: [f64; 2],
    /// Where it springs from the vein that bears it, mm.
    pub origin: [f64; 2],
}

impl DevelopmentPlan {
    /// Lets the leaf develop.
    ///
    /// # Errors
    ///
    /// [`NotGrown`]: a number out of range, or more convergence points than a leaf may have.
    pub fn develop(&self, seed: u64) -> Result<DevelopedLeaf, NotGrown> {
        self.develop_until(seed, self.steps())
    }

    /// Steps that the development takes.
    pub fn steps(&self) -> u32 {
        Developing::steps(self)
    }

    /// As [`DevelopmentPlan::develop`], but only the first steps.
    ///
    /// # Errors
    ///
    /// As [`DevelopmentPlan::develop`].
    pub(crate) fn develop_until(&self, seed: u64, steps: u32) -> Result<DevelopedLeaf, NotGrown> {
        self.validate()?;
        let mut grown = Developing::new(self, seed);
        for _ in 0..steps.min(self.steps()) {
            grown.advance(self)?;
        }
        Ok(DevelopedLeaf {
            plan: self.clone(),
            seed,
            grown,
        })
    }
}

impl DevelopedLeaf {
    /// Steps done.
    pub fn step(&self) -> u32 {
        self.grown.step
    }

    /// The same leaf after fewer steps.
    ///
    /// # Errors
    ///
    /// As [`DevelopmentPlan::develop`].
    pub(crate) fn at_step(&self, step: u32) -> Result<Self, NotGrown> {
        if step >= self.grown.step {
            return Ok(self.clone());
        }
        self.plan.develop_until(self.seed, step)
    }

    /// Length of the midrib over that of the primordium.
    pub fn length(&self) -> f64 {
        self.grown.skeleton.length()
    }

    /// The margin, its midrib from the origin to (0, `length_mm`).
    ///
    /// # Errors
    ///
    /// [`NotGrown`], [`NotGrown`].
    pub fn outline(&self, length_mm: f64) -> Result<Outline, NotGrown> {
        self.grown.outline(length_mm)
    }

    /// The main veins, in the frame of [`DevelopedLeaf::outline`] for the same length.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] of the style.
    pub fn network(
        &self,
        length_mm: f64,
        style: MainVeinStyle,
    ) -> Result<VenationNetwork, NotGrown> {
        style.in_range()?;
        Ok(self.grown.network(length_mm, style))
    }

    /// The main veins one by one, the midrib first, in the order in which they came.
    pub fn veins(&self, length_mm: f64) -> Vec<MainVein> {
        let skeleton = &self.grown.skeleton;
        let scale = length_mm / skeleton.length();
        let place = |node: u32| (skeleton.nodes[node as usize].place * scale).to_array();
        let vein = |vein: &super::skeleton::Vein| MainVein {
            order: vein.order,
            wave: vein.wave,
            born: vein.born,
            tip: place(vein.tip),
            origin: place(vein.origin.min(vein.tip)),
        };
        skeleton.veins.iter().map(vein).collect()
    }
}
