//! A walk through a leaf of layers, on the mesh: where light enters and where it leaves.

use glam::{Vec2, Vec3};

use crate::bsdf::leaf_face::FaceView;
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::geometry::{Geometry, Hit};
use crate::material::leaf::Inside;
use crate::material::leaf_layers::walk::{Chance, Place, Walk};
use crate::spectrum::{Lanes, Wavelengths};

/// Light at one face of a leaf, outside or inside.
#[derive(Clone, Copy, Debug)]
pub struct AtFace<const N: usize> {
    /// The face: 0 adaxial, 1 abaxial.
    pub face: usize,
    /// Where.
    pub surface: SurfacePoint,
    /// The frame there, whose +z points away from the leaf.
    pub outward: Frame,
    /// Direction from which light of each wavelength comes, in that frame.
    pub wo: [Vec3; N],
}

/// What becomes of light at a face.
#[derive(Clone, Copy, Debug)]
pub struct Leaving<const N: usize> {
    /// Direction in the world, unit.
    pub towards: Vec3,
    /// Its density, if a sampled light could have chosen it too.
    pub pdf: Option<f32>,
    /// Share of the light.
    pub weight: Lanes<N>,
    /// Where it leaves.
    pub surface: SurfacePoint,
}

/// The way of light into a leaf and through it, as far as its next face.
pub struct LeafWalk<'a, const N: usize> {
    geometry: &'a Geometry,
    walk: Walk<'a, N>,
    chance: Chance,
    /// The entry and the frame of the whole walk, +z adaxial.
    entry: SurfacePoint,
    frame: Frame,
    at: AtFace<N>,
}

/// The frame with +z away from a face.
fn outward(frame: &Frame, face: usize) -> Frame {
    if face == 0 {
        return *frame;
    }
    Frame::new(-frame.normal, frame.along)
}

/// A direction in the frame of the leaf in that of a face, and back: the abaxial face's is turned about
/// its y axis.
fn turned(w: Vec3, face: usize) -> Vec3 {
    if face == 0 {
        return w;
    }
    Vec3::new(-w.x, w.y, -w.z)
}

impl<'a, const N: usize> LeafWalk<'a, N> {
    /// Light that meets a leaf; `wo` is the direction from which it comes, in `frame`. The walk is
    /// cut after so many events.
    pub fn new(
        geometry: &'a Geometry,
        inside: Inside<'a>,
        (hit, surface, frame, wo): (&Hit, &SurfacePoint, &Frame, Vec3),
        wavelengths: &Wavelengths<N>,
        (numbers, most_events): ([f32; 4], u32),
    ) -> Self {
        let face = usize::from(wo.z < 0.0);
        let place = Place {
            uv: surface.uv,
            uv_per_m: geometry.uv_per_metre(hit, [frame.across, frame.along]),
        };
        let held = (inside.held, inside.palette);
        let outward = outward(frame, face);
        let mut chance = Chance::new(numbers);
        let lit = (face, most_events, &mut chance);
        Self {
            geometry,
            walk: Walk::new(inside.layers, held, place, wavelengths, lit),
            chance,
            entry: *surface,
            frame: *frame,
            at: AtFace {
                face,
                surface: *surface,
                outward,
                wo: [outward.to_local(frame.to_world(wo)); N],
            },
        }
    }

    /// Where the light is.
    pub fn at(&self) -> &AtFace<N> {
        &self.at
    }

    /// Share of the light that is left.
    pub fn weight(&self) -> Lanes<N> {
        self.walk.weight()
    }

    /// What a limit took of the light, if that has ended.
    pub fn cut(&self) -> Lanes<N> {
        if self.walk.is_cut() {
            self.walk.weight()
        } else {
            Lanes::ZERO
        }
    }

    /// A random number in [0, 1).
    pub fn number(&mut self) -> f32 {
        self.chance.number()
    }

    /// What a sampled light sees of the face at which the light is.
    pub fn view(&self) -> Option<FaceView<N>> {
        self.walk.view(self.at.face, &self.at.wo)
    }

    /// What the face does: the light that leaves.
    ///
    /// # Errors
    ///
    /// The directions in which it goes inside, for [`LeafWalk::go_on`], if it does not leave.
    pub fn cross(&mut self) -> Result<Leaving<N>, [Vec3; N]> {
        let face = self.at.face;
        let crossed = self.walk.cross(face, &self.at.wo, &mut self.chance);
        let [first, ..] = crossed.towards[..] else {
            unreachable!("a path carries a wavelength")
        };
        if first.z > 0.0 {
            return Ok(Leaving {
                towards: self.at.outward.to_world(first),
                pdf: crossed.pdf,
                weight: self.walk.weight(),
                surface: self.at.surface,
            });
        }
        // Inside, the frame is that of the entry however the blade is bent.
        Err(crossed.towards.map(|towards| turned(towards, face)))
    }

    /// Follows light inside to the next face; `None` if it ends.
    pub fn go_on(&mut self, headings: [Vec3; N]) -> Option<()> {
        let arrival = self.walk.to_face(headings, &mut self.chance)?;
        let (surface, frame) = self.exit();
        let face = arrival.face;
        self.at = AtFace {
            face,
            surface,
            outward: outward(&frame, face),
            wo: arrival.headings.map(|heading| turned(-heading, face)),
        };
        Some(())
    }

    /// Follows light until it leaves, by the face that it met first or by another; `None` if it ends.
    pub fn through(&mut self) -> Option<Leaving<N>> {
        loop {
            match self.cross() {
                Ok(leaving) => return Some(leaving),
                Err(headings) => self.go_on(headings)?,
            }
        }
    }

    /// The surface beside the entry at which the light is, found along the normal; the entry where
    /// there is none, as beyond the margin.
    fn exit(&self) -> (SurfacePoint, Frame) {
        let Vec2 { x, y } = self.walk.offset();
        let beside = self.frame.across * x + self.frame.along * y;
        let reach = 0.5 * beside.length() + 1e-4;
        if beside == Vec3::ZERO {
            return (self.entry, self.frame);
        }
        let origin = self.entry.position + beside + self.frame.normal * reach;
        let probe = Ray::new(origin, -self.frame.normal).up_to(2.0 * reach);
        let found = self
            .geometry
            .intersect(&probe)
            .filter(|hit| hit.instance == self.entry.instance);
        let Some(hit) = found else {
            return (self.entry, self.frame);
        };
        let surface = self.geometry.surface(&hit);
        (surface, surface.frame())
    }
}
