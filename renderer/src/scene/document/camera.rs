//! `[camera.perspective]` and `[integrator]`.

use glam::DVec3;

use super::limits::Limits;
use super::reader::Block;
use crate::scene::description::{Camera, Integrator};
use crate::scene::error::SceneError;

/// Coordinates of the world, m. Farther out, single precision no longer resolves a leaf.
pub(crate) const COORDINATES_M: Limits = Limits::closed(-1e6, 1e6);

/// Reads `[camera]`.
pub(crate) fn read_camera(parent: &Block<'_>) -> Option<Camera> {
    let camera = parent.block("camera", &["perspective"])?;
    let (_, block) = camera.variant(&["perspective"])?;
    let position = block
        .numbers("position_m", COORDINATES_M)
        .map(DVec3::from_array);
    let look_at = block
        .numbers("look_at_m", COORDINATES_M)
        .map(DVec3::from_array);
    let up = block
        .optional_numbers("up", COORDINATES_M)
        .map_or(DVec3::Z, DVec3::from_array);
    let fov_deg = block.number("vertical_fov_deg", Limits::closed(0.01, 170.0));
    let aperture_mm = block.number_or("aperture_diameter_mm", Limits::closed(0.0, 1e6), 0.0);
    let focus_distance = block.optional_number("focus_distance_m", Limits::above(0.0, 1e7));
    block.finish();
    let (position, look_at) = (position?, look_at?);
    let view = look_at - position;
    // Nearer than this the direction would consist of rounding errors.
    if view.length() <= 1e-9 * position.length().max(1e-3) {
        let error = SceneError::BadView {
            problem: "the camera looks at the point where it stands",
            help: "move `position_m` or `look_at_m`",
        };
        let at = block.node("look_at_m").map_or(&block.at, |node| &node.at);
        block.cx.error(at, error);
        return None;
    }
    let across = view.normalize().cross(up.normalize_or_zero());
    if across.length() < 1e-6 {
        let error = SceneError::BadView {
            problem: "the camera's `up` is zero or points along its view",
            help: "choose another direction, for example `up = [0, 1, 0]`",
        };
        let at = block.node("up").map_or(&block.at, |node| &node.at);
        block.cx.error(at, error);
        return None;
    }
    Some(Camera {
        position,
        look_at,
        up,
        vertical_fov: fov_deg?.to_radians(),
        lens_radius: aperture_mm / 2000.0,
        focus_distance: focus_distance.unwrap_or(view.length()),
    })
}

/// Reads `[integrator]`, which may be left out.
pub(crate) fn read_integrator(parent: &Block<'_>) -> Integrator {
    let Some(block) = parent.optional_block("integrator") else {
        return Integrator::default();
    };
    let max_depth = block.optional_integer("max_depth", 1, 100_000);
    let roulette_below = block.optional_number("roulette_below", Limits::closed(0.0, 1.0));
    let branches = block.optional_integer("branches", 1, 64);
    let light_samples = block.optional_integer("light_samples", 1, 64);
    block.finish();
    Integrator {
        max_depth: max_depth.map(|depth| depth as u32),
        roulette_below,
        branches: branches.map(|branches| branches as u32),
        light_samples: light_samples.map(|samples| samples as u32),
    }
}
