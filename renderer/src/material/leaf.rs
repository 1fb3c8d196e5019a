//! A leaf's material: its tissue, which determines R and T, and its coats.

use glam::Vec2;
use leafmodel::optics::{ProspectD, Texel};

use crate::bsdf::leaf::{Coat, LeafBsdf, Tissue};
use crate::material::coarse;
use crate::material::held::Held;
use crate::material::palette::Palette;
use crate::spectrum::{Curve, Lanes, Spectrum, Table, WavelengthGrid, Wavelengths};

/// A leaf's material.
#[derive(Clone, Debug)]
pub struct LeafMaterial {
    /// The tissue, which determines R and T.
    pub tissue: LeafTissue,
    /// The palette of its pigments; not used for measured spectra.
    pub palette: Palette,
    /// Abaxial over adaxial reflectance.
    abaxial_ratio: Spectrum,
    /// Adaxial and abaxial coat.
    coats: [Coat; 2],
    /// The tissue's optics, tabulated, if the leaf is uniform.
    uniform: Option<Table>,
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

impl LeafMaterial {
    /// A leaf of this tissue with the pigments of `palette`, under an adaxial and an abaxial coat.
    pub fn new(
        tissue: LeafTissue,
        palette: Palette,
        abaxial_ratio: Curve,
        coats: [Coat; 2],
    ) -> Self {
        Self {
            tissue,
            palette,
            abaxial_ratio: abaxial_ratio.into(),
            coats,
            uniform: None,
        }
    }

    /// Evaluates everything that depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.abaxial_ratio.tabulate(grid);
        let is_uniform = match &self.tissue {
            LeafTissue::Held(held) => held.is_uniform(),
            LeafTissue::Measured { .. } => true,
        };
        let table = || Tissue::table(grid, |wavelengths| self.tissue_at(Vec2::ZERO, wavelengths));
        self.uniform = is_uniform.then(table);
    }

    /// A wavelength of the range, on a coarse grid, at which the adaxial coat at normal incidence
    /// reflects more than R, so that the leaf cannot reproduce R. With a map its mean contents are
    /// used.
    pub fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<f64> {
        let coat = f64::from(self.coats[0].albedo().normal());
        let exceeds = |reflectance: f64| reflectance < coat - 1e-4;
        match &self.tissue {
            LeafTissue::Held(held) => {
                let mean = held.mean();
                coarse(range_nm).find(|&nm| {
                    let at = ProspectD::coefficients_of(self.palette.pigments(), nm);
                    exceeds(at.reflectance_transmittance(&mean).reflectance)
                })
            }
            LeafTissue::Measured { reflectance, .. } => {
                coarse(range_nm).find(|&nm| exceeds(f64::from(reflectance.at(nm as f32))))
            }
        }
    }

    /// The BSDF at texture coordinates `uv`.
    #[inline]
    pub fn bsdf<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> LeafBsdf<'_, N> {
        let row = self
            .uniform
            .as_ref()
            .and_then(|table| table.row(wavelengths));
        let tissue = row.map_or_else(|| self.tissue_at(uv, wavelengths), Tissue::from_lanes);
        LeafBsdf::new(&self.coats, tissue)
    }

    fn tissue_at<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Tissue<N> {
        let optics = |contents: &Texel| {
            let pile = self.palette.lanes(wavelengths);
            let (reflectance, transmittance) = pile.reflectance_transmittance(contents);
            (Lanes(reflectance), Lanes(transmittance))
        };
        let (reflectance, transmittance) = match &self.tissue {
            LeafTissue::Held(held) => optics(&held.at(uv)),
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => (
                reflectance.lanes(wavelengths),
                transmittance.lanes(wavelengths),
            ),
        };
        let ratio = self.abaxial_ratio.lanes(wavelengths);
        Tissue::new(&self.coats, reflectance, transmittance, ratio)
    }
}

#[cfg(test)]
mod tests {
    use leafmodel::optics::pigments::{AnthocyaninMix, ChlorophyllMix};
    use leafmodel::optics::{Contents, Pigments};

    use super::*;
    use crate::material::contents_texture::ContentsTexture;
    use crate::material::palette::Palettes;
    use crate::scene::description::FilmKind;
    use crate::spectrum::WavelengthSampler;
    use glam::Vec3;

    fn at(nm: f32) -> Wavelengths<4> {
        Wavelengths::new([nm; 4])
    }

    fn palettes() -> [Pigments; 6] {
        std::array::from_fn(|i| match i {
            0 => Pigments::default(),
            1 => Pigments {
                chlorophyll: ChlorophyllMix::bands(3.1),
                ..Pigments::default()
            },
            _ => Pigments {
                anthocyanins: AnthocyaninMix::Aglycones {
                    shares: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                    shift_nm: 5.0 * i as f64,
                    blue_fraction: 0.0,
                },
                ..Pigments::default()
            },
        })
    }

    #[test]
    fn along_a_path_prospect_gives_what_the_exact_model_gives() {
        let green = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("a leaf");
        let mut known = Palettes::default();
        for pigments in &palettes()[..3] {
            let palette = known.of(pigments);
            for step in 0..1000 {
                let nm = 395.0 + 2.13 * step as f32;
                let held = green.to_texel();
                let (r, t) = palette.lanes(&at(nm)).reflectance_transmittance(&held);
                let exact = ProspectD::coefficients_of(pigments, f64::from(nm))
                    .reflectance_transmittance(&green);
                assert!(
                    (f64::from(r[0]) - exact.reflectance).abs() < 1e-6,
                    "R at {nm} nm"
                );
                assert!(
                    (f64::from(t[3]) - exact.transmittance).abs() < 1e-6,
                    "T at {nm} nm"
                );
            }
        }
    }

    #[test]
    fn tabulated_leaves_are_what_they_are_at_any_wavelength() {
        let red = Contents::new(1.6, 5.0, 5.0, 20.0, 0.1, 0.011, 0.006).expect("a leaf");
        let sampler = WavelengthSampler::new(&FilmKind::Rgb {
            range_nm: [400.0, 780.0],
        });
        let mut known = Palettes::on(sampler.grid());
        let texel = red.to_texel();
        for pigments in &palettes() {
            for tissue in [
                LeafTissue::Held(Held::Uniform(red)),
                LeafTissue::Held(Held::Map(ContentsTexture::new(1, 1, vec![texel]))),
            ] {
                let mut leaf = LeafMaterial::new(
                    tissue,
                    known.of(pigments),
                    Curve::from_points(&[(400.0, 1.7), (700.0, 1.0)]),
                    [Coat::new(1.45, 0.3, 0.3), Coat::new(1.4, 0.4, 0.4)],
                );
                leaf.tabulate(sampler.grid());
                for u in [0.0, 0.3, 0.999] {
                    let drawn = sampler.draw::<8>(u);
                    let free = Wavelengths::new(drawn.nm);
                    let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, -0.8));
                    for wi in [wi, -wi] {
                        let got = leaf.bsdf(Vec2::ZERO, &drawn).eval(wo, wi);
                        let expected = leaf.bsdf(Vec2::ZERO, &free).eval(wo, wi);
                        for lane in 0..8 {
                            let error = (got.0[lane] - expected.0[lane]).abs();
                            assert!(error <= 1e-7, "{} nm: {error}", drawn.nm[lane]);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn whether_a_coat_reflects_too_much_is_a_matter_of_the_palette() {
        // In the blue form anthocyanins absorb at 655 nm, where PROSPECT-D's hardly do.
        let red = Contents::new(2.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0).expect("a leaf");
        let mut known = Palettes::default();
        let mut exceeds = |pigments: &Pigments| {
            let leaf = LeafMaterial::new(
                LeafTissue::Held(Held::Uniform(red)),
                known.of(pigments),
                Curve::from_points(&[(400.0, 1.0), (700.0, 1.0)]),
                [Coat::new(1.6, 0.3, 0.3), Coat::new(1.6, 0.3, 0.3)],
            );
            leaf.coat_exceeds_reflectance([655.0, 660.0]).is_some()
        };
        let blue = Pigments {
            anthocyanins: AnthocyaninMix::Aglycones {
                shares: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                shift_nm: 0.0,
                blue_fraction: 1.0,
            },
            ..Pigments::default()
        };
        assert!(!exceeds(&Pigments::default()));
        assert!(exceeds(&blue));
    }
}
