//! Cross-sections of petioles that are not round, and where petioles swell.

use glam::DVec3;

use super::super::mesh::vertex_normals;
use super::super::stalk::StalkMesh;
use crate::document::Declared;
use crate::numeric::smooth_step;
use crate::plane::polyline;

/// Cosines of the angles from the adaxial side at which a groove begins and is deepest.
const GROOVE: [f64; 2] = [0.55, 0.95];

/// The form of a petiole between its ends. All numbers are shares.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Section {
    /// Depth of the groove along its adaxial side, over the radius.
    #[key("groove", 0.0..=0.8)]
    pub groove: f64,
    /// How much narrower it is from side to side than if it were round, as an aspen's.
    ///
    /// How much narrower it is from side to side: an aspen's is a blade on edge. The cross-section
    /// keeps its area.
    #[key("flatness", 0.0..=0.7)]
    pub flatness: f64,
    /// Thickening of its foot, over the radius.
    #[key("foot", 0.0..=2.0)]
    pub foot: f64,
    /// Thickening below the blade (a pulvinus there), over the radius.
    #[key("head", 0.0..=2.0)]
    pub head: f64,
}

impl Default for Section {
    /// Round, with a foot a third thicker.
    fn default() -> Self {
        Self {
            groove: 0.0,
            flatness: 0.0,
            foot: 0.3,
            head: 0.0,
        }
    }
}

impl Section {
    /// Gives a round tube along `points` this section. `sections` tells of each point how much of
    /// it applies there, and the direction across the petiole.
    pub(super) fn shape(&self, tube: &mut StalkMesh, points: &[DVec3], sections: &[(f64, DVec3)]) {
        if self.groove == 0.0 && self.flatness == 0.0 {
            return;
        }
        let last = points.len() - 1;
        let whole = polyline::lengths(points);
        let length = whole[last];
        let mut nearest = 0;
        for (position, uv) in tube.positions.iter_mut().zip(&tube.uvs) {
            // Vertices come in the order of the points.
            while nearest < last
                && (whole[nearest + 1] - uv.y * length).abs()
                    <= (whole[nearest] - uv.y * length).abs()
            {
                nearest += 1;
            }
            let (share, aside) = sections[nearest];
            if share == 0.0 {
                continue;
            }
            let before = points[nearest.saturating_sub(1)];
            let tangent = (points[(nearest + 1).min(last)] - before).normalize();
            let across = (aside - tangent * tangent.dot(aside)).normalize();
            let up = across.cross(tangent);
            let offset = *position - points[nearest];
            let [along, x, z] = [tangent, across, up].map(|axis| axis.dot(offset));
            let radius = x.hypot(z);
            if radius == 0.0 {
                continue;
            }
            let [from, to] = GROOVE;
            let depth = self.groove * smooth_step((z / radius - from) / (to - from));
            let narrow = (1.0 - share * self.flatness).sqrt();
            let sunk = 1.0 - share * depth;
            *position = points[nearest]
                + tangent * along
                + across * (x * narrow * sunk)
                + up * (z / narrow * sunk);
        }
        tube.normals = vertex_normals(&tube.positions, &tube.triangles);
    }
}
