//! A step's growth: driven nodes get children, and sources that veins have reached are used up.

use glam::DVec2;

use crate::venation::simulation::NO_DIRECTION;
use crate::venation::simulation::Outcome;
use crate::venation::simulation::TURNING;
use crate::venation::simulation::turned;

use super::{PATIENCE, Simulation};
use crate::venation::influence::{Fate, Influence};
use crate::venation::sources::Known;
use crate::venation::veins::COINCIDENT;

impl<I: Influence> Simulation<'_, I> {
    /// Adds up, for each driven node, the unit vectors to its sources (Eq. 1); returns the driven
    /// nodes by number.
    pub(super) fn gather_pulls(&mut self) -> Vec<u32> {
        let count = self.veins.positions.len();
        self.pulls.resize(count, DVec2::ZERO);
        self.is_driven.resize(count, false);
        let mut driven = Vec::new();
        let (pulls, is_driven) = (&mut self.pulls, &mut self.is_driven);
        let positions = &self.veins.positions;
        self.sources.each_driven(|place, node| {
            let i = node as usize;
            if !is_driven[i] {
                is_driven[i] = true;
                driven.push(node);
            }
            let way = place - positions[i];
            let length = way.length();
            if length > 0.0 {
                pulls[i] += way / length;
            }
        });
        driven.sort_unstable();
        driven
    }

    /// Places a child for each driven node where possible, and records the outcome.
    pub(super) fn grow_veins(&mut self, driven: &[u32], unit: f64) {
        self.outcomes
            .resize(self.veins.positions.len(), Outcome::Blocked);
        for &node in driven {
            self.outcomes[node as usize] = self.grow_one(node, unit);
        }
    }

    fn grow_one(&mut self, node: u32, unit: f64) -> Outcome {
        let i = node as usize;
        let pull = std::mem::take(&mut self.pulls[i]);
        self.is_driven[i] = false;
        let length = pull.length();
        if length < NO_DIRECTION {
            return Outcome::Blocked;
        }
        let from = self.veins.positions[i];
        let unit = unit * self.lamina.enlargement(from);
        let straight = pull / length * unit;
        let reach = |way: &DVec2| self.lamina.can_reach(from, from + *way);
        let way = if reach(&straight) {
            Some(straight)
        } else if self.turns(node, unit) {
            turned(straight).find(reach)
        } else {
            None
        };
        let Some(way) = way else {
            return Outcome::OffBlade;
        };
        let child = from + way;
        if self.veins.tree.any_within(child, COINCIDENT * unit) {
            return Outcome::Blocked;
        }
        // Only where an architecture asks for it: the rows of the paper let veins run side by side.
        if self.veins.minds_crossings
            && (self.veins.is_crowded(node, way, unit) || self.veins.crosses(node, child, unit))
        {
            return Outcome::Blocked;
        }
        let id = self.veins.add_node(child, self.step, &self.lamina);
        self.veins.add_edge(node, id, &self.lamina);
        Outcome::Child(id)
    }

    /// Whether a vein's tip that would leave the blade turns aside. It does so only near an origin:
    /// the base of a blade whose halves hang down beside the petiole lies in a notch, and a midrib
    /// drawn towards the mean of both halves would end there.
    fn turns(&self, node: u32, unit: f64) -> bool {
        let from = self.veins.positions[node as usize];
        let origins = &self.veins.positions[..self.origins as usize];
        let near = |origin: &DVec2| (*origin - from).length() < TURNING * unit;
        self.veins.is_tip(node) && origins.iter().any(near)
    }

    /// Passes tags on to children and counts the steps in which no node of a source could grow;
    /// returns the number of children.
    pub(super) fn notify_sources(&mut self, driven: &[u32]) -> usize {
        let outcomes = &self.outcomes;
        let outcome_of = |node: u32| outcomes[node as usize];
        let is_blocked = |node: u32| outcome_of(node) == Outcome::Blocked;
        let mut children = Vec::new();
        let all_blocked = |influence: &mut I| {
            let mut all_blocked = true;
            children.clear();
            influence.each_driven(|node| match outcome_of(node) {
                Outcome::Child(child) => {
                    all_blocked = false;
                    children.push((node, child));
                }
                Outcome::OffBlade => all_blocked = false,
                Outcome::Blocked => {}
            });
            for &(parent, child) in &children {
                influence.inherit(parent, child);
            }
            all_blocked
        };
        let some_are_blocked = driven.iter().any(|&node| is_blocked(node));
        self.sources
            .count_blocked(all_blocked, is_blocked, some_are_blocked);
        let has_child = |node: &&u32| matches!(outcome_of(**node), Outcome::Child(_));
        driven.iter().filter(has_child).count()
    }

    /// Removes used-up sources and joins the veins that have met there.
    pub(super) fn judge_sources(&mut self, unit: f64) {
        let mut used_up = Vec::new();
        let source_tree = &mut self.source_tree;
        let lamina = &self.lamina;
        let kill_distance = self.plan.kill_distance;
        self.sources
            .give_up_lone(PATIENCE, |id, place| source_tree.remove(id, place));
        let stays = |known: &mut Known<I>, id: u32, place: DVec2, blocked_steps: u32| {
            let kill = kill_distance * (unit * lamina.enlargement(place));
            let arrivals = match known.influence.judge(kill) {
                Fate::UsedUp(arrivals) => arrivals,
                Fate::Stays if blocked_steps >= PATIENCE => known.influence.give_up(),
                Fate::Stays => return true,
            };
            source_tree.remove(id, place);
            used_up.push((place, arrivals));
            false
        };
        self.sources.retain_known(stays);
        for (place, arrivals) in used_up {
            self.veins
                .weld(place, &arrivals, unit, &self.lamina, self.step);
        }
    }
}
