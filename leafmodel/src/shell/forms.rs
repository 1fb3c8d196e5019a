//! The fundamental forms of a surface, and those that its material wants.

use glam::DVec3;

use super::grid::Basis;
use super::patch::Patch;
use super::tensor::{
    Stiffness, Tensor, added, applied, between, determinant, inverse, isotropic, less, scaled,
    solved, sum,
};

pub(super) fn tangents(basis: &[Basis], x: &[DVec3]) -> [DVec3; 2] {
    let mut sums = [DVec3::ZERO; 2];
    for function in basis {
        let at = x[function.point as usize];
        sums[0] += at * function.first[0];
        sums[1] += at * function.first[1];
    }
    sums
}

pub(super) fn metric([u, v]: &[DVec3; 2]) -> Tensor {
    [u.dot(*u), v.dot(*v), u.dot(*v)]
}

/// The fundamental forms of a surface at a point.
pub(super) struct Forms {
    pub(super) metric: Tensor,
    pub(super) curvature: Tensor,
    pub(super) normal: DVec3,
    /// The tangential part of each second derivative, as coefficients of the tangents.
    along: [[f64; 2]; 3],
}

impl Forms {
    pub(super) fn of(basis: &[Basis], x: &[DVec3]) -> Self {
        let tangents = tangents(basis, x);
        let mut second = [DVec3::ZERO; 3];
        for function in basis {
            let at = x[function.point as usize];
            for (sum, &by) in second.iter_mut().zip(&function.second) {
                *sum += at * by;
            }
        }
        let metric = metric(&tangents);
        let [u, v] = tangents;
        let normal = u.cross(v).normalize_or(DVec3::Z);
        let [a, b, c] = inverse(metric);
        let along = second.map(|d| {
            let (p, q) = (d.dot(u), d.dot(v));
            [a * p + c * q, c * p + b * q]
        });
        Self {
            metric,
            curvature: second.map(|d| normal.dot(d)),
            normal,
            along,
        }
    }

    /// How the curvature changes as the control point of a function moves along the normal.
    pub(super) fn rate(&self, function: &Basis) -> Tensor {
        let [p, q] = function.first;
        std::array::from_fn(|i| function.second[i] - self.along[i][0] * p - self.along[i][1] * q)
    }
}

/// What the material at a point wants, and how much.
pub(super) struct Wanted {
    pub(super) metric: Tensor,
    pub(super) curvature: Tensor,
    pub(super) stretch: Stiffness,
    pub(super) bend: Stiffness,
}

impl Wanted {
    pub(super) fn new(rest: &Forms, patch: &Patch) -> Self {
        let grown = between(patch.growth, rest.metric);
        let scale = determinant(grown).max(0.0).sqrt();
        let isotropic = isotropic(grown);
        let lamina = [patch.stretch, patch.bend].map(|k| scaled(&isotropic, k * scale));
        let [stretch, bend] = [0, 1].map(|i| sum(&lamina[i], &patch.veins[i]));
        let factor = patch.veins_growth * patch.veins_growth;
        let metric = compromise(
            (&lamina[0], grown),
            (&patch.veins[0], rest.metric.map(|a| factor * a)),
        );
        let curvature = compromise(
            (&lamina[1], added(rest.curvature, patch.curvature)),
            (
                &patch.veins[1],
                added(
                    rest.curvature,
                    rest.metric.map(|a| patch.veins_curvature * a),
                ),
            ),
        );
        Self {
            metric,
            curvature,
            stretch,
            bend,
        }
    }
}

/// What two materials side by side want together.
fn compromise(one: (&Stiffness, Tensor), other: (&Stiffness, Tensor)) -> Tensor {
    let difference = less(other.1, one.1);
    if difference == [0.0; 3] {
        return one.1;
    }
    let pull = applied(other.0, difference);
    added(one.1, solved(&sum(one.0, other.0), pull))
}
