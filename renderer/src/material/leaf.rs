//! A leaf's material: what decides its R and T, and its coats.

use glam::Vec2;
use leafmodel::optics::fast::PileLane;
use leafmodel::optics::{Contents, ProspectD};

use crate::bsdf::leaf::{Coat, LeafBsdf};
use crate::material::PathSpectra;
use crate::material::contents_texture::ContentsTexture;
use crate::material::palette::Palette;
use crate::spectrum::{Curve, Lanes, Wavelengths};

/// A leaf's material.
#[derive(Clone, Debug)]
pub struct LeafMaterial {
    /// What decides R and T.
    pub tissue: LeafTissue,
    /// What its pigments are; measured spectra have no use for it.
    pub palette: Palette,
    /// Abaxial over adaxial reflectance.
    pub abaxial_ratio: Curve,
    /// Adaxial and abaxial coat.
    pub coats: [Coat; 2],
}

/// What decides a leaf's reflectance and transmittance.
#[derive(Clone, Debug)]
pub enum LeafTissue {
    /// PROSPECT-D of contents that are the same everywhere.
    Uniform(Contents),
    /// PROSPECT-D of contents that a map gives.
    Map(ContentsTexture),
    /// Measured spectra.
    Measured {
        /// Reflectance of the adaxial face.
        reflectance: Curve,
        /// Transmittance.
        transmittance: Curve,
    },
}

/// PROSPECT-D's constants at a path's wavelengths, for one palette.
#[derive(Clone, Debug)]
pub struct LeafOptics<const N: usize> {
    palette: usize,
    lanes: [PileLane; N],
}

impl<const N: usize> LeafOptics<N> {
    /// At these wavelengths; outside 400–2500 nm the tables' end values hold (a scene that comes there has said so).
    pub fn new(palette: &Palette, wavelengths: &Wavelengths<N>) -> Self {
        Self {
            palette: palette.number(),
            lanes: wavelengths
                .nm
                .map(|nm| PileLane::new(&palette.coefficients(f64::from(nm)))),
        }
    }

    /// Number of the palette.
    pub fn palette(&self) -> usize {
        self.palette
    }

    /// R and T of a leaf with these contents.
    pub fn reflectance_transmittance(&self, contents: &Contents) -> (Lanes<N>, Lanes<N>) {
        let (reflectance, transmittance) = PileLane::evaluate_lanes(&self.lanes, contents);
        (Lanes(reflectance), Lanes(transmittance))
    }

    /// What contents absorb in all, `Σ C K`.
    pub fn absorption(&self, contents: &Contents) -> [f64; N] {
        let whole = Contents {
            structure: 1.0,
            ..*contents
        };
        self.lanes
            .each_ref()
            .map(|lane| lane.absorption_per_plate(&whole))
    }
}

impl LeafMaterial {
    /// A wavelength of the range, on a coarse grid, at which the adaxial coat at normal incidence reflects more than
    /// R, so that the leaf cannot give R back; with a map its mean contents stand for all.
    pub fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<f64> {
        let coat = f64::from(self.coats[0].albedo().normal());
        let steps = 200;
        let contents = match &self.tissue {
            LeafTissue::Uniform(contents) => Some(*contents),
            LeafTissue::Map(map) => Some(map.mean()),
            LeafTissue::Measured { .. } => None,
        };
        (0..=steps)
            .map(|i| range_nm[0] + (range_nm[1] - range_nm[0]) * f64::from(i) / f64::from(steps))
            .find(|&nm| {
                let reflectance = match (&self.tissue, &contents) {
                    (LeafTissue::Measured { reflectance, .. }, _) => {
                        f64::from(reflectance.at(nm as f32))
                    }
                    (_, Some(contents)) => {
                        ProspectD::coefficients_of(self.palette.pigments(), nm)
                            .reflectance_transmittance(contents)
                            .reflectance
                    }
                    (_, None) => return false,
                };
                reflectance < coat - 1e-4
            })
    }

    /// The BSDF at texture coordinates `uv`.
    pub fn bsdf<const N: usize>(&self, uv: Vec2, spectra: &mut PathSpectra<N>) -> LeafBsdf<'_, N> {
        let (reflectance, transmittance) = match &self.tissue {
            LeafTissue::Uniform(contents) => spectra
                .optics(&self.palette)
                .reflectance_transmittance(contents),
            LeafTissue::Map(map) => spectra
                .optics(&self.palette)
                .reflectance_transmittance(&map.at(uv)),
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => (
                reflectance.lanes(&spectra.wavelengths),
                transmittance.lanes(&spectra.wavelengths),
            ),
        };
        let ratio = self.abaxial_ratio.lanes(&spectra.wavelengths);
        LeafBsdf::new(&self.coats, reflectance, transmittance, ratio)
    }
}

#[cfg(test)]
mod tests {
    use leafmodel::optics::Pigments;
    use leafmodel::optics::pigments::{AnthocyaninMix, ChlorophyllMix};

    use super::*;
    use crate::material::palette::Palettes;

    fn at(nm: f32) -> Wavelengths<4> {
        Wavelengths {
            nm: [nm; 4],
            pdf: [1.0; 4],
        }
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
                let optics = LeafOptics::<4>::new(&palette, &at(nm));
                let (r, t) = optics.reflectance_transmittance(&green);
                let exact = ProspectD::coefficients_of(pigments, f64::from(nm))
                    .reflectance_transmittance(&green);
                assert!(
                    (f64::from(r.0[0]) - exact.reflectance).abs() < 1e-6,
                    "R at {nm} nm"
                );
                assert!(
                    (f64::from(t.0[3]) - exact.transmittance).abs() < 1e-6,
                    "T at {nm} nm"
                );
            }
        }
    }

    #[test]
    fn a_path_among_more_palettes_than_it_keeps_sees_each_as_it_is() {
        let red = Contents::new(1.6, 5.0, 5.0, 20.0, 0.1, 0.011, 0.006).expect("a leaf");
        let mut known = Palettes::default();
        let palettes = palettes().map(|pigments| known.of(&pigments));
        let mut spectra = PathSpectra::new(at(575.0));
        for turn in 0..3 * palettes.len() {
            let palette = &palettes[turn * 5 % palettes.len()];
            let got = spectra.optics(palette).reflectance_transmittance(&red);
            let alone = LeafOptics::new(palette, &at(575.0)).reflectance_transmittance(&red);
            assert_eq!(got, alone);
        }
    }

    #[test]
    fn whether_a_coat_reflects_too_much_is_a_matter_of_the_palette() {
        // In the blue form anthocyanins absorb at 655 nm, where PROSPECT-D's hardly do.
        let red = Contents::new(2.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0).expect("a leaf");
        let mut known = Palettes::default();
        let mut exceeds = |pigments: &Pigments| {
            let leaf = LeafMaterial {
                tissue: LeafTissue::Uniform(red),
                palette: known.of(pigments),
                abaxial_ratio: Curve::from_points(&[(400.0, 1.0), (700.0, 1.0)]),
                coats: [Coat::new(1.6, 0.3, 0.3), Coat::new(1.6, 0.3, 0.3)],
            };
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
