//! The pictures of a glTF file.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use gltf_json::Root;

use super::accessors::view;
use super::container::{Files, resource};
use super::error::ModelError;
use super::textures::Texture;
use crate::image::{ImageError, Picture, Stored, jpeg, portable_network};
use crate::material::colour_map::{ColourTexture, Wrap};

/// The pictures of a file, and those that were decoded as textures.
pub(super) struct Pictures<'a, 'f> {
    pub(super) root: &'a Root,
    buffers: &'a [Cow<'a, [u8]>],
    files: Files<'f>,
    known: BTreeMap<(usize, [&'static str; 2], Stored), Arc<ColourTexture>>,
}

impl<'a, 'f> Pictures<'a, 'f> {
    pub(super) fn new(root: &'a Root, buffers: &'a [Cow<'a, [u8]>], files: Files<'f>) -> Self {
        Self {
            root,
            buffers,
            files,
            known: BTreeMap::new(),
        }
    }

    /// A picture, decoded from its bytes.
    pub(super) fn decode<T>(
        &self,
        number: usize,
        decode: impl FnOnce(&[u8]) -> Result<T, ImageError>,
    ) -> Result<T, ModelError> {
        let image = &self.root.images[number];
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => resource(uri, self.files, &|| format!("images[{number}]"))?,
            (None, Some(of)) => Cow::Borrowed(view(self.root, self.buffers, of.value())?),
            (None, None) => {
                let what = "has neither a uri nor a view of a buffer";
                return Err(ModelError::invalid(format!("images[{number}]"), what));
            }
        };
        decode(&bytes).map_err(|source| ModelError::Picture { number, source })
    }

    /// A texture whose values mean this; what several materials have is decoded once.
    pub(super) fn texture(
        &mut self,
        texture: Texture,
        stored: Stored,
    ) -> Result<Arc<ColourTexture>, ModelError> {
        let (wrap, number) = texture.source(self.root);
        let key = (number, wrap.map(Wrap::word), stored);
        if !self.known.contains_key(&key) {
            let picture = self.decode(number, |bytes| decoded(bytes, stored))?;
            self.known.insert(key, Arc::new(texture_of(&picture, wrap)));
        }
        Ok(Arc::clone(&self.known[&key]))
    }
}

fn texture_of(picture: &Picture, wrap: [Wrap; 2]) -> ColourTexture {
    let channel = |name| picture.layer(name).expect("what is decoded has R, G and B");
    let [r, g, b] = ["R", "G", "B"].map(|name| channel(name).data.iter().copied());
    let texels = r.zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect();
    ColourTexture::new(picture.width as usize, texels, wrap)
}

/// Three channels of a picture; its first bytes say which format it has. The format of models demands
/// that what a picture says of its colours is ignored.
fn decoded(bytes: &[u8], stored: Stored) -> Result<Picture, ImageError> {
    if bytes.starts_with(b"\x89PNG") {
        portable_network::decode_as(bytes, stored)
    } else if bytes.starts_with(b"\xff\xd8") {
        jpeg::decode_as(bytes, stored)
    } else {
        Err(ImageError::malformed("it is neither PNG nor JPEG"))
    }
}
