//! Drawings of networks in pixels, to be traced back.

use glam::DVec2;
use rayon::prelude::*;

use super::Raster;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Grey values of paper, blade and veins.
pub(crate) const GREYS: [f32; 3] = [1.0, 0.75, 0.25];

/// Rows that are drawn together.
const BAND: usize = 64;

/// A leaf in pixels, its veins with their widths and round ends; each pixel is what its centre
/// lies on. Leaves a border of 12 pixels.
pub(crate) fn drawn(outline: &Outline, network: &VenationNetwork, mm_per_pixel: f64) -> Raster {
    let (low, high) = outline.bounds();
    let border = 12.0 * mm_per_pixel;
    let (low, high) = (low - border, high + border);
    let size = (high - low) / mm_per_pixel;
    let (width, height) = (size.x.ceil() as usize, size.y.ceil() as usize);
    let place = |p: DVec2| DVec2::new(p.x - low.x, high.y - p.y) / mm_per_pixel;
    let mut values = vec![GREYS[0]; width * height];
    let pieces: Vec<([DVec2; 2], [f64; 2])> = network
        .segments()
        .map(|s| {
            let radii = [s.radius_from / mm_per_pixel, s.radius_to / mm_per_pixel];
            ([place(s.from), place(s.to)], radii)
        })
        .collect();
    let margin: Vec<DVec2> = outline.points().iter().map(|&p| place(p)).collect();
    // Bands of rows, each with the pieces that reach into it.
    let mut in_band: Vec<Vec<u32>> = vec![Vec::new(); height.div_ceil(BAND)];
    for (number, (ends, radii)) in (0..).zip(&pieces) {
        let reach = radii[0].max(radii[1]) + 1.0;
        let low = (ends[0].y.min(ends[1].y) - reach).max(0.0) as usize / BAND;
        let high = (ends[0].y.max(ends[1].y) + reach).max(0.0) as usize / BAND;
        for band in in_band.iter_mut().take(high + 1).skip(low) {
            band.push(number);
        }
    }
    values
        .par_chunks_mut(BAND * width)
        .zip(in_band)
        .enumerate()
        .for_each(|(band, (rows, numbers))| {
            for (row, line) in rows.chunks_mut(width).enumerate() {
                fill_blade(&margin, (band * BAND + row) as f64 + 0.5, line);
            }
            for number in numbers {
                let (ends, radii) = &pieces[number as usize];
                fill_vein(*ends, *radii, band * BAND, width, rows);
            }
        });
    Raster::new(width, height, values).expect("a small picture")
}

fn fill_blade(margin: &[DVec2], y: f64, line: &mut [f32]) {
    let mut crossings: Vec<f64> = margin
        .iter()
        .zip(margin.iter().cycle().skip(1))
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
        .collect();
    crossings.sort_by(f64::total_cmp);
    for pair in crossings.chunks_exact(2) {
        let last = line.len();
        let column = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(last);
        line[column(pair[0])..column(pair[1])].fill(GREYS[1]);
    }
}

fn fill_vein(ends: [DVec2; 2], radii: [f64; 2], top: usize, width: usize, rows: &mut [f32]) {
    let reach = radii[0].max(radii[1]) + 1.0;
    let low = ends[0].min(ends[1]) - reach;
    let high = ends[0].max(ends[1]) + reach;
    let height = rows.len() / width;
    let way = ends[1] - ends[0];
    let (from, to) = (
        (low.y.max(0.0) as usize).max(top),
        (high.y.max(0.0) as usize + 1).min(top + height),
    );
    for y in from..to {
        for x in low.x.max(0.0) as usize..(high.x.max(0.0) as usize + 1).min(width) {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let along = ((p - ends[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            let radius = radii[0] + along * (radii[1] - radii[0]);
            if p.distance_squared(ends[0] + way * along) <= radius * radius {
                rows[(y - top) * width + x] = GREYS[2];
            }
        }
    }
}
