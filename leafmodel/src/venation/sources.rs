//! The present auxin sources, in the order of their birth.
//!
//! A source is either *known*, with its own [`Influence`], or lone ([`super::lone`]). The data that
//! each step reads of all sources are stored contiguously, apart from the rest.

use glam::DVec2;
use rayon::prelude::*;

use super::fresh_nodes::FreshNodes;
use super::influence::{Influence, Surroundings};
use super::lone::{Lone, LoneSources};

/// Stored instead of a basin's number: the source is known.
const KNOWN: u32 = u32::MAX;

/// Stored instead of a basin's number: the source is gone.
const GONE: u32 = u32::MAX - 1;

/// Number of known sources from which several threads are used.
const MANY: usize = 512;

/// Number of steps between two tests whether a known source has become lone.
const RECONSIDERED: u32 = 16;

/// A source with its own influence.
pub(crate) struct Known<I> {
    /// Its place in the lists.
    pub(crate) slot: u32,
    /// Its influence on the veins.
    pub(crate) influence: I,
}

/// All sources.
pub(crate) struct Sources<I> {
    places: Vec<DVec2>,
    /// The basin of a lone source, or [`KNOWN`], or [`GONE`].
    basins: Vec<u32>,
    /// For each source the number of consecutive steps in which none of its nodes could grow.
    blocked_steps: Vec<u32>,
    ids: Vec<u32>,
    /// For each source the place where its tissue started.
    starts: Vec<DVec2>,
    /// The known sources, by slot.
    pub(crate) known: Vec<Known<I>>,
    lone: LoneSources,
    gone: usize,
    /// Whether any of `blocked_steps` is not 0.
    some_are_blocked: bool,
}

impl<I: Influence> Sources<I> {
    /// An empty set of sources.
    pub(crate) fn new() -> Self {
        Self {
            places: Vec::new(),
            basins: Vec::new(),
            blocked_steps: Vec::new(),
            ids: Vec::new(),
            starts: Vec::new(),
            known: Vec::new(),
            lone: LoneSources::new(),
            gone: 0,
            some_are_blocked: false,
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.gone == self.basins.len()
    }

    /// Places of the sources that are there, in the order of their birth.
    pub(crate) fn places(&self) -> impl Iterator<Item = DVec2> + '_ {
        let all = self.basins.iter().zip(&self.places);
        all.filter(|(basin, _)| **basin != GONE)
            .map(|(_, &place)| place)
    }

    /// Adds source number `id`, whose tissue started at `start`. It may be lone if it is farther
    /// than `near` from all veins.
    pub(crate) fn push(
        &mut self,
        id: u32,
        place: DVec2,
        start: DVec2,
        near: Option<f64>,
        surroundings: &Surroundings,
    ) {
        let slot = self.basins.len() as u32;
        self.places.push(place);
        self.starts.push(start);
        self.ids.push(id);
        self.blocked_steps.push(0);
        self.basins.push(KNOWN);
        let basins = &mut self.basins;
        let is_lone = near.is_some_and(|near| {
            let settled = |lone: Lone, basin| basins[lone.slot as usize] = basin;
            let lone = Lone { place, slot };
            self.lone.try_insert(lone, near, surroundings.tree, settled)
        });
        if !is_lone {
            self.known.push(Known {
                slot,
                influence: I::new(place, id, surroundings),
            });
        }
    }

    /// Adapts the cells of lone sources to sources that are born `spacing` apart.
    pub(crate) fn fit_cells(&mut self, spacing: f64) {
        let basins = &mut self.basins;
        self.lone
            .fit_cells(spacing, |lone, basin| basins[lone.slot as usize] = basin);
    }

    /// Lets every source take in new nodes; sources farther than `near` from them may be lone.
    pub(crate) fn notice(
        &mut self,
        fresh: &FreshNodes,
        near: Option<f64>,
        surroundings: &Surroundings,
    ) {
        let update = |known: &mut Known<I>| known.influence.notice(fresh, surroundings);
        if self.known.len() > MANY {
            let known = self.known.par_iter_mut().with_min_len(64);
            known.for_each(update);
        } else {
            self.known.iter_mut().for_each(update);
        }
        let Some(near) = near else {
            return;
        };
        let basins = &mut self.basins;
        let leaving = self
            .lone
            .notice(fresh, surroundings.tree, near, |lone, basin| {
                basins[lone.slot as usize] = basin;
            });
        if leaving.is_empty() {
            return;
        }
        let ids = &self.ids;
        self.known.extend(leaving.into_iter().map(|lone| {
            basins[lone.slot as usize] = KNOWN;
            Known {
                slot: lone.slot,
                influence: I::new(lone.place, ids[lone.slot as usize], surroundings),
            }
        }));
        self.known.sort_unstable_by_key(|known| known.slot);
    }

    /// Finds known sources that have become lone; each is tested only every few steps.
    pub(crate) fn reconsider(&mut self, step: u32, near: f64, surroundings: &Surroundings) {
        let Self {
            known,
            places,
            basins,
            lone,
            ..
        } = self;
        known.retain(|known| {
            let slot = known.slot;
            if slot % RECONSIDERED != step % RECONSIDERED || !known.influence.is_untouched() {
                return true;
            }
            let place = places[slot as usize];
            let settled = |lone: Lone, basin| basins[lone.slot as usize] = basin;
            !lone.try_insert(Lone { place, slot }, near, surroundings.tree, settled)
        });
    }

    /// Moves all sources, none of which may be lone, with their tissue; `now_at` maps starting
    /// places to present ones.
    pub(crate) fn carry(
        &mut self,
        now_at: impl Fn(DVec2) -> DVec2,
        surroundings: &Surroundings,
        mut moved: impl FnMut(u32, DVec2),
    ) {
        for known in &mut self.known {
            let slot = known.slot as usize;
            let place = now_at(self.starts[slot]);
            self.places[slot] = place;
            moved(self.ids[slot], place);
            known.influence.relocate(place, surroundings);
        }
    }

    /// Calls `visit` with the place of each source and each node that it drives, in the order of
    /// birth.
    pub(crate) fn each_driven(&self, mut visit: impl FnMut(DVec2, u32)) {
        let mut known = self.known.iter();
        for (&basin, &place) in self.basins.iter().zip(&self.places) {
            match basin {
                GONE => {}
                KNOWN => {
                    if let Some(known) = known.next() {
                        known.influence.each_driven(|node| visit(place, node));
                    }
                }
                basin => visit(place, self.lone.node(basin)),
            }
        }
    }

    /// Counts the steps in which no node of a source could grow: `all_blocked` says so for a known
    /// source, `is_blocked` for a node.
    pub(crate) fn count_blocked(
        &mut self,
        mut all_blocked: impl FnMut(&mut I) -> bool,
        is_blocked: impl Fn(u32) -> bool,
        some_are_blocked: bool,
    ) {
        if !(some_are_blocked || self.some_are_blocked) {
            for known in &mut self.known {
                let blocked = all_blocked(&mut known.influence);
                self.some_are_blocked |= blocked;
                self.blocked_steps[known.slot as usize] = u32::from(blocked);
            }
            return;
        }
        let mut some = false;
        let mut known = self.known.iter_mut();
        for (&basin, steps) in self.basins.iter().zip(&mut self.blocked_steps) {
            let blocked = match basin {
                GONE => continue,
                KNOWN => known
                    .next()
                    .is_some_and(|known| all_blocked(&mut known.influence)),
                basin => is_blocked(self.lone.node(basin)),
            };
            *steps = if blocked { *steps + 1 } else { 0 };
            some |= blocked;
        }
        self.some_are_blocked = some;
    }

    /// Removes the lone sources whose node could not grow for `patience` steps; calls `gone` with
    /// number and place of each.
    pub(crate) fn give_up_lone(&mut self, patience: u32, mut gone: impl FnMut(u32, DVec2)) {
        if !self.some_are_blocked {
            return;
        }
        for slot in 0..self.basins.len() {
            let is_lone = !matches!(self.basins[slot], GONE | KNOWN);
            if is_lone && self.blocked_steps[slot] >= patience {
                let place = self.places[slot];
                let slot = slot as u32;
                self.lone.remove(Lone { place, slot });
                let slot = slot as usize;
                self.basins[slot] = GONE;
                self.gone += 1;
                gone(self.ids[slot], place);
            }
        }
    }

    /// Removes the known sources for which `stays` is false.
    pub(crate) fn retain_known(
        &mut self,
        mut stays: impl FnMut(&mut Known<I>, u32, DVec2, u32) -> bool,
    ) {
        let Self {
            known,
            basins,
            places,
            ids,
            blocked_steps,
            gone,
            ..
        } = self;
        known.retain_mut(|known| {
            let slot = known.slot as usize;
            let stays = stays(known, ids[slot], places[slot], blocked_steps[slot]);
            if !stays {
                basins[slot] = GONE;
                *gone += 1;
            }
            stays
        });
        if self.gone > 64 && self.gone * 4 > self.basins.len() {
            self.close_ranks();
        }
    }

    /// Compacts the lists.
    fn close_ranks(&mut self) {
        let mut next = 0;
        let is_there = |basin: &u32| *basin != GONE;
        let slots: Vec<u32> = self
            .basins
            .iter()
            .map(|basin| {
                let slot = next;
                next += u32::from(is_there(basin));
                slot
            })
            .collect();
        keep(&mut self.places, &self.basins);
        keep(&mut self.starts, &self.basins);
        keep(&mut self.ids, &self.basins);
        keep(&mut self.blocked_steps, &self.basins);
        self.basins.retain(is_there);
        for known in &mut self.known {
            known.slot = slots[known.slot as usize];
        }
        self.lone.renumber(&slots);
        self.gone = 0;
    }

    /// Removes all sources; calls `gone` with number and place of each.
    pub(crate) fn drain(&mut self, mut gone: impl FnMut(u32, DVec2)) {
        for (slot, _) in self
            .basins
            .iter()
            .enumerate()
            .filter(|(_, basin)| **basin != GONE)
        {
            gone(self.ids[slot], self.places[slot]);
        }
        *self = Self::new();
    }
}

/// Keeps the entries of a list whose sources are not gone.
fn keep<T>(list: &mut Vec<T>, basins: &[u32]) {
    let mut slot = 0;
    list.retain(|_| {
        slot += 1;
        basins[slot - 1] != GONE
    });
}
