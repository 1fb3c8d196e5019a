//! Drawings of numbers as SVG: axes with round ticks, marks, and text that is escaped.
//!
//! - **In**: numbers, and places in pixels from the upper left corner.
//! - **Out**: an SVG file, or SVG to stand in a page, whose style sheet then gives its colours.
//! - **Always true**: no text of a name or a file is read as markup; ticks have few digits; the same
//!   numbers give the same bytes.
//! - **Left out**: leaves and networks, which `export::drawing` draws.

mod axis;
mod canvas;
mod chart;

pub(crate) use self::axis::{Axis, short};
pub(crate) use self::canvas::{Anchor, Canvas, escaped};
pub(crate) use self::chart::{CHART_SIZE, Chart, ChartLine};
