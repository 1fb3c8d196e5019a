//! Mitsuba's plugins and their parameters as XML elements.

use std::fmt::Display;

use glam::{DMat4, DVec3};

use crate::export::element::Element;

impl Element {
    /// A plugin: `<bsdf type="diffuse">`.
    pub(super) fn plugin(family: &'static str, kind: &str) -> Self {
        Self::new(family).with("type", kind)
    }

    /// Sets the id by which other plugins refer to it.
    pub(super) fn called(self, id: impl Display) -> Self {
        self.with("id", id)
    }

    /// Adds a real parameter.
    pub(super) fn float(self, name: &str, value: f64) -> Self {
        self.parameter("float", name, value)
    }

    /// Adds an integer parameter.
    pub(super) fn integer(self, name: &str, value: impl Into<i64>) -> Self {
        self.parameter("integer", name, value.into())
    }

    /// Adds a boolean parameter.
    pub(super) fn boolean(self, name: &str, value: bool) -> Self {
        self.parameter("boolean", name, value)
    }

    /// Adds a string parameter.
    pub(super) fn string(self, name: &str, value: impl Display) -> Self {
        self.parameter("string", name, value)
    }

    /// Adds a reference to another plugin.
    pub(super) fn referring(self, id: impl Display) -> Self {
        self.holding(Self::new("ref").called(id))
    }

    /// Adds a transform to the world by these steps, in the order of their application.
    pub(super) fn placed(self, steps: impl IntoIterator<Item = Self>) -> Self {
        let transform = Self::new("transform").with("name", "to_world");
        self.holding(transform.holding_all(steps))
    }

    /// Adds a parameter of the given type.
    pub(super) fn parameter(self, kind: &'static str, name: &str, value: impl Display) -> Self {
        self.holding(Self::new(kind).with("name", name).with("value", value))
    }
}

/// A step of a transform: from `origin`, +z towards `target`.
pub(super) fn look_at(origin: DVec3, target: DVec3, up: DVec3) -> Element {
    let triple = |v: DVec3| format!("{}, {}, {}", v.x, v.y, v.z);
    Element::new("lookat")
        .with("origin", triple(origin))
        .with("target", triple(target))
        .with("up", triple(up))
}

/// A step of a transform: a matrix, in single precision as read by Mitsuba.
pub(super) fn matrix(matrix: DMat4) -> Element {
    let row_major = matrix.as_mat4().transpose().to_cols_array();
    let values = row_major.map(|value| value.to_string());
    Element::new("matrix").with("value", values.join(" "))
}
