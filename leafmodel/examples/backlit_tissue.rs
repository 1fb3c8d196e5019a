//! A drawn venation held against the light: contents map → PROSPECT-D → a picture of the
//! transmittance.
//!
//! `cargo run --release -p leafmodel --example backlit_tissue -- out.ppm [texels]` writes
//! transmittance at 650, 550 and 450 nm as red, green and blue of a PPM, each times two and
//! gamma-encoded, and the seconds that painting took to stderr.

use std::io::Write as _;
use std::time::Instant;

use glam::DVec2;
use leafmodel::blade::contents_map::ContentsMap;
use leafmodel::blade::frame::UvFrame;
use leafmodel::blade::tissue::Tissue;
use leafmodel::optics::{Coefficients, Constituent, Contents, ProspectD, Texel, VeinFactors};
use leafmodel::venation::network::VeinSegment;

const LENGTH_MM: f64 = 70.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("name a file to write")?;
    let texels: u32 = arguments.next().map_or(Ok(2048), |text| text.parse())?;
    let veins = venation();
    let frame = UvFrame::around(&margin());
    let start = Instant::now();
    let map = ContentsMap::paint(&frame, &veins, &tissue()?, texels, 1)?;
    eprintln!(
        "{} segments, {} × {} texels: {:.2} s",
        veins.len(),
        map.width,
        map.height,
        start.elapsed().as_secs_f64()
    );
    let bands = [
        ProspectD::coefficients(650.0)?,
        ProspectD::coefficients(550.0)?,
        ProspectD::coefficients(450.0)?,
    ];
    let mut file = std::io::BufWriter::new(std::fs::File::create(path)?);
    write!(file, "P6\n{} {}\n255\n", map.width, map.height)?;
    for row in map.texels.chunks(map.width as usize).rev() {
        for texel in row {
            file.write_all(&pixel(texel, &bands))?;
        }
    }
    file.flush()?;
    Ok(())
}

fn pixel(texel: &Texel, bands: &[Coefficients; 3]) -> [u8; 3] {
    let contents = Contents::from_texel(*texel);
    bands.map(|band| {
        let transmittance = band.reflectance_transmittance(&contents).transmittance;
        (255.0 * libm::pow((2.0 * transmittance).min(1.0), 1.0 / 2.2)) as u8
    })
}

/// A thin broad leaf such as beech or poplar.
fn tissue() -> Result<Tissue, Box<dyn std::error::Error>> {
    Ok(Tissue {
        lamina: Contents::new(1.5, 40.0, 9.0, 0.5, 0.0, 0.01, 0.006)?,
        vein_factors: VeinFactors::of(&[
            (Constituent::Structure, 1.3),
            (Constituent::Chlorophyll, 0.08),
            (Constituent::Carotenoids, 0.1),
            (Constituent::Water, 2.0),
            (Constituent::DryMatter, 2.5),
        ]),
        vein_body: None,
        full_vein_radius_mm: 0.06,
        sheath_width_mm: 0.08,
        mottle: 0.1,
        mottle_scale_mm: 1.5,
    })
}

/// An ovate margin.
fn margin() -> Vec<DVec2> {
    let half: Vec<DVec2> = (0..=100)
        .map(|i| {
            let y = f64::from(i) / 100.0;
            DVec2::new(half_width(y), LENGTH_MM * y)
        })
        .collect();
    let mirrored = half.iter().rev().map(|point| DVec2::new(-point.x, point.y));
    half.iter().copied().chain(mirrored).collect()
}

fn half_width(y: f64) -> f64 {
    21.0 * libm::sin(std::f64::consts::PI * libm::pow(y.clamp(0.0, 1.0), 0.8))
}

fn inside(point: DVec2) -> bool {
    (0.0..LENGTH_MM).contains(&point.y) && point.x.abs() < half_width(point.y / LENGTH_MM)
}

/// Midrib, eight pairs of arched secondaries, tertiaries across, and a hexagonal net of minor
/// veins.
fn venation() -> Vec<VeinSegment> {
    let mut veins = Vec::new();
    let midrib = |t: f64| DVec2::new(0.0, LENGTH_MM * t);
    draw(&mut veins, 1, 0.55, 0.08, midrib);
    for pair in 0..8 {
        let y = LENGTH_MM * (0.06 + 0.1 * f64::from(pair));
        for side in [-1.0, 1.0] {
            let arch = |t: f64| DVec2::new(side * 24.0 * t, y + 13.0 * t + 6.0 * t * t);
            draw(&mut veins, 2, 0.2, 0.05, arch);
            for step in 1..14 {
                let from = arch(f64::from(step) / 14.0);
                let across =
                    |t: f64| from + DVec2::new(0.8 * libm::sin(7.0 * t), 0.1 * LENGTH_MM * t);
                draw(&mut veins, 3, 0.055, 0.045, across);
            }
        }
    }
    net(&mut veins);
    veins.retain(|vein| inside(vein.from) && inside(vein.to));
    veins
}

fn draw(
    veins: &mut Vec<VeinSegment>,
    order: u8,
    thick: f64,
    thin: f64,
    curve: impl Fn(f64) -> DVec2,
) {
    let count = 60;
    for i in 0..count {
        let (start, end) = (
            f64::from(i) / f64::from(count),
            f64::from(i + 1) / f64::from(count),
        );
        veins.push(VeinSegment {
            from: curve(start),
            to: curve(end),
            radius_from: thick + start * (thin - thick),
            radius_to: thick + end * (thin - thick),
            order,
        });
    }
}

/// Hexagons of 0.32 mm sides, bent a little so that they look grown.
fn net(veins: &mut Vec<VeinSegment>) {
    let side = 0.32;
    let bent = |x: f64, y: f64| {
        let shake =
            |a: f64, b: f64| 0.3 * side * libm::sin(a * x + b * y + libm::sin(b * x - a * y));
        DVec2::new(x + shake(7.1, 3.7), y + shake(2.9, 8.3))
    };
    let (step_x, step_y) = (3.0_f64.sqrt() * side, 1.5 * side);
    for row in 0..=(LENGTH_MM / step_y) as i32 {
        for column in -50..=50 {
            let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
            let x = (f64::from(column) + shift) * step_x;
            let y = f64::from(row) * step_y;
            let top = bent(x, y + side);
            let shoulders = [
                bent(x - 0.5 * step_x, y + 0.5 * side),
                bent(x + 0.5 * step_x, y + 0.5 * side),
            ];
            let below = bent(x + 0.5 * step_x, y - 0.5 * side);
            for (from, to) in [
                (top, shoulders[0]),
                (top, shoulders[1]),
                (shoulders[1], below),
            ] {
                veins.push(VeinSegment {
                    from,
                    to,
                    radius_from: 0.02,
                    radius_to: 0.02,
                    order: 4,
                });
            }
        }
    }
}
