//! The bytes of a glTF file's pictures.

use std::borrow::Cow;

use gltf_json::Root;

use super::accessors::view;
use super::container::resource;
use super::{Files, ModelError};
use crate::image::ImageError;

/// A picture of the file, decoded from its bytes.
pub(super) fn picture<T>(
    root: &Root,
    number: usize,
    buffers: &[Cow<'_, [u8]>],
    files: Files<'_>,
    decode: impl FnOnce(&[u8]) -> Result<T, ImageError>,
) -> Result<T, ModelError> {
    let image = &root.images[number];
    let bytes = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => resource(uri, files, &|| format!("images[{number}]"))?,
        (None, Some(of)) => Cow::Borrowed(view(root, buffers, of.value())?),
        (None, None) => {
            let what = "has neither a uri nor a view of a buffer";
            return Err(ModelError::invalid(format!("images[{number}]"), what));
        }
    };
    decode(&bytes).map_err(|source| ModelError::Picture { number, source })
}
