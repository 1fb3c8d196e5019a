//! The two faces of a thin blade as one surface.

use super::Surface;
use super::adjacency::NONE;
use crate::not_grown::{NotGrown, not_grown};

impl Surface {
    /// A sheet doubled: its own faces, then as many turned over, the two joined along the margin.
    ///
    /// Face `f` of a sheet of `n` faces keeps its number; `n + f` lies behind it, with the second
    /// and third corner exchanged. Both sides are at the same place in space. But on the surface
    /// the distance between a point and the one behind it is the way around the margin, so the
    /// adaxial and the abaxial face of a leaf have separate cells.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn both_faces(sheet: &Self) -> Result<Self, NotGrown> {
        let count = sheet.faces.len() as u32;
        if count > 1 << 29 {
            return Err(not_grown!(
                "the mesh has {} faces or vertices, more than 2³⁰",
                2 * sheet.faces.len()
            ));
        }
        let mut faces = sheet.faces.clone();
        let mut neighbours = sheet.neighbours.clone();
        let mut edges = sheet.neighbour_edges.clone();
        for face in 0..count {
            let [a, b, c] = sheet.faces[face as usize];
            faces.push([a, c, b]);
            let mut across = [NONE; 3];
            let mut theirs = [0; 3];
            for edge in 0..3 {
                // Turned over, the edges come in reverse order.
                let behind = 2 - edge;
                if let Some(neighbour) = sheet.neighbour(face, edge) {
                    across[behind] = count + neighbour;
                    theirs[behind] = 2 - sheet.neighbour_edges[face as usize][edge];
                } else {
                    across[behind] = face;
                    theirs[behind] = edge as u8;
                    neighbours[face as usize][edge] = count + face;
                    edges[face as usize][edge] = behind as u8;
                }
            }
            neighbours.push(across);
            edges.push(theirs);
        }
        Self::assemble(sheet.positions.clone(), faces, neighbours, edges)
    }
}
