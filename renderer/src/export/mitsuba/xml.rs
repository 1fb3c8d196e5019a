//! The scene description proper.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use glam::DVec3;

use leafmodel::optics::Contents;

use crate::camera;
use crate::material;
use crate::scene::description::{
    Coat, Description, LeafTissue, Light, Material, Named, SolidOptics, SolidTissue, Spectrum,
};
use crate::scene::world::{MaterialOwner, World};

use super::absorption_file;
use super::shapes::{self, MeshFile};
use super::spectra::{self, Spectra};
use super::units::{UNITS_PER_METRE, material_id};

/// Suns stand this many scene radii away: irradiance differs over the scene by twice its inverse, either way from the
/// middle.
const SUN_DISTANCE: f64 = 1e5;

/// Where in the export the picture of an environment light lies.
pub(super) fn environment_file(light: &str, file: &Path) -> String {
    let ending = file
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or("exr");
    format!("maps/environment-{light}.{ending}")
}

/// The text of `scene.xml`, and the meshes that it names; spectra that become files are added to `spectra`.
pub(super) fn scene(
    scene: &Description,
    world: &World,
    spectra: &mut Spectra,
) -> (String, BTreeSet<MeshFile>) {
    let mut xml = String::from("<scene version=\"3.0.0\">\n");
    xml += &integrator(scene);
    xml += &sensor(scene);
    for number in 0..world.materials.len() {
        xml += &bsdf(scene, world, number, spectra);
    }
    let meshes = shapes::write(&mut xml, scene, world, spectra);
    for light in &scene.lights {
        xml += &emitter(light, world, spectra);
    }
    (xml + "</scene>\n", meshes)
}

fn integrator(scene: &Description) -> String {
    // Mitsuba counts the camera's own hit as depth 1.
    let depth = scene
        .integrator
        .max_depth
        .map_or(-1, |most| i64::from(most) + 1);
    format!(
        "<integrator type=\"path\">\n  <integer name=\"max_depth\" value=\"{depth}\"/>\n  \
         <integer name=\"rr_depth\" value=\"1000\"/>\n</integrator>\n"
    )
}

fn sensor(scene: &Description) -> String {
    let camera = &scene.camera;
    let axes = camera::Camera::axes(camera);
    let origin = camera.position * UNITS_PER_METRE;
    let target = origin + axes.z_axis * UNITS_PER_METRE;
    let kind = if camera.lens_radius > 0.0 {
        "thinlens"
    } else {
        "perspective"
    };
    let mut xml = format!("<sensor type=\"{kind}\">\n");
    let triple = |v: DVec3| format!("{}, {}, {}", v.x, v.y, v.z);
    let _ = writeln!(
        xml,
        "  <transform name=\"to_world\">\n    <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n  </transform>",
        triple(origin),
        triple(target),
        triple(axes.y_axis)
    );
    let _ = writeln!(
        xml,
        "  <float name=\"fov\" value=\"{}\"/>\n  <string name=\"fov_axis\" value=\"y\"/>\n  \
         <float name=\"near_clip\" value=\"0.1\"/>\n  <float name=\"far_clip\" value=\"1e9\"/>",
        camera.vertical_fov.to_degrees()
    );
    if camera.lens_radius > 0.0 {
        let _ = writeln!(
            xml,
            "  <float name=\"aperture_radius\" value=\"{}\"/>\n  \
             <float name=\"focus_distance\" value=\"{}\"/>",
            camera.lens_radius * UNITS_PER_METRE,
            camera.focus_distance * UNITS_PER_METRE
        );
    }
    let _ = writeln!(
        xml,
        "  <sampler type=\"independent\">\n    <integer name=\"sample_count\" value=\"{}\"/>\n  </sampler>\n  \
         <film type=\"specfilm\">\n    <integer name=\"width\" value=\"{}\"/>\n    \
         <integer name=\"height\" value=\"{}\"/>\n    <string name=\"component_format\" value=\"float32\"/>\n    \
         <rfilter type=\"box\"/>",
        scene.film.spp, scene.film.width, scene.film.height
    );
    for (number, band) in super::bands(scene).iter().enumerate() {
        xml += &spectra::response(number, band);
    }
    xml + "  </film>\n</sensor>\n"
}

fn number(name: &str, value: f64) -> String {
    format!("  <float name=\"{name}\" value=\"{value}\"/>\n")
}

fn bsdf(scene: &Description, world: &World, material: usize, spectra: &mut Spectra) -> String {
    let id = material_id(scene, world, material);
    let table = match &world.materials[material] {
        crate::material::Material::Leaf(leaf) => absorption_file(&leaf.palette),
        crate::material::Material::Solid(solid) => absorption_file(solid.palette()),
        crate::material::Material::Diffuse(_) | crate::material::Material::Dielectric(_) => {
            String::new()
        }
    };
    if let MaterialOwner::Leaf { leaf, .. } = world.owners[material] {
        let leaf = &scene.leaves[leaf].value;
        let tissue = match &world.materials[material] {
            crate::material::Material::Leaf(own) => match &own.tissue {
                material::leaf::LeafTissue::Uniform(contents) => {
                    uniform_tissue(contents, &table, leaf.extrapolate)
                }
                material::leaf::LeafTissue::Map(_)
                | material::leaf::LeafTissue::Measured { .. } => {
                    map_tissue(&id, &table, leaf.extrapolate)
                }
            },
            crate::material::Material::Diffuse(_)
            | crate::material::Material::Dielectric(_)
            | crate::material::Material::Solid(_) => String::new(),
        };
        return leaf_bsdf(&id, &tissue, &leaf.abaxial_ratio, &leaf.coats, spectra);
    }
    if let MaterialOwner::Solid(solid) = world.owners[material] {
        let solid = &scene.solids[solid].value;
        return solid_bsdf(
            &id,
            &map_tissue(&id, &table, solid.extrapolate),
            &solid.optics,
        );
    }
    match &scene.materials[material].value {
        Material::Diffuse { reflectance } => format!(
            "<bsdf type=\"twosided\" id=\"{id}\"><bsdf type=\"diffuse\">\n  {}</bsdf></bsdf>\n",
            spectra.element("reflectance", reflectance, 1.0)
        ),
        Material::Dielectric { eta, roughness } => {
            let kind = if *roughness > 0.0 {
                "roughdielectric"
            } else {
                "dielectric"
            };
            let mut xml = format!("<bsdf type=\"{kind}\" id=\"{id}\">\n");
            xml += &number("int_ior", *eta);
            xml += &number("ext_ior", 1.0);
            if *roughness > 0.0 {
                xml += "  <string name=\"distribution\" value=\"ggx\"/>\n";
                xml += &number("alpha", *roughness);
            }
            xml + "</bsdf>\n"
        }
        Material::Leaf {
            tissue,
            pigments: _,
            abaxial_ratio,
            coats,
        } => {
            let tissue = match tissue {
                LeafTissue::Contents {
                    contents,
                    extrapolate,
                } => uniform_tissue(contents, &table, *extrapolate),
                LeafTissue::Map { extrapolate, .. } => map_tissue(&id, &table, *extrapolate),
                LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => {
                    "  <string name=\"tissue\" value=\"measured\"/>\n  ".to_owned()
                        + &spectra.element("reflectance", reflectance, 1.0)
                        + "  "
                        + &spectra.element("transmittance", transmittance, 1.0)
                }
            };
            leaf_bsdf(&id, &tissue, abaxial_ratio, coats, spectra)
        }
        Material::Solid {
            tissue,
            pigments: _,
            optics,
        } => {
            let tissue = match tissue {
                SolidTissue::Contents {
                    contents,
                    extrapolate,
                } => uniform_tissue(contents, &table, *extrapolate),
                SolidTissue::Map { extrapolate, .. } => map_tissue(&id, &table, *extrapolate),
            };
            solid_bsdf(&id, &tissue, optics)
        }
    }
}

fn prospect(table: &str, extrapolate: bool) -> String {
    format!(
        "  <string name=\"prospect\" value=\"{table}\"/>\n  \
         <boolean name=\"extrapolate\" value=\"{extrapolate}\"/>\n"
    )
}

fn uniform_tissue(contents: &Contents, table: &str, extrapolate: bool) -> String {
    let mut xml = String::from("  <string name=\"tissue\" value=\"contents\"/>\n");
    xml += &prospect(table, extrapolate);
    for (constituent, value) in **contents {
        xml += &number(constituent.channel(), value);
    }
    xml
}

fn map_tissue(id: &str, table: &str, extrapolate: bool) -> String {
    format!(
        "  <string name=\"tissue\" value=\"map\"/>\n  <string name=\"map\" value=\"maps/{id}.exr\"/>\n{}",
        prospect(table, extrapolate)
    )
}

fn leaf_bsdf(
    id: &str,
    tissue: &str,
    abaxial_ratio: &Spectrum,
    coats: &[Coat; 2],
    spectra: &mut Spectra,
) -> String {
    let mut xml = format!("<bsdf type=\"lamina_leaf\" id=\"{id}\">\n{tissue}");
    for (face, coat) in ["adaxial", "abaxial"].into_iter().zip(coats) {
        xml += &number(&format!("{face}_eta"), coat.eta);
        xml += &number(&format!("{face}_alpha_across"), coat.alpha_across);
        xml += &number(&format!("{face}_alpha_along"), coat.alpha_along);
    }
    xml + "  " + &spectra.element("abaxial_ratio", abaxial_ratio, 1.0) + "</bsdf>\n"
}

fn solid_bsdf(id: &str, tissue: &str, optics: &SolidOptics) -> String {
    let mut xml = format!("<bsdf type=\"lamina_solid\" id=\"{id}\">\n{tissue}");
    for (name, value) in [
        ("depth_mm", optics.tissue.depth_mm),
        ("scattering_per_mm", optics.tissue.scattering_per_mm),
        ("eta", optics.tissue.eta),
        ("coat_eta", optics.coat.eta),
        ("coat_alpha", optics.coat.alpha_across),
    ] {
        xml += &number(name, value);
    }
    xml + "</bsdf>\n"
}

fn emitter(light: &Named<Light>, world: &World, spectra: &mut Spectra) -> String {
    match &light.value {
        // Written with its shape.
        Light::Area { .. } => String::new(),
        Light::Constant { radiance } => {
            format!(
                "<emitter type=\"constant\">\n  {}</emitter>\n",
                spectra.element("radiance", radiance, 1.0)
            )
        }
        Light::Distant {
            towards,
            angular_diameter,
            irradiance,
        } => sun(*towards, *angular_diameter, irradiance, world, spectra),
        Light::Environment {
            file,
            scale,
            rotation,
            ..
        } => format!(
            "<!-- Mitsuba makes spectra of this picture in its own way. -->\n<emitter type=\"envmap\">\n  \
             <string name=\"filename\" value=\"{}\"/>\n  <float name=\"scale\" value=\"{scale}\"/>\n  \
             <transform name=\"to_world\">\n    <rotate x=\"1\" angle=\"90\"/>\n    \
             <rotate z=\"1\" angle=\"{}\"/>\n  </transform>\n</emitter>\n",
            environment_file(&light.name, file),
            rotation.to_degrees()
        ),
    }
}

/// A disk of the sun's angular size, seen from the middle of the scene.
fn sun(
    towards: DVec3,
    angular_diameter: f64,
    irradiance: &Spectrum,
    world: &World,
    spectra: &mut Spectra,
) -> String {
    let (low, high) = world.geometry.bounds();
    let middle = (low + high).as_dvec3() * 0.5 * UNITS_PER_METRE;
    let distance = SUN_DISTANCE * f64::from((high - low).length()) * 0.5 * UNITS_PER_METRE;
    let radius = distance * libm::tan(0.5 * angular_diameter);
    let sin = libm::sin(0.5 * angular_diameter);
    let radiance = spectra.element("radiance", irradiance, 1.0 / (PI * sin * sin));
    let place = middle + towards * distance;
    let up = towards.any_orthonormal_vector();
    format!(
        "<shape type=\"disk\">\n  <transform name=\"to_world\">\n    <scale value=\"{radius}\"/>\n    \
         <lookat origin=\"{}, {}, {}\" target=\"{}, {}, {}\" up=\"{}, {}, {}\"/>\n  </transform>\n  \
         <bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"0\"/></bsdf>\n  \
         <emitter type=\"area\">\n  {radiance}  </emitter>\n</shape>\n",
        place.x, place.y, place.z, middle.x, middle.y, middle.z, up.x, up.y, up.z
    )
}
