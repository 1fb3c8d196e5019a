//! Greens that are not even: fields between veins differ, larger patches of the leaf do, and tissue
//! along primaries is paler.
//!
//! Each texel's chlorophyll and carotenoids are multiplied by
//!
//! `(1 + a f) (1 + b g) (1 − c exp(−d / w)) / m`
//!
//! with a number f of mean 0 and deviation 1 for each field that veins of the first three orders
//! enclose, smooth noise g of mean 0 and deviation 1, the distance d from the axis of the nearest
//! primary, and the mean m of the rest over the blade, weighted by chlorophyll.
//!
//! - **In**: an [`Unevenness`], a painted map, margin and veins, a seed.
//! - **Out**: the map with its pigments changed.
//! - **Always true**: the blade as a whole holds as much chlorophyll as before.
//! - **Left out**: whence it comes: light flecks, age, supply.

mod grid;

use glam::DVec2;
use rayon::prelude::*;

use self::grid::{Grid, NOISE_DEVIATION};
use super::contents_map::ContentsMap;
use super::coverage::{Coverage, extend};
use super::frame::UvFrame;
use super::mottle::Mottle;
use crate::document::Declared;
use crate::optics::Constituent;
use crate::plane::distances::Distances;
use crate::shape::outline::Outline;
use crate::venation::network::VeinSegment;

/// By how much the greens of a blade differ from place to place.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Unevenness {
    /// Coefficient of variation of chlorophyll from field to field between veins of the first three
    /// orders.
    #[key("fields", 0.0..=0.3)]
    pub fields: f64,
    /// Coefficient of variation of chlorophyll from patch to patch.
    #[key("patches", 0.0..=0.3)]
    pub patches: f64,
    /// Size of the patches.
    #[key("patch_mm", 0.5..=500.0)]
    pub patch_mm: f64,
    /// Share of the chlorophyll that tissue at primaries lacks.
    #[key("along_primaries", 0.0..=0.9)]
    pub along_primaries: f64,
    /// Distance from the axes of primaries over which that falls to 1/e.
    #[key("reach_mm", 0.05..=100.0)]
    pub reach_mm: f64,
}

impl Default for Unevenness {
    /// A broad leaf as one sees it against the light; by eye.
    fn default() -> Self {
        Self {
            fields: 0.04,
            patches: 0.04,
            patch_mm: 14.0,
            along_primaries: 0.08,
            reach_mm: 2.0,
        }
    }
}

/// What the seed is changed by, so that patches and fields do not follow the mottle.
const OTHER: [u64; 2] = [0x9a7c_5e11, 0x51e1_d5aa];

impl Unevenness {
    /// Changes the pigments of a map over `frame`.
    pub(crate) fn apply(
        &self,
        map: &mut ContentsMap,
        frame: &UvFrame,
        outline: &Outline,
        veins: &[VeinSegment],
        seed: u64,
    ) {
        let grid = Grid {
            frame,
            width: map.width as usize,
            height: map.height as usize,
        };
        let inside = grid.inside(outline);
        let mut factors = if self.fields > 0.0 {
            let mut numbers = grid.field_numbers(&inside, veins, seed ^ OTHER[0]);
            for f in &mut numbers {
                *f = 1.0 + self.fields * *f;
            }
            numbers
        } else {
            vec![1.0; map.texels.len()]
        };
        let noise = Mottle::new(seed ^ OTHER[1], self.patch_mm);
        let lines: Vec<[DVec2; 2]> = veins
            .iter()
            .filter(|vein| vein.order == 1)
            .map(|vein| [vein.from, vein.to])
            .collect();
        // Without primaries all is infinitely far from them.
        let size = [grid.width, grid.height];
        let coverage = Coverage::new(outline.points(), frame, size);
        let away = Distances::new(lines).of_grid(
            size,
            |[column, row]| grid.middle(column, row),
            |row| coverage.row(row),
        );
        grid.each_row(&mut factors, |row, factors| {
            let covered = coverage.row(row);
            for (column, factor) in factors.iter_mut().enumerate().filter(|(c, _)| covered[*c]) {
                let patch = noise.at(grid.middle(column, row));
                let patch = (patch / NOISE_DEVIATION).clamp(-2.5, 2.5);
                let paler = libm::exp(-away[row * grid.width + column] / self.reach_mm);
                *factor *= (1.0 + self.patches * patch) * (1.0 - self.along_primaries * paler);
            }
            extend(factors, covered);
        });
        // One texel after the other, so that the sums do not depend on the number of threads.
        let (mut before, mut after) = (0.0, 0.0);
        for ((texel, factor), _) in (map.texels.iter().zip(&factors))
            .zip(&inside)
            .filter(|(_, inside)| **inside)
        {
            let chlorophyll = f64::from(texel[Constituent::Chlorophyll]);
            before += chlorophyll;
            after += chlorophyll * *factor;
        }
        let mean = if before > 0.0 { after / before } else { 1.0 };
        let texels = map.texels.par_iter_mut().with_min_len(1 << 12);
        texels.zip(factors).for_each(|(texel, factor)| {
            for pigment in [Constituent::Chlorophyll, Constituent::Carotenoids] {
                texel[pigment] = (f64::from(texel[pigment]) * factor / mean) as f32;
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grow_options::GrowOptions;
    use std::sync::LazyLock;

    use crate::leaf::{Lamina, LeafPlan};
    use crate::species::find;

    fn plan(unevenness: Option<Unevenness>) -> LeafPlan {
        let mut plan = find("tertiary").expect("a preset").plan();
        plan.map_size = 320;
        plan.tissue.mottle = 0.0;
        plan.unevenness = unevenness;
        plan
    }

    /// Ratios of chlorophyll to that of the even leaf inside the blade, and their places; and both
    /// leaves' sums.
    fn ratios(unevenness: Unevenness) -> (Vec<(DVec2, f64)>, [f64; 2]) {
        let lamina = &*LAMINA;
        let [even, own] = [None, Some(unevenness)].map(|unevenness| {
            let map = GrowOptions::default().contents(&plan(unevenness), lamina);
            map.expect("a good plan")
        });
        let frame = frame();
        let grid = Grid {
            frame: &frame,
            width: own.width as usize,
            height: own.height as usize,
        };
        let mut ratios = Vec::new();
        let mut sums = [0.0; 2];
        for (i, pair) in even.texels.iter().zip(&own.texels).enumerate() {
            let p = grid.place(i);
            if lamina.outline.contains(p) {
                let [was, own] = [pair.0, pair.1];
                let [was, own] = [was, own].map(|texel| f64::from(texel[Constituent::Chlorophyll]));
                sums[0] += was;
                sums[1] += own;
                ratios.push((p, own / was));
            }
        }
        (ratios, sums)
    }

    /// Distances to veins of these orders.
    fn distances(orders: [u8; 2]) -> Distances {
        let segments = LAMINA.network.segments();
        let those = segments.filter(|vein| (orders[0]..=orders[1]).contains(&vein.order));
        Distances::new(those.map(|vein| [vein.from, vein.to]).collect())
    }

    fn frame() -> UvFrame {
        UvFrame::around(LAMINA.outline.points())
    }

    static LAMINA: LazyLock<Lamina> =
        LazyLock::new(|| plan(None).grow_lamina().expect("a good plan"));

    fn deviation(values: &[f64]) -> f64 {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n).sqrt()
    }

    const NONE: Unevenness = Unevenness {
        fields: 0.0,
        patches: 0.0,
        patch_mm: 10.0,
        along_primaries: 0.0,
        reach_mm: 2.0,
    };

    #[test]
    fn the_leaf_holds_as_much_as_before_and_varies_by_what_was_asked() {
        let cases = [
            Unevenness {
                fields: 0.06,
                ..NONE
            },
            Unevenness {
                patches: 0.06,
                patch_mm: 6.0,
                ..NONE
            },
        ];
        for unevenness in cases {
            let (ratios, [was, own]) = ratios(unevenness);
            assert!((own / was - 1.0).abs() < 1e-6, "{was} {own}");
            let values: Vec<f64> = ratios.iter().map(|(_, ratio)| *ratio).collect();
            let cv = deviation(&values);
            // Few patches and fields of unlike size: a leaf's own deviation is about that asked for.
            assert!((0.035..0.085).contains(&cv), "{unevenness:?}: {cv}");
        }
    }

    #[test]
    fn fields_are_even_inside_and_differ_across_tertiaries() {
        let (ratios, _) = ratios(Unevenness {
            fields: 0.06,
            ..NONE
        });
        let distances = distances([1, grid::ENCLOSING]);
        // Beside a place far from veins there is the same green.
        let texel = frame().size.max_element() / 320.0;
        let mut steps = [Vec::new(), Vec::new()];
        for pair in ratios.windows(2) {
            let is_row = (pair[0].0.y - pair[1].0.y).abs() < 1e-9;
            if is_row && pair[1].0.x - pair[0].0.x < 1.5 * texel {
                let near = distances.at(pair[0].0) < texel;
                let far = distances.at(pair[0].0) > 5.0 * texel;
                if near || far {
                    steps[usize::from(near)].push((pair[0].1 - pair[1].1).abs());
                }
            }
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        assert!(steps[0].len() > 500, "{}", steps[0].len());
        assert!(mean(&steps[0]) < 1e-6, "{}", mean(&steps[0]));
        assert!(mean(&steps[1]) > 0.004, "{}", mean(&steps[1]));
    }

    #[test]
    fn tissue_along_primaries_is_paler() {
        let (ratios, _) = ratios(Unevenness {
            along_primaries: 0.2,
            ..NONE
        });
        let distances = distances([1, 1]);
        let far = ratios.iter().find(|(p, _)| distances.at(*p) > 12.0);
        let far = far.expect("a place far away").1;
        for (p, ratio) in &ratios {
            let expected = 1.0 - 0.2 * libm::exp(-distances.at(*p) / 2.0);
            assert!((ratio / far - expected).abs() < 2e-3, "{ratio} {expected}");
        }
    }
}
