//! `[camera.perspective]` and `[camera.orthographic]`.

use glam::DVec3;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{Degrees, DegreesList, Kind, Number, Vector};

use crate::camera::thin_lens::{ANGLES_DEG, Field, Focus, Iris, Lens, LensError, Opening};
use crate::camera::view::{Near, Projection, View};
pub(super) use crate::geometry::instance::COORDINATES_M;
use crate::scene::description::{Camera, FocusObject};

/// Limits of the size on the sensor over the size in the scene.
const MAGNIFICATIONS: Limits = Limits::closed(1e-6, 1000.0);
/// Limits of lengths of lens and sensor, mm.
const LENGTHS_MM: Limits = Limits::closed(0.1, 1e5);
/// Height of the recorded frame of 24 × 36 mm, m.
const SENSOR_HEIGHT: f64 = 0.024;

/// The keys of `[camera]`.
pub(super) fn camera(camera: &mut Camera, keys: &mut Keys<'_>) {
    keys.kind(camera, &KINDS);
}

/// The kinds of `[camera]`.
pub(super) const NAMES: [&str; 2] = ["perspective", "orthographic"];

const KINDS: [Variant<Camera>; 2] = [
    Variant {
        name: NAMES[0],
        about: "A thin lens.",
        new: Camera::usual,
        is: |camera| matches!(camera.view.projection, Projection::Perspective(_)),
        declare: perspective,
    },
    Variant {
        name: NAMES[1],
        about: "Parallel rays: what is farther away looks no smaller.",
        new: || {
            let mut camera = Camera::usual();
            camera.view.projection = Projection::Orthographic { height: 1.0 };
            camera
        },
        is: |camera| matches!(camera.view.projection, Projection::Orthographic { .. }),
        declare: orthographic,
    },
];

fn perspective(camera: &mut Camera, keys: &mut Keys<'_>) {
    let about = "Middle of the lens.";
    place(&mut camera.view, about, keys);
    let lens = lens(keys);
    let focus = focus(&lens, camera, keys);
    // What does not fit together is reported after what cannot stand alone.
    let view = &mut camera.view;
    if !check_view(view, keys) {
        return;
    }
    let focus = match focus {
        Some(Wanted::Point(point)) => Focus::Point(view.in_picture(point)),
        Some(Wanted::Plane(focus)) => focus,
        None => Focus::Distance((view.look_at - view.position).length()),
    };
    match lens.focused(focus) {
        Ok(thin) => {
            let is_shaped = lens.iris != Iris::default() || lens.tilt != [0.0; 2];
            if thin.radius == 0.0 && is_shaped {
                keys.warn(
                    "scene::pinhole",
                    "the lens has no opening, so its shape and tilt change nothing".to_owned(),
                    "add an opening, for example `f_number = 4`",
                );
            }
            view.projection = Projection::Perspective(thin);
        }
        Err(error) => refuse(&error, keys),
    }
}

/// The number of a key that is there. If it is wrong, that is reported, and it is 1.
fn needed(
    key: &'static str,
    kind: impl Kind<Of = f64>,
    about: &'static str,
    keys: &mut Keys<'_>,
) -> f64 {
    let mut number = 1.0;
    keys.needed(key, &mut number, kind, about);
    number
}

/// Height of the recorded frame, m.
fn sensor_height(about: &'static str, keys: &mut Keys<'_>) -> f64 {
    let mut sensor_mm = 1000.0 * SENSOR_HEIGHT;
    keys.key(
        "sensor_height_mm",
        &mut sensor_mm,
        Number(LENGTHS_MM),
        about,
    );
    sensor_mm / 1000.0
}

/// What the file wants to be sharp.
enum Wanted {
    Plane(Focus),
    /// A point of the world.
    Point(DVec3),
}

/// The keys of the lens, but for its focus.
fn lens(keys: &mut Keys<'_>) -> Lens {
    let mut lens = Lens::pinhole(1.0);
    let fields = ["vertical_fov_deg", "focal_length_mm"];
    for chosen in keys.one_of(&fields, Some(fields[0])) {
        if chosen == "vertical_fov_deg" {
            let [least, most] = ANGLES_DEG;
            let limits = Limits::closed(least, most);
            let about = "Angle from the lower to the upper edge of the picture.";
            lens.field = Field::Angle(needed(chosen, Degrees(limits), about, keys));
        } else {
            let about = "Focal length, instead of the angle. The angle then follows from the \
                sensor's height, and gets smaller as the focus comes nearer.";
            let length_mm = needed(chosen, Number(LENGTHS_MM), about, keys);
            lens.field = Field::FocalLength(length_mm / 1000.0);
        }
    }
    let about = "Height of the recorded frame; 24 is that of small-format film.";
    lens.sensor_height = sensor_height(about, keys);
    let openings = ["aperture_diameter_mm", "f_number"];
    for chosen in keys.one_of_or_none(&openings, Some(openings[0])) {
        if chosen == "f_number" {
            let about = "Focal length over the diameter of the lens opening, instead of the \
                diameter. Smaller is less sharp before and behind the sharp plane.";
            let limits = Number(Limits::closed(0.5, 1000.0));
            lens.opening = Opening::FNumber(needed(chosen, limits, about, keys));
        } else {
            let mut aperture_mm = 0.0;
            let about = "Diameter of the lens opening; 0 is a pinhole.";
            let limits = Number(Limits::closed(0.0, 1e6));
            keys.key(chosen, &mut aperture_mm, limits, about);
            lens.opening = Opening::Diameter(aperture_mm / 1000.0);
        }
    }
    lens.iris.declare(keys);
    let about = "Turns of the lens, but not of the film, about the picture's axes to the right and \
        up, right-handed. They tilt the sharp plane: a positive first number brings it nearer \
        at the top of the picture.";
    let limits = DegreesList::<2>(Limits::closed(-45.0, 45.0));
    keys.key("tilt_deg", &mut lens.tilt, limits, about);
    lens
}

/// The keys of the focus.
fn focus(lens: &Lens, camera: &mut Camera, keys: &mut Keys<'_>) -> Option<Wanted> {
    let mut wanted = None;
    for chosen in keys.one_of_or_none(&FOCUS, None) {
        let focus = match chosen {
            "focus_distance_m" => {
                let limits = Number(Limits::above(0.0, 1e7));
                let about = "Distance of the sharp plane along the axis; without it and the next \
                    three keys that of `look_at_m`.";
                Wanted::Plane(Focus::Distance(needed(chosen, limits, about, keys)))
            }
            "focus_point_m" => {
                let about = "Point through which the sharp plane goes, instead of its distance.";
                let mut point = DVec3::ZERO;
                keys.needed(chosen, &mut point, Vector(COORDINATES_M), about);
                Wanted::Point(point)
            }
            "focus_object" => {
                const OBJECT: NameIn = NameIn("objects", "the name of an object to be sharp");
                let about = "Object through whose middle the sharp plane goes, instead of its \
                    distance: that of the box around all its parts.";
                let mut object = usize::MAX;
                keys.needed(chosen, &mut object, OBJECT, about);
                let lens = lens.clone();
                camera.focus_object = Some(FocusObject { object, lens });
                Wanted::Plane(Focus::Infinity)
            }
            _ => {
                let about = "Size on the sensor over size in the scene, on the sharp plane, \
                    instead of its distance: 1 is life size. It needs `focal_length_mm`.";
                let times = needed(chosen, Number(MAGNIFICATIONS), about, keys);
                keys.exclude("vertical_fov_deg", chosen);
                Wanted::Plane(Focus::Magnification(times))
            }
        };
        wanted = Some(focus);
    }
    wanted
}

const FOCUS: [&str; 4] = [
    "focus_distance_m",
    "focus_point_m",
    "focus_object",
    "magnification",
];

/// Reports a lens that cannot be focused.
fn refuse(error: &LensError, keys: &Keys<'_>) {
    let of_focus = FOCUS.into_iter().find(|key| keys.has(key));
    let (key, help) = match error {
        LensError::TooNear { .. } => (
            of_focus.unwrap_or("focal_length_mm"),
            "focus farther away than the focal length, or shorten that",
        ),
        LensError::Behind { .. } => (
            of_focus.unwrap_or("look_at_m"),
            "name a point in front of the camera, on the side of `look_at_m`",
        ),
        LensError::OffAxis => (
            of_focus.unwrap_or("tilt_deg"),
            "tilt the lens less, or name a point nearer to the middle of the picture",
        ),
        LensError::Angle { .. } => (
            "focal_length_mm",
            "change the focal length, or `sensor_height_mm`",
        ),
        LensError::NoFocalLength => (
            "magnification",
            "write `focal_length_mm` instead of `vertical_fov_deg`",
        ),
    };
    keys.refuse(&[key], error.to_string(), help);
}

fn orthographic(camera: &mut Camera, keys: &mut Keys<'_>) {
    let about = "Middle of the plane from which rays start; what is behind it is not seen.";
    place(&mut camera.view, about, keys);
    let sizes = ["height_m", "magnification"];
    let mut height = 1.0;
    for chosen in keys.one_of(&sizes, Some(sizes[0])) {
        if chosen == "height_m" {
            let about = "Height of what the picture shows.";
            let limits = Number(Limits::closed(1e-6, 1e6));
            height = needed(chosen, limits, about, keys);
            keys.exclude(chosen, "sensor_height_mm");
        }
        if chosen == "magnification" {
            let about = "Size on the sensor over size in the scene, instead of the height: 1 is \
                life size.";
            let times = needed(chosen, Number(MAGNIFICATIONS), about, keys);
            let about = "Height of the recorded frame, for `magnification`; 24 is that of \
                small-format film.";
            height = sensor_height(about, keys) / times;
        }
    }
    camera.view.projection = Projection::Orthographic { height };
    check_view(&camera.view, keys);
}

/// The keys that say where a camera stands.
fn place(view: &mut View, about_position: &'static str, keys: &mut Keys<'_>) {
    let coordinates = Vector(COORDINATES_M);
    keys.required(
        "position_m",
        &mut view.position,
        coordinates,
        about_position,
    );
    let about = "Point that comes to the middle of the picture; not where the camera stands.";
    keys.required("look_at_m", &mut view.look_at, coordinates, about);
    let about = "Direction that points up in the picture, of any length.";
    keys.key("up", &mut view.up, coordinates, about);
}

/// Whether a camera that was read looks anywhere; reports it if it does not.
fn check_view(camera: &View, keys: &Keys<'_>) -> bool {
    if !keys.is_sound() {
        return false;
    }
    let view = camera.look_at - camera.position;
    // Nearer than this the direction would consist of rounding errors.
    if view.length() <= 1e-9 * camera.position.length().max(1e-3) {
        let error = DocumentError::BadView {
            problem: "the camera looks at the point where it stands",
            help: "move `position_m` or `look_at_m`",
        };
        keys.report(&["look_at_m"], error);
        return false;
    }
    let across = view.normalize().cross(camera.up.normalize_or_zero());
    if across.length() < 1e-6 {
        let error = DocumentError::BadView {
            problem: "the camera's `up` is zero or points along its view",
            help: "choose another direction, for example `up = [0, 1, 0]`",
        };
        keys.report(&["up"], error);
        return false;
    }
    true
}

impl Camera {
    /// A camera with all defaults.
    pub(in crate::scene) fn usual() -> Self {
        let lens = Lens::pinhole(1.0).focused(Focus::Distance(1.0));
        let lens = lens.expect("an angle can be focused at any distance");
        Self {
            view: View {
                position: DVec3::NEG_Y,
                look_at: DVec3::ZERO,
                up: DVec3::Z,
                projection: Projection::Perspective(lens),
                near: Near::default(),
            },
            focus_object: None,
        }
    }
}
