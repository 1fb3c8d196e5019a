//! A traced picture with what was traced drawn over it.
//!
//! - **In**: grey values, and the lines in their pixels.
//! - **Out**: a [`Drawing`], at most so many pixels long.
//! - **Left out**: widths; lines have one width, so that the veins below stay to be seen.

use glam::DVec2;
use leafmodel::export::order_colour;
use leafmodel::tracing::{Raster, Traced};
use tiny_skia::{LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

use super::drawing::{Drawing, add};
use crate::image::{ImageError, MOST_BYTES};

/// How much the picture is paled, so that lines stand out.
const PALED: f32 = 0.45;

/// Width of the lines, pixels.
const WIDTH: f32 = 1.4;

/// Radius of the dots at junctions and free ends, pixels.
const DOT: f64 = 2.0;

/// Colour of the margin.
const MARGIN: [u8; 3] = [230, 60, 160];

/// Draws margin and veins over the picture, whose longer side takes at most `longest` pixels.
///
/// Veins have the colours of their orders; a dot marks each node at which other than two pieces
/// meet.
///
/// # Errors
///
/// [`ImageError::TooLarge`] if there is no memory for it.
pub fn draw_over(picture: &Raster, traced: &Traced, longest: u32) -> Result<Drawing, ImageError> {
    let (width, height) = (picture.width(), picture.height());
    let scale = (f64::from(longest) / width.max(height) as f64).min(1.0);
    let side = |pixels: usize| ((pixels as f64 * scale).round() as u32).max(1);
    let (across, down) = (side(width), side(height));
    let mut canvas = Pixmap::new(across, down).ok_or(ImageError::TooLarge {
        width: u64::from(across),
        height: u64::from(down),
        channels: 4,
        most: MOST_BYTES,
    })?;
    for (at, pixel) in canvas.pixels_mut().iter_mut().enumerate() {
        let (x, y) = (at % across as usize, at / across as usize);
        // The mean of the pixels that lie under it.
        let range = |at: usize, of: usize| {
            let low = ((at as f64 / scale) as usize).min(of - 1);
            low..((((at + 1) as f64 / scale).ceil() as usize).min(of)).max(low + 1)
        };
        let (mut sum, mut count) = (0.0, 0.0);
        for row in range(y, height) {
            for column in range(x, width) {
                sum += picture.values()[row * width + column];
                count += 1.0;
            }
        }
        let value = (sum / count).clamp(0.0, 1.0) * (1.0 - PALED) + PALED;
        let grey = (value * 255.0).round() as u8;
        *pixel = tiny_skia::ColorU8::from_rgba(grey, grey, grey, 255).premultiply();
    }
    let place = |p: DVec2| traced.frame.to_px(p) * scale;
    let mut margin = PathBuilder::new();
    let points = traced.outline.points().iter();
    add(&mut margin, points.map(|&p| place(p)));
    stroke(&mut canvas, margin, MARGIN);
    let network = &traced.network;
    let position = |node: u32| place(network.nodes()[node as usize].position);
    let mut by_order: Vec<PathBuilder> = vec![PathBuilder::new(); usize::from(u8::MAX) + 1];
    let mut degree = vec![0_u32; network.nodes().len()];
    for edge in network.edges() {
        let (from, to) = (position(edge.from), position(edge.to));
        let path = &mut by_order[usize::from(edge.order)];
        path.move_to(from.x as f32, from.y as f32);
        path.line_to(to.x as f32, to.y as f32);
        degree[edge.from as usize] += 1;
        degree[edge.to as usize] += 1;
    }
    for (order, path) in by_order.into_iter().enumerate().rev() {
        stroke(&mut canvas, path, order_colour(order as u8));
    }
    let mut dots = PathBuilder::new();
    for (node, _) in (0..).zip(&degree).filter(|(_, degree)| **degree != 2) {
        let p = position(node);
        for way in [DVec2::X, DVec2::Y] {
            let (a, b) = (p - way * DOT, p + way * DOT);
            dots.move_to(a.x as f32, a.y as f32);
            dots.line_to(b.x as f32, b.y as f32);
        }
    }
    stroke(&mut canvas, dots, [0, 0, 0]);
    Ok(Drawing::of(&canvas))
}

fn stroke(canvas: &mut Pixmap, path: PathBuilder, [red, green, blue]: [u8; 3]) {
    let Some(path) = path.finish() else { return };
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 255);
    let line = Stroke {
        width: WIDTH,
        line_cap: LineCap::Round,
        ..Stroke::default()
    };
    canvas.stroke_path(&path, &paint, &line, Transform::identity(), None);
}
