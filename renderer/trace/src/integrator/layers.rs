//! The layers of a picture, declared once: name, storage and source of each.
//!
//! - **In**: the kind of film.
//! - **Out**: [`LAYERS`]; and a film's [`Layout`], which says what its pixels store and where each
//!   layer's numbers are.
//! - **Always true**: code that adds samples, merges films, develops pictures or says how many
//!   bytes a pixel takes reads this table. A test compares the book with it. A new layer is an
//!   entry here and, if it shows a new property of a hit, a [`Quantity`].
//! - **Left out**: the summation, which is in [`crate::film`].

use glam::DVec3;

use crate::camera::view::View;
use crate::film::{Film, Pixel, Series, Sum};
use crate::integrator::features::{Quantity, Sight};
use crate::spectrum::WavelengthSampler;
use crate::spectrum::recorded::{Band, FilmKind, MOST_BANDS, spectral_channel_name};
use crate::spectrum::rgb::LUMINANCE;

/// One layer: channels of a picture that belong together.
#[derive(Clone, Copy, Debug)]
pub struct FilmLayer {
    /// Prefix of the channels' names, followed by a dot; empty for the picture itself.
    pub name: &'static str,
    /// Its channels.
    pub channels: Channels,
    /// Films that have it.
    pub films: Films,
    /// Its source.
    pub source: Source,
    /// Its description, for the book.
    pub about: &'static str,
}

/// The channels of a layer.
#[derive(Clone, Copy, Debug)]
pub enum Channels {
    /// One for each channel of the film: `R`, `G`, `B` or the bands.
    OfFilm,
    /// These.
    Named(&'static [&'static str]),
}

/// Films that have a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Films {
    /// All.
    All,
    /// Those of colour.
    Colour,
    /// Those of bands.
    Spectral,
}

impl Films {
    /// Whether a film of colour, or one of bands, is among them.
    const fn has(self, colour: bool) -> bool {
        match self {
            Self::All => true,
            Self::Colour => colour,
            Self::Spectral => !colour,
        }
    }
}

/// The source of a layer: what pixels store for it, and how it is developed.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// The film's own channels.
    Radiance(fn(&Pixel<'_>, usize) -> f64),
    /// The variance of the mean of a channel, or of luminance.
    Variance(fn(usize) -> Series),
    /// What every pixel counts.
    Pixel(fn(&Pixel<'_>) -> f64),
    /// Its own features, one per channel; 0 where nothing is covered.
    Feature {
        /// The quantity; the layer uses as many of its numbers as it has channels.
        quantity: Quantity,
        /// How a pixel keeps it.
        sum: Sum,
        /// Least and greatest value in the picture.
        within: [f64; 2],
    },
    /// A function of the camera and the mean of another layer of three features; 0 where nothing is
    /// covered.
    OfPoint {
        /// Name of the other layer, whose films have this one.
        layer: &'static str,
        /// The function of its three means.
        by: fn(DVec3, &View) -> f64,
    },
}

const XYZ: Channels = Channels::Named(&["X", "Y", "Z"]);
const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Every layer that a picture may have.
pub const LAYERS: &[FilmLayer] = &[
    FilmLayer {
        name: "",
        channels: Channels::OfFilm,
        films: Films::All,
        source: Source::Radiance(mean),
        about: "mean radiance",
    },
    FilmLayer {
        name: "variance",
        channels: Channels::OfFilm,
        films: Films::All,
        source: Source::Variance(Series::Channel),
        about: "variance of the mean radiance, by batches of 16 samples and by halves; of fewer than 16 samples an upper estimate, as if they were independent",
    },
    FilmLayer {
        name: "variance",
        channels: Channels::Named(&["Y"]),
        films: Films::All,
        source: Source::Variance(|_| Series::Luminance),
        about: "variance of the mean luminance, of bands that of their mean, by batches of 16 samples and by halves",
    },
    FilmLayer {
        name: "",
        channels: Channels::Named(&["A"]),
        films: Films::All,
        source: Source::Pixel(alpha),
        about: "share of the samples that met something",
    },
    FilmLayer {
        name: "P",
        channels: XYZ,
        films: Films::All,
        source: Source::Feature {
            quantity: Quantity::Position,
            sum: Sum::Wide { fraction_bits: 24 },
            within: ANY,
        },
        about: "position of what was met first, m",
    },
    FilmLayer {
        name: "N",
        channels: XYZ,
        films: Films::All,
        source: Source::Feature {
            quantity: Quantity::Normal,
            sum: Sum::Narrow { fraction_bits: 22 },
            within: ANY,
        },
        about: "normal of what was met first, on the side of the camera",
    },
    FilmLayer {
        name: "albedo",
        channels: Channels::Named(&["R", "G", "B"]),
        films: Films::Colour,
        source: Source::Feature {
            quantity: Quantity::Albedo,
            sum: Sum::Narrow { fraction_bits: 20 },
            within: [0.0, 1.0],
        },
        about: "albedo of what was met first, linear sRGB",
    },
    FilmLayer {
        name: "albedo",
        channels: Channels::Named(&["Y"]),
        films: Films::Spectral,
        source: Source::Feature {
            quantity: Quantity::MeanAlbedo,
            sum: Sum::Narrow { fraction_bits: 20 },
            within: [0.0, 1.0],
        },
        about: "mean albedo over the bands of what was met first",
    },
    FilmLayer {
        name: "depth",
        channels: Channels::Named(&["Z"]),
        films: Films::All,
        source: Source::OfPoint {
            layer: "P",
            // The points that a pixel sees lie along one line except for its width and the blur of
            // the lens, so this is nearly the mean distance.
            by: |point, camera| camera.distance_of(point),
        },
        about: "distance of the mean position from the middle of the lens, m; along parallel rays, from the plane through the camera",
    },
    FilmLayer {
        name: "samples",
        channels: Channels::Named(&["Y"]),
        films: Films::All,
        source: Source::Pixel(|pixel| f64::from(pixel.samples())),
        about: "number of samples",
    },
    FilmLayer {
        name: "id",
        channels: Channels::Named(&["object"]),
        films: Films::All,
        source: Source::Feature {
            quantity: Quantity::Object,
            sum: Sum::First,
            within: ANY,
        },
        about: "number of the object that the pixel's first sample met, 0 for none; the attribute `lamina:objects` names them",
    },
];

fn mean(pixel: &Pixel<'_>, channel: usize) -> f64 {
    pixel.mean(channel)
}

fn alpha(pixel: &Pixel<'_>) -> f64 {
    pixel.alpha()
}

/// Greatest number of channels of a film.
pub const MOST_CHANNELS: usize = MOST_BANDS;

/// Greatest number of features of a sample.
pub const MOST_FEATURES: usize = {
    let mut count = 0;
    let mut row = 0;
    while row < LAYERS.len() {
        count += LAYERS[row].features();
        row += 1;
    }
    count
};

impl FilmLayer {
    /// Number of features that a pixel stores for it.
    const fn features(&self) -> usize {
        match (&self.source, self.channels) {
            (Source::Feature { .. }, Channels::Named(names)) => {
                assert!(names.len() <= 3, "a quantity has at most three numbers");
                names.len()
            }
            (Source::Feature { .. }, Channels::OfFilm) => {
                panic!("a feature's channels do not depend on the film")
            }
            (
                Source::Radiance(_)
                | Source::Variance(_)
                | Source::Pixel(_)
                | Source::OfPoint { .. },
                _,
            ) => 0,
        }
    }

    /// Full names of its channels on a film of this kind.
    pub fn channel_names(&self, kind: &FilmKind) -> Vec<String> {
        let of_bands = |bands: &[Band]| {
            let names = bands
                .iter()
                .map(|band| spectral_channel_name(band.center_nm));
            names.collect()
        };
        let own: Vec<String> = match (self.channels, kind) {
            (Channels::Named(names), _) => names.iter().map(ToString::to_string).collect(),
            (Channels::OfFilm, FilmKind::Rgb { .. }) => ["R", "G", "B"].map(str::to_owned).into(),
            (Channels::OfFilm, FilmKind::Spectral { bands }) => of_bands(bands),
            (Channels::OfFilm, FilmKind::Sensor(sensor)) => of_bands(&sensor.boxes()),
        };
        let whole = |own: String| match self.name {
            "" => own,
            name => format!("{name}.{own}"),
        };
        own.into_iter().map(whole).collect()
    }
}

/// The layout of a film's records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Number of channels: R, G, B or the bands.
    pub beauty: usize,
    /// Whether they are R, G, B.
    pub colour: bool,
}

impl Layout {
    /// The layout of a film with these wavelengths.
    pub fn new(wavelengths: &WavelengthSampler) -> Self {
        Self {
            beauty: wavelengths.channels(),
            colour: wavelengths.is_rgb(),
        }
    }

    /// The layers of its pictures.
    #[inline]
    pub fn layers(self) -> impl Iterator<Item = &'static FilmLayer> {
        LAYERS
            .iter()
            .filter(move |layer| layer.films.has(self.colour))
    }

    /// How a film keeps its features.
    pub fn sums(self) -> Vec<Sum> {
        let of = |layer: &FilmLayer| match layer.source {
            Source::Feature { sum, .. } => vec![sum; layer.features()],
            Source::Radiance(_)
            | Source::Variance(_)
            | Source::Pixel(_)
            | Source::OfPoint { .. } => Vec::new(),
        };
        self.layers().flat_map(of).collect()
    }

    /// The share of each channel in luminance; bands have equal ones.
    pub fn luminance(self) -> Vec<f32> {
        if self.colour {
            LUMINANCE.map(|share| share as f32).to_vec()
        } else {
            vec![1.0 / self.beauty as f32; self.beauty]
        }
    }

    /// Memory of a pixel, bytes.
    pub fn bytes_per_pixel(self) -> usize {
        Film::bytes_per_pixel(self.beauty, &self.sums())
    }

    /// Number of a layer's first feature; `None` if it has no features or the film has no such
    /// layer.
    pub fn first_feature(self, name: &str) -> Option<usize> {
        let mut first = 0;
        for layer in self.layers() {
            if layer.name == name && layer.features() > 0 {
                return Some(first);
            }
            first += layer.features();
        }
        None
    }

    /// The features of a sample that hit something.
    #[inline]
    pub fn features<const N: usize>(self, sight: &Sight<'_, N>) -> Features {
        // Apart, so that what is recorded is known where each loop is compiled.
        if self.colour {
            OF_COLOUR.of(sight)
        } else {
            OF_BANDS.of(sight)
        }
    }
}

/// What the films of a kind record of a hit: quantities, with the number of features of each.
struct Recorded {
    quantities: [(Quantity, usize); LAYERS.len()],
    count: usize,
}

const OF_COLOUR: Recorded = Recorded::new(true);
const OF_BANDS: Recorded = Recorded::new(false);

impl Recorded {
    /// By films of colour or by those of bands.
    const fn new(colour: bool) -> Self {
        let mut quantities = [(Quantity::Object, 0); LAYERS.len()];
        let (mut count, mut row) = (0, 0);
        while row < LAYERS.len() {
            let layer = &LAYERS[row];
            if let (Source::Feature { quantity, .. }, true) =
                (&layer.source, layer.films.has(colour))
            {
                quantities[count] = (*quantity, layer.features());
                count += 1;
            }
            row += 1;
        }
        Self { quantities, count }
    }

    #[inline(always)]
    fn of<const N: usize>(&self, sight: &Sight<'_, N>) -> Features {
        let mut features = [0.0; MOST_FEATURES + 2];
        let mut first = 0;
        for &(quantity, count) in &self.quantities[..self.count] {
            // Numbers of a quantity beyond the layer's channels are overwritten by the next one.
            features[first..first + 3].copy_from_slice(&quantity.of(sight));
            first += count;
        }
        features
    }
}

/// Features of a sample, with room for numbers of the last quantity beyond its layer's channels.
pub type Features = [f32; MOST_FEATURES + 2];

#[cfg(test)]
mod tests;
