//! A grown leaf as bytes: a sequence of counts and numbers, little-endian.

use glam::{DAffine3, Vec2, Vec3};
use leafmodel::memory;
use leafmodel::optics::{Contents, PerConstituent};

use crate::scene::plants::parts::{LeafParts, MapParts, MeshParts, Piece, SurfaceParts};

/// The leaf as bytes.
pub(super) fn to_bytes(parts: &LeafParts) -> Vec<u8> {
    let mut out = Vec::new();
    count(&mut out, parts.meshes.len());
    for mesh in &parts.meshes {
        count(&mut out, mesh.positions.len());
        floats(&mut out, mesh.positions.iter().flat_map(Vec3::to_array));
        count(&mut out, mesh.normals.len());
        floats(&mut out, mesh.normals.iter().flat_map(Vec3::to_array));
        count(&mut out, usize::from(mesh.uvs.is_some()));
        if let Some(uvs) = &mesh.uvs {
            count(&mut out, uvs.len());
            floats(&mut out, uvs.iter().flat_map(Vec2::to_array));
        }
        count(&mut out, mesh.triangles.len());
        let corners = mesh.triangles.as_flattened().iter();
        out.extend(corners.flat_map(|corner| corner.to_le_bytes()));
    }
    count(&mut out, parts.maps.len());
    for map in &parts.maps {
        count(&mut out, map.width);
        count(&mut out, map.height);
        doubles(&mut out, &map.size_mm);
        floats(
            &mut out,
            map.texels.iter().flat_map(|texel| *texel.as_array()),
        );
        count(&mut out, usize::from(map.surface.is_some()));
        if let Some(surface) = &map.surface {
            floats(&mut out, surface.size_mm.into_iter());
            let moments = surface.texels.as_flattened().as_flattened();
            floats(&mut out, moments.iter().copied());
            count(&mut out, surface.cover.len());
            floats(&mut out, surface.cover.as_flattened().iter().copied());
        }
    }
    count(&mut out, usize::from(parts.stalk.is_some()));
    if let Some(stalk) = &parts.stalk {
        doubles(&mut out, stalk.as_array());
    }
    count(&mut out, parts.hairs.len());
    for hairs in &parts.hairs {
        doubles(&mut out, hairs.as_array());
    }
    count(&mut out, parts.pieces.len());
    for piece in &parts.pieces {
        count(&mut out, piece.mesh);
        count(&mut out, piece.material);
        doubles(&mut out, &piece.to_leaf.to_cols_array());
    }
    out
}

fn count(out: &mut Vec<u8>, value: usize) {
    out.extend((value as u64).to_le_bytes());
}

fn floats(out: &mut Vec<u8>, values: impl Iterator<Item = f32>) {
    out.extend(values.flat_map(f32::to_le_bytes));
}

fn doubles(out: &mut Vec<u8>, values: &[f64]) {
    out.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}

/// The leaf that these bytes encode; `None` if they are not a leaf or some are left over.
pub(super) fn parts_from(bytes: &[u8]) -> Option<LeafParts> {
    let mut rest = Rest(bytes);
    let meshes = rest.list(|rest| {
        Some(MeshParts {
            positions: rest.counted(Vec3::from_array)?,
            normals: rest.counted(Vec3::from_array)?,
            uvs: match rest.count()? {
                0 => None,
                1 => Some(rest.counted(Vec2::from_array)?),
                _ => return None,
            },
            triangles: rest.triangles()?,
        })
    })?;
    let maps = rest.list(|rest| {
        let (width, height) = (rest.count()?, rest.count()?);
        let size_mm = rest.doubles()?;
        let texels = rest.floats(width.checked_mul(height)?, PerConstituent::new)?;
        let surface = match rest.count()? {
            0 => None,
            1 => Some(SurfaceParts {
                size_mm: rest.floats(1, |size: [f32; 2]| size)?.pop()?,
                texels: rest.floats(width.checked_mul(height)?, |flat: [f32; 8]| {
                    [0, 4].map(|face| std::array::from_fn(|i| flat[face + i]))
                })?,
                cover: rest.counted(|cover: [f32; 3]| cover)?,
            }),
            _ => return None,
        };
        let covered = surface.as_ref().map_or(0, |surface| surface.cover.len());
        let is_whole = covered == 0 || covered == texels.len();
        (!texels.is_empty() && is_whole).then_some(MapParts {
            width,
            height,
            size_mm,
            texels,
            surface,
        })
    })?;
    let stalk = match rest.count()? {
        0 => None,
        1 => Some(Contents(PerConstituent::new(rest.doubles()?))),
        _ => return None,
    };
    let hairs = rest.list(|rest| Some(Contents(PerConstituent::new(rest.doubles()?))))?;
    let materials = maps.len() + usize::from(stalk.is_some()) + hairs.len();
    let pieces = rest.list(|rest| {
        let piece = Piece {
            mesh: rest.count()?,
            material: rest.count()?,
            to_leaf: DAffine3::from_cols_array(&rest.doubles()?),
        };
        (piece.mesh < meshes.len() && piece.material < materials).then_some(piece)
    })?;
    // A leaf has at least one blade.
    (rest.0.is_empty() && !pieces.is_empty()).then_some(LeafParts {
        meshes,
        maps,
        stalk,
        hairs,
        pieces,
    })
}

/// Bytes not yet read.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn count(&mut self) -> Option<usize> {
        let bytes = self.take(8)?.try_into().ok()?;
        usize::try_from(u64::from_le_bytes(bytes)).ok()
    }

    /// A list preceded by its length.
    fn list<T>(&mut self, mut one: impl FnMut(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        (0..self.count()?).map(|_| one(self)).collect()
    }

    fn floats<const N: usize, T>(
        &mut self,
        count: usize,
        make: impl Fn([f32; N]) -> T,
    ) -> Option<Vec<T>> {
        let bytes = self.take(count.checked_mul(4 * N)?)?;
        let number = |bytes: &[u8]| [bytes[0], bytes[1], bytes[2], bytes[3]];
        let one = |bytes: &[u8]| {
            make(std::array::from_fn(|i| {
                f32::from_le_bytes(number(&bytes[4 * i..]))
            }))
        };
        let mut made = memory::room_for(count);
        made.extend(bytes.chunks_exact(4 * N).map(one));
        Some(made)
    }

    fn counted<const N: usize, T>(&mut self, make: impl Fn([f32; N]) -> T) -> Option<Vec<T>> {
        let count = self.count()?;
        self.floats(count, make)
    }

    fn triangles(&mut self) -> Option<Vec<[u32; 3]>> {
        let count = self.count()?;
        // Bits are copied without any conversion of floats.
        let bytes = self.take(count.checked_mul(12)?)?;
        let corner = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let triangles = bytes.chunks_exact(12);
        Some(
            triangles
                .map(|t| [0, 4, 8].map(|at| corner(&t[at..])))
                .collect(),
        )
    }

    fn doubles<const N: usize>(&mut self) -> Option<[f64; N]> {
        let bytes = self.take(8 * N)?;
        let mut values = [0.0; N];
        for (value, bytes) in values.iter_mut().zip(bytes.chunks_exact(8)) {
            *value = f64::from_le_bytes(bytes.try_into().ok()?);
        }
        Some(values)
    }
}
