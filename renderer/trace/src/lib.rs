//! What rays of light need: spectra, scattering, lights, geometry, films.
//!
//! - **Knows**: surfaces, media, lights and cameras in one frame, in `f32` and metres; wavelengths in
//!   nanometres; radiance in W m⁻² sr⁻¹ nm⁻¹.
//! - **Must not know**: scenes as files, growth, pictures as files, commands. What a file may set of a shape, a
//!   lens or a path is declared at its struct.
//! - **Always true**: the same numbers on every machine and any number of threads.

pub mod bsdf;
pub mod camera;
pub mod film;
pub mod geometry;
pub mod integrator;
pub mod light;
pub mod material;
pub mod medium;
pub mod sampling;
pub mod simd;
pub mod spectrum;
pub mod walk;
pub mod world;
