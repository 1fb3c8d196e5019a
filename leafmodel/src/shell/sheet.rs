//! The energy of a sheet, its slope and its stiffness.

mod stiffness;

use glam::{DVec2, DVec3};

use super::contact::Contact;
use super::forms::{Forms, Wanted, metric, tangents};
use super::grid::{Basis, Grid};
use super::patch::Patch;
use super::skin::Skin;
use super::tensor::{Stiffness, Tensor, applied, dot, less, scaled};

/// Share of the stretching energy that is taken at the middles of cells' sides; the rest is taken at
/// the middles of cells. Those alone would not notice a wave of two cells' length, nor would the
/// corners notice one that alternates both ways; with the sides at full weight a sheet could hardly
/// bend without stretching (membrane locking).
const AT_SIDES: f64 = 0.02;

/// A horizontal plane that carries the sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground {
    /// Height at which the sheet begins to rest on it, mm.
    pub(crate) height: f64,
    /// Pressure over depth, N/mm³.
    pub(crate) stiffness: f64,
}

/// A point of the sheet that is held in its place and direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clamp {
    /// The flat point.
    pub(crate) at: DVec2,
    /// Stiffness of its holder, N/mm.
    pub(crate) stiffness: f64,
}

/// A point at which energy is taken.
#[derive(Clone, Debug)]
struct Place {
    basis: Vec<Basis>,
    wanted: Tensor,
    stiffness: Stiffness,
}

/// A sheet with all that acts on it.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    stretching: Vec<Place>,
    bending: Vec<Place>,
    /// Force on each control point, N.
    load: Vec<DVec3>,
    /// What is held: basis function, derivative (0 is the value), target, stiffness.
    held: Vec<Held>,
    ground: Option<Ground>,
    /// Places that may touch the ground, with their areas.
    soles: Vec<(Vec<Basis>, f64)>,
    /// What keeps it from passing through itself.
    contact: Option<Contact>,
    points: usize,
    spacing: f64,
    /// Mean of the bending stiffnesses, N mm.
    pub(super) typical_bend: f64,
}

#[derive(Clone, Debug)]
struct Held {
    weights: Vec<(u32, f64)>,
    target: DVec3,
    stiffness: f64,
}

impl Sheet {
    /// The sheet on `grid` that was at `rest` (control points) before it grew, made of `patches`
    /// (one for each cell), pulled by its weight along `down` (a vector of length ≤ 1).
    pub(crate) fn new(
        grid: &Grid,
        rest: &[DVec3],
        patches: &[Patch],
        down: DVec3,
        ground: Option<Ground>,
        clamp: Option<Clamp>,
    ) -> Self {
        let h = grid.spacing();
        let cell_area = |cell: usize| h * h * grid.share(cell).max(0.05);
        let mut sheet = Self {
            stretching: Vec::new(),
            bending: Vec::new(),
            load: vec![DVec3::ZERO; grid.points()],
            held: Vec::new(),
            ground,
            soles: Vec::new(),
            contact: None,
            points: grid.points(),
            spacing: h,
            typical_bend: patches.iter().map(|patch| patch.bend).sum::<f64>()
                / patches.len() as f64,
        };
        // Middles of sides, each with the cells that meet there.
        let mut sides: Vec<(DVec2, usize)> = Vec::new();
        for (cell, patch) in patches.iter().enumerate() {
            let p = grid.centre(cell);
            let basis = grid.basis(p);
            let area = cell_area(cell);
            let form = Forms::of(&basis, rest);
            let wanted = Wanted::new(&form, patch);
            sheet.stretching.push(Place {
                basis: basis.to_vec(),
                wanted: wanted.metric,
                stiffness: scaled(&wanted.stretch, area * (1.0 - AT_SIDES)),
            });
            sheet.bending.push(Place {
                basis: basis.to_vec(),
                wanted: wanted.curvature,
                stiffness: scaled(&wanted.bend, area),
            });
            for function in &basis {
                sheet.load[function.point as usize] +=
                    down * (patch.weight * area * function.value);
            }
            if ground.is_some() {
                sheet.soles.push((basis.to_vec(), area));
            }
            let halves = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|way| 0.5 * h * way);
            sides.extend(halves.map(|half| (p + half, cell)));
        }
        sides.sort_by(|(a, i), (b, j)| {
            let key = |p: &DVec2| ((p.y / h * 4.0).round(), (p.x / h * 4.0).round());
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(i.cmp(j))
        });
        for same in sides.chunk_by(|(a, _), (b, _)| a.distance_squared(*b) < 0.01 * h * h) {
            let cells: Vec<usize> = same.iter().map(|&(_, cell)| cell).collect();
            sheet.add_side(grid, rest, patches, same[0].0, &cells, &cell_area);
        }
        if let Some(clamp) = clamp {
            sheet.clamp(grid, rest, patches, clamp);
        }
        sheet
    }

    /// The same sheet, whose parts keep clear of each other as the pieces of `skin` say.
    pub(crate) fn keeping_clear(self, skin: Skin) -> Self {
        // As stiff as the bending of a cell: a search that can bend it can also stop it.
        let stiffness = self.typical_bend / (self.spacing * self.spacing);
        Self {
            contact: Some(Contact::new(skin, stiffness)),
            ..self
        }
    }

    fn add_side(
        &mut self,
        grid: &Grid,
        rest: &[DVec3],
        patches: &[Patch],
        at: DVec2,
        cells: &[usize],
        cell_area: &impl Fn(usize) -> f64,
    ) {
        // A nudge into one of the cells, so that the functions are those of a cell that exists.
        let inward = grid.centre(cells[0]);
        let mut basis = grid.basis(at.lerp(inward, 1e-9)).to_vec();
        basis.retain(|function| function.value > 1e-6);
        let form = Forms::of(&basis, rest);
        let mut place = Place {
            basis,
            wanted: [0.0; 3],
            stiffness: [[0.0; 3]; 3],
        };
        for &cell in cells {
            let wanted = Wanted::new(&form, &patches[cell]);
            let share = scaled(&wanted.stretch, 0.25 * AT_SIDES * cell_area(cell));
            for (sum, metric) in place.wanted.iter_mut().zip(wanted.metric) {
                *sum += metric / cells.len() as f64;
            }
            let sums = place.stiffness.iter_mut().flatten();
            for (sum, share) in sums.zip(share.as_flattened()) {
                *sum += share;
            }
        }
        self.stretching.push(place);
    }

    fn clamp(&mut self, grid: &Grid, rest: &[DVec3], patches: &[Patch], clamp: Clamp) {
        let basis = grid.basis(clamp.at);
        let growth = grid.cell(clamp.at).map_or(1.0, |cell| {
            0.5 * (patches[cell].growth[0] + patches[cell].growth[1])
        });
        let h = self.spacing;
        for derivative in 0..3 {
            let weights: Vec<(u32, f64)> = basis
                .iter()
                .map(|function| {
                    let weight = match derivative {
                        0 => function.value,
                        i => h * function.first[i - 1],
                    };
                    (function.point, weight)
                })
                .collect();
            let target: DVec3 = weights.iter().map(|&(i, w)| rest[i as usize] * w).sum();
            let grown = if derivative == 0 { 1.0 } else { growth };
            self.held.push(Held {
                weights,
                target: target * grown,
                stiffness: clamp.stiffness,
            });
        }
    }

    /// The same sheet, with every cell below `y` held where it is at rest.
    #[cfg(test)]
    pub(super) fn held_below(mut self, grid: &Grid, rest: &[DVec3], y: f64) -> Self {
        let below = (0..grid.cells()).map(|cell| grid.centre(cell));
        for p in below.filter(|p| p.y < y) {
            let weights: Vec<(u32, f64)> =
                grid.basis(p).iter().map(|b| (b.point, b.value)).collect();
            let target = weights.iter().map(|&(i, w)| rest[i as usize] * w).sum();
            self.held.push(Held {
                weights,
                target,
                stiffness: 1e3,
            });
        }
        self
    }

    /// Number of control points.
    pub(super) fn points(&self) -> usize {
        self.points
    }

    /// The side of a cell, mm.
    pub(super) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The energy, N mm, with the control points at `x`.
    pub(super) fn energy(&self, x: &[DVec3]) -> f64 {
        self.walk(x, &mut |_, _| {})
    }

    /// The energy; `slope` becomes its derivative by each control point.
    pub(super) fn slope(&self, x: &[DVec3], slope: &mut [DVec3]) -> f64 {
        slope.fill(DVec3::ZERO);
        self.walk(x, &mut |point, force| slope[point as usize] += force)
    }

    fn walk(&self, x: &[DVec3], push: &mut impl FnMut(u32, DVec3)) -> f64 {
        let mut energy = 0.0;
        for place in &self.stretching {
            let tangents = tangents(&place.basis, x);
            let strain = less(metric(&tangents), place.wanted).map(|e| 0.5 * e);
            let stress = applied(&place.stiffness, strain);
            energy += 0.5 * dot(stress, strain);
            let [u, v] = tangents;
            let by_first = [
                u * stress[0] + v * (0.5 * stress[2]),
                v * stress[1] + u * (0.5 * stress[2]),
            ];
            for function in &place.basis {
                let [first, second] = function.first;
                push(function.point, by_first[0] * first + by_first[1] * second);
            }
        }
        for place in &self.bending {
            let form = Forms::of(&place.basis, x);
            let change = less(form.curvature, place.wanted);
            let moment = applied(&place.stiffness, change);
            energy += 0.5 * dot(moment, change);
            for function in &place.basis {
                let along = dot(moment, form.rate(function));
                push(function.point, form.normal * along);
            }
        }
        for (point, (&force, &at)) in (0..).zip(self.load.iter().zip(x)) {
            energy -= force.dot(at);
            push(point, -force);
        }
        for held in &self.held {
            let at: DVec3 = held.weights.iter().map(|&(i, w)| x[i as usize] * w).sum();
            let away = at - held.target;
            energy += 0.5 * held.stiffness * away.length_squared();
            for &(point, weight) in &held.weights {
                push(point, away * (weight * held.stiffness));
            }
        }
        if let Some(ground) = self.ground {
            for (basis, area) in &self.soles {
                let depth = ground.height - height(basis, x);
                if depth > 0.0 {
                    let stiffness = ground.stiffness * area;
                    energy += 0.5 * stiffness * depth * depth;
                    for function in basis {
                        let force = -stiffness * depth * function.value;
                        push(function.point, DVec3::Z * force);
                    }
                }
            }
        }
        if let Some(contact) = &self.contact {
            energy += contact.walk(&contact.touches(x), push);
        }
        energy
    }
}

fn height(basis: &[Basis], x: &[DVec3]) -> f64 {
    basis
        .iter()
        .map(|function| function.value * x[function.point as usize].z)
        .sum()
}
