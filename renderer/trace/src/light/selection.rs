//! Selection of the lights that are sampled at a point.

use std::sync::Arc;

use crate::light::tree::LightTree;
use crate::light::{Light, Receiver, Sampled};
use crate::sampling::distribution::Piecewise1d;

/// Lights sorted by how they are sampled.
///
/// Suns are small and strong, so each is sampled at every vertex. Of the other lights, except
/// constant skies, one is chosen by the light that it may send to the vertex. A constant sky is
/// left to the bounces, which find it best; so are all other skies and environment pictures in a
/// selection without them ([`Selections`]).
#[derive(Clone, Debug)]
pub struct LightSelection {
    /// Lights sampled at every vertex.
    pub always: Box<[usize]>,
    /// Lights that are found by rays that hit nothing.
    pub at_infinity: Box<[usize]>,
    pictures: Option<Pictures>,
    patches: Option<Arc<Patches>>,
}

/// Skies and environment pictures, of which one is chosen by its brightness.
#[derive(Clone, Debug)]
struct Pictures {
    lights: Box<[usize]>,
    by_irradiance: Piecewise1d,
    /// Irradiance of all these pictures on a surface that sees half of the surroundings: a rough
    /// value, W m⁻² nm⁻¹.
    irradiance: f32,
    /// The greatest of their unevennesses.
    unevenness: f64,
}

/// Patches of area lights, and spotlights, of which the tree chooses one.
#[derive(Clone, Debug)]
struct Patches {
    /// Light and part of each leaf of the tree.
    parts: Box<[(u32, u32)]>,
    /// Leaf of the first part of each light, by the light's number.
    first_leaf: Box<[u32]>,
    tree: LightTree,
}

/// The lights to sample for paths that sample skies and environment pictures, and for those that
/// leave them to bounces.
#[derive(Clone, Debug)]
pub struct Selections {
    with_skies: LightSelection,
    without_skies: LightSelection,
}

impl Selections {
    /// The selections for a scene's lights and a film with the given range of wavelengths.
    pub fn new(lights: &[Light], range_nm: [f64; 2]) -> Self {
        let with_skies = LightSelection::new(lights, range_nm);
        Self {
            without_skies: with_skies.without_skies(),
            with_skies,
        }
    }

    /// The selection with skies and environment pictures, or without.
    #[inline]
    pub fn of(&self, with_skies: bool) -> &LightSelection {
        if with_skies {
            &self.with_skies
        } else {
            &self.without_skies
        }
    }

    /// Whether there are skies or environment pictures to sample that bounces could find as well,
    /// since none of their light comes from a small part of them.
    pub fn have_even_skies(&self) -> bool {
        let pictures = self.with_skies.pictures.as_ref();
        pictures.is_some_and(|pictures| pictures.unevenness <= EVEN)
    }
}

/// Unevenness of a sky up to which bounces may do without samples of it. Of one that is less
/// uneven, a part that sends a tenth of the light is an eight-hundredth of the sphere or more: some
/// of a few thousand bounces meet it, so that a trial tells what they miss.
const EVEN: f64 = 8.0;

/// A light that is to be sampled.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// Number of the light.
    pub light: usize,
    /// Its part: a patch of an area light, 0 for other lights.
    pub part: usize,
    /// Expected number of samples of this part: the probability of the choice times the number of
    /// choices.
    pub expected: f32,
}

impl Choice {
    /// The choice of a light with one part that is always sampled.
    pub fn certain(light: usize) -> Self {
        Self {
            light,
            part: 0,
            expected: 1.0,
        }
    }
}

impl LightSelection {
    /// The selection for a scene's lights and a film with the given range of wavelengths.
    pub fn new(lights: &[Light], range_nm: [f64; 2]) -> Self {
        let (mut always, mut at_infinity) = (Vec::new(), Vec::new());
        let (mut pictures, mut irradiances) = (Vec::new(), Vec::new());
        let mut greatest = 1.0_f64;
        let (mut emitters, mut parts) = (Vec::new(), Vec::new());
        let mut first_leaf = vec![0; lights.len()];
        for (number, light) in lights.iter().enumerate() {
            if light.is_at_infinity() {
                at_infinity.push(number);
            }
            match light.sampled(range_nm) {
                Sampled::Never => {}
                Sampled::Always => always.push(number),
                Sampled::Around {
                    irradiance,
                    unevenness,
                } => {
                    pictures.push(number);
                    irradiances.push(irradiance);
                    greatest = greatest.max(unevenness);
                }
                Sampled::ByParts(own) => {
                    first_leaf[number] = parts.len() as u32;
                    parts.extend((0..own.len()).map(|part| (number as u32, part as u32)));
                    emitters.extend(own);
                }
            }
        }
        Self {
            always: always.into(),
            at_infinity: at_infinity.into(),
            pictures: (!pictures.is_empty()).then(|| Pictures {
                lights: pictures.into(),
                by_irradiance: Piecewise1d::new(&irradiances),
                irradiance: irradiances.iter().sum(),
                unevenness: greatest,
            }),
            patches: (!emitters.is_empty()).then(|| {
                Arc::new(Patches {
                    parts: parts.into(),
                    first_leaf: first_leaf.into(),
                    tree: LightTree::new(&emitters),
                })
            }),
        }
    }

    /// The same lights, of which skies and environment pictures are never sampled.
    fn without_skies(&self) -> Self {
        Self {
            pictures: None,
            ..self.clone()
        }
    }

    /// Whether there is no light to choose from.
    pub fn is_empty(&self) -> bool {
        self.pictures.is_none() && self.patches.is_none()
    }

    /// Chooses one of the lights that share a sample by `u` in [0, 1); `None` if none of them
    /// illuminates the receiver.
    pub fn choose(&self, receiver: &Receiver, u: f32) -> Option<Choice> {
        let share = self.share_of_pictures(receiver);
        if u < share {
            let pictures = self.pictures.as_ref()?;
            let (place, _) = pictures.by_irradiance.sample(u / share);
            return Some(Choice {
                light: pictures.lights[place],
                part: 0,
                expected: share * pictures.by_irradiance.probability(place),
            });
        }
        let patches = self.patches.as_ref()?;
        let (leaf, probability) = if patches.tree.len() == 1 {
            (0, 1.0)
        } else {
            let u = ((u - share) / (1.0 - share)).min(1.0 - f32::EPSILON);
            patches.tree.choose(receiver, u)?
        };
        let (light, part) = patches.parts[leaf];
        Some(Choice {
            light: light as usize,
            part: part as usize,
            expected: (1.0 - share) * probability,
        })
    }

    /// Expected number of samples of a light at infinity at `receiver` if `chosen` lights are
    /// chosen there; 0 if it is left to the bounces.
    pub(crate) fn samples_of_infinite(
        &self,
        light: usize,
        receiver: &Receiver,
        chosen: f32,
    ) -> f32 {
        if self.always.contains(&light) {
            return 1.0;
        }
        let Some(pictures) = &self.pictures else {
            return 0.0;
        };
        let place = pictures.lights.iter().position(|&number| number == light);
        place.map_or(0.0, |place| {
            chosen * self.share_of_pictures(receiver) * pictures.by_irradiance.probability(place)
        })
    }

    /// Probability of choosing a part of a light at `receiver`.
    pub(crate) fn probability_of_part(
        &self,
        light: usize,
        part: usize,
        receiver: &Receiver,
    ) -> f32 {
        let Some(patches) = &self.patches else {
            return 0.0;
        };
        let leaf = patches.first_leaf[light] as usize + part;
        let probability = if patches.tree.len() == 1 {
            1.0
        } else {
            patches.tree.probability(leaf, receiver)
        };
        (1.0 - self.share_of_pictures(receiver)) * probability
    }

    /// Probability of choosing an environment picture.
    fn share_of_pictures(&self, receiver: &Receiver) -> f32 {
        match (&self.pictures, &self.patches) {
            (None, _) => 0.0,
            (Some(_), None) => 1.0,
            (Some(pictures), Some(patches)) => {
                let near = patches.tree.importance(receiver);
                if near <= 0.0 {
                    return 1.0;
                }
                let share = pictures.irradiance / (pictures.irradiance + near);
                // Neither estimate accounts for shadows.
                share.clamp(0.1, 0.9)
            }
        }
    }
}
