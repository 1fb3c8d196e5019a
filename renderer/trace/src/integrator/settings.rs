//! The size of a picture, and how light is followed.

use document::declared::{Declared, Defaults};
use serde::{Deserialize, Serialize};

use crate::sampling::dimensions::MOST_EVENTS;

/// How light is followed.
///
/// Where a number is `None`, there is no limit, or a trial decides.
#[derive(Clone, Copy, Debug, Declared, Defaults)]
pub struct Integrator {
    /// Most scattering events of a path. A limit darkens the picture: in the infrared, where leaves
    /// hardly absorb, a limit of 8 loses some 2 %. How many paths it cuts is reported.
    #[key("max_depth", 1..=100_000)]
    pub max_depth: Option<u32>,
    /// Events after which a path is cut, in pictures and in instruments: scatterings, flights through
    /// media, and ways between scatterings in a leaf of layers. It is for light that is caught. How many
    /// paths were cut is reported, and how much light that may lose.
    ///
    /// Roulette ends paths long before, unless light is caught in what absorbs nothing, as in a medium so
    /// dense that its free paths are below the precision of places.
    #[key("max_events", 1..=u64::from(MOST_EVENTS), default = 100_000)]
    pub max_events: u32,
    /// Paths of whose light less than this share can reach the film may end by Russian roulette, without
    /// bias; 0 switches it off. On a film of colour the share is what the eye sees, on bands their mean,
    /// at least a quarter of the brightest. Higher is faster and noisier.
    #[key("roulette_below", 0.0..=1.0)]
    pub roulette_below: Option<f64>,
    /// Paths that go on from what the camera sees first, where none of the lights that are sampled
    /// (suns, lamps, sky pictures) reaches it. More is slower and less noisy, in shade.
    #[key("branches", 1..=64)]
    pub branches: Option<u32>,
    /// Paths that go on from there where such a light reaches it. More is slower and less noisy, above
    /// all close to leaves in the sun.
    #[key("lit_branches", 1..=64)]
    pub lit_branches: Option<u32>,
    /// Samples of lamps and sky pictures at what the camera sees first; suns have one each. More is
    /// slower and less noisy where lamps cast soft shadows.
    #[key("light_samples", 1..=64)]
    pub light_samples: Option<u32>,
    /// Whether skies and environment pictures are sampled as lamps are; if not, paths find them where
    /// they leave the scene. Without is faster, and noisier where little of a sky sends much of its
    /// light.
    #[key("sample_skies")]
    pub sample_skies: Option<bool>,
    /// Whether the camera looks through all lights: sky and sun are black with an alpha of 0, and it
    /// does not see objects that shine. They light everything else, and are seen in mirrors and through
    /// glass. The colours are then those of the foreground, multiplied by alpha.
    #[key("hide_lights")]
    pub hide_lights: bool,
}

/// The size, samples and seed of a picture.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub struct Job {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel; for a part of a picture the number behind its last sample.
    pub spp: u32,
    /// Seed of every random number.
    pub seed: u64,
}
