//! Random numbers and sampling.
//!
//! A random number is a function of (seed, pixel, sample, dimension): there is no generator state,
//! so pictures do not depend on threads, tiles or interruptions.
//!
//! ```
//! use glam::Vec2;
//! use trace::sampling::stream::Stream;
//! use trace::sampling::warp;
//!
//! // Sample 7 of pixel (12, 3): four numbers, then the next four, the same whenever they are asked for.
//! let mut stream = Stream::new(1, 12, 3, 7);
//! let [u, v, ..] = stream.next4();
//! assert_eq!(Stream::new(1, 12, 3, 7).next4()[..2], [u, v]);
//! let direction = warp::cosine_hemisphere(Vec2::new(u, v));
//! assert!(direction.z >= 0.0 && (direction.length() - 1.0).abs() < 1e-6);
//! ```

pub mod beta;
pub mod dimensions;
pub mod distribution;
pub(crate) mod mixer;
pub mod stream;
pub mod warp;
