//! A leaf's material: its tissue, which determines R and T, and its coats.

pub mod fluorescence;

use glam::Vec2;
use optics::ProspectD;
use optics::fluorescence::EmissionSpectrum;

use crate::bsdf::leaf::{Coat, LeafBsdf, LeafShape, Tissue, usual_abaxial_ratio};
use crate::material::contents_texture::{Around, ContentsTexture};
use crate::material::held::Held;
use crate::material::leaf_layers::LeafLayers;
use crate::material::light_spread::{Entry, LightSpread};
use crate::material::palette::{Palette, coarse};
use crate::material::relief::{Relief, ReliefMap};
use crate::simd::{Sixteen, Task};
use crate::spectrum::{Curve, Lanes, Spectrum, Table, WavelengthGrid, Wavelengths};

/// A leaf's material.
#[derive(Clone, Debug)]
pub struct LeafMaterial {
    /// The tissue, which determines R and T.
    pub tissue: LeafTissue,
    /// The palette of its pigments; not used for measured spectra.
    pub palette: Palette,
    /// The reflectance of the abaxial face; none if it follows what the leaf absorbs.
    abaxial: Option<Abaxial>,
    /// Adaxial and abaxial coat.
    coats: [Coat; 2],
    /// How what it scatters depends on angle.
    shape: LeafShape,
    /// The tissue's optics, tabulated, if the leaf is uniform.
    uniform: Option<Table>,
    /// How far light that it lets through spreads sideways; not used without a map of contents.
    spread: Option<LightSpread>,
    /// The face with half of the tissue that this is, if it is not the whole leaf.
    half: Option<Half>,
    /// Photons that its chlorophyll emits for each that it absorbs.
    quantum_efficiency: f64,
    /// The spectrum of these photons.
    emission: EmissionSpectrum,
    /// The relief of its faces, if they are not smooth.
    pub relief: Option<Relief>,
    /// Its layers, if light is followed through them.
    layers: Option<Box<LeafLayers>>,
}

/// The inside of a leaf through which light is followed.
#[derive(Clone, Copy, Debug)]
pub struct Inside<'m> {
    /// Its layers.
    pub layers: &'m LeafLayers,
    /// What it holds.
    pub held: &'m Held,
    /// The palette of its pigments.
    pub palette: &'m Palette,
}

/// A face with half of the tissue.
#[derive(Clone, Debug)]
struct Half {
    face: usize,
    /// Its own and none.
    coats: [Coat; 2],
    shape: LeafShape,
}

/// The tissue of a leaf, which determines its reflectance and transmittance.
#[derive(Clone, Debug)]
pub enum LeafTissue {
    /// PROSPECT-D of contents.
    Held(Held),
    /// Measured spectra.
    Measured {
        /// Reflectance of the adaxial face.
        reflectance: Curve,
        /// Transmittance.
        transmittance: Curve,
    },
}

impl LeafTissue {
    /// The map of its contents, if it has one.
    pub fn map(&self) -> Option<&ContentsTexture> {
        match self {
            Self::Held(Held::Map(map)) => Some(map),
            Self::Held(Held::Uniform(_)) | Self::Measured { .. } => None,
        }
    }
}

/// What is known of the abaxial face.
#[derive(Clone, Debug)]
pub enum Abaxial {
    /// Its reflectance over that of the adaxial one.
    Ratio(Spectrum),
    /// Its reflectance.
    Reflectance(Spectrum),
}

/// Reflectance of the abaxial face of a leaf of reflectance and transmittance `[r, t]`; `at` evaluates
/// a spectrum.
#[inline(always)]
fn abaxial<const N: usize>(
    known: Option<&Abaxial>,
    [r, t]: [Lanes<N>; 2],
    at: impl Fn(&Spectrum) -> Lanes<N>,
) -> Lanes<N> {
    match known {
        Some(Abaxial::Reflectance(reflectance)) => at(reflectance),
        Some(Abaxial::Ratio(ratio)) => at(ratio) * r,
        None => usual_abaxial_ratio(r, t) * r,
    }
}

impl LeafMaterial {
    /// A leaf of this tissue, whose pigments are those of `palette`, under an adaxial and an
    /// abaxial coat. If nothing is known of the abaxial face it has [`usual_abaxial_ratio`].
    pub fn new(
        tissue: LeafTissue,
        palette: Palette,
        abaxial: Option<Abaxial>,
        coats: [Coat; 2],
    ) -> Self {
        Self {
            palette,
            abaxial,
            shape: match &tissue {
                // Leaves of canopy models have no coats, and scatter as Lambert's law says.
                _ if !coats.iter().any(Coat::shines) => LeafShape::EVEN,
                LeafTissue::Held(held) => LeafShape::of(&held.mean()),
                LeafTissue::Measured { .. } => LeafShape::measured(),
            },
            coats,
            tissue,
            uniform: None,
            spread: None,
            half: None,
            quantum_efficiency: 0.0,
            emission: EmissionSpectrum::default(),
            relief: None,
            layers: None,
        }
    }

    /// The same leaf, in which light that it lets through spreads sideways; `thickness_uv` is one
    /// thickness of the blade in texture coordinates. Uniform leaves stay as they are.
    #[must_use]
    pub fn spreading(mut self, thickness_uv: Vec2) -> Self {
        if let LeafTissue::Held(Held::Map(map)) = &self.tissue {
            self.spread = Some(LightSpread::new(thickness_uv, &map.mean(), &self.palette));
        }
        self
    }

    /// The same leaf, through whose layers light is followed; what is asked of it otherwise, such as
    /// its albedo, is that of the leaf BSDF. Measured spectra have no inside and stay as they are.
    #[must_use]
    pub fn layered(mut self) -> Self {
        if let LeafTissue::Held(held) = &self.tissue {
            let alpha = self.coats.each_ref().map(|coat| {
                let (_, [across, along]) = coat.numbers();
                (across * along).sqrt()
            });
            self.layers = Some(Box::new(LeafLayers::new(held, alpha)));
        }
        self
    }

    /// Its inside, if light is to be followed through it.
    #[inline]
    pub fn inside(&self) -> Option<Inside<'_>> {
        let layers = self.layers.as_deref()?;
        match &self.tissue {
            LeafTissue::Held(held) => Some(Inside {
                layers,
                held,
                palette: &self.palette,
            }),
            LeafTissue::Measured { .. } => None,
        }
    }

    /// How far light that it lets through spreads sideways.
    pub fn spread(&self) -> Option<&LightSpread> {
        self.spread.as_ref()
    }

    /// One face (0 adaxial, 1 abaxial) of the same leaf cut along its middle.
    #[must_use]
    pub fn half(mut self, face: usize) -> Self {
        debug_assert!(self.relief.is_none(), "a relief is added to the half");
        let mut coats = self.coats.clone();
        coats[1 - face] = Coat::none();
        let shape = self.shape.cut(1 - face);
        self.half = Some(Half { face, coats, shape });
        self
    }

    /// The face that this is with half of the tissue, if it is not the whole leaf.
    pub fn half_face(&self) -> Option<usize> {
        self.half.as_ref().map(|half| half.face)
    }

    /// The same leaf with a relief.
    pub fn with_relief(mut self, map: ReliefMap) -> Self {
        let relief = Relief::new(map, self.outer_coats());
        self.relief = Some(match &self.half {
            Some(half) => relief.without(1 - half.face),
            None => relief,
        });
        self
    }

    /// The coats of both sides: that of a cut is none.
    fn outer_coats(&self) -> &[Coat; 2] {
        self.half.as_ref().map_or(&self.coats, |half| &half.coats)
    }

    /// Evaluates everything that depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        if let Some(Abaxial::Ratio(known) | Abaxial::Reflectance(known)) = &mut self.abaxial {
            known.tabulate(grid);
        }
        if let Some(spread) = &mut self.spread {
            spread.tabulate(grid);
        }
        let is_uniform = match &self.tissue {
            LeafTissue::Held(held) => held.is_uniform(),
            LeafTissue::Measured { .. } => true,
        };
        let table = || Tissue::table(grid, |wavelengths| self.tissue_at(Vec2::ZERO, wavelengths));
        self.uniform = is_uniform.then(table);
    }

    /// A wavelength of the range, on a coarse grid, at which the coat of a face (0 adaxial, 1 abaxial)
    /// at normal incidence reflects more than that face should, so that the leaf cannot reproduce
    /// its reflectance. With a map its mean contents are used.
    pub(crate) fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<(f64, usize)> {
        let mean = match &self.tissue {
            LeafTissue::Held(held) => Some(held.mean()),
            LeafTissue::Measured { .. } => None,
        };
        let coats = self.coats.each_ref().map(|coat| coat.albedo().normal());
        coarse(range_nm).find_map(|nm| {
            let at = nm as f32;
            let [r, t] = match &self.tissue {
                LeafTissue::Held(_) => {
                    let at = ProspectD::coefficients_of(self.palette.pigments(), nm);
                    let found = at.reflectance_transmittance(mean.as_ref()?);
                    [found.reflectance as f32, found.transmittance as f32]
                }
                LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => [reflectance.at(at), transmittance.at(at)],
            };
            let below = abaxial(
                self.abaxial.as_ref(),
                [r, t].map(|value| Lanes([value])),
                |known| Lanes([known.curve().at(at)]),
            );
            let of_faces = [r, below.0[0]];
            let exceeds = |face: &usize| of_faces[*face] < coats[*face] - 1e-4;
            [0, 1].into_iter().find(exceeds).map(|face| (nm, face))
        })
    }

    /// Where the leaf is looked up at texture coordinates `uv`; what it holds there is on its way
    /// from memory, since a map is larger than the caches.
    #[inline]
    pub fn site<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Site<N> {
        let spreading = match (&self.spread, &self.tissue) {
            (Some(spread), LeafTissue::Held(Held::Map(map))) => {
                let approach = Approach {
                    spread,
                    map,
                    uv,
                    wavelengths,
                };
                Some(self.palette.level().run(approach))
            }
            (None, _) | (Some(_), LeafTissue::Held(_) | LeafTissue::Measured { .. }) => None,
        };
        Site {
            spreading,
            ..Site::of(uv)
        }
    }

    /// The BSDF at a site.
    #[inline]
    pub(crate) fn bsdf_at<const N: usize>(
        &self,
        site: &Site<N>,
        wavelengths: &Wavelengths<N>,
    ) -> LeafBsdf<'_, N> {
        let row = self
            .uniform
            .as_ref()
            .and_then(|table| table.row(wavelengths));
        let tissue = row.map_or_else(|| self.tissue_of(site, wavelengths), Tissue::from_lanes);
        let shape = self.half.as_ref().map_or(&self.shape, |half| &half.shape);
        LeafBsdf::new(self.outer_coats(), shape, tissue)
    }

    /// The BSDF of the whole leaf at texture coordinates `uv`, of which this may be one face with half
    /// of the tissue.
    pub fn whole_bsdf<const N: usize>(
        &self,
        uv: Vec2,
        wavelengths: &Wavelengths<N>,
    ) -> LeafBsdf<'_, N> {
        let tissue = self.palette.level().run(TissueAt {
            leaf: self,
            half: None,
            site: &self.site(uv, wavelengths),
            wavelengths,
        });
        LeafBsdf::new(&self.coats, &self.shape, tissue)
    }

    pub(super) fn tissue_at<const N: usize>(
        &self,
        uv: Vec2,
        wavelengths: &Wavelengths<N>,
    ) -> Tissue<N> {
        self.tissue_of(&self.site(uv, wavelengths), wavelengths)
    }

    #[inline]
    fn tissue_of<const N: usize>(&self, site: &Site<N>, wavelengths: &Wavelengths<N>) -> Tissue<N> {
        self.palette.level().run(TissueAt {
            leaf: self,
            half: self.half.as_ref(),
            site,
            wavelengths,
        })
    }
}

/// Where a leaf is looked up.
#[derive(Clone, Copy, Debug)]
pub struct Site<const N: usize> {
    /// Texture coordinates.
    pub uv: Vec2,
    /// Factor on the colours of a map, linear sRGB.
    pub tint: [f32; 3],
    /// The x and the y axis of a map of normals in the frame of the BSDF, whose z axis is the shading
    /// normal.
    pub map_axes: [Vec2; 2],
    /// Of a leaf with a map in which light spreads, where that entered which leaves there, and the
    /// texels around.
    spreading: Option<(Entry<N>, Around)>,
}

impl<const N: usize> Site<N> {
    /// A place without light that entered elsewhere.
    pub fn of(uv: Vec2) -> Self {
        Self {
            uv,
            tint: [1.0; 3],
            map_axes: [Vec2::X, Vec2::Y],
            spreading: None,
        }
    }
}

/// The way to what a leaf holds at texture coordinates.
struct Approach<'a, const N: usize> {
    spread: &'a LightSpread,
    map: &'a ContentsTexture,
    uv: Vec2,
    wavelengths: &'a Wavelengths<N>,
}

impl<const N: usize> Task for Approach<'_, N> {
    type Output = (Entry<N>, Around);

    #[inline(always)]
    fn run<E: Sixteen>(self, _: E) -> Self::Output {
        let around = self.map.around(self.uv);
        for texel in around.texels {
            self.map.prefetch(texel);
        }
        let entry = self.spread.entry(self.map, self.uv, self.wavelengths);
        for texel in entry.texels {
            self.map.prefetch(texel);
        }
        (entry, around)
    }
}

/// The tissue of a leaf at a site.
struct TissueAt<'a, const N: usize> {
    leaf: &'a LeafMaterial,
    /// The face with half of the tissue that is meant, if it is not the whole leaf.
    half: Option<&'a Half>,
    site: &'a Site<N>,
    wavelengths: &'a Wavelengths<N>,
}

impl<const N: usize> Task for TissueAt<'_, N> {
    type Output = Tissue<N>;

    #[inline(always)]
    fn run<E: Sixteen>(self, _: E) -> Tissue<N> {
        let Self {
            leaf,
            half,
            site: Site { uv, spreading, .. },
            wavelengths,
        } = self;
        let ([reflectance, transmittance], through) = match &leaf.tissue {
            LeafTissue::Held(held) => {
                let pile = leaf.palette.lanes(wavelengths);
                if let (Some(spread), Some(spreading), Held::Map(map)) =
                    (&leaf.spread, spreading, held)
                {
                    let (entry, around) = spreading;
                    let entered = spread.entered(map, entry, wavelengths);
                    let ((r, t), through) = pile.with_each(&map.between(around), &entered);
                    ([Lanes(r), Lanes(t)], Some(Lanes(through)))
                } else {
                    let (r, t) = pile.reflectance_transmittance(&held.at(*uv));
                    ([Lanes(r), Lanes(t)], None)
                }
            }
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => {
                let measured = [reflectance, transmittance].map(|curve| curve.lanes(wavelengths));
                (measured, None)
            }
        };
        let known = leaf.abaxial.as_ref();
        let below = abaxial(known, [reflectance, transmittance], |known| {
            known.lanes(wavelengths)
        });
        let mut tissue = Tissue::of_faces(
            &leaf.coats,
            &leaf.shape,
            [reflectance, below],
            transmittance,
        );
        if let Some(through) = through {
            tissue = tissue.passing(&leaf.coats, through);
        }
        match half {
            Some(half) => tissue.half(&leaf.coats, half.face),
            None => tissue,
        }
    }
}

#[cfg(test)]
mod tests;
