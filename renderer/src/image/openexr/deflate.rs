//! Compression of the blocks of an `OpenEXR` file on all threads.
//!
//! - **In**: layers of single precision, in the order of their names.
//! - **Out**: for each 16 rows the bytes of a ZIP block of the format.
//! - **Always true**: a block depends on its rows alone, so the bytes do not depend on threads.

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use rayon::prelude::*;

use crate::image::picture::Layer;

/// Rows of a block, as the format prescribes for this compression.
const ROWS: usize = 16;
/// Effort of the compressor, 1 to 10. A fifth of the time of the `exr` crate's 4, for files 3 %
/// larger: the mantissas of rendered values are noise, and any effort compresses the exponents.
/// `docs/src/theory/paths.md` has the table.
const EFFORT: u8 = 1;

/// The blocks of a picture from top to bottom; layers are in the order of the file's channels.
pub(super) fn blocks(layers: &[&Layer], width: usize, height: usize) -> Vec<Chunk> {
    let starts: Vec<usize> = (0..height).step_by(ROWS).collect();
    let block = |&start: &usize| Chunk {
        layer_index: 0,
        compressed_block: CompressedBlock::ScanLine(CompressedScanLineBlock {
            y_coordinate: start as i32,
            compressed_pixels_le: compressed(layers, width, start..height.min(start + ROWS)),
        }),
    };
    starts.par_iter().map(block).collect()
}

/// Some rows, compressed.
///
/// # Source
///
/// `OpenEXR` File Layout, "Scan line blocks": row by row, in each channel by channel,
/// little-endian. The ZIP compressor of the reference implementation separates bytes at even and
/// odd places, then stores differences of neighbours plus 128. A block that does not get smaller is
/// stored uncompressed.
fn compressed(layers: &[&Layer], width: usize, rows: std::ops::Range<usize>) -> Vec<u8> {
    let mut plain = Vec::with_capacity(rows.len() * layers.len() * width * size_of::<f32>());
    for row in rows {
        for layer in layers {
            let values = &layer.data[row * width..][..width];
            plain.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        }
    }
    let even = plain.iter().step_by(2);
    let odd = plain.iter().skip(1).step_by(2);
    let mut before = None;
    let differences: Vec<u8> = even
        .chain(odd)
        .map(|&byte| {
            let difference =
                before.map_or(byte, |before| byte.wrapping_sub(before).wrapping_add(128));
            before = Some(byte);
            difference
        })
        .collect();
    let small = miniz_oxide::deflate::compress_to_vec_zlib(&differences, EFFORT);
    if small.len() < plain.len() {
        small
    } else {
        plain
    }
}
