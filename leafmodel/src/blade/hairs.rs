//! Hairs (trichomes) as geometry: thin tapered tubes that stand on a blade's faces and along its
//! margin.
//!
//! - **In**: a [`HairPlan`], the blade's mesh, its veins, the seed.
//! - **Out**: a [`HairMesh`] in the frame of the blade.
//! - **Always true**: a hair starts on the mesh and leaves it on its own side. Its number is the
//!   density times the area (or the length of the margin), up to chance within one hair a triangle.
//!   The same input gives the same bits.
//! - **Left out**: glands, stars and scales; hairs that touch each other.

mod plan;
mod tube;

use glam::{DVec2, DVec3};

pub use self::plan::{HairPlace, HairPlan};
pub use self::tube::HairMesh;
use self::tube::Root;

use super::mesh::BladeMesh;
use super::vein_grid::VeinGrid;
use crate::document::{Declared, RangeError};
use crate::random::{Use, uniform};
use crate::venation::network::VeinSegment;

/// Greatest number of hairs of one kind on a blade.
pub const MOST_HAIRS: usize = 400_000;
/// Random numbers of one hair.
const NUMBERS: u64 = 8;
/// A hair stands on a vein within this many radii of its axis.
const ON_VEIN: f64 = 1.5;

impl HairPlan {
    /// The hairs of a blade.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for a plan out of range, and for more than [`MOST_HAIRS`] hairs.
    pub fn grow(
        &self,
        blade: &BladeMesh,
        veins: &[VeinSegment],
        least_vein_mm: f64,
        seed: u64,
    ) -> Result<HairMesh, RangeError> {
        self.in_range()?;
        let rooted = Rooted {
            plan: self,
            blade,
            veins: VeinGrid::new(
                veins
                    .iter()
                    .filter(|vein| vein.radius_from.max(vein.radius_to) >= least_vein_mm)
                    .copied()
                    .collect(),
                |vein| ON_VEIN * vein.radius_from.max(vein.radius_to),
            ),
            // Kinds of one leaf must not share their chance.
            seed: self.name.bytes().fold(seed, |seed, byte| {
                seed.wrapping_mul(0x0100_0000_01b3) ^ u64::from(byte)
            }),
        };
        let roots = rooted.roots()?;
        let mut mesh = HairMesh::default();
        for root in &roots {
            mesh.add(self, root);
        }
        Ok(mesh)
    }
}

struct Rooted<'a> {
    plan: &'a HairPlan,
    blade: &'a BladeMesh,
    veins: VeinGrid,
    seed: u64,
}

impl Rooted<'_> {
    fn roots(&self) -> Result<Vec<Root>, RangeError> {
        let mut roots = Vec::new();
        let mut counter = 0;
        let plan = self.plan;
        for (sign, density) in [(1.0, plan.adaxial_per_mm2), (-1.0, plan.abaxial_per_mm2)] {
            for corners in &self.blade.triangles {
                let [a, b, c] = corners.map(|v| self.blade.lamina[v as usize]);
                let area = 0.5 * (b - a).perp_dot(c - a);
                for _ in 0..self.count(&mut counter, density * area) {
                    roots.extend(self.on_face(&mut counter, corners, sign));
                }
                checked(roots.len())?;
            }
        }
        if plan.fringe_per_mm > 0.0 {
            for (edge, inner) in self.margin() {
                let [from, to] = edge.map(|v| self.blade.positions[v as usize]);
                let wanted = plan.fringe_per_mm * from.distance(to);
                for _ in 0..self.count(&mut counter, wanted) {
                    roots.extend(self.on_margin(&mut counter, edge, inner));
                }
                checked(roots.len())?;
            }
        }
        Ok(roots)
    }

    /// Random numbers, each used once.
    fn draw<const N: usize>(&self, counter: &mut u64) -> [f64; N] {
        let start = *counter;
        *counter += NUMBERS;
        std::array::from_fn(|i| uniform(self.seed, Use::Hair, start + i as u64))
    }

    /// A whole number whose mean is `wanted`.
    fn count(&self, counter: &mut u64, wanted: f64) -> usize {
        if wanted <= 0.0 {
            return 0;
        }
        let [chance] = self.draw(counter);
        (wanted + chance).floor() as usize
    }

    fn on_face(&self, counter: &mut u64, corners: &[u32; 3], sign: f64) -> Option<Root> {
        let [u, v, stray, chance @ ..]: [f64; 6] = self.draw(counter);
        // Uniform over the triangle.
        let (u, v) = if u + v > 1.0 {
            (1.0 - u, 1.0 - v)
        } else {
            (u, v)
        };
        let weights = [1.0 - u - v, u, v];
        let mix = |of: &[DVec3]| -> DVec3 {
            let terms = corners.iter().zip(weights);
            terms
                .map(|(&corner, weight)| of[corner as usize] * weight)
                .sum()
        };
        let flat: DVec2 = corners
            .iter()
            .zip(weights)
            .map(|(&corner, weight)| self.blade.lamina[corner as usize] * weight)
            .sum();
        if !self.grows_at(flat) {
            return None;
        }
        let out = mix(&self.blade.normals).normalize() * sign;
        Some(Root {
            foot: mix(&self.blade.positions),
            out,
            lean: self.leaning(corners, out, stray),
            chance,
        })
    }

    fn grows_at(&self, p: DVec2) -> bool {
        let on_vein = || {
            let mut near = self.veins.near(p);
            near.any(|vein| vein.distance <= ON_VEIN * vein.radius)
        };
        match self.plan.place {
            HairPlace::All => true,
            HairPlace::Veins => on_vein(),
            HairPlace::Between => !on_vein(),
        }
    }

    /// The direction of lean: that to the apex on this triangle, turned about `out` by chance.
    fn leaning(&self, corners: &[u32; 3], out: DVec3, chance: f64) -> DVec3 {
        let [a, b, c] = corners.map(|v| self.blade.positions[v as usize]);
        let [fa, fb, fc] = corners.map(|v| self.blade.lamina[v as usize]);
        let (first, second) = (fb - fa, fc - fa);
        // ∂p/∂y of the flat lamina, whose +y points to the apex.
        let to_apex = (c - a) * first.x - (b - a) * second.x;
        let flat = to_apex - out * to_apex.dot(out);
        let along = flat
            .try_normalize()
            .unwrap_or_else(|| out.any_orthonormal_vector());
        let angle = self.plan.stray * (2.0 * chance - 1.0);
        along * libm::cos(angle) + out.cross(along) * libm::sin(angle)
    }

    /// Edges with one triangle, in its order, and the corner opposite to each.
    fn margin(&self) -> Vec<([u32; 2], u32)> {
        let mut edges: Vec<([u32; 2], [u32; 2], u32)> = Vec::new();
        for &[a, b, c] in &self.blade.triangles {
            for (from, to, inner) in [(a, b, c), (b, c, a), (c, a, b)] {
                edges.push(([from.min(to), from.max(to)], [from, to], inner));
            }
        }
        edges.sort_unstable();
        let lone = edges.chunk_by(|one, other| one.0 == other.0);
        lone.filter(|same| same.len() == 1)
            .map(|same| (same[0].1, same[0].2))
            .collect()
    }

    fn on_margin(&self, counter: &mut u64, [from, to]: [u32; 2], inner: u32) -> Option<Root> {
        let [share, stray, chance @ ..]: [f64; 5] = self.draw(counter);
        let [a, b, c] = [from, to, inner].map(|v| self.blade.positions[v as usize]);
        let along = (b - a).try_normalize()?;
        let inwards = c - a;
        let out = -(inwards - along * inwards.dot(along)).try_normalize()?;
        let upwards = self.blade.lamina[to as usize].y >= self.blade.lamina[from as usize].y;
        let along = if upwards { along } else { -along };
        let normal = out.cross(along);
        // At the margin hairs stray out of the sheet's plane, not along it.
        let angle = 0.5 * self.plan.stray * (2.0 * stray - 1.0);
        let tilt = libm::sin(0.5 * angle);
        Some(Root {
            foot: a.lerp(b, share),
            out: (out * libm::cos(angle) + normal * tilt).normalize(),
            lean: along,
            chance,
        })
    }
}

fn checked(count: usize) -> Result<(), RangeError> {
    RangeError::unless(
        count <= MOST_HAIRS,
        "number of hairs",
        count as f64,
        "at most 400000: lower the density, or let them stand on veins only",
    )
}

#[cfg(test)]
mod tests;
