//! The surface cut into blocks of faces that share one patch.
//!
//! If faces are small compared with the radius, the patches of neighbouring faces hold nearly the
//! same hundreds of faces. So neighbouring faces that lie nearly in a plane form a block, up to a
//! size that is a share of the radius, and the patch of its middle face serves the whole block. On
//! developable surfaces this is exact.

use glam::DVec2;
use rayon::prelude::*;

use crate::mosaic::patch::PatchFinder;
use crate::mosaic::surface::{Surface, Unfold};

/// Greatest distance of a block's faces from the middle of its base, as a share of the radius. With
/// larger blocks there are fewer of them, but each has more cells to search.
const HUB: f64 = 0.75;

/// The same where faces are many, to save memory. It was chosen when the other value was 0.4. The
/// two are not merged, because pushes are summed block by block in single precision, so another
/// value would change the places of cells for a given seed.
const HUB_OF_MANY: f64 = 0.8;

/// Number of faces in a square whose side is the radius from which on faces count as many.
const MANY: f64 = 50.0;

/// Cosine of the greatest angle between a block's faces and its base (20°).
const LEAST_COSINE: f64 = 0.94;

/// Faces whose cells search their neighbours together.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Its own faces, with the motion of each into the frame of the base.
    pub own: Vec<(u32, Unfold)>,
    /// All faces within the radius of the own ones, in the frame of the base.
    pub near: Vec<(u32, Unfold)>,
    /// Middle of the base in its frame, mm.
    pub centre: DVec2,
    /// Distance of the farthest point of the own faces from `centre`, mm.
    pub reach: f64,
}

/// Cuts a surface into blocks for repulsion within a radius. Every face is in one of them.
pub(super) fn blocks(surface: &Surface, radius: f64) -> Vec<Block> {
    let per_square = surface.faces().len() as f64 * radius * radius / surface.total_area();
    let hub = radius * if per_square > MANY { HUB_OF_MANY } else { HUB };
    let owned = own_faces(surface, hub);
    let block = |finder: &mut PatchFinder<'_>, own: &Vec<u32>| {
        let base = own[0];
        let centre = surface.flat(&surface.centre(base));
        // The hub bounds the faces added to a block, but a lone base may be larger.
        let corners = surface.corners(base);
        let base_reach = corners.iter().map(|corner| corner.distance(centre));
        let own_hub = base_reach.fold(if own.len() > 1 { hub } else { 0.0 }, f64::max);
        let patch = finder.patch_of_disc(base, own_hub, radius);
        let mut sorted = own.clone();
        sorted.sort_unstable();
        let mut mine = Vec::with_capacity(own.len());
        let mut reach: f64 = 0.0;
        for &(face, unfold) in patch.faces() {
            if sorted.binary_search(&face).is_ok() {
                mine.push((face, unfold));
                for corner in surface.corners(face) {
                    reach = reach.max(unfold.apply(corner).distance(centre));
                }
            }
        }
        Block {
            own: mine,
            near: patch.faces().to_vec(),
            centre,
            reach,
        }
    };
    owned
        .par_iter()
        .map_init(|| PatchFinder::new(surface), block)
        .collect()
}

/// The faces of each block, the base first.
fn own_faces(surface: &Surface, hub: f64) -> Vec<Vec<u32>> {
    let count = surface.faces().len();
    let normals: Vec<_> = (0..count as u32).map(|face| surface.normal(face)).collect();
    let mut taken = vec![false; count];
    let mut finder = PatchFinder::new(surface);
    let mut owned = Vec::new();
    for base in 0..count {
        if taken[base] {
            continue;
        }
        let centre = surface.flat(&surface.centre(base as u32));
        let patch = finder.patch_of_disc(base as u32, 0.0, hub);
        let mut own = Vec::new();
        for &(face, unfold) in patch.faces() {
            let corners = surface.corners(face).map(|corner| unfold.apply(corner));
            let within = corners.iter().all(|corner| corner.distance(centre) <= hub);
            let flat = normals[base].dot(normals[face as usize]) >= LEAST_COSINE;
            let joins = face as usize == base || (within && flat);
            if joins && !taken[face as usize] {
                taken[face as usize] = true;
                own.push(face);
            }
        }
        owned.push(own);
    }
    owned
}
