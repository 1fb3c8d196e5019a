//! `[film.rgb]` and `[film.spectral]`.

mod named;
mod sensitivities;
mod sensor;

use std::sync::Arc;

use leafmodel::document::context::Context;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::limits::Limits;
use leafmodel::document::number_lists::Rising;
use leafmodel::document::schema::Type;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::{Kind, Number};
use leafmodel::document::values::{integers_at, list, number, numbers_at};
use leafmodel::document::{Keys, Variant};

use self::named::NameOrFile;
use self::sensitivities::{LEAST_SHARE, Sensitivities};
use crate::film::MOST_SAMPLES;
use crate::spectrum::cie;
use crate::spectrum::observer::Observer;
use crate::spectrum::recorded::{Band, FilmKind, MOST_BANDS};

/// Range of wavelengths of the renderer, nm.
pub(in crate::scene) const WAVELENGTHS_NM: Limits = Limits::closed(360.0, 2500.0);
/// Most pixels along one side; both sides at most give 2^28 pixels.
const MOST_PIXELS: u64 = 16384;

/// What is recorded, and how well.
#[derive(Clone, Debug, Declared)]
pub struct Film {
    /// Pixels across.
    #[key(with = Self::declare_size)]
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel; with `noise` the most.
    #[key("spp", required, 1..=MOST_SAMPLES.into())]
    pub spp: u32,
    /// Relative error at which a part of the picture has enough samples; `None` if all parts get
    /// the same number.
    #[key(with = Self::declare_noise)]
    pub noise: Option<f64>,
    /// Seed of every random number; same file, same seed, same bytes.
    #[key("seed")]
    pub seed: u64,
    /// Radius of the Gaussian reconstruction filter; 0 is a box of one pixel, which keeps pixels
    /// independent of each other.
    ///
    /// In pixels.
    #[key("filter_radius_px", 0.0..=8.0)]
    pub filter_radius: f64,
    /// Colour or bands.
    pub kind: FilmKind,
}

const KINDS: [Variant<Film>; 2] = [
    Variant {
        name: "rgb",
        about: "Colour.",
        new: || Film {
            filter_radius: 1.5,
            ..Film::usual()
        },
        is: |film| matches!(film.kind, FilmKind::Rgb { .. }),
        declare: |film, keys| {
            film.declare(keys);
            if let FilmKind::Rgb { range_nm, observer } = &mut film.kind {
                let about = "Wavelengths that paths carry, first and last. The default is where \
                    PROSPECT-D has data and the observer sees nearly everything.";
                keys.key("range_nm", range_nm, Range, about);
                let about = "What sees the light: the CIE's observer, a camera by name, or a table \
                    of a camera's sensitivities to red, green and blue by wavelength in nm.";
                let kind = Sensitivities {
                    range_nm: *range_nm,
                };
                keys.key("sensitivities", observer, NameOrFile(kind), about);
                warn_of_unseen(*range_nm, observer, keys);
            }
            set_range(film, keys);
        },
    },
    Variant {
        name: "spectral",
        about: "Mean radiance in bands of wavelengths.",
        new: || Film {
            filter_radius: 0.0,
            kind: FilmKind::Spectral { bands: Vec::new() },
            ..Film::usual()
        },
        is: |film| matches!(film.kind, FilmKind::Spectral { .. } | FilmKind::Sensor(_)),
        declare: |film, keys| {
            film.declare(keys);
            film.declare_bands(keys);
            set_range(film, keys);
        },
    },
];

impl Film {
    /// A film with all defaults.
    pub(in crate::scene) fn usual() -> Self {
        Self {
            width: 1,
            height: 1,
            spp: 1,
            noise: None,
            seed: 0,
            filter_radius: 1.5,
            kind: FilmKind::Rgb {
                range_nm: [400.0, 780.0],
                observer: Observer::Cie1931,
            },
        }
    }

    fn declare_size(&mut self, keys: &mut Keys<'_>) {
        let mut size = [self.width, self.height];
        keys.required("size", &mut size, PixelSize, "Pixels across and down.");
        [self.width, self.height] = size;
    }

    fn declare_noise(&mut self, keys: &mut Keys<'_>) {
        let mut noise = self.noise.unwrap_or(0.0);
        let limits = Number(Limits::closed(0.0, 1.0));
        let about = "Relative error at which a part of the picture has enough samples: 0.01 is one \
            percent (adaptive sampling); 0 gives every pixel `spp` samples.";
        keys.key("noise", &mut noise, limits, about);
        self.noise = (noise > 0.0).then_some(noise);
    }
}

impl Film {
    /// The bands: boxes, or those of a sensor.
    fn declare_bands(&mut self, keys: &mut Keys<'_>) {
        let (mut bands, mut sensor) = match &self.kind {
            FilmKind::Sensor(sensor) => (Vec::new(), Some(Arc::clone(sensor))),
            FilmKind::Spectral { bands } => (bands.clone(), None),
            FilmKind::Rgb { .. } => return,
        };
        let current = if sensor.is_some() {
            "sensor"
        } else {
            "bands_nm"
        };
        for chosen in keys.one_of(&["bands_nm", "sensor"], Some(current)) {
            if chosen == "sensor" {
                let about = "A sensor, by whose responses its bands are recorded: one by name, or a \
                    table of wavelength in nm and a column of relative responses for each band.";
                keys.optional(
                    "sensor",
                    &mut sensor,
                    NameOrFile(sensor::OfFilm(WAVELENGTHS_NM)),
                    about,
                );
                if let Some(sensor) = &sensor {
                    self.kind = FilmKind::Sensor(Arc::clone(sensor));
                }
            } else {
                let mut width_nm = bands.first().map_or(10.0, |band| band.width_nm);
                let limits = Number(Limits::closed(0.0, 200.0));
                let about = "Full width of every band of `bands_nm`; 0 is a single wavelength.";
                keys.key("band_width_nm", &mut width_nm, limits, about);
                let about = "Middles of the bands. The whole band must lie within 360 to 2500 \
                    nm.";
                keys.needed("bands_nm", &mut bands, Bands { width_nm }, about);
                self.kind = FilmKind::Spectral {
                    bands: std::mem::take(&mut bands),
                };
            }
        }
    }
}

/// The keys of `[film]`.
pub(in crate::scene) fn film(film: &mut Film, keys: &mut Keys<'_>) {
    keys.kind(film, &KINDS);
}

/// Sets the wavelengths that the film needs, for all blocks read after it.
fn set_range(film: &Film, keys: &Keys<'_>) {
    let Some(block) = keys.reader() else {
        return;
    };
    let range = match &film.kind {
        FilmKind::Rgb { range_nm, .. } => Some(*range_nm),
        FilmKind::Sensor(sensor) => Some(sensor.range_nm()),
        FilmKind::Spectral { bands } if bands.is_empty() => None,
        FilmKind::Spectral { bands } => {
            let ends = bands.iter().map(|band| {
                let half = band.width_nm / 2.0;
                [band.center_nm - half, band.center_nm + half]
            });
            ends.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)])
        }
    };
    block.cx.range_nm.set(range);
}

/// Warns of a film that leaves out much of what the eye sees.
fn warn_of_unseen(range_nm: [f64; 2], observer: &Observer, keys: &Keys<'_>) {
    let given = keys
        .reader()
        .and_then(|block| Some((block.cx, block.node("range_nm")?)));
    let (Some((cx, node)), Observer::Cie1931) = (given, observer) else {
        return;
    };
    let [low, high] = range_nm;
    let [_, seen, _] = cie::xyz_of(|nm| if (low..=high).contains(&nm) { 1.0 } else { 0.0 });
    if seen < LEAST_SHARE {
        let message = format!(
            "`range_nm` leaves out {:.0} % of the light that the eye sees: colours are not those of the scene",
            100.0 * (1.0 - seen)
        );
        let help = "widen it; a picture in the infrared or ultraviolet needs `[film.spectral]`, which is shown as grey";
        cx.warn(&node.at, "scene::range", message, help);
    }
}

/// Pixels across and down.
#[derive(Clone, Copy, Debug)]
struct PixelSize;

impl Kind for PixelSize {
    type Of = [u32; 2];

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<[u32; 2]> {
        let size = integers_at::<2>(cx, node, key, 1, MOST_PIXELS)?;
        Some(size.map(|pixels| pixels as u32))
    }

    fn write(&self, value: &[u32; 2]) -> Value {
        list(value.map(|pixels| Value::Integer(pixels.into())))
    }

    fn describe(&self) -> Type {
        let pixels = Type::Integer {
            least: 1,
            most: MOST_PIXELS,
        };
        let list = Type::Tuple(vec![pixels; 2]);
        Type::AnyOf(vec![list], "pixels across and down, as in [640, 480]")
    }
}

/// Two wavelengths, the first below the second.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Range;

impl Kind for Range {
    type Of = [f64; 2];

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<[f64; 2]> {
        let range: [f64; 2] = numbers_at(cx, node, key, WAVELENGTHS_NM)?;
        if range[0] < range[1] {
            return Some(range);
        }
        let error = DocumentError::NotRising {
            key: key.to_owned(),
            before: range[0],
            after: range[1],
        };
        cx.error(&node.at, error);
        None
    }

    fn write(&self, value: &[f64; 2]) -> Value {
        list(value.map(number))
    }

    fn describe(&self) -> Type {
        Type::Tuple(vec![Type::Number(WAVELENGTHS_NM); 2])
    }
}

/// Centres of bands, rising; each whole band must lie within the range of the data.
#[derive(Clone, Copy, Debug)]
struct Bands {
    width_nm: f64,
}

impl Bands {
    const WANTED: &str = "a list of 1 to 1024 numbers";

    fn limits(self) -> Limits {
        let [(low, _), (high, _)] = WAVELENGTHS_NM.ends();
        Limits::closed(low + self.width_nm / 2.0, high - self.width_nm / 2.0)
    }
}

impl Kind for Bands {
    type Of = Vec<Band>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<Band>> {
        let kind = Rising {
            limits: self.limits(),
            most: MOST_BANDS,
            wanted: Self::WANTED,
        };
        let width_nm = self.width_nm;
        let bands = kind.read(cx, node, key)?.into_iter();
        let bands = bands.map(|center_nm| Band {
            center_nm,
            width_nm,
        });
        Some(bands.collect())
    }

    fn write(&self, bands: &Vec<Band>) -> Value {
        list(bands.iter().map(|band| number(band.center_nm)))
    }

    fn describe(&self) -> Type {
        Type::List {
            of: Box::new(Type::Number(WAVELENGTHS_NM)),
            least: 1,
            most: MOST_BANDS,
            wanted: "the middles of 1 to 1024 bands, rising",
        }
    }
}
