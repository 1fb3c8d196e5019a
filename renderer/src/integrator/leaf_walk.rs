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
pub struct AtFace {
    /// The face: 0 adaxial, 1 abaxial.
    pub face: usize,
    /// Where.
    pub surface: SurfacePoint,
    /// The frame there, whose +z points away from the leaf.
    pub outward: Frame,
    /// Direction from which the light comes, in that frame.
    pub wo: Vec3,
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
    at: AtFace,
}

/// The frame with +z away from a face.
fn outward(frame: &Frame, face: usize) -> Frame {
    if face == 0 {
        return *frame;
    }
    Frame::new(-frame.normal, frame.along)
}

impl<'a, const N: usize> LeafWalk<'a, N> {
    /// Light that meets a leaf; `wo` is the direction from which it comes, in `frame`.
    pub fn new(
        geometry: &'a Geometry,
        inside: Inside<'a>,
        (hit, surface, frame, wo): (&Hit, &SurfacePoint, &Frame, Vec3),
        wavelengths: &Wavelengths<N>,
        numbers: [f32; 4],
    ) -> Self {
        let face = usize::from(wo.z < 0.0);
        let place = Place {
            uv: surface.uv,
            uv_per_m: geometry.uv_per_metre(hit, [frame.across, frame.along]),
        };
        let held = (inside.held, inside.palette);
        let outward = outward(frame, face);
        Self {
            geometry,
            walk: Walk::new(inside.layers, held, place, wavelengths, face),
            chance: Chance::new(numbers),
            entry: *surface,
            frame: *frame,
            at: AtFace {
                face,
                surface: *surface,
                outward,
                wo: outward.to_local(frame.to_world(wo)),
            },
        }
    }

    /// Where the light is.
    pub fn at(&self) -> &AtFace {
        &self.at
    }

    /// Share of the light that is left.
    pub fn weight(&self) -> Lanes<N> {
        self.walk.weight()
    }

    /// A random number in [0, 1).
    pub fn number(&mut self) -> f32 {
        self.chance.number()
    }

    /// What a sampled light sees of the face at which the light is.
    pub fn view(&self) -> Option<FaceView> {
        let face = self.walk.face(self.at.face);
        (!face.is_smooth()).then(|| face.seen_from(self.at.wo))
    }

    /// What the face does: the light that leaves.
    ///
    /// # Errors
    ///
    /// The direction in which it goes inside, for [`LeafWalk::go_on`], if it does not leave.
    pub fn cross(&mut self) -> Result<Leaving<N>, Vec3> {
        let face = self.walk.face(self.at.face);
        let crossed = face.cross(self.at.wo, || self.chance.number());
        let towards = self.at.outward.to_world(crossed.towards);
        if crossed.towards.z > 0.0 {
            return Ok(Leaving {
                towards,
                pdf: crossed.pdf,
                weight: self.walk.weight(),
                surface: self.at.surface,
            });
        }
        // Inside, the frame is that of the entry however the blade is bent.
        let here = self.at.outward.to_local(towards);
        let side = if self.at.face == 0 { 1.0 } else { -1.0 };
        let (x, y) = if self.at.face == 0 {
            (here.x, here.y)
        } else {
            (-here.x, here.y)
        };
        Err(Vec3::new(x, y, side * here.z))
    }

    /// Follows light inside to the next face; `None` if it ends.
    pub fn go_on(&mut self, heading: Vec3) -> Option<()> {
        let arrival = self.walk.to_face(heading, &mut self.chance)?;
        let (surface, frame) = self.exit();
        let outward = outward(&frame, arrival.face);
        let from = -arrival.heading;
        // As above: the abaxial face's frame is turned about its y axis.
        let wo = if arrival.face == 0 {
            from
        } else {
            Vec3::new(-from.x, from.y, -from.z)
        };
        self.at = AtFace {
            face: arrival.face,
            surface,
            outward,
            wo,
        };
        Some(())
    }

    /// Follows light until it leaves, by the face that it met first or by another; `None` if it ends.
    pub fn through(mut self) -> Option<Leaving<N>> {
        loop {
            match self.cross() {
                Ok(leaving) => return Some(leaving),
                Err(heading) => self.go_on(heading)?,
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
        let surface = self.geometry.surface(&probe, &hit);
        (surface, surface.frame())
    }
}
