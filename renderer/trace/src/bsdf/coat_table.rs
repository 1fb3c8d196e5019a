//! The directional albedo of coats of any roughness, for coats whose roughness changes from place
//! to place.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::directional_albedo::{lattice_on_disc, reflected_share, slants};
use super::fresnel;
use super::ggx::Ggx;
use super::known::Known;
use super::leaf_shape::Passed;

const ALPHA_NODES: usize = 16;
const MU_NODES: usize = 33;
/// Least and greatest roughness of the table.
const ALPHAS: [f32; 2] = [0.02, 1.0];
/// Points of the rank-1 lattice for one entry: Fibonacci numbers.
const LATTICE: (u32, u32) = (1597, 987);

/// `E(µ)` of isotropic coats of one refractive index, over roughness.
///
/// `E` is convex in µ, and linear interpolation never lies below it, so a leaf under the coat never
/// sends out more than comes in.
#[derive(Clone, Debug)]
pub struct CoatTable {
    /// `[roughness][µ]`.
    rows: Box<[[f32; MU_NODES]]>,
}

/// Crystals of wax on a face, which scatter all light that they meet (glaucous bloom).
///
/// Of light at the cosine µ the share `E_w(µ) = ½ (1 − exp(−τ/µ))` is sent back and the rest goes
/// on: a thin layer of optical thickness τ whose crystals send half of what they scatter to each
/// side.
#[derive(Clone, Debug)]
pub struct Bloom {
    tau: f32,
    /// `Ē_w`.
    mean: f32,
    /// What passes bloom and coat, for each roughness of the table.
    passed: Box<[Passed]>,
}

impl Bloom {
    /// Bloom of an optical thickness over the coats of a table.
    pub fn new(tau: f32, table: &CoatTable) -> Self {
        let mut bloom = Self {
            tau,
            mean: 0.0,
            passed: Box::default(),
        };
        bloom.passed = table.passed(&bloom, |_| 1.0);
        if tau > 0.0 {
            let [passed, ..] = slants(|mu| 1.0 - bloom.sent_back(mu));
            bloom.mean = 1.0 - passed;
        }
        bloom
    }

    /// `E_w`.
    #[inline]
    fn sent_back(&self, mu: f32) -> f32 {
        if self.tau == 0.0 {
            return 0.0;
        }
        0.5 * (1.0 - libm::expf(-self.tau / mu.max(1e-4)))
    }
}

/// A row of the table at a cosine.
#[inline]
fn along(row: &[f32; MU_NODES], mu: f32) -> f32 {
    let node = ((mu.sqrt() * (MU_NODES - 1) as f32) as usize).min(MU_NODES - 2);
    let [low, high] = [mu_of(node), mu_of(node + 1)];
    let share = ((mu - low) / (high - low)).clamp(0.0, 1.0);
    row[node] * (1.0 - share) + row[node + 1] * share
}

/// The coat of one face at one place, and the bloom on it.
#[derive(Clone, Debug)]
pub struct LocalCoat<'a> {
    /// Its distribution of microfacets.
    pub ggx: Ggx,
    /// Its refractive index.
    pub eta: f32,
    table: &'a CoatTable,
    bloom: &'a Bloom,
    /// Row of the table and share of the next.
    row: usize,
    share: f32,
}

impl CoatTable {
    /// The table of a refractive index, made once in a process; an infinite one reflects all light.
    pub fn of(eta: f32) -> Arc<Self> {
        static KNOWN: Known<u32, CoatTable> = Known::new();
        KNOWN.get(eta.to_bits(), || Self::new(eta))
    }

    fn new(eta: f32) -> Self {
        let points = lattice_on_disc(LATTICE);
        let fresnel = |cos: f32| {
            if eta.is_infinite() {
                1.0
            } else {
                fresnel::dielectric(cos, eta)
            }
        };
        let row = |node: usize| {
            let alpha = alpha_of(node);
            let ggx = Ggx {
                alpha_x: alpha,
                alpha_y: alpha,
            };
            std::array::from_fn(|i| {
                if eta == 1.0 {
                    0.0
                } else {
                    reflected_share(ggx, fresnel, (mu_of(i), 0.0), &points)
                }
            })
        };
        let rows: Vec<[f32; MU_NODES]> = (0..ALPHA_NODES).into_par_iter().map(row).collect();
        Self { rows: rows.into() }
    }

    /// What passes bloom and coat of diffuse light with a weight at each cosine, for each roughness
    /// of the table.
    pub(super) fn passed(&self, bloom: &Bloom, weight: impl Fn(f32) -> f32) -> Box<[Passed]> {
        let passed = |row: &[f32; MU_NODES], mu: f32| {
            (1.0 - along(row, mu)) * (1.0 - bloom.sent_back(mu)) * weight(mu)
        };
        let rows = self.rows.iter();
        rows.map(|row| Passed::of_sums(slants(|mu| passed(row, mu))))
            .collect()
    }

    /// The coat of this roughness under a bloom; beyond the table's range that of its end.
    pub fn coat<'a>(
        &'a self,
        eta: f32,
        [alpha_x, alpha_y]: [f32; 2],
        bloom: &'a Bloom,
    ) -> LocalCoat<'a> {
        let [least, most] = ALPHAS;
        let ggx = Ggx {
            alpha_x: alpha_x.clamp(least, most),
            alpha_y: alpha_y.clamp(least, most),
        };
        let mean = (0.5 * (ggx.alpha_x * ggx.alpha_x + ggx.alpha_y * ggx.alpha_y)).sqrt();
        let place = ((mean - least) / (most - least)).max(0.0).sqrt() * (ALPHA_NODES - 1) as f32;
        let row = (place as usize).min(ALPHA_NODES - 2);
        let [low, high] = [alpha_of(row), alpha_of(row + 1)];
        LocalCoat {
            ggx,
            eta,
            table: self,
            bloom,
            row,
            share: ((mean - low) / (high - low)).clamp(0.0, 1.0),
        }
    }
}

impl LocalCoat<'_> {
    /// Whether the coat reflects anything.
    #[inline]
    pub fn shines(&self) -> bool {
        self.eta != 1.0
    }

    /// `E` at a cosine: what coat and bloom send back.
    #[inline]
    pub fn reflected(&self, mu: f32) -> f32 {
        1.0 - (1.0 - self.shone(mu)) * (1.0 - self.sent_back(mu))
    }

    /// What the coat alone reflects.
    #[inline]
    fn shone(&self, mu: f32) -> f32 {
        let mu = mu.clamp(0.0, 1.0);
        let rows = &self.table.rows;
        along(&rows[self.row], mu) * (1.0 - self.share)
            + along(&rows[self.row + 1], mu) * self.share
    }

    /// What the bloom sends back.
    #[inline]
    pub fn sent_back(&self, mu: f32) -> f32 {
        self.bloom.sent_back(mu)
    }

    /// The bloom's `f`, given what it sends back of light from either direction.
    #[inline]
    pub fn bloom(&self, from_wo: f32, from_wi: f32) -> f32 {
        if self.bloom.mean == 0.0 {
            return 0.0;
        }
        from_wo * from_wi * FRAC_1_PI / self.bloom.mean
    }

    /// What passes coat and bloom of light that is alike from all directions.
    #[inline]
    pub fn passed(&self) -> Passed {
        self.along_roughness(&self.bloom.passed)
    }

    /// The value at the coat's roughness of a list with one for each roughness of the table.
    #[inline]
    pub(super) fn along_roughness(&self, values: &[Passed]) -> Passed {
        values[self.row].towards(values[self.row + 1], self.share)
    }

    /// The lobe's value and its sampling density for two directions on the side +z.
    #[inline]
    pub fn lobe(&self, wo: Vec3, lambda: f32, wi: Vec3) -> (f32, f32) {
        super::coat::coat_lobe(self.ggx, self.eta, wo, lambda, wi)
    }
}

fn alpha_of(node: usize) -> f32 {
    let [least, most] = ALPHAS;
    let x = node as f32 / (ALPHA_NODES - 1) as f32;
    least + (most - least) * x * x
}

fn mu_of(node: usize) -> f32 {
    let x = node as f32 / (MU_NODES - 1) as f32;
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::directional_albedo::DirectionalAlbedo;

    #[test]
    fn a_coat_of_the_table_reflects_what_its_own_table_says() {
        let table = CoatTable::of(1.45);
        for alpha in [0.1, 0.3, 0.47, 0.8] {
            let ggx = Ggx {
                alpha_x: alpha,
                alpha_y: alpha,
            };
            let own = DirectionalAlbedo::new(ggx, 1.45);
            let none = Bloom::new(0.0, &table);
            let coat = table.coat(1.45, [alpha; 2], &none);
            assert!(
                (1.0 - coat.passed().mean - own.mean()).abs() < 1e-3,
                "{alpha}"
            );
            for mu in [0.05_f32, 0.2, 0.5, 1.0] {
                let expected = own.at(Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu));
                let found = coat.reflected(mu);
                assert!(
                    (found - expected).abs() < 6e-3,
                    "{found} {expected} {alpha} {mu}"
                );
            }
        }
    }
}
