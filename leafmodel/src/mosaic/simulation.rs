//! The growth of a mosaic: cells are placed, relax and divide.

mod regions;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::DVec3;

use self::regions::Regions;
use super::control::Controls;
use super::division::{child_id, chosen, days_to_division, kind_of_child, place_of_child};
use super::live::Live;
use super::plan::{MosaicPlan, RadiusRule};
use super::relaxation::{Bonds, Relaxation, free_walk};
use super::surface::subdivide::Ancestry;
use super::surface::{Surface, SurfacePoint};
use crate::document::RangeError;
use crate::grow_options::GrowOptions;
use crate::not_grown::{NotGrown, not_grown};
use crate::random::{Use, bits, uniform};

/// Number of attempts to place an initial cell before the surface counts as blocked.
const THROWS: u32 = 1000;

/// Number of attempts to place a child outside blocked areas; after them it lies at its parent's
/// place.
const CHILD_TRIES: u64 = 16;

/// Faces are cut until no edge is longer than this, over the radius.
const LONGEST_EDGE: f64 = 1.5;

/// A cell of a mosaic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Its place on the surface.
    pub at: SurfacePoint,
    /// Its type, as an index of the plan's.
    pub kind: u16,
    /// Its clone: the initial cell that it descends from, from 0.
    pub clone: u32,
    /// The cell whose child it is, as an index of the mosaic's; `None` for an initial cell.
    pub parent: Option<u32>,
}

/// A mosaic at one time: cells on a surface.
#[derive(Clone, Debug)]
pub struct Mosaic {
    /// The surface, at that time's size; faces as in the surface given.
    pub surface: Arc<Surface>,
    /// The cells: first the initial ones, then children by the time of their birth.
    pub cells: Vec<Cell>,
    /// Repulsion radius at that time, mm.
    pub radius_mm: f64,
    /// The time, days.
    pub day: f64,
}

const NO_PARENT: u32 = u32::MAX;
const NEVER: u64 = u64::MAX;

impl Mosaic {
    /// Grows a mosaic on a surface for the plan's days.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], if the plan is not valid or there are too many cells.
    pub fn grow(surface: &Surface, plan: &MosaicPlan, seed: u64) -> Result<Self, NotGrown> {
        let mut mosaics = GrowOptions::default().mosaics(surface, plan, seed, &[plan.days])?;
        Ok(mosaics.remove(0))
    }

    /// Places of the cells in space, mm.
    pub fn positions(&self) -> Vec<DVec3> {
        let places = self
            .cells
            .iter()
            .map(|cell| self.surface.position(&cell.at));
        places.collect()
    }
}

impl GrowOptions<'_> {
    /// A mosaic at several times of one run, in the order of `days` (each from 0 to the plan's
    /// days).
    ///
    /// The same surface, plan and seed give the same bits, on any number of threads and whatever
    /// other days are asked for.
    ///
    /// # Errors
    ///
    /// As [`Mosaic::grow`]; [`NotGrown`] for a day outside the plan's, and where growth is stopped.
    pub fn mosaics(
        self,
        surface: &Surface,
        plan: &MosaicPlan,
        seed: u64,
        days: &[f64],
    ) -> Result<Vec<Mosaic>, NotGrown> {
        plan.validate()?;
        for &day in days {
            let good = (0.0..=plan.days).contains(&day);
            RangeError::unless(good, "day of a stage", day, "0 to the days of the plan")?;
        }
        let event = |day: f64| (day * f64::from(plan.relaxations_per_day)).round() as u64;
        let mut order: Vec<usize> = (0..days.len()).collect();
        order.sort_by(|&a, &b| days[a].total_cmp(&days[b]));
        let mut run = Run::start(surface, plan, seed, self.is_stopped)?;
        let mut grown: Vec<Option<Mosaic>> = days.iter().map(|_| None).collect();
        for stage in order {
            while run.event < event(days[stage]) {
                if (self.is_stopped)() {
                    return Err(NotGrown::stopped("stopped"));
                }
                run.next_event(self.most_cells)?;
            }
            grown[stage] = Some(run.mosaic(days[stage])?);
        }
        Ok(grown.into_iter().flatten().collect())
    }
}

/// A mosaic that is growing.
struct Run<'a> {
    plan: &'a MosaicPlan,
    controls: Controls<'a>,
    adhesion: Vec<Vec<f64>>,
    /// The surface as given.
    given: &'a Surface,
    /// The surface subdivided, at its final size.
    mature: Surface,
    ancestry: Ancestry,
    /// The surface subdivided, at the size of the day; `None` if it does not grow.
    grown: Option<Surface>,
    relaxation: Relaxation,
    regions: Option<Regions>,
    /// Area of one cell when the mosaic starts, mm².
    cell_area: f64,
    cells: Vec<Live>,
    event: u64,
}

impl<'a> Run<'a> {
    fn start(
        given: &'a Surface,
        plan: &'a MosaicPlan,
        seed: u64,
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<Self, NotGrown> {
        let size = plan.growth.map(|growth| growth.start);
        let at_start = size.map(|size| scaled(given, size)).transpose()?;
        let area = at_start.as_ref().unwrap_or(given).total_area();
        let cell_area = area / plan.initial_cells as f64;
        let radius = plan.radius_weight * cell_area.sqrt();
        let (mature, ancestry) = given.subdivided(LONGEST_EDGE * radius)?;
        let grown = size.map(|size| scaled(&mature, size)).transpose()?;
        let mut run = Self {
            controls: Controls(&plan.controls),
            adhesion: plan
                .types
                .iter()
                .map(|kind| kind.adhesion.clone())
                .collect(),
            plan,
            given,
            relaxation: Relaxation::new(grown.as_ref().unwrap_or(&mature), radius),
            regions: grown
                .as_ref()
                .map(|grown| Regions::new(grown, radius, seed)),
            mature,
            ancestry,
            grown,
            cell_area,
            cells: Vec::new(),
            event: 0,
        };
        run.throw_cells(seed)?;
        let uniform = vec![vec![0.0; plan.types.len()]; plan.types.len()];
        for _ in 0..plan.initial_relaxations {
            if is_stopped() {
                return Err(NotGrown::stopped("stopped"));
            }
            // Without adhesion its controls have no effect, but blocked areas stay blocked.
            run.relax(&uniform, plan.initial_step);
        }
        Ok(run)
    }

    fn surface(&self) -> &Surface {
        self.grown.as_ref().unwrap_or(&self.mature)
    }

    /// Places the initial cells.
    fn throw_cells(&mut self, seed: u64) -> Result<(), NotGrown> {
        let mut probabilities = Vec::new();
        for number in 0..self.plan.initial_cells {
            let id = bits(seed, Use::MosaicKind, number as u64);
            let throw = |attempt: u32| {
                let u =
                    [0, 1, 2].map(|k| uniform(id, Use::MosaicPlace, 3 * u64::from(attempt) + k));
                self.surface().sample(u)
            };
            let free =
                |point: &SurfacePoint| !self.controls.is_blocked(self.mature.position(point));
            let point = (0..THROWS).map(throw).find(free);
            let point = point.ok_or_else(|| {
                not_grown!("the blocked areas leave no room for cells: {THROWS} throws found none")
            })?;
            probabilities.clear();
            probabilities.extend(self.plan.types.iter().map(|kind| kind.initial_probability));
            self.controls
                .initial(self.mature.position(&point), &mut probabilities);
            let kind = chosen(
                probabilities.iter().copied(),
                uniform(id, Use::MosaicKind, u64::MAX),
            );
            let mut cell = Live {
                face: point.face,
                at: self.surface().flat(&point),
                kind,
                clone: number as u32,
                parent: NO_PARENT,
                id,
                divisions: 0,
                divides_at: NEVER,
            };
            cell.divides_at = self.next_division(&cell);
            self.cells.push(cell);
        }
        Ok(())
    }

    /// Place of a cell on the full-grown surface, mm.
    fn mature_place(&self, cell: &Live) -> DVec3 {
        self.mature
            .position(&self.surface().point(cell.face, cell.at))
    }

    /// The relaxation event at which a cell divides next, by the division time of its type.
    fn next_division(&self, cell: &Live) -> u64 {
        if self.grown.is_some() {
            // On a growing surface the room decides about divisions.
            return NEVER;
        }
        let rate = self.controls.rate(self.mature_place(cell), cell.kind);
        let days = self.plan.types[usize::from(cell.kind)].division_days / rate;
        days_to_division(cell.id, cell.divisions, days).map_or(NEVER, |days| {
            let events = (days * f64::from(self.plan.relaxations_per_day)).round();
            // A cell has to be there before it divides.
            self.event + (events as u64).max(1)
        })
    }

    /// Divides the cells that are due and relaxes.
    fn next_event(&mut self, most_cells: usize) -> Result<(), NotGrown> {
        self.event += 1;
        let per_day = u64::from(self.plan.relaxations_per_day);
        if self.grown.is_some() && (self.event - 1).is_multiple_of(per_day) {
            self.grow_surface()?;
        }
        let due: Vec<u32> = match &mut self.regions {
            None => {
                let due = (0..self.cells.len())
                    .filter(|&number| self.cells[number].divides_at <= self.event);
                due.map(|number| number as u32).collect()
            }
            Some(regions) => {
                let rate = |cell: &Live| {
                    let at = self.mature.position(
                        &self
                            .grown
                            .as_ref()
                            .unwrap_or(&self.mature)
                            .point(cell.face, cell.at),
                    );
                    self.controls.rate(at, cell.kind)
                        / self.plan.types[usize::from(cell.kind)].division_days
                };
                regions.due(&self.cells, self.event, &rate)
            }
        };
        for number in due {
            self.divide(number);
        }
        if self.cells.len() > most_cells {
            return Err(not_grown!(
                "on day {} there are more than {most_cells} cells; make the days fewer or the \
                 divisions rarer",
                self.event as f64 / per_day as f64
            ));
        }
        if self.plan.radius == RadiusRule::Daily && self.event.is_multiple_of(per_day) {
            let area = self.surface().total_area() / self.cells.len() as f64;
            let radius = self.plan.radius_weight * area.sqrt();
            if radius != self.relaxation.radius() {
                self.relaxation = Relaxation::new(self.surface(), radius);
            }
        }
        let adhesion = std::mem::take(&mut self.adhesion);
        self.relax(&adhesion, self.plan.step);
        self.adhesion = adhesion;
        Ok(())
    }

    fn relax(&mut self, adhesion: &[Vec<f64>], step: f64) {
        if step == 0.0 {
            return;
        }
        let bonds = Bonds {
            adhesion,
            controls: self.controls,
            step,
        };
        let surface = self.grown.as_ref().unwrap_or(&self.mature);
        self.relaxation
            .relax(surface, &self.mature, &mut self.cells, &bonds);
    }

    /// Adds a child beside a cell.
    fn divide(&mut self, number: u32) {
        let parent = self.cells[number as usize];
        let id = child_id(parent.id, parent.divisions);
        let switching = &self.plan.types[usize::from(parent.kind)].switching;
        let place = self.mature_place(&parent);
        let switching = self.controls.switching(place, parent.kind, switching);
        let mut child = Live {
            kind: kind_of_child(&switching, parent.id, parent.divisions),
            parent: number,
            id,
            divisions: 0,
            ..parent
        };
        let radius = self.relaxation.radius();
        for attempt in 0..CHILD_TRIES {
            let way = place_of_child(id, attempt) * radius;
            let (face, at) = free_walk(self.surface(), &self.mature, &parent, way, self.controls);
            (child.face, child.at) = (face, at);
            if (face, at) != (parent.face, parent.at) {
                break;
            }
        }
        child.divides_at = self.next_division(&child);
        self.cells.push(child);
        let mut parent = parent;
        parent.divisions += 1;
        parent.divides_at = self.next_division(&parent);
        self.cells[number as usize] = parent;
    }

    /// Size of the surface over its final size on a day.
    fn size(&self, day: f64) -> Option<DVec3> {
        let growth = self.plan.growth?;
        Some(growth.size(day, self.plan.days))
    }

    /// Grows the surface by one day; cells keep their places in the tissue.
    fn grow_surface(&mut self) -> Result<(), NotGrown> {
        let per_day = f64::from(self.plan.relaxations_per_day);
        let day = (self.event - 1) as f64 / per_day + 1.0;
        let (Some(size), Some(old)) = (self.size(day), &self.grown) else {
            return Ok(());
        };
        let new = scaled(&self.mature, size)?;
        for cell in &mut self.cells {
            cell.at = new.flat(&old.point(cell.face, cell.at));
        }
        if let Some(regions) = &mut self.regions {
            regions.grow(old, &new, self.cell_area, self.plan.relaxations_per_day);
        }
        self.relaxation = Relaxation::new(&new, self.relaxation.radius());
        self.grown = Some(new);
        Ok(())
    }

    /// The present state as a mosaic.
    fn mosaic(&self, day: f64) -> Result<Mosaic, NotGrown> {
        let size = self.size(day);
        let surface =
            size.map_or_else(|| Ok(self.given.clone()), |size| scaled(self.given, size))?;
        let cell = |cell: &Live| Cell {
            at: self
                .ancestry
                .carry_back(&self.surface().point(cell.face, cell.at)),
            kind: cell.kind,
            clone: cell.clone,
            parent: (cell.parent != NO_PARENT).then_some(cell.parent),
        };
        Ok(Mosaic {
            surface: Arc::new(surface),
            cells: self.cells.iter().map(cell).collect(),
            radius_mm: self.relaxation.radius(),
            day,
        })
    }
}

/// A surface at another size, from the origin.
fn scaled(surface: &Surface, size: DVec3) -> Result<Surface, NotGrown> {
    let positions = surface.positions().iter().map(|at| *at * size).collect();
    surface.moved(positions)
}
