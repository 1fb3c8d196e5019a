//! Veins that stand out of the abaxial face.

use glam::DVec2;

use super::sites::Axis;

/// Half width of a vein's ridge over its radius.
const RIDGE: f64 = 1.8;

/// The ridges of the meshed veins over the flat lamina.
pub(super) struct Relief {
    axes: Vec<Axis>,
    /// Height over the vein's diameter.
    height: f64,
    min: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    members: Vec<Vec<u32>>,
}

impl Relief {
    /// For axes within the box from `min` to `max`; `height` is the ridge's height over the vein's diameter.
    pub(super) fn new(axes: Vec<Axis>, height: f64, min: DVec2, max: DVec2) -> Self {
        let widest = axes
            .iter()
            .map(|axis| axis.radius_from.max(axis.radius_to))
            .fold(0.0, f64::max);
        let longest = axes
            .iter()
            .map(|axis| axis.from.distance(axis.to))
            .fold(0.0, f64::max);
        // An axis is entered where its middle lies; nothing farther than this from a point can matter to it.
        let cell = (RIDGE * widest + 0.5 * longest).max(1e-3 * (max - min).max_element());
        let columns = ((max.x - min.x) / cell) as usize + 1;
        let rows = ((max.y - min.y) / cell) as usize + 1;
        let mut relief = Self {
            axes,
            height,
            min,
            cell,
            columns,
            rows,
            members: vec![Vec::new(); columns * rows],
        };
        for number in 0..relief.axes.len() {
            let axis = relief.axes[number];
            let (column, row) = relief.cell_of(0.5 * (axis.from + axis.to));
            relief.members[row * relief.columns + column].push(number as u32);
        }
        relief
    }

    fn cell_of(&self, point: DVec2) -> (usize, usize) {
        let place = ((point - self.min) / self.cell).max(DVec2::ZERO);
        (
            (place.x as usize).min(self.columns - 1),
            (place.y as usize).min(self.rows - 1),
        )
    }

    /// Height of the ridge at a point of the lamina, mm, ≥ 0: the highest of those that reach it.
    ///
    /// A ridge is `h (1 + cos(π d / w)) / 2` at distance `d < w` from the axis, with `h` the vein's diameter times the
    /// relief and `w` 1.8 times its radius: smooth at the top and at the foot.
    pub(super) fn at(&self, point: DVec2) -> f64 {
        let (column, row) = self.cell_of(point);
        let mut highest = 0.0_f64;
        for y in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            for x in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                for &number in &self.members[y * self.columns + x] {
                    highest = highest.max(self.ridge(&self.axes[number as usize], point));
                }
            }
        }
        highest
    }

    fn ridge(&self, axis: &Axis, point: DVec2) -> f64 {
        let along = axis.to - axis.from;
        let share = ((point - axis.from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let radius = axis.radius_from + (axis.radius_to - axis.radius_from) * share;
        let distance = point.distance(axis.from + along * share);
        let width = RIDGE * radius;
        if distance >= width {
            return 0.0;
        }
        let profile = 0.5 * (1.0 + libm::cos(std::f64::consts::PI * distance / width));
        2.0 * radius * self.height * profile
    }
}
