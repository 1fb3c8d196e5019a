//! `[camera.perspective]` and `[integrator]`.

use glam::DVec3;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Degrees, Integer, Number, Vector};

use super::report;
use crate::scene::description::{Camera, Integrator};

/// Limits of world coordinates, m. Beyond them single precision does not resolve a leaf.
pub(super) const COORDINATES_M: Limits = Limits::closed(-1e6, 1e6);

/// The keys of `[camera]`.
pub(super) fn camera(camera: &mut Camera, keys: &mut Keys<'_>) {
    keys.kind(camera, &KINDS);
}

const KINDS: [Variant<Camera>; 1] = [Variant {
    name: "perspective",
    about: "A thin lens.",
    new: Camera::usual,
    is: |_| true,
    declare: perspective,
}];

fn perspective(camera: &mut Camera, keys: &mut Keys<'_>) {
    let coordinates = Vector(COORDINATES_M);
    let about = "Middle of the lens.";
    keys.required("position_m", &mut camera.position, coordinates, about);
    let about = "Point that comes to the middle of the picture; not where the camera stands.";
    keys.required("look_at_m", &mut camera.look_at, coordinates, about);
    let about = "Direction that points up in the picture, of any length.";
    keys.key("up", &mut camera.up, coordinates, about);
    let limits = Degrees(Limits::closed(0.01, 170.0));
    let about = "Angle from the lower to the upper edge of the picture.";
    keys.required("vertical_fov_deg", &mut camera.vertical_fov, limits, about);
    let mut aperture_mm = 2000.0 * camera.lens_radius;
    let limits = Number(Limits::closed(0.0, 1e6));
    let about = "Diameter of the lens opening.";
    keys.key("aperture_diameter_mm", &mut aperture_mm, limits, about);
    camera.lens_radius = aperture_mm / 2000.0;
    let mut focus = None;
    let limits = Number(Limits::above(0.0, 1e7));
    let about = "Distance of the sharp plane along the axis.";
    keys.optional("focus_distance_m", &mut focus, limits, about);
    let view = camera.look_at - camera.position;
    camera.focus_distance = focus.unwrap_or(view.length());
    if !keys.is_sound() {
        return;
    }
    // Nearer than this the direction would consist of rounding errors.
    if view.length() <= 1e-9 * camera.position.length().max(1e-3) {
        let error = DocumentError::BadView {
            problem: "the camera looks at the point where it stands",
            help: "move `position_m` or `look_at_m`",
        };
        report(keys, "look_at_m", error);
        return;
    }
    let across = view.normalize().cross(camera.up.normalize_or_zero());
    if across.length() < 1e-6 {
        let error = DocumentError::BadView {
            problem: "the camera's `up` is zero or points along its view",
            help: "choose another direction, for example `up = [0, 1, 0]`",
        };
        report(keys, "up", error);
    }
}

impl Camera {
    /// A camera with all defaults.
    pub(in crate::scene) fn usual() -> Self {
        Self {
            position: DVec3::NEG_Y,
            look_at: DVec3::ZERO,
            up: DVec3::Z,
            vertical_fov: 1.0,
            lens_radius: 0.0,
            focus_distance: 1.0,
        }
    }
}

/// The keys of `[integrator]`.
pub(super) fn integrator(integrator: &mut Integrator, keys: &mut Keys<'_>) {
    let count = Integer::within(1, 100_000);
    let about = "Most scattering events of a path. A limit darkens the picture: in the infrared, \
        where leaves hardly absorb, a limit of 8 loses some 2 %.";
    keys.optional("max_depth", &mut integrator.max_depth, count, about);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "Paths of whose light less than this share can reach the film may end by Russian \
        roulette, without bias; 0 switches it off. On a film of colour the share is what the eye \
        sees, on bands that of the brightest band. Higher is faster and noisier.";
    keys.optional(
        "roulette_below",
        &mut integrator.roulette_below,
        limits,
        about,
    );
    let count = Integer::within(1, 64);
    let about = "Paths that go on from what the camera sees first, where none of the lights that \
        are sampled (suns, lamps, sky pictures) reaches it. More is slower and less noisy, in \
        shade.";
    keys.optional("branches", &mut integrator.branches, count, about);
    let about = "Samples of lamps and sky pictures at what the camera sees first; suns have one \
        each. More is slower and less noisy where lamps cast soft shadows.";
    keys.optional("light_samples", &mut integrator.light_samples, count, about);
}
