//! The light on a sample: through a port over a spot, or from around the whole object.

use glam::{Vec2, Vec3};

use super::error::{InstrumentError, Problem};
use super::measurement::Measurement;
use super::row::Direction;
use super::spot::{Port, axes_of, ports};
use super::stage::Stage;
use crate::geometry::Ray;
use crate::geometry::frame::Frame;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::{Incidence, Sample};

/// Names of the faces.
pub(super) const FACES: [&str; 2] = ["adaxial", "abaxial"];

/// Where rays start.
enum Opening {
    /// A port that the surface touches.
    Port(Port),
    /// A ball around the whole object: its middle and radius, m. Rays that miss it do not count.
    Around([Vec3; 2], f32),
}

/// A sample alone, ready to be lit on either face.
pub(super) struct Bench<'w> {
    /// The sample.
    pub(super) stage: Stage<'w>,
    openings: [Opening; 2],
    /// The object's x axis, unit.
    x: Vec3,
}

/// One light on one face.
pub(super) struct Lamp<'b> {
    opening: &'b Opening,
    /// The frame of the face: x as the object's, +z out of the face.
    pub(super) frame: Frame,
    pub(super) direction: Direction,
    /// Azimuth of a beam in the frame, and the sense of azimuths: the frame of the abaxial face is
    /// mirrored.
    pub(super) azimuth: f64,
    pub(super) turn: f64,
    /// Number of the face.
    pub(super) face: usize,
    /// Number of the light, from which its random numbers come.
    pub(super) stream: u32,
}

impl<'w> Bench<'w> {
    /// The sample of an instrument.
    pub(super) fn new(
        measurement: &Measurement<'w>,
        sample: &Sample,
    ) -> Result<Self, InstrumentError> {
        let object = &measurement.scene.objects[sample.object];
        let stage = Stage::of_object(measurement.world, sample.object);
        let stage = stage.map_err(|source| measurement.refuse(Problem::Geometry(source)))?;
        let [x, _, z] = axes_of(&object.value);
        let openings = if let Some(spot) = &sample.spot {
            let ports = ports(&stage, (&object.name, &object.value), spot)?;
            if sample.faces[1] && ports[1].faces_a_surface(&stage.geometry) {
                let object = object.name.clone();
                return Err(Problem::PortInside { object }.at(&spot.at));
            }
            ports.map(Opening::Port)
        } else {
            let (least, most) = stage.geometry.bounds();
            let radius = 0.5 * (most - least).length() * 1.0001;
            [z, -z].map(|normal| Opening::Around([0.5 * (least + most), normal], radius))
        };
        Ok(Self { stage, openings, x })
    }

    /// All lights of a sample, face by face.
    pub(super) fn lamps(&self, sample: &Sample) -> Vec<Lamp<'_>> {
        let directions = directions(&sample.incidence);
        let mut lamps = Vec::new();
        for (face, opening) in self.openings.iter().enumerate() {
            if !sample.faces[face] {
                continue;
            }
            let normal = match opening {
                Opening::Port(port) => port.normal,
                Opening::Around([_, normal], _) => *normal,
            };
            let turn = if face == 0 { 1.0 } else { -1.0 };
            for (number, &direction) in directions.iter().enumerate() {
                lamps.push(Lamp {
                    opening,
                    frame: frame(normal, self.x),
                    direction,
                    azimuth: turn * sample.incidence.azimuth,
                    turn,
                    face,
                    stream: (face * directions.len() + number) as u32,
                });
            }
        }
        lamps
    }
}

/// The directions of an instrument's light, in the order of its rows.
pub(super) fn directions(incidence: &Incidence) -> Vec<Direction> {
    let beams = incidence.angles.iter().map(|angle| Direction::Beam(*angle));
    let diffuse = incidence.diffuse.then_some(Direction::Diffuse);
    beams.chain(diffuse).collect()
}

/// Towards a beam at an angle from +z and an azimuth, rad.
pub(super) fn towards(angle: f64, azimuth: f64) -> Vec3 {
    let (sin, cos) = libm::sincos(angle);
    let (sin_azimuth, cos_azimuth) = libm::sincos(azimuth);
    glam::DVec3::new(sin * cos_azimuth, sin * sin_azimuth, cos).as_vec3()
}

impl Lamp<'_> {
    /// A ray of the light.
    pub(super) fn ray(&self, stream: &mut Stream) -> Ray {
        let [x, y, u, v] = stream.next4();
        let disc = warp::disc(Vec2::new(x, y));
        match self.opening {
            Opening::Port(port) => {
                let local = match self.direction {
                    Direction::Beam(angle) => towards(angle, self.azimuth),
                    Direction::Diffuse => warp::cosine_hemisphere(Vec2::new(u, v)),
                };
                let place = self.frame.to_world(disc.extend(0.0)) * port.radius;
                Ray::new(port.middle + place, -self.frame.to_world(local))
            }
            Opening::Around([middle, _], radius) => {
                let local = match self.direction {
                    Direction::Beam(angle) => towards(angle, self.azimuth),
                    // The same radiance from everywhere: each direction lights what it sees.
                    Direction::Diffuse => warp::cone(Vec2::new(u, v), 1.0),
                };
                let towards = self.frame.to_world(local);
                let (across, along) = towards.any_orthonormal_pair();
                let place = (across * disc.x + along * disc.y + towards * 2.0) * *radius;
                Ray::new(*middle + place, -towards)
            }
        }
    }
}

/// The frame with +z along a normal whose x axis is as near to `x` as can be.
fn frame(normal: Vec3, x: Vec3) -> Frame {
    let flat = x - normal * normal.dot(x);
    let x = flat
        .try_normalize()
        .unwrap_or(normal.any_orthonormal_vector());
    Frame::new(normal, normal.cross(x))
}
