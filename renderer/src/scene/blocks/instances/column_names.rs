//! The names of the columns of a table of instances.

use leafmodel::document::limits::Limits;

use crate::scene::blocks::camera::COORDINATES_M;
use crate::scene::blocks::placement::{ANGLES_DEG, SCALES};

/// Names of the columns, in the order in which a row stores their numbers.
pub(super) const NAMES: [&str; COUNT] = [
    "x_m",
    "y_m",
    "z_m",
    "rotate_x_deg",
    "rotate_y_deg",
    "rotate_z_deg",
    "quaternion_w",
    "quaternion_x",
    "quaternion_y",
    "quaternion_z",
    "scale",
    "scale_x",
    "scale_y",
    "scale_z",
    "shape",
];

/// Number of columns.
pub(super) const COUNT: usize = 15;
pub(super) const POSITION: usize = 0;
pub(super) const ROTATION: usize = 3;
pub(super) const QUATERNION: usize = 6;
pub(super) const SCALE: usize = 10;
pub(super) const AXES: usize = 11;
/// Index of the column for the object's shape.
pub(super) const SHAPE: usize = 14;

/// Greatest deviation of a quaternion's length from 1. Quaternions with three digits pass; columns
/// with other meanings do not.
pub(super) const UNIT_TOLERANCE: f64 = 0.01;

/// The range of a column's numbers; shapes are looked up instead.
pub(super) fn limits(column: usize) -> Limits {
    match column {
        POSITION..ROTATION => COORDINATES_M,
        ROTATION..QUATERNION => ANGLES_DEG,
        QUATERNION..SCALE => Limits::closed(-1.0 - UNIT_TOLERANCE, 1.0 + UNIT_TOLERANCE),
        _ => SCALES,
    }
}
