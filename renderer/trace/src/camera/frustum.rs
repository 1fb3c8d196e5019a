//! The part of space that a picture shows, and what of a box lies in it.

use glam::{DMat3, DVec2, DVec3};

use super::thin_lens::lens_axes;
use super::view::{Projection, View};

/// The faces of a box, whose corners are numbered by their sides: 1 along the first edge, 2 along
/// the second, 4 along the third.
const FACES: [[usize; 4]; 6] = [
    [0, 1, 3, 2],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 3, 7, 6],
    [0, 2, 6, 4],
    [1, 3, 7, 5],
];

/// The part of space that a picture shows. It is a little larger where a lens blurs.
#[derive(Clone, Debug)]
pub struct Frustum {
    position: DVec3,
    /// To the right, up, and into the scene.
    axes: DMat3,
    is_parallel: bool,
    /// Normals to the inside, in the frame of the picture, and distances: what is inside has
    /// `normal · point + distance ≥ 0`.
    planes: [(DVec3, f64); 5],
    /// Half the picture's width and height: at distance 1, or for parallel rays everywhere.
    half_extent: DVec2,
}

/// What of a box is in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glimpse {
    /// The point of it that is nearest along the axis of the camera, m, in the scene.
    pub nearest: DVec3,
    /// Least and greatest distance from the camera along its axis, m.
    pub depths: [f64; 2],
    /// Least and greatest place in the picture, where its middle is (0, 0) and its edges are at 1.
    pub places: [DVec2; 2],
}

impl Frustum {
    /// That of a picture of `size` pixels, whose filter reaches `radius` pixels beyond each.
    pub fn new(view: &View, size: [u32; 2], radius: f64) -> Self {
        let [width, height] = size.map(f64::from);
        let half_height = view.half_height();
        let half_extent = DVec2::new(half_height * width / height, half_height);
        // Rounded outwards.
        let beyond = DVec2::new(1.0 + 2.0 * radius / width, 1.0 + 2.0 * radius / height);
        let seen = half_extent * beyond * (1.0 + 1e-6);
        let (slope, aside, behind) = match &view.projection {
            Projection::Orthographic { .. } => (DVec2::ZERO, seen, 0.0),
            Projection::Perspective(lens) => {
                // A ray from the edge of the lens starts so far from the axis and leans so much more.
                let normal = lens_axes(lens.tilt).z_axis;
                let bending = |[x, y]: [f64; 2]| {
                    let direction = DVec3::new(x * seen.x, y * seen.y, 1.0);
                    if lens.tilt == [0.0; 2] {
                        1.0 / lens.focus_distance
                    } else {
                        direction.dot(normal) / lens.focal_length() - 1.0 / lens.image_distance
                    }
                };
                let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
                let most = corners.map(|corner| bending(corner).abs());
                // That of a polygon of the same area, of any number of corners.
                let reach = 1.3 * lens.radius;
                let leaning = reach * most.into_iter().fold(0.0, f64::max);
                (seen + leaning, DVec2::splat(reach), reach)
            }
        };
        let side = |normal: DVec3, slope: f64, aside: f64| (normal + DVec3::Z * slope, aside);
        Self {
            position: view.position,
            axes: view.axes(),
            is_parallel: matches!(view.projection, Projection::Orthographic { .. }),
            planes: [
                side(DVec3::X, slope.x, aside.x),
                side(DVec3::NEG_X, slope.x, aside.x),
                side(DVec3::Y, slope.y, aside.y),
                side(DVec3::NEG_Y, slope.y, aside.y),
                (DVec3::Z, behind),
            ],
            half_extent,
        }
    }

    /// What is seen of a box with these corners, which need not be at right angles; `None` if nothing
    /// is.
    pub fn glimpse(&self, corners: [DVec3; 8]) -> Option<Glimpse> {
        let to_picture = self.axes.transpose();
        let corners = corners.map(|corner| to_picture * (corner - self.position));
        let inside = |point: DVec3, (normal, distance): (DVec3, f64)| normal.dot(point) + distance;
        let mut is_whole = true;
        for plane in self.planes {
            let within = corners.map(|corner| inside(corner, plane) >= 0.0);
            if within == [false; 8] {
                return None;
            }
            is_whole &= within == [true; 8];
        }
        let mut seen = Vec::new();
        if is_whole {
            seen.extend(corners);
        } else {
            let (mut part, mut cut) = (Vec::new(), Vec::new());
            for face in FACES {
                part.clear();
                part.extend(face.map(|corner| corners[corner]));
                for plane in self.planes {
                    cut.clear();
                    for (number, &from) in part.iter().enumerate() {
                        let to = part[(number + 1) % part.len()];
                        let [a, b] = [from, to].map(|point| inside(point, plane));
                        if a >= 0.0 {
                            cut.push(from);
                        }
                        if (a < 0.0) != (b < 0.0) {
                            cut.push(from + (to - from) * (a / (a - b)));
                        }
                    }
                    std::mem::swap(&mut part, &mut cut);
                }
                seen.append(&mut part);
            }
            // The camera may be within the box.
            let edges = [1, 2, 4].map(|corner| corners[corner] - corners[0]);
            let place = DMat3::from_cols_array_2d(&edges.map(|edge| edge.to_array())).inverse()
                * -corners[0];
            if place.cmpge(DVec3::ZERO).all() && place.cmple(DVec3::ONE).all() {
                seen.push(DVec3::ZERO);
            }
        }
        let nearest = *seen.iter().min_by(|a, b| a.z.total_cmp(&b.z))?;
        let farthest = seen.iter().map(|point| point.z).fold(nearest.z, f64::max);
        let places = seen.iter().map(|&point| self.on_film(point));
        let everywhere = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        Some(Glimpse {
            nearest: self.position + self.axes * nearest,
            depths: [nearest.z, farthest],
            places: places.fold(everywhere, |[least, most], at| {
                [least.min(at), most.max(at)]
            }),
        })
    }

    /// Where a point in the frame of the picture is seen.
    fn on_film(&self, point: DVec3) -> DVec2 {
        let plane = point.truncate() / self.half_extent;
        if self.is_parallel {
            plane
        } else {
            plane / point.z.max(f64::MIN_POSITIVE)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::thin_lens::{Focus, Lens};
    use crate::camera::view::Near;

    /// Looks along +y, z up: 2 m high at a distance of 1 m, or everywhere.
    fn frustum(is_parallel: bool) -> Frustum {
        let lens = Lens::pinhole(std::f64::consts::FRAC_PI_2).focused(Focus::Distance(1.0));
        let projection = if is_parallel {
            Projection::Orthographic { height: 2.0 }
        } else {
            Projection::Perspective(lens.expect("an angle can be focused"))
        };
        let view = View {
            position: DVec3::new(5e5, 0.0, 0.0),
            look_at: DVec3::new(5e5, 1.0, 0.0),
            up: DVec3::Z,
            projection,
            near: Near::default(),
        };
        Frustum::new(&view, [20, 20], 0.0)
    }

    /// A box by its least and greatest coordinates, beside the camera.
    fn seen(is_parallel: bool, least: [f64; 3], most: [f64; 3]) -> Option<Glimpse> {
        let corner = |number: usize| {
            let side = |axis: usize| [least, most][number >> axis & 1][axis];
            DVec3::new(5e5 + side(0), side(1), side(2))
        };
        frustum(is_parallel).glimpse(std::array::from_fn(corner))
    }

    #[test]
    fn a_box_beside_or_behind_the_camera_is_not_seen() {
        for is_parallel in [false, true] {
            let is_seen = |least, most| seen(is_parallel, least, most).is_some();
            assert!(is_seen([-0.1, 1.0, -0.1], [0.1, 2.0, 0.1]));
            assert!(!is_seen([-0.1, -2.0, -0.1], [0.1, -1.0, 0.1]));
            assert!(!is_seen([1.1, 0.2, -0.1], [1.2, 1.0, 0.1]));
            // Its corner comes into view at a distance of 1.1 m.
            let is_wide = is_seen([1.1, 0.2, -0.1], [1.2, 1.15, 0.1]);
            assert_eq!(is_wide, !is_parallel);
        }
    }

    #[test]
    fn the_part_of_a_box_that_is_seen_begins_where_rays_enter_it() {
        // A floor of a thousand kilometres, half a metre below the camera.
        let floor = |is_parallel| seen(is_parallel, [-1e6, -1e6, -0.6], [1e6, 1e6, -0.5]);
        let below = floor(false).expect("it is below the horizon");
        assert!((below.depths[0] - 0.5).abs() < 1e-5, "{below:?}");
        assert!((below.nearest.y - 0.5).abs() < 1e-5, "{below:?}");
        assert!((below.depths[1] - 1e6).abs() < 1.0, "{below:?}");
        let below = floor(true).expect("it is in the way");
        assert!(below.depths[0].abs() < 1e-9, "{below:?}");
        // All around: nothing is known to be farther than the camera.
        for is_parallel in [false, true] {
            let dome = seen(is_parallel, [-1e3; 3], [1e3; 3]).expect("it is around");
            assert_eq!(dome.depths[0], 0.0);
            assert!((dome.depths[1] - 1e3).abs() < 1e-6, "{dome:?}");
        }
    }

    #[test]
    fn a_flat_box_is_seen_as_any_other() {
        let card = seen(false, [-0.1, 3.0, -0.2], [0.1, 3.0, 0.2]).expect("it is ahead");
        assert!((card.depths[0] - 3.0).abs() < 1e-9 && (card.depths[1] - 3.0).abs() < 1e-9);
        let [least, most] = card.places;
        assert!(
            (most - DVec2::new(0.1, 0.2) / 3.0).length() < 1e-9,
            "{card:?}"
        );
        assert!((least + most).length() < 1e-9, "{card:?}");
    }
}
