//! Draws a melon's stripes on a sphere and a cube, and noise on a cap, as SVG; times tessellation,
//! atlas and painting.
//!
//! `cargo run --release -p leafmodel --example mosaic_plate -- FOLDER`

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use leafmodel::mosaic::atlas::Atlas;
use leafmodel::mosaic::noise_pattern::NoisePattern;
use leafmodel::mosaic::paint::TypeField;
use leafmodel::mosaic::shapes::lathe::lathe;
use leafmodel::mosaic::shapes::{rounded_cube, sphere};
use leafmodel::mosaic::voronoi::Voronoi;
use leafmodel::mosaic::{
    CellType, ControlImage, CylinderControl, Mosaic, MosaicPlan, RadiusRule, Steered, Surface,
    SurfacePoint,
};
use leafmodel::optics::Contents;

/// Flat colours of the two types.
const COLOURS: [&str; 2] = ["#3f7a2a", "#e6d36b"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let cap = [
        (0.0, 0.0),
        (30.0, -2.0),
        (48.0, 2.0),
        (50.0, 6.0),
        (40.0, 20.0),
        (20.0, 30.0),
        (0.0, 33.0),
    ];
    let shapes = [
        ("melon", sphere(50.0, 2.5)?, true),
        ("square-melon", rounded_cube(90.0, 15.0, 2.5)?, true),
        ("noise-on-cap", lathe(&cap.map(DVec2::from), 2.0)?, false),
    ];
    for (name, shape, grown) in shapes {
        let surface = Surface::new(shape.positions, shape.faces)?;
        let start = Instant::now();
        let (sites, kinds) = if grown {
            let mosaic = Mosaic::grow(&surface, &watermelon(), 1)?;
            (
                mosaic.cells.iter().map(|cell| cell.at).collect(),
                mosaic.cells.iter().map(|cell| cell.kind).collect(),
            )
        } else {
            noise(&surface)
        };
        eprintln!("{name}: pattern made in {:.2?}", start.elapsed());
        draw(name, &surface, &sites, &kinds, Path::new(&folder))?;
    }
    Ok(())
}

/// The plan of Figs. 10 and 11, with a fifth of the cells; share and width of the stripes are ours.
fn watermelon() -> MosaicPlan {
    let cell = |name: &str, division_days, share, own: usize, adhesion: f64| {
        let only = |value: f64| (0..2).map(|k| if k == own { value } else { 0.0 }).collect();
        CellType {
            name: name.into(),
            division_days,
            initial_probability: share,
            switching: only(1.0),
            adhesion: only(adhesion),
        }
    };
    MosaicPlan {
        initial_cells: 2000,
        days: 20.0,
        radius_weight: 0.5,
        relaxations_per_day: 4,
        step: 0.066,
        initial_relaxations: 70,
        initial_step: 0.005,
        radius: RadiusRule::Initial,
        types: vec![
            cell("dark", 10.0, 0.7, 0, 0.9),
            cell("light", 5.0, 0.3, 1, 0.5),
        ],
        controls: vec![CylinderControl {
            from: DVec3::new(0.0, 0.0, -60.0),
            to: DVec3::new(0.0, 0.0, 60.0),
            radius_mm: None,
            image: ControlImage::Stripes {
                count: 10,
                share: 0.35,
                waviness: 0.2,
                bends: 4.0,
                seed: 1,
            },
            steers: Steered::InitialType(1),
        }],
        growth: None,
    }
}

fn noise(surface: &Surface) -> (Vec<SurfacePoint>, Vec<u16>) {
    let pattern = NoisePattern {
        scale_mm: 18.0,
        octaves: 3,
        gain: 0.5,
        share: 0.4,
    };
    let sites = surface.probes(20_000, 1);
    let places: Vec<DVec3> = sites.iter().map(|site| surface.position(site)).collect();
    let kinds = pattern.kinds(&places, 1);
    (sites, kinds)
}

fn draw(
    name: &str,
    surface: &Surface,
    sites: &[SurfacePoint],
    kinds: &[u16],
    folder: &Path,
) -> Result<(), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let voronoi = Voronoi::new(surface, sites);
    let tessellated = start.elapsed();
    std::fs::write(
        folder.join(format!("{name}.svg")),
        svg(surface, &voronoi, kinds),
    )?;
    let start = Instant::now();
    let field = TypeField::of_cells(surface, voronoi, kinds, 2, 0.4);
    let blended = start.elapsed();
    let start = Instant::now();
    let atlas = Atlas::new(surface, 2048, 4)?;
    let laid = start.elapsed();
    let of_types = [
        Contents::new(1.6, 55.0, 10.0, 0.0, 0.0, 0.012, 0.006)?,
        Contents::new(1.6, 4.0, 12.0, 0.0, 0.0, 0.012, 0.006)?,
    ];
    let start = Instant::now();
    let texels: Vec<Option<SurfacePoint>> = (0..2048 * 2048_u32)
        .into_par_iter()
        .map(|i| atlas.shown(i % 2048, i / 2048))
        .collect();
    let painted = field.paint(texels.into_par_iter(), &of_types);
    let filled = painted.iter().flatten().count();
    let [low, high] = atlas.density_range(surface);
    eprintln!(
        "{name}: {} faces, {} cells; tessellated in {tessellated:.2?}, blend prepared in {blended:.2?}, atlas of {} charts \
         in {laid:.2?} (filled {:.2}, density {low:.2} to {high:.2}), {filled} texels painted in {:.2?}",
        surface.faces().len(),
        sites.len(),
        atlas.charts(),
        atlas.filled(),
        start.elapsed()
    );
    Ok(())
}

/// The polygons that face a viewer at (2, −3, 1.5), drawn without perspective.
fn svg(surface: &Surface, voronoi: &Voronoi, kinds: &[u16]) -> String {
    let view = DVec3::new(2.0, -3.0, 1.5).normalize();
    let right = DVec3::Z.cross(view).normalize();
    let up = view.cross(right);
    let mut polygons: Vec<_> = voronoi
        .polygons(surface)
        .filter(|polygon| surface.normal(polygon.face).dot(view) > 0.0)
        .map(|polygon| (polygon.corners[0].dot(view), polygon))
        .collect();
    polygons.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-80 -80 160 160\" width=\"800\" height=\"800\">\n",
    );
    for (_, polygon) in polygons {
        let colour = COLOURS[usize::from(kinds[polygon.cell as usize])];
        let points: Vec<String> = polygon
            .corners
            .iter()
            .map(|p| format!("{:.3},{:.3}", p.dot(right), -p.dot(up)))
            .collect();
        let points = points.join(" ");
        // A hair of its own colour hides the joints of the pieces.
        let _ = writeln!(
            text,
            "<polygon points=\"{points}\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"0.06\"/>"
        );
    }
    text + "</svg>\n"
}
