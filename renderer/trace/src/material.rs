//! Materials: they turn the parameters of a hit into a [`Bsdf`].
//!
//! ```
//! use glam::{Vec2, Vec3};
//! use trace::bsdf::Bsdf;
//! use trace::material::Material;
//! use trace::spectrum::{Curve, Wavelengths};
//!
//! // Red paint: little below 600 nm, much above.
//! let reflectance = Curve::from_points(&[(590.0, 0.1), (610.0, 0.7)]);
//! let paint = Material::Diffuse(reflectance.into());
//! let wavelengths = Wavelengths::new([450.0, 550.0, 650.0, 750.0]);
//! let bsdf: Bsdf<'_, 4> = paint.bsdf(Vec2::splat(0.5), &wavelengths);
//! assert_eq!(bsdf.albedo(Vec3::Z).0, [0.1, 0.1, 0.7, 0.7]);
//! ```

pub mod colour_map;
pub mod contents_texture;
pub mod held;
pub mod leaf;
pub mod leaf_layers;
pub mod light_spread;
pub mod model;
pub mod palette;
pub mod plastic;
pub mod reflectance;
pub mod relief;
pub mod solid;

use glam::Vec2;

use crate::bsdf::Bsdf;
use crate::bsdf::dielectric::Dielectric;
use crate::bsdf::hapke::{Grains, HapkeBsdf};
use crate::spectrum::{Spectrum, WavelengthGrid, Wavelengths};
use colour_map::ColourMap;
use contents_texture::ContentsTexture;
use held::Held;
use leaf::{Inside, LeafMaterial, LeafTissue, Site};
use model::ModelMaterial;
use palette::Palette;
use plastic::PlasticMaterial;
use reflectance::Reflectance;
use relief::Relief;
use solid::SolidMaterial;

/// The materials, a closed set.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian, with a reflectance.
    Diffuse(Reflectance),
    /// The boundary of a transparent medium.
    Dielectric(Dielectric),
    /// A diffuse body below a rough coat.
    Plastic(Box<PlasticMaterial>),
    /// The surface of a glTF model.
    Model(Box<ModelMaterial>),
    /// A surface of grains, such as bare soil.
    Hapke {
        /// Single-scattering albedo of the grains, in [0, 1].
        albedo: Spectrum,
        /// How they scatter.
        grains: Grains,
    },
    /// A leaf.
    Leaf(Box<LeafMaterial>),
    /// Solid tissue: fruit rind, a mushroom's cap.
    Solid(Box<SolidMaterial>),
}

/// A material's tissue, for materials that are tissue of any kind.
#[derive(Clone, Copy, Debug)]
pub struct Tissue<'m> {
    /// The palette of its pigments.
    pub palette: &'m Palette,
    /// Its contents; `None` if its spectra were measured.
    pub held: Option<&'m Held>,
}

/// A coat that alone reflects more than the whole should.
#[derive(Clone, Copy, Debug)]
pub struct ExceedingCoat {
    /// A wavelength at which it does, nm.
    pub nm: f64,
    /// Name of the coat in messages.
    pub coat: &'static str,
    /// Name of the whole in messages.
    pub whole: &'static str,
}

impl Material {
    /// Its tissue, if it is tissue.
    pub fn tissue(&self) -> Option<Tissue<'_>> {
        match self {
            Self::Diffuse(_)
            | Self::Dielectric(_)
            | Self::Plastic(_)
            | Self::Model(_)
            | Self::Hapke { .. } => None,
            Self::Leaf(leaf) => Some(Tissue {
                palette: &leaf.palette,
                held: match &leaf.tissue {
                    LeafTissue::Held(held) => Some(held),
                    LeafTissue::Measured { .. } => None,
                },
            }),
            Self::Solid(solid) => Some(Tissue {
                palette: solid.palette(),
                held: Some(solid.held()),
            }),
        }
    }

    /// The map of its colours, if it has one.
    pub fn colour_map(&self) -> Option<&ColourMap> {
        match self {
            Self::Diffuse(reflectance) => reflectance.colour_map(),
            Self::Plastic(plastic) => plastic.reflectance().colour_map(),
            Self::Model(model) => Some(model.colours()),
            Self::Dielectric(_) | Self::Leaf(_) | Self::Solid(_) | Self::Hapke { .. } => None,
        }
    }

    /// Whether it has a map of normals.
    #[inline]
    pub fn has_normals(&self) -> bool {
        matches!(self, Self::Model(model) if model.has_normals())
    }

    /// Whether colours of a mesh's vertices are factors on its own.
    #[inline]
    pub fn is_tinted(&self) -> bool {
        self.colour_map().is_some_and(ColourMap::is_tinted)
    }

    /// The map of its contents, if it has one.
    pub fn contents_map(&self) -> Option<&ContentsTexture> {
        match self.tissue()?.held? {
            Held::Map(map) => Some(map),
            Held::Uniform(_) => None,
        }
    }

    /// Its coat, if that reflects more than the whole should at a wavelength of the range.
    pub fn exceeding_coat(&self, range_nm: [f64; 2]) -> Option<ExceedingCoat> {
        match self {
            Self::Diffuse(_)
            | Self::Dielectric(_)
            | Self::Plastic(_)
            | Self::Model(_)
            | Self::Hapke { .. } => None,
            Self::Leaf(leaf) => {
                let (nm, face) = leaf.coat_exceeds_reflectance(range_nm)?;
                let coat = ["the adaxial coat", "the abaxial coat"][face];
                let whole = "the leaf";
                Some(ExceedingCoat { nm, coat, whole })
            }
            Self::Solid(solid) => {
                let nm = solid.coat_exceeds_reflectance(range_nm)?;
                let (coat, whole) = ("the coat", "the solid tissue");
                Some(ExceedingCoat { nm, coat, whole })
            }
        }
    }

    /// Evaluates everything that depends on wavelength alone, at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        match self {
            Self::Diffuse(reflectance) => reflectance.tabulate(grid),
            Self::Dielectric(_) => {}
            Self::Plastic(plastic) => plastic.tabulate(grid),
            Self::Model(model) => model.tabulate(grid),
            Self::Hapke { albedo, .. } => albedo.tabulate(grid),
            Self::Leaf(leaf) => leaf.tabulate(grid),
            Self::Solid(solid) => solid.tabulate(grid),
        }
    }

    /// The leaf that it is.
    #[inline]
    fn leaf(&self) -> Option<&LeafMaterial> {
        if let Self::Leaf(leaf) = self {
            Some(leaf)
        } else {
            None
        }
    }

    /// The leaf that it is, if that fluoresces.
    pub fn fluorescing(&self) -> Option<&LeafMaterial> {
        self.leaf().filter(|leaf| leaf.fluoresces())
    }

    /// Its relief, if it has one.
    #[inline]
    pub fn relief(&self) -> Option<&Relief> {
        self.leaf()?.relief.as_ref()
    }

    /// Its inside, if light is to be followed through it.
    #[inline]
    pub fn inside(&self) -> Option<Inside<'_>> {
        self.leaf()?.inside()
    }

    /// Where it is looked up at texture coordinates `uv`; what a leaf holds there is on its way from
    /// memory.
    #[inline]
    pub fn site<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Site<N> {
        self.leaf()
            .map_or_else(|| Site::of(uv), |leaf| leaf.site(uv, wavelengths))
    }

    /// The BSDF at texture coordinates `uv`, at a path's wavelengths.
    #[inline]
    pub fn bsdf<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Bsdf<'_, N> {
        self.bsdf_at(&self.site(uv, wavelengths), wavelengths)
    }

    /// The BSDF at a site, at the same wavelengths.
    #[inline]
    pub(crate) fn bsdf_at<const N: usize>(
        &self,
        site: &Site<N>,
        wavelengths: &Wavelengths<N>,
    ) -> Bsdf<'_, N> {
        match self {
            Self::Diffuse(reflectance) => Bsdf::Diffuse(reflectance.at(site, wavelengths)),
            Self::Dielectric(dielectric) => Bsdf::Dielectric(*dielectric),
            Self::Plastic(plastic) => Bsdf::Leaf(plastic.bsdf(site, wavelengths)),
            Self::Model(model) => Bsdf::Metallic(model.bsdf(site, wavelengths)),
            Self::Hapke { albedo, grains } => Bsdf::Hapke(HapkeBsdf {
                albedo: albedo.lanes(wavelengths),
                grains: *grains,
            }),
            Self::Leaf(leaf) => Bsdf::Leaf(leaf.bsdf_at(site, wavelengths)),
            Self::Solid(solid) => Bsdf::Leaf(solid.bsdf(site.uv, wavelengths)),
        }
    }
}
