//! Notes about a scene's materials that can be given only after files are read and leaves are
//! grown.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec3};

use super::placing::{MaterialOwner, Pieces};
use super::seen::corners_between;
use leafmodel::optics::Contents;

use crate::geometry::TriangleMesh;
use crate::material::colour_map::ColourMap;
use crate::material::{ExceedingCoat, Material};
use crate::scene::description::{Description, InstancePlace, Named, ObjectShape};
use crate::scene::plants::Piece;

/// Notes on leaves and solid tissue whose coat alone reflects more than the whole should, one for
/// each.
pub(super) fn on_coats(
    scene: &Description,
    materials: &[Material],
    owners: &[MaterialOwner],
    range_nm: [f64; 2],
) -> Vec<String> {
    let mut notes: Vec<(String, String)> = Vec::new();
    for (material, owner) in materials.iter().zip(owners) {
        if let Some(exceeding) = material.exceeding_coat(range_nm) {
            let ExceedingCoat { nm, coat, whole } = exceeding;
            let name = match owner {
                MaterialOwner::Scene(number) => {
                    format!("materials.{}", scene.materials[*number].name)
                }
                MaterialOwner::Leaf { leaf, .. } => format!("leaves.{}", scene.leaves[*leaf].name),
                MaterialOwner::Solid(solid) => format!("solids.{}", scene.solids[*solid].name),
            };
            if notes.last().is_some_and(|(before, _)| *before == name) {
                continue;
            }
            let note = format!(
                "{name}: at {nm} nm {coat} alone reflects more than {whole} should; \
                 {whole} reflects the coat's share there (lower the coat's eta)"
            );
            notes.push((name, note));
        }
    }
    notes.into_iter().map(|(_, note)| note).collect()
}

/// Notes on a mesh of this name: faces that were dropped or cross themselves, and what was left out
/// of its file.
pub fn on_mesh(name: &str, mesh: &TriangleMesh, left_out: &[String]) -> Vec<String> {
    let remarks = mesh.remarks().into_iter();
    let remarks = remarks.map(|remark| format!("meshes.{name}: {remark}"));
    let parts = left_out.join(", ");
    let left_out =
        (!parts.is_empty()).then(|| format!("meshes.{name}: left out of its file: {parts}"));
    remarks.chain(left_out).collect()
}

/// Notes on maps with both betalains and anthocyanins in any texels, since no plant has both.
pub(super) fn on_maps<'m>(
    materials: impl IntoIterator<Item = (&'m str, &'m Material)>,
) -> Vec<String> {
    // Contents are at least 0, so their means show whether any texel has some. Uniform contents are
    // checked where they are read.
    let mixes = |material: &Material| {
        let map = material.contents_map();
        map.is_some_and(|map| map.mean().mixes_betalains_and_anthocyanins())
    };
    materials
        .into_iter()
        .filter(|(_, material)| mixes(material))
        .map(|(name, _)| {
            format!(
                "materials.{name}: its map holds betalains and anthocyanins, which never occur in the same plant: {}",
                Contents::NEVER_TOGETHER
            )
        })
        .collect()
}

/// Notes on meshes without texture coordinates whose material has a picture.
pub(super) fn on_missing_uvs(
    scene: &Description,
    meshes: &[TriangleMesh],
    materials: &[Material],
) -> Vec<String> {
    let objects = scene.objects.iter();
    let shapes = objects.flat_map(|object| object.value.shapes.iter().copied());
    let pairs: BTreeSet<(usize, usize)> = shapes.filter_map(ObjectShape::mesh).collect();
    let without = pairs.into_iter().filter(|(mesh, material)| {
        let map = materials[*material].colour_map();
        let has_picture = |map: &ColourMap| map.slots().iter().any(|slot| slot.texture.is_some());
        meshes[*mesh].uvs().is_none() && map.is_some_and(has_picture)
    });
    let told = without.map(|(mesh, material)| {
        format!(
            "meshes.{}: it has no texture coordinates, so that the picture of materials.{} lies on each \
             triangle by itself",
            scene.meshes[mesh].name, scene.materials[material].name
        )
    });
    told.collect()
}

/// Length of the longest undivided leaves and of the longest compound ones, m, with room for what is
/// a little longer.
const LONGEST: [f64; 2] = [4.0, 25.0];

/// Length below which nothing is a whole leaf, m.
const SHORTEST: f64 = 2e-4;

/// Notes on objects whose scale makes of a leaf what no plant has.
pub(super) fn on_sizes(
    scene: &Description,
    meshes: &[TriangleMesh],
    pieces: &Pieces,
    strewn: &BTreeMap<usize, Vec<InstancePlace>>,
) -> Vec<String> {
    let mut notes = Vec::new();
    for (
        number,
        Named {
            name,
            value: object,
        },
    ) in scene.objects.iter().enumerate()
    {
        let lengths = object.shapes.iter().map(|shape| {
            let leaf = &scene.leaves[shape.leaf()?].value;
            let longest = LONGEST[usize::from(leaf.plan.compound.is_some())];
            Some((longest, length_of(&pieces.of(*shape), meshes)))
        });
        let lengths: Vec<_> = lengths.collect();
        let places = strewn.get(&number).or(object.instances.as_ref());
        let alone = InstancePlace::new(0, object.to_world);
        let alone = places.is_none().then_some(&alone);
        let unlikely = places
            .into_iter()
            .flatten()
            .chain(alone)
            .filter_map(|place| {
                let (longest, length) = lengths[place.shape as usize]?;
                let scale = (0..3).map(|axis| place.linear.col(axis).length());
                let length = length * f64::from(scale.fold(0.0, f32::max));
                (!(SHORTEST..=longest).contains(&length)).then_some((longest, length))
            });
        if let Some((longest, length)) = unlikely.max_by(|a, b| a.1.total_cmp(&b.1)) {
            notes.push(if length > longest {
                format!(
                    "objects.{name}: a leaf is {length:.1} m long, and the longest in nature have \
                     {longest} m: check `scale` and `length_mm`"
                )
            } else {
                format!(
                    "objects.{name}: a leaf is {:.1e} mm long, and no plant has such short ones: \
                     check `scale` and `length_mm`",
                    1e3 * length
                )
            });
        }
    }
    notes
}

/// Length of a shape along the longest side of its box, m.
fn length_of(pieces: &[Piece], meshes: &[TriangleMesh]) -> f64 {
    let corners = pieces.iter().flat_map(|piece| {
        let (least, most) = meshes[piece.mesh].bounds();
        corners_between([least, most].map(Vec3::as_dvec3), &piece.to_leaf)
    });
    let nowhere = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [least, most] = corners.fold(nowhere, |[least, most], corner| {
        [least.min(corner), most.max(corner)]
    });
    (most - least).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::leaf::Coat;
    use crate::material::contents_texture::ContentsTexture;
    use crate::material::held::Held;
    use crate::material::leaf::{LeafMaterial, LeafTissue};
    use crate::material::palette::Palette;
    use leafmodel::optics::Constituent;

    /// A leaf of two texels, the first with anthocyanins, the second with betaxanthins.
    fn leaf(anthocyanins: f32, betaxanthins: f32) -> Material {
        let green = Contents::prospect_d([1.5, 30.0, 8.0, 0.0, 0.0, 0.01, 0.01]).to_texel();
        let first = green.with(&[(Constituent::Anthocyanins, anthocyanins)]);
        let second = green.with(&[(Constituent::Betaxanthins, betaxanthins)]);
        let coat = Coat::new(1.45, 0.3, 0.3);
        Material::Leaf(Box::new(LeafMaterial::new(
            LeafTissue::Held(Held::Map(ContentsTexture::new(2, 1, vec![first, second]))),
            Palette::default(),
            None,
            [coat.clone(), coat],
        )))
    }

    #[test]
    fn maps_that_hold_what_no_plant_does_are_reported_by_name() {
        let (both, red, yellow) = (leaf(2.0, 0.5), leaf(2.0, 0.0), leaf(0.0, 0.5));
        let notes = on_maps([("beet", &both), ("maple", &red), ("cactus", &yellow)]);
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].starts_with("materials.beet: "), "{notes:?}");
    }
}
