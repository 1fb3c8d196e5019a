//! The inside of a leaf as five layers, for light that is followed through it.
//!
//! - **In**: contents, uniform or from a map, and the roughness of both faces.
//! - **Out**: a [`walk::Walk`] at a path's wavelengths, which says where light meets a face.
//! - **Always true**: without absorption nothing is lost; a uniform leaf with smooth faces is
//!   [`optics::layers`] at each of them.
//! - **Left out**: into air all wavelengths of a path go in one direction; where cells of a map are
//!   empty they scatter as the others do.
//!
//! `docs/src/theory/leaf-layers.md` describes it under "In pictures".

use optics::layers::{Anatomy, LayeredLeaf, Tissue};
use optics::{Constituent, Contents, ProspectD};
use rayon::prelude::*;

use crate::material::held::Held;

pub mod walk;

/// Number of layers.
const LAYERS: usize = Tissue::ALL.len();
/// Wavelengths at which the layers are tabulated, nm: first, step, number.
const TABLE_NM: (f64, f64, usize) = (400.0, 10.0, 211);
/// Structures `N` at which the amount of scattering is tabulated: first, step, number.
const STRUCTURES: (f64, f64, usize) = (1.0, 0.125, 33);

/// Least thickness of a leaf, in thicknesses of the anatomy. One without water and dry matter has none,
/// and coefficients along a path, which are optical depths over thickness, must stay finite.
const LEAST_AMOUNT: f64 = 1e-6;

/// The layers at one wavelength.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Refractive indices.
    index: [f32; LAYERS],
    /// Optical depths of scattering.
    scattering: [f32; LAYERS],
    /// Mean cosine of scattering.
    g: f32,
}

/// The inside of a leaf.
#[derive(Clone, Debug)]
pub struct LeafLayers {
    /// Thickness of each layer, from the adaxial face on, m.
    thickness_m: [f32; LAYERS],
    /// Share of each constituent in each layer.
    shares: [[f32; Constituent::COUNT]; LAYERS],
    /// By wavelength.
    rows: Vec<Row>,
    /// Scattering over that of the mean structure, by structure; empty if the leaf is uniform.
    by_structure: Vec<f32>,
    /// The greatest of it that the map has.
    most: f32,
    /// GGX roughness of the adaxial and the abaxial face.
    alpha: [f32; 2],
}

impl LeafLayers {
    /// The layers of a leaf with these contents, whose faces are this rough (0 is smooth).
    ///
    /// Thickness, refractive indices and whether cells are full follow from the mean of a map.
    pub fn new(held: &Held, alpha: [f32; 2]) -> Self {
        let mean = held.mean();
        let leaf = LayeredLeaf::new(&mean);
        let anatomy = Anatomy::BIFACIAL;
        let whole: f64 = Tissue::ALL
            .map(|tissue| anatomy.thickness_um(tissue))
            .iter()
            .sum();
        let amount = (leaf.thickness_um() / whole).max(LEAST_AMOUNT);
        let by_structure = match held {
            Held::Uniform(_) => Vec::new(),
            Held::Map(_) => by_structure(&mean),
        };
        let most = match held {
            Held::Uniform(_) => 1.0,
            Held::Map(map) => map
                .texels()
                .iter()
                .map(|texel| between(&by_structure, STRUCTURES, texel[Constituent::Structure]))
                .fold(0.0, f32::max),
        };
        Self {
            thickness_m: Tissue::ALL
                .map(|tissue| (1e-6 * amount * anatomy.thickness_um(tissue)) as f32),
            shares: Tissue::ALL.map(|tissue| {
                Constituent::ALL.map(|constituent| anatomy.share(constituent, tissue) as f32)
            }),
            rows: (0..TABLE_NM.2)
                .into_par_iter()
                .map(|step| row(&leaf, TABLE_NM.0 + TABLE_NM.1 * step as f64))
                .collect(),
            by_structure,
            most,
            alpha,
        }
    }

    /// The layers at a wavelength, linear between those of the table.
    fn row(&self, nm: f32) -> Row {
        let (first, step, count) = TABLE_NM;
        let place = ((nm - first as f32) / step as f32).clamp(0.0, (count - 1) as f32);
        let below = (place as usize).min(count - 2);
        let share = place - below as f32;
        let (a, b) = (&self.rows[below], &self.rows[below + 1]);
        let mix = |a: f32, b: f32| a + share * (b - a);
        Row {
            index: std::array::from_fn(|layer| mix(a.index[layer], b.index[layer])),
            scattering: std::array::from_fn(|layer| mix(a.scattering[layer], b.scattering[layer])),
            g: mix(a.g, b.g),
        }
    }

    /// How much more than with the mean structure it scatters with this one.
    fn more_scattering(&self, structure: f32) -> f32 {
        if self.by_structure.is_empty() {
            1.0
        } else {
            between(&self.by_structure, STRUCTURES, structure)
        }
    }
}

/// A table's value between its nodes, at an end beyond them.
fn between(table: &[f32], (first, step, count): (f64, f64, usize), at: f32) -> f32 {
    let place = ((at - first as f32) / step as f32).clamp(0.0, (count - 1) as f32);
    let below = (place as usize).min(count - 2);
    let share = place - below as f32;
    table[below] + share * (table[below + 1] - table[below])
}

fn row(leaf: &LayeredLeaf, nm: f64) -> Row {
    let stack = leaf.stack(&ProspectD::coefficients_extrapolated(nm));
    let layers = stack.layers();
    Row {
        index: std::array::from_fn(|layer| layers[layer].index as f32),
        scattering: std::array::from_fn(|layer| {
            (layers[layer].depth * layers[layer].albedo) as f32
        }),
        g: layers[0].phase.mean_cosine() as f32,
    }
}

/// Scattering by structure, over that of the mean contents.
fn by_structure(mean: &Contents) -> Vec<f32> {
    // The scattering of full and of empty cells is asked for as the optical depth of the spongy
    // mesophyll at 800 nm, which is proportional to it.
    let depth = |contents: &Contents| {
        let leaf = LayeredLeaf::new(contents);
        f64::from(row(&leaf, 800.0).scattering[Tissue::Spongy as usize])
    };
    let whole = depth(mean);
    let (first, step, count) = STRUCTURES;
    (0..count)
        .into_par_iter()
        .map(|number| {
            let structure = first + step * number as f64;
            let contents = mean.with(&[(Constituent::Structure, structure)]);
            (depth(&contents) / whole) as f32
        })
        .collect()
}

#[cfg(test)]
mod tests;
