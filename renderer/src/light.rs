//! Where light comes from.
//!
//! - **In**: a point that is lit, random numbers.
//! - **Out**: a direction or point on the light, its radiance at the path's wavelengths, its
//!   density over solid angle.
//! - **Always true**: [`Light::at_infinity`] and [`AreaLight::pdf`] give the density of what
//!   [`Light::sample`] draws. A light whose density is 0 is found by bounces only and never
//!   sampled.
//!
//! ```
//! use glam::{Vec2, Vec3};
//! use renderer::light::distant::DistantLight;
//! use renderer::light::{Light, Receiver};
//! use renderer::spectrum::{Curve, Wavelengths};
//!
//! // A sun in the zenith with an irradiance of 1 W m⁻² nm⁻¹.
//! let sun = DistantLight::new(Vec3::Z, 0.00925, Curve::from_points(&[(550.0, 1.0)]));
//! let floor = Receiver { position: Vec3::ZERO, normal: Vec3::Z };
//! let wavelengths = Wavelengths::new([450.0, 550.0, 650.0, 750.0]);
//! let sample = Light::Distant(sun).sample(0, &floor, &wavelengths, Vec2::splat(0.5)).expect("it shines");
//! // Radiance over density is the irradiance.
//! let irradiance = sample.radiance.mean() * sample.wi.z / sample.pdf;
//! assert!((irradiance - 1.0).abs() < 1e-3, "{irradiance}");
//! ```

use glam::{Vec2, Vec3};

pub mod area;
pub mod distant;
pub mod environment;
pub mod patch;
pub mod selection;
pub mod spot;
pub mod tree;

use std::f32::consts::PI;

use crate::spectrum::{Lanes, Spectrum, WavelengthGrid, Wavelengths};
use area::AreaLight;
use distant::DistantLight;
use environment::EnvironmentLight;
use spot::SpotLight;
use tree::Emitter;

/// The lights, a closed set.
#[derive(Clone, Debug)]
pub enum Light {
    /// A disc at infinity.
    Distant(DistantLight),
    /// The same radiance from every direction, W m⁻² sr⁻¹ nm⁻¹.
    Constant(Spectrum),
    /// A picture at infinity.
    Environment(EnvironmentLight),
    /// A surface that shines.
    Area(AreaLight),
    /// A point that shines into a cone.
    Spot(SpotLight),
}

/// A point that is lit.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Where it is, world, m.
    pub position: Vec3,
    /// Unit normal, world. Light counts by the size of its cosine with it, from either side: a leaf
    /// transmits.
    pub normal: Vec3,
}

/// Light that may arrive at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<const N: usize> {
    /// Unit direction from the point to the light, world.
    pub wi: Vec3,
    /// Point on the light, or `None` at infinity.
    pub point: Option<Vec3>,
    /// Radiance if nothing is in between; of a light without extent the irradiance on a surface
    /// that faces it, W m⁻² nm⁻¹.
    pub radiance: Lanes<N>,
    /// Density over solid angle, sr⁻¹; 1 of a light without extent.
    pub pdf: f32,
    /// Whether the light has no extent, so that no bounce ever finds it.
    pub is_point: bool,
}

/// How it is decided whether a light is sampled at a point.
#[derive(Clone, Debug)]
pub enum Sampled {
    /// Never: bounces find it best.
    Never,
    /// Always, for it is small and strong.
    Always,
    /// As one of those that surround the scene.
    Around {
        /// On a surface that faces half of the surroundings: rough, W m⁻² nm⁻¹.
        irradiance: f32,
    },
    /// Part by part, each by what it may send to the point.
    ByParts(Vec<Emitter>),
}

impl Light {
    /// How it is decided whether this light is sampled, on a film of the given range of
    /// wavelengths.
    pub fn sampled(&self, range_nm: [f64; 2]) -> Sampled {
        match self {
            Self::Distant(_) => Sampled::Always,
            Self::Constant(_) => Sampled::Never,
            Self::Environment(light) => {
                let radiance = light.mean_brightness() * light.white().mean_over(range_nm);
                Sampled::Around {
                    irradiance: PI * radiance,
                }
            }
            Self::Area(light) => {
                let radiance = light.radiance().mean_over(range_nm);
                Sampled::ByParts(light.emitters(radiance).collect())
            }
            Self::Spot(light) => {
                let intensity = light.intensity().mean_over(range_nm);
                Sampled::ByParts(vec![light.emitter(intensity)])
            }
        }
    }

    /// Whether a ray that meets nothing may find it.
    pub fn is_at_infinity(&self) -> bool {
        match self {
            Self::Distant(_) | Self::Constant(_) | Self::Environment(_) => true,
            Self::Area(_) | Self::Spot(_) => false,
        }
    }

    /// Draws light arriving at `receiver` from the light's part number `part`: a patch of an area
    /// light, 0 for the other lights. `u` picks a place on it.
    pub fn sample<const N: usize>(
        &self,
        part: usize,
        receiver: &Receiver,
        wavelengths: &Wavelengths<N>,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        match self {
            Self::Distant(light) => Some(light.sample(wavelengths, u)),
            Self::Constant(_) => None,
            Self::Environment(light) => light.sample(wavelengths, u),
            Self::Area(light) => light.sample(part, receiver, wavelengths, u),
            Self::Spot(light) => light.sample(receiver, wavelengths),
        }
    }

    /// Works its spectra out at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        match self {
            Self::Distant(light) => light.tabulate(grid),
            Self::Constant(radiance) => radiance.tabulate(grid),
            Self::Environment(light) => light.tabulate(grid),
            Self::Area(light) => light.tabulate(grid),
            Self::Spot(light) => light.tabulate(grid),
        }
    }

    /// Radiance from infinity along the unit direction `wi` (towards the light), and the density
    /// with which [`Light::sample`] draws that direction; `None` if the light is not there.
    pub fn at_infinity<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Lanes<N>, f32)> {
        match self {
            Self::Distant(light) => light.towards(wi, wavelengths),
            Self::Constant(radiance) => Some((radiance.lanes(wavelengths), 0.0)),
            Self::Environment(light) => Some(light.towards(wi, wavelengths)),
            Self::Area(_) | Self::Spot(_) => None,
        }
    }
}

/// Angle between unit vectors, also where it is small, rad.
fn angle(a: Vec3, b: Vec3) -> f32 {
    2.0 * libm::atan2f((a - b).length(), (a + b).length())
}
