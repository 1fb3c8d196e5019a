//! Errors of glTF files.

use thiserror::Error;

use crate::image::ImageError;

/// Why there is no file.
#[derive(Debug, Error)]
pub enum GltfError {
    /// More bytes than the numbers of a `.glb` file hold.
    #[error(
        "the file would have {0} bytes, and a .glb file has 4294967295 at most: ask for smaller textures \
         or fewer triangles"
    )]
    TooLarge(usize),
    /// A texture cannot be made.
    #[error(transparent)]
    Image(#[from] ImageError),
}
