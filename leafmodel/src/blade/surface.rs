//! The relief of a blade's two faces below the mesh: slopes of veins at every order, and of areoles
//! that bulge between them.
//!
//! Each face is a height over the flat lamina, mm, towards the adaxial side:
//!
//! - adaxial: bulge − `impressed` · 2r · mound, with a groove along each vein of radius r;
//! - abaxial: bulge − `raised` · 2r · mound, so that each vein stands out below.
//!
//! The mound across a vein is that of the mesh's relief. The bulge is that of a sheet that swells and
//! that veins hold down (`bulge`). The mesh's vertices are displaced by as much of both as its edges
//! can carry; the slopes that its normals have by that are subtracted here (`carried`), so that mesh
//! and map together always have the slopes of the two heights.
//!
//! - **In**: a [`SurfacePlan`], the veins, the mesh, the frame of the contents map.
//! - **Out**: a [`SurfaceMap`]: for each texel and face the mean slopes and the mean squares of
//!   slopes. The squares are averaged within texels, so that veins finer than a texel still make
//!   the surface rougher (LEAN moments, \[olano2010\]). Where there are stomata or dust, also how
//!   far it is to the next vein, and how thick the dust lies.
//! - **Always true**: a mean square is at least the square of the mean. The same input gives the
//!   same bits.
//! - **Left out**: shadows of the relief on itself.

mod bulge;
mod carried;
pub mod dust;
mod mounds;
mod plan;
pub mod stomata;

use glam::DVec2;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub(crate) use self::bulge::{Bulge, HeldSheet};
use self::carried::{Carried, PLACES};
use self::dust::{Gathering, optical_thicknesses};
use self::mounds::Mounds;
pub use self::mounds::SurfaceOf;
pub use self::plan::SurfacePlan;
use super::coverage::Coverage;
use crate::document::RangeError;
use crate::memory;
use crate::plane::distances::Distances;

/// Moments of the slopes of one face over a texel: `[mean ∂z/∂x, mean ∂z/∂y, mean (∂z/∂x)², mean
/// (∂z/∂y)²]`, z towards the adaxial side.
pub type SlopeMoments = [f32; 4];

/// What lies on or in a face besides its slopes: optical thickness of the dust on the adaxial and on
/// the abaxial face, and the distance to the axis of the nearest vein, mm.
pub type Cover = [f32; 3];

/// The distance to veins where there are none, mm.
const NO_VEIN_MM: f32 = 1e3;

/// The slopes of both faces over a `UvFrame`, as texels of a map with the layout of the contents
/// map.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SurfaceMap {
    /// Texels along `u`.
    pub width: u32,
    /// Texels along `v`.
    pub height: u32,
    /// Row by row from `v = 0`; adaxial and abaxial face.
    #[serde(with = "super::planes")]
    pub texels: Vec<[SlopeMoments; 2]>,
    /// As many texels of dust and stomata; empty if there are neither.
    #[serde(with = "super::planes")]
    pub cover: Vec<Cover>,
    /// Sides of the frame, mm.
    pub size_mm: [f32; 2],
}

impl SurfaceMap {
    /// The slopes of a blade on a map of `[width, height]` texels.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for a plan out of range.
    pub fn of(
        plan: &SurfacePlan,
        blade: &SurfaceOf<'_>,
        [width, height]: [u32; 2],
    ) -> Result<Self, RangeError> {
        plan.validate()?;
        let frame = blade.frame;
        let size = [width as usize, height as usize];
        let texel = frame.size / DVec2::new(f64::from(width), f64::from(height));
        let sheet = HeldSheet {
            frame,
            veins: blade.veins,
            full_vein_radius_mm: blade.tissue.full_vein_radius_mm,
        };
        let bulge = Bulge::of(plan, &sheet, texel.max_element());
        let mounds = Mounds::new(plan, blade, texel.max_element());
        // Faces whose veins have no heights of their own keep those of the mesh.
        let with_veins = [plan.impressed, plan.raised] != [0.0; 2];
        let carried = blade
            .mesh
            .and_then(|mesh| Carried::new(mesh, with_veins, frame, size));
        let withering = blade.withering.filter(|_| plan.dead_roughness > 0.0);
        let coverage = Coverage::new(blade.margin, frame, size);
        let mut texels = memory::untouched(vec![[[0.0; 4]; 2]; size[0] * size[1]]);
        let rows = texels.par_chunks_mut(size[0]).enumerate();
        rows.for_each(|(row, texels)| {
            let covered = coverage.row(row);
            let carried = carried.as_ref().map(|carried| carried.row(row));
            let mut near = Vec::new();
            for (column, out) in texels.iter_mut().enumerate().filter(|(c, _)| covered[*c]) {
                let corner = frame.min + texel * DVec2::new(column as f64, row as f64);
                let carried = |place: [usize; 2]| {
                    carried.as_ref().map_or(DVec2::ZERO, |slopes| {
                        slopes[(place[1] * size[0] + column) * PLACES + place[0]]
                    })
                };
                let dead = withering.map_or(0.0, |aged| aged.dead_share(corner + 0.5 * texel));
                // As the renderer has it, a variance σ² of slopes adds 3 σ² to the square of a
                // roughness.
                let rough = dead * plan.dead_roughness * plan.dead_roughness / 3.0;
                *out = moments(
                    &bulge,
                    (&mounds, &mut near),
                    (corner, texel),
                    rough,
                    carried,
                );
            }
        });
        Ok(Self {
            width,
            height,
            texels,
            cover: cover(plan, blade, size, &coverage),
            size_mm: frame.size.as_vec2().to_array(),
        })
    }
}

/// Dust and the distance to veins for each texel; nothing if neither is needed.
fn cover(
    plan: &SurfacePlan,
    blade: &SurfaceOf<'_>,
    [width, height]: [usize; 2],
    coverage: &Coverage,
) -> Vec<Cover> {
    let (has_dust, has_stomata) = (plan.dust.is_there(), plan.stomata.are_there());
    if !has_dust && !has_stomata {
        return Vec::new();
    }
    let frame = blade.frame;
    let texel = frame.size / DVec2::new(width as f64, height as f64);
    let lines = blade.veins.iter().map(|vein| [vein.from, vein.to]);
    let veins = (has_stomata && !blade.veins.is_empty()).then(|| Distances::new(lines.collect()));
    let middle = |[column, row]: [usize; 2]| {
        frame.min + texel * (DVec2::new(column as f64, row as f64) + 0.5)
    };
    let away = veins.map(|veins| veins.of_grid([width, height], middle, |row| coverage.row(row)));
    let mut taus = Vec::new();
    if has_dust {
        let gathering = Gathering::new(plan.dust, blade.veins, blade.margin, blade.seed);
        let mut loads = memory::filled(f64::NAN, width * height);
        let rows = loads.par_chunks_mut(width).enumerate();
        rows.for_each(|(row, loads)| {
            let covered = coverage.row(row);
            for column in (0..width).filter(|column| covered[*column]) {
                loads[column] = gathering.at(middle([column, row]));
            }
        });
        taus = optical_thicknesses(&plan.dust, &loads);
    }
    let mut cover = memory::room_for(width * height);
    cover.extend((0..width * height).map(|i| {
        let [above, below] = taus.get(i).copied().unwrap_or_default();
        let away_mm = match &away {
            Some(away) if away[i].is_finite() => away[i] as f32,
            Some(_) | None => NO_VEIN_MM,
        };
        [above, below, away_mm]
    }));
    cover
}

/// The moments of both faces over the texel at a corner and of a size, mm, whose coats are `rough`
/// by age; `carried` are the slopes of the mesh at each place in it. `near` is room for a list.
fn moments(
    bulge: &Bulge,
    (mounds, near): (&Mounds, &mut Vec<u32>),
    (corner, texel): (DVec2, DVec2),
    rough: f64,
    carried: impl Fn([usize; 2]) -> DVec2,
) -> [SlopeMoments; 2] {
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
    let centre = corner + 0.5 * texel;
    mounds.reaching(centre, 0.5 * texel.length(), near);
    // The slopes of bulge and mesh hardly change within a texel.
    if near.is_empty() {
        let slope = bulge.slope(centre) - carried([PLACES / 2; 2]);
        add([slope; 2], rough, 1.0);
    } else {
        for number in 0..PLACES * PLACES {
            let place = [number % PLACES, number / PLACES];
            let share = DVec2::new(place[0] as f64, place[1] as f64);
            let p = corner + texel * (share + 0.5) / PLACES as f64;
            let slope = bulge.slope(p) - carried(place);
            let vein = mounds.slopes(near, p);
            let faces = vein.slopes.map(|own| own + slope);
            let rough = rough + vein.roughness;
            add(faces, rough, 1.0 / (PLACES * PLACES) as f64);
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
