//! The material of solid tissue: its contents, which determine its reflectance, and its coat.
//!
//! It reflects like a leaf that transmits nothing; `docs/src/theory/solid-tissue.md` describes the
//! model.

use std::sync::Arc;

use glam::Vec2;
use optics::ProspectD;
use optics::solid::{ReflectanceTable, Solid};

use crate::bsdf::leaf::{Coat, LeafBsdf, LeafShape, Tissue};
use crate::material::held::Held;
use crate::material::palette::{Palette, coarse};
use crate::spectrum::{Lanes, Table, WavelengthGrid, Wavelengths};

/// A material of solid tissue.
#[derive(Clone, Debug)]
pub struct SolidMaterial {
    held: Held,
    palette: Palette,
    optics: Solid,
    table: Arc<ReflectanceTable>,
    /// Both coats are the same: a body is seen from outside only, and a sheet looks the same from
    /// both sides.
    coats: [Coat; 2],
    /// The tissue's optics, tabulated, if the body is uniform.
    uniform: Option<Table>,
}

/// Tables of reflectance, one for each refractive index: making one takes a tenth of a second.
#[derive(Debug, Default)]
pub struct ReflectanceTables(Vec<(f64, Arc<ReflectanceTable>)>);

impl ReflectanceTables {
    /// The table for a refractive index of 1 to 2, made on first use.
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
    /// Tissue with these optics, which must be in range, and the pigments of `palette`, below a
    /// coat. `table` is that of the optics' refractive index, without a skin.
    pub fn new(
        held: Held,
        palette: Palette,
        optics: Solid,
        table: Arc<ReflectanceTable>,
        coat: Coat,
    ) -> Self {
        Self {
            held,
            palette,
            optics,
            table,
            coats: [coat.clone(), coat],
            uniform: None,
        }
    }

    /// Its contents.
    pub fn held(&self) -> &Held {
        &self.held
    }

    /// The palette of its pigments.
    pub fn palette(&self) -> &Palette {
        &self.palette
    }

    /// Reflectance at normal incidence of tissue with the total absorption `absorption`, `Σ C K`.
    fn reflectance(&self, absorption: f64) -> f64 {
        self.table.at(self.optics.albedo_of(absorption))
    }

    /// A wavelength of the range, on a coarse grid, at which the coat at normal incidence reflects
    /// more than the tissue should. With a map its mean contents are used.
    pub(crate) fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<f64> {
        let coat = f64::from(self.coats[0].albedo().normal());
        let mean = self.held.mean();
        coarse(range_nm).find(|&nm| {
            let at = ProspectD::coefficients_of(self.palette.pigments(), nm);
            self.reflectance(at.absorption_of_leaf(&mean)) < coat - 1e-4
        })
    }

    /// Evaluates everything that depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        let table = || Tissue::table(grid, |wavelengths| self.tissue_at(Vec2::ZERO, wavelengths));
        self.uniform = self.held.is_uniform().then(table);
    }

    /// The BSDF at texture coordinates `uv`.
    pub fn bsdf<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> LeafBsdf<'_, N> {
        let row = self
            .uniform
            .as_ref()
            .and_then(|table| table.row(wavelengths));
        let tissue = row.map_or_else(|| self.tissue_at(uv, wavelengths), Tissue::from_lanes);
        LeafBsdf::new(&self.coats, &LeafShape::EVEN, tissue)
    }

    fn tissue_at<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Tissue<N> {
        let contents = self.held.at(uv);
        let absorption = self.palette.lanes(wavelengths).absorption(&contents);
        let reflectance = absorption.map(|absorbed| self.reflectance(f64::from(absorbed)) as f32);
        Tissue::new(
            &self.coats,
            &LeafShape::EVEN,
            Lanes(reflectance),
            Lanes::ZERO,
            Lanes::ONE,
        )
    }
}
