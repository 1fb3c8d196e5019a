//! PROSPECT's constants for each palette of pigments of a scene.
//!
//! Scenes rarely have more than one or two palettes. Tables are made when the scene is built, once
//! for each distinct palette, and palettes are numbered.

use std::sync::{Arc, OnceLock};

use optics::fast::{self, PileLanes};
use optics::{Coefficients, Interface, Pigments, ProspectD, Texel};

use crate::simd::{Level, Sixteen, Task};
use crate::spectrum::{Lanes, Table, WavelengthGrid, Wavelengths};

/// First and last whole nanometre of PROSPECT's table.
const TABLE_NM: [usize; 2] = [400, 2500];

/// The composition of the pigment columns, with the resulting constants. Copies share one table.
#[derive(Clone, Debug)]
pub struct Palette {
    number: usize,
    pigments: Pigments,
    /// Constants for each whole nanometre.
    table: Arc<[Coefficients]>,
    /// Constants at the wavelengths of the picture's paths.
    tabulated: Option<Arc<Table>>,
    /// The vector instructions with which R and T are computed.
    level: Level,
}

/// PROSPECT-D's own columns, number 0.
impl Default for Palette {
    fn default() -> Self {
        static OWN: OnceLock<Palette> = OnceLock::new();
        OWN.get_or_init(|| Self::new(0, Pigments::default()))
            .clone()
    }
}

impl Palette {
    fn new(number: usize, pigments: Pigments) -> Self {
        let table = (TABLE_NM[0]..=TABLE_NM[1])
            .map(|nm| ProspectD::coefficients_of(&pigments, nm as f64))
            .collect();
        Self {
            number,
            pigments,
            table,
            tabulated: None,
            level: Level::best(),
        }
    }

    /// The palette with its constants evaluated at every wavelength of a grid.
    fn on(mut self, grid: &WavelengthGrid) -> Self {
        let constants = |nm| fast::constants(&self.coefficients(f64::from(nm)));
        self.tabulated = Some(Arc::new(Table::new(grid, constants)));
        self
    }

    /// PROSPECT's constants at a path's wavelengths.
    #[inline(always)]
    pub fn lanes<const N: usize>(&self, wavelengths: &Wavelengths<N>) -> PileLanes<N> {
        let table = self.tabulated.as_ref();
        let Some(row) = table.and_then(|table| table.row(wavelengths)) else {
            return self.fresh_lanes(wavelengths);
        };
        PileLanes {
            constants: row.map(|lanes| lanes.0),
        }
    }

    #[cold]
    #[inline(never)]
    fn fresh_lanes<const N: usize>(&self, wavelengths: &Wavelengths<N>) -> PileLanes<N> {
        PileLanes::new(&wavelengths.nm.map(|nm| self.coefficients(f64::from(nm))))
    }

    /// `(R, T)` of a leaf with these contents at a path's wavelengths.
    #[inline]
    pub fn reflectance_transmittance<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        contents: &Texel,
    ) -> (Lanes<N>, Lanes<N>) {
        self.level.run(OfContents {
            palette: self,
            wavelengths,
            contents,
        })
    }

    /// The vector instructions with which R and T are computed.
    pub fn level(&self) -> Level {
        self.level
    }

    /// The same palette, of which R and T are computed with these vector instructions.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// Its number among the palettes of the scene; 0 is PROSPECT-D's own.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The composition of its columns.
    pub fn pigments(&self) -> &Pigments {
        &self.pigments
    }

    /// The constants at a wavelength in nm, linear between whole nanometres; outside 400–2500 nm
    /// the end values hold.
    ///
    /// The mean transmissivities of the faces are interpolated too, not computed from the
    /// interpolated index. Over one nanometre the difference is below 1e-7, and the computation
    /// would dominate the time of a path.
    pub fn coefficients(&self, nm: f64) -> Coefficients {
        let table = &self.table;
        let place = (nm - TABLE_NM[0] as f64).clamp(0.0, (table.len() - 1) as f64);
        let below = (place as usize).min(table.len() - 2);
        let share = place - below as f64;
        let (a, b) = (&table[below], &table[below + 1]);
        let between = |low: f64, high: f64| low + share * (high - low);
        Coefficients {
            interface: Interface {
                refractive_index: between(
                    a.interface.refractive_index,
                    b.interface.refractive_index,
                ),
                t_av_40: between(a.interface.t_av_40, b.interface.t_av_40),
                t_av_90: between(a.interface.t_av_90, b.interface.t_av_90),
            },
            absorption: a.absorption.zip_with(b.absorption, between),
        }
    }
}

/// Wavelengths across a range, nm, at which a coat is compared with the whole.
pub(super) fn coarse(range_nm: [f64; 2]) -> impl Iterator<Item = f64> {
    const STEPS: u32 = 200;
    let [first, last] = range_nm;
    (0..=STEPS).map(move |i| first + (last - first) * f64::from(i) / f64::from(STEPS))
}

/// R and T of the same contents at all wavelengths.
struct OfContents<'a, const N: usize> {
    palette: &'a Palette,
    wavelengths: &'a Wavelengths<N>,
    contents: &'a Texel,
}

impl<const N: usize> Task for OfContents<'_, N> {
    type Output = (Lanes<N>, Lanes<N>);

    #[inline(always)]
    fn run<E: Sixteen>(self, _: E) -> Self::Output {
        let pile = self.palette.lanes(self.wavelengths);
        let (reflectance, transmittance) = pile.reflectance_transmittance(self.contents);
        (Lanes(reflectance), Lanes(transmittance))
    }
}

/// The distinct palettes of a scene, by number; the first is PROSPECT-D's own.
#[derive(Clone, Debug)]
pub struct Palettes {
    palettes: Vec<Palette>,
    grid: Option<WavelengthGrid>,
}

impl Default for Palettes {
    fn default() -> Self {
        Self {
            palettes: vec![Palette::default()],
            grid: None,
        }
    }
}

impl Palettes {
    /// An empty set for a picture with these wavelengths, at which constants are evaluated in
    /// advance.
    pub fn on(grid: &WavelengthGrid) -> Self {
        Self {
            palettes: vec![Palette::default().on(grid)],
            grid: Some(grid.clone()),
        }
    }

    /// The palette of these pigments, made on first use.
    pub fn of(&mut self, pigments: &Pigments) -> Palette {
        let known = self
            .palettes
            .iter()
            .find(|palette| palette.pigments == *pigments);
        if let Some(palette) = known {
            return palette.clone();
        }
        let mut palette = Palette::new(self.palettes.len(), pigments.clone());
        if let Some(grid) = &self.grid {
            palette = palette.on(grid);
        }
        self.palettes.push(palette.clone());
        palette
    }

    /// All palettes, by number.
    pub fn iter(&self) -> impl Iterator<Item = &Palette> {
        self.palettes.iter()
    }
}

#[cfg(test)]
mod tests {
    use optics::Constituent;
    use optics::pigments::{CarotenoidMix, ChlorophyllMix};

    use super::*;
    use crate::spectrum::WavelengthSampler;
    use crate::spectrum::observer::Observer;
    use crate::spectrum::recorded::FilmKind;

    fn low_b() -> Pigments {
        Pigments {
            chlorophyll: Some(ChlorophyllMix::bands(8.0)),
            ..Pigments::default()
        }
    }

    #[test]
    fn equal_pigments_share_a_table_and_prospects_own_are_number_0() {
        let mut palettes = Palettes::default();
        let first = palettes.of(&low_b());
        let own = palettes.of(&Pigments::default());
        let again = palettes.of(&low_b());
        assert_eq!([first.number(), own.number(), again.number()], [1, 0, 1]);
        assert!(Arc::ptr_eq(&first.table, &again.table));
        assert!(Arc::ptr_eq(&own.table, &Palette::default().table));
        assert_eq!(palettes.iter().count(), 2);
    }

    #[test]
    fn optics_have_the_same_bits_at_every_level() {
        let grid = WavelengthSampler::new(&FilmKind::Rgb {
            range_nm: [400.0, 2500.0],
            observer: Observer::Cie1931,
        });
        let wavelengths = grid.draw::<8>(0.3, 0);
        let mut palettes = Palettes::on(grid.grid());
        let palette = palettes.of(&Pigments::default());
        let leaves: [Texel; 8] = std::array::from_fn(|number| {
            let share = number as f32 / 7.0;
            Texel::splat(0.0).with(&[
                (Constituent::Structure, 1.0 + 2.0 * share),
                (Constituent::Chlorophyll, 80.0 * share),
                (Constituent::Water, 0.04 * (1.0 - share)),
                (Constituent::DryMatter, 0.01 * share),
            ])
        });
        let of = |level| {
            let palette = palette.clone().at_level(level);
            leaves.each_ref().map(|leaf| {
                let (r, t) = palette.reflectance_transmittance(&wavelengths, leaf);
                [r.0.map(f32::to_bits), t.0.map(f32::to_bits)]
            })
        };
        let [first, others @ ..] = &Level::all()[..] else {
            panic!("one level runs everywhere");
        };
        for level in others {
            assert_eq!(of(*level), of(*first), "{}", level.name());
        }
    }

    #[test]
    fn whole_nanometres_are_the_models_own_constants() {
        let pigments = Pigments {
            carotenoids: Some(CarotenoidMix::bands([0.5, 0.5, 0.0, 0.0, 0.0])),
            ..low_b()
        };
        let mut palettes = Palettes::default();
        for pigments in [Pigments::default(), pigments] {
            let palette = palettes.of(&pigments);
            for nm in [400.0, 433.0, 679.0, 2500.0] {
                let own = ProspectD::coefficients_of(&pigments, nm);
                assert_eq!(palette.coefficients(nm), own);
            }
        }
    }
}
