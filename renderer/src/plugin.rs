//! Mitsuba's plugins and their parameters as XML elements: what lights, materials and the export write them with.
//!
//! - **In**: numbers, spectra and maps of colours by their names, and the tracer's materials.
//! - **Out**: [`Element`]s, and the files beside the scene that they name.
//! - **Left out**: which plugin a thing becomes. Each light and material says that in its own file of
//!   [`description`](crate::scene::description), the rest is in [`export`](crate::export).

pub(crate) mod colours;
pub(crate) mod element;
pub(crate) mod emitter;
pub(crate) mod spectra;
pub(crate) mod surface;

use std::fmt::Display;

use glam::{DMat4, DVec3};

use element::Element;

/// Mitsuba's units per metre: the exported scene is in millimetres.
///
/// Mitsuba moves the origin of every new ray off its surface by 9e-5 (1 + largest coordinate). In
/// metres that is a tenth of a millimetre, as much as the height of veins, so light would pass
/// below them (an error of 0.25 % of the mean in a close-up). In millimetres it is some
/// micrometres. Radiance does not depend on the unit.
pub(crate) const UNITS_PER_METRE: f64 = 1000.0;

/// Name of a light in the export.
pub(crate) fn light_id(light: &str) -> String {
    format!("light-{light}")
}

/// Path, within the export, of the weights of a light.
pub(crate) fn weights_file(light: &str) -> String {
    format!("maps/{}.exr", light_id(light))
}

impl Element {
    /// A plugin: `<bsdf type="diffuse">`.
    pub(crate) fn plugin(family: &'static str, kind: &str) -> Self {
        Self::new(family).with("type", kind)
    }

    /// Sets the id by which other plugins refer to it.
    pub(crate) fn called(self, id: impl Display) -> Self {
        self.with("id", id)
    }

    /// Adds a real parameter.
    pub(crate) fn float(self, name: &str, value: f64) -> Self {
        self.parameter("float", name, value)
    }

    /// Adds an integer parameter.
    pub(crate) fn integer(self, name: &str, value: impl Into<i64>) -> Self {
        self.parameter("integer", name, value.into())
    }

    /// Adds a boolean parameter.
    pub(crate) fn boolean(self, name: &str, value: bool) -> Self {
        self.parameter("boolean", name, value)
    }

    /// Adds a string parameter.
    pub(crate) fn string(self, name: &str, value: impl Display) -> Self {
        self.parameter("string", name, value)
    }

    /// Adds a reference to another plugin.
    pub(crate) fn referring(self, id: impl Display) -> Self {
        self.holding(Self::new("ref").called(id))
    }

    /// Adds a transform to the world by these steps, in the order of their application.
    pub(crate) fn placed(self, steps: impl IntoIterator<Item = Self>) -> Self {
        let transform = Self::new("transform").with("name", "to_world");
        self.holding(transform.holding_all(steps))
    }

    /// Adds a parameter of the given type.
    pub(crate) fn parameter(self, kind: &'static str, name: &str, value: impl Display) -> Self {
        self.holding(Self::new(kind).with("name", name).with("value", value))
    }
}

/// A step of a transform: from `origin`, +z towards `target`.
pub(crate) fn look_at(origin: DVec3, target: DVec3, up: DVec3) -> Element {
    let triple = |v: DVec3| format!("{}, {}, {}", v.x, v.y, v.z);
    Element::new("lookat")
        .with("origin", triple(origin))
        .with("target", triple(target))
        .with("up", triple(up))
}

/// A step of a transform: a matrix, in single precision as read by Mitsuba.
pub(crate) fn matrix(matrix: DMat4) -> Element {
    let row_major = matrix.as_mat4().transpose().to_cols_array();
    let values = row_major.map(|value| value.to_string());
    Element::new("matrix").with("value", values.join(" "))
}
