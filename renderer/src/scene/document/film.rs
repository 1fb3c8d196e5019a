//! `[film.rgb]`, `[film.spectral]` and `[picture]`.

use super::limits::Limits;
use super::reader::Block;
use super::tree::Value;
use super::values::{integers_at, number_at, wrong_length, wrong_type};
use crate::scene::description::{Band, Film, FilmKind, Picture, Tone};
use crate::scene::error::SceneError;
use crate::scene::nearest::nearest;
use crate::scene::source::escaped;

/// Wavelengths that the renderer knows, nm.
pub(crate) const WAVELENGTHS_NM: [f64; 2] = [360.0, 2500.0];
/// Most pixels along one side; both sides at most give 2^28 pixels.
const MOST_PIXELS: u64 = 16384;
/// Most samples a pixel.
const MOST_SAMPLES: u64 = 65536 * 16;
const MOST_BANDS: usize = 32;

/// Reads `[film]`, and tells the context which wavelengths it needs.
pub(crate) fn read_film(parent: &Block<'_>) -> Option<Film> {
    let film = parent.block("film", &["rgb", "spectral"])?;
    let (variant, block) = film.variant(&["rgb", "spectral"])?;
    let size = block
        .needed("size", || {
            "`size = [640, 480]`, pixels across and down".to_owned()
        })
        .and_then(|node| integers_at::<2>(block.cx, node, "size", 1, MOST_PIXELS));
    let spp = block.integer("spp", 1, MOST_SAMPLES);
    let noise = block.number_or("noise", Limits::closed(0.0, 1.0), 0.0);
    let seed = block.integer_or("seed", 0, u64::MAX, 0);
    let default_radius = if variant == "rgb" { 1.5 } else { 0.0 };
    let filter_radius =
        block.number_or("filter_radius_px", Limits::closed(0.0, 8.0), default_radius);
    let kind = if variant == "rgb" {
        read_range(&block).map(|range_nm| FilmKind::Rgb { range_nm })
    } else {
        read_bands(&block).map(|bands| FilmKind::Spectral { bands })
    };
    block.cx.range_nm.set(kind.as_ref().map(needed_range));
    block.finish();
    let [width, height] = size?.map(|pixels| pixels as u32);
    Some(Film {
        width,
        height,
        spp: spp? as u32,
        noise: (noise > 0.0).then_some(noise),
        seed,
        filter_radius,
        kind: kind?,
    })
}

/// First and last wavelength of which a film needs data, nm.
fn needed_range(kind: &FilmKind) -> [f64; 2] {
    match kind {
        FilmKind::Rgb { range_nm } => *range_nm,
        FilmKind::Spectral { bands } => {
            bands
                .iter()
                .fold([f64::INFINITY, 0.0], |[low, high], band| {
                    let half = band.width_nm / 2.0;
                    [
                        low.min(band.center_nm - half),
                        high.max(band.center_nm + half),
                    ]
                })
        }
    }
}

fn read_range(block: &Block<'_>) -> Option<[f64; 2]> {
    let [low, high] = WAVELENGTHS_NM;
    let Some(node) = block.node("range_nm") else {
        return Some([400.0, 780.0]);
    };
    let range: [f64; 2] =
        super::values::numbers_at(block.cx, node, "range_nm", Limits::closed(low, high))?;
    if range[0] < range[1] {
        return Some(range);
    }
    let error = SceneError::NotRising {
        key: "range_nm".to_owned(),
        before: range[0],
        after: range[1],
    };
    block.cx.error(&node.at, error);
    None
}

fn read_bands(block: &Block<'_>) -> Option<Vec<Band>> {
    const WANTED: &str = "a list of 1 to 32 numbers";
    let [low, high] = WAVELENGTHS_NM;
    let width_nm = block.number_or("band_width_nm", Limits::closed(0.0, 200.0), 10.0);
    let node = block.needed("bands_nm", || {
        "`bands_nm = [450, 550]`, the middles of 1 to 32 bands".to_owned()
    })?;
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, "bands_nm", WANTED);
        return None;
    };
    if list.is_empty() || list.len() > MOST_BANDS {
        wrong_length(block.cx, &node.at, "bands_nm", "a list", list.len(), WANTED);
        return None;
    }
    // The whole band must lie where there are data.
    let limits = Limits::closed(low + width_nm / 2.0, high - width_nm / 2.0);
    let mut bands: Vec<Band> = Vec::with_capacity(list.len());
    let before_this = block.cx.error_count();
    for node in list {
        let Some(center_nm) = number_at(block.cx, node, "bands_nm", limits) else {
            continue;
        };
        if let Some(last) = bands.last().filter(|last| last.center_nm >= center_nm) {
            let error = SceneError::NotRising {
                key: "bands_nm".to_owned(),
                before: last.center_nm,
                after: center_nm,
            };
            block.cx.error(&node.at, error);
            break;
        }
        bands.push(Band {
            center_nm,
            width_nm,
        });
    }
    (block.cx.error_count() == before_this).then_some(bands)
}

/// Reads `[picture]`, which may be left out.
pub(crate) fn read_picture(parent: &Block<'_>) -> Picture {
    const WORDS: [&str; 2] = ["linear", "filmic"];
    let mut picture = Picture {
        exposure_ev: 0.0,
        tone: Tone::Linear,
    };
    let Some(block) = parent.optional_block("picture") else {
        return picture;
    };
    picture.exposure_ev = block.number_or("exposure_ev", Limits::closed(-30.0, 30.0), 0.0);
    match block.optional_text("tone") {
        None | Some(("linear", _)) => {}
        Some(("filmic", _)) => picture.tone = Tone::Filmic,
        Some((word, at)) => {
            let error = SceneError::UnknownWord {
                key: "tone".to_owned(),
                word: escaped(word, super::context::QUOTED),
                nearest: nearest(word, WORDS).map(str::to_owned),
                known: super::values::listed(WORDS),
            };
            block.cx.error(at, error);
        }
    }
    block.finish();
    picture
}
