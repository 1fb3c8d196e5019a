//! Meshes of few triangles: blades as grids over their texture coordinates, whose margin and holes a mask
//! shows, and tubes whose vertices are joined.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DMat3, DVec3, Mat3, Vec2, Vec3};

use crate::geometry::TriangleMesh;

/// Looks at a texel, across and down, for what a blade covers of it.
const LOOKS: usize = 4;
/// Steepest slope, of a blade against its card, that a map of normals shows.
const STEEPEST: f32 = 3.0;
/// Fraction of its area that a tube keeps: with less it falls apart.
const LEAST_AREA: f32 = 0.75;
/// Factor between widths of cells that are tried for a tube.
const WIDER: f32 = 1.2;

/// The plane that fits a blade best: the place of a pair of texture coordinates in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BladePlane {
    origin: Vec3,
    along_u: Vec3,
    along_v: Vec3,
}

impl BladePlane {
    /// The plane of least squares; `None` where texture coordinates are on a line.
    pub(super) fn of(mesh: &TriangleMesh) -> Option<Self> {
        let uvs = mesh.uvs()?;
        let (mut squares, mut products) = (DMat3::ZERO, DMat3::ZERO);
        for &vertex in mesh.triangles().as_flattened() {
            let (uv, place) = (uvs[vertex as usize], mesh.positions()[vertex as usize]);
            let known = DVec3::new(1.0, f64::from(uv.x), f64::from(uv.y));
            squares += DMat3::from_cols(known * known.x, known * known.y, known * known.z);
            let place = place.as_dvec3();
            products += DMat3::from_cols(place * known.x, place * known.y, place * known.z);
        }
        if squares.determinant() == 0.0 {
            return None;
        }
        let [origin, along_u, along_v] = (products * squares.inverse()).to_cols_array_2d();
        let vector = |of: [f64; 3]| DVec3::from(of).as_vec3();
        let plane = Self {
            origin: vector(origin),
            along_u: vector(along_u),
            along_v: vector(along_v),
        };
        (plane.normal() != Vec3::ZERO).then_some(plane)
    }

    fn at(&self, uv: Vec2) -> Vec3 {
        self.origin + self.step(uv)
    }

    fn step(&self, by: Vec2) -> Vec3 {
        self.along_u * by.x + self.along_v * by.y
    }

    /// The adaxial unit normal.
    fn normal(&self) -> Vec3 {
        self.along_u.cross(self.along_v).normalize_or_zero()
    }

    /// The frame of its map of normals.
    fn frame(&self) -> Mat3 {
        let (x, z) = (self.along_u.normalize(), self.normal());
        Mat3::from_cols(x, z.cross(x), z)
    }
}

/// Calls `at` with the weights of a triangle's corners at each node of a lattice within it: the middles of
/// `size` equal parts of [0, 1] along u and v.
fn nodes_within(uvs: [Vec2; 3], size: [usize; 2], mut at: impl FnMut(usize, usize, Vec3)) {
    let [a, b, c] = uvs;
    let area = (b - a).perp_dot(c - a);
    if area == 0.0 {
        return;
    }
    let range = |axis: usize| {
        let (low, high) = (a.min(b).min(c)[axis], a.max(b).max(c)[axis]);
        let count = size[axis] as f32;
        let first = (low * count - 0.5).ceil().max(0.0) as usize;
        let end = (high * count + 0.5).floor().clamp(0.0, count) as usize;
        first..end
    };
    for row in range(1) {
        for column in range(0) {
            let place = Vec2::new(column as f32, row as f32) + 0.5;
            let place = place / Vec2::new(size[0] as f32, size[1] as f32);
            let second = (place - a).perp_dot(c - a) / area;
            let third = (b - a).perp_dot(place - a) / area;
            let weights = Vec3::new(1.0 - second - third, second, third);
            // Both sides of an edge may have a node on it.
            if weights.min_element() >= -1e-6 {
                at(column, row, weights);
            }
        }
    }
}

/// What a mesh covers of its texture: for each texel, row by row from the top, the fraction, and the slope of
/// the mesh against a plane, if there is one.
pub(super) fn coverage(
    mesh: &TriangleMesh,
    size: [usize; 2],
    plane: Option<&BladePlane>,
) -> Vec<(f32, Vec2)> {
    let fine = size.map(|side| side * LOOKS);
    let to_plane = plane.map(|plane| plane.frame().transpose());
    let mut looked = vec![false; fine[0] * fine[1]];
    let mut sums = vec![(0.0, Vec3::ZERO); size[0] * size[1]];
    let (Some(uvs), normals) = (mesh.uvs(), mesh.normals()) else {
        return vec![(1.0, Vec2::ZERO); size[0] * size[1]];
    };
    for triangle in mesh.triangles() {
        let own = triangle.map(|vertex| vertex as usize);
        nodes_within(
            own.map(|vertex| uvs[vertex]),
            fine,
            |column, row, weights| {
                if std::mem::replace(&mut looked[row * fine[0] + column], true) {
                    return;
                }
                let sum = &mut sums[(size[1] - 1 - row / LOOKS) * size[0] + column / LOOKS];
                sum.0 += 1.0 / (LOOKS * LOOKS) as f32;
                if let (Some(to_plane), Some(normals)) = (to_plane, normals) {
                    sum.1 += to_plane
                        * Mat3::from_cols_array_2d(&own.map(|v| normals[v].to_array()))
                        * weights;
                }
            },
        );
    }
    let slope = |normal: Vec3| {
        if normal.z <= 0.0 {
            return Vec2::ZERO;
        }
        (-normal.truncate() / normal.z).clamp_length_max(STEEPEST)
    };
    sums.into_iter()
        .map(|(part, normal)| (part, slope(normal)))
        .collect()
}

/// A blade as a grid of at most so many triangles, of which those stay that cover some of it; of two triangles
/// it is a card.
pub(super) fn grid(mesh: &TriangleMesh, most: usize) -> Option<TriangleMesh> {
    let plane = BladePlane::of(mesh)?;
    let uvs = mesh.uvs()?;
    let used = || {
        mesh.triangles()
            .as_flattened()
            .iter()
            .map(|&vertex| uvs[vertex as usize])
    };
    let low = used().reduce(Vec2::min)?;
    let high = used().reduce(Vec2::max)?;
    let size = high - low;
    let sides = Vec2::new(plane.along_u.length(), plane.along_v.length()) * size;
    let cells = (most / 2).max(1) as f32;
    let rows = ((cells * sides.y / sides.x).sqrt() as usize).clamp(1, most.max(1));
    let columns = ((cells as usize) / rows).max(1);
    let step = size / Vec2::new(columns as f32, rows as f32);
    let width = columns + 1;
    let uv_of = |node: usize| low + step * Vec2::new((node % width) as f32, (node / width) as f32);
    // A lattice whose middles are the nodes.
    let lattice = [columns + 1, rows + 1];
    let in_lattice =
        |uv: Vec2| ((uv - low) / step + 0.5) / Vec2::new(lattice[0] as f32, lattice[1] as f32);
    let mut nodes: Vec<Option<(Vec3, Vec3)>> = vec![None; lattice[0] * lattice[1]];
    let mut is_covered = vec![false; columns * rows];
    for triangle in mesh.triangles() {
        let own = triangle.map(|vertex| vertex as usize);
        let corners = own.map(|vertex| uvs[vertex]);
        let normals = mesh.normals();
        nodes_within(corners.map(in_lattice), lattice, |column, row, weights| {
            let mean = |of: &[Vec3]| -> Vec3 { (0..3).map(|i| of[own[i]] * weights[i]).sum() };
            let normal = normals.map_or(plane.normal(), mean);
            nodes[row * width + column] = Some((mean(mesh.positions()), normal));
        });
        let cells = corners.map(|uv| (uv - low) / step);
        let [first, last] = [
            cells.into_iter().reduce(Vec2::min)?,
            cells.into_iter().reduce(Vec2::max)?,
        ];
        for row in first.y as usize..=(last.y as usize).min(rows - 1) {
            for column in first.x as usize..=(last.x as usize).min(columns - 1) {
                is_covered[row * columns + column] = true;
            }
        }
    }
    if nodes.iter().all(Option::is_none) {
        let on_plane = |node| Some((plane.at(uv_of(node)), plane.normal()));
        nodes = (0..nodes.len()).map(on_plane).collect();
    }
    extend(&mut nodes, lattice, &plane, step);
    let corner = |cell: usize, right: usize, up: usize| {
        ((cell / columns + up) * width + cell % columns + right) as u32
    };
    let covered = (0..columns * rows).filter(|&cell| is_covered[cell]);
    let triangles = covered.flat_map(|cell| {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| corner(cell, x, y));
        [[a, b, c], [a, c, d]]
    });
    let triangles = triangles.collect();
    let (positions, normals) = nodes.into_iter().map(Option::unwrap_or_default).unzip();
    let uvs = (0..lattice[0] * lattice[1]).map(uv_of).collect();
    TriangleMesh::new(positions, Some(normals), Some(uvs), triangles).ok()
}

/// Gives nodes beyond the blade a place, step by step from those that have one.
fn extend(
    nodes: &mut [Option<(Vec3, Vec3)>],
    [width, height]: [usize; 2],
    plane: &BladePlane,
    step: Vec2,
) {
    while nodes.iter().any(Option::is_none) {
        let before = nodes.to_vec();
        for (number, node) in nodes
            .iter_mut()
            .enumerate()
            .filter(|(_, node)| node.is_none())
        {
            let (column, row) = (number % width, number / width);
            let beside = [
                (column > 0).then(|| (number - 1, Vec2::new(step.x, 0.0))),
                (column + 1 < width).then(|| (number + 1, Vec2::new(-step.x, 0.0))),
                (row > 0).then(|| (number - width, Vec2::new(0.0, step.y))),
                (row + 1 < height).then(|| (number + width, Vec2::new(0.0, -step.y))),
            ];
            let known = beside.into_iter().flatten();
            let known = known.filter_map(|(other, by)| {
                before[other].map(|(place, normal)| (place + plane.step(by), normal))
            });
            let known: Vec<(Vec3, Vec3)> = known.collect();
            if !known.is_empty() {
                let count = known.len() as f32;
                let sum = known.into_iter().reduce(|a, b| (a.0 + b.0, a.1 + b.1));
                *node = sum.map(|(place, normal)| (place / count, normal));
            }
        }
    }
}

/// A tube of so many triangles, or as few as keep most of its area: vertices in one cell of a lattice become
/// one. `None` if it has to stay as it is.
pub(super) fn joined(mesh: &TriangleMesh, most: usize) -> Option<TriangleMesh> {
    let (low, high) = mesh.bounds();
    let mut cell = (high - low).length() / (mesh.triangles().len() as f32).sqrt() / 16.0;
    let least = LEAST_AREA * area(mesh);
    let mut fewest = None;
    loop {
        let next = joined_in(mesh, low, cell).filter(|next| area(next) >= least);
        match next {
            Some(next) if next.triangles().len() <= most => return Some(next),
            Some(next) => fewest = Some(next),
            None => return fewest,
        }
        cell *= WIDER;
    }
}

/// Twice the area.
fn area(mesh: &TriangleMesh) -> f32 {
    let triangles = mesh.triangles().iter();
    let corners = triangles.map(|triangle| triangle.map(|v| mesh.positions()[v as usize]));
    corners.map(|[a, b, c]| (b - a).cross(c - a).length()).sum()
}

fn joined_in(mesh: &TriangleMesh, low: Vec3, cell: f32) -> Option<TriangleMesh> {
    let mut numbers: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut sums: Vec<(Vec3, Vec3, f32)> = Vec::new();
    let mut number_of = vec![u32::MAX; mesh.positions().len()];
    let mut seen = BTreeSet::new();
    let mut triangles = Vec::new();
    for triangle in mesh.triangles() {
        let own = triangle.map(|vertex| {
            let vertex = vertex as usize;
            if number_of[vertex] == u32::MAX {
                let place = mesh.positions()[vertex];
                let key = ((place - low) / cell).floor().as_ivec3().to_array();
                let next = sums.len() as u32;
                let number = *numbers.entry(key).or_insert(next);
                if number == next {
                    sums.push((Vec3::ZERO, Vec3::ZERO, 0.0));
                }
                let sum = &mut sums[number as usize];
                let normal = mesh.normals().map_or(Vec3::ZERO, |normals| normals[vertex]);
                *sum = (sum.0 + place, sum.1 + normal, sum.2 + 1.0);
                number_of[vertex] = number;
            }
            number_of[vertex]
        });
        let mut sorted = own;
        sorted.sort_unstable();
        let is_flat = sorted[0] == sorted[1] || sorted[1] == sorted[2];
        if !is_flat && seen.insert(sorted) {
            triangles.push(own);
        }
    }
    let positions = sums
        .iter()
        .map(|(place, _, count)| place / *count)
        .collect();
    let normals = mesh
        .normals()
        .map(|_| sums.iter().map(|(_, normal, _)| *normal).collect());
    TriangleMesh::new(positions, normals, None, triangles).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc of radius 0.4 around the middle of its texture, bent along v, of many triangles.
    fn disc() -> TriangleMesh {
        let place = |uv: Vec2| Vec3::new(0.1 * uv.x, 0.2 * uv.y, 0.05 * uv.y * uv.y);
        let mut uvs = vec![Vec2::splat(0.5)];
        for ring in 1..=20 {
            uvs.extend((0..60).map(|k| {
                let turn = Vec2::from_angle(k as f32 * std::f32::consts::TAU / 60.0);
                0.5 + turn * 0.02 * ring as f32
            }));
        }
        let at = |ring: u32, k: u32| 1 + (ring - 1) * 60 + k % 60;
        let mut triangles: Vec<[u32; 3]> = (0..60).map(|k| [0, at(1, k), at(1, k + 1)]).collect();
        for ring in 1..20 {
            for k in 0..60 {
                let [a, b, c, d] = [
                    at(ring, k),
                    at(ring + 1, k),
                    at(ring + 1, k + 1),
                    at(ring, k + 1),
                ];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        let positions = uvs.iter().map(|&uv| place(uv)).collect();
        let normals = uvs
            .iter()
            .map(|uv| Vec3::new(0.0, -0.5 * uv.y, 1.0).normalize())
            .collect();
        TriangleMesh::new(positions, Some(normals), Some(uvs), triangles).expect("a good disc")
    }

    #[test]
    fn a_grid_follows_the_blade_and_its_mask_covers_what_the_blade_does() {
        let disc = disc();
        let grid = grid(&disc, 200).expect("a grid");
        let count = grid.triangles().len();
        assert!((100..=200).contains(&count), "{count}");
        let uvs = grid.uvs().expect("it keeps them");
        for vertex in grid.triangles().as_flattened() {
            let (place, uv) = (grid.positions()[*vertex as usize], uvs[*vertex as usize]);
            if uv.distance(Vec2::splat(0.5)) < 0.39 {
                // A triangle of the disc is 0.042 wide in v, so it departs from the bend by 0.05 · 0.042² / 4.
                let wanted = Vec3::new(0.1 * uv.x, 0.2 * uv.y, 0.05 * uv.y * uv.y);
                assert!(place.distance(wanted) < 2.3e-5, "{place} for {wanted}");
            }
        }
        let plane = BladePlane::of(&disc).expect("a plane");
        let mask = coverage(&disc, [64, 64], Some(&plane));
        let area: f32 = mask.iter().map(|(part, _)| part).sum::<f32>() / 4096.0;
        // A polygon of 60 corners in the circle.
        let exact = 0.16 * 30.0 * (std::f32::consts::TAU / 60.0).sin();
        assert!((area - exact).abs() < 2e-3, "{area} for {exact}");
        // In the middle the blade is parallel to its plane; towards the apex, in the upper rows, it rises.
        let slope = |row: usize| mask[row * 64 + 32].1;
        assert!(
            slope(32).length() < 0.02 && slope(10).y > 0.1,
            "{} {}",
            slope(32),
            slope(10)
        );
    }

    #[test]
    fn a_card_is_two_triangles_and_joined_tubes_are_few() {
        let card = grid(&disc(), 2).expect("a card");
        assert_eq!(card.triangles().len(), 2);
        let (low, high) = card.bounds();
        assert!((high.x - low.x - 0.08).abs() < 1e-4, "{low} {high}");
        let tube = joined(&disc(), 300).expect("something is left");
        assert!(
            (50..=300).contains(&tube.triangles().len()),
            "{}",
            tube.triangles().len()
        );
    }
}
