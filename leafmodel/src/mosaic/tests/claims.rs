//! Statements of \[binsfeld2011\] about its figures, tested on mosaics grown with the parameters of
//! Table I on similar bodies.
//!
//! The table leaves out the initial shares and the switching; those used here were fitted to what
//! the pictures show: 12 % foreground at the start and 12 % of the background's children foreground
//! for the ageing of Fig. 5.

mod cap;
mod croton;
mod melon;

use super::statistics::{area_shares, labels_at};
use crate::mosaic::shapes::Shape;
use crate::mosaic::voronoi::Voronoi;
use crate::mosaic::{Mosaic, MosaicPlan, Surface, SurfacePoint};

/// Label of the background for the measures.
const BACKGROUND: u32 = 0;
/// Label of the foreground for the measures.
const FOREGROUND: u32 = 1;

/// A row of Table I, and the parameters that it leaves out.
struct Row {
    cells: usize,
    days: f64,
    radius_weight: f64,
    /// `α_FF`, `α_BB`.
    adhesion: [f64; 2],
    /// Days between divisions of foreground and background.
    division: [f64; 2],
    /// Share of the foreground at the start, where no control changes it.
    foreground: f64,
    /// Share of the background's children that are foreground.
    switching: f64,
}

impl Row {
    fn plan(&self) -> MosaicPlan {
        MosaicPlan {
            initial_cells: self.cells,
            days: self.days,
            radius_weight: self.radius_weight,
            types: MosaicPlan::two_types(
                self.division,
                self.adhesion,
                self.foreground,
                self.switching,
            ),
            ..MosaicPlan::default()
        }
    }
}

fn surface(shape: Shape) -> Surface {
    Surface::new(shape.positions, shape.faces).expect("shapes are surfaces")
}

/// A mosaic prepared for the measures.
struct Seen {
    voronoi: Voronoi,
    kinds: Vec<u32>,
    clones: Vec<u32>,
}

fn grown(surface: &Surface, plan: &MosaicPlan, seed: u64) -> Seen {
    Seen::of(&Mosaic::grow(surface, plan, seed).expect("a good plan"))
}

impl Seen {
    fn of(mosaic: &Mosaic) -> Self {
        let sites: Vec<SurfacePoint> = mosaic.cells.iter().map(|cell| cell.at).collect();
        let label = |kind| if kind == 0 { FOREGROUND } else { BACKGROUND };
        Self {
            voronoi: Voronoi::new(&mosaic.surface, &sites),
            kinds: mosaic.cells.iter().map(|cell| label(cell.kind)).collect(),
            clones: mosaic.cells.iter().map(|cell| cell.clone).collect(),
        }
    }

    /// Share of the foreground in the area.
    fn share(&self) -> f64 {
        area_shares(&self.voronoi, &self.kinds, 2)[FOREGROUND as usize]
    }

    fn at(&self, surface: &Surface, points: &[SurfacePoint]) -> Vec<u32> {
        labels_at(surface, &self.voronoi, &self.kinds, points)
    }
}
