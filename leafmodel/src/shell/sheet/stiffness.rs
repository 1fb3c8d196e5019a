//! The stiffness of a sheet as a matrix.

use glam::DVec3;

use super::super::envelope::Envelope;
use super::super::forms::{Forms, metric, tangents};
use super::super::grid::Basis;
use super::super::tensor::{Tensor, applied, dot, less, positive};
use super::{Place, Sheet, height};

impl Sheet {
    /// An empty matrix with place for the sheet's stiffness.
    pub(in crate::shell) fn matrix(&self) -> Envelope {
        let mut first: Vec<usize> = (0..self.points).collect();
        let places = self.stretching.iter().chain(&self.bending);
        for place in places {
            let least = place.basis.iter().map(|function| function.point).min();
            let least = least.expect("a place has functions") as usize;
            for function in &place.basis {
                let row = &mut first[function.point as usize];
                *row = least.min(*row);
            }
        }
        for held in &self.held {
            let least = held.weights.iter().map(|&(point, _)| point).min();
            let least = least.expect("what is held has functions") as usize;
            for &(point, _) in &held.weights {
                first[point as usize] = least.min(first[point as usize]);
            }
        }
        Envelope::new((0..3 * self.points).map(|i| 3 * first[i / 3]).collect())
    }

    /// Writes the stiffness at `x` without its negative parts: that of Gauss and Newton, with the
    /// stress of what is under tension.
    pub(in crate::shell) fn stiffness(&self, x: &[DVec3], damping: f64, matrix: &mut Envelope) {
        matrix.clear();
        for place in &self.stretching {
            Self::add_stretching(place, x, matrix);
        }
        for place in &self.bending {
            let form = Forms::of(&place.basis, x);
            let rates: Vec<Tensor> = place.basis.iter().map(|f| form.rate(f)).collect();
            let forces: Vec<Tensor> = rates
                .iter()
                .map(|&r| applied(&place.stiffness, r))
                .collect();
            let n = form.normal.to_array();
            pairs(&place.basis, |i, j, a, b| {
                let factor = dot(forces[i], rates[j]);
                for (row, &u) in n.iter().enumerate() {
                    for (column, &v) in n.iter().enumerate() {
                        put(matrix, (a, row), (b, column), factor * u * v);
                    }
                }
            });
        }
        for held in &self.held {
            for &(a, u) in &held.weights {
                for &(b, v) in held.weights.iter().filter(|&&(b, _)| b <= a) {
                    for axis in 0..3 {
                        put(matrix, (a, axis), (b, axis), held.stiffness * u * v);
                    }
                }
            }
        }
        if let Some(ground) = self.ground {
            for (basis, area) in &self.soles {
                if height(basis, x) < ground.height {
                    pairs(basis, |i, j, a, b| {
                        let value = ground.stiffness * area * basis[i].value * basis[j].value;
                        put(matrix, (a, 2), (b, 2), value);
                    });
                }
            }
        }
        if let Some(contact) = &self.contact {
            contact.stiffnesses(&contact.touches(x), |a, b, value, normal| {
                for row in 0..3 {
                    for column in 0..3 {
                        let value = value * normal[row] * normal[column];
                        put(matrix, (a, row), (b, column), value);
                    }
                }
            });
        }
        for i in 0..3 * self.points {
            matrix.add(i, i, damping);
        }
    }

    fn add_stretching(place: &Place, x: &[DVec3], matrix: &mut Envelope) {
        let tangents = tangents(&place.basis, x);
        let strain = less(metric(&tangents), place.wanted).map(|e| 0.5 * e);
        let [u, v] = tangents;
        let rates: Vec<[DVec3; 3]> = place
            .basis
            .iter()
            .map(|function| {
                let [a, b] = function.first;
                [u * a, v * b, 0.5 * (v * a + u * b)]
            })
            .collect();
        let forces: Vec<[DVec3; 3]> = rates
            .iter()
            .map(|rate| {
                place
                    .stiffness
                    .map(|row| rate[0] * row[0] + rate[1] * row[1] + rate[2] * row[2])
            })
            .collect();
        let tension = positive(applied(&place.stiffness, strain));
        pairs(&place.basis, |i, j, a, b| {
            let (f, g) = (place.basis[i].first, place.basis[j].first);
            let stressed = tension[0] * f[0] * g[0]
                + tension[1] * f[1] * g[1]
                + 0.5 * tension[2] * (f[0] * g[1] + f[1] * g[0]);
            let (force, rate) = (&forces[i], &rates[j]);
            let places = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
            for (row, column) in places {
                let straight = if row == column { stressed } else { 0.0 };
                let value = force.iter().zip(rate).fold(straight, |sum, (force, rate)| {
                    sum + force[row] * rate[column]
                });
                put(matrix, (a, row), (b, column), value);
            }
        });
    }
}

/// Adds to the lower half of the matrix.
fn put(matrix: &mut Envelope, (a, row): (u32, usize), (b, column): (u32, usize), value: f64) {
    let (i, j) = (3 * a as usize + row, 3 * b as usize + column);
    if j <= i {
        matrix.add(i, j, value);
    }
}

/// Calls `act` with the indices and points of each pair of which the second is not beyond the
/// first.
fn pairs(basis: &[Basis], mut act: impl FnMut(usize, usize, u32, u32)) {
    for (i, a) in basis.iter().enumerate() {
        for (j, b) in basis.iter().enumerate() {
            if b.point <= a.point {
                act(i, j, a.point, b.point);
            }
        }
    }
}
