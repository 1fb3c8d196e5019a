//! Surfaces that emit on the side of their normal.

use glam::{Vec2, Vec3};

use crate::light::patch::{self, Patch};
use crate::light::pattern::{Pattern, PlaneUv};
use crate::light::sample::{LightSample, Receiver};
use crate::light::tree::Emitter;
use crate::material::colour_map::ColourMap;
use crate::spectrum::rgb::Primaries;
use crate::spectrum::{Curve, Lanes, Share, Spectrum, WavelengthGrid, Wavelengths};

/// Patches in world space with a common radiance, or one that follows a pattern. A patch is a
/// triangle, or a rectangle of two triangles.
#[derive(Clone, Debug)]
pub struct AreaLight {
    radiance: Spectrum,
    patches: Box<[Patch]>,
    /// The patch that each triangle belongs to; `None` if it has no area in world space.
    patch_of: Box<[Option<u32>]>,
    patterned: Option<Box<Patterned>>,
}

/// A pattern over the patches.
#[derive(Clone, Debug)]
struct Patterned {
    pattern: Pattern,
    /// Of each patch.
    planes: Box<[PlaneUv]>,
    /// Mean factor over each patch.
    means: Box<[f32]>,
    primaries: Primaries,
}

/// Points along a side of a patch at which a pattern is averaged.
const AVERAGED: usize = 8;

/// Least mean of a patch as a share of the light's: between the points that are averaged there may
/// be light.
const LEAST_MEAN: f32 = 0.01;

impl AreaLight {
    /// An even light from world-space triangles, counter-clockwise seen from the bright side.
    pub fn new(triangles: &[[Vec3; 3]], radiance: Curve) -> Self {
        let (patches, patch_of) = patch::patches(triangles);
        Self {
            radiance: radiance.into(),
            patches: patches.into(),
            patch_of: patch_of.into(),
            patterned: None,
        }
    }

    /// A light whose radiance is multiplied by a pattern over the texture coordinates of its
    /// triangles.
    pub fn with_pattern(
        triangles: &[[Vec3; 3]],
        uvs: &[[Vec2; 3]],
        radiance: Curve,
        pattern: Pattern,
    ) -> Self {
        let plane_of = |number: usize| PlaneUv::of(triangles[number], uvs[number]);
        let (patches, patch_of) = patch::patches_if(triangles, |first| {
            plane_of(first).continues(triangles[first + 1], uvs[first + 1])
        });
        let mut planes = Vec::with_capacity(patches.len());
        for (number, patch) in patch_of.iter().enumerate() {
            if patch.is_some_and(|patch| patch as usize == planes.len()) {
                planes.push(plane_of(number));
            }
        }
        let means = patches.iter().zip(&planes);
        let means: Vec<f32> = means
            .map(|(patch, plane)| mean_over(patch, plane, &pattern))
            .collect();
        let areas = patches.iter().zip(&means);
        let [light, area] = areas.fold([0.0; 2], |[light, area], (patch, mean)| {
            [light + mean * patch.area(), area + patch.area()]
        });
        let least = LEAST_MEAN * light / area.max(f32::MIN_POSITIVE);
        let patterned = Patterned {
            pattern,
            planes: planes.into(),
            means: means.into_iter().map(|mean| mean.max(least)).collect(),
            primaries: Primaries::new(radiance.clone()),
        };
        Self {
            radiance: radiance.into(),
            patches: patches.into(),
            patch_of: patch_of.into(),
            patterned: Some(Box::new(patterned)),
        }
    }

    /// Radiance curve, W m⁻² sr⁻¹ nm⁻¹; with a pattern, where that is 1.
    pub fn radiance(&self) -> &Curve {
        self.radiance.curve()
    }

    /// The light that the materials of its model emit, if that is its pattern.
    pub fn emission(&self) -> Option<&ColourMap> {
        self.patterned.as_ref()?.pattern.of_model()
    }

    /// Mean of the pattern over the surface, linear sRGB, to be multiplied by the radiance; `None`
    /// without a pattern.
    pub(crate) fn mean_colour(&self) -> Option<[f64; 3]> {
        /// Points over the whole surface, roughly, and fewest along a side of a patch.
        const POINTS: [usize; 2] = [1 << 18, 4];
        let patterned = self.patterned.as_ref()?;
        let each = (POINTS[0] / self.patches.len().max(1))
            .isqrt()
            .max(POINTS[1]);
        let mut sum = [0.0; 3];
        let mut area = 0.0;
        for (patch, plane) in self.patches.iter().zip(&patterned.planes) {
            for point in 0..each * each {
                let u = Vec2::new((point % each) as f32, (point / each) as f32);
                let uv = plane.at(patch.at((u + 0.5) / each as f32));
                for (sum, value) in sum.iter_mut().zip(patterned.pattern.at(uv)) {
                    *sum += f64::from(patch.area() * value) / (each * each) as f64;
                }
            }
            area += f64::from(patch.area());
        }
        Some(sum.map(|sum| sum / area))
    }

    /// A radiance that it exceeds nowhere.
    pub fn at_most(&self, share: &Share) -> f32 {
        let Some(patterned) = &self.patterned else {
            return self.radiance.curve().over(share);
        };
        let parts = patterned.primaries.over(share).into_iter();
        let parts = parts.zip(patterned.pattern.at_most());
        parts.map(|(spectrum, most)| spectrum * most).sum()
    }

    /// Evaluates its radiance at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.radiance.tabulate(grid);
        if let Some(patterned) = &mut self.patterned {
            patterned.primaries.tabulate(grid);
        }
    }

    /// The emitting patches.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Number of the patch that a triangle belongs to.
    pub(crate) fn patch_of(&self, triangle: u32) -> Option<usize> {
        self.patch_of[triangle as usize].map(|patch| patch as usize)
    }

    /// Each patch as an emitter for the light tree, with its mean radiance over the film's
    /// wavelengths.
    pub fn emitters(&self, range_nm: [f64; 2]) -> impl Iterator<Item = Emitter> + '_ {
        let radiance = self.radiance().mean_over(range_nm);
        self.patches.iter().enumerate().map(move |(number, patch)| {
            let patterned = self.patterned.as_ref();
            let mean = patterned.map_or(1.0, |patterned| patterned.means[number]);
            patch.emitter(radiance * mean)
        })
    }

    /// Samples a point of one patch, seen from `receiver`.
    pub fn sample<const N: usize>(
        &self,
        patch: usize,
        receiver: &Receiver,
        wavelengths: &Wavelengths<N>,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        let sample = self.patches[patch].sample(receiver, u)?;
        Some(LightSample {
            wi: sample.wi,
            point: Some(sample.point),
            radiance: self.radiance_at(Some(patch), sample.point, wavelengths),
            pdf: sample.pdf,
            is_point: false,
        })
    }

    /// Density over solid angle with which [`AreaLight::sample`] draws a point of that patch, seen
    /// from `receiver`.
    pub fn pdf(&self, patch: usize, receiver: &Receiver, point: Vec3) -> f32 {
        self.patches[patch].pdf(receiver, point)
    }

    /// Radiance towards `-wi` from a point of a triangle with the given normal; `None` on the dark
    /// side.
    pub fn emitted<const N: usize>(
        &self,
        wi: Vec3,
        normal: Vec3,
        (triangle, point): (u32, Vec3),
        wavelengths: &Wavelengths<N>,
    ) -> Option<Lanes<N>> {
        (wi.dot(normal) < 0.0)
            .then(|| self.radiance_at(self.patch_of(triangle), point, wavelengths))
    }

    fn radiance_at<const N: usize>(
        &self,
        patch: Option<usize>,
        point: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Lanes<N> {
        let Some(patterned) = &self.patterned else {
            return self.radiance.lanes(wavelengths);
        };
        // A triangle without area is seen by no ray.
        let factor = patch.map_or([0.0; 3], |patch| {
            patterned.pattern.at(patterned.planes[patch].at(point))
        });
        if factor[0] == factor[1] && factor[1] == factor[2] {
            return self.radiance.lanes(wavelengths) * factor[0];
        }
        patterned.primaries.spectrum(factor, wavelengths)
    }
}

/// Mean brightness of a pattern over a patch.
fn mean_over(patch: &Patch, plane: &PlaneUv, pattern: &Pattern) -> f32 {
    let mut sum = 0.0;
    for y in 0..AVERAGED {
        for x in 0..AVERAGED {
            let u = (Vec2::new(x as f32, y as f32) + 0.5) / AVERAGED as f32;
            sum += pattern.brightness(plane.at(patch.at(u)));
        }
    }
    sum / (AVERAGED * AVERAGED) as f32
}

#[cfg(test)]
mod tests;
