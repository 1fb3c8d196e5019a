//! A strip below a drawing that says how large and how old what it shows is, and what its colours
//! mean.
//!
//! - **In**: a [`Drawing`], and the [`Note`]s for its strip.
//! - **Out**: the drawing with a white strip below it, as wide as both need.
//! - **Always true**: notes of equal lengths take equal places, so that a strip stands still while
//!   a leaf grows above it. The same notes give the same bytes.
//! - **Left out**: letters beyond those of ASCII and Latin-1; they are drawn as question marks.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::drawing::Drawing;

/// A thing that a strip shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// A bar of a round length with that length.
    ScaleBar {
        /// Pixels of the drawing to a millimetre.
        pixels_per_mm: f64,
    },
    /// Words.
    Text(String),
    /// Squares of colours, each with its meaning.
    Swatches(Vec<([u8; 3], String)>),
    /// A row of colours between what its ends mean.
    Ramp {
        /// Colours from the first end to the last.
        colours: Vec<[u8; 3]>,
        /// What the ends mean.
        ends: [String; 2],
    },
}

const INK: [u8; 3] = [40, 40, 40];
const PAPER: u8 = 255;

/// Longest scale bar, as a share of the drawing's width.
const LONGEST_BAR: f64 = 0.3;

/// Adds a strip with notes below a drawing. Notes that do not fit beside each other stand in
/// several lines; a drawing that is narrower than the widest note stands in the middle.
pub fn captioned(drawing: &Drawing, notes: &[Note]) -> Drawing {
    let type_size = TypeSize::for_picture(drawing.width.max(drawing.height) as usize);
    let items: Vec<Item> = notes
        .iter()
        .map(|note| Item::new(note, drawing.width as usize, type_size))
        .collect();
    let gap = type_size.height();
    let widest = items.iter().map(|item| item.width).max();
    let width = (drawing.width as usize).max(widest.unwrap_or(0) + 2 * (gap / 2));
    let lines = in_lines(&items, width - 2 * (gap / 2), gap);
    let line_height = type_size.height() + gap / 2;
    let drawn = drawing.height as usize;
    let height = drawn + lines.len() * line_height + gap / 2;
    let mut sheet = CaptionSheet {
        width,
        rgb: vec![PAPER; 3 * width * height],
    };
    let aside = (width - drawing.width as usize) / 2;
    let row_length = 3 * drawing.width as usize;
    for (row, pixels) in drawing.rgb.chunks_exact(row_length).enumerate() {
        let start = 3 * (row * width + aside);
        sheet.rgb[start..start + row_length].copy_from_slice(pixels);
    }
    for (line, items) in lines.iter().enumerate() {
        let top = drawn + gap / 4 + line * line_height;
        // The first item stands left, the last right, the others evenly between.
        let taken: usize = items.iter().map(|item| item.width).sum();
        let free = width - 2 * (gap / 2) - taken;
        let between = free / (items.len().saturating_sub(1)).max(1);
        let mut left = gap / 2;
        for item in items {
            item.draw(&mut sheet, [left, top], type_size);
            left += item.width + between;
        }
    }
    Drawing {
        width: width as u32,
        height: height as u32,
        rgb: sheet.rgb,
    }
}

/// Items that fit into lines of `width` with `gap` between them, in their order.
fn in_lines(items: &[Item], width: usize, gap: usize) -> Vec<Vec<&Item>> {
    let mut lines: Vec<Vec<&Item>> = Vec::new();
    let mut room = 0;
    for item in items {
        match lines.last_mut() {
            Some(line) if room >= item.width + gap => {
                room -= item.width + gap;
                line.push(item);
            }
            Some(_) | None => {
                room = width - item.width.min(width);
                lines.push(vec![item]);
            }
        }
    }
    lines
}

/// The longest of 1, 2, 5, 10, 20 … and 0.5, 0.2 … millimetres of which at most `most` fit.
fn round_length(most: f64) -> f64 {
    // Powers of ten by multiplication: exact where they are whole.
    let mut power = 1.0;
    while power * 10.0 <= most {
        power *= 10.0;
    }
    let mut parts = 1.0;
    while power / parts > most && parts < 1e9 {
        parts *= 10.0;
    }
    let unit = power / parts;
    let steps = [5.0, 2.0, 1.0];
    let step = steps.into_iter().find(|step| step * unit <= most);
    step.unwrap_or(1.0) * unit
}

/// A note with its size, measured.
struct Item {
    width: usize,
    pieces: Vec<CaptionPiece>,
}

/// A part of an item, from its left end.
enum CaptionPiece {
    Words(usize, String),
    /// Left, width, height as share of the line, colours from left to right.
    Bar(usize, usize, f64, Vec<[u8; 3]>),
}

impl Item {
    fn new(note: &Note, picture_width: usize, type_size: TypeSize) -> Self {
        let letter = type_size.letter();
        let side = (type_size.height() * 5 / 8).max(4);
        let mut item = Self {
            width: 0,
            pieces: Vec::new(),
        };
        match note {
            Note::Text(words) => item.words(words, letter),
            Note::ScaleBar { pixels_per_mm } => {
                let most = LONGEST_BAR * picture_width as f64 / pixels_per_mm;
                let length = round_length(most.max(1e-6));
                let pixels = ((length * pixels_per_mm).round() as usize).max(1);
                item.bar(pixels, 0.2, vec![INK]);
                item.width += letter;
                item.words(&format!("{length} mm"), letter);
            }
            Note::Swatches(swatches) => {
                for (number, (colour, meaning)) in swatches.iter().enumerate() {
                    item.width += if number > 0 { 2 * letter } else { 0 };
                    item.bar(side, side as f64 / type_size.height() as f64, vec![*colour]);
                    item.width += letter / 2;
                    item.words(meaning, letter);
                }
            }
            Note::Ramp { colours, ends } => {
                item.words(&ends[0], letter);
                item.width += letter;
                item.bar(10 * letter, 0.45, colours.clone());
                item.width += letter;
                item.words(&ends[1], letter);
            }
        }
        item
    }

    fn words(&mut self, words: &str, letter: usize) {
        self.pieces
            .push(CaptionPiece::Words(self.width, words.to_owned()));
        self.width += words.chars().count() * letter;
    }

    fn bar(&mut self, width: usize, height: f64, colours: Vec<[u8; 3]>) {
        self.pieces
            .push(CaptionPiece::Bar(self.width, width, height, colours));
        self.width += width;
    }

    fn draw(&self, sheet: &mut CaptionSheet, [left, top]: [usize; 2], type_size: TypeSize) {
        for piece in &self.pieces {
            match piece {
                CaptionPiece::Words(at, words) => sheet.words([left + at, top], words, type_size),
                CaptionPiece::Bar(at, width, share, colours) => {
                    let full = type_size.height();
                    let height = ((full as f64 * share).round() as usize).max(1);
                    let top = top + (full - height.min(full)) / 2;
                    for x in 0..*width {
                        let colour = colours[(x * colours.len() / width).min(colours.len() - 1)];
                        for y in 0..height {
                            sheet.mix([left + at + x, top + y], colour, 255);
                        }
                    }
                }
            }
        }
    }
}

/// The letters that a picture of a size has.
#[derive(Clone, Copy, Debug)]
struct TypeSize(RasterHeight);

impl TypeSize {
    /// About a fortieth of the longer side.
    fn for_picture(longer: usize) -> Self {
        Self(match longer {
            ..640 => RasterHeight::Size16,
            640..900 => RasterHeight::Size20,
            900..1300 => RasterHeight::Size24,
            _ => RasterHeight::Size32,
        })
    }

    fn height(self) -> usize {
        self.0.val()
    }

    fn letter(self) -> usize {
        get_raster_width(FontWeight::Regular, self.0)
    }
}

/// Pixels that are drawn on.
struct CaptionSheet {
    width: usize,
    rgb: Vec<u8>,
}

impl CaptionSheet {
    fn words(&mut self, [left, top]: [usize; 2], words: &str, type_size: TypeSize) {
        for (number, letter) in words.chars().enumerate() {
            let raster = |letter| get_raster(letter, FontWeight::Regular, type_size.0);
            let Some(glyph) = raster(letter).or_else(|| raster('?')) else {
                continue;
            };
            let left = left + number * type_size.letter();
            for (y, row) in glyph.rows().enumerate() {
                for (x, &strength) in row.iter().enumerate() {
                    self.mix([left + x, top + y], INK, strength);
                }
            }
        }
    }

    /// Mixes a colour into a pixel, between sRGB values as drawings do.
    fn mix(&mut self, [x, y]: [usize; 2], colour: [u8; 3], strength: u8) {
        if x >= self.width {
            return;
        }
        let start = 3 * (y * self.width + x);
        let Some(pixel) = self.rgb.get_mut(start..start + 3) else {
            return;
        };
        for (value, ink) in pixel.iter_mut().zip(colour) {
            let (below, above) = (u32::from(*value), u32::from(ink));
            let strength = u32::from(strength);
            *value = ((below * (255 - strength) + above * strength + 127) / 255) as u8;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(width: u32, height: u32) -> Drawing {
        Drawing {
            width,
            height,
            rgb: vec![200; 3 * width as usize * height as usize],
        }
    }

    /// Columns of the first row below the drawing's in which every pixel of a run is ink.
    fn longest_run_of_ink(drawing: &Drawing, from_row: u32) -> usize {
        let width = drawing.width as usize;
        let rows = drawing.rgb.chunks_exact(3 * width);
        let runs = rows.skip(from_row as usize).map(|row| {
            let pixels = row.chunks_exact(3);
            let (_, longest) = pixels.fold((0, 0), |(run, longest), pixel| {
                let run = if pixel == INK { run + 1 } else { 0 };
                (run, longest.max(run))
            });
            longest
        });
        runs.max().unwrap_or(0)
    }

    #[test]
    fn lengths_of_bars_are_round_and_fit() {
        for (most, expected) in [
            (30.0, 20.0),
            (20.0, 20.0),
            (19.9, 10.0),
            (7.2, 5.0),
            (1.9, 1.0),
            (0.9, 0.5),
            (0.0213, 0.02),
            (4999.0, 2000.0),
        ] {
            let found = round_length(most);
            assert!((found / expected - 1.0).abs() < 1e-12, "{most}: {found}");
        }
    }

    #[test]
    fn a_bar_is_as_long_as_it_says() {
        // 4 pixels to a millimetre, 500 wide: 37.5 mm are 0.3 of it, so the bar is 20 mm.
        let drawing = grey(500, 300);
        let with = captioned(&drawing, &[Note::ScaleBar { pixels_per_mm: 4.0 }]);
        assert_eq!(with.width, 500);
        assert!(with.height > 300);
        assert_eq!(with.rgb[..drawing.rgb.len()], drawing.rgb);
        assert_eq!(longest_run_of_ink(&with, 300), 80);
    }

    #[test]
    fn a_strip_is_still_and_a_narrow_drawing_is_set_in_the_middle() {
        let notes = |step: &str| {
            let swatches = (1..=7).map(|order| ([10, 20, 30], order.to_string()));
            [
                Note::ScaleBar { pixels_per_mm: 4.0 },
                Note::Swatches(swatches.collect()),
                Note::Text(format!("step {step} of 400")),
            ]
        };
        let narrow = grey(60, 300);
        let [early, late] = ["  7", "391"].map(|step| captioned(&narrow, &notes(step)));
        assert_eq!((early.width, early.height), (late.width, late.height));
        assert!(early.width > 60);
        let aside = (early.width as usize - 60) / 2;
        let first = &early.rgb[..3 * early.width as usize];
        assert!(first[..3 * aside].iter().all(|&value| value == PAPER));
        assert_eq!(&first[3 * aside..3 * (aside + 60)], &narrow.rgb[..180]);
        assert_ne!(early, late);
        // Nothing is lost: three notes take more than one line here, and one on a wide sheet.
        let wide = captioned(&grey(1000, 300), &notes("391"));
        assert_eq!(wide.width, 1000);
        assert!(wide.height - 300 < late.height - 300);
    }
}
