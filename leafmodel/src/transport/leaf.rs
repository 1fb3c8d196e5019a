//! The grown leaf: its cells, their parents, its cost and the stages of its growth.

use super::cells::{Cell, NONE};
use super::cost::TransportSystem;
use super::growth::{Growth, Outgrown};
use super::plan::{Ladder, TransportPlan};
use super::revenue::Revenue;
use super::tree::Tree;
use crate::not_grown::{NotGrown, not_grown};

/// The leaf at one step of the rising revenue.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// `ε` of the step.
    pub epsilon: f64,
    /// `F` of the leaf at that time.
    pub cost: f64,
    /// The parent of each cell of the stage; these cells are the first ones of the full-grown leaf.
    pub(crate) parents: Vec<u32>,
}

impl Stage {
    /// Number of cells at this stage.
    pub fn cells(&self) -> usize {
        self.parents.len()
    }
}

/// A leaf whose transport network is a local minimum of the cost.
///
/// Cells are numbered in the order in which they were added. The root is 0; every other cell has a
/// parent. In mirrored leaves a cell of the right half comes just before its mirror image.
#[derive(Clone, Debug, PartialEq)]
pub struct TransportLeaf {
    plan: TransportPlan,
    seed: u64,
    cells: Vec<Cell>,
    parents: Vec<u32>,
    counts: Vec<u32>,
    generations: Vec<u32>,
    cost: f64,
    stages: Vec<Stage>,
}

impl TransportPlan {
    /// Grows the leaf: an (`ε`, `h`) leaf of Definition 3.5 of \[xia2007\]. `seed` is used for
    /// uneven light only.
    ///
    /// # Errors
    ///
    /// [`NotGrown`]; [`NotGrown`] as soon as the leaf
    /// outgrows `most_cells`.
    pub fn grow(&self, seed: u64) -> Result<TransportLeaf, NotGrown> {
        self.validate()?;
        let outgrown = |Outgrown { cells }| {
            let error = not_grown!(
                "the leaf has {cells} cells when most_cells is {}; only for alpha above 0.5 is it \
                 sure to stop growing (alpha is {})",
                self.most_cells,
                self.alpha
            );
            let help = "use a lower revenue, a larger alpha, or allow more cells";
            error.mend("epsilon", help)
        };
        let mut growth = self.seedling(seed);
        let last = self.in_cells(self.epsilon);
        let mut stages = Vec::new();
        match self.ladder {
            Ladder::Equal(steps) => {
                // The least revenue at which the first cell can be added under uneven light.
                let first = last.min(1.0 / self.revenue(seed).greatest());
                for step in 0..=steps {
                    let share = f64::from(step) / f64::from(steps);
                    let epsilon = first * (1.0 - share) + last * share;
                    growth.settle(epsilon).map_err(outgrown)?;
                    stages.push(self.stage(&growth, self.epsilon * (epsilon / last)));
                }
            }
            Ladder::Events => {
                while let Some(epsilon) = growth.next_event(last) {
                    let before = growth.cells();
                    growth.settle(epsilon).map_err(outgrown)?;
                    stages.push(self.stage(&growth, self.epsilon * (epsilon / last)));
                    // By rounding, a cell that would just break even may not be added.
                    if growth.cells() == before {
                        break;
                    }
                }
                stages.push(self.stage(&growth, self.epsilon));
            }
        }
        Ok(self.leaf_of(&growth, seed, stages))
    }

    /// A copy of the growing leaf as a grown one.
    pub(crate) fn leaf_of(&self, growth: &Growth, seed: u64, stages: Vec<Stage>) -> TransportLeaf {
        let (cells, parents, copied) = unfolded(&growth.tree);
        let counts = copied.iter().map(|&v| growth.tree.nodes[v as usize].weight);
        let generations = copied.iter().map(|&v| growth.generations[v as usize]);
        TransportLeaf {
            plan: self.clone(),
            seed,
            counts: counts.collect(),
            generations: generations.collect(),
            cells,
            parents,
            cost: self.to_scale(growth.tree.cost()),
            stages,
        }
    }

    /// The root alone, ready to grow.
    pub(crate) fn seedling(&self, seed: u64) -> Growth {
        let revenue = self.revenue(seed);
        Growth::new(
            [self.alpha, self.beta],
            self.is_mirrored(),
            revenue,
            self.most_cells,
        )
    }

    pub(crate) fn revenue(&self, seed: u64) -> Revenue {
        Revenue {
            noise: self.noise,
            patch: self.noise_cells,
            seed,
        }
    }

    /// Converts a cost from cells to the plan's unit of length, a factor of `h^{2α+1}`.
    pub(crate) fn to_scale(&self, cost: f64) -> f64 {
        cost * libm::pow(self.cell, 2.0 * self.alpha + 1.0)
    }

    pub(crate) fn stage(&self, growth: &Growth, epsilon: f64) -> Stage {
        Stage {
            epsilon,
            cost: self.to_scale(growth.tree.cost()),
            parents: unfolded(&growth.tree).1,
        }
    }
}

/// Cells and parents of the whole leaf, and the node of the tree for each.
pub(crate) fn unfolded(tree: &Tree) -> (Vec<Cell>, Vec<u32>, Vec<u32>) {
    let (mut cells, mut parents, mut copied) = (Vec::new(), Vec::new(), Vec::new());
    // The number of each node's first cell. All are needed first, since a parent may be younger
    // than its child.
    let mut numbers = Vec::with_capacity(tree.nodes.len());
    let mut next = 0;
    for node in &tree.nodes {
        numbers.push(next);
        next += node.copies;
    }
    for (v, (&cell, node)) in (0_u32..).zip(tree.cells.iter().zip(&tree.nodes)) {
        for image in 0..node.copies {
            cells.push(if image == 0 { cell } else { cell.mirrored() });
            copied.push(v);
            parents.push(if node.parent == NONE {
                NONE
            } else {
                let across = image.min(tree.nodes[node.parent as usize].copies - 1);
                numbers[node.parent as usize] + across
            });
        }
    }
    (cells, parents, copied)
}

impl TransportLeaf {
    /// The plan from which it was grown.
    pub fn plan(&self) -> &TransportPlan {
        &self.plan
    }

    /// The seed of its uneven light.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Its cells; the first is the root.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The number of the cell that supplies cell `v`; `None` for the root.
    pub fn parent(&self, v: usize) -> Option<usize> {
        (self.parents[v] != NONE).then_some(self.parents[v] as usize)
    }

    /// The numbers of all cells, each after that of its parent.
    pub(crate) fn root_to_tip(&self) -> Vec<usize> {
        self.system().root_to_tip()
    }

    /// Whether both sides are exact mirror images.
    pub fn is_mirrored(&self) -> bool {
        self.plan.is_mirrored()
    }

    /// How many cells are supplied through each cell, itself included: `w(e_v)/h²`, ≥ 1.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// For each cell the number of the application of `L` that added it; 0 for the root. A step of
    /// the ladder takes several applications.
    pub fn generations(&self) -> &[u32] {
        &self.generations
    }

    /// `F`, the cost of transport, in the plan's unit of length to the power 2α + 1.
    pub fn cost(&self) -> f64 {
        self.cost
    }

    /// The leaf at each step of the ladder; the last is full-grown.
    pub fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// The leaf at a stage; a stage beyond the last means the full-grown leaf.
    pub(crate) fn at_stage(&self, stage: usize) -> Self {
        let Some(then) = self.stages.get(stage) else {
            return self.clone();
        };
        let kept: Vec<usize> = (0..then.cells()).collect();
        let mut young = self.part(&kept, |v| then.parents[v]);
        young.plan.epsilon = then.epsilon;
        young.stages.truncate(stage + 1);
        young
    }

    /// The leaf with only the `kept` cells, ascending. `parent` gives the parents' numbers among
    /// them.
    pub(crate) fn part(&self, kept: &[usize], parent: impl Fn(usize) -> u32) -> Self {
        let mut part = Self {
            plan: self.plan.clone(),
            seed: self.seed,
            cells: kept.iter().map(|&v| self.cells[v]).collect(),
            parents: kept.iter().map(|&v| parent(v)).collect(),
            counts: Vec::new(),
            generations: kept.iter().map(|&v| self.generations[v]).collect(),
            cost: 0.0,
            stages: self.stages.clone(),
        };
        part.counts = part.system().counts();
        part.cost = part.system().cost();
        part
    }

    /// The leaf as a transport system, whose quantities are computed from the definitions.
    pub fn system(&self) -> TransportSystem<'_> {
        let TransportPlan {
            alpha, beta, cell, ..
        } = self.plan;
        TransportSystem::new(&self.cells, &self.parents, [alpha, beta, cell])
    }
}
