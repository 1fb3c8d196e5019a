//! A flat drawing of a leaf: margin and veins in their true widths.
//!
//! - **In**: an [`Outline`], a [`VenationNetwork`], a size, a [`Style`].
//! - **Out**: a [`Drawing`], 8-bit sRGB, apex up.
//! - **Always true**: the same network gives the same bytes. Ink is proportional to the area of
//!   veins, also for veins finer than a pixel.
//! - **Left out**: light. Coverage is mixed between sRGB values, as drawing programs do.

#[cfg(test)]
mod tests;

use glam::DVec2;
use leafmodel::export::order_colour;
use leafmodel::export::runs::Runs;
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::{VeinEdge, VenationNetwork};
use tiny_skia::{Color, FillRule, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

use crate::image::{ImageError, MOST_BYTES, MOST_PIXELS, portable_network};

/// Space around the blade, as a share of its longer side.
const BORDER: f64 = 0.02;

/// Least drawn width of veins, pixels; finer veins are drawn this wide and paler, since the
/// rasteriser works in quarters of a pixel.
const LEAST_WIDTH: f64 = 0.75;

/// Number of levels of paleness of fine veins.
const PALES: usize = 16;

/// Nodes along a vein that are nearer together than this many pixels are left out.
const SHORTEST: f64 = 0.75;

/// Least gap at a bend that is closed, pixels.
const LEAST_GAP: f64 = 0.05;

/// Number of corners of the finest polygon that approximates a disc.
const CORNERS: usize = 64;

/// The largest side that the rasteriser can draw, pixels.
const LONGEST_SIDE: u32 = 32_000;

/// The style of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// For white paper: dark veins on a pale leaf.
    OnPaper,
    /// Each vein order in its own colour ([`leafmodel::export::ORDER_COLOURS`]), coarse veins on
    /// top.
    Orders,
    /// Each piece of vein in the colour of the step that added it ([`age_colour`]), old ones on
    /// top.
    Ages {
        /// The step that has the last colour.
        last: u32,
    },
}

/// What is drawn of a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Its margins, mm; a compound leaf has several.
    pub outlines: &'a [Outline],
    /// Its veins.
    pub network: &'a VenationNetwork,
    /// Auxin sources, mm, drawn as dots on top.
    pub sources: &'a [DVec2],
}

/// Colour of the dots that mark auxin sources.
pub const SOURCE_COLOUR: [u8; 3] = [213, 40, 60];

/// Number of steps between colours of ages.
const AGES: usize = 64;

/// Colours of ages from the first step to the last, at equal distances: the dark part of
/// matplotlib's map *viridis* (S. van der Walt and N. Smith, CC0), whose lightness rises evenly,
/// so that it reads in print and for colour-blind eyes; its yellow end cannot be seen on white.
const AGE_COLOURS: [[u8; 3]; 7] = [
    [68, 1, 84],
    [70, 48, 126],
    [54, 92, 141],
    [39, 127, 142],
    [31, 161, 135],
    [74, 193, 109],
    [122, 209, 81],
];

/// The colour of what was born at `share` of the time from the first step to the last, 0 to 1.
pub fn age_colour(share: f64) -> [u8; 3] {
    let last = AGE_COLOURS.len() - 1;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let below = (at as usize).min(last - 1);
    let mix = at - below as f64;
    let (from, to) = (AGE_COLOURS[below], AGE_COLOURS[below + 1]);
    std::array::from_fn(|i| {
        (f64::from(from[i]) * (1.0 - mix) + f64::from(to[i]) * mix).round() as u8
    })
}

/// A picture in 8-bit sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green and blue by row, from the top, and column.
    pub rgb: Vec<u8>,
}

impl Drawing {
    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    ///
    /// [`ImageError::TooLarge`].
    pub fn png(&self) -> Result<Vec<u8>, ImageError> {
        portable_network::encoded(self.width, self.height, &self.rgb)
    }

    /// What is on a canvas.
    pub(super) fn of(canvas: &Pixmap) -> Self {
        let pixels = canvas.pixels().iter();
        Self {
            width: canvas.width(),
            height: canvas.height(),
            rgb: pixels
                .flat_map(|p| [p.red(), p.green(), p.blue()])
                .collect(),
        }
    }
}

/// Draws a leaf on a sheet whose longer side, with a border of a fiftieth, takes
/// `pixels_per_long_side`.
///
/// The sheet is given by the lower left and upper right corner of a blade's [`Outline::bounds`]: on
/// the sheet of the full-grown leaf, pictures of all its stages have the same scale.
///
/// # Errors
///
/// [`ImageError`] unless `pixels_per_long_side` is 1 to 32 000 and the picture has at most
/// [`MOST_PIXELS`].
pub fn draw_within(
    (low, high): (DVec2, DVec2),
    subject: Subject,
    pixels_per_long_side: u32,
    style: Style,
) -> Result<Drawing, ImageError> {
    let border = BORDER * (high - low).max_element();
    let size = high - low + DVec2::splat(2.0 * border);
    let scale = pixels_per_mm((low, high), pixels_per_long_side);
    let side = |length: f64| (length * scale).round().max(1.0) as u32;
    let (width, height) = (side(size.x), side(size.y));
    if pixels_per_long_side == 0 {
        return Err(ImageError::inconsistent("a drawing needs at least 1 pixel"));
    }
    let pixels = u64::from(width) * u64::from(height);
    let is_small = pixels <= MOST_PIXELS && pixels_per_long_side <= LONGEST_SIDE;
    let canvas = is_small.then(|| Pixmap::new(width, height)).flatten();
    let mut canvas = canvas.ok_or(ImageError::TooLarge {
        width: u64::from(width),
        height: u64::from(height),
        channels: 3,
        most: MOST_BYTES,
    })?;
    let sheet = DrawingSheet {
        corner: DVec2::new(low.x - border, high.y + border),
        scale,
    };
    let (blade, margin) = match style {
        Style::OnPaper => ([238, 243, 226], [150, 168, 132]),
        Style::Orders | Style::Ages { .. } => ([246, 246, 242], [190, 190, 184]),
    };
    canvas.fill(Color::WHITE);
    let outlines = subject.outlines.iter();
    for path in outlines.filter_map(|outline| sheet.polygon(outline.points())) {
        fill(&mut canvas, &path, blade, 1.0);
        let line = Stroke::default();
        let same = Transform::identity();
        canvas.stroke_path(&path, &ink(margin, 1.0), &line, same, None);
    }
    for (colour, strength, path) in sheet.veins(subject.network, style) {
        fill(&mut canvas, &path, colour, strength);
    }
    if let Some(path) = sheet.dots(subject.sources, dot_radius(pixels_per_long_side)) {
        fill(&mut canvas, &path, SOURCE_COLOUR, 1.0);
    }
    Ok(Drawing::of(&canvas))
}

/// Pixels to a millimetre on a sheet that [`draw_within`] draws.
pub fn pixels_per_mm((low, high): (DVec2, DVec2), pixels_per_long_side: u32) -> f64 {
    f64::from(pixels_per_long_side) / ((1.0 + 2.0 * BORDER) * (high - low).max_element())
}

/// Radius of the dot of a source, pixels: as fine as can well be seen.
fn dot_radius(pixels_per_long_side: u32) -> f64 {
    (f64::from(pixels_per_long_side) / 400.0).clamp(1.5, 6.0)
}

fn ink([red, green, blue]: [u8; 3], strength: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * strength).round() as u8);
    paint
}

fn fill(canvas: &mut Pixmap, path: &Path, colour: [u8; 3], strength: f64) {
    let rule = FillRule::Winding;
    let paint = ink(colour, strength);
    canvas.fill_path(path, &paint, rule, Transform::identity(), None);
}

/// The map from millimetres to pixels.
struct DrawingSheet {
    /// Its upper left corner, mm.
    corner: DVec2,
    /// Pixels per millimetre.
    scale: f64,
}

impl DrawingSheet {
    fn place(&self, p: DVec2) -> DVec2 {
        DVec2::new(p.x - self.corner.x, self.corner.y - p.y) * self.scale
    }

    fn polygon(&self, points: &[DVec2]) -> Option<Path> {
        let mut path = PathBuilder::new();
        add(&mut path, points.iter().map(|&p| self.place(p)));
        path.finish()
    }

    /// Discs about places.
    fn dots(&self, places: &[DVec2], radius: f64) -> Option<Path> {
        let mut path = PathBuilder::new();
        let disc = disc();
        for &place in places {
            let centre = self.place(place);
            // A quarter of the corners is enough for some pixels.
            let corners = disc.iter().step_by(4);
            add(&mut path, corners.map(|&p| centre + p * radius));
        }
        path.finish()
    }

    /// Areas to fill, with colour and strength, from the bottom to the top layer.
    fn veins(&self, network: &VenationNetwork, style: Style) -> Vec<([u8; 3], f64, Path)> {
        let layers = match style {
            Style::OnPaper => 1,
            Style::Orders => usize::from(u8::MAX) + 1,
            Style::Ages { .. } => AGES,
        };
        // Everything of one colour and strength is one path, so that overlapping pieces are not
        // drawn twice.
        let mut paths: Vec<Vec<PathBuilder>> = vec![Vec::new(); layers];
        let disc = disc();
        let nodes = network.nodes();
        for run in Runs::new(network).iter() {
            let edges = || run.iter().map(|&edge| &network.edges()[edge as usize]);
            let layer = |edge: &VeinEdge| match style {
                Style::OnPaper => 0,
                Style::Orders => usize::from(edge.order),
                Style::Ages { last } => {
                    let born = f64::from(nodes[edge.to as usize].born.min(last));
                    (born / f64::from(last.max(1)) * (AGES - 1) as f64).round() as usize
                }
            };
            let first = network.edges()[run[0] as usize];
            let mut tail = self.place(nodes[first.from as usize].position);
            let mut start = first.radius_from * self.scale;
            let mut before = DVec2::ZERO;
            let last = run.len() - 1;
            for (number, edge) in edges().enumerate() {
                let head = self.place(nodes[edge.to as usize].position);
                let end = edge.radius_to * self.scale;
                let short = (head - tail).length() < SHORTEST;
                if short && number < last && (start - end).abs() < 0.05 * end {
                    continue;
                }
                let layer = layer(edge);
                let width = start + end;
                let steps = (width / LEAST_WIDTH * PALES as f64).ceil();
                let pale = (steps as usize).clamp(1, PALES) - 1;
                if paths[layer].is_empty() {
                    paths[layer] = vec![PathBuilder::new(); PALES];
                }
                let path = &mut paths[layer][pale];
                let least = 0.5 * LEAST_WIDTH;
                let radii = [start.max(least), end.max(least)];
                let aside = piece(path, [tail, head], radii);
                // On the outer side of a bend the pieces leave a gap, about r sin φ wide.
                if (aside.perp_dot(before) * radii[0]).abs() > LEAST_GAP {
                    round(path, tail, radii[0], &disc);
                }
                if number == last {
                    round(path, head, radii[1], &disc);
                }
                (tail, start, before) = (head, end, aside);
            }
        }
        let mut areas = Vec::new();
        for (layer, paths) in paths.into_iter().enumerate().rev() {
            let colour = match style {
                Style::OnPaper => [60, 90, 42],
                Style::Orders => order_colour(layer as u8),
                Style::Ages { .. } => age_colour(layer as f64 / (AGES - 1) as f64),
            };
            for (pale, path) in paths.into_iter().enumerate() {
                // Each strength is the middle of its level, except the last, which is full.
                let strength = ((pale as f64 + 0.5) / PALES as f64)
                    .max(f64::from(u8::from(pale + 1 == PALES)));
                areas.extend(path.finish().map(|path| (colour, strength, path)));
            }
        }
        areas
    }
}

/// A closed polygon.
pub(super) fn add(path: &mut PathBuilder, mut points: impl Iterator<Item = DVec2>) {
    if let Some(first) = points.next() {
        path.move_to(first.x as f32, first.y as f32);
        for p in points {
            path.line_to(p.x as f32, p.y as f32);
        }
        path.close();
    }
}

/// Adds a piece of vein with straight sides; returns the unit vector across it. Pieces and discs
/// have the same orientation, so that overlaps have the same sign.
fn piece(path: &mut PathBuilder, [from, to]: [DVec2; 2], [start, end]: [f64; 2]) -> DVec2 {
    let aside = (to - from).perp().normalize_or_zero();
    let sides = [
        from + aside * start,
        from - aside * start,
        to - aside * end,
        to + aside * end,
    ];
    add(path, sides.into_iter());
    aside
}

/// Adds a disc, unless it is too small to be seen.
fn round(path: &mut PathBuilder, centre: DVec2, radius: f64, disc: &[DVec2]) {
    // The polygon deviates from the disc by less than a tenth of a pixel.
    let every = match radius {
        ..0.6 => return,
        ..3.0 => 8,
        ..12.0 => 4,
        ..48.0 => 2,
        _ => 1,
    };
    add(
        path,
        disc.iter().step_by(every).map(|&p| centre + p * radius),
    );
}

/// Corners on the unit circle.
fn disc() -> Vec<DVec2> {
    (0..CORNERS)
        .map(|i| std::f64::consts::TAU * i as f64 / CORNERS as f64)
        .map(|angle| DVec2::new(libm::cos(angle), libm::sin(angle)))
        .collect()
}
