//! Lamina: a spectral path tracer for leaves and leaf scenes.
//!
//! Lengths are metres, wavelengths nanometres, radiance W m⁻² sr⁻¹ nm⁻¹, transport in `f32`.

pub mod bsdf;
pub mod camera;
pub mod cli;
pub mod export;
pub mod film;
pub mod geometry;
pub mod image;
pub mod integrator;
pub mod light;
pub mod material;
pub mod sampling;
pub mod scene;
pub mod simd;
pub mod spectrum;
