//! A leaf at times of its growth, whatever it grows by.

use glam::DVec2;

use super::error::LeafError;
use super::lamina::Lamina;
use super::outline_plan::Contour;
use super::plan::LeafPlan;
use super::venation_plan::Growing;
use crate::development::{DevelopedLeaf, MainVeinStyle};
use crate::shape::growth_form::GrowthForm;
use crate::shape::outline::Outline;
use crate::transport::{Ladder, TransportLeaf};
use crate::venation::network::VenationNetwork;
use crate::venation::plan::{AuxinPlan, Growth};
use crate::venation::{Stage, VeinGrowth};

/// Margin and veins at one time of growth, true to the size they have then, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafStage {
    /// The margin.
    pub outline: Outline,
    /// The veins.
    pub network: VenationNetwork,
    /// The auxin sources that are there, mm; none where veins do not grow towards any.
    pub sources: Vec<DVec2>,
}

impl LeafPlan {
    /// The last step of growth of a lamina that this plan has brought forth; the first is 0.
    ///
    /// Steps are those of the veins that grow towards auxin; those in which the revenue of a
    /// transport leaf rises or, if it rises from event to event, the cells that come; those of a
    /// leaf that develops from its margin.
    ///
    /// # Errors
    ///
    /// [`LeafError::NoStages`] if it comes to be all at once.
    pub fn last_step(&self, lamina: &Lamina) -> Result<u32, LeafError> {
        let developed = || part(lamina.developed.as_ref());
        Ok(match self.growing()? {
            Growing::Auxin(_) => lamina.network.steps(),
            Growing::DevelopedThenAuxin(_) => developed()?.step() + lamina.network.steps(),
            Growing::Cells(_) => part(lamina.cells.as_ref())?.last_step(),
            Growing::Filled(_) => part(lamina.filled.as_ref())?.leaf().last_step(),
            Growing::Developed(_) => developed()?.step(),
        })
    }

    /// The lamina at each of some steps, up to the last; beyond it is full-grown.
    ///
    /// # Errors
    ///
    /// [`LeafError`], above all [`LeafError::NoStages`].
    pub fn stages(&self, lamina: &Lamina, steps: &[u32]) -> Result<Vec<LeafStage>, LeafError> {
        let outline = &lamina.outline;
        let all = |stages: Vec<(Outline, VenationNetwork)>| {
            let stages = stages.into_iter();
            stages.map(|(outline, network)| LeafStage {
                outline,
                network,
                sources: Vec::new(),
            })
        };
        let developed = || part(lamina.developed.as_ref());
        Ok(match self.growing()? {
            Growing::Auxin(plan) => {
                let stages = VeinGrowth::new(outline, plan, self.seed).stages(steps);
                let stages = stages.map_err(LeafError::Venation)?.into_iter();
                let stage = |stage: Stage| {
                    let stage = LeafStage {
                        outline: stage.outline,
                        network: stage.network,
                        sources: stage.sources,
                    };
                    match (&self.outline.contour, &plan.growth) {
                        (Contour::GrowthAlgorithm(form), Growth::Isogonic { .. }) => {
                            allometric(form, stage, outline.length())
                        }
                        _ => stage,
                    }
                };
                stages.map(stage).collect()
            }
            Growing::DevelopedThenAuxin(plan) => {
                self.main_then_finer(lamina, developed()?, plan, steps)?
            }
            Growing::Cells(style) => {
                let leaf = part(lamina.cells.as_ref())?;
                let stages: Vec<usize> = steps.iter().map(|&step| leaf.stage_of(step)).collect();
                let stages = leaf.at_scale(self.length_mm, style, &stages);
                all(stages.map_err(LeafError::Venation)?).collect()
            }
            Growing::Filled(style) => {
                let blade = part(lamina.filled.as_ref())?;
                let stages: Vec<usize> = steps.iter().map(|&step| step as usize).collect();
                let networks = blade.networks_at(outline, style, &stages);
                let stages = networks.map_err(LeafError::Venation)?.into_iter();
                all(stages.map(|network| (outline.clone(), network)).collect()).collect()
            }
            Growing::Developed(style) => developed()?.stages(self.length_mm, style, steps)?,
        })
    }

    /// Stages of the development, then those of the finer veins on the full-grown blade.
    fn main_then_finer(
        &self,
        lamina: &Lamina,
        leaf: &DevelopedLeaf,
        plan: &AuxinPlan,
        steps: &[u32],
    ) -> Result<Vec<LeafStage>, LeafError> {
        let outline = &lamina.outline;
        let main = leaf.network(self.length_mm, MainVeinStyle::default());
        let main = main.map_err(LeafError::Venation)?;
        let later = steps
            .iter()
            .filter_map(|&step| step.checked_sub(leaf.step()));
        let later: Vec<u32> = std::iter::once(0).chain(later).collect();
        let finer = VeinGrowth {
            main: Some(&main),
            ..VeinGrowth::new(outline, plan, self.seed)
        };
        let mut finer = finer
            .stages(&later)
            .map_err(LeafError::Venation)?
            .into_iter();
        // Main veins are as wide at the end of the development as at the start of the net.
        let first = finer
            .next()
            .into_iter()
            .flat_map(|stage| stage.network.edges().to_vec());
        let widest = first.map(|edge| edge.radius_from).fold(0.0, f64::max);
        let style = MainVeinStyle {
            base_radius_mm: widest.clamp(1e-4, 100.0),
            murray_exponent: plan.murray_exponent,
        };
        let young: Vec<u32> = steps
            .iter()
            .copied()
            .filter(|&step| step < leaf.step())
            .collect();
        let mut stages = leaf.stages(self.length_mm, style, &young)?.into_iter();
        let mut finer = finer.map(|stage| {
            // The blade has all its size by now.
            let factor = match plan.growth {
                Growth::Isogonic { .. } => outline.length() / stage.outline.length(),
                Growth::None | Growth::Marginal { .. } | Growth::Anisotropic { .. } => 1.0,
            };
            let base = outline.base();
            let sources = stage.sources.iter();
            LeafStage {
                network: stage.network.enlarged(base, factor),
                sources: sources.map(|&p| base + (p - base) * factor).collect(),
                outline: match plan.growth {
                    Growth::Anisotropic { .. } => stage.outline,
                    Growth::None | Growth::Marginal { .. } | Growth::Isogonic { .. } => {
                        outline.clone()
                    }
                },
            }
        });
        let next = |&step: &u32| {
            if step < leaf.step() {
                stages.next()
            } else {
                finer.next()
            }
        };
        Ok(steps.iter().filter_map(next).collect())
    }

    /// Whether it grows in stages, as far as can be known before it grows.
    ///
    /// # Errors
    ///
    /// [`LeafError::NoStages`].
    pub fn check_stages(&self) -> Result<(), LeafError> {
        self.growing().map(drop)
    }

    fn growing(&self) -> Result<Growing<'_>, LeafError> {
        if self.damage.is_some() {
            return Err(LeafError::NoStages(
                "damage comes to a full-grown leaf; take the block `damage` out of the plan",
            ));
        }
        self.venation.growing(&self.outline)
    }
}

/// A stage in the form that the leaf had when it was so long, instead of that of the full-grown leaf
/// reduced.
///
/// It stays as it is where the map of the tissue is not one-to-one: on palmate leaves, and where
/// rows of cells pass over one another.
fn allometric(form: &GrowthForm, stage: LeafStage, final_length: f64) -> LeafStage {
    let (base, length) = (stage.outline.base(), stage.outline.length());
    let Some(course) = form.course(length / final_length).ok().flatten() else {
        return stage;
    };
    let earlier = |p: DVec2| base + course.earlier((p - base) / length) * length;
    let points = stage.outline.points().iter().map(|&p| earlier(p)).collect();
    match Outline::new(points, base, stage.outline.apex()) {
        Ok(outline) => LeafStage {
            outline,
            network: stage.network.moved(earlier),
            sources: stage.sources.into_iter().map(earlier).collect(),
        },
        Err(_) => stage,
    }
}

/// A part that the lamina of this plan has.
fn part<T>(part: Option<&T>) -> Result<&T, LeafError> {
    part.ok_or(LeafError::NoStages("the lamina is that of another plan"))
}

impl DevelopedLeaf {
    /// True to the size that it had at each step.
    fn stages(
        &self,
        length_mm: f64,
        style: MainVeinStyle,
        steps: &[u32],
    ) -> Result<Vec<LeafStage>, LeafError> {
        let stage = |&step: &u32| {
            let young = self.at_step(step).map_err(LeafError::Venation)?;
            let share = young.length() / self.length();
            let style = MainVeinStyle {
                base_radius_mm: (style.base_radius_mm * share).max(1e-4),
                ..style
            };
            Ok(LeafStage {
                outline: young
                    .outline(length_mm * share)
                    .map_err(LeafError::Venation)?,
                network: young
                    .network(length_mm * share, style)
                    .map_err(LeafError::Venation)?,
                sources: Vec::new(),
            })
        };
        steps.iter().map(stage).collect()
    }
}

impl TransportLeaf {
    fn last_step(&self) -> u32 {
        let last = match self.plan().ladder {
            Ladder::Equal(_) => self.stages().len(),
            Ladder::Events => self.cells().len(),
        };
        last.saturating_sub(1) as u32
    }

    /// The stage of a step as [`LeafPlan::last_step`] counts them.
    fn stage_of(&self, step: u32) -> usize {
        match self.plan().ladder {
            Ladder::Equal(_) => step as usize,
            Ladder::Events => {
                let stages = self.stages();
                stages.partition_point(|stage| stage.cells() <= step as usize)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf::venation_plan::VenationPlan;
    use crate::shape::teeth::ToothWave;
    use crate::species;
    use crate::transport::{FilledPlan, TransportPlan};
    use crate::venation::arcuate::ArcuatePlan;
    use crate::venation::plan::Pattern;

    fn preset(name: &str) -> LeafPlan {
        species::find(name).expect("there is one").plan()
    }

    fn seedling_to_leaf(plan: &LeafPlan) -> (Lamina, Vec<LeafStage>) {
        let lamina = plan.grow_lamina().expect("a good plan");
        let last = plan.last_step(&lamina).expect("it has stages");
        let steps: Vec<u32> = (0..=5).map(|i| last * i / 5).collect();
        let stages = plan.stages(&lamina, &steps).expect("it has stages");
        (lamina, stages)
    }

    #[test]
    fn a_leaf_of_the_growth_algorithm_follows_its_allometric_course() {
        for (name, rate_ratio) in [("young-3a", 1.07), ("young-3d", 1.71)] {
            let (lamina, stages) = seedling_to_leaf(&preset(name));
            let mut widths = Vec::new();
            for stage in &stages {
                let (low, high) = stage.outline.bounds();
                let width_over_length = (high.x - low.x) / stage.outline.length();
                // Eqs. 1 and 2 in closed form, for the row that grows fastest.
                let enlargement = 1000.0 * stage.outline.length() / lamina.outline.length();
                let steps = libm::log(enlargement) / libm::log(1.1);
                let half_width = libm::pow(1.0 + 0.1 / rate_ratio, steps) / enlargement;
                assert!((width_over_length / (2.0 * half_width) - 1.0).abs() < 1e-9);
                let nodes = stage.network.nodes().iter();
                let inside = nodes.filter(|node| stage.outline.covers(node.position));
                assert_eq!(inside.count(), stage.network.nodes().len());
                widths.push(width_over_length);
            }
            assert!(
                widths.windows(2).all(|pair| pair[1] < pair[0] - 1e-3),
                "{widths:?}"
            );
            let grown = stages.last().expect("stages");
            assert!((grown.outline.area() / lamina.outline.area() - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_transport_leaf_grows_to_scale_from_one_cell_with_its_root_in_one_place() {
        for events in [false, true] {
            let mut plan = preset("xia-1");
            if events {
                plan.outline = Contour::Transport(TransportPlan {
                    ladder: Ladder::Events,
                    ..TransportPlan::default()
                })
                .into();
            }
            let (lamina, stages) = seedling_to_leaf(&plan);
            let cell = lamina.network.segment_mm();
            for pair in stages.windows(2) {
                assert!(pair[0].outline.area() < pair[1].outline.area());
                // By at most a tether outside of what comes later.
                for &p in pair[0].outline.points() {
                    let outline = &pair[1].outline;
                    assert!(outline.contains(p) || outline.distance_to_margin(p) < cell);
                }
            }
            for stage in &stages {
                assert!(stage.outline.base().length() < 1.5 * cell);
                assert_eq!(stage.network.validate(), Ok(()));
                let inside = |p| stage.outline.covers(p);
                assert!(
                    stage
                        .network
                        .nodes()
                        .iter()
                        .all(|node| inside(node.position))
                );
            }
            // The first cell comes at once, above the root.
            assert!(stages[0].outline.area() < 2.5 * cell * cell);
            assert_eq!(stages[5].outline, lamina.outline);
            assert_eq!(stages[5].network, lamina.network);
        }
    }

    #[test]
    fn veins_that_fill_a_blade_grow_on_the_blade_that_is_there() {
        let mut plan = preset("young-4a");
        plan.venation = FilledPlan {
            cells_along: 30,
            ..FilledPlan::default()
        }
        .into();
        let (lamina, stages) = seedling_to_leaf(&plan);
        let nodes = |stage: &LeafStage| stage.network.nodes().len();
        for pair in stages.windows(2) {
            assert!(nodes(&pair[0]) < nodes(&pair[1]));
            assert_eq!(pair[0].outline, lamina.outline);
        }
        assert_eq!(stages[5].network, lamina.network);
    }

    #[test]
    fn what_is_there_all_at_once_has_no_stages_and_says_so() {
        let refused = |plan: &LeafPlan| {
            let lamina = plan.grow_lamina().expect("a good plan");
            plan.last_step(&lamina).expect_err("none").to_string()
        };
        let mut splines = preset("xia-1");
        splines.venation = ArcuatePlan::default().into();
        assert!(refused(&splines).contains("arcuate veins are there all at once"));
        let mut toothed = preset("xia-1");
        toothed.outline.teeth = vec![ToothWave {
            per_side: 5,
            height: 0.002,
            lean: 0.0,
            fade_base: 0.2,
            fade_apex: 0.2,
            ..ToothWave::default()
        }];
        assert!(refused(&toothed).contains("teeth belong to the full-grown margin"));
    }

    #[test]
    fn sources_stay_clear_of_open_veins_and_of_each_other_and_are_gone_at_the_end() {
        let mut plan = preset("poplar");
        let VenationPlan::Auxin(auxin) = &mut plan.venation else {
            panic!("veins of the poplar grow towards auxin")
        };
        auxin.pattern = Pattern::Open;
        auxin.final_length = 150.0;
        let kill = auxin.kill_distance;
        let lamina = plan.grow_lamina().expect("a good plan");
        let last = plan.last_step(&lamina).expect("it has stages");
        let steps: Vec<u32> = (0..=20).map(|i| last * i / 20).collect();
        let stages = plan.stages(&lamina, &steps).expect("it has stages");
        let segment = lamina.network.segment_mm();
        let mut seen = 0;
        for stage in &stages[1..] {
            for (number, &source) in stage.sources.iter().enumerate() {
                assert!(stage.outline.contains(source));
                let nodes = stage.network.nodes().iter();
                let away = nodes.map(|node| node.position.distance(source));
                let away = away.fold(f64::INFINITY, f64::min);
                assert!(
                    away >= kill * segment * (1.0 - 1e-9),
                    "{away} {kill} {segment}"
                );
                assert!(!stage.sources[..number].contains(&source));
                seen += 1;
            }
        }
        assert!(seen > 20, "{seen}");
        let end = stages.last().expect("stages");
        assert_eq!(end.sources, []);
    }
}
