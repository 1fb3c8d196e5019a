//! Reflectance and transmittance of materials, for programs that compute with spectra.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::bsdf::Bsdf;
use crate::geometry::TriangleMesh;
use crate::material::Material;
use crate::material::leaf::LeafMaterial;
use crate::spectrum::{Lanes, Wavelengths};

use super::colours::WAVELENGTHS;

const FIRST_NM: usize = 400;
const STEP_NM: usize = 10;
const COUNT: usize = 211;
/// Most triangles of a mesh at whose middles a material is looked at.
const MOST_LOOKS: usize = 1024;

/// Fractions that are sent back and let through, at each wavelength.
type Spectra = [[f64; COUNT]; 2];

/// What glTF's `extras` say of each face of a material on a mesh: means over the mesh, by area, for light
/// along the normal. `blade` is the leaf if the mesh is one.
pub(super) fn extras(
    material: &Material,
    blade: Option<&LeafMaterial>,
    mesh: &TriangleMesh,
) -> [Value; 2] {
    let looks = looks(material, mesh);
    let whole: f64 = looks.iter().map(|(_, area)| area).sum();
    let seen = looks
        .par_iter()
        .map(|&(uv, area)| (seen(material, blade, uv), area / whole));
    // Added up in order, so that the sum is the same each time.
    let seen: Vec<([Spectra; 2], f64)> = seen.collect();
    [0, 1].map(|face| {
        let [reflectance, transmittance] = [0, 1].map(|part| {
            let mean = |step: usize| -> f64 {
                let own = seen
                    .iter()
                    .map(|(faces, weight)| weight * faces[face][part][step]);
                own.sum()
            };
            (0..COUNT)
                .map(|step| (mean(step) * 1e6).round() / 1e6)
                .collect::<Vec<_>>()
        });
        let nm: Vec<usize> = (0..COUNT).map(|step| FIRST_NM + step * STEP_NM).collect();
        json!({ "wavelength_nm": nm, "reflectance": reflectance, "transmittance": transmittance })
    })
}

/// Texture coordinates at which a material is looked at, and the area for which each stands.
fn looks(material: &Material, mesh: &TriangleMesh) -> Vec<(Vec2, f64)> {
    let is_varied = material.contents_map().is_some() || material.colour_map().is_some();
    let Some(uvs) = mesh.uvs().filter(|_| is_varied) else {
        return vec![(Vec2::splat(0.5), 1.0)];
    };
    let triangles = mesh.triangles();
    let all = triangles
        .iter()
        .step_by(triangles.len().div_ceil(MOST_LOOKS));
    let looks = all.map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions()[vertex as usize]);
        let middle: Vec2 = triangle.iter().map(|&vertex| uvs[vertex as usize]).sum();
        (middle / 3.0, f64::from((b - a).cross(c - a).length()))
    });
    looks.collect()
}

/// What each face sends back and lets through at a place.
fn seen(material: &Material, blade: Option<&LeafMaterial>, uv: Vec2) -> [Spectra; 2] {
    let mut found = [[[0.0; COUNT]; 2]; 2];
    for first in (0..COUNT).step_by(WAVELENGTHS) {
        let nm = std::array::from_fn(|lane| (FIRST_NM + (first + lane) * STEP_NM) as f32);
        let faces = at(material, blade, uv, &Wavelengths::new(nm));
        for (found, faces) in found
            .as_flattened_mut()
            .iter_mut()
            .zip(faces.as_flattened())
        {
            for (found, &value) in found[first..].iter_mut().zip(&faces.0) {
                *found = f64::from(value);
            }
        }
    }
    found
}

fn at(
    material: &Material,
    blade: Option<&LeafMaterial>,
    uv: Vec2,
    wavelengths: &Wavelengths<WAVELENGTHS>,
) -> [[Lanes<WAVELENGTHS>; 2]; 2] {
    if let Some(leaf) = blade {
        let bsdf = leaf.whole_bsdf(uv, wavelengths);
        return [0, 1].map(|face| bsdf.along_normal(face));
    }
    let bsdf = material.bsdf(uv, wavelengths);
    let sent_back = match &bsdf {
        // The wall of a tube: of what it lets in, all leaves again that it does not absorb.
        Bsdf::Leaf(wall) => {
            let [back, through] = wall.along_normal(0);
            Lanes::from_fn(|lane| {
                let (r, t) = (back.0[lane], through.0[lane]);
                r + t * t / (1.0 - r).max(1e-6)
            })
        }
        Bsdf::Diffuse(_)
        | Bsdf::Dielectric(_)
        | Bsdf::Relief(_)
        | Bsdf::Metallic(_)
        | Bsdf::Hapke(_) => bsdf.albedo(Vec3::Z),
    };
    [[sent_back, Lanes::ZERO]; 2]
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::export::gltf::{GltfOptions, glb, wavelengths};
    use crate::scene::load;
    use crate::scene::world::{BuildOptions, World};

    /// A coated leaf whose spectra were measured, and a soil beside it.
    const SCENE: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, 0, 1]
look_at_m = [0, 0.01, 0]
vertical_fov_deg = 40
[meshes.card.rectangle]
width_m = 0.1
height_m = 0.1
[materials.leaf.leaf]
adaxial = { eta = 1.45, alpha = 0.3 }
abaxial = { eta = 1.4, alpha = 0.5 }
[materials.leaf.leaf.measured]
reflectance = { table = [[400, 0.05], [700, 0.11], [2500, 0.47]] }
abaxial_reflectance = 0.2
transmittance = { table = [[400, 0.01], [2500, 0.43]] }
[materials.soil.diffuse]
reflectance = { table = [[400, 0.1], [2500, 0.52]] }
[objects.leaf]
mesh = "card"
material = "leaf"
[objects.soil]
mesh = "card"
material = "soil"
position_m = [0.2, 0, 0]
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;

    #[test]
    fn the_extras_of_materials_are_the_spectra_that_were_measured() {
        let loaded = load::parse(SCENE, "scene.toml", Path::new("."), &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let colours = wavelengths();
        let built = BuildOptions {
            wavelengths: Some(&colours),
            ..BuildOptions::default()
        };
        let world = World::build_with(&scene, &built).expect("a good scene");
        let options = GltfOptions {
            spectra: true,
            ..GltfOptions::default()
        };
        let (file, _) = glb(&scene, &world, options).expect("a file");
        let glb = gltf::Glb::from_slice(&file).expect("a glb file");
        let root: Value = serde_json::from_slice(&glb.json).expect("JSON");
        let along = |nm: f64, low: f64, high: f64| low + (high - low) * (nm - 400.0) / 2100.0;
        let of_leaf = |nm: f64| match nm {
            ..700.0 => 0.05 + 0.06 * (nm - 400.0) / 300.0,
            _ => 0.11 + 0.36 * (nm - 700.0) / 1800.0,
        };
        let materials = root["materials"].as_array().expect("a list");
        assert_eq!(materials.len(), 3);
        for material in materials {
            let extras = &material["extras"];
            let value = |key: &str, step: usize| extras[key][step].as_f64().expect("a number");
            for step in 0..COUNT {
                let nm = value("wavelength_nm", step);
                let through = along(nm, 0.01, 0.43);
                let (r, t) = match material["name"].as_str() {
                    Some("material-leaf.adaxial") => (of_leaf(nm), through),
                    Some("material-leaf.abaxial") => (0.2, through),
                    Some("material-soil") => (along(nm, 0.1, 0.52), 0.0),
                    name => panic!("{name:?}"),
                };
                let found = (value("reflectance", step), value("transmittance", step));
                // Rounded in the file, and by f32 before.
                assert!(
                    (found.0 - r).abs() < 1e-5 && (found.1 - t).abs() < 1e-5,
                    "{material}"
                );
            }
        }
    }
}
