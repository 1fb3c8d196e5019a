//! The camera of a scene.

use glam::DVec3;

use crate::camera::thin_lens::{Focus, Lens, LensError};
use crate::camera::view::{Projection, View};

/// The camera of a scene.
#[derive(Clone, Debug)]
pub struct Camera {
    /// The view. If the focus is on an object, which is somewhere only once it has grown, it is
    /// focused at infinity; [`Camera::view_on`] knows more.
    pub view: View,
    /// The object that is in focus.
    pub focus_object: Option<FocusObject>,
}

/// A focus on an object.
#[derive(Clone, Debug)]
pub struct FocusObject {
    /// Index into [`super::Description::objects`].
    pub object: usize,
    /// The lens that is focused.
    pub lens: Lens,
}

impl Camera {
    /// The view, given a function to the middle of an object.
    ///
    /// # Errors
    ///
    /// [`LensError`] if the lens cannot be focused there.
    pub fn view_on(&self, middle: impl FnOnce(usize) -> DVec3) -> Result<View, LensError> {
        let Some(FocusObject { object, lens }) = &self.focus_object else {
            return Ok(self.view.clone());
        };
        let point = self.view.in_picture(middle(*object));
        let lens = lens.focused(Focus::Point(point))?;
        Ok(View {
            projection: Projection::Perspective(lens),
            ..self.view.clone()
        })
    }
}
