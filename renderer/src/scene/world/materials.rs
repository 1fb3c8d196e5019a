//! Conversion of materials from the description, with data that several of them share.

use std::sync::Arc;

use leafmodel::optics::solid::ReflectanceTable;

use super::error::WorldError;
use super::meshes::OwnSurface;
use crate::material::Material;
use crate::material::palette::{Palette, Palettes};
use crate::material::solid::ReflectanceTables;
use crate::scene::description::material::Sources;
use crate::scene::description::{Description, Named};
use crate::spectrum::WavelengthGrid;

/// Data that materials share, made on first use.
pub(super) struct Known {
    /// Palettes of pigments.
    pub(super) palettes: Palettes,
    reflectances: ReflectanceTables,
}

impl Known {
    /// Empty data for a picture with these wavelengths.
    pub(super) fn on(grid: &WavelengthGrid) -> Self {
        Self {
            palettes: Palettes::on(grid),
            reflectances: ReflectanceTables::default(),
        }
    }

    /// The shared data for each leaf and each body of solid tissue.
    pub(super) fn for_grown(
        &mut self,
        scene: &Description,
    ) -> (Vec<Palette>, Vec<(Palette, Arc<ReflectanceTable>)>) {
        let leaves = scene.leaves.iter();
        let leaves = leaves.map(|leaf| self.palettes.of(&leaf.value.plan.pigments));
        let leaves = leaves.collect();
        let solids = scene.solids.iter().map(|solid| {
            let palette = self.palettes.of(&solid.value.plan.pigments);
            (palette, self.reflectances.of(solid.value.optics.tissue.eta))
        });
        (leaves, solids.collect())
    }
}

/// Makes the scene's materials; `surfaces` are those that each of its meshes brings along.
pub(super) fn build_materials(
    scene: &Description,
    surfaces: &[OwnSurface],
    known: &mut Known,
    notes: &mut Vec<String>,
) -> Result<Vec<Material>, WorldError> {
    let built = scene.materials.iter().map(|Named { name, value }| {
        let surface = value.colours_of().map(|mesh| &surfaces[mesh]);
        let mut sources = Sources {
            name,
            palettes: &mut known.palettes,
            reflectances: &mut known.reflectances,
            colours: surface.and_then(|own| own.colours.as_ref()),
            finishes: surface.and_then(|own| own.finishes.as_ref()),
            notes,
        };
        value
            .built(&mut sources)
            .map_err(|source| WorldError::Asset {
                place: format!("materials.{name}"),
                source,
            })
    });
    built.collect()
}
