//! Colours of vertices as pictures, so that a material looks all colours up by texture coordinates.
//!
//! Each triangle has a square of two by two texels, with the colours of its corners in three of
//! them. Between these three middles bilinear interpolation is linear, as it should be on a
//! triangle.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::Vec2;
use gltf_json::Root;

use super::surfaces::Patch;
use super::textures::texture;
use crate::material::colour_map::{ColourTexture, Wrap};

/// Most squares side by side. Texture coordinates are moved along u, where they lose digits.
const MOST_ACROSS: usize = 16;

/// Gives each part that has colours of its vertices and no picture a picture of them.
pub(super) fn paint(root: &Root, patches: &mut [Patch], left_out: &mut BTreeSet<String>) {
    for patch in patches {
        let Some(colours) = patch.colours.take().filter(|_| !patch.triangles.is_empty()) else {
            continue;
        };
        if patch.uvs.is_some() && texture(root, patch.material).is_some() {
            left_out.insert("colours of vertices of parts that have a picture too".to_owned());
            continue;
        }
        let count = patch.triangles.len();
        let across = count.min(MOST_ACROSS);
        let [width, height] = [2 * across, 2 * count.div_ceil(across)];
        let mut texels = vec![[0.0_f32; 3]; width * height];
        let mut uvs = Vec::with_capacity(3 * count);
        for (number, corners) in patch.triangles.iter().enumerate() {
            let (x, y) = (2 * (number % across), 2 * (number / across));
            let [a, b, c] = corners.map(|corner| colours[corner as usize]);
            texels[y * width + x] = a;
            texels[y * width + x + 1] = b;
            texels[(y + 1) * width + x] = c;
            texels[(y + 1) * width + x + 1] = std::array::from_fn(|i| b[i] + c[i] - a[i]);
            uvs.extend([(x, y), (x + 1, y), (x, y + 1)].map(|(x, y)| {
                let [u, down] =
                    [(x, width), (y, height)].map(|(at, of)| (at as f32 + 0.5) / of as f32);
                Vec2::new(u, 1.0 - down)
            }));
        }
        let corners = || {
            patch
                .triangles
                .iter()
                .flatten()
                .map(|corner| *corner as usize)
        };
        patch.positions = corners().map(|corner| patch.positions[corner]).collect();
        patch.normals = corners().map(|corner| patch.normals[corner]).collect();
        patch.triangles = (0..count as u32)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect();
        patch.uvs = Some(uvs);
        patch.painted = Some(Arc::new(ColourTexture::new(
            width,
            texels,
            [Wrap::Clamp; 2],
        )));
    }
}
