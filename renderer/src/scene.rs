//! From a scene file to the immutable scene that is traced.

pub mod description;
