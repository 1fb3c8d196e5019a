//! Pictures and their files: `OpenEXR` for data, PNG and JPEG for looking at; Radiance HDR is read.
//!
//! [`colours`] is the one reader of pictures that emit light or are textures.
//!
//! - **In**: [`Picture`]s, layers of `f32` with names and attributes; or untrusted bytes.
//! - **Out**: complete files, with the same bytes for the same picture; or a [`Picture`].
//! - **Always true**: a file is replaced by renaming a finished one, so a failure leaves the old
//!   one. A header that claims more than 2²⁸ pixels or 4 GiB is refused before anything is
//!   allocated for it.
//! - **Left out**: deep data, mip levels (the largest is read).
//!
//! ```
//! use renderer::image::{Attribute, Layer, Picture, compare, openexr};
//!
//! let mut picture = Picture::new([2, 1], [Layer::new("Y", vec![0.25, 4.0])]);
//! picture.attributes.push(("comments".to_owned(), Attribute::Text("two pixels".to_owned())));
//! let bytes = openexr::encode(&picture)?;
//! let again = openexr::decode(&bytes)?;
//! assert_eq!(again.layer("Y"), picture.layer("Y"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod animation;
pub mod atomic;
pub mod card;
pub mod claimed;
pub mod colours;
pub mod compare;
pub mod display;
mod encoding;
mod error;
pub mod jpeg;
pub mod light_colour;
pub mod openexr;
mod picture;
pub mod pixels;
pub mod portable_network;
mod primaries;
pub mod radiance;
pub mod scan;
pub mod tone;
pub mod white;

pub use compare::{ChannelComparison, Comparison, compare};
pub use encoding::Stored;
pub use error::{ImageError, MOST_BYTES, MOST_PIXELS, MOST_TEXTURE_BYTES};
pub use picture::{Attribute, LUMINANCE, Layer, Picture, REC709, luminance};
