//! What a checkpoint tells of its render, and whether two are of the same one.

use std::sync::Arc;
use std::time::Duration;

use super::bytes::{Out, Rest};
use super::view;
use crate::image::light_colour::LightColour;
use crate::image::pixels::Depth;
use crate::image::tone::Tone;
use crate::integrator::caption::Caption;
use crate::integrator::effort::Effort;
use crate::integrator::render::{Begun, Job};
use crate::scene::description::{Picture, White};

/// Tones by the numbers that stand for them.
const TONES: [Tone; 4] = [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear];
use crate::spectrum::observer::{Camera, Observer};
use crate::spectrum::recorded::{Band, FilmKind};

/// The version of the program, without which bits are not promised.
pub const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// What a checkpoint tells of its render.
#[derive(Clone, Debug)]
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
#[derive(Clone, Copy, Debug)]
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

    pub(super) fn to_bytes(&self, progress: &Progress) -> Vec<u8> {
        let mut out = Out::default();
        out.text(&self.program);
        out.long(self.scene);
        for word in [self.job.width, self.job.height, self.job.spp] {
            out.word(word);
        }
        out.long(self.job.seed);
        out.flag(self.whole.is_some());
        out.word(self.whole.unwrap_or(0));
        out.flag(self.aim.is_some());
        out.double(self.aim.unwrap_or(0.0));
        let Effort {
            roulette_below,
            branches,
            lit_branches,
            light_samples,
            sample_skies,
        } = progress.effort;
        for word in [
            roulette_below.to_bits(),
            branches,
            lit_branches,
            light_samples,
        ] {
            out.word(word);
        }
        out.flag(sample_skies);
        for word in [progress.first, progress.drawn[0], progress.drawn[1]] {
            out.word(word);
        }
        out.long(progress.rays);
        out.double(progress.elapsed.as_secs_f64());
        let caption = &self.caption;
        out.text(&caption.name);
        out.text(&caption.source);
        out.long(caption.objects.len() as u64);
        for name in &caption.objects {
            out.text(name);
        }
        out.long(caption.lights.len() as u64);
        for LightColour { name, colour } in &caption.lights {
            out.text(name);
            out.doubles(colour);
        }
        match &caption.kind {
            FilmKind::Rgb { range_nm, observer } => {
                out.flag(false);
                out.doubles(range_nm);
                put_observer(observer, &mut out);
            }
            FilmKind::Spectral { bands } => {
                out.flag(true);
                out.long(bands.len() as u64);
                for band in bands {
                    out.doubles(&[band.center_nm, band.width_nm]);
                }
            }
        }
        view::put(&caption.camera, &mut out);
        let Picture {
            exposure_ev,
            auto_exposure,
            grey_object,
            white,
            white_object,
            white_light,
            tone,
            contrast,
            depth,
            alpha,
        } = &caption.picture;
        out.double(*exposure_ev);
        out.flag(*auto_exposure);
        // An object has a name, so none is an empty one.
        out.text(grey_object.as_deref().unwrap_or_default());
        out.double(match white {
            White::D65 => 0.0,
            White::Kelvin(kelvin) => *kelvin,
        });
        out.text(white_object.as_deref().unwrap_or_default());
        out.text(white_light.as_deref().unwrap_or_default());
        let number = TONES.iter().position(|known| known == tone);
        out.word(number.map_or(u32::MAX, |number| number as u32));
        out.double(*contrast);
        out.flag(*depth == Depth::Sixteen);
        out.flag(*alpha);
        out.0
    }

    pub(super) fn from_bytes(bytes: &[u8]) -> Option<(Self, Progress)> {
        let mut rest = Rest(bytes);
        let rest = &mut rest;
        let program = rest.text()?;
        let scene = rest.long()?;
        let (width, height, spp) = (rest.word()?, rest.word()?, rest.word()?);
        let seed = rest.long()?;
        let (has_whole, whole) = (rest.flag()?, rest.word()?);
        let (has_aim, aim) = (rest.flag()?, rest.double()?);
        let effort = Effort {
            roulette_below: f32::from_bits(rest.word()?),
            branches: rest.word()?,
            lit_branches: rest.word()?,
            light_samples: rest.word()?,
            sample_skies: rest.flag()?,
        };
        let (first, drawn) = (rest.word()?, [rest.word()?, rest.word()?]);
        let (rays, seconds) = (rest.long()?, rest.double()?);
        let caption = Caption {
            name: rest.text()?,
            source: rest.text()?,
            objects: rest.list(Rest::text)?,
            lights: rest.list(|rest| {
                let name = rest.text()?;
                let colour = rest.doubles()?;
                Some(LightColour { name, colour })
            })?,
            kind: if rest.flag()? {
                FilmKind::Spectral {
                    bands: rest.list(|rest| {
                        let [center_nm, width_nm] = rest.doubles()?;
                        Some(Band {
                            center_nm,
                            width_nm,
                        })
                    })?,
                }
            } else {
                FilmKind::Rgb {
                    range_nm: rest.doubles()?,
                    observer: take_observer(rest)?,
                }
            },
            camera: view::take(rest)?,
            picture: Picture {
                exposure_ev: rest.double()?,
                auto_exposure: rest.flag()?,
                grey_object: Some(rest.text()?).filter(|name| !name.is_empty()),
                white: match rest.double()? {
                    0.0 => White::D65,
                    kelvin => White::Kelvin(kelvin),
                },
                white_object: Some(rest.text()?).filter(|name| !name.is_empty()),
                white_light: Some(rest.text()?).filter(|name| !name.is_empty()),
                tone: *TONES.get(rest.word()? as usize)?,
                contrast: rest.double()?,
                depth: if rest.flag()? {
                    Depth::Sixteen
                } else {
                    Depth::Eight
                },
                alpha: rest.flag()?,
            },
        };
        let heading = Self {
            program,
            scene,
            job: Job {
                width,
                height,
                spp,
                seed,
            },
            whole: has_whole.then_some(whole),
            aim: has_aim.then_some(aim),
            caption,
        };
        let progress = Progress {
            first,
            drawn,
            effort,
            rays,
            elapsed: Duration::try_from_secs_f64(seconds).ok()?,
        };
        let is_sound = rest.0.is_empty()
            && effort.roulette_below.is_finite()
            && effort.branches > 0
            && effort.lit_branches > 0
            && effort.light_samples > 0
            && first <= spp
            && drawn[0] <= drawn[1]
            && u64::from(first) + u64::from(drawn[1]) <= u64::from(spp);
        let has_bands = match &heading.caption.kind {
            FilmKind::Rgb { range_nm, .. } => 0.0 < range_nm[0] && range_nm[0] < range_nm[1],
            FilmKind::Spectral { bands } => (1..=32).contains(&bands.len()),
        };
        (is_sound && has_bands).then_some((heading, progress))
    }
}

fn put_observer(observer: &Observer, out: &mut Out) {
    match observer {
        Observer::Cie1931 => out.flag(false),
        Observer::Camera(camera) => {
            out.flag(true);
            out.text(camera.name());
            out.long(camera.rows().len() as u64);
            for (nm, values) in camera.rows() {
                out.double(*nm);
                out.doubles(values);
            }
        }
    }
}

/// The matrix of a camera follows from its table.
fn take_observer(rest: &mut Rest<'_>) -> Option<Observer> {
    if !rest.flag()? {
        return Some(Observer::Cie1931);
    }
    let name = rest.text()?;
    let rows = rest.list(|rest| Some((rest.double()?, rest.doubles()?)))?;
    let camera = Camera::new(&name, rows).ok()?;
    Some(Observer::Camera(Arc::new(camera)))
}
