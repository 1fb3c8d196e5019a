//! The interface to leafmodel: converts grown leaves and bodies to meshes and materials, and
//! millimetres to metres.

pub(super) mod parts;

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec2};
use leafmodel::blade::BladeMesh;
use leafmodel::blade::stalk::StalkMesh;
use leafmodel::blade::surface::stomata::StomataPlan;
use leafmodel::compound::{WholeLeaf, leaflet_plans};
use leafmodel::grow_options::{GrowOptions, Kept};
use leafmodel::leaf::LeafPlan;
use leafmodel::not_grown::NotGrown;
use leafmodel::optics::solid::ReflectanceTable;
use leafmodel::solid::Solid;
use thiserror::Error;

use self::parts::{LeafParts, MapParts, MeshParts, SurfaceParts};
pub use self::parts::{Piece, PlantError};
use crate::geometry::{MeshError, TriangleMesh};
use crate::material::contents_texture::ContentsTexture;
use crate::material::held::Held;
use crate::material::leaf::{LeafMaterial, LeafTissue};
use crate::material::palette::Palette;
use crate::material::relief::{ReliefMap, StomataNumbers};
use crate::material::solid::SolidMaterial;
use crate::scene::description::{self, LeafFaces, LeafOptics};
use crate::scene::plant_cache::PlantCache;
use crate::scene::tissue;

/// A grown leaf, ready to be placed: petiole, rachis and leaflets, or a single blade.
#[derive(Debug)]
pub struct GrownLeaf {
    /// Blades and stalks, metres; a blade's base is at the origin, its midrib along +y, its adaxial
    /// side +z.
    pub meshes: Vec<TriangleMesh>,
    /// Materials (maps of contents and coats) of the different blades, two for one that is closed,
    /// then the material of the stalks, if there are any, then those of hairs by kind.
    pub materials: Vec<LeafMaterial>,
    /// The pieces with their places; at least one.
    pub pieces: Vec<Piece>,
}

/// Why a body of solid tissue cannot be grown.
#[derive(Debug, Error)]
pub enum SolidError {
    /// The plan cannot be carried out.
    #[error(transparent)]
    Growth(#[from] NotGrown),
    /// Its mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Grows a body of solid tissue with the pigments of `palette`, in the frame of its shape; `table`
/// is that of its refractive index.
///
/// # Errors
///
/// [`SolidError`] if the plan cannot be carried out.
pub fn grow_solid(
    solid: &description::Solid,
    palette: Palette,
    table: Arc<ReflectanceTable>,
) -> Result<(TriangleMesh, SolidMaterial), SolidError> {
    let grown = Solid::grow(&solid.plan)?;
    let uvs = grown.uvs.iter().map(|uv| uv.as_vec2()).collect();
    let mesh = mesh_parts(
        &grown.positions,
        &grown.normals,
        Some(uvs),
        &grown.triangles,
    );
    let mesh = mesh.into_mesh()?;
    let map = grown.contents;
    let held = Held::Map(ContentsTexture::new(
        map.width as usize,
        map.height as usize,
        map.texels,
    ));
    Ok((mesh, tissue::solid(held, palette, &solid.optics, table)))
}

/// Grows veins that several leaves share once, into `cache`.
pub fn keep_shared_veins<'a>(
    leaves: impl Iterator<Item = &'a description::Leaf>,
    cache: &PlantCache,
) {
    let blades = leaves.flat_map(|leaf| match &leaf.plan.compound {
        Some(form) => leaflet_plans(&leaf.plan, form),
        None => vec![leaf.plan.clone()],
    });
    leafmodel::leaf::keep_shared_veins(&blades.collect::<Vec<_>>(), cache);
}

/// Grows a leaf with the pigments of `palette`, or takes those of its stages from `cache` that are there.
///
/// # Errors
///
/// [`PlantError`] if the plan cannot be carried out.
pub fn grow(
    leaf: &description::Leaf,
    palette: &Palette,
    cache: Option<&PlantCache>,
) -> Result<GrownLeaf, PlantError> {
    let options = GrowOptions {
        kept: cache.map(|cache| cache as &dyn Kept),
        ..GrowOptions::default()
    };
    let parts = LeafParts::grow(&leaf.plan, options)?;
    let faces = leaf.faces_by_age();
    let material = |held, faces: &LeafFaces| {
        let held = LeafTissue::Held(held);
        tissue::leaf(held, palette.clone(), faces, leaf.fluorescence)
    };
    // Stalks and hairs are no sheets, through which light could be followed from face to face.
    let round = LeafFaces {
        optics: LeafOptics::Plates,
        ..faces.clone()
    };
    let spread_mm = leaf.light_spread * leaf.plan.form.thickness_mm;
    let surface = leaf.plan.surface.as_ref();
    let is_closed = leaf.plan.form.closed;
    let blade = |map: MapParts, half: Option<usize>| {
        let size = [map.width, map.height];
        let spread_uv = map.size_mm.map(|side_mm| (spread_mm / side_mm) as f32);
        let texture = ContentsTexture::new(map.width, map.height, map.texels);
        let mut blade = material(Held::Map(texture), &faces);
        // In a closed blade light spreads on its way from one face to the other.
        if spread_mm > 0.0 && half.is_none() {
            blade = blade.spreading(Vec2::from(spread_uv));
        }
        if let Some(face) = half {
            blade = blade.half(face);
        }
        match (map.surface, surface) {
            (Some(parts), Some(plan)) => blade.with_relief(ReliefMap {
                size,
                texels: parts.texels,
                cover: parts.cover,
                size_mm: parts.size_mm,
                cells: [plan.cells_um, plan.cell_elongation, plan.cell_share].map(|n| n as f32),
                bloom: plan.bloom.map(|tau| tau as f32),
                stomata: stomata(&plan.stomata),
                dust_brightness: plan.dust.is_there().then_some(plan.dust.brightness),
            }),
            (_, _) => blade,
        }
    };
    let blades = parts.maps.into_iter().flat_map(|map| {
        if is_closed {
            vec![blade(map.clone(), Some(0)), blade(map, Some(1))]
        } else {
            vec![blade(map, None)]
        }
    });
    let uniform = |contents| material(Held::Uniform(contents), &round);
    let stalk = parts.stalk.map(uniform);
    let hairs = parts.hairs.into_iter().map(uniform);
    let meshes = parts.meshes.into_iter().map(MeshParts::into_mesh);
    Ok(GrownLeaf {
        meshes: meshes.collect::<Result<_, _>>()?,
        materials: blades.chain(stalk).chain(hairs).collect(),
        pieces: parts.pieces,
    })
}

/// Stomata as the renderer has them.
fn stomata(plan: &StomataPlan) -> StomataNumbers {
    StomataNumbers {
        per_mm2: plan.per_mm2.map(|density| density as f32),
        length_um: plan.length_um as f32,
        aspect: plan.aspect as f32,
        depth_um: plan.depth_um as f32,
        row_um: plan.row_um as f32,
    }
}

impl LeafParts {
    fn grow(plan: &LeafPlan, options: GrowOptions<'_>) -> Result<Self, PlantError> {
        let whole = WholeLeaf::grow_with(plan, options)?;
        let stalk_contents = whole.stalk_contents(plan)?;
        let (mut meshes, mut maps) = (Vec::new(), Vec::new());
        // The first mesh of each blade, whether its stalk's follows, and how many of hairs after it.
        let mut own = Vec::new();
        let halves = if plan.form.closed { 2 } else { 1 };
        let stalk_material = halves * whole.blades.len();
        for grown in whole.blades {
            let hairy: Vec<bool> = grown.hairs.iter().map(|hairs| hairs.count() > 0).collect();
            own.push((meshes.len(), grown.petiole.is_some(), hairy));
            if plan.form.closed {
                let frame = &grown.frame;
                let closed = grown.mesh.closed(|place| frame.uv(place));
                meshes.extend(closed.iter().map(blade));
            } else {
                meshes.push(blade(&grown.mesh));
            }
            if let Some(petiole) = &grown.petiole {
                meshes.push(stalk(petiole));
            }
            let hairs = grown.hairs.iter().filter(|hairs| hairs.count() > 0);
            meshes.extend(
                hairs.map(|hairs| {
                    mesh_parts(&hairs.positions, &hairs.normals, None, &hairs.triangles)
                }),
            );
            maps.push(MapParts {
                width: grown.contents.width as usize,
                height: grown.contents.height as usize,
                size_mm: grown.frame.size.to_array(),
                texels: grown.contents.texels,
                surface: grown.surface.map(|map| SurfaceParts {
                    texels: map.texels,
                    cover: map.cover,
                    size_mm: map.size_mm,
                }),
            });
        }
        let mut pieces = Vec::new();
        for placement in &whole.placements {
            let (mesh, has_stalk, hairy) = &own[placement.blade];
            let (mesh, has_stalk) = (*mesh, *has_stalk);
            let to_leaf = DAffine3 {
                translation: placement.to_leaf.translation * 1e-3,
                ..placement.to_leaf
            };
            let piece = |mesh, material| Piece {
                mesh,
                material,
                to_leaf,
            };
            let faces = 0..halves;
            pieces.extend(faces.map(|face| piece(mesh + face, halves * placement.blade + face)));
            let mesh = mesh + halves;
            pieces.extend(has_stalk.then(|| piece(mesh, stalk_material)));
            let kinds = hairy.iter().enumerate().filter(|(_, there)| **there);
            for (after, (kind, _)) in kinds.enumerate() {
                let mesh = mesh + usize::from(has_stalk) + after;
                // Their materials come after that of stalks, if there is one.
                pieces.push(piece(mesh, stalk_material + 1 + kind));
            }
        }
        if let Some(axes) = &whole.axes {
            pieces.push(Piece {
                mesh: meshes.len(),
                material: stalk_material,
                to_leaf: DAffine3::IDENTITY,
            });
            meshes.push(stalk(axes));
        }
        // The wall of a stalk is rendered as leaf tissue with the stalk's contents.
        let has_stalks = pieces.iter().any(|piece| piece.material == stalk_material);
        if !has_stalks {
            let hairs = pieces
                .iter_mut()
                .filter(|piece| piece.material > stalk_material);
            hairs.for_each(|piece| piece.material -= 1);
        }
        Ok(Self {
            meshes,
            maps,
            stalk: has_stalks.then_some(stalk_contents),
            hairs: plan.hairs.iter().map(|kind| kind.contents).collect(),
            pieces,
        })
    }
}

fn blade(blade: &BladeMesh) -> MeshParts {
    let uvs = blade.uvs.iter();
    let uvs = uvs.map(|uv| Vec2::new(uv.x as f32, uv.y as f32)).collect();
    mesh_parts(
        &blade.positions,
        &blade.normals,
        Some(uvs),
        &blade.triangles,
    )
}

/// Tubes, such as stalks and the axes of plants.
pub(super) fn stalk(tubes: &StalkMesh) -> MeshParts {
    mesh_parts(&tubes.positions, &tubes.normals, None, &tubes.triangles)
}

/// A mesh in metres from places in millimetres.
fn mesh_parts(
    positions_mm: &[DVec3],
    normals: &[DVec3],
    uvs: Option<Vec<Vec2>>,
    triangles: &[[u32; 3]],
) -> MeshParts {
    let positions = positions_mm.iter();
    MeshParts {
        positions: positions.map(|&p| (p * 1e-3).as_vec3()).collect(),
        normals: normals.iter().map(|normal| normal.as_vec3()).collect(),
        uvs,
        triangles: triangles.to_vec(),
    }
}
