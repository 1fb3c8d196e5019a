//! Memory that pictures take once they are read, from their headers alone.

use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

use image::{ImageReader, Limits};

use super::error::MOST_PIXELS;
use super::{openexr, portable_network};

/// Bytes of a pixel of a PNG, JPEG or Radiance HDR, while its colours are made: as stored, in 16
/// bits, and as three layers, which become one map.
const OF_A_PIXEL: f64 = 24.0;

/// Bytes that a picture takes while it is read; 0 of what is none, or larger than any that is read, since
/// reading reports that.
pub fn bytes_of_file(path: &Path) -> f64 {
    File::open(path).map_or(0.0, |file| bytes(BufReader::new(file)))
}

/// As [`bytes_of_file`], of the bytes of a file.
pub fn bytes(mut file: impl BufRead + Seek) -> f64 {
    let is_exr = |file: &[u8]| file.starts_with(openexr::MAGIC);
    if file.fill_buf().is_ok_and(is_exr) {
        return openexr::claimed_bytes(file);
    }
    let reader = ImageReader::new(file).with_guessed_format();
    let size = reader.ok().and_then(|mut reader| {
        let mut limits = Limits::default();
        limits.max_alloc = Some(portable_network::MOST_PROFILE);
        reader.limits(limits);
        reader.into_dimensions().ok()
    });
    let pixels = size.map_or(0, |(width, height)| u64::from(width) * u64::from(height));
    if pixels > MOST_PIXELS {
        return 0.0;
    }
    OF_A_PIXEL * pixels as f64
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::image::{Layer, Picture};

    #[test]
    fn headers_say_how_large_pictures_become() {
        let black = vec![0; 3 * 40 * 30];
        let png = portable_network::encoded(40, 30, &black).expect("three values per pixel");
        assert_eq!(bytes(Cursor::new(png)), OF_A_PIXEL * 1200.0);
        let layer = |name: &str| Layer::new(name, vec![0.0; 1200]);
        let picture = Picture {
            width: 40,
            height: 30,
            layers: ["R", "G", "B"].map(layer).into(),
            ..Picture::default()
        };
        let exr = openexr::encode(&picture).expect("it has pixels");
        assert_eq!(bytes(Cursor::new(exr)), OF_A_PIXEL * 1200.0);
        assert_eq!(bytes(Cursor::new(b"no picture")), 0.0);
    }
}
