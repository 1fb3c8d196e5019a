//! The blade against its background, and the petiole taken off it.
//!
//! What is like the frame of the picture and hangs together with it is background. Its brightness
//! is a plane fitted to the frame, as light falls off to one side; pixels that lie off it by more
//! than the frame's noise (a leaf that touches the frame) are left out of the fit.

use super::components::{Joined, each_component, keep_largest};
use super::distance::squared_distances;
use super::error::TraceError;
use super::grid::{Mask, Raster, beside};

/// Number of robust standard deviations of the frame that are still background.
const NOISE: f64 = 6.0;

/// Least difference to the background, as a share of the greatest value.
const LEAST_STEP: f64 = 0.012;

/// Least share of a picture that a leaf takes.
const LEAST_LEAF: f64 = 0.005;

/// Widest part of a leaf's stalk, in radii of the widest vein.
const STALK: f64 = 1.3;

/// The pixels of the leaf, with its holes: the largest part that is not background.
pub(super) fn silhouette(picture: &Raster) -> Result<Mask, TraceError> {
    let (width, height) = (picture.width(), picture.height());
    let plane = Plane::of_frame(picture);
    let is_like = |x: usize, y: usize| {
        let value = f64::from(picture.values()[y * width + x]);
        (value - plane.at(x, y)).abs() <= plane.tolerance
    };
    let background = Mask::new(width, height, is_like);
    let mut leaf = Mask::new(width, height, |_, _| true);
    let mut open: Vec<u32> = Vec::new();
    let frame = (0..width)
        .flat_map(|x| [(x, 0), (x, height - 1)])
        .chain((0..height).flat_map(|y| [(0, y), (width - 1, y)]));
    for (x, y) in frame {
        let cell = background.cell(x, y);
        if background.cells[cell] && leaf.cells[cell] {
            leaf.cells[cell] = false;
            open.push(cell as u32);
        }
    }
    let steps = leaf.steps();
    while let Some(cell) = open.pop() {
        for step in steps.iter().step_by(2) {
            let other = beside(cell as usize, *step);
            if background.cells[other] && leaf.cells[other] {
                leaf.cells[other] = false;
                open.push(other as u32);
            }
        }
    }
    keep_largest(&mut leaf);
    let share = leaf.count() as f64 / (width * height) as f64;
    if share < LEAST_LEAF {
        return Err(TraceError::NoLeaf(share));
    }
    if share > 1.0 - 1e-3 {
        return Err(TraceError::NoBackground);
    }
    Ok(leaf)
}

/// The brightness of the background as a plane over the picture.
struct Plane {
    level: f64,
    across: f64,
    down: f64,
    tolerance: f64,
}

impl Plane {
    fn of_frame(picture: &Raster) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let values = picture.values();
        let places = (0..width)
            .flat_map(|x| [(x, 0), (x, height - 1)])
            .chain((1..height - 1).flat_map(|y| [(0, y), (width - 1, y)]));
        let frame: Vec<[f64; 3]> = places
            .map(|(x, y)| [x as f64, y as f64, f64::from(values[y * width + x])])
            .collect();
        let top = values.iter().copied().fold(0.0_f32, f32::max);
        let least = LEAST_STEP * f64::from(top);
        let median = |mut of: Vec<f64>| {
            of.sort_by(f64::total_cmp);
            of[of.len() / 2]
        };
        let mut plane = Self {
            level: median(frame.iter().map(|place| place[2]).collect()),
            across: 0.0,
            down: 0.0,
            tolerance: 0.0,
        };
        for _ in 0..4 {
            let off = |place: &[f64; 3]| (place[2] - plane.of(place[0], place[1])).abs();
            let noise = 1.4826 * median(frame.iter().map(off).collect());
            let tolerance = (NOISE * noise).max(least);
            let near: Vec<&[f64; 3]> = frame
                .iter()
                .filter(|place| off(place) <= tolerance)
                .collect();
            plane.tolerance = tolerance;
            if let Some(fitted) = fitted(&near, [width as f64, height as f64]) {
                plane = Self {
                    tolerance: plane.tolerance,
                    ..fitted
                };
            }
        }
        plane
    }

    fn of(&self, x: f64, y: f64) -> f64 {
        self.level + self.across * x + self.down * y
    }

    fn at(&self, x: usize, y: usize) -> f64 {
        self.of(x as f64, y as f64)
    }
}

/// The plane with the least squares of differences; `None` if the places do not span one.
fn fitted(places: &[&[f64; 3]], [width, height]: [f64; 2]) -> Option<Plane> {
    let count = places.len() as f64;
    let middle: [f64; 3] =
        std::array::from_fn(|i| places.iter().map(|place| place[i]).sum::<f64>() / count.max(1.0));
    let product = |i: usize, j: usize| -> f64 {
        let terms = places
            .iter()
            .map(|p| (p[i] - middle[i]) * (p[j] - middle[j]));
        terms.sum::<f64>() / count.max(1.0)
    };
    let (xx, xy, yy) = (product(0, 0), product(0, 1), product(1, 1));
    let (xv, yv) = (product(0, 2), product(1, 2));
    let determinant = xx * yy - xy * xy;
    if determinant <= 1e-6 * (width * height) * (width * height) {
        return None;
    }
    let across = (xv * yy - yv * xy) / determinant;
    let down = (yv * xx - xv * xy) / determinant;
    Some(Plane {
        level: middle[2] - across * middle[0] - down * middle[1],
        across,
        down,
        tolerance: 0.0,
    })
}

/// Takes the petiole off a silhouette; the cell in the middle of where it was joined, if there was
/// one.
///
/// An opening by a disc (\[serra1982\]) a little wider than the widest vein leaves the blade. Of
/// the parts that it takes away (teeth, tips), the petiole is the largest that consists of vein.
pub(super) fn take_off_petiole(leaf: &mut Mask, veins: &Mask, widest: f64) -> Option<usize> {
    let radius = STALK * widest + 1.0;
    let square = (radius * radius).ceil() as u32;
    let squares = squared_distances(leaf);
    let mut beyond = leaf.clone();
    for (cell, square_here) in squares.into_iter().enumerate() {
        // What is farther from the core of the blade than the radius is found by the distances
        // from outside of the core.
        beyond.cells[cell] = square_here <= square && !leaf.is_frame(cell);
    }
    if beyond.count() + 2 * (leaf.stride + leaf.rows) - 4 >= leaf.cells.len() {
        return None; // Nothing is wider than the veins.
    }
    let squares = squared_distances(&beyond);
    let mut rest = leaf.clone();
    for (cell, square_here) in squares.into_iter().enumerate() {
        rest.cells[cell] = leaf.cells[cell] && square_here > square;
    }
    let mut stalk: Vec<u32> = Vec::new();
    each_component(&rest, true, Joined::Eight, |part| {
        let inked = part
            .cells
            .iter()
            .filter(|&&cell| veins.cells[cell as usize]);
        let is_vein = 2 * inked.count() > part.cells.len();
        if is_vein && part.cells.len() > stalk.len() {
            stalk.clone_from(&part.cells);
        }
    });
    // At least twice as long as wide.
    if (stalk.len() as f64) < 4.0 * widest * widest {
        return None;
    }
    let steps = leaf.steps();
    let (mut x, mut y, mut count) = (0.0, 0.0, 0.0);
    for &cell in &stalk {
        leaf.cells[cell as usize] = false;
    }
    for &cell in &stalk {
        let touches = steps
            .iter()
            .any(|step| leaf.cells[beside(cell as usize, *step)]);
        if touches {
            let place = leaf.centre(cell as usize);
            (x, y, count) = (x + place.x, y + place.y, count + 1.0);
        }
    }
    keep_largest(leaf);
    (count > 0.0).then(|| leaf.cell_at(glam::DVec2::new(x / count, y / count)))
}
