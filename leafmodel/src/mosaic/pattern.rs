//! A mosaic as tissue: the contents of cells of each type.

use std::sync::Arc;

use glam::DVec2;

use super::control::Controls;
use super::paint::TypeField;
use super::paint::sheet::SheetField;
use super::shapes::sheet;
use super::types::types;
use super::{CylinderControl, Mosaic, MosaicPlan, Surface};
use crate::document::{Declared, Keys, NamedList, Words};
use crate::grow_options::GrowOptions;
use crate::not_grown::{NotGrown, not_grown};
use crate::optics::Contents;
use crate::shape::outline::Outline;

/// Edge of a mosaic's triangles over the distance between cells at the start.
const EDGE_OVER_SPACING: f64 = 1.0;

/// A mosaic whose cells hold pigments.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct MosaicPattern {
    /// How cells grow.
    #[key(flat)]
    pub plan: MosaicPlan,
    /// What cells of each type hold.
    pub contents: Vec<Contents>,
    /// Width over which unlike cells blend.
    #[key("blend_mm", 0.0..=100.0)]
    pub blend_mm: f64,
    /// Whether the pattern goes through the blade, or each face has cells of its own, joined at the
    /// margin; the leaf then holds the mean of the two.
    #[key("faces", word)]
    pub faces: LeafFaces,
}

impl Default for MosaicPattern {
    fn default() -> Self {
        Self {
            plan: MosaicPlan {
                types: Vec::new(),
                ..MosaicPlan::default()
            },
            contents: Vec::new(),
            blend_mm: 0.2,
            faces: LeafFaces::Through,
        }
    }
}

fn controls(controls: &mut Vec<CylinderControl>, keys: &mut Keys<'_>, types: &[String]) {
    let mut named: Vec<(String, CylinderControl)> = std::mem::take(controls)
        .into_iter()
        .zip(1..)
        .map(|(control, number)| (format!("control-{number}"), control))
        .collect();
    let list = NamedList {
        required: false,
        new: &|name: &str| (name.to_owned(), CylinderControl::default()),
        name_of: |(name, _): &(String, CylinderControl)| name,
    };
    let about = "Images round cylinders that steer cells.";
    keys.named("controls", &mut named, &list, about, |(_, one), keys| {
        one.keys(keys, types);
    });
    *controls = named.into_iter().map(|(_, control)| control).collect();
}

/// The faces of a leaf on which cells live.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Words)]
pub enum LeafFaces {
    /// One layer of cells: the pattern goes through the blade.
    #[default]
    Through,
    /// Both faces, joined at the margin; at each point the leaf's contents are the mean of those of
    /// its two faces.
    Both,
}

/// Most triangles that are visited to find the cells near each: some 20 ns each.
const MOST_VISITS: f64 = 3e9;

/// How many triangles are visited to find those within two mean distances between cells of each.
fn visits(faces: usize, cells: usize) -> f64 {
    let faces = faces as f64;
    faces * (4.0 * std::f64::consts::PI * faces / cells.max(1) as f64).min(faces)
}

/// Refuses a surface of too many triangles for so few cells.
fn check_fineness(faces: usize, cells: usize) -> Result<(), NotGrown> {
    if visits(faces, cells) > MOST_VISITS {
        return Err(not_grown!(
            "the surface has {faces} triangles for {cells} cells, so that each triangle would be \
             compared with {} others, {:.0e} times in all, more than {MOST_VISITS:.0e}: make the \
             body less slender, or its mesh coarser",
            (visits(faces, cells) / faces as f64).round(),
            visits(faces, cells)
        ));
    }
    Ok(())
}

impl MosaicPattern {
    /// The keys of `mosaic`. `base` is what cells hold where they say nothing else.
    pub(crate) fn keys(&mut self, keys: &mut Keys<'_>, base: Contents) {
        self.declare(keys);
        let names = types((&mut self.plan.types, &mut self.contents), keys, base);
        controls(&mut self.plan.controls, keys, &names);
        let about = "`start = [x, y, z]`, 0.01 to 10: size at the start over the final size; \
            `middle` (0 to 1) and `steepness` (1 to 100) make it logistic. Cells then divide as \
            fast as the surface makes room.";
        let growth = &mut self.plan.growth;
        keys.optional_block("growth", growth, Default::default, about, Declared::declare);
    }

    /// Checks plan, contents and blend.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first that is wrong.
    pub fn validate(&self) -> Result<(), NotGrown> {
        self.in_range()?;
        self.plan.validate()?;
        let (types, contents) = (self.plan.types.len(), self.contents.len());
        if contents != types {
            return Err(not_grown!(
                "there are {types} cell types and contents for {contents}"
            ));
        }
        Ok(())
    }

    /// Whether a control may block places, where the tissue itself shows.
    pub(crate) fn may_leave_bare(&self) -> bool {
        Controls(&self.plan.controls).block()
    }

    /// Suitable edge length, mm, of the triangles on which the mosaic is to grow, for a surface of
    /// `area` mm².
    pub fn edge_mm(&self, area: f64) -> f64 {
        EDGE_OVER_SPACING * (area / self.plan.initial_cells as f64).sqrt()
    }

    /// Grows the mosaic on a surface.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], also where growth is stopped.
    pub fn grow(
        &self,
        surface: &Surface,
        seed: u64,
        options: GrowOptions<'_>,
    ) -> Result<(Mosaic, TypeField), NotGrown> {
        self.validate()?;
        let days = [self.plan.days];
        let faces = surface.faces().len();
        check_fineness(faces, self.plan.most_cells())?;
        let mut mosaic = options.mosaics(surface, &self.plan, seed, &days)?.remove(0);
        if self.plan.growth.is_some_and(|growth| growth.days.is_some()) {
            // What is painted has its final size.
            mosaic.surface = Arc::new(surface.clone());
        }
        check_fineness(faces, mosaic.cells.len())?;
        let field = self.field(&mosaic, self.blend_mm)?;
        Ok((mosaic, field))
    }

    /// The types of a mosaic of this plan at every point, blended over another width, mm.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn field(&self, mosaic: &Mosaic, blend_mm: f64) -> Result<TypeField, NotGrown> {
        let field = TypeField::of_mosaic(mosaic, self.plan.types.len(), blend_mm)?;
        Ok(field.heeding(Arc::clone(&mosaic.surface), &self.plan.controls))
    }

    /// Grows the mosaic on a leaf's lamina.
    ///
    /// # Errors
    ///
    /// As [`MosaicPattern::grow`].
    pub fn on_lamina(
        &self,
        outline: &Outline,
        seed: u64,
        options: GrowOptions<'_>,
    ) -> Result<LaminaPattern, NotGrown> {
        self.validate()?;
        let both = self.faces == LeafFaces::Both;
        let area = outline.area() * if both { 2.0 } else { 1.0 };
        let shape = sheet(outline, self.edge_mm(area)).map_err(NotGrown::because)?;
        let one = Surface::new(shape.positions, shape.faces)?;
        let surface = if both {
            Surface::both_faces(&one)?
        } else {
            one
        };
        let (mosaic, field) = self.grow(&surface, seed, options)?;
        Ok(LaminaPattern {
            sheet: SheetField::new(&mosaic.surface, field, both),
            contents: self.contents.clone(),
        })
    }
}

/// A mosaic on a lamina, prepared for queries of its contents.
#[derive(Clone, Debug)]
pub struct LaminaPattern {
    sheet: SheetField,
    contents: Vec<Contents>,
}

impl LaminaPattern {
    /// Contents of the tissue at a point of the lamina (mm); beyond the margin those at its nearest
    /// point; `None` where controls block cells. `weights` is a buffer.
    pub fn contents(&self, point: DVec2, weights: &mut Vec<f64>) -> Option<Contents> {
        let field = self.sheet.field();
        if field.has_bare_places() && field.is_bare(&self.sheet.locate(point)) {
            return None;
        }
        weights.resize(self.contents.len(), 0.0);
        Some(self.sheet.at(point, &self.contents, weights))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::Constituent;
    use crate::species;

    #[test]
    fn the_two_faces_of_a_leaf_have_patterns_of_their_own_and_it_holds_their_mean() {
        let croton = species::find("croton").expect("a preset").plan();
        let outline = croton.outline.grow(60.0, 1).expect("a good outline");
        let tissue = |chlorophyll| {
            let contents = Contents::new(1.5, chlorophyll, 8.0, 0.0, 0.0, 0.01, 0.005);
            contents.expect("in range")
        };
        let pattern = MosaicPattern {
            plan: MosaicPlan {
                initial_cells: 800,
                days: 20.0,
                types: MosaicPlan::two_types([8.0, 10.0], [0.5, 0.8], 0.25, 0.0),
                ..MosaicPlan::default()
            },
            contents: vec![tissue(0.0), tissue(50.0)],
            blend_mm: 0.0,
            faces: LeafFaces::Both,
        };
        let grown = pattern.on_lamina(&outline, 3, GrowOptions::default());
        let lamina = grown.expect("a good plan");
        let mut weights = Vec::new();
        let mut seen = [0.0_f64; 3];
        for row in 0..60 {
            for column in 0..30 {
                let at = DVec2::new(0.3 * f64::from(column) - 4.5, 15.0 + 0.5 * f64::from(row));
                let contents = lamina
                    .contents(at, &mut weights)
                    .expect("nothing is blocked");
                // Foreground on both faces, on one, on none.
                let class = contents[Constituent::Chlorophyll] / 25.0;
                assert!((class - class.round()).abs() < 1e-9, "{class}");
                seen[class.round() as usize] += 1.0 / 1800.0;
            }
        }
        // If the faces were independent, the foreground would be on exactly one of them for 2 p (1
        // − p) of the leaf.
        let share = seen[0] + 0.5 * seen[1];
        assert!(share > 0.2 && share < 0.6, "{share}");
        let by_chance = 2.0 * share * (1.0 - share);
        assert!((seen[1] / by_chance - 1.0).abs() < 0.15, "{seen:?}");
    }
}
