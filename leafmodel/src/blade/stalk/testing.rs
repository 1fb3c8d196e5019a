//! What is wrong with a tube.

use thiserror::Error;

use super::StalkMesh;

/// What is wrong with a tube. Tubes from [`StalkMesh::tube`] have no defects.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub(crate) enum StalkDefect {
    /// An edge without exactly one triangle on each side of it.
    #[error("the edge from vertex {from} to vertex {to} is open, or used twice")]
    Open {
        /// Its first vertex.
        from: u32,
        /// Its second vertex.
        to: u32,
    },
    /// A triangle that faces inward, or away from a normal of its corners.
    #[error("triangle {triangle} is turned over")]
    TurnedOver {
        /// Which.
        triangle: usize,
    },
}

impl StalkMesh {
    /// Area of all triangles, mm².
    pub(crate) fn area(&self) -> f64 {
        let areas = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|v| self.positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        });
        areas.sum()
    }

    /// Checks what every tube must satisfy: each edge has one triangle on either side, and
    /// triangles face the same way as normals.
    ///
    /// # Errors
    ///
    /// The first [`StalkDefect`] found.
    pub(crate) fn validate(&self) -> Result<(), StalkDefect> {
        let edges = |reversed: bool| {
            let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * self.triangles.len());
            for &[a, b, c] in &self.triangles {
                let around = [[a, b], [b, c], [c, a]];
                edges.extend(
                    around.map(|[from, to]| if reversed { [to, from] } else { [from, to] }),
                );
            }
            edges.sort_unstable();
            edges
        };
        let (forward, backward) = (edges(false), edges(true));
        let twice = forward.windows(2).find(|pair| pair[0] == pair[1]);
        let open = forward.iter().zip(&backward).find(|(a, b)| a != b);
        if let Some([from, to]) = twice.map(|pair| pair[0]).or(open.map(|(a, b)| *a.min(b))) {
            return Err(StalkDefect::Open { from, to });
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|v| self.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            if !corners
                .iter()
                .all(|&v| normal.dot(self.normals[v as usize]) > 0.0)
            {
                return Err(StalkDefect::TurnedOver { triangle });
            }
        }
        Ok(())
    }
}
