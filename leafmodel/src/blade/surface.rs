//! The relief of a blade's two faces below the mesh: slopes of veins at every order, and of areoles
//! that bulge between them.
//!
//! Each face is a height over the flat lamina, mm, towards the adaxial side:
//!
//! - adaxial: bulge − `impressed` · 2r · mound, with a groove along each vein of radius r;
//! - abaxial: bulge − `raised` · 2r · mound, so that each vein stands out below.
//!
//! The mound across a vein is that of the mesh's relief, which carries part of it on the major
//! veins: what the mesh carries is subtracted here. The bulge is that of a sheet that swells and
//! that veins hold down (`bulge`).
//!
//! - **In**: a [`SurfacePlan`], the veins, the frame of the contents map.
//! - **Out**: a [`SurfaceMap`]: for each texel and face the mean slopes and the mean squares of
//!   slopes. The squares are averaged within texels, so that veins finer than a texel still make
//!   the surface rougher (LEAN moments, \[olano2010\]).
//! - **Always true**: a mean square is at least the square of the mean. The same input gives the
//!   same bits.
//! - **Left out**: shadows of the relief on itself.

mod bulge;
mod mounds;

use glam::DVec2;
use rayon::prelude::*;

use self::bulge::Bulge;
use self::mounds::Mounds;
use super::BladeForm;
use super::coverage::Coverage;
use super::frame::UvFrame;
use super::tissue::{Tissue, TissueError};
use crate::venation::network::VeinSegment;

/// How the faces of a blade differ from smooth sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePlan {
    /// Depth of the groove over a vein on the adaxial face, over the vein's diameter, −2 (raised)
    /// to 2.
    pub impressed: f64,
    /// Height of a vein on the abaxial face over its diameter, −2 to 2.
    pub raised: f64,
    /// Height to which the lamina bulges far from veins, towards the adaxial side, mm, 0 to 5.
    pub bulge_mm: f64,
    /// Distance from a vein within which the lamina rises to that height, mm, 0.05 to 100.
    pub bulge_width_mm: f64,
    /// GGX roughness that the coat has over a fully developed vein beside its own: the squares add
    /// up; 0 to 1.
    pub vein_roughness: f64,
    /// Mean width of the cells of the epidermis, µm; 0 for none, else 5 to 500.
    pub cells_um: f64,
    /// Length of these cells along the leaf over their width, 1 to 30.
    pub cell_elongation: f64,
    /// Share of the coat's roughness, as a square, that the cells' own bulges make, 0 to 1.
    pub cell_share: f64,
    /// Optical thickness of the wax bloom on the adaxial and the abaxial face, 0 to 10.
    pub bloom: [f64; 2],
}

impl SurfacePlan {
    /// A surface of which nothing is said: smooth.
    pub const SMOOTH: Self = Self {
        impressed: 0.0,
        raised: 0.0,
        bulge_mm: 0.0,
        bulge_width_mm: 1.0,
        vein_roughness: 0.0,
        cells_um: 0.0,
        cell_elongation: 1.0,
        cell_share: 0.2,
        bloom: [0.0; 2],
    };

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`TissueError`] for the first field out of range, by name.
    pub fn validate(&self) -> Result<(), TissueError> {
        let fields = [
            ("impressed", self.impressed, -2.0..=2.0, "from -2 to 2"),
            ("raised", self.raised, -2.0..=2.0, "from -2 to 2"),
            ("bulge_mm", self.bulge_mm, 0.0..=5.0, "from 0 to 5"),
            (
                "bulge_width_mm",
                self.bulge_width_mm,
                0.05..=100.0,
                "from 0.05 to 100",
            ),
            (
                "vein_roughness",
                self.vein_roughness,
                0.0..=1.0,
                "from 0 to 1",
            ),
            (
                "cells_um",
                self.cells_um,
                0.0..=500.0,
                "0, or from 5 to 500",
            ),
            (
                "cell_elongation",
                self.cell_elongation,
                1.0..=30.0,
                "from 1 to 30",
            ),
            ("cell_share", self.cell_share, 0.0..=1.0, "from 0 to 1"),
            ("adaxial_bloom", self.bloom[0], 0.0..=10.0, "from 0 to 10"),
            ("abaxial_bloom", self.bloom[1], 0.0..=10.0, "from 0 to 10"),
        ];
        for (field, value, range, text) in fields {
            TissueError::unless(range.contains(&value), field, value, text)?;
        }
        let valid = self.cells_um == 0.0 || self.cells_um >= 5.0;
        TissueError::unless(valid, "cells_um", self.cells_um, "0, or from 5 to 500")
    }
}

/// Moments of the slopes of one face over a texel: `[mean ∂z/∂x, mean ∂z/∂y, mean (∂z/∂x)², mean
/// (∂z/∂y)²]`, z towards the adaxial side.
pub type SlopeMoments = [f32; 4];

/// The slopes of both faces over a [`UvFrame`], as texels of a map with the layout of the contents
/// map.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceMap {
    /// Texels along `u`.
    pub width: u32,
    /// Texels along `v`.
    pub height: u32,
    /// Row by row from `v = 0`; adaxial and abaxial face.
    pub texels: Vec<[SlopeMoments; 2]>,
    /// Sides of the frame, mm.
    pub size_mm: [f32; 2],
}

/// What the relief of a blade is made from.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceOf<'a> {
    /// Where the map lies.
    pub frame: &'a UvFrame,
    /// The margin, mm; without one the whole frame is covered.
    pub margin: &'a [DVec2],
    /// The veins.
    pub veins: &'a [VeinSegment],
    /// The tissue, for the radius of a fully developed vein.
    pub tissue: &'a Tissue,
    /// The blade, whose mesh carries part of the relief.
    pub form: &'a BladeForm,
}

/// Places within a texel, per side, at which its slopes are taken.
const PLACES: usize = 3;

impl SurfaceMap {
    /// The slopes of a blade on a map of `[width, height]` texels.
    ///
    /// # Errors
    ///
    /// [`TissueError`] for a plan out of range.
    pub fn of(
        plan: &SurfacePlan,
        blade: &SurfaceOf<'_>,
        [width, height]: [u32; 2],
    ) -> Result<Self, TissueError> {
        plan.validate()?;
        let frame = blade.frame;
        let texel = frame.size / DVec2::new(f64::from(width), f64::from(height));
        let bulge = Bulge::of(plan, blade, texel.max_element());
        let mounds = Mounds::new(plan, blade, texel.max_element());
        let coverage = Coverage::new(blade.margin, frame, [width as usize, height as usize]);
        let mut texels = vec![[[0.0; 4]; 2]; width as usize * height as usize];
        let rows = texels.par_chunks_mut(width as usize).enumerate();
        rows.for_each(|(row, texels)| {
            let covered = coverage.row(row);
            for (column, out) in texels.iter_mut().enumerate().filter(|(c, _)| covered[*c]) {
                let corner = frame.min + texel * DVec2::new(column as f64, row as f64);
                *out = moments(&bulge, &mounds, corner, texel);
            }
        });
        Ok(Self {
            width,
            height,
            texels,
            size_mm: frame.size.as_vec2().to_array(),
        })
    }
}

/// The moments of both faces over the texel at `corner`.
fn moments(bulge: &Bulge, mounds: &Mounds, corner: DVec2, texel: DVec2) -> [SlopeMoments; 2] {
    let mut sums = [[0.0_f64; 4]; 2];
    let mut add = |slopes: [DVec2; 2], rough: f64, weight: f64| {
        for (sum, slope) in sums.iter_mut().zip(slopes) {
            let terms = [
                slope.x,
                slope.y,
                slope.x * slope.x + rough,
                slope.y * slope.y + rough,
            ];
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum += weight * term;
            }
        }
    };
    let veins = mounds.near(corner + 0.5 * texel);
    if veins.is_empty() {
        let slope = bulge.slope(corner + 0.5 * texel);
        add([slope; 2], 0.0, 1.0);
    } else {
        for number in 0..PLACES * PLACES {
            let place = DVec2::new((number % PLACES) as f64, (number / PLACES) as f64);
            let p = corner + texel * (place + 0.5) / PLACES as f64;
            let slope = bulge.slope(p);
            let vein = mounds.slopes(veins, p);
            let faces = vein.slopes.map(|own| own + slope);
            add(faces, vein.roughness, 1.0 / (PLACES * PLACES) as f64);
        }
    }
    // Rounding to single precision must not bring a mean square below the square of the mean.
    sums.map(|sum| {
        let [x, y, xx, yy] = sum.map(|value| value as f32);
        [x, y, xx.max(x * x), yy.max(y * y)]
    })
}

#[cfg(test)]
mod tests;
