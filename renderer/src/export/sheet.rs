//! Leaves of one plant side by side, as a drawing and as a picture.

use std::fmt::Write as _;

use glam::DVec2;
use image::imageops::replace;
use image::{Rgb, RgbImage};
use leafmodel::export::{self, SvgStyle};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;

use super::drawing::{Style, Subject, draw_within};
use crate::image::{ImageError, portable_network};

/// Lower left and upper right corner of what a picture shows, mm.
type SheetPage = (DVec2, DVec2);

/// A leaf of the sheet.
pub(crate) struct Specimen {
    pub(crate) bounds: SheetPage,
    pub(crate) outlines: Vec<Outline>,
    pub(crate) network: VenationNetwork,
}

/// Leaves side by side in rows, all at one scale, each in the middle of a cell of one size.
pub(crate) struct Sheet {
    leaves: Vec<Specimen>,
    columns: usize,
    /// Width and height of a cell, mm.
    cell: DVec2,
}

impl Sheet {
    pub(crate) fn new(leaves: Vec<Specimen>) -> Self {
        let sizes = leaves.iter().map(|leaf| leaf.bounds.1 - leaf.bounds.0);
        let cell = sizes.fold(DVec2::ZERO, DVec2::max);
        // About half again as wide as high.
        let count = leaves.len() as f64;
        let columns = (1.5 * count * cell.y / cell.x).sqrt().round();
        Self {
            columns: (columns as usize).clamp(1, leaves.len().max(1)),
            leaves,
            cell,
        }
    }

    /// The part of the plane that a leaf's cell shows.
    fn page(&self, leaf: &Specimen) -> SheetPage {
        let middle = (leaf.bounds.0 + leaf.bounds.1) * 0.5;
        (middle - self.cell * 0.5, middle + self.cell * 0.5)
    }

    /// Column and row of each leaf.
    fn placed(&self) -> impl Iterator<Item = ([usize; 2], &Specimen)> {
        let columns = self.columns;
        let numbered = self.leaves.iter().enumerate();
        numbered.map(move |(i, leaf)| ([i % columns, i / columns], leaf))
    }

    fn rows(&self) -> usize {
        self.leaves.len().div_ceil(self.columns)
    }

    /// The drawings of all leaves in one.
    pub(crate) fn svg(&self) -> String {
        let cell = self.cell * 1.08;
        let wide = cell.x * self.columns as f64;
        let high = cell.y * self.rows() as f64;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide:.3}mm\" height=\"{high:.3}mm\" \
             viewBox=\"0 0 {wide:.3} {high:.3}\">\n"
        );
        for (number, ([column, row], leaf)) in self.placed().enumerate() {
            let drawn = export::svg_within(
                self.page(leaf),
                &leaf.outlines,
                &leaf.network,
                SvgStyle::default(),
            );
            let (x, y) = (cell.x * column as f64, cell.y * row as f64);
            // Within a drawing `id`s are those of one leaf.
            let drawn = drawn.replace(" id=\"", &format!(" id=\"leaf-{}-", number + 1));
            let placed = drawn.replacen(
                "<svg xmlns=\"http://www.w3.org/2000/svg\"",
                &format!("<svg x=\"{x:.3}\" y=\"{y:.3}\""),
                1,
            );
            // Lengths of an inner drawing are in units of the outer one.
            let placed = placed.replacen("mm\" height=\"", "\" height=\"", 1);
            let placed = placed.replacen("mm\" viewBox", "\" viewBox", 1);
            let _ = writeln!(text, "{placed}");
        }
        text += "</svg>\n";
        text
    }

    /// `pixels` along the longer side.
    ///
    /// # Errors
    ///
    /// Those of a drawing that is too large.
    pub(crate) fn png(&self, pixels: u32) -> Result<Vec<u8>, ImageError> {
        let across = self.cell.x * self.columns as f64;
        let down = self.cell.y * self.rows() as f64;
        let longer = self.cell.max_element() / across.max(down);
        let each = ((f64::from(pixels) * longer) as u32).max(8);
        let mut sheet: Option<RgbImage> = None;
        for ([column, row], leaf) in self.placed() {
            let subject = Subject {
                outlines: &leaf.outlines,
                network: &leaf.network,
                sources: &[],
            };
            let drawn = draw_within(self.page(leaf), subject, each, Style::OnPaper)?;
            let [wide, high] = [drawn.width, drawn.height];
            let drawn = RgbImage::from_raw(wide, high, drawn.rgb);
            let drawn = drawn.expect("a drawing has all of its pixels");
            let sheet = sheet.get_or_insert_with(|| {
                let size = [wide * self.columns as u32, high * self.rows() as u32];
                RgbImage::from_pixel(size[0], size[1], Rgb([255; 3]))
            });
            let place = [wide as usize * column, high as usize * row];
            replace(sheet, &drawn, place[0] as i64, place[1] as i64);
        }
        let sheet = sheet.unwrap_or_default();
        portable_network::encoded(sheet.width(), sheet.height(), &sheet)
    }
}
