//! The part of a path that leads through a leaf of layers.

use glam::Vec3;

use super::drops::Passage;
use super::lamps::sampled_light;
use super::paths::{Bounce, Leg, Paths};
use super::result::PathResult;
use super::vertex::Vertex;
use crate::bsdf::View;
use crate::geometry::Hit;
use crate::geometry::frame::Frame;
use crate::geometry::surface::SurfacePoint;
use crate::light::Receiver;
use crate::material::leaf::Inside;
use crate::sampling::dimensions::{FACES, picture as sets};
use crate::sampling::stream::Stream;
use crate::spectrum::Lanes;
use crate::walk::cone::Cone;
use crate::walk::facet::Facet;
use crate::walk::leaf_walk::LeafWalk;
use crate::walk::{Scatterer, roulette};

/// Where a path meets the leaf.
pub(super) struct Entry<'a, const N: usize> {
    pub(super) inside: Inside<'a>,
    /// The hit, the surface, its frame, and the direction from which the ray came in it.
    pub(super) at: (&'a Hit, &'a SurfacePoint, &'a Frame, Vec3),
    /// Throughput and width of the ray.
    pub(super) leg: (Lanes<N>, f32),
    pub(super) depth: u32,
    /// The bodies around, in scenes with media.
    pub(super) passage: &'a Passage,
}

impl<const N: usize> Paths<'_, N> {
    /// The leg that leaves the leaf, by either face; `None` if the path ends in it. Lights are
    /// sampled at every face that the light meets, from outside and from inside, and weighted
    /// against the chance that one facet of it sends light there.
    pub(super) fn through_leaf(
        &self,
        entry: &Entry<'_, N>,
        stream: &mut Stream,
        result: &mut PathResult<N>,
    ) -> Option<Leg<N>> {
        let (throughput, width) = entry.leg;
        let world = self.world;
        stream.seek(sets::VERTEX.of(entry.depth));
        let numbers = stream.next4();
        let light_samples = self.light_samples(entry.depth);
        let mut walk = LeafWalk::new(
            &world.geometry,
            entry.inside,
            entry.at,
            self.wavelengths,
            (numbers, world.integrator.max_events),
        );
        let [_, mut x, mut y, _] = numbers;
        for face in 0.. {
            let at = *walk.at();
            let receiver = Receiver {
                position: at.surface.position,
                normal: at.surface.shading_normal,
            };
            let facet = Facet {
                around: &world.geometry,
                surface: &at.surface,
            };
            let seen = walk.view();
            let view = seen.as_ref().map(View::Face);
            if let Some(view) = &view {
                let vertex = Vertex {
                    paths: self,
                    scatterer: Scatterer::Surface {
                        facet,
                        frame: &at.outward,
                        view,
                    },
                    receiver,
                    is_lit: true,
                    light_samples,
                    throughput: throughput * walk.weight(),
                    width,
                    gathered: result.radiance,
                    inside: &entry.passage.around.inside,
                    boundary: None,
                    cap: None,
                };
                let (light, rays) = sampled_light(world, &vertex, self.wavelengths, [x, y], stream);
                result.radiance += light;
                result.rays += rays;
            }
            match walk.cross() {
                Ok(leaving) => {
                    let mut throughput = throughput * leaving.weight;
                    let brightness = self.brightness(&throughput);
                    if brightness <= 0.0 {
                        return None;
                    }
                    let below = self.effort.roulette_below;
                    throughput *= roulette(brightness, below, || walk.number())?;
                    let towards = facet.leaving(leaving.towards);
                    // Light of one facet may have been mirrored into the same direction.
                    let density = |own: f32| {
                        let view = view.as_ref().filter(|_| facet.is_near_gap(towards));
                        view.map_or(own, |view| {
                            facet.scatter((&at.outward, view), towards).1.pdf
                        })
                    };
                    return Some(Leg {
                        ray: facet.spawn(towards),
                        cone: Cone::scattered(width),
                        throughput,
                        origin: Bounce {
                            pdf: leaving.pdf.map_or(f32::INFINITY, density),
                            from: receiver,
                            light_samples,
                        },
                    });
                }
                Err(headings) => {
                    if walk.go_on(headings).is_none() {
                        result.end_early(throughput * walk.cut());
                        return None;
                    }
                }
            }
            result.rays += 1;
            let place = entry.depth * FACES + face.min(FACES - 1);
            stream.seek(sets::FACE.of(place));
            [_, x, y, _] = stream.next4();
        }
        None
    }
}
