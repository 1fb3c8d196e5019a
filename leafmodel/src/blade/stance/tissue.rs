//! What the cells of a blade's shell are made of, and what they want to be.

use std::f64::consts::PI;

use glam::DVec2;

use super::plan::{Drying, Stance};
use crate::blade::mottle::Mottle;
use crate::blade::plan::BladeForm;
use crate::random::{Use, bits};
use crate::shape::outline::Outline;
use crate::shell::{Grid, Patch};
use crate::venation::network::VeinSegment;

/// Young's modulus of a turgid lamina, N/mm², and that of veins over it. Laminae lie between some 5
/// and 100 N/mm², veins at several hundred; both by eye within that.
const LAMINA: f64 = 30.0;
const VEINS: f64 = 8.0;
/// Share of a turgid blade's stiffness that remains without turgor, and factor of an air-dry one.
const FLACCID: f64 = 0.02;
const DRY: f64 = 10.0;
/// Thickness of an air-dry lamina over that of a fresh one.
const DRY_THICKNESS: f64 = 0.6;
/// Veins from this radius, mm, count as rods.
const ROD: f64 = 0.04;
/// Curvature of two equal layers over their difference in strain and the thickness of both
/// (\[timoshenko1925\]).
const BILAYER: f64 = 1.5;
/// A sheet is stretched as if it were this share of a cell thick at least: waves shorter than
/// cells would otherwise be wanted.
const STRETCHED_AS: f64 = 0.12;
/// Sizes of patches that differ, as shares of the leaf's length.
const PATCHES: [f64; 2] = [0.22, 0.08];
/// Disorder of a growing margin: curvature in units of the leaf's length.
const DISORDER: f64 = 0.5;
/// Weight of 1 g/cm², N/mm².
const GRAVITY: f64 = 9.81e-5;

/// Share of a turgid blade's stiffness. It falls in proportion to the turgor, as the modulus of
/// parenchyma does (\[nilsson1958\]).
pub(super) fn stiffness_left(stance: &Stance) -> f64 {
    let wilted = stance.wilting.map_or(0.0, |wilting| wilting.share);
    1.0 - (1.0 - FLACCID) * wilted
}

/// Weight over area, N/mm², of tissue that holds so much water (cm) and dry matter (g/cm²).
pub(super) fn weight(stance: &Stance, [water, dry_matter]: [f64; 2]) -> f64 {
    let dry = stance.drying.map_or(0.0, |drying| drying.share);
    GRAVITY * (water * (1.0 - 0.9 * dry) + dry_matter)
}

/// Young's modulus of veins, N/mm².
pub(super) fn veins_modulus(stance: &Stance) -> f64 {
    LAMINA * VEINS * stiffness_left(stance)
}

/// The patches of a blade, one for each cell.
pub(super) fn patches(
    grid: &Grid,
    stance: &Stance,
    form: &BladeForm,
    (outline, veins): (&Outline, &[VeinSegment]),
    weight: f64,
    seed: u64,
) -> Vec<Patch> {
    let length = outline.length();
    let dry = stance.drying.map_or(0.0, |drying| drying.share);
    let modulus = LAMINA * stiffness_left(stance) * (1.0 + (DRY - 1.0) * dry);
    let thickness = form.thickness_mm * (1.0 - (1.0 - DRY_THICKNESS) * dry);
    let bend = modulus * thickness * thickness * thickness / 12.0;
    let thick = thickness.max(STRETCHED_AS * grid.spacing());
    let rods = Rods::new(grid, veins);
    let noise = |which: u64, size: f64| {
        Mottle::new(
            bits(seed, Use::Stance, which),
            PATCHES[0].min(size) * length,
        )
    };
    let [coarse, fine] = [noise(0, PATCHES[0]), noise(1, PATCHES[1])];
    let [bent, crisp] = [noise(2, PATCHES[0]), noise(3, PATCHES[1])];
    (0..grid.cells())
        .map(|cell| {
            let p = grid.centre(cell);
            let mut patch = Patch {
                stretch: 12.0 * bend / (thick * thick),
                bend,
                growth: [1.0, 1.0, 0.0],
                curvature: [0.0; 3],
                veins: rods.stiffness(cell, VEINS * modulus),
                veins_growth: 1.0,
                veins_curvature: 0.0,
                weight,
            };
            if let Some(growth) = stance.margin_growth {
                let inside = outline.distance_to_margin(p);
                let grown = growth.excess * libm::exp(-inside / (growth.width * length));
                patch.growth = [1.0 + grown, 1.0 + grown, 0.0];
                let disorder = DISORDER * (bent.at(p) + crisp.at(p)) / length;
                patch.curvature = [disorder, disorder, 0.0];
            }
            if let Some(drying) = stance.drying {
                let [shrunk, curled] = [(coarse, fine), (bent, crisp)].map(|(one, other)| {
                    (1.0 + drying.unevenness * (one.at(p) + 0.7 * other.at(p))).max(0.0)
                });
                dry_patch(
                    &mut patch,
                    &drying,
                    rods.along(cell),
                    [shrunk, curled],
                    thickness,
                );
                patch.veins_curvature = dry * drying.bow / length;
            }
            patch
        })
        .collect()
}

/// Lets a patch dry. `along` is the direction of veins as a tensor of trace ≤ 1, `[11, 22, 12]`.
fn dry_patch(
    patch: &mut Patch,
    drying: &Drying,
    along: [f64; 3],
    [shrunk, curled]: [f64; 2],
    thickness: f64,
) {
    let less = 1.0 - drying.along;
    // Across veins 1, along them `drying.along`.
    let pattern = [
        1.0 - less * along[0],
        1.0 - less * along[1],
        -less * along[2],
    ];
    let shrinkage = drying.share * drying.shrinkage * shrunk;
    let curvature = BILAYER * drying.share * drying.faces * curled / thickness;
    for (i, &across) in pattern.iter().enumerate() {
        let fresh = patch.growth[i];
        // `along` has no part in a shear that is not there.
        patch.growth[i] = fresh * if i < 2 { 1.0 - shrinkage * across } else { 1.0 };
        patch.curvature[i] += curvature * across;
    }
    patch.growth[2] -= shrinkage * pattern[2];
    patch.veins_growth = 1.0 - drying.share * drying.shrinkage * drying.along;
}

/// Veins as rods in the cells that they run through.
struct Rods {
    /// Sums over length and cross-section: `∫ A d d`, `∫ I d d` over the cell's area, with `d` the
    /// direction's tensor, entry 12 twice.
    forms: Vec<[[[f64; 3]; 3]; 2]>,
    /// Sum of the directions' tensors, by radius squared.
    directions: Vec<[f64; 3]>,
}

impl Rods {
    fn new(grid: &Grid, veins: &[VeinSegment]) -> Self {
        let mut rods = Self {
            forms: vec![[[[0.0; 3]; 3]; 2]; grid.cells()],
            directions: vec![[0.0; 3]; grid.cells()],
        };
        let h = grid.spacing();
        for vein in veins {
            let radius = 0.5 * (vein.radius_from + vein.radius_to);
            let whole = vein.to - vein.from;
            let length = whole.length();
            if radius < ROD || length == 0.0 {
                continue;
            }
            let t = whole / length;
            let tensor = [t.x * t.x, t.y * t.y, 2.0 * t.x * t.y];
            let pieces = (length / (0.5 * h)).ceil().max(1.0) as usize;
            for piece in 0..pieces {
                let at: DVec2 = vein.from + whole * ((piece as f64 + 0.5) / pieces as f64);
                if let Some(cell) = grid.cell(at) {
                    rods.add(cell, radius, length / pieces as f64 / (h * h), tensor);
                }
            }
        }
        rods
    }

    fn add(&mut self, cell: usize, radius: f64, length_over_area: f64, tensor: [f64; 3]) {
        let section = PI * radius * radius;
        let second = 0.25 * section * radius * radius;
        for (form, value) in self.forms[cell].iter_mut().zip([section, second]) {
            for row in 0..3 {
                for column in 0..3 {
                    form[row][column] += value * length_over_area * tensor[row] * tensor[column];
                }
            }
        }
        let weight = radius * radius * length_over_area;
        let sum = &mut self.directions[cell];
        *sum = [
            sum[0] + weight * tensor[0],
            sum[1] + weight * tensor[1],
            sum[2] + 0.5 * weight * tensor[2],
        ];
    }

    fn stiffness(&self, cell: usize, modulus: f64) -> [[[f64; 3]; 3]; 2] {
        self.forms[cell].map(|form| form.map(|row| row.map(|value| modulus * value)))
    }

    /// The direction that veins of the cell have in common: `(T − λ₂) / tr T` with the lesser
    /// principal value `λ₂`; nothing if they run all ways.
    fn along(&self, cell: usize) -> [f64; 3] {
        let [a, b, c] = self.directions[cell];
        let trace = a + b;
        if trace <= 0.0 {
            return [0.0; 3];
        }
        let half = 0.5 * (a - b);
        let lesser = 0.5 * trace - (half * half + c * c).sqrt();
        [(a - lesser) / trace, (b - lesser) / trace, c / trace]
    }
}
