//! Where the vertices of a blade's mesh go.
//!
//! Points follow a size field: as close as the vein is thin along major veins and beside them, growing away from them
//! up to the longest edge. So the triangulation of these points is near to what refinement would make of it, and
//! refinement, which runs away where veins meet at sharp angles, has little left to do.

use glam::DVec2;

use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Growth of the edge length per length away from a vein.
const GRADING: f64 = 0.35;
/// Points nearer to each other than this share of the local edge length are not set.
const CLOSEST: f64 = 0.7;
/// Shortest edge over the longest.
const FINEST: f64 = 1.0 / 32.0;

/// Vertices of a mesh and the pairs of them that must be edges.
#[derive(Clone, Debug, Default)]
pub(super) struct Sites {
    /// Positions, mm; first the margin, in order.
    pub points: Vec<DVec2>,
    /// How many of them are margin.
    pub margin: usize,
    /// Pairs along veins.
    pub vein_edges: Vec<[usize; 2]>,
}

/// A piece of the axis of a meshed vein.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub from: DVec2,
    pub to: DVec2,
    pub radius_from: f64,
    pub radius_to: f64,
}

/// Axes of the veins that are at least `radius` thick.
pub(super) fn major_axes(network: &VenationNetwork, radius: f64) -> Vec<Axis> {
    network
        .segments()
        .filter(|vein| vein.radius_from.max(vein.radius_to) >= radius)
        .map(|vein| Axis {
            from: vein.from,
            to: vein.to,
            radius_from: vein.radius_from,
            radius_to: vein.radius_to,
        })
        .collect()
}

/// Area, mm², of the smallest triangle that is worth being made better, for edges of at most `longest` mm.
pub(super) fn least_area(longest: f64) -> f64 {
    let shortest = longest * FINEST;
    0.4 * shortest * shortest
}

/// Squares of equal size over the outline's box, with the points in each.
struct Bins {
    min: DVec2,
    size: f64,
    columns: usize,
    rows: usize,
    members: Vec<Vec<u32>>,
}

impl Bins {
    fn new(min: DVec2, max: DVec2, size: f64) -> Self {
        let columns = ((max.x - min.x) / size) as usize + 1;
        let rows = ((max.y - min.y) / size) as usize + 1;
        Self {
            min,
            size,
            columns,
            rows,
            members: vec![Vec::new(); columns * rows],
        }
    }

    fn cell(&self, point: DVec2) -> (usize, usize) {
        let place = ((point - self.min) / self.size).max(DVec2::ZERO);
        (
            (place.x as usize).min(self.columns - 1),
            (place.y as usize).min(self.rows - 1),
        )
    }

    fn insert(&mut self, point: DVec2, number: usize) {
        let (column, row) = self.cell(point);
        self.members[row * self.columns + column].push(number as u32);
    }

    /// Whether a point lies within `reach` (at most the bins' size) of `point`.
    fn any_within(&self, points: &[DVec2], point: DVec2, reach: f64) -> bool {
        let (column, row) = self.cell(point);
        for y in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            for x in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                let near =
                    |&number: &u32| points[number as usize].distance_squared(point) < reach * reach;
                if self.members[y * self.columns + x].iter().any(near) {
                    return true;
                }
            }
        }
        false
    }
}

/// Sets the vertices for a mesh with edges of at most `longest` (mm) and the given vein axes.
pub(super) fn place(outline: &Outline, axes: &[Axis], longest: f64) -> Sites {
    let (min, max) = outline.bounds();
    let shortest = longest * FINEST;
    let mut sites = Sites {
        points: margin_points(outline, longest),
        ..Sites::default()
    };
    sites.margin = sites.points.len();
    let mut bins = Bins::new(min, max, longest);
    for (number, &point) in sites.points.iter().enumerate() {
        bins.insert(point, number);
    }
    set_axes(outline, axes, shortest, &mut sites, &mut bins);
    let finest = beside_axes(outline, axes, shortest, &mut sites, &mut bins);
    fill(outline, longest, &finest, &mut sites, &mut bins);
    sites
}

/// The margin at steps of at most `longest`; corners of the outline stay.
fn margin_points(outline: &Outline, longest: f64) -> Vec<DVec2> {
    let corners = outline.points();
    let mut points: Vec<DVec2> = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let pieces = (corner.distance(next) / longest).ceil().max(1.0) as usize;
        for piece in 0..pieces {
            points.push(corner.lerp(next, piece as f64 / pieces as f64));
        }
    }
    // Thin out what is needlessly close, where the margin is smooth.
    let mut kept: Vec<DVec2> = Vec::new();
    let count = points.len();
    for (i, &point) in points.iter().enumerate() {
        let Some(&last) = kept.last() else {
            kept.push(point);
            continue;
        };
        let next = points[(i + 1) % count];
        let (before, after) = (point - last, next - point);
        let straight = before.normalize_or_zero().dot(after.normalize_or_zero()) > 0.98;
        let short = last.distance(next) < 0.8 * longest;
        if !(straight && short) {
            kept.push(point);
        }
    }
    kept
}

/// Points along the axes, one per distance of the local radius, joined by edges.
fn set_axes(outline: &Outline, axes: &[Axis], shortest: f64, sites: &mut Sites, bins: &mut Bins) {
    // Axes come in the order of their far nodes, so each starts where an earlier one ended.
    let mut ends = EndMap::default();
    for axis in axes {
        let step = (1.5 * axis.radius_from.max(axis.radius_to)).max(shortest);
        let mut last = ends.get(axis.from);
        let pieces = (axis.from.distance(axis.to) / step).ceil().max(1.0) as usize;
        // A vein that starts here needs its first point too.
        let first = usize::from(last.is_some());
        for piece in first..=pieces {
            let point = axis.from.lerp(axis.to, piece as f64 / pieces as f64);
            let origin = last.map(|number| sites.points[number]);
            // What is too near to the last vertex carries that one on.
            let far_enough = origin.is_none_or(|origin| origin.distance(point) >= 0.7 * step);
            if far_enough
                && outline.contains(point)
                && outline.distance_to_margin(point) > 0.5 * step
                && !bins.any_within(&sites.points, point, 0.6 * step)
            {
                let number = sites.points.len();
                sites.points.push(point);
                bins.insert(point, number);
                if let Some(last) = last {
                    sites.vein_edges.push([last, number]);
                }
                last = Some(number);
            }
        }
        if let Some(last) = last {
            ends.set(axis.to, last);
        }
    }
}

/// Numbers by exact position: veins that continue each other share a node's coordinates bit for bit.
#[derive(Default)]
struct EndMap(std::collections::BTreeMap<[u64; 2], usize>);

impl EndMap {
    fn key(point: DVec2) -> [u64; 2] {
        [point.x.to_bits(), point.y.to_bits()]
    }

    fn get(&self, point: DVec2) -> Option<usize> {
        self.0.get(&Self::key(point)).copied()
    }

    fn set(&mut self, point: DVec2, number: usize) {
        self.0.insert(Self::key(point), number);
    }
}

/// Rows of points beside the axes that carry the profile of the relief; gives every vein point with its local step.
fn beside_axes(
    outline: &Outline,
    axes: &[Axis],
    shortest: f64,
    sites: &mut Sites,
    bins: &mut Bins,
) -> Vec<(DVec2, f64)> {
    let mut finest = Vec::new();
    for axis in axes {
        let along = axis.to - axis.from;
        let Some(direction) = along.try_normalize() else {
            continue;
        };
        let normal = direction.perp();
        let radius = 0.5 * (axis.radius_from + axis.radius_to);
        let step = (1.5 * radius).max(shortest);
        finest.push((0.5 * (axis.from + axis.to), step));
        let pieces = (along.length() / step).ceil().max(1.0) as usize;
        for piece in 0..pieces {
            let middle = axis
                .from
                .lerp(axis.to, (piece as f64 + 0.5) / pieces as f64);
            for offset in [0.8, -0.8, 1.8, -1.8] {
                let point = middle + normal * (offset * radius.max(0.6 * shortest));
                let reach = CLOSEST * 0.6 * step;
                if outline.contains(point)
                    && outline.distance_to_margin(point) > reach
                    && !bins.any_within(&sites.points, point, reach)
                {
                    bins.insert(point, sites.points.len());
                    sites.points.push(point);
                }
            }
        }
    }
    finest
}

/// Fills what is left with triangular grids, finer ones near veins first.
fn fill(
    outline: &Outline,
    longest: f64,
    finest: &[(DVec2, f64)],
    sites: &mut Sites,
    bins: &mut Bins,
) {
    let (min, max) = outline.bounds();
    // Distance to the nearest vein, as far as the grading reaches.
    let reach = longest / GRADING;
    let mut near = Bins::new(min, max, reach);
    for (number, (point, _)) in finest.iter().enumerate() {
        near.insert(*point, number);
    }
    let size_at = |point: DVec2| {
        let (column, row) = near.cell(point);
        let mut size = longest;
        for y in row.saturating_sub(1)..=(row + 1).min(near.rows - 1) {
            for x in column.saturating_sub(1)..=(column + 1).min(near.columns - 1) {
                for &number in &near.members[y * near.columns + x] {
                    let (vein, step) = finest[number as usize];
                    size = size.min(step + GRADING * vein.distance(point));
                }
            }
        }
        size
    };
    let mut spacing = longest * FINEST;
    while spacing <= longest * 1.000_001 {
        let height = spacing * 0.75_f64.sqrt();
        let rows = ((max.y - min.y) / height) as usize + 1;
        let columns = ((max.x - min.x) / spacing) as usize + 1;
        for row in 0..rows {
            for column in 0..columns {
                let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
                let point = min
                    + DVec2::new(
                        (column as f64 + shift) * spacing,
                        (row as f64 + 0.5) * height,
                    );
                let size = size_at(point);
                let wanted = size >= spacing && (size < 2.0 * spacing || spacing * 2.0 > longest);
                if wanted
                    && !bins.any_within(&sites.points, point, CLOSEST * spacing)
                    && outline.contains(point)
                    && outline.distance_to_margin(point) > 0.4 * spacing
                {
                    bins.insert(point, sites.points.len());
                    sites.points.push(point);
                }
            }
        }
        spacing *= 2.0;
    }
}
