//! The integrating sphere.
//!
//! The sample is lit from one side, by parallel light or by even light from the half space, and
//! everything that it sends back into that half space is reflected, everything that goes on into
//! the other is transmitted. The rest is absorbed. Light that leaves does not come back: the sphere
//! is an ideal one, without the error of substitution.

use glam::{Vec2, Vec3};

use super::batches::{Budget, Experiment, estimates};
use super::fluorescence::{self, Illumination, Manner};
use super::row::{Direction, Row};
use super::spot::{Port, axes_of, ports};
use super::stage::Stage;
use super::walk::{Escaped, Event, Straight, Walk, Witness};
use super::{InstrumentError, LANES};
use crate::geometry::Ray;
use crate::geometry::frame::Frame;
use crate::sampling::stream::Stream;
use crate::sampling::warp;
use crate::scene::description::{Description, Incidence, Instrument, Named, Sphere};
use crate::scene::world::World;
use crate::spectrum::Wavelengths;

/// Ways in which light goes on from where it first meets the sample. Whether it is reflected or
/// transmitted is most of what differs between rays, and costs less than another ray.
const WAYS: u32 = 8;
/// Names of the faces.
const FACES: [&str; 2] = ["adaxial", "abaxial"];
/// Figures of a wavelength.
const QUANTITIES: [&str; 3] = ["reflectance", "transmittance", "absorptance"];

/// How fluorescence is shown.
const FLUORESCENCE: Manner = Manner {
    words: [
        Some("fluorescence_emitted"),
        Some("fluorescence_backward"),
        Some("fluorescence_forward"),
        Some("fluorescence_absorbed"),
        None,
    ],
    ways: WAYS,
    counts_misses: false,
    soil: None,
};

/// Where rays start.
enum Opening {
    /// A port that the surface touches.
    Port(Port),
    /// A ball around the whole object: its middle and radius, m. Rays that miss it do not count.
    Around([Vec3; 2], f32),
}

/// One light on one face, at one set of wavelengths.
struct Lit<'a> {
    stage: &'a Stage<'a>,
    opening: &'a Opening,
    /// The frame of the port: x as the object's, +z out of the face.
    frame: Frame,
    direction: Direction,
    azimuth: f64,
    wavelengths: Wavelengths<LANES>,
    stream: u32,
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

impl Experiment for Lit<'_> {
    fn sums(&self) -> usize {
        1 + QUANTITIES.len() * LANES
    }

    fn stream(&self) -> u32 {
        self.stream
    }

    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
        let ray = self.ray(stream);
        let mut gathered = Gathered {
            normal: self.frame.to_world(Vec3::Z),
            is_lit: false,
            flux: [[0.0; LANES]; 2],
        };
        let walk = Walk {
            stage: self.stage,
            course: &Straight,
            wavelengths: &self.wavelengths,
            ways: WAYS,
        };
        walk.follow(ray, stream, &mut gathered);
        if !gathered.is_lit {
            return;
        }
        sums[0] += 1.0;
        for lane in 0..LANES {
            let [r, t] = gathered.flux.map(|of| of[lane]);
            sums[1 + lane] += r;
            sums[1 + LANES + lane] += t;
            sums[1 + 2 * LANES + lane] += 1.0 - r - t;
        }
    }
}

/// What the sphere gathers of one ray.
struct Gathered {
    /// Out of the face that is lit.
    normal: Vec3,
    /// Whether the ray has met the sample.
    is_lit: bool,
    /// Reflected and transmitted flux.
    flux: [[f64; LANES]; 2],
}

impl Witness<'_> for Gathered {
    fn event(&mut self, _event: &Event) {
        self.is_lit = true;
    }

    fn escape(&mut self, escaped: &Escaped) {
        let side = usize::from(escaped.direction.dot(self.normal) <= 0.0);
        for (sum, weight) in self.flux[side].iter_mut().zip(escaped.weight.0) {
            *sum += f64::from(weight);
        }
    }
}

impl Lit<'_> {
    /// A ray of the light.
    fn ray(&self, stream: &mut Stream) -> Ray {
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

/// Measures.
pub(super) fn read_out(
    world: &World,
    scene: &Description,
    (instrument, sphere): (&Named<Instrument>, &Sphere),
    first_set: usize,
    budget: &Budget,
) -> Result<Vec<Row>, InstrumentError> {
    let at = &instrument.value.at;
    let object = &scene.objects[sphere.object];
    let stage =
        Stage::of_object(world, sphere.object).map_err(|source| InstrumentError::Geometry {
            at: at.clone(),
            source,
        })?;
    let [x, _, z] = axes_of(&object.value);
    let openings = if let Some(spot) = &sphere.spot {
        let ports = ports(&stage, (&object.name, &object.value), spot)?;
        if sphere.faces[1] && ports[1].faces_a_surface(&stage.geometry) {
            return Err(InstrumentError::PortInside {
                at: spot.at.clone(),
                object: object.name.clone(),
            });
        }
        ports.map(Opening::Port)
    } else {
        let (least, most) = stage.geometry.bounds();
        let radius = 0.5 * (most - least).length() * 1.0001;
        [z, -z].map(|normal| Opening::Around([0.5 * (least + most), normal], radius))
    };
    let directions = directions(&sphere.incidence);
    let nm = &instrument.value.wavelengths_nm;
    let sets = nm.len().div_ceil(LANES);
    let azimuth = sphere.incidence.azimuth;
    let mut lit = Vec::new();
    for (face, opening) in openings
        .iter()
        .enumerate()
        .filter(|(face, _)| sphere.faces[*face])
    {
        let normal = match opening {
            Opening::Port(port) => port.normal,
            Opening::Around([_, normal], _) => *normal,
        };
        for (number, &direction) in directions.iter().enumerate() {
            for set in 0..sets {
                lit.push(Lit {
                    stage: &stage,
                    opening,
                    frame: frame(normal, x),
                    direction,
                    // The frame of the other face is mirrored.
                    azimuth: if face == 0 { azimuth } else { -azimuth },
                    wavelengths: world.wavelengths.grid().set(first_set + set),
                    stream: (face * directions.len() + number) as u32,
                });
            }
        }
    }
    let found = estimates(&lit, budget);
    if found.iter().any(|figures| figures[0].value.is_nan()) {
        return Err(InstrumentError::NothingLit {
            at: at.clone(),
            object: object.name.clone(),
        });
    }
    let mut rows = Vec::new();
    for (figures, lit) in found.chunks(sets).zip(lit.chunks(sets)) {
        let face = lit[0].stream as usize / directions.len();
        for (i, &wavelength_nm) in nm.iter().enumerate() {
            for (number, quantity) in QUANTITIES.into_iter().enumerate() {
                let figure = figures[i / LANES][number * LANES + i % LANES];
                rows.push(Row {
                    instrument: instrument.name.clone(),
                    incidence: lit[0].direction,
                    face: Some(FACES[face]),
                    part: None,
                    wavelength_nm,
                    quantity,
                    value: figure.value,
                    error: figure.error,
                    unit: "1",
                });
            }
        }
    }
    if let Some(reading) = &instrument.value.fluorescence {
        let firsts = lit.iter().step_by(sets);
        let lights: Vec<_> = firsts
            .map(|lit| {
                let face = lit.stream as usize / directions.len();
                (lit, lit.direction, Some(FACES[face]))
            })
            .collect();
        let sample = (&stage, &Straight);
        let read = (instrument.name.as_str(), reading);
        let own = fluorescence::read_out(sample, &lights, read, &FLUORESCENCE, budget);
        rows.extend(own);
    }
    Ok(rows)
}

impl Illumination for Lit<'_> {
    fn ray(&self, stream: &mut Stream) -> Ray {
        Lit::ray(self, stream)
    }

    fn is_back(&self, direction: Vec3) -> bool {
        direction.dot(self.frame.to_world(Vec3::Z)) > 0.0
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
