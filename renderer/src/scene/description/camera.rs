//! The camera of a scene: `[camera.perspective]` and `[camera.orthographic]`.

mod framing;

use glam::{DQuat, DVec3};
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::{NameIn, NameOrAll};
use leafmodel::document::value_kind::{Degrees, Kind, Number, Vector};
use thiserror::Error;

use self::framing::{Frame, Framed};
use crate::camera::thin_lens::{ANGLES_DEG, Field, Focus, Iris, Lens, LensError, Opening};
use crate::camera::view::{Near, Projection, View};
use crate::geometry::instance::COORDINATES_M;

/// The camera of a scene.
#[derive(Clone, Debug)]
pub struct Camera {
    /// The view. If an object is in focus or fills the picture, which is somewhere only once it has grown, it is
    /// focused at infinity; [`Camera::view_on`] knows more.
    pub view: View,
    /// The lens, before it is focused; none with parallel rays.
    lens: Option<Lens>,
    /// What is sharp; what the camera looks at, or the middle of what fills the picture, if it is `None`.
    sharp: Option<Sharp>,
    /// What fills the picture.
    frame: Option<Frame>,
}

/// Where things of a scene are.
pub trait Places {
    /// The middle of the box around an object, m.
    fn middle(&self, object: usize) -> DVec3;

    /// Points of the scene between which all of an object lies, or everything that there is; m.
    fn around(&self, object: Option<usize>) -> Vec<DVec3>;
}

impl Default for Camera {
    fn default() -> Self {
        let lens = Lens::pinhole(1.0).focused(Focus::Distance(1.0));
        let lens = lens.expect("an angle can be focused at any distance");
        let direction = Aim::default();
        Self {
            view: direction.seen_from(DVec3::NEG_Y, Projection::Perspective(lens)),
            lens: None,
            sharp: None,
            frame: None,
        }
    }
}

impl Declared for Camera {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let mut written = WrittenCamera::Perspective(Perspective::default());
        written.declare(keys);
        *self = match written {
            WrittenCamera::Perspective(of) => of.camera,
            WrittenCamera::Orthographic(of) => of.camera,
        };
    }

    fn kinds() -> Vec<&'static str> {
        WrittenCamera::kinds()
    }
}

impl Camera {
    /// The view, once it is known where things are; `aspect` is the picture's width over its height.
    ///
    /// # Errors
    ///
    /// [`FocusError`] if the lens cannot be focused on what should be sharp.
    pub fn view_on(&self, places: &impl Places, aspect: f64) -> Result<View, FocusError> {
        let mut view = self.view.clone();
        let framed = self.frame.and_then(|frame| {
            let points = places.around(frame.object);
            Framed::of(points, &view, aspect, frame.margin)
        });
        let Some(lens) = &self.lens else {
            if let Some(framed) = framed {
                framed.fill_by_parallel_rays(&mut view);
            }
            return Ok(view);
        };
        let focus = |view: &View, middle: f64| match self.sharp {
            Some(Sharp::Plane(focus)) => focus,
            Some(Sharp::Point(point)) => Focus::Point(view.in_picture(point)),
            Some(Sharp::Object(object)) => Focus::Point(view.in_picture(places.middle(object))),
            None => Focus::Distance(middle),
        };
        let focused = if let Some(framed) = framed {
            let at_first = match self.sharp {
                Some(Sharp::Plane(focus)) => focus,
                Some(Sharp::Point(_) | Sharp::Object(_)) | None => Focus::Infinity,
            };
            framed.fill_by_lens(&mut view, lens, at_first, focus)
        } else {
            let thin = lens.focused(focus(&view, (view.look_at - view.position).length()));
            thin.map(|thin| view.projection = Projection::Perspective(thin))
        };
        focused.map_err(|error| FocusError {
            key: match self.sharp {
                Some(Sharp::Plane(_)) | None => "frame",
                Some(Sharp::Point(_)) => "focus_point_m",
                Some(Sharp::Object(_)) => "focus_object",
            },
            error,
        })?;
        Ok(view)
    }
}

/// Why a camera cannot be focused where it stands once things have grown.
#[derive(Debug, Error)]
#[error("camera.perspective.{key}: {error}")]
pub struct FocusError {
    key: &'static str,
    error: LensError,
}

/// Limits of the size on the sensor over the size in the scene.
const MAGNIFICATIONS: Limits = Limits::closed(1e-6, 1000.0);
/// Least and greatest length of lens and sensor, mm.
const LENGTHS_MM: [f64; 2] = [0.1, 1e5];
/// Height of the recorded frame of 24 × 36 mm.
const SENSOR_HEIGHT_MM: f64 = 24.0;

/// A camera as a file has it.
#[derive(Clone, Debug, Declared)]
enum WrittenCamera {
    /// A thin lens.
    Perspective(Perspective),
    /// Parallel rays: what is farther away looks no smaller.
    Orthographic(Orthographic),
}

/// Where a camera looks.
#[derive(Clone, Copy, Debug, Declared, Defaults)]
struct Aim {
    /// Point that comes to the middle of the picture; not where the camera stands.
    #[key("look_at_m", required, within(COORDINATES_M))]
    look_at: DVec3,
    /// Direction that points up in the picture, of any length.
    #[key("up", within(COORDINATES_M), default = DVec3::Z)]
    up: DVec3,
    /// How far the camera is turned about an axis through `look_at_m` along `up`, anticlockwise as seen from above: a
    /// turntable.
    #[key("turn_deg", degrees(-3600.0..=3600.0))]
    turn: f64,
}

/// A camera with parallel rays.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::look)]
struct Orthographic {
    /// Middle of the plane from which rays start; what is behind it is not seen.
    #[key("position_m", required, within(COORDINATES_M), default = DVec3::NEG_Y)]
    position: DVec3,
    #[key(flat)]
    direction: Aim,
    /// Height of what the picture shows, m.
    #[key(with = Self::declare_height, default = 1.0)]
    height: f64,
    frame: WrittenFrame,
    /// Fraction of the picture's width and height that `frame` leaves free at each edge.
    #[key("frame_margin", 0.0..=0.45, default = 0.05)]
    frame_margin: f64,
    /// The whole, once it is read.
    camera: Camera,
}

/// A camera with a lens.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::focus)]
struct Perspective {
    /// Middle of the lens.
    #[key("position_m", required, within(COORDINATES_M), default = DVec3::NEG_Y)]
    position: DVec3,
    #[key(flat)]
    direction: Aim,
    #[key(with = Self::declare_field, default = Field::Angle(1.0))]
    field: Field,
    /// Height of the recorded frame; 24 is that of small-format film.
    #[key("sensor_height_mm", LENGTHS_MM[0]..=LENGTHS_MM[1], default = SENSOR_HEIGHT_MM)]
    sensor_height_mm: f64,
    #[key(with = Self::declare_opening, default = Opening::Diameter(0.0))]
    opening: Opening,
    #[key(flat)]
    iris: Iris,
    /// Turns of the lens, but not of the film, about the picture's axes to the right and up, right-handed. They
    /// tilt the sharp plane: a positive first number brings it nearer at the top of the picture.
    #[key("tilt_deg", degrees(-45.0..=45.0))]
    tilt: [f64; 2],
    #[key(with = Self::declare_sharp)]
    sharp: Option<Sharp>,
    #[key(with = Self::declare_frame)]
    frame: WrittenFrame,
    /// Fraction of the picture's width and height that `frame` leaves free at each edge.
    #[key("frame_margin", 0.0..=0.45, default = 0.05)]
    frame_margin: f64,
    /// The whole, once it is read.
    camera: Camera,
}

/// What the file wants to be sharp.
#[derive(Clone, Copy, Debug)]
enum Sharp {
    Plane(Focus),
    /// A point of the world.
    Point(DVec3),
    /// The middle of an object with this number.
    Object(usize),
}

impl Aim {
    fn seen_from(self, position: DVec3, projection: Projection) -> View {
        let position = match self.up.try_normalize() {
            Some(axis) if self.turn != 0.0 => {
                let turned = DQuat::from_axis_angle(axis, self.turn);
                self.look_at + turned * (position - self.look_at)
            }
            _ => position,
        };
        View {
            position,
            look_at: self.look_at,
            up: self.up,
            projection,
            near: Near::default(),
        }
    }
}

impl Orthographic {
    fn declare_height(&mut self, keys: &mut Keys<'_>) {
        let sizes = ["height_m", "magnification", "frame"];
        for chosen in keys.one_of(&sizes, Some(sizes[0])) {
            if chosen == "frame" {
                let mut object = None;
                keys.needed(chosen, &mut object, FRAMED, ABOUT_FRAME);
                self.frame = Some(object);
            } else if chosen == "height_m" {
                let about = "Height of what the picture shows.";
                let limits = Number(Limits::closed(1e-6, 1e6));
                self.height = needed(chosen, limits, about, keys);
                keys.exclude(chosen, "sensor_height_mm");
            } else {
                let about = "Size on the sensor over size in the scene, instead of the height: 1 is \
                    life size.";
                let times = needed(chosen, Number(MAGNIFICATIONS), about, keys);
                let mut sensor_mm = SENSOR_HEIGHT_MM;
                let limits = Number(Limits::closed(LENGTHS_MM[0], LENGTHS_MM[1]));
                let about = "Height of the recorded frame, for `magnification`; 24 is that of \
                    small-format film.";
                keys.key("sensor_height_mm", &mut sensor_mm, limits, about);
                self.height = sensor_mm / 1000.0 / times;
            }
        }
    }

    fn look(&mut self, keys: &mut Keys<'_>) {
        let height = self.height;
        let projection = Projection::Orthographic { height };
        self.camera.view = self.direction.seen_from(self.position, projection);
        self.camera.frame = frame_of(self.frame, self.frame_margin);
        check_view(&self.camera.view, keys);
    }
}

impl Perspective {
    fn declare_field(&mut self, keys: &mut Keys<'_>) {
        let fields = ["vertical_fov_deg", "focal_length_mm"];
        for chosen in keys.one_of(&fields, Some(fields[0])) {
            self.field = if chosen == "vertical_fov_deg" {
                let [least, most] = ANGLES_DEG;
                let limits = Degrees(Limits::closed(least, most));
                let about = "Angle from the lower to the upper edge of the picture.";
                Field::Angle(needed(chosen, limits, about, keys))
            } else {
                let limits = Number(Limits::closed(LENGTHS_MM[0], LENGTHS_MM[1]));
                let about = "Focal length, instead of the angle. The angle then follows from the \
                    sensor's height, and gets smaller as the focus comes nearer.";
                Field::FocalLength(needed(chosen, limits, about, keys) / 1000.0)
            };
        }
    }

    fn declare_opening(&mut self, keys: &mut Keys<'_>) {
        let openings = ["aperture_diameter_mm", "f_number"];
        for chosen in keys.one_of_or_none(&openings, Some(openings[0])) {
            self.opening = if chosen == "f_number" {
                let about = "Focal length over the diameter of the lens opening, instead of the \
                    diameter. Smaller is less sharp before and behind the sharp plane.";
                let limits = Number(Limits::closed(0.5, 1000.0));
                Opening::FNumber(needed(chosen, limits, about, keys))
            } else {
                let mut aperture_mm = 0.0;
                let about = "Diameter of the lens opening; 0 is a pinhole.";
                let limits = Number(Limits::closed(0.0, 1e6));
                keys.key(chosen, &mut aperture_mm, limits, about);
                Opening::Diameter(aperture_mm / 1000.0)
            };
        }
    }

    fn declare_sharp(&mut self, keys: &mut Keys<'_>) {
        for chosen in keys.one_of_or_none(&FOCUS, None) {
            self.sharp = Some(match chosen {
                "focus_distance_m" => {
                    let limits = Number(Limits::above(0.0, 1e7));
                    let about = "Distance of the sharp plane along the axis; without it and the next \
                        three keys that of `look_at_m`.";
                    Sharp::Plane(Focus::Distance(needed(chosen, limits, about, keys)))
                }
                "focus_point_m" => {
                    let about =
                        "Point through which the sharp plane goes, instead of its distance.";
                    let mut point = DVec3::ZERO;
                    keys.needed(chosen, &mut point, Vector(COORDINATES_M), about);
                    Sharp::Point(point)
                }
                "focus_object" => {
                    const OBJECT: NameIn = NameIn("objects", "the name of an object to be sharp");
                    let about = "Object through whose middle the sharp plane goes, instead of its \
                        distance: that of the box around all its parts.";
                    let mut object = usize::MAX;
                    keys.needed(chosen, &mut object, OBJECT, about);
                    Sharp::Object(object)
                }
                _ => {
                    let about = "Size on the sensor over size in the scene, on the sharp plane, \
                        instead of its distance: 1 is life size. It needs `focal_length_mm`.";
                    let times = needed(chosen, Number(MAGNIFICATIONS), about, keys);
                    keys.exclude("vertical_fov_deg", chosen);
                    Sharp::Plane(Focus::Magnification(times))
                }
            });
        }
    }

    fn declare_frame(&mut self, keys: &mut Keys<'_>) {
        keys.optional("frame", &mut self.frame, FRAMED, ABOUT_FRAME);
        keys.exclude("frame", "magnification");
    }

    /// Focuses the lens. What does not fit together is reported after what cannot stand alone.
    fn focus(&mut self, keys: &mut Keys<'_>) {
        let lens = Lens {
            field: self.field,
            sensor_height: self.sensor_height_mm / 1000.0,
            opening: self.opening,
            iris: self.iris,
            tilt: self.tilt,
        };
        self.camera.lens = Some(lens.clone());
        self.camera.sharp = self.sharp;
        self.camera.frame = frame_of(self.frame, self.frame_margin);
        let view = &mut self.camera.view;
        *view = self
            .direction
            .seen_from(self.position, view.projection.clone());
        if !check_view(view, keys) {
            return;
        }
        let focus = match self.sharp {
            Some(Sharp::Plane(focus)) => focus,
            // They are somewhere, and so is the camera, only once things have grown.
            Some(Sharp::Object(_)) => Focus::Infinity,
            Some(Sharp::Point(_)) | None if self.frame.is_some() => Focus::Infinity,
            Some(Sharp::Point(point)) => Focus::Point(view.in_picture(point)),
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
}

/// The object that fills the picture, or everything.
type WrittenFrame = Option<Option<usize>>;

/// What fills the picture.
const FRAMED: NameOrAll = NameOrAll(
    NameIn(
        "objects",
        "the name of an object that fills the picture, or `everything`",
    ),
    "everything",
);
const ABOUT_FRAME: &str = "What fills the picture: the camera looks in the direction from `position_m` to `look_at_m`, and stands as near \
    as all of that object, or of everything, allows. It is in focus if nothing else is said.";

fn frame_of(object: WrittenFrame, margin: f64) -> Option<Frame> {
    object.map(|object| Frame { object, margin })
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
