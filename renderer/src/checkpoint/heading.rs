//! What a checkpoint tells of its render, and whether two are of the same one.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::codec;
use crate::integrator::caption::Caption;
use crate::integrator::effort::Effort;
use crate::integrator::render::{Begun, Job};
use crate::spectrum::recorded::{Band, FilmKind, MOST_BANDS};

/// The version of the program, without which bits are not promised.
pub const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// What a checkpoint tells of its render.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Heading {
    /// Version of the program that wrote it.
    pub program: String,
    /// [Fingerprint](crate::scene::fingerprint) of the scene.
    pub scene: u64,
    /// Size and seed; `spp` is the number of the sample at which the render ends.
    pub job: Job,
    /// Number of samples of the whole picture if it is known; more than `job.spp` for a part.
    pub whole: Option<u32>,
    /// Target noise.
    pub aim: Option<f64>,
    /// What a picture of the sums tells of its scene.
    pub caption: Caption,
}

/// What else the file has before the sums.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) struct Progress {
    pub(super) first: u32,
    /// Fewest and most samples of a pixel.
    pub(super) drawn: [u32; 2],
    pub(super) effort: Effort,
    pub(super) rays: u64,
    pub(super) elapsed: Duration,
}

impl Progress {
    pub(super) fn of(begun: &Begun) -> Self {
        Self {
            first: begun.first,
            drawn: begun.film.drawn_range(),
            effort: begun.effort,
            rays: begun.rays,
            elapsed: begun.elapsed,
        }
    }
}

impl Heading {
    /// How another render differs, in words: "what is there, not what is wanted". `None` if samples
    /// of both add up to one picture.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let size = |heading: &Self| (heading.job.width, heading.job.height);
        if self.program != other.program {
            let (own, other) = (&self.program, &other.program);
            return Some(format!("written by version {own} of Lamina, not {other}"));
        }
        if self.caption.name != other.caption.name {
            let (own, other) = (&self.caption.name, &other.caption.name);
            return Some(format!("of the scene {own}, not {other}"));
        }
        if size(self) != size(other) {
            let ((width, height), (other_width, other_height)) = (size(self), size(other));
            return Some(format!(
                "of {width} × {height} pixels, not {other_width} × {other_height}"
            ));
        }
        if self.scene != other.scene {
            let name = &self.caption.name;
            return Some(format!(
                "of another state of the scene {name}: the file, an override or a file that it names has changed"
            ));
        }
        if self.job.seed != other.job.seed {
            return Some(format!(
                "of the seed {}, not {}",
                self.job.seed, other.job.seed
            ));
        }
        if self.aim != other.aim {
            let words = |aim: Option<f64>| aim.map_or("none".to_owned(), |aim| aim.to_string());
            let (own, other) = (words(self.aim), words(other.aim));
            return Some(format!("of the target noise {own}, not {other}"));
        }
        None
    }

    /// The bytes of a heading and of the progress beside it.
    pub(super) fn to_bytes(&self, progress: &Progress) -> Vec<u8> {
        codec::to_bytes(&(self, progress))
    }

    /// What [`Heading::to_bytes`] has written; `None` if these bytes are something else or impossible.
    pub(super) fn from_bytes(bytes: &[u8]) -> Option<(Self, Progress)> {
        let (heading, progress): (Self, Progress) = codec::from_bytes(bytes)?;
        let Progress {
            first,
            drawn,
            effort,
            ..
        } = progress;
        let spp = heading.job.spp;
        let is_sound = heading.aim.is_none_or(f64::is_finite)
            && effort.roulette_below.is_finite()
            && effort.branches > 0
            && effort.lit_branches > 0
            && effort.light_samples > 0
            && first <= spp
            && drawn[0] <= drawn[1]
            && u64::from(first) + u64::from(drawn[1]) <= u64::from(spp);
        let has_bands = match &heading.caption.kind {
            FilmKind::Rgb { range_nm, .. } => {
                0.0 < range_nm[0] && range_nm[0] < range_nm[1] && range_nm[1].is_finite()
            }
            FilmKind::Spectral { bands } => {
                let is_finite =
                    |band: &Band| band.center_nm.is_finite() && band.width_nm.is_finite();
                (1..=MOST_BANDS).contains(&bands.len()) && bands.iter().all(is_finite)
            }
            FilmKind::Sensor(sensor) => sensor.bands().len() <= MOST_BANDS,
        };
        (is_sound && has_bands).then_some((heading, progress))
    }
}
