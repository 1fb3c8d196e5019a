//! Dust on the faces of a blade: how much of it lies where.
//!
//! Grains of one diameter d and of the density of quartz lie on a face, m grams on a square metre.
//! A beam straight down meets them with the optical thickness `τ = 3 m / (2 ρ d)`, that is the
//! cross-section of spheres, and they cover `1 − exp(−τ)` of the face: the exponential law with
//! which measured spectra of dusty leaves agree best (\[ma2023\]).
//!
//! Water that leaves a face carries dust into grooves over veins and to the margin, above all to
//! the tip. The load at a place is
//!
//! `m (1 + a e^(−d_v / w)) (1 + b e^(−d_m / 4w)) (1 + c n) / mean`
//!
//! with the distances `d_v` to the nearest vein of the first two orders and `d_m` to the margin, and
//! smooth noise n in [−1, 1]. The form is ours.

use glam::DVec2;

use super::super::mottle::Mottle;
use crate::document::Declared;
use crate::plane::distances::Distances;
use crate::plane::polygon;
use crate::venation::network::VeinSegment;

/// Density of quartz, g cm⁻³.
const DENSITY: f64 = 2.65;
/// Highest order of the veins along which dust gathers.
const GATHERING: u8 = 2;
/// How much further from the margin than from veins dust gathers.
const MARGIN_REACH: f64 = 4.0;
/// What the seed is changed by, so that dust does not follow other patches.
const OTHER: u64 = 0xd057_1a7e;
/// Greatest optical thickness: such a face is covered whole.
const MOST_TAU: f64 = 8.0;

/// Mineral dust on the faces of a blade.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct DustPlan {
    /// Mean load of the adaxial face. With grains of 12 µm, 5 g cover a fifth of it.
    #[key("adaxial_g_per_m2", 0.0..=50.0, at = 0)]
    /// Mean load of the abaxial face.
    #[key("abaxial_g_per_m2", 0.0..=50.0, at = 1)]
    pub load_g_per_m2: [f64; 2],
    /// Diameter of the grains. Smaller ones cover more for their mass.
    #[key("grain_um", 1.0..=100.0)]
    pub grain_um: f64,
    /// Factor on the reflectance of the dry soil that the dust comes from.
    #[key("brightness", 0.1..=1.5)]
    pub brightness: f64,
    /// Variation of the load from patch to patch, as a share of it.
    #[key("patchiness", 0.0..=1.0)]
    pub patchiness: f64,
    /// Size of the patches.
    #[key("patch_mm", 0.2..=200.0)]
    pub patch_mm: f64,
    /// By how much more lies on veins of the first two orders, over the load far from them.
    #[key("at_veins", 0.0..=10.0)]
    pub at_veins: f64,
    /// By how much more lies at the margin, where water leaves the blade.
    #[key("at_margin", 0.0..=10.0)]
    pub at_margin: f64,
    /// Distance from a vein over which that falls to 1/e; four times that from the margin.
    #[key("reach_mm", 0.05..=50.0)]
    pub reach_mm: f64,
}

impl DustPlan {
    /// Clean faces.
    pub const NONE: Self = Self {
        load_g_per_m2: [0.0; 2],
        grain_um: 12.0,
        brightness: 1.0,
        patchiness: 0.5,
        patch_mm: 6.0,
        at_veins: 0.8,
        at_margin: 0.8,
        reach_mm: 0.6,
    };

    /// Whether there is any.
    pub fn is_there(&self) -> bool {
        self.load_g_per_m2.iter().any(|&load| load > 0.0)
    }

    /// Optical thickness of a load, g m⁻².
    pub(crate) fn optical_thickness(&self, load_g_per_m2: f64) -> f64 {
        // g m⁻² over g cm⁻³ is µm: the thickness of the grains if they were melted together.
        1.5 * load_g_per_m2 / (DENSITY * self.grain_um)
    }
}

/// Where dust gathers on a blade.
#[derive(Debug)]
pub(super) struct Gathering {
    plan: DustPlan,
    veins: Option<Distances>,
    margin: Option<Distances>,
    noise: Mottle,
}

impl Gathering {
    pub(super) fn new(plan: DustPlan, veins: &[VeinSegment], margin: &[DVec2], seed: u64) -> Self {
        let of = |lines: Vec<[DVec2; 2]>, more: f64| {
            (more > 0.0 && !lines.is_empty()).then(|| Distances::new(lines))
        };
        let lines = veins.iter().filter(|vein| vein.order <= GATHERING);
        let lines = lines.map(|vein| [vein.from, vein.to]).collect();
        let sides = polygon::sides(margin).map(<[DVec2; 2]>::from).collect();
        Self {
            veins: of(lines, plan.at_veins),
            margin: of(sides, plan.at_margin),
            noise: Mottle::new(seed ^ OTHER, plan.patch_mm),
            plan,
        }
    }

    /// The load at a point over that of a place far from veins and margin, ≥ 0.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let plan = &self.plan;
        let near = |field: &Option<Distances>, more: f64, reach: f64| {
            field
                .as_ref()
                .map_or(1.0, |field| 1.0 + more * libm::exp(-field.at(p) / reach))
        };
        near(&self.veins, plan.at_veins, plan.reach_mm)
            * near(&self.margin, plan.at_margin, MARGIN_REACH * plan.reach_mm)
            * (1.0 + plan.patchiness * self.noise.at(p))
    }
}

/// Turns relative loads, `f64::NAN` beyond the margin, into optical thicknesses of both faces whose
/// mean load is the plan's.
pub(super) fn optical_thicknesses(plan: &DustPlan, loads: &[f64]) -> Vec<[f32; 2]> {
    let there = loads.iter().filter(|load| !load.is_nan());
    let (sum, count) = there.fold((0.0, 0.0), |(sum, n), load| (sum + load, n + 1.0));
    let per_load = plan
        .load_g_per_m2
        .map(|load| plan.optical_thickness(load) * if sum > 0.0 { count / sum } else { 0.0 });
    let tau = |load: &f64| {
        let load = if load.is_nan() { 0.0 } else { *load };
        per_load.map(|per_load| (per_load * load).min(MOST_TAU) as f32)
    };
    loads.iter().map(tau).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_grams_of_grains_cover_what_their_cross_sections_do() {
        // 10 g of spheres of 20 µm: 10 / (2.65e6 · π/6 · (2e-5)³) of them, of π (1e-5)² each.
        let plan = DustPlan {
            grain_um: 20.0,
            ..DustPlan::NONE
        };
        let pi = std::f64::consts::PI;
        let count = 10.0 / (2.65e6 * pi / 6.0 * 2e-5_f64.powi(3));
        let expected = count * pi * 1e-10;
        let found = plan.optical_thickness(10.0);
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }

    #[test]
    fn the_mean_load_is_the_plans_whatever_the_pattern() {
        let plan = DustPlan {
            load_g_per_m2: [4.0, 1.0],
            ..DustPlan::NONE
        };
        let vein = VeinSegment {
            from: DVec2::new(10.0, 0.0),
            to: DVec2::new(10.0, 20.0),
            radius_from: 0.3,
            radius_to: 0.1,
            order: 1,
        };
        let margin = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(DVec2::from);
        let gathering = Gathering::new(plan, &[vein], &margin, 7);
        let loads: Vec<f64> = (0..10_000)
            .map(|i| {
                let p = DVec2::new(f64::from(i % 100), f64::from(i / 100)) * 0.2 + 0.1;
                if i % 7 == 0 {
                    f64::NAN
                } else {
                    gathering.at(p)
                }
            })
            .collect();
        let taus = optical_thicknesses(&plan, &loads);
        let mean = |face: usize| {
            let covered = taus.iter().zip(&loads).filter(|(_, load)| !load.is_nan());
            let (sum, count) = covered.fold((0.0, 0.0), |(sum, n), (tau, _)| {
                (sum + f64::from(tau[face]), n + 1.0)
            });
            sum / count
        };
        for (face, load) in [(0, 4.0), (1, 1.0)] {
            let expected = plan.optical_thickness(load);
            assert!((mean(face) / expected - 1.0).abs() < 1e-5);
        }
        // It is irregular, and more lies on the vein and at the margin.
        let band = |near: &dyn Fn(f64) -> bool| {
            let cells = (0..10_000).filter(|i| i % 7 != 0 && (30..70).contains(&(i / 100)));
            let cells: Vec<usize> = cells
                .filter(|i| near((i % 100) as f64 * 0.2 + 0.1))
                .collect();
            cells.iter().map(|&i| f64::from(taus[i][0])).sum::<f64>() / cells.len() as f64
        };
        let on_vein = band(&|x| (x - 10.0).abs() < 0.3);
        let between = band(&|x| (x - 10.0).abs() > 4.0 && (x - 10.0).abs() < 6.0);
        let at_margin = band(&|x| (x - 10.0).abs() > 9.5);
        assert!(on_vein > 1.3 * between, "{on_vein} {between}");
        assert!(at_margin > 1.3 * between, "{at_margin} {between}");
    }
}
