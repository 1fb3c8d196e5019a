//! What Mitsuba gets of a light.

use glam::DVec3;

use super::element::{Element, Layout};
use crate::spectrum::written::Spectrum;

/// What Mitsuba gets of a light.
pub(crate) enum Emitter<'l> {
    /// A plugin with a place of its own.
    Placed(Element),
    /// A disc in the sky.
    Disc {
        /// Unit vector towards its middle.
        towards: DVec3,
        /// Half the angle under which it is seen, rad.
        half: f64,
        /// How it shines.
        emitter: Element,
    },
    /// It belongs to the shape of its object ([`Area`](crate::scene::description::light::area::Area)).
    OnShape,
    /// A part of what shines from everywhere: this radiance, or else the table of the tracer's light.
    Around(Option<&'l Spectrum>),
}

/// The emitter that makes a shape shine with a radiance, which is its parameter of this name.
pub(crate) fn area(radiance: Element) -> Element {
    Element::plugin("emitter", "area")
        .holding(radiance)
        .laid_out(Layout::Level)
}
