//! Light sources.
//!
//! - **In**: an illuminated point, random numbers.
//! - **Out**: a direction or point on the light, its radiance at the path's wavelengths, its
//!   density over solid angle.
//! - **Always true**: [`Light::at_infinity`] and [`AreaLight::pdf`] give the density of what
//!   [`Light::sample`] draws. A light whose density is 0 is found by bounces only and never
//!   sampled.
//!
//! ```
//! use glam::{Vec2, Vec3};
//! use trace::light::distant::DistantLight;
//! use trace::light::{Light, Receiver};
//! use trace::spectrum::{Curve, Wavelengths};
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
pub mod daylight;
pub mod distant;
pub mod environment;
pub mod patch;
pub mod pattern;
pub mod radiance_table;
pub mod sample;
pub mod selection;
pub mod spot;
pub mod texels;
pub mod tree;

use std::f32::consts::PI;

use self::area::AreaLight;
use crate::spectrum::rgb::basis_at;
use crate::spectrum::{Curve, Lanes, Share, Spectrum, WavelengthGrid, Wavelengths};
use daylight::sky::SkyLight;
use daylight::sun::SunLight;
use distant::DistantLight;
use environment::EnvironmentLight;
use radiance_table::RadianceTable;
pub use sample::{LightSample, Receiver};
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
    /// The sun's disc, darker towards its limb.
    Sun(SunLight),
    /// A clear or an overcast sky, and the ground below its horizon.
    Sky(SkyLight),
    /// An emitting surface.
    Area(AreaLight),
    /// A point that emits into a cone (a spotlight).
    Spot(SpotLight),
}

/// The mean spectrum of a light over all directions or its surface.
#[derive(Clone, Copy, Debug)]
pub struct MeanSpectrum<'l> {
    curve: &'l Curve,
    /// Linear sRGB, where 1 1 1 is the curve.
    colour: Option<[f64; 3]>,
}

impl MeanSpectrum<'_> {
    /// What the light sends out in a share of the range, relative to others.
    pub fn over(&self, share: &Share) -> f64 {
        let Some(colour) = self.colour else {
            return self.curve.over(share).into();
        };
        let basis = colour.into_iter().zip(basis_at(share.nm));
        let part: f64 = basis.map(|(mean, basis)| mean * f64::from(basis)).sum();
        part * f64::from(self.curve.over(share))
    }
}

/// Whether and how a light is sampled at a point.
#[derive(Clone, Debug)]
pub enum Sampled {
    /// Never: bounces find it best.
    Never,
    /// Always, since it is small and strong.
    Always,
    /// As one of the lights that surround the scene.
    Around {
        /// Rough irradiance on a surface that sees half of the surroundings, W m⁻² nm⁻¹.
        irradiance: f32,
        /// Mean square of its radiance over all directions, relative to the square of the mean: 1
        /// if it is even, the inverse of its share of the sphere if all comes from one part.
        unevenness: f64,
    },
    /// By parts, each with a probability according to the light that it may send to the point.
    ByParts(Vec<Emitter>),
}

impl Light {
    /// Whether and how this light is sampled, on a film with the given range of wavelengths.
    pub fn sampled(&self, range_nm: [f64; 2]) -> Sampled {
        match self {
            Self::Distant(_) | Self::Sun(_) => Sampled::Always,
            Self::Constant(_) => Sampled::Never,
            Self::Environment(light) => {
                let radiance = light.mean_brightness() * light.white().mean_over(range_nm);
                Sampled::Around {
                    irradiance: PI * radiance,
                    unevenness: light.unevenness(),
                }
            }
            Self::Sky(light) => Sampled::Around {
                irradiance: light.diffuse().mean_over(range_nm),
                unevenness: light.unevenness(),
            },
            Self::Area(light) => Sampled::ByParts(light.emitters(range_nm).collect()),
            Self::Spot(light) => {
                let intensity = light.intensity().mean_over(range_nm);
                Sampled::ByParts(vec![light.emitter(intensity)])
            }
        }
    }

    /// A radiance that it exceeds nowhere, W m⁻² sr⁻¹ nm⁻¹; infinite for a light without extent.
    pub fn at_most(&self, share: &Share) -> f32 {
        match self {
            Self::Distant(light) => light.radiance().over(share),
            Self::Constant(radiance) => radiance.curve().over(share),
            Self::Environment(light) => light.at_most(share),
            Self::Sun(light) => light.limb_at(share)[0],
            Self::Sky(light) => light.at_most(share),
            Self::Area(light) => light.at_most(share),
            Self::Spot(_) => f32::INFINITY,
        }
    }

    /// A radiance that a picture shows if the light or white paper in it is seen: of lights that are
    /// mostly too small to be seen, that of paper. Of a spotlight it is that of paper 1 m away.
    pub fn shows(&self, share: &Share) -> f32 {
        match self {
            Self::Distant(light) => light.radiance().over(share) * light.solid_angle() / PI,
            Self::Sun(light) => light.irradiance().over(share) / PI,
            Self::Spot(light) => light.intensity().over(share) / PI,
            Self::Constant(_) | Self::Environment(_) | Self::Sky(_) | Self::Area(_) => {
                self.at_most(share)
            }
        }
    }

    /// Whether a ray that hits nothing may find it.
    pub(crate) fn is_at_infinity(&self) -> bool {
        match self {
            Self::Distant(_)
            | Self::Constant(_)
            | Self::Environment(_)
            | Self::Sun(_)
            | Self::Sky(_) => true,
            Self::Area(_) | Self::Spot(_) => false,
        }
    }

    /// Samples light that arrives at `receiver` from part `part` of the light: a patch of an area
    /// light, 0 for other lights. `u` selects a place on it.
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
            Self::Sun(light) => Some(light.sample(wavelengths, u)),
            Self::Sky(light) => light.sample(wavelengths, u),
            Self::Area(light) => light.sample(part, receiver, wavelengths, u),
            Self::Spot(light) => light.sample(receiver, wavelengths),
        }
    }

    /// Its radiance over directions as a table, if it is one.
    pub fn radiance_table(&self) -> Option<RadianceTable<'_>> {
        match self {
            Self::Environment(light) => Some(light.tabulated()),
            Self::Sky(light) => Some(light.tabulated()),
            Self::Distant(_) | Self::Constant(_) | Self::Sun(_) | Self::Area(_) | Self::Spot(_) => {
                None
            }
        }
    }

    /// Its mean spectrum.
    pub fn mean_spectrum(&self) -> MeanSpectrum<'_> {
        let (curve, colour) = match self {
            Self::Distant(light) => (light.radiance(), None),
            Self::Constant(radiance) => (radiance.curve(), None),
            Self::Environment(light) => (light.white(), Some(light.mean_colour())),
            Self::Sun(light) => (light.irradiance(), None),
            Self::Sky(light) => (light.diffuse(), None),
            Self::Area(light) => (light.radiance(), light.mean_colour()),
            Self::Spot(light) => (light.intensity(), None),
        };
        MeanSpectrum { curve, colour }
    }

    /// Evaluates its spectra at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        match self {
            Self::Distant(light) => light.tabulate(grid),
            Self::Constant(radiance) => radiance.tabulate(grid),
            Self::Environment(light) => light.tabulate(grid),
            Self::Sun(light) => light.tabulate(grid),
            Self::Sky(light) => light.tabulate(grid),
            Self::Area(light) => light.tabulate(grid),
            Self::Spot(light) => light.tabulate(grid),
        }
    }

    /// Radiance from infinity along the unit direction `wi` (towards the light), and the density
    /// with which [`Light::sample`] draws that direction; `None` if the light does not lie in that
    /// direction.
    pub fn at_infinity<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Lanes<N>, f32)> {
        match self {
            Self::Distant(light) => light.towards(wi, wavelengths),
            Self::Constant(radiance) => Some((radiance.lanes(wavelengths), 0.0)),
            Self::Environment(light) => Some(light.towards(wi, wavelengths)),
            Self::Sun(light) => light.towards(wi, wavelengths),
            Self::Sky(light) => Some(light.towards(wi, wavelengths)),
            Self::Area(_) | Self::Spot(_) => None,
        }
    }

    /// Prefetches what [`Light::radiance_at_infinity`] will look up for a ray that is to be traced.
    #[inline]
    pub fn prefetch(&self, wi: Vec3) {
        if let Self::Environment(light) = self {
            light.prefetch(wi);
        }
    }

    /// Radiance from infinity as by [`Light::at_infinity`], without the density, which takes time.
    pub fn radiance_at_infinity<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<Lanes<N>> {
        match self {
            Self::Environment(light) => Some(light.seen_towards(wi, wavelengths)),
            Self::Sky(light) => Some(light.seen_towards(wi, wavelengths)),
            Self::Distant(_) | Self::Constant(_) | Self::Sun(_) | Self::Area(_) | Self::Spot(_) => {
                let found = self.at_infinity(wi, wavelengths);
                found.map(|(radiance, _)| radiance)
            }
        }
    }
}
