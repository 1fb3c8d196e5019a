//! Spotlights: points that emit into a cone.

use std::f64::consts::PI;

use glam::Vec3;

use crate::light::sample::{LightSample, Receiver, angle};
use crate::light::tree::Emitter;
use crate::spectrum::{Curve, Spectrum, WavelengthGrid, Wavelengths};

/// A point light whose radiant intensity is constant inside an inner cone and falls linearly in the
/// angle to 0 at the edge of the outer one.
#[derive(Clone, Debug)]
pub struct SpotLight {
    position: Vec3,
    axis: Vec3,
    /// Half angle of the inner cone, in which the intensity equals that on the axis, rad.
    beam: f32,
    /// Half angle of the outer cone, outside which there is no light, rad.
    cone: f32,
    intensity: Spectrum,
}

impl SpotLight {
    /// A light at a point, around the unit vector `axis`, with the half angle of the cone, the
    /// width of the edge inside it (rad, at most the half angle), and the radiant intensity on the
    /// axis, W sr⁻¹ nm⁻¹.
    pub fn new(position: Vec3, axis: Vec3, cone: f64, penumbra: f64, intensity: Curve) -> Self {
        let cone = cone.min(PI);
        Self {
            position,
            axis,
            beam: (cone - penumbra).max(0.0) as f32,
            cone: cone as f32,
            intensity: intensity.into(),
        }
    }

    /// Radiant intensity on the axis, W sr⁻¹ nm⁻¹.
    pub fn intensity(&self) -> &Curve {
        self.intensity.curve()
    }

    /// Evaluates its intensity at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.intensity.tabulate(grid);
    }

    /// The light as an emitter for the light tree; `mean_intensity` is that of the film's
    /// wavelengths, W sr⁻¹ nm⁻¹.
    pub fn emitter(&self, mean_intensity: f32) -> Emitter {
        Emitter {
            center: self.position,
            radius: 0.0,
            axis: self.axis,
            spread: self.beam,
            reach: self.cone - self.beam,
            intensity: mean_intensity,
        }
    }

    /// The light that arrives at `receiver`; `None` outside the cone.
    pub fn sample<const N: usize>(
        &self,
        receiver: &Receiver,
        wavelengths: &Wavelengths<N>,
    ) -> Option<LightSample<N>> {
        let offset = self.position - receiver.position;
        let wi = offset.try_normalize()?;
        let share = self.share(-wi);
        let irradiance = self.intensity.lanes(wavelengths) * (share / offset.length_squared());
        (share > 0.0).then_some(LightSample {
            wi,
            point: Some(self.position),
            radiance: irradiance,
            pdf: 1.0,
            is_point: true,
        })
    }

    /// Intensity in a direction (a unit vector) over that on the axis.
    fn share(&self, direction: Vec3) -> f32 {
        let angle = angle(self.axis, direction);
        if angle <= self.beam {
            1.0
        } else if angle < self.cone {
            (self.cone - angle) / (self.cone - self.beam)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::light::tree::LightTree;
    use crate::sampling::stream::Stream;
    use crate::sampling::warp;

    const AT: Vec3 = Vec3::new(0.5, -1.0, 2.0);
    const INTENSITY: f32 = 3.0;

    fn spot(axis: Vec3, cone_deg: f64, penumbra_deg: f64) -> SpotLight {
        let [cone, penumbra] = [cone_deg, penumbra_deg].map(f64::to_radians);
        SpotLight::new(AT, axis, cone, penumbra, Curve::Constant(INTENSITY))
    }

    /// Irradiance from the light on a surface at a place.
    fn irradiance(light: &SpotLight, position: Vec3, normal: Vec3) -> f32 {
        let receiver = Receiver { position, normal };
        let sample = light.sample(&receiver, &Wavelengths::new([550.0; 4]));
        sample.map_or(0.0, |sample| {
            sample.radiance.0[0] * sample.wi.dot(normal) / sample.pdf
        })
    }

    #[test]
    fn a_floor_gets_the_intensity_by_the_square_of_the_distance_times_the_cosine() {
        // Straight down on the plane z = 0, 20° with an edge of 5°.
        let light = spot(Vec3::NEG_Z, 20.0, 5.0);
        for (degrees, share) in [
            (0.0, 1.0),
            (10.0, 1.0),
            (14.9, 1.0),
            (16.0, 0.8),
            (19.0, 0.2),
            (20.1, 0.0),
        ] {
            let angle = f32::to_radians(degrees);
            let place = Vec3::new(AT.x + AT.z * libm::tanf(angle), AT.y, 0.0);
            let cos = libm::cosf(angle);
            let expected = share * INTENSITY * cos * cos * cos / (AT.z * AT.z);
            let found = irradiance(&light, place, Vec3::Z);
            assert!(
                (found - expected).abs() < 2e-5,
                "{degrees}°: {found}, not {expected}"
            );
        }
    }

    #[test]
    fn the_edge_of_a_narrow_cone_lies_where_it_should() {
        let light = spot(Vec3::NEG_Z, 0.1, 0.0);
        for (degrees, lit) in [(0.0999, true), (0.1001, false)] {
            let place = Vec3::new(AT.x + AT.z * f32::to_radians(degrees), AT.y, 0.0);
            assert_eq!(irradiance(&light, place, Vec3::Z) > 0.0, lit, "{degrees}°");
        }
    }

    /// Radiant flux of intensity 1: `2π ∫ share sin θ dθ = 2π (1 − (sin c − sin b) / (c − b))` with
    /// the half angles `c` of the cone and `b` of the beam, and `2π (1 − cos c)` without an edge.
    fn flux(cone_deg: f64, penumbra_deg: f64) -> f64 {
        let (cone, width) = (cone_deg.to_radians(), penumbra_deg.to_radians());
        let beam = cone - width;
        let mean_cos = if width > 0.0 {
            (libm::sin(cone) - libm::sin(beam)) / width
        } else {
            libm::cos(cone)
        };
        2.0 * PI * (1.0 - mean_cos)
    }

    #[test]
    fn the_flux_through_a_sphere_is_that_of_the_cone() {
        const DRAWS: u32 = 1 << 16;
        let axis = Vec3::new(0.3, -0.5, 0.8).normalize();
        for (cone, penumbra) in [
            (60.0, 0.0),
            (60.0, 25.0),
            (89.0, 89.0),
            (30.0, 10.0),
            (180.0, 0.0),
        ] {
            let light = spot(axis, cone, penumbra);
            let radius = 0.7;
            let (mut sum, mut squares) = (0.0, 0.0);
            for draw in 0..DRAWS {
                let [x, y, ..] = Stream::new(3, draw, 0, 0).next4();
                // All directions: a cone of half a turn.
                let direction = warp::cone(Vec2::new(x, y), 2.0).normalize();
                let per_area = irradiance(&light, AT + radius * direction, -direction);
                let flux = f64::from(per_area * radius * radius) * 4.0 * PI;
                sum += flux;
                squares += flux * flux;
            }
            let count = f64::from(DRAWS);
            let mean = sum / count;
            let error = ((squares / count - mean * mean) / count).max(0.0).sqrt();
            let expected = f64::from(INTENSITY) * flux(cone, penumbra);
            // Four deviations, and rounding of single precision where there are none.
            assert!(
                (mean - expected).abs() < 4.0 * error + 1e-5 * expected,
                "{cone}°, {penumbra}°: {mean} ± {error}, not {expected}"
            );
        }
    }

    #[test]
    fn the_choice_between_lights_misses_no_place_that_one_of_them_lights() {
        let lights: Vec<SpotLight> = (0..40_u32)
            .map(|number| {
                let [x, y, z, w] = Stream::new(5, number, 0, 0).next4();
                let axis = warp::cone(Vec2::new(x, y), 2.0).normalize();
                let (cone, edge) = (0.1 + 2.0 * f64::from(z), f64::from(w));
                let place = Vec3::new(y, z, x) * 2.0;
                let intensity = Curve::Constant(libm::powf(10.0, 4.0 * w - 2.0));
                SpotLight::new(place, axis, cone, cone * edge, intensity)
            })
            .collect();
        let bounds = lights.iter().map(|light| light.emitter(1.0));
        let tree = LightTree::new(&bounds.collect::<Vec<_>>());
        let wavelengths = Wavelengths::new([550.0; 4]);
        let mut lit = 0;
        for place in 0..500 {
            let [x, y, z, _] = Stream::new(6, place, 0, 0).next4();
            let receiver = Receiver {
                position: Vec3::new(x, y, z) * 3.0,
                normal: Vec3::Z,
            };
            for (number, light) in lights.iter().enumerate() {
                if light.sample(&receiver, &wavelengths).is_some() {
                    lit += 1;
                    assert!(tree.probability(number, &receiver) > 0.0, "{receiver:?}");
                }
            }
        }
        assert!(lit > 1000, "only {lit}");
    }
}
