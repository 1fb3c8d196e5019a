//! Light inside a leaf of layers, from face to face.

use glam::{Vec2, Vec3};
use optics::{Constituent, Texel};

use super::{LAYERS, LeafLayers};
use crate::bsdf::fresnel;
use crate::bsdf::leaf_face::{Crossed, FaceView, LeafFace, Likelihood};
use crate::material::held::Held;
use crate::material::palette::Palette;
use crate::sampling::mixer::Sequence;
use crate::spectrum::{Lanes, Wavelengths};

/// Weight, in the lane where it is greatest, below which chance decides whether light goes on with
/// that much, or ends.
const ROULETTE_BELOW: f32 = 0.05;
/// Cosine to the normal below which light counts as if it had this one.
const LEAST_COSINE: f32 = 1e-7;
/// Most texels of a map that light crosses between two looks at the contents.
const TEXELS: f32 = 1.0;

/// Random numbers of a walk, which needs no one knows how many: splitmix64, seeded by numbers of
/// the path's stream.
#[derive(Clone, Debug)]
pub struct Chance(Sequence);

impl Chance {
    /// Random numbers that depend on these alone.
    pub fn new(numbers: [f32; 4]) -> Self {
        let mut chance = Sequence(0x1a7e_5eed);
        for number in numbers {
            chance.0 ^= u64::from(number.to_bits());
            chance.0 = chance.next();
        }
        Self(chance)
    }

    /// A number in [0, 1).
    pub fn number(&mut self) -> f32 {
        (self.0.next() >> 40) as f32 / 16_777_216.0
    }
}

/// Where a walk begins: texture coordinates there, and how they change by m along the two axes of
/// the frame of the surface.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Texture coordinates.
    pub uv: Vec2,
    /// Their change along x and along y, 1/m.
    pub uv_per_m: [Vec2; 2],
}

/// Light that meets a face from inside.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<const N: usize> {
    /// The face: 0 adaxial, 1 abaxial.
    pub face: usize,
    /// Direction in which light of each wavelength goes, in the frame of the surface, unit.
    pub headings: [Vec3; N],
}

/// Light inside a leaf; the frame is that of the surface, +z adaxial.
///
/// All wavelengths go one way: through the same layers, scattered at the same depths into the same
/// directions. Between two scatterings each has the directions of its own indices.
#[derive(Clone, Debug)]
pub struct Walk<'a, const N: usize> {
    layers: &'a LeafLayers,
    held: &'a Held,
    place: Place,
    /// Indices, and coefficients of scattering with the greatest amount that the leaf has, 1/m.
    index: [Lanes<N>; LAYERS],
    scattering: [Lanes<N>; LAYERS],
    g: Lanes<N>,
    /// What one unit of each constituent absorbs.
    specific: [Lanes<N>; Constituent::COUNT],
    /// Absorption of each layer, if the leaf is uniform, 1/m.
    uniform: Option<[Lanes<N>; LAYERS]>,
    /// Distance that light goes between two looks at the contents, m.
    stride: f32,
    /// Which layer the light is in, how deep in it, m, and how far beside its entry, m.
    layer: usize,
    depth: f32,
    offset: Vec2,
    /// Share of the light that is not absorbed.
    left: Lanes<N>,
    likelihood: Likelihood<N>,
    /// Events until the walk is cut: light may be caught in a layer whose neighbours have a lower
    /// index, if nothing scatters or absorbs it there.
    events: u32,
}

impl<'a, const N: usize> Walk<'a, N> {
    /// Light of a path's wavelengths at a place, about to enter by a face (0 adaxial, 1 abaxial),
    /// and the number of events after which it is cut.
    pub fn new(
        layers: &'a LeafLayers,
        (held, palette): (&'a Held, &Palette),
        place: Place,
        wavelengths: &Wavelengths<N>,
        (face, events, chance): (usize, u32, &mut Chance),
    ) -> Self {
        let rows = wavelengths.nm.map(|nm| layers.row(nm));
        let coefficients = wavelengths.nm.map(|nm| palette.coefficients(f64::from(nm)));
        let specific = Constituent::ALL.map(|constituent| {
            Lanes::from_fn(|lane| match constituent {
                Constituent::Structure => 0.0,
                Constituent::Chlorophyll
                | Constituent::Carotenoids
                | Constituent::Anthocyanins
                | Constituent::Betacyanins
                | Constituent::Betaxanthins
                | Constituent::Brown
                | Constituent::Water
                | Constituent::DryMatter
                | Constituent::Proteins
                | Constituent::CarbonBased
                | Constituent::Extra => coefficients[lane].absorption[constituent] as f32,
            })
        });
        let stride = match held {
            Held::Uniform(_) => f32::INFINITY,
            Held::Map(map) => {
                let (width, height) = map.size();
                let texels = Vec2::new(width as f32, height as f32);
                let [x, y] = place.uv_per_m.map(|change| (change * texels).length());
                TEXELS / x.max(y).max(1e-6)
            }
        };
        let mut walk = Self {
            layers,
            held,
            place,
            index: std::array::from_fn(|layer| Lanes(rows.map(|row| row.index[layer]))),
            scattering: std::array::from_fn(|layer| {
                let most = layers.most / layers.thickness_m[layer];
                Lanes(rows.map(|row| row.scattering[layer] * most))
            }),
            g: Lanes(rows.map(|row| row.g)),
            specific,
            uniform: None,
            stride,
            layer: 0,
            depth: 0.0,
            offset: Vec2::ZERO,
            left: Lanes::ONE,
            likelihood: Likelihood::new(chance.number()),
            events,
        };
        walk.move_to_face(face);
        if let Held::Uniform(contents) = held {
            let texel = contents.to_texel();
            walk.uniform = Some(std::array::from_fn(|layer| walk.absorption(layer, &texel)));
        }
        walk
    }

    fn move_to_face(&mut self, face: usize) {
        self.layer = face * (LAYERS - 1);
        self.depth = face as f32 * self.layers.thickness_m[self.layer];
    }

    /// A face of the leaf.
    fn face(&self, face: usize) -> LeafFace<N> {
        LeafFace::new(self.index[face * (LAYERS - 1)], self.layers.alpha[face])
    }

    /// What becomes of light that comes from `wo` at a face, in the face's frame.
    pub fn cross(&mut self, face: usize, wo: &[Vec3; N], chance: &mut Chance) -> Crossed<N> {
        let face = self.face(face);
        face.cross(wo, &mut self.likelihood, || chance.number())
    }

    /// What a sampled light sees of a face that light from `wo` meets; `None` if it is smooth.
    pub fn view(&self, face: usize, wo: &[Vec3; N]) -> Option<FaceView<N>> {
        let face = self.face(face);
        (!face.is_smooth()).then(|| face.seen_from(*wo, self.likelihood))
    }

    /// Whether the walk was cut when it ended.
    pub fn is_cut(&self) -> bool {
        self.events == 0
    }

    /// How far beside its entry the light is, m along x and y.
    pub fn offset(&self) -> Vec2 {
        self.offset
    }

    /// The share of the light that is left.
    pub fn weight(&self) -> Lanes<N> {
        self.left * self.likelihood.weight()
    }

    /// Absorption of a layer with these contents, 1/m.
    fn absorption(&self, layer: usize, contents: &Texel) -> Lanes<N> {
        let mut sum = Lanes::ZERO;
        let shares = &self.layers.shares[layer];
        for (constituent, specific) in Constituent::ALL.into_iter().zip(&self.specific) {
            sum += *specific * (shares[constituent as usize] * contents[constituent]);
        }
        sum * (1.0 / self.layers.thickness_m[layer])
    }

    fn contents(&self) -> Texel {
        let [x, y] = self.place.uv_per_m;
        self.held
            .at(self.place.uv + x * self.offset.x + y * self.offset.y)
    }

    /// Goes straight on through a part of the layer's thickness, m, and leaves behind what is
    /// absorbed; the distance is that of each wavelength.
    fn advance(&mut self, heading: Vec3, deep: f32, distance: Lanes<N>) {
        let along = deep / heading.z.abs().max(LEAST_COSINE);
        let beside = Vec2::new(heading.x, heading.y);
        if let Some(uniform) = &self.uniform {
            self.absorb(uniform[self.layer], distance);
            self.offset += beside * along;
        } else {
            let steps = (along * beside.length() / self.stride)
                .ceil()
                .clamp(1.0, 1000.0);
            let (step, distance) = (along / steps, distance * (1.0 / steps));
            for _ in 0..steps as u32 {
                self.offset += beside * (0.5 * step);
                let absorption = self.absorption(self.layer, &self.contents());
                self.absorb(absorption, distance);
                self.offset += beside * (0.5 * step);
            }
        }
        self.depth += deep * if heading.z < 0.0 { 1.0 } else { -1.0 };
    }

    fn absorb(&mut self, absorption: Lanes<N>, distance: Lanes<N>) {
        self.left *= unmet(absorption, distance);
    }

    /// Follows light from the face at which it is until it meets a face again; `None` if it ends.
    pub fn to_face(&mut self, mut headings: [Vec3; N], chance: &mut Chance) -> Option<Arrival<N>> {
        let drawn = self.likelihood.drawn();
        loop {
            let greatest = self.weight().max_lane();
            if greatest <= 0.0 || self.events == 0 {
                return None;
            }
            self.events -= 1;
            if greatest < ROULETTE_BELOW {
                if chance.number() * ROULETTE_BELOW >= greatest {
                    return None;
                }
                self.left *= ROULETTE_BELOW / greatest;
            }
            let layer = self.layer;
            let thickness = self.layers.thickness_m[layer];
            let down = headings[drawn].z < 0.0;
            let deep = if down {
                thickness - self.depth
            } else {
                self.depth
            };
            let deep = deep.max(0.0);
            let scattering = self.scattering[layer];
            // Distance for each metre of depth.
            let slant = Lanes(headings.map(|heading| 1.0 / heading.z.abs().max(LEAST_COSINE)));
            let free = -libm::logf(1.0 - chance.number()) / scattering.0[drawn];
            let met = free / slant.0[drawn];
            if met < deep {
                let distance = slant * met;
                self.advance(headings[drawn], met, distance);
                // Density over depth.
                let chances = scattering * slant * unmet(scattering, distance);
                self.likelihood.happens(chances);
                if self.uniform.is_none() {
                    // Chance leaves out what scatters less here than where it does most.
                    let structure = self.contents()[Constituent::Structure];
                    let here = self.layers.more_scattering(structure) / self.layers.most;
                    if chance.number() >= here {
                        continue;
                    }
                }
                headings = self.scattered(&headings, chance);
                continue;
            }
            let distance = slant * deep;
            self.advance(headings[drawn], deep, distance);
            self.likelihood.happens(unmet(scattering, distance));
            self.depth = if down { thickness } else { 0.0 };
            let next = if down {
                layer + 1
            } else {
                layer.wrapping_sub(1)
            };
            if next >= LAYERS {
                let face = usize::from(down);
                return Some(Arrival { face, headings });
            }
            if self.refracts(&mut headings, [layer, next], chance) {
                self.layer = next;
                self.depth = if down {
                    0.0
                } else {
                    self.layers.thickness_m[next]
                };
            }
        }
    }

    /// Whether light goes on into the next layer, with its directions there; else it is reflected.
    fn refracts(
        &mut self,
        headings: &mut [Vec3; N],
        [layer, next]: [usize; 2],
        chance: &mut Chance,
    ) -> bool {
        let relative = self.index[next] / self.index[layer];
        let drawn = self.likelihood.drawn();
        let [own, cosine] = [relative.0[drawn], headings[drawn].z.abs()];
        let refracts = fresnel::refracted_cosine(cosine, own).is_some()
            && (own == 1.0 || chance.number() >= fresnel::dielectric(cosine, own));
        let mut chances = Lanes::ZERO;
        for (lane, heading) in headings.iter_mut().enumerate() {
            let (relative, cosine) = (relative.0[lane], heading.z.abs());
            let reflected = fresnel::dielectric(cosine, relative);
            chances.0[lane] = if refracts { 1.0 - reflected } else { reflected };
            if !refracts {
                heading.z = -heading.z;
            } else if let Some(refracted) = fresnel::refracted_cosine(cosine, relative) {
                let refracted = refracted.copysign(heading.z);
                let on = Vec3::new(heading.x / relative, heading.y / relative, refracted);
                *heading = on.normalize();
            }
        }
        self.likelihood.happens(chances);
        refracts
    }

    /// The direction after scattering, by Henyey and Greenstein, which is that of all wavelengths.
    fn scattered(&mut self, headings: &[Vec3; N], chance: &mut Chance) -> [Vec3; N] {
        let drawn = self.likelihood.drawn();
        let (g, x) = (self.g.0[drawn], 2.0 * chance.number() - 1.0);
        let cosine = if g.abs() < 1e-3 {
            x
        } else {
            let root = (1.0 - g * g) / (1.0 + g * x);
            ((1.0 + g * g - root * root) / (2.0 * g)).clamp(-1.0, 1.0)
        };
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let (turn_sine, turn_cosine) = libm::sincosf(std::f32::consts::TAU * chance.number());
        let heading = headings[drawn];
        let (across, along) = heading.any_orthonormal_pair();
        let to = across * (sine * turn_cosine) + along * (sine * turn_sine) + heading * cosine;
        let to = to.normalize();
        self.likelihood.happens(Lanes::from_fn(|lane| {
            let g = self.g.0[lane];
            let spread = 1.0 + g * g - 2.0 * g * headings[lane].dot(to);
            (1.0 - g * g) / (spread * spread.sqrt())
        }));
        [to; N]
    }
}

/// What of light meets nothing over a distance.
#[inline]
fn unmet<const N: usize>(coefficient: Lanes<N>, distance: Lanes<N>) -> Lanes<N> {
    Lanes::from_fn(|lane| libm::expf(-coefficient.0[lane] * distance.0[lane]))
}
