//! What an instrument measures with, and what all of them do alike.

use super::batches::{Effort, Estimate, Experiment, estimates};
use super::error::{InstrumentError, Problem};
use super::flux::LANES;
use super::row::{Direction, Row};
use super::spectral::{self, Series};
use crate::scene::description::{Description, Instrument, Named};
use crate::spectrum::Wavelengths;
use trace::world::World;

/// An instrument of a scene that is read out.
#[derive(Clone, Copy)]
pub(super) struct Measurement<'a> {
    pub(super) world: &'a World,
    pub(super) scene: &'a Description,
    pub(super) instrument: &'a Named<Instrument>,
    /// The first set of its wavelengths among those of the world.
    pub(super) first_set: usize,
    pub(super) effort: &'a Effort<'a>,
}

impl Measurement<'_> {
    /// What is wrong with the instrument.
    pub(super) fn refuse(&self, problem: Problem) -> InstrumentError {
        problem.at(&self.instrument.value.at)
    }

    /// What is wrong with an object for the instrument.
    pub(super) fn inside(&self, object: usize, problem: &'static str) -> InstrumentError {
        let object = self.object(object);
        self.refuse(Problem::Inside { object, problem })
    }

    /// The name of the object with a number.
    pub(super) fn object(&self, number: usize) -> String {
        self.scene.objects[number].name.clone()
    }

    /// Number of wavelengths.
    fn count(&self) -> usize {
        self.instrument.value.measured_nm().len()
    }

    /// Number of sets of wavelengths.
    pub(super) fn sets(&self) -> usize {
        self.count().div_ceil(LANES)
    }

    /// An experiment for each light and set of wavelengths, the sets of a light together.
    pub(super) fn lit<L: Copy, E>(
        &self,
        lights: impl Iterator<Item = L>,
        experiment: impl Fn(L, Wavelengths<LANES>) -> E,
    ) -> Vec<E> {
        let grid = self.world.wavelengths.grid();
        let sets = self.first_set..self.first_set + self.sets();
        let all = lights.flat_map(|light| sets.clone().map(move |set| (light, grid.set(set))));
        all.map(|(light, set)| experiment(light, set)).collect()
    }

    /// What experiments find. Fails if no light meets the object that is to be lit.
    pub(super) fn estimates(
        &self,
        experiments: &[impl Experiment],
        object: usize,
    ) -> Result<Vec<Vec<Estimate>>, InstrumentError> {
        let found = estimates(experiments, self.effort);
        if found.iter().any(|figures| figures[0].value.is_nan()) {
            let object = self.object(object);
            return Err(self.refuse(Problem::NothingLit { object }));
        }
        Ok(found)
    }

    /// A row without a value.
    pub(super) fn row(&self, quantity: &'static str, light: Direction) -> Row {
        Row::new(&self.instrument.name, quantity, light)
    }

    /// The figure with this number at each wavelength, of experiments by sets of wavelengths whose
    /// sums are in the order of quantities, lanes within each.
    pub(super) fn by_wavelength(&self, sets: &[Vec<Estimate>], number: usize) -> Vec<Estimate> {
        let figure = |i: usize| sets[i / LANES][number * LANES + i % LANES];
        (0..self.count()).map(figure).collect()
    }

    /// All rows of one light's figures.
    pub(super) fn rows(&self, series: &[Series]) -> Vec<Row> {
        spectral::rows(&self.instrument.value, series)
    }
}
