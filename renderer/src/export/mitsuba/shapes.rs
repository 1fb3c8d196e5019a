//! The objects of the scene. Each mesh is written once. A shape in several places is also written
//! once, as a group with instances.
//!
//! A shape in one place is written as separate shapes, one for each of its parts. One in several
//! places becomes a `shapegroup` of its parts and an `instance` for each place, so that Mitsuba
//! keeps one copy of its triangles. Emitting shapes are always written separately, since no
//! instance can hold an emitter.
//!
//! Mitsuba treats the normals of mirrored shapes differently, so no exported transform mirrors:
//! where one would, the file holds the mirror image of the mesh.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DMat4, DVec3};

use crate::plugin::element::{Document, Element, Layout};
use crate::plugin::spectra::Spectra;
use crate::plugin::{UNITS_PER_METRE, matrix};
use crate::scene::description::{Description, Object, ObjectShape};
use crate::scene::plants::Piece;
use crate::scene::world::World;

use super::{emitter, media};
use crate::export::names::material_id;

/// A mesh of the world, or its mirror image in x.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MeshFile {
    /// Number of the mesh.
    pub(super) mesh: usize,
    /// Whether it is the mirror image.
    pub(super) mirrored: bool,
}

impl MeshFile {
    /// Its path within the export. Further meshes of a leaf are numbered from 2.
    pub(super) fn path(self, scene: &Description, world: &World) -> String {
        let image = if self.mirrored { ".mirrored" } else { "" };
        if let Some(mesh) = scene.meshes.get(self.mesh) {
            return format!("meshes/mesh-{}{image}.ply", mesh.name);
        }
        for (leaf, pieces) in scene.leaves.iter().zip(&world.pieces.leaves) {
            // A leaf's meshes have numbers without gaps.
            let meshes = || pieces.iter().map(|piece| piece.mesh);
            let (first, last) = (meshes().min(), meshes().max());
            if let (Some(first), Some(last)) = (first, last)
                && (first..=last).contains(&self.mesh)
            {
                let part = match self.mesh - first {
                    0 => String::new(),
                    part => format!(".{}", part + 1),
                };
                return format!("meshes/leaf-{}{part}{image}.ply", leaf.name);
            }
        }
        let mut solids = scene.solids.iter().zip(&world.pieces.solids);
        let solid = solids.find(|(_, piece)| piece.mesh == self.mesh);
        let name = solid.map_or("", |(solid, _)| &solid.name);
        format!("meshes/solid-{name}{image}.ply")
    }
}

/// A shape or its mirror image, which a group holds.
type GroupedShape = (ObjectShape, bool);

/// Writes all shapes, and returns the meshes that they use.
pub(super) fn write(
    document: &mut Document,
    scene: &Description,
    world: &World,
    spectra: &mut Spectra,
) -> BTreeSet<MeshFile> {
    let mut writer = ShapeWriter {
        scene,
        world,
        meshes: BTreeSet::new(),
    };
    let mut shining = BTreeMap::new();
    for (light, built) in scene.with_built(&world.lights) {
        if let Some(area) = light.value.area() {
            let emission = emitter::emission(built);
            shining.insert(area.object, (area, &*light.name, emission));
        }
    }
    let mut counts: BTreeMap<GroupedShape, usize> = BTreeMap::new();
    for (number, object) in scene.objects.iter().enumerate() {
        if !shining.contains_key(&number) {
            for (_, kind, _) in places(&object.value, world.strewn.get(&number)) {
                *counts.entry(kind).or_default() += 1;
            }
        }
    }
    let mut groups = BTreeSet::new();
    for (number, object) in scene.objects.iter().enumerate() {
        let light = shining.get(&number);
        for (place, kind, to_world) in places(&object.value, world.strewn.get(&number)) {
            let mut id = format!("object-{}", object.name);
            if object.value.instances.is_some() || object.value.is_spread() {
                id += &format!(".{}", place + 1);
            }
            if light.is_none() && counts[&kind] > 1 {
                if groups.insert(kind) {
                    document.add(&writer.group(kind));
                }
                document.add(&writer.instance(&id, kind, to_world));
                continue;
            }
            let emitter =
                light.map(|(area, name, emission)| area.emitter(name, *emission, spectra));
            for (part, piece) in world.pieces.of(kind.0).iter().enumerate() {
                let id = match part {
                    0 => id.clone(),
                    part => format!("{id}.part-{}", part + 1),
                };
                let mesh = writer.mesh(&id, piece, to_world);
                document.add(&mesh.holding_all(emitter.clone()));
            }
        }
    }
    writer.meshes
}

/// An object's places: number, shape, local to world. `strewn` are those that were found for it.
fn places<'a>(
    object: &'a Object,
    strewn: Option<&'a Vec<(u32, DMat4)>>,
) -> impl Iterator<Item = (usize, GroupedShape, DMat4)> + 'a {
    let in_one_place = strewn.is_none() && object.instances.is_none();
    let alone = in_one_place.then_some((0, object.to_world));
    let own = object.instances.iter().flatten();
    let own = own.filter(move |_| strewn.is_none());
    let own = own.map(|place| (place.shape, place.matrix()));
    let strewn = strewn.into_iter().flatten().copied();
    alone
        .into_iter()
        .chain(own)
        .chain(strewn)
        .enumerate()
        .map(|(number, (shape, to_world))| {
            let shape = object.shapes[shape as usize];
            (number, (shape, mirrors(to_world)), to_world)
        })
}

fn mirrors(matrix: DMat4) -> bool {
    // For an affine matrix this is the determinant of its linear part.
    matrix.determinant() < 0.0
}

/// The mirror image in x.
fn mirror() -> DMat4 {
    DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0))
}

struct ShapeWriter<'a> {
    scene: &'a Description,
    world: &'a World,
    meshes: BTreeSet<MeshFile>,
}

impl ShapeWriter<'_> {
    /// A part of a shape; `to_world` maps the shape's own frame to the world or to its group, in
    /// metres.
    fn mesh(&mut self, id: &str, piece: &Piece, to_world: DMat4) -> Element {
        let mut to_world = to_world * DMat4::from(piece.to_leaf);
        let file = MeshFile {
            mesh: piece.mesh,
            mirrored: mirrors(to_world),
        };
        if file.mirrored {
            to_world *= mirror();
        }
        self.meshes.insert(file);
        let mesh = self.world.geometry.mesh(piece.mesh as u32);
        let to_world = DMat4::from_scale(DVec3::splat(UNITS_PER_METRE)) * to_world;
        Element::plugin("shape", "ply")
            .called(id)
            .string("filename", file.path(self.scene, self.world))
            .boolean("face_normals", mesh.normals().is_none())
            .placed([matrix(to_world)])
            .referring(material_id(self.scene, self.world, piece.material))
            .holding_all(media::of_material(self.scene, self.world, piece.material))
    }

    /// All parts of a shape, in millimetres.
    fn group(&mut self, kind: GroupedShape) -> Element {
        let id = self.group_id(kind);
        let to_group = if kind.1 { mirror() } else { DMat4::IDENTITY };
        let pieces = self.world.pieces.of(kind.0);
        let parts = pieces.iter().enumerate();
        let parts = parts
            .map(|(part, piece)| self.mesh(&format!("{id}.part-{}", part + 1), piece, to_group));
        Element::plugin("shape", "shapegroup")
            .called(&id)
            .holding_all(parts)
            .laid_out(Layout::Level)
    }

    fn instance(&self, id: &str, kind: GroupedShape, to_world: DMat4) -> Element {
        let to_world = if kind.1 {
            to_world * mirror()
        } else {
            to_world
        };
        // Group and world are both in millimetres.
        let millimetres = DMat4::from_scale(DVec3::splat(UNITS_PER_METRE));
        let metres = DMat4::from_scale(DVec3::splat(UNITS_PER_METRE.recip()));
        Element::plugin("shape", "instance")
            .called(id)
            .referring(self.group_id(kind))
            .placed([matrix(millimetres * to_world * metres)])
    }

    fn group_id(&self, (shape, mirrored): GroupedShape) -> String {
        let scene = self.scene;
        let name = match shape {
            ObjectShape::Mesh { mesh, material } => format!(
                "mesh-{}.{}",
                scene.meshes[mesh].name, scene.materials[material].name
            ),
            ObjectShape::Leaf { leaf } => format!("leaf-{}", scene.leaves[leaf].name),
            ObjectShape::Solid { solid } => format!("solid-{}", scene.solids[solid].name),
        };
        let image = if mirrored { ".mirrored" } else { "" };
        format!("group-{name}{image}")
    }
}
