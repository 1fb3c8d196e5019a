//! What lies on the ground, as the greatest height over each cell of a grid.

use glam::{DMat3, DVec2, DVec3};
use numerics::rest::{Contact, support};

use super::body::Body;
use super::place::{NoPlace, ScatterError, from_z};

/// Cells along the radius of the smallest body.
const CELLS_PER_RADIUS: f64 = 100.0;
/// Fewest of them on a wide ground.
const FEWEST_PER_RADIUS: f64 = 8.0;
/// Most cells of a pile (128 MiB).
const MOST_CELLS: f64 = 16_777_216.0;
/// Times that a body is turned on its way to rest.
const TURNS: usize = 40;
/// Steepest slope over which a body turns at once.
const STEEPEST: f64 = 0.4;
/// Slope below which a body lies still.
const STILL: f64 = 5e-4;
/// Slope over which a body still wants to turn where it found no rest, as on an edge from which it
/// would slip.
const UNSTEADY: f64 = 0.01;
/// Slope of what a body lies on from which it would slide: the friction of leaf litter, by eye.
const FRICTION: f64 = 0.7;

/// The greatest height of everything over each cell of the ground plan, m; −∞ where nothing is.
#[derive(Debug)]
pub(super) struct Pile {
    origin: DVec2,
    cell: f64,
    size: [usize; 2],
    heights: Vec<f64>,
    /// Cells of the triangle that is added; kept for its memory.
    covered: Vec<Covered>,
}

/// A cell that a triangle's plan may touch, with bounds of its height there.
#[derive(Clone, Copy, Debug)]
struct Covered {
    index: usize,
    cell: [u32; 2],
    low: f64,
    high: f64,
}

/// A triangle over the cells that its plan may touch.
#[derive(Clone, Copy, Debug)]
struct Plan {
    /// In cells.
    corners: [DVec2; 3],
    heights: [f64; 3],
    /// First and last column and row.
    least: [u32; 2],
    most: [u32; 2],
}

impl Plan {
    /// The least and the greatest height of its corners.
    fn ends(&self) -> (f64, f64) {
        let [a, b, c] = self.heights;
        (a.min(b).min(c), a.max(b).max(c))
    }
}

impl Pile {
    /// A pile over the rectangle of the ground plan, and as far around it as bodies reach; the
    /// smallest body sets how fine it is.
    ///
    /// # Errors
    ///
    /// [`ScatterError::TooWide`] if the cells would be too large for it.
    pub(super) fn over(
        [least, most]: [DVec2; 2],
        reach: f64,
        smallest: f64,
    ) -> Result<Self, ScatterError> {
        let extent = most - least + 2.0 * reach;
        // One more on each side, so that what touches the border has a cell.
        let size = |cell: f64| (extent / cell).ceil() + 3.0;
        let mut cell = smallest / CELLS_PER_RADIUS;
        while size(cell).element_product() > MOST_CELLS {
            cell *= 1.25;
        }
        if cell * FEWEST_PER_RADIUS > smallest || !cell.is_normal() {
            return Err(ScatterError::TooWide {
                width: extent.max_element(),
                radius: smallest,
            });
        }
        let size = size(cell).to_array().map(|n| n as usize);
        Ok(Self {
            origin: least - reach - cell,
            cell,
            size,
            heights: vec![f64::NEG_INFINITY; size[0] * size[1]],
            covered: Vec::new(),
        })
    }

    /// Adds a triangle of the world.
    pub(super) fn add(&mut self, triangle: [DVec3; 3]) {
        let Some(plan) = self.plan(triangle) else {
            return;
        };
        // What is sunk or turned down raises nothing.
        let (_, top) = plan.ends();
        let ([first, _], [last, _]) = (plan.least, plan.most);
        let is_below = |row: u32| {
            let [first, last] = [first, last].map(|column| self.index([column, row]));
            self.heights[first..=last]
                .iter()
                .all(|height| *height >= top)
        };
        if (plan.least[1]..=plan.most[1]).all(is_below) {
            return;
        }
        let mut covered = std::mem::take(&mut self.covered);
        covered.clear();
        self.cover(&plan, &mut covered);
        self.raise(&covered, 0.0);
        self.covered = covered;
    }

    fn raise(&mut self, covered: &[Covered], by: f64) {
        for at in covered {
            let height = &mut self.heights[at.index];
            *height = height.max(at.high + by);
        }
    }

    /// The height over the cell of a point.
    fn height(&self, at: DVec2) -> f64 {
        let place = (at - self.origin) / self.cell;
        let inside = |x: f64, size: usize| (0.0..size as f64).contains(&x).then_some(x as usize);
        match (inside(place.x, self.size[0]), inside(place.y, self.size[1])) {
            (Some(x), Some(y)) => self.heights[y * self.size[0] + x],
            (_, _) => f64::NEG_INFINITY,
        }
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.size[0] + x as usize
    }

    /// The plan of a triangle; `None` if all of it lies beside the pile.
    fn plan(&self, triangle: [DVec3; 3]) -> Option<Plan> {
        let corners = triangle.map(|corner| (corner.truncate() - self.origin) / self.cell);
        let [a, b, c] = corners;
        let least = a.min(b).min(c).floor().max(DVec2::ZERO);
        let most = a.max(b).max(c).floor();
        let last = DVec2::new(self.size[0] as f64 - 1.0, self.size[1] as f64 - 1.0);
        let most = most.min(last);
        (least.x <= most.x && least.y <= most.y).then(|| Plan {
            corners,
            heights: triangle.map(|corner| corner.z),
            least: least.to_array().map(|n| n as u32),
            most: most.to_array().map(|n| n as u32),
        })
    }

    /// Cells that a triangle's plan touches, with the least and greatest height of its plane there,
    /// within those of the triangle.
    fn cover(&self, plan: &Plan, covered: &mut Vec<Covered>) {
        let [a, b, c] = plan.corners;
        let [z0, z1, z2] = plan.heights;
        let (bottom, top) = plan.ends();
        let double_area = (b - a).perp_dot(c - a);
        // Height per cell along x and y; of an upright triangle nothing but its ends is known.
        let slope = DVec2::new(
            (z1 - z0) * (c - a).y - (z2 - z0) * (b - a).y,
            (z2 - z0) * (b - a).x - (z1 - z0) * (c - a).x,
        ) / double_area;
        let is_upright = !slope.is_finite();
        let within = 0.5 * (slope.x.abs() + slope.y.abs());
        let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| {
            let along = (to - from) * double_area.signum();
            (from, along, 0.5 * (along.x.abs() + along.y.abs()))
        });
        for y in plan.least[1]..=plan.most[1] {
            for x in plan.least[0]..=plan.most[0] {
                let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let touches = edges
                    .iter()
                    .all(|(from, along, reach)| along.perp_dot(middle - *from) + reach >= -1e-9);
                if !touches {
                    continue;
                }
                let height = z0 + slope.dot(middle - a);
                let (low, high) = if is_upright {
                    (bottom, top)
                } else {
                    let low = (height - within).clamp(bottom, top);
                    (low, (height + within).clamp(bottom, top))
                };
                covered.push(Covered {
                    index: self.index([x, y]),
                    cell: [x, y],
                    low,
                    high,
                });
            }
        }
    }

    /// The cells of a body whose centre of mass is at a place.
    fn cover_all(&self, body: &Body, posture: DMat3, place: DVec3, covered: &mut Vec<Covered>) {
        covered.clear();
        for triangle in body.triangles() {
            let triangle = triangle.map(|corner| posture * corner + place);
            if let Some(plan) = self.plan(triangle) {
                self.cover(&plan, covered);
            }
        }
    }

    /// How far what covers a cell must be lifted; `None` if nothing lies below.
    fn contact(&self, covered: &Covered, at: DVec2) -> Option<Contact> {
        let height = self.heights[covered.index];
        let lift = height - covered.low;
        let middle = DVec2::from_array(covered.cell.map(|n| f64::from(n) + 0.5));
        lift.is_finite().then(|| Contact {
            at: self.origin + self.cell * middle - at,
            lift,
            height,
        })
    }

    /// Lets a body fall straight down over a point of the plan, lets it turn until it lies still,
    /// and adds it. `posture` holds its first turn and its size. Returns its last posture and the
    /// place of its centre of mass, or why it has none.
    pub(super) fn settle(
        &mut self,
        body: &Body,
        posture: DMat3,
        at: DVec2,
        gap: f64,
    ) -> Result<(DMat3, DVec3), NoPlace> {
        let mut posture = posture;
        let place = at.extend(0.0);
        let mut covered = Vec::new();
        let mut contacts = Vec::new();
        // First by some corners, then by all of it: a corner of what lies below may touch a face.
        let mut is_fine = false;
        let (mut before, mut share) = (DVec2::ZERO, 1.0);
        let (mut steep, mut steepness) = (0.0, 0.0);
        for turns in 0..TURNS {
            contacts.clear();
            if is_fine {
                self.cover_all(body, posture, place, &mut covered);
                let cells = covered
                    .iter()
                    .filter_map(|covered| self.contact(covered, at));
                contacts.extend(cells);
            } else {
                contacts.extend(body.probes().filter_map(|probe| {
                    let probe = posture * probe;
                    let height = self.height(at + probe.truncate());
                    height.is_finite().then(|| Contact {
                        at: probe.truncate(),
                        lift: height - probe.z,
                        height,
                    })
                }));
            }
            let lies = support(&contacts).ok_or(NoPlace::Edge)?;
            let slope = lies.slope;
            steepness = lies.steepness;
            // Between two contacts that take turns a body would rock for ever.
            if slope.dot(before) < 0.0 {
                share *= 0.5;
            }
            before = slope;
            steep = slope.length();
            let slope = slope * share * (STEEPEST / steep).min(1.0);
            if slope.length() < STILL {
                if is_fine {
                    break;
                }
                (is_fine, share) = (true, 1.0);
                continue;
            }
            posture = from_z((-slope).extend(1.0).normalize()) * posture;
            is_fine |= 2 * turns > TURNS;
        }
        if steep > UNSTEADY || steepness > FRICTION {
            return Err(NoPlace::Steep);
        }
        self.cover_all(body, posture, place, &mut covered);
        let lifts = covered.iter();
        let lifts = lifts.map(|covered| self.heights[covered.index] - covered.low);
        let lift = lifts.fold(f64::NEG_INFINITY, f64::max) + gap;
        if !lift.is_finite() {
            return Err(NoPlace::Edge);
        }
        self.raise(&covered, lift);
        Ok((posture, at.extend(lift)))
    }
}
