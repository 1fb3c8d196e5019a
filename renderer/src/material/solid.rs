//! Solid tissue: what decides its reflectance, and its coat.
//!
//! It reflects as a leaf that lets nothing through: `docs/src/theory/solid-tissue.md` has the model.

use std::sync::Arc;

use glam::Vec2;
use leafmodel::optics::solid::{ReflectanceTable, Solid};
use leafmodel::optics::{Contents, ProspectD};

use crate::bsdf::leaf::{Coat, LeafBsdf};
use crate::material::PathSpectra;
use crate::material::contents_texture::ContentsTexture;
use crate::spectrum::Lanes;

/// What solid tissue holds per area of its surface.
#[derive(Clone, Debug)]
pub enum SolidTissue {
    /// The same everywhere.
    Uniform(Contents),
    /// What a map gives.
    Map(ContentsTexture),
}

/// A material of solid tissue.
#[derive(Clone, Debug)]
pub struct SolidMaterial {
    tissue: SolidTissue,
    optics: Solid,
    table: Arc<ReflectanceTable>,
    /// A body is seen from outside; a sheet of it looks alike from both sides.
    coats: [Coat; 2],
}

/// Tables of reflectance, one for each refractive index: making one takes as long as tracing a hundred thousand paths.
#[derive(Debug, Default)]
pub struct ReflectanceTables(Vec<(f64, Arc<ReflectanceTable>)>);

impl ReflectanceTables {
    /// The table for a refractive index of 1 to 2, made when it is first asked for.
    pub fn of(&mut self, eta: f64) -> Arc<ReflectanceTable> {
        let known = self.0.iter().find(|(other, _)| *other == eta);
        if let Some((_, table)) = known {
            return Arc::clone(table);
        }
        let table = Arc::new(ReflectanceTable::new(eta, 0.0));
        self.0.push((eta, Arc::clone(&table)));
        table
    }
}

impl SolidMaterial {
    /// Tissue of these optics, in range, below a coat; `table` is that of the optics' refractive index, without a skin.
    pub fn new(
        tissue: SolidTissue,
        optics: Solid,
        table: Arc<ReflectanceTable>,
        coat: Coat,
    ) -> Self {
        Self {
            tissue,
            optics,
            table,
            coats: [coat.clone(), coat],
        }
    }

    /// What it holds.
    pub fn tissue(&self) -> &SolidTissue {
        &self.tissue
    }

    /// Reflectance at normal incidence of tissue that absorbs `absorption` in all, `Σ C K`.
    fn reflectance(&self, absorption: f64) -> f64 {
        self.table.at(self.optics.albedo_of(absorption))
    }

    /// A wavelength of the range, on a coarse grid, at which the coat at normal incidence reflects more than the tissue
    /// should; with a map its mean contents stand for all.
    pub fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<f64> {
        let coat = f64::from(self.coats[0].albedo().normal());
        let contents = match &self.tissue {
            SolidTissue::Uniform(contents) => *contents,
            SolidTissue::Map(map) => map.mean(),
        };
        let steps = 200;
        (0..=steps)
            .map(|i| range_nm[0] + (range_nm[1] - range_nm[0]) * f64::from(i) / f64::from(steps))
            .find(|&nm| {
                let at = ProspectD::coefficients_extrapolated(nm).absorption;
                self.reflectance(at.of_leaf(&contents)) < coat - 1e-4
            })
    }

    /// The BSDF at texture coordinates `uv`.
    pub fn bsdf<const N: usize>(&self, uv: Vec2, spectra: &mut PathSpectra<N>) -> LeafBsdf<'_, N> {
        let absorption = match &self.tissue {
            SolidTissue::Uniform(contents) => spectra.absorption(contents),
            SolidTissue::Map(map) => spectra.absorption(&map.at(uv)),
        };
        let reflectance = Lanes(absorption.map(|absorption| self.reflectance(absorption) as f32));
        LeafBsdf::new(&self.coats, reflectance, Lanes::ZERO, Lanes::ONE)
    }
}
