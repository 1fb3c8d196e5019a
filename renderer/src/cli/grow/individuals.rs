//! Leaves of one plant: their plans in one file, or their margins and veins on one sheet.

use std::fmt::Write as _;
use std::sync::atomic::AtomicBool;

use glam::DVec2;
use leafmodel::export::{self, SvgStyle};
use leafmodel::plan_file::individuals_to_toml;
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;

use super::choice::Chosen;
use super::drawings::Page;
use super::outputs::{Kind, Outputs};
use super::{Grown, finish};
use crate::cli::Failure;
use crate::export::drawing::{Style, Subject, draw_within};
use crate::image::portable_network;

/// Refuses files that hold one leaf only.
pub(super) fn check(outputs: &Outputs) -> Result<(), Failure> {
    let is_good = |kind: &Kind| matches!(kind, Kind::Toml | Kind::Svg | Kind::Png);
    if outputs.whole.is_empty() || !outputs.whole.iter().all(|(_, kind)| is_good(kind)) {
        return Err(Failure::bad(
            "--individuals writes plans into one toml, or margins and veins side by side as svg or png: let --out end in one of \
             these; other files hold one leaf, such as `lamina grow FILE.toml#NAME` takes from the plans",
        ));
    }
    Ok(())
}

/// Writes leaves 1 to `count` of a plant.
pub(super) fn write(
    chosen: &Chosen,
    outputs: &Outputs,
    count: u16,
    pixels: u32,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let (name, plan, preset) = (chosen.name.as_str(), &chosen.plan, chosen.preset);
    let numbers = 1..=u64::from(count);
    let mut sheet = None;
    for (path, kind) in &outputs.whole {
        let bytes = match kind {
            Kind::Toml => individuals_to_toml(name, plan, preset, numbers.clone()).into_bytes(),
            Kind::Svg | Kind::Png => {
                if sheet.is_none() {
                    let leaves = numbers.clone().map(|number| {
                        let plan = plan.individual(preset, number);
                        let grown = Grown::new(&plan, false, stop)?;
                        let lamina = grown.lamina();
                        Ok(match grown.flat(&plan)? {
                            Some(flat) => Specimen {
                                bounds: flat.bounds(),
                                outlines: flat.outlines,
                                network: flat.network,
                            },
                            None => Specimen {
                                bounds: lamina.outline.bounds(),
                                outlines: vec![lamina.outline.clone()],
                                network: lamina.network.clone(),
                            },
                        })
                    });
                    let leaves: Result<Vec<Specimen>, Failure> = leaves.collect();
                    sheet = Some(Sheet::new(leaves?));
                }
                match &sheet {
                    Some(sheet) if *kind == Kind::Svg => sheet.svg().into_bytes(),
                    Some(sheet) => sheet.png(pixels)?,
                    None => Vec::new(),
                }
            }
            Kind::Gif
            | Kind::Apng
            | Kind::Mp4
            | Kind::Json
            | Kind::GraphMl
            | Kind::GeoJson
            | Kind::Csv
            | Kind::Ply
            | Kind::Obj => {
                continue;
            }
        };
        finish(path, &bytes, stop)?;
    }
    Ok(())
}

/// A leaf of the sheet.
struct Specimen {
    bounds: Page,
    outlines: Vec<Outline>,
    network: VenationNetwork,
}

/// Leaves side by side in rows, all at one scale, each in the middle of a cell of one size.
struct Sheet {
    leaves: Vec<Specimen>,
    columns: usize,
    /// Width and height of a cell, mm.
    cell: DVec2,
}

impl Sheet {
    fn new(leaves: Vec<Specimen>) -> Self {
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
    fn page(&self, leaf: &Specimen) -> Page {
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

    fn svg(&self) -> String {
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
    fn png(&self, pixels: u32) -> Result<Vec<u8>, Failure> {
        let across = self.cell.x * self.columns as f64;
        let down = self.cell.y * self.rows() as f64;
        let longer = self.cell.max_element() / across.max(down);
        let each = ((f64::from(pixels) * longer) as u32).max(8);
        let mut sheet: Option<([usize; 2], Vec<u8>)> = None;
        let mut size = [0; 2];
        for ([column, row], leaf) in self.placed() {
            let page = self.page(leaf);
            let subject = Subject {
                outlines: &leaf.outlines,
                network: &leaf.network,
                sources: &[],
            };
            let drawn = draw_within(page, subject, each, Style::OnPaper);
            let drawn = drawn.map_err(Failure::bad)?;
            size = [drawn.width as usize, drawn.height as usize];
            let (whole, rgb) = sheet.get_or_insert_with(|| {
                let whole = [size[0] * self.columns, size[1] * self.rows()];
                (whole, vec![255; 3 * whole[0] * whole[1]])
            });
            for (line, pixels) in drawn
                .rgb
                .chunks_exact(3 * size[0])
                .enumerate()
                .take(size[1])
            {
                let y = row * size[1] + line;
                let start = 3 * (y * whole[0] + column * size[0]);
                if let Some(place) = rgb.get_mut(start..start + pixels.len()) {
                    place.copy_from_slice(pixels);
                }
            }
        }
        let ([width, height], rgb) = sheet.unwrap_or((size, Vec::new()));
        portable_network::encoded(width as u32, height as u32, &rgb).map_err(Failure::bad)
    }
}
