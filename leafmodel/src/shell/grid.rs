//! Quadratic B-splines over the cells of a square grid that a flat shape covers.

use crate::plane::polygon;
use glam::{DVec2, DVec3};

/// Marks a cell, or a control point, that the shape does not need.
const NONE: u32 = u32::MAX;
/// Samples of each cell's cover, along each side.
const SAMPLES: usize = 4;

/// A square grid over a flat shape.
///
/// Cell `(i, j)` holds the points `origin + spacing · (i + s, j + t)` with `s`, `t` in [0, 1]. Nine
/// control points act on it. Only cells that the shape touches exist.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    origin: DVec2,
    spacing: f64,
    columns: usize,
    rows: usize,
    /// The number of each cell, row by row, or [`NONE`].
    cells: Vec<u32>,
    /// Column, row and covered share of each cell that exists.
    places: Vec<([usize; 2], f64)>,
    /// Number of each control point, row by row, or [`NONE`].
    points: Vec<u32>,
    /// Column and row of each control point that exists.
    knots: Vec<[usize; 2]>,
}

/// Values of one basis function and its derivatives by flat coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Basis {
    /// Number of the control point.
    pub(crate) point: u32,
    pub(crate) value: f64,
    /// First derivatives, 1/mm.
    pub(crate) first: [f64; 2],
    /// Second derivatives: twice by x, twice by y, by both, 1/mm².
    pub(crate) second: [f64; 3],
}

impl Grid {
    /// The grid of this spacing over the shape whose margin is `margin`; `contains` tells whether a
    /// point lies within it.
    pub(crate) fn over(margin: &[DVec2], contains: impl Fn(DVec2) -> bool, spacing: f64) -> Self {
        let (low, high) = margin
            .iter()
            .fold((margin[0], margin[0]), |(low, high), &p| {
                (low.min(p), high.max(p))
            });
        let count = ((high - low) / spacing).ceil().max(DVec2::ONE) + 1.0;
        let (columns, rows) = (count.x as usize, count.y as usize);
        let origin = 0.5 * (low + high) - 0.5 * spacing * count;
        let mut grid = Self {
            origin,
            spacing,
            columns,
            rows,
            cells: vec![NONE; columns * rows],
            places: Vec::new(),
            points: vec![NONE; (columns + 2) * (rows + 2)],
            knots: Vec::new(),
        };
        let mut touched = vec![false; columns * rows];
        for (a, b) in polygon::sides(margin) {
            let pieces = (a.distance(b) / (0.2 * spacing)).ceil().max(1.0) as usize;
            for piece in 0..pieces {
                let [column, row] = grid.cell_at(a.lerp(b, piece as f64 / pieces as f64)).0;
                touched[row * columns + column] = true;
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let at = row * columns + column;
                let share = grid.share_of([column, row], touched[at], &contains);
                if touched[at] || share > 0.0 {
                    grid.cells[at] = grid.places.len() as u32;
                    grid.places.push(([column, row], share));
                }
            }
        }
        grid.number_points();
        grid
    }

    /// Share of a cell within the shape. A cell without margin lies within it or not, as a whole.
    fn share_of(&self, cell: [usize; 2], cut: bool, contains: &impl Fn(DVec2) -> bool) -> f64 {
        let [column, row] = cell.map(|i| i as f64);
        let within =
            |s: f64, t: f64| contains(self.origin + self.spacing * DVec2::new(column + s, row + t));
        if !cut {
            return f64::from(u8::from(within(0.5, 0.5)));
        }
        let place = |i: usize| (i as f64 + 0.5) / SAMPLES as f64;
        let inside = (0..SAMPLES * SAMPLES)
            .filter(|i| within(place(i % SAMPLES), place(i / SAMPLES)))
            .count();
        inside as f64 / (SAMPLES * SAMPLES) as f64
    }

    /// Numbers the control points across the shorter side first: the matrix of a sheet then has its
    /// entries near the diagonal.
    fn number_points(&mut self) {
        let (wide, tall) = (self.columns + 2, self.rows + 2);
        let mut needed = vec![false; wide * tall];
        for &([column, row], _) in &self.places {
            for i in 0..9 {
                needed[(row + i / 3) * wide + column + i % 3] = true;
            }
        }
        let (outer, inner) = if wide > tall {
            (wide, tall)
        } else {
            (tall, wide)
        };
        for slow in 0..outer {
            for fast in 0..inner {
                let [column, row] = if wide > tall {
                    [slow, fast]
                } else {
                    [fast, slow]
                };
                if needed[row * wide + column] {
                    self.points[row * wide + column] = self.knots.len() as u32;
                    self.knots.push([column, row]);
                }
            }
        }
    }

    pub(crate) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The corner of the first cell.
    pub(super) fn origin(&self) -> DVec2 {
        self.origin
    }

    /// Column and row of a cell, and its control points.
    pub(super) fn cell_points(&self, cell: usize) -> ([usize; 2], [u32; 9]) {
        let ([column, row], _) = self.places[cell];
        let point = |i: usize| self.points[(row + i / 3) * (self.columns + 2) + column + i % 3];
        ([column, row], std::array::from_fn(point))
    }

    /// Number of cells.
    pub(crate) fn cells(&self) -> usize {
        self.places.len()
    }

    /// Number of control points.
    pub(crate) fn points(&self) -> usize {
        self.knots.len()
    }

    /// The middle of a cell.
    pub(crate) fn centre(&self, cell: usize) -> DVec2 {
        let ([column, row], _) = self.places[cell];
        self.origin + self.spacing * (DVec2::new(column as f64, row as f64) + 0.5)
    }

    /// Share of a cell that the shape covers.
    pub(crate) fn share(&self, cell: usize) -> f64 {
        self.places[cell].1
    }

    /// Number of the cell that holds a flat point, if it exists.
    pub(crate) fn cell(&self, p: DVec2) -> Option<usize> {
        let ([column, row], _) = self.cell_at(p);
        let cell = self.cells[row * self.columns + column];
        (cell != NONE).then_some(cell as usize)
    }

    /// Column and row of the cell that holds a point, and the point's place in it.
    fn cell_at(&self, p: DVec2) -> ([usize; 2], DVec2) {
        let place = (p - self.origin) / self.spacing;
        let most = DVec2::new(self.columns as f64 - 1.0, self.rows as f64 - 1.0);
        let corner = place.floor().clamp(DVec2::ZERO, most);
        ([corner.x as usize, corner.y as usize], place - corner)
    }

    /// The basis functions at a flat point. In a cell that does not exist, those of the nearest one
    /// that does, continued.
    pub(crate) fn basis(&self, p: DVec2) -> [Basis; 9] {
        let (cell, at) = self.cell_at(p);
        if self.cells[cell[1] * self.columns + cell[0]] != NONE {
            return self.basis_in(cell, at);
        }
        let place = (p - self.origin) / self.spacing;
        let corner = |&[column, row]: &[usize; 2]| DVec2::new(column as f64, row as f64);
        let (nearest, _) = self
            .places
            .iter()
            .min_by(|(a, _), (b, _)| {
                let away = |cell| (place - corner(cell) - 0.5).length_squared();
                away(a).total_cmp(&away(b))
            })
            .expect("a shape touches a cell");
        self.basis_in(*nearest, place - corner(nearest))
    }

    /// The basis functions at a place of a cell.
    fn basis_in(&self, [column, row]: [usize; 2], at: DVec2) -> [Basis; 9] {
        let (x, y) = (quadratic(at.x), quadratic(at.y));
        let h = self.spacing;
        std::array::from_fn(|i| {
            let (a, b) = (i % 3, i / 3);
            Basis {
                point: self.points[(row + b) * (self.columns + 2) + column + a],
                value: x[0][a] * y[0][b],
                first: [x[1][a] * y[0][b] / h, x[0][a] * y[1][b] / h],
                second: [
                    x[2][a] * y[0][b] / (h * h),
                    x[0][a] * y[2][b] / (h * h),
                    x[1][a] * y[1][b] / (h * h),
                ],
            }
        })
    }

    /// Control points of the spline that follows `place`, a smooth function of the flat point.
    ///
    /// `c = f − ⅛ h² Δf` at the middle of each function reproduces quadratic polynomials.
    pub(crate) fn fitted(&self, place: impl Fn(DVec2) -> DVec3) -> Vec<DVec3> {
        let h = self.spacing;
        let at = |[column, row]: [usize; 2]| {
            self.origin + h * (DVec2::new(column as f64, row as f64) - 0.5)
        };
        self.knots
            .iter()
            .map(|&knot| {
                let p = at(knot);
                let [x, y] = [DVec2::X * h, DVec2::Y * h];
                let around = place(p + x) + place(p - x) + place(p + y) + place(p - y);
                1.5 * place(p) - 0.125 * around
            })
            .collect()
    }

    /// The value of a spline at a flat point and its derivatives by both coordinates.
    pub(crate) fn value(&self, control: &[DVec3], p: DVec2) -> [DVec3; 3] {
        let mut sums = [DVec3::ZERO; 3];
        for basis in self.basis(p) {
            let c = control[basis.point as usize];
            sums[0] += c * basis.value;
            sums[1] += c * basis.first[0];
            sums[2] += c * basis.first[1];
        }
        sums
    }
}

/// Values, first and second derivatives of the three quadratic B-splines on the unit cell.
pub(super) fn quadratic(t: f64) -> [[f64; 3]; 3] {
    let s = 1.0 - t;
    [
        [0.5 * s * s, 0.75 - (t - 0.5) * (t - 0.5), 0.5 * t * t],
        [-s, 1.0 - 2.0 * t, t],
        [1.0, -2.0, 1.0],
    ]
}
