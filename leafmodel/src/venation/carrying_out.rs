//! Carrying out a checked plan: which rule sources follow, and what comes after what.

use super::bipolar::Bipolar;
use super::closed::Anastomosis;
use super::given::GivenVeins;
use super::grown::Grown;
use super::influence::Influence;
use super::lamina::Lamina;
use super::lamina_clock::LaminaClock;
use super::network::Ending;
use super::open::NearestNode;
use super::plan::{AuxinPlan, Neighbourhood, Pattern};
use super::relative_neighbourhood::RelativeNeighbourhood;
use super::simulation::Simulation;
use super::urquhart::UrquhartNeighbourhood;

/// Runs a checked plan; returns the full-grown state and those after `steps`.
#[cfg(test)]
pub(crate) fn carry_out(
    plan: &AuxinPlan,
    lamina: Lamina,
    clock: LaminaClock,
    seed: u64,
    steps: &[u32],
    is_stopped: &dyn Fn() -> bool,
) -> (Grown, Vec<Grown>) {
    let watch = Watch {
        steps,
        young: Vec::new(),
        is_stopped,
    };
    carry_out_from(plan, lamina, clock, None, seed, watch)
}

/// As [`carry_out`], from veins that are there.
pub(super) fn carry_out_from(
    plan: &AuxinPlan,
    lamina: Lamina,
    clock: LaminaClock,
    given: Option<&GivenVeins>,
    seed: u64,
    watch: Watch<'_>,
) -> (Grown, Vec<Grown>) {
    match plan.pattern {
        Pattern::Open => simulate::<NearestNode>(plan, lamina, clock, given, seed, watch),
        Pattern::Closed(Neighbourhood::Relative) => {
            simulate::<Anastomosis<RelativeNeighbourhood>>(plan, lamina, clock, given, seed, watch)
        }
        Pattern::Closed(Neighbourhood::Bipolar) => {
            simulate::<Anastomosis<Bipolar>>(plan, lamina, clock, given, seed, watch)
        }
        Pattern::Closed(Neighbourhood::Urquhart) => {
            simulate::<Anastomosis<UrquhartNeighbourhood>>(plan, lamina, clock, given, seed, watch)
        }
    }
}

/// Records states while veins grow, and stops the growth on request.
pub(super) struct Watch<'a> {
    /// Steps whose states are to be kept.
    pub(super) steps: &'a [u32],
    /// The states kept so far.
    pub(super) young: Vec<Grown>,
    /// Returns whether to stop.
    pub(super) is_stopped: &'a dyn Fn() -> bool,
}

impl Watch<'_> {
    /// Keeps the state if its step is wanted; returns whether to go on.
    fn look<I: Influence>(&mut self, now: &Simulation<'_, I>) -> bool {
        if self.steps.contains(&now.step) {
            self.young.push(now.state(Ending::Growing));
        }
        !(self.is_stopped)()
    }
}

fn simulate<I: Influence>(
    plan: &AuxinPlan,
    lamina: Lamina,
    clock: LaminaClock,
    given: Option<&GivenVeins>,
    seed: u64,
    mut watch: Watch<'_>,
) -> (Grown, Vec<Grown>) {
    let mut simulation = Simulation::<I>::new(plan, lamina, clock, seed);
    if let Some(given) = given {
        simulation.start_from(given);
    }
    watch.look(&simulation);
    // Veins that are given take the place of those that would be laid out.
    let mut rounds = if given.is_some() {
        Vec::new()
    } else {
        if let Some(architecture) = &plan.architecture {
            simulation.lay_out_architecture(architecture, |now| watch.look(now));
        }
        simulation.arch_rounds()
    };
    if let Some(arches) = rounds.pop() {
        // Secondaries end freely at first and join later (\[scarpella2004\]).
        let mut free = simulation.under::<NearestNode>();
        for round in rounds {
            free.lay_out(&round, |now| watch.look(now));
        }
        simulation = free.under();
        simulation.lay_out(&arches, |now| watch.look(now));
    }
    let mut ending = simulation.run(|now| watch.look(now));
    let grown = match &plan.free_endings {
        None => simulation.state(ending),
        Some(free) => {
            let rest = free.as_plan(plan);
            let mut veinlets = simulation.with_free_endings(&rest, free);
            let last = veinlets.run(|now| watch.look(now));
            if last != Ending::Settled {
                ending = last;
            }
            veinlets.state(ending)
        }
    };
    (grown, watch.young)
}
