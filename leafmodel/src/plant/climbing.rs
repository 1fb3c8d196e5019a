//! Axes that climb: they cling to a wall, and their leaves stand off it.

use glam::{DVec2, DVec3};

use crate::document::{Declared, Keys};
use crate::plane::bounds;
use crate::rotation::about;

/// How a plant climbs. Angles are radians.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = away_from_wall)]
pub struct Climbing {
    /// Away from the wall, in the plant's frame; any length but 0. The wall goes through the
    /// plant's foot.
    #[key("away", -1e6..=1e6)]
    pub away: DVec3,
    /// Angle by which petioles stand off the wall.
    ///
    /// Radians.
    #[key("lift_deg", degrees(0.0..=85.0))]
    pub lift: f64,
    /// Least distance between blades, taken flat, and the wall.
    #[key("clearance_mm", 0.0..=1000.0)]
    pub clearance_mm: f64,
    /// Adventitious roots by which axes hold on, for each millimetre of them.
    #[key("rootlets_per_mm", 0.0..=20.0)]
    pub rootlets_per_mm: f64,
}

/// Gives the direction away from the wall the length 1.
fn away_from_wall(climbing: &mut Climbing, keys: &Keys<'_>) {
    match climbing.away.try_normalize() {
        Some(away) => climbing.away = away,
        None => keys.refuse(
            &["away"],
            "a direction of length 0 is none".to_owned(),
            "write the direction in which the wall faces, such as `[1, 0, 0]`",
        ),
    }
}

impl Climbing {
    /// Ivy's: the wall faces +x; by eye.
    pub const USUAL: Self = Self {
        away: DVec3::X,
        lift: 40.0 * std::f64::consts::PI / 180.0,
        clearance_mm: 4.0,
        rootlets_per_mm: 0.8,
    };
}

/// Turns by which a blade that is too near is raised, and how far each goes beyond what is missing.
const RAISES: u32 = 6;
/// Most cells of a wall.
const MOST_CELLS: f64 = 4e6;
/// Least width of a cell, mm.
const CELL_MM: f64 = 1.5;

/// A wall: heights over the plane through the plant's foot, on a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    away: DVec3,
    axes: [DVec3; 2],
    first: DVec2,
    cell: f64,
    size: [usize; 2],
    /// Not a number where there is nothing.
    heights: Vec<f32>,
}

/// Directions of the wall's plane: across, and up.
fn plane(away: DVec3) -> [DVec3; 2] {
    let across = away.cross(DVec3::Z);
    let across = across.try_normalize().unwrap_or(DVec3::Y);
    [across, across.cross(away)]
}

impl Wall {
    /// The plane itself.
    pub fn flat(away: DVec3) -> Self {
        Self {
            away,
            axes: plane(away),
            first: DVec2::ZERO,
            cell: 1.0,
            size: [0, 0],
            heights: Vec::new(),
        }
    }

    /// The side of a surface that faces `away`, of triangles in the plant's frame, mm.
    pub fn of(triangles: &[[DVec3; 3]], away: DVec3) -> Self {
        let wall = Self::flat(away);
        let on = |point: DVec3| DVec2::from_array(wall.axes.map(|axis| axis.dot(point)));
        let corners = triangles
            .iter()
            .flatten()
            .copied()
            .filter(|c| c.is_finite());
        let (least, most) = bounds(corners.map(on));
        let extent = most - least;
        if !extent.is_finite() || extent.min_element() <= 0.0 {
            return wall;
        }
        let cell = (extent.x * extent.y / MOST_CELLS).sqrt().max(CELL_MM);
        let size = [extent.x, extent.y].map(|extent| (extent / cell).ceil() as usize + 1);
        let mut heights = vec![f32::NAN; size[0] * size[1]];
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| (on(corner) - least) / cell);
            let height = triangle.map(|corner| corner.dot(away));
            let double = (b - a).perp_dot(c - a);
            if !double.is_finite() || double.abs() < 1e-12 {
                continue;
            }
            let low = a.min(b).min(c).ceil().max(DVec2::ZERO);
            let high = a.max(b).max(c).floor();
            let [x0, y0] = [low.x as usize, low.y as usize];
            if high.x < 0.0 || high.y < 0.0 {
                continue;
            }
            for y in y0..=(high.y as usize).min(size[1] - 1) {
                for x in x0..=(high.x as usize).min(size[0] - 1) {
                    let at = DVec2::new(x as f64, y as f64);
                    let u = (b - at).perp_dot(c - at) / double;
                    let v = (c - at).perp_dot(a - at) / double;
                    let w = 1.0 - u - v;
                    if u.min(v).min(w) >= -1e-9 {
                        let here = (u * height[0] + v * height[1] + w * height[2]) as f32;
                        let cell = &mut heights[y * size[0] + x];
                        *cell = cell.max(here);
                    }
                }
            }
        }
        Self {
            first: least,
            cell,
            size,
            heights,
            ..wall
        }
    }

    /// Its height over the plane below a point, mm; beside it that of the plane.
    pub fn height(&self, point: DVec3) -> f64 {
        let at = DVec2::from_array(self.axes.map(|axis| axis.dot(point)));
        let at = ((at - self.first) / self.cell).round();
        if at.x < 0.0 || at.y < 0.0 {
            return 0.0;
        }
        let [x, y] = [at.x as usize, at.y as usize];
        if x >= self.size[0] || y >= self.size[1] {
            return 0.0;
        }
        let height = f64::from(self.heights[y * self.size[0] + x]);
        if height.is_nan() { 0.0 } else { height }
    }

    /// How far a point lies before the wall, mm.
    fn before(&self, point: DVec3) -> f64 {
        point.dot(self.away) - self.height(point)
    }

    /// The part of a direction within the plane.
    pub(super) fn within(&self, direction: DVec3) -> DVec3 {
        let flat = direction - self.away * direction.dot(self.away);
        flat.try_normalize().unwrap_or(self.axes[1])
    }

    /// The point of the plane below another.
    pub(super) fn below(&self, point: DVec3) -> DVec3 {
        point - self.away * point.dot(self.away)
    }

    /// Direction in which the first leaf of an axis in the plane stands.
    pub(super) fn beside(&self, along: DVec3) -> DVec3 {
        self.away.cross(along).normalize()
    }

    /// The direction away from it.
    pub(super) fn away(&self) -> DVec3 {
        self.away
    }

    /// How high the middle line of an axis of this radius must lie at a point of the plane, mm.
    pub(super) fn needed(&self, point: DVec3, radius: f64) -> f64 {
        // The axis is as wide as it is thick.
        let side = self.axes.map(|axis| axis * (0.7 * radius));
        let around = [DVec3::ZERO, side[0], -side[0], side[1], -side[1]];
        let heights = around.map(|offset| self.height(point + offset));
        heights.into_iter().fold(f64::MIN, f64::max) + 0.95 * radius
    }
}

impl Climbing {
    /// The direction in which a petiole stands out from an axis on the wall, of which `radial` is
    /// the part along the wall.
    pub(super) fn lifted(&self, radial: DVec3, along: DVec3) -> DVec3 {
        // At right angles to both, also where the axis bends over the wall's relief.
        let across = self.away - along * self.away.dot(along);
        let away = (across - radial * across.dot(radial)).normalize();
        radial * libm::cos(self.lift) + away * libm::sin(self.lift)
    }

    /// The turn about its foot that takes a leaf off the wall: of points of its blade, given from the
    /// foot, none is then nearer than the clearance, as far as a few turns can do that.
    pub(super) fn cleared(&self, wall: &Wall, foot: DVec3, points: &[DVec3]) -> glam::DMat3 {
        let mut turn = glam::DMat3::IDENTITY;
        for _ in 0..RAISES {
            let lowest = points
                .iter()
                .map(|point| turn * *point)
                .map(|point| (wall.before(foot + point), point))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((height, point)) = lowest else {
                break;
            };
            let missing = self.clearance_mm - height;
            let flat = point - self.away * point.dot(self.away);
            let reach = flat.length();
            if missing <= 0.0 || reach < 1e-6 {
                break;
            }
            let axis = (flat / reach).cross(self.away);
            let angle = libm::atan2(missing, reach).min(0.6);
            turn = about(axis.normalize(), angle) * turn;
        }
        turn
    }
}
