//! Films without sound: GIF, which everything shows, and APNG, which has every colour.
//!
//! - **In**: frames of 8-bit sRGB, all of one size, in their order.
//! - **Out**: the bytes of a file that repeats without end.
//! - **Always true**: an APNG has the frames as they are. A GIF has at most 256 colours a frame,
//!   exactly if a frame has no more. Of a frame only the rectangle that differs from the frame
//!   before is stored. The same frames give the same bytes.
//! - **Left out**: films as phones make them; `lamina grow` gives frames to another program for
//!   those.
//!
//! ```
//! use renderer::image::animation::{Animation, Format, Timing};
//!
//! let timing = Timing { frames_per_second: 12.0, last_frame_seconds: 1.0 };
//! let mut film = Animation::new(Format::Gif, [2, 1], 2, timing)?;
//! film.push(&[[255; 6]])?;
//! film.push(&[[0; 6]])?;
//! let bytes = film.finish()?;
//! assert_eq!(bytes[..6], *b"GIF89a");
//! # Ok::<(), renderer::image::ImageError>(())
//! ```

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use color_quant::NeuQuant;
use rayon::prelude::*;

use super::error::{ImageError, MOST_BYTES, check_size};
use super::portable_network::encoder;

/// The unit of delays in a GIF: a hundredth of a second.
const GIF_TICKS: f64 = 100.0;

/// The unit of delays in an APNG as written here: a millisecond.
const APNG_TICKS: f64 = 1000.0;

/// The longest delay that both formats hold, in their units.
const LONGEST_DELAY: f64 = 65535.0;

/// Kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Graphics Interchange Format 89a.
    Gif,
    /// PNG with the chunks of animations (third edition of the PNG specification).
    Apng,
}

/// How long frames are shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Frames a second, > 0.
    pub frames_per_second: f64,
    /// Seconds for which the last frame is shown before the film begins anew, ≥ 0; a frame's time
    /// at least.
    pub last_frame_seconds: f64,
}

impl Timing {
    /// The delay after frame `number` of `count`, whole ticks. Delays are rounded so that their
    /// sum stays true.
    fn delay(self, number: u32, count: u32, ticks: f64) -> u16 {
        let until = |number: u32| (f64::from(number) * ticks / self.frames_per_second).round();
        let regular = until(number + 1) - until(number);
        let delay = if number + 1 == count {
            regular.max((self.last_frame_seconds * ticks).round())
        } else {
            regular
        };
        delay.clamp(1.0, LONGEST_DELAY) as u16
    }
}

/// A film that is being written.
pub struct Animation {
    size: [u32; 2],
    count: u32,
    written: u32,
    timing: Timing,
    /// The frame before.
    shown: Vec<u8>,
    encoder: Encoder,
    bytes: Shared,
}

enum Encoder {
    Gif(gif::Encoder<Shared>),
    Apng(Box<png::Writer<Shared>>),
}

impl Animation {
    /// Begins a film of `count` frames of `size` pixels.
    ///
    /// # Errors
    ///
    /// [`ImageError::Inconsistent`] if there are no frames, the times are not finite and positive,
    /// or a side of a GIF is over 65 535; [`ImageError::TooLarge`].
    pub fn new(
        format: Format,
        size: [u32; 2],
        count: u32,
        timing: Timing,
    ) -> Result<Self, ImageError> {
        let [width, height] = size;
        check_size(width, height, 3, 3, MOST_BYTES)?;
        let is_positive = timing.frames_per_second > 0.0 && timing.frames_per_second.is_finite();
        let is_timed = is_positive && timing.last_frame_seconds.is_finite();
        if !is_timed || count == 0 || width * height == 0 {
            let what = "a film needs frames, pixels and times";
            return Err(ImageError::inconsistent(what));
        }
        let bytes = Shared::default();
        let encoder = match format {
            Format::Gif => {
                let what = |_| ImageError::inconsistent("sides of a gif are at most 65535");
                let side = |side: u32| u16::try_from(side).map_err(what);
                let (width, height) = (side(width)?, side(height)?);
                let encoder = gif::Encoder::new(bytes.clone(), width, height, &[]);
                let encoder = encoder.and_then(|mut encoder| {
                    encoder.set_repeat(gif::Repeat::Infinite)?;
                    Ok(encoder)
                });
                Encoder::Gif(encoder.map_err(ImageError::inconsistent)?)
            }
            Format::Apng => {
                let kind = (png::ColorType::Rgb, png::BitDepth::Eight);
                let writer = encoder(bytes.clone(), size, kind).and_then(|mut encoder| {
                    encoder.set_animated(count, 0)?;
                    encoder.write_header()
                });
                Encoder::Apng(Box::new(writer.map_err(ImageError::inconsistent)?))
            }
        };
        Ok(Self {
            size,
            count,
            written: 0,
            timing,
            shown: Vec::new(),
            encoder,
            bytes,
        })
    }

    /// Adds frames: red, green and blue by row, from the top, and column.
    ///
    /// # Errors
    ///
    /// [`ImageError::Inconsistent`] if there are more frames than were told, or one has another
    /// size.
    pub fn push(&mut self, frames: &[impl AsRef<[u8]> + Sync]) -> Result<(), ImageError> {
        let length = 3 * self.size[0] as usize * self.size[1] as usize;
        if frames.iter().any(|frame| frame.as_ref().len() != length) {
            let what = "a frame of another size than its film";
            return Err(ImageError::inconsistent(what));
        }
        if frames.len() > (self.count - self.written) as usize {
            return Err(ImageError::inconsistent("more frames than were told"));
        }
        let width = self.size[0] as usize;
        let rectangles: Vec<Rectangle> = (0..frames.len())
            .map(|i| {
                let before = if i > 0 {
                    frames[i - 1].as_ref()
                } else {
                    &self.shown
                };
                Rectangle::of_difference(before, frames[i].as_ref(), width)
            })
            .collect();
        let first = self.written;
        let delay = |i: usize, ticks| self.timing.delay(first + i as u32, self.count, ticks);
        match &mut self.encoder {
            Encoder::Gif(encoder) => {
                // To choose the colours costs most.
                let frames = frames.par_iter().map(AsRef::as_ref).zip(&rectangles);
                let quantised: Vec<gif::Frame> = frames
                    .map(|(frame, rectangle)| {
                        let pixels = rectangle.cut(frame, width);
                        let [wide, high] = rectangle.size.map(|side| side as u16);
                        let (indices, palette) = few_colours(&pixels);
                        let mut frame =
                            gif::Frame::from_palette_pixels(wide, high, indices, palette, None);
                        [frame.left, frame.top] = rectangle.corner.map(|at| at as u16);
                        frame.dispose = gif::DisposalMethod::Keep;
                        frame
                    })
                    .collect();
                for (i, mut frame) in quantised.into_iter().enumerate() {
                    frame.delay = delay(i, GIF_TICKS);
                    encoder
                        .write_frame(&frame)
                        .map_err(ImageError::inconsistent)?;
                }
            }
            Encoder::Apng(writer) => {
                for (i, (frame, rectangle)) in frames.iter().zip(&rectangles).enumerate() {
                    let pixels = rectangle.cut(frame.as_ref(), width);
                    let [wide, high] = rectangle.size.map(|side| side as u32);
                    let [left, top] = rectangle.corner.map(|at| at as u32);
                    writer
                        .reset_frame_position()
                        .and_then(|()| writer.set_frame_dimension(wide, high))
                        .and_then(|()| writer.set_frame_position(left, top))
                        .and_then(|()| {
                            writer.set_frame_delay(delay(i, APNG_TICKS), APNG_TICKS as u16)
                        })
                        .and_then(|()| writer.set_blend_op(png::BlendOp::Source))
                        .and_then(|()| writer.set_dispose_op(png::DisposeOp::None))
                        .and_then(|()| writer.write_image_data(&pixels))
                        .map_err(ImageError::inconsistent)?;
                }
            }
        }
        self.written += frames.len() as u32;
        if let Some(last) = frames.last() {
            last.as_ref().clone_into(&mut self.shown);
        }
        Ok(())
    }

    /// The bytes of the file.
    ///
    /// # Errors
    ///
    /// [`ImageError::Inconsistent`] if there are fewer frames than were told.
    pub fn finish(self) -> Result<Vec<u8>, ImageError> {
        if self.written != self.count {
            return Err(ImageError::inconsistent("fewer frames than were told"));
        }
        match self.encoder {
            // The end of a GIF is written when its encoder goes.
            Encoder::Gif(encoder) => drop(encoder.into_inner().map_err(ImageError::inconsistent)?),
            Encoder::Apng(writer) => writer.finish().map_err(ImageError::inconsistent)?,
        }
        Ok(self.bytes.take())
    }
}

/// The most colours that a frame of a GIF has.
const MOST_COLOURS: usize = 256;

/// How many of the most frequent colours a frame keeps as they are; the others are merged.
const KEPT_COLOURS: usize = 64;

/// The number of each pixel's colour in a palette, and the palette.
///
/// Where there are too many colours, those that take little of the picture would get hardly any of
/// the palette, though they are what one looks at: lines, dots, keys. So each counts by the root of
/// its number of pixels.
fn few_colours(pixels: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let all = || pixels.chunks_exact(3).map(|p| [p[0], p[1], p[2]]);
    let mut counts: BTreeMap<[u8; 3], u32> = BTreeMap::new();
    for colour in all() {
        *counts.entry(colour).or_default() += 1;
    }
    let mut colours: Vec<([u8; 3], u32)> = counts.into_iter().collect();
    let mut palette: Vec<[u8; 3]>;
    if colours.len() <= MOST_COLOURS {
        palette = colours.iter().map(|(colour, _)| *colour).collect();
    } else {
        colours.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let (kept, merged) = colours.split_at(KEPT_COLOURS);
        palette = kept.iter().map(|(colour, _)| *colour).collect();
        let examples = merged.iter().flat_map(|([r, g, b], count)| {
            let weight = f64::from(*count).sqrt().ceil() as usize;
            std::iter::repeat_n([*r, *g, *b, 255], weight).flatten()
        });
        let examples: Vec<u8> = examples.collect();
        let net = NeuQuant::new(1, MOST_COLOURS - KEPT_COLOURS, &examples);
        let found = net.color_map_rgb();
        palette.extend(found.chunks_exact(3).map(|p| [p[0], p[1], p[2]]));
    }
    let off = |a: [u8; 3], b: [u8; 3]| -> u32 {
        let offs = a.into_iter().zip(b);
        offs.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let nearest = |colour: [u8; 3]| {
        let near = (0..palette.len()).min_by_key(|&i| off(palette[i], colour));
        near.unwrap_or(0) as u8
    };
    let numbers: BTreeMap<[u8; 3], u8> = colours
        .iter()
        .map(|(colour, _)| (*colour, nearest(*colour)))
        .collect();
    (
        all().map(|colour| numbers[&colour]).collect(),
        palette.concat(),
    )
}

/// A part of a frame, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rectangle {
    corner: [usize; 2],
    size: [usize; 2],
}

impl Rectangle {
    /// The least that holds all pixels that differ; a pixel if none does, all if there is no
    /// frame before.
    fn of_difference(before: &[u8], frame: &[u8], width: usize) -> Self {
        let height = frame.len() / (3 * width);
        if before.len() != frame.len() {
            return Self {
                corner: [0, 0],
                size: [width, height],
            };
        }
        let (mut low, mut high) = ([width, height], [0, 0]);
        let rows = before
            .chunks_exact(3 * width)
            .zip(frame.chunks_exact(3 * width));
        for (y, (before, frame)) in rows.enumerate().filter(|(_, (a, b))| a != b) {
            let pixels = || before.chunks_exact(3).zip(frame.chunks_exact(3));
            let first = pixels().position(|(a, b)| a != b).unwrap_or(0);
            let last = pixels().rposition(|(a, b)| a != b).unwrap_or(0);
            low = [low[0].min(first), low[1].min(y)];
            high = [high[0].max(last + 1), high[1].max(y + 1)];
        }
        if high == [0, 0] {
            (low, high) = ([0, 0], [1, 1]);
        }
        Self {
            corner: low,
            size: [high[0] - low[0], high[1] - low[1]],
        }
    }

    /// Its pixels.
    fn cut(&self, frame: &[u8], width: usize) -> Vec<u8> {
        let rows = frame.chunks_exact(3 * width);
        let rows = rows.skip(self.corner[1]).take(self.size[1]);
        let (from, to) = (self.corner[0], self.corner[0] + self.size[0]);
        rows.flat_map(|row| &row[3 * from..3 * to])
            .copied()
            .collect()
    }
}

/// Bytes to which an encoder writes and which outlive it.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Shared {
    fn take(&self) -> Vec<u8> {
        let mut bytes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut bytes)
    }
}

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder as _;

    use super::*;

    const SIZE: [u32; 2] = [40, 30];

    const TIMING: Timing = Timing {
        frames_per_second: 12.0,
        last_frame_seconds: 1.5,
    };

    /// A disc of many greens that grows and moves on white.
    fn frame(number: u32) -> Vec<u8> {
        let mut rgb = Vec::new();
        for y in 0..SIZE[1] {
            for x in 0..SIZE[0] {
                let from = [x as f64 - 10.0 - f64::from(number), f64::from(y) - 15.0];
                let away = from[0].hypot(from[1]) / (3.0 + f64::from(number));
                rgb.extend(if away < 1.0 {
                    [(200.0 * away) as u8, 140, (7 * x + y) as u8]
                } else {
                    [255; 3]
                });
            }
        }
        rgb
    }

    fn film(format: Format, frames: &[Vec<u8>]) -> Vec<u8> {
        let count = frames.len() as u32;
        let mut film = Animation::new(format, SIZE, count, TIMING).expect("a film");
        for group in frames.chunks(3) {
            film.push(group).expect("frames");
        }
        film.finish().expect("all frames")
    }

    #[test]
    fn an_apng_read_by_another_decoder_has_every_pixel_and_delay() {
        let frames: Vec<Vec<u8>> = [0, 1, 2, 2, 3].map(frame).into();
        let bytes = film(Format::Apng, &frames);
        assert_eq!(bytes, film(Format::Apng, &frames));
        let decoder = image::codecs::png::PngDecoder::new(io::Cursor::new(&bytes));
        let decoder = decoder.expect("a PNG").apng().expect("an animation");
        let read = decoder.into_frames().collect_frames().expect("good frames");
        assert_eq!(read.len(), 5);
        let mut seconds = 0.0;
        for (read, frame) in read.iter().zip(&frames) {
            let rgb: Vec<u8> = read
                .buffer()
                .pixels()
                .flat_map(|p| [p[0], p[1], p[2]])
                .collect();
            assert!(rgb == *frame);
            let (over, under) = read.delay().numer_denom_ms();
            seconds += f64::from(over) / f64::from(under) / 1000.0;
        }
        assert!((seconds - (4.0 / 12.0 + 1.5)).abs() < 1e-3, "{seconds}");
    }

    #[test]
    fn a_gif_read_back_has_few_colours_exactly_and_many_nearly() {
        let two_colours: Vec<Vec<u8>> = (0..4)
            .map(|number| {
                let paler = frame(number).into_iter();
                paler
                    .map(|value| if value == 255 { 255 } else { 90 })
                    .collect()
            })
            .collect();
        let many: Vec<Vec<u8>> = (0..4).map(frame).collect();
        for (frames, worst) in [(two_colours, 0), (many, 12)] {
            let bytes = film(Format::Gif, &frames);
            assert_eq!(bytes, film(Format::Gif, &frames));
            let mut options = gif::DecodeOptions::new();
            options.set_color_output(gif::ColorOutput::RGBA);
            let mut decoder = options.read_info(&bytes[..]).expect("a GIF");
            assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
            let mut screen = vec![0_u8; 3 * (SIZE[0] * SIZE[1]) as usize];
            let mut ticks = 0;
            for frame in &frames {
                let part = decoder.read_next_frame().expect("good").expect("a frame");
                ticks += u32::from(part.delay);
                for y in 0..part.height {
                    for x in 0..part.width {
                        let from = 4 * (usize::from(y) * usize::from(part.width) + usize::from(x));
                        let row = usize::from(part.top + y) * SIZE[0] as usize;
                        let to = 3 * (row + usize::from(part.left + x));
                        screen[to..to + 3].copy_from_slice(&part.buffer[from..from + 3]);
                    }
                }
                let off = screen.iter().zip(frame).map(|(a, b)| a.abs_diff(*b)).max();
                assert!(off <= Some(worst), "{off:?}");
            }
            assert!(decoder.read_next_frame().expect("an end").is_none());
            assert_eq!(ticks, 25 + 150);
        }
    }

    #[test]
    fn wrong_frames_are_refused() {
        for format in [Format::Gif, Format::Apng] {
            let begun = |count| Animation::new(format, SIZE, count, TIMING);
            assert!(begun(0).is_err());
            let mut film = begun(1).expect("a film");
            assert!(film.push(&[vec![0_u8; 3]]).is_err());
            assert!(film.push(&[frame(0), frame(1)]).is_err());
            assert!(film.finish().is_err());
            let never = Timing {
                frames_per_second: 0.0,
                ..TIMING
            };
            assert!(Animation::new(format, SIZE, 1, never).is_err());
        }
    }
}
