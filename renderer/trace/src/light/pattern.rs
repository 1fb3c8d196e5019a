//! How the radiance of an emitting surface varies over it.

use glam::{Vec2, Vec3};

use super::texels::{Beyond, Texels};
use crate::material::colour_map::ColourMap;

/// Factor on the radiance, as linear sRGB, by the surface's texture coordinates.
///
/// With `(u, v)` in [0, 1] and `r² = (2u − 1)² + (2v − 1)²`, the factor is `edge^(r²)`: 1 in the
/// middle of the square, `edge` in the middle of each of its edges, `edge²` in its corners. That is
/// the bell of one lamp behind the cloth of a soft box. Colours multiply it.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Logarithm of the edge's share of the middle, ≤ 0.
    ln_edge: f32,
    colours: Option<Colours>,
}

/// Colours over texture coordinates.
#[derive(Clone, Debug)]
pub enum Colours {
    /// A picture whose upper border is v = 1.
    Picture(Texels),
    /// What the materials of a model emit.
    Model(ColourMap),
}

impl Pattern {
    /// A pattern from the edge's share of the radiance in the middle, in (0, 1], and colours.
    pub fn new(edge: f64, colours: Option<Colours>) -> Self {
        Self {
            ln_edge: libm::log(edge) as f32,
            colours,
        }
    }

    /// What the materials of a model emit, if it is that.
    pub(crate) fn of_model(&self) -> Option<&ColourMap> {
        match self.colours.as_ref()? {
            Colours::Model(map) => Some(map),
            Colours::Picture(_) => None,
        }
    }

    /// The factor at texture coordinates.
    pub fn at(&self, uv: Vec2) -> [f32; 3] {
        let r = 2.0 * uv - Vec2::ONE;
        let bell = libm::expf(self.ln_edge * r.length_squared());
        let colour = match &self.colours {
            None => [1.0; 3],
            Some(Colours::Picture(picture)) => picture.at([uv.x, 1.0 - uv.y], Beyond::Same),
            Some(Colours::Model(map)) => map.colour(uv),
        };
        colour.map(|value| value * bell)
    }

    /// Numbers that red, green and blue of the factor exceed nowhere.
    pub fn at_most(&self) -> [f32; 3] {
        match &self.colours {
            None => [1.0; 3],
            Some(Colours::Picture(picture)) => picture.greatest(),
            Some(Colours::Model(map)) => map.greatest(),
        }
    }

    /// Mean of red, green and blue of the factor at texture coordinates, without their signs:
    /// colours outside of Rec. 709 have channels below 0.
    pub fn brightness(&self, uv: Vec2) -> f32 {
        let factors = self.at(uv).map(f32::abs);
        factors.iter().sum::<f32>() / 3.0
    }
}

/// The texture coordinates of the points of a plane.
#[derive(Clone, Copy, Debug)]
pub struct PlaneUv {
    point: Vec3,
    uv: Vec2,
    /// Gradients of u and v over space, m⁻¹.
    gradients: [Vec3; 2],
}

/// Greatest difference of texture coordinates that is taken for rounding.
const ROUNDING: f32 = 1e-4;

impl PlaneUv {
    /// Of the plane of a triangle with these texture coordinates; a triangle without area has
    /// those of its first corner everywhere.
    pub fn of([a, b, c]: [Vec3; 3], [at_a, at_b, at_c]: [Vec2; 3]) -> Self {
        let [p, q] = [b - a, c - a];
        let normal = p.cross(q);
        let area2 = normal.length_squared();
        let gradients = if area2 > 0.0 {
            let [along_p, along_q] = [q.cross(normal) / area2, normal.cross(p) / area2];
            let [by_p, by_q] = [at_b - at_a, at_c - at_a];
            [
                along_p * by_p.x + along_q * by_q.x,
                along_p * by_p.y + along_q * by_q.y,
            ]
        } else {
            [Vec3::ZERO; 2]
        };
        Self {
            point: a,
            uv: at_a,
            gradients,
        }
    }

    /// Texture coordinates of a point of the plane.
    pub fn at(&self, point: Vec3) -> Vec2 {
        let offset = point - self.point;
        self.uv + Vec2::from(self.gradients.map(|gradient| gradient.dot(offset)))
    }

    /// Whether another triangle of the plane continues these coordinates.
    pub fn continues(&self, corners: [Vec3; 3], uvs: [Vec2; 3]) -> bool {
        let mut corners = corners.into_iter().zip(uvs);
        corners.all(|(corner, uv)| (self.at(corner) - uv).abs().max_element() <= ROUNDING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bell_falls_from_the_middle_to_its_edges_and_corners() {
        let pattern = Pattern::new(0.5, None);
        for (uv, expected) in [
            ([0.5, 0.5], 1.0),
            ([0.0, 0.5], 0.5),
            ([0.5, 1.0], 0.5),
            ([1.0, 0.0], 0.25),
        ] {
            let factor = pattern.brightness(uv.into());
            assert!((factor - expected).abs() < 1e-6, "{uv:?}: {factor}");
        }
        assert_eq!(Pattern::new(1.0, None).at(Vec2::ZERO), [1.0; 3]);
    }

    #[test]
    fn a_picture_is_upright_on_the_square() {
        let red_over_blue = Texels::new(vec![[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], 1);
        let pattern = Pattern::new(1.0, Some(Colours::Picture(red_over_blue)));
        assert_eq!(pattern.at(Vec2::new(0.3, 0.9)), [1.0, 0.0, 0.0]);
        assert_eq!(pattern.at(Vec2::new(0.3, 0.1)), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_plane_has_the_texture_coordinates_of_its_triangles() {
        let corners = [
            Vec3::new(1.0, 0.0, 2.0),
            Vec3::new(3.0, 0.0, 2.5),
            Vec3::new(1.0, 4.0, 2.0),
        ];
        let uvs = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vec2::from);
        let plane = PlaneUv::of(corners, uvs);
        for (corner, uv) in corners.into_iter().zip(uvs) {
            assert!((plane.at(corner) - uv).length() < 1e-6);
        }
        let middle = (corners[1] + corners[2]) / 2.0;
        assert!((plane.at(middle) - Vec2::splat(0.5)).length() < 1e-6);
        let other = [corners[1], corners[1] + corners[2] - corners[0], corners[2]];
        let uvs = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
        assert!(plane.continues(other, uvs));
        let turned = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
        assert!(!plane.continues(other, turned));
    }
}
