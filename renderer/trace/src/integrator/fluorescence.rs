//! Radiance that a fluorescing leaf emits, in pictures.
//!
//! A path comes from the camera with the wavelengths of emission. At a leaf that fluoresces another
//! path goes on with wavelengths that excite, and finds their light as any path does: by lights that
//! are sampled at the leaf and by the direction in which it goes on. What it finds excites the leaf,
//! and what the leaf then emits towards the camera at the path's own wavelengths is added. That path
//! excites nothing in turn.

use optics::fluorescence::EXCITED_NM;

use super::path::PathResult;
use super::path::drops::Passage;
use super::path::lamps::sampled_light;
use super::path::paths::{Leg, Paths};
use super::path::vertex::Vertex;
use crate::bsdf::View;
use crate::bsdf::fluorescence::FluorescenceView;
use crate::geometry::surface::SurfacePoint;
use crate::light::Receiver;
use crate::material::leaf::LeafMaterial;
use crate::sampling::dimensions::excitation as sets;
use crate::sampling::stream::Stream;
use crate::spectrum::{Lanes, Wavelengths};
use crate::walk::encounter::Encounter;
use crate::walk::{Scatterer, Walk};

/// Probability of a path of excitation at a leaf that the camera does not see directly. At the first
/// leaf there always is one.
const BEYOND_THE_FIRST: f32 = 0.25;

impl<const N: usize> Paths<'_, N> {
    /// What a leaf emits towards where a path comes from, at the path's wavelengths. The path was
    /// scattered `depth` times before.
    pub(super) fn emitted(
        &self,
        leaf: &LeafMaterial,
        encounter: &Encounter<'_, N>,
        way: (&Leg<N>, &Passage),
        depth: u32,
        stream: &Stream,
    ) -> PathResult<N> {
        let surface: &SurfacePoint = &encounter.surface;
        let emitting = leaf.emitting(surface.uv, self.wavelengths);
        let mut stream = stream.nested(depth);
        stream.seek(sets::START.of(0));
        let [coin, wavelength, side, _] = stream.next4();
        let chance = if depth == 0 { 1.0 } else { BEYOND_THE_FIRST };
        if coin >= chance || emitting.is_nothing() || encounter.wo.z == 0.0 {
            return PathResult::NOTHING;
        }
        // Each lane has a place in its own share of the wavelengths.
        let [first, last] = EXCITED_NM.map(|nm| nm as f32);
        let step = (last - first) / N as f32;
        let nm = std::array::from_fn(|lane| first + step * (lane as f32 + wavelength));
        let wavelengths = Wavelengths::new(nm);
        let excited = leaf.excited(surface.uv, &wavelengths);
        // Light on the same face, or on the other one, in proportion to what the same light excites.
        let own_face = usize::from(encounter.wo.z < 0.0);
        let faces = [own_face, 1 - own_face];
        let sums = [false, true].map(|through| {
            let source = excited.source(faces[usize::from(through)], &[1.0; N]);
            let leaving = emitting.leaving(&source, through);
            leaving.iter().sum::<f64>()
        });
        let through_chance = sums[1] / (sums[0] + sums[1]);
        if !through_chance.is_finite() {
            return PathResult::NOTHING;
        }
        let is_through = f64::from(side) < through_chance;
        let side_chance = if is_through {
            through_chance
        } else {
            1.0 - through_chance
        };

        let found = self.exciting(
            leaf,
            (encounter, way),
            (&wavelengths, depth),
            is_through,
            &mut stream,
        );

        // Photons for each lane, but for hc, and energy of what is emitted.
        let share = f64::from(step) / (side_chance * f64::from(chance));
        let own = self.wavelengths.nm;
        let emitted = |found: Lanes<N>| {
            let photons =
                std::array::from_fn(|lane| f64::from(found.0[lane]) * f64::from(nm[lane]) * share);
            let source = excited.source(faces[usize::from(is_through)], &photons);
            let leaving = emitting.leaving(&source, is_through);
            Lanes::from_fn(|lane| (leaving[lane] / f64::from(own[lane])) as f32)
        };
        let cut = if found.cuts > 0 {
            emitted(found.cut)
        } else {
            Lanes::ZERO
        };
        PathResult {
            radiance: emitted(found.radiance),
            cut,
            ..found
        }
    }

    /// Light of wavelengths that excite, as a leaf that sent all of it towards where the path comes
    /// from would show it.
    fn exciting(
        &self,
        leaf: &LeafMaterial,
        (encounter, (leg, passage)): (&Encounter<'_, N>, (&Leg<N>, &Passage)),
        (wavelengths, depth): (&Wavelengths<N>, u32),
        is_through: bool,
        stream: &mut Stream,
    ) -> PathResult<N> {
        let surface = &encounter.surface;
        let paths = Paths {
            world: self.world,
            effort: self.effort,
            wavelengths,
            excites: true,
        };
        let view = View::Fluorescence(FluorescenceView::new(
            leaf.coats(),
            encounter.wo,
            is_through,
        ));
        let vertex = Vertex {
            paths: &paths,
            scatterer: Scatterer::Surface {
                facet: encounter.facet(&self.world.geometry),
                frame: &encounter.frame,
                view: &view,
            },
            receiver: Receiver {
                position: surface.position,
                normal: surface.shading_normal,
            },
            is_lit: true,
            light_samples: 1,
            throughput: Lanes::ONE,
            width: encounter.width,
            gathered: Lanes::ZERO,
            inside: &passage.around.inside,
            // A leaf is a sheet, no boundary of a body.
            boundary: None,
            cap: None,
        };
        let mut result = PathResult::NOTHING;
        stream.seek(sets::LEAF.of(0));
        let numbers = stream.next4();
        let [_, x, y, _] = numbers;
        let (light, rays) = sampled_light(self.world, &vertex, wavelengths, [x, y], stream);
        result.radiance += light;
        result.rays += rays;
        let mut leg = *leg;
        if vertex.bounce(numbers, 1.0, self.effort.roulette_below, &mut leg) {
            let drops = passage.drops;
            let place = (
                encounter.facet(&self.world.geometry),
                &encounter.frame,
                encounter.wo,
            );
            let passage = Passage {
                drops: (drops.film()).map_or(drops, |film| film.leave(drops, place, &mut leg)),
                ..*passage
            };
            paths.follow(&mut leg, passage, depth + 1, stream, &mut result);
        }
        result
    }
}
