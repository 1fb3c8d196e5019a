//! `[solids.NAME]`, a body of solid tissue such as a fruit or the cap of a mushroom, and `[materials.NAME.solid]`.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use leafmodel::mosaic::pattern::MosaicPattern;
use leafmodel::mosaic::shapes::Shape;
use leafmodel::optics::solid::{ETA, SCATTERING_PER_MM, Solid as Tissue};
use leafmodel::optics::{Contents, PerConstituent};
use leafmodel::solid::{SolidMesh, SolidPlan, SolidShape};

use super::contents::read_changed;
use super::context::QUOTED;
use super::leaf::MAP_SIZE;
use super::limits::Limits;
use super::material::read_map;
use super::mosaic::read_mosaic;
use super::path::{Wanted, resolve};
use super::pigments::read_pigments;
use super::reader::Block;
use super::spectrum::require_prospect;
use super::tree::Value;
use super::values::{numbers_at, wrong_length, wrong_type};
use crate::geometry;
use crate::scene::assets;
use crate::scene::description::{Coat, Material, Solid, SolidOptics, SolidTissue};
use crate::scene::error::SceneError;
use crate::scene::source::{Place, escaped};

/// What solid tissue holds where nothing is said.
pub(crate) const NOTHING: Contents = Contents::NOTHING;
/// Depth that contents are spread over where nothing is said, mm.
pub(crate) const DEPTH_MM: f64 = 1.0;
/// GGX roughness of the skin where nothing is said.
pub(crate) const COAT_ALPHA: f64 = 0.3;
/// Extents of bodies, mm.
const EXTENTS_MM: Limits = Limits::closed(0.01, 1e5);
/// The shapes.
const SHAPES: [&str; 5] = ["sphere", "ellipsoid", "rounded_cube", "lathe", "mesh"];
/// Points that a profile may have.
const PROFILE: std::ops::RangeInclusive<usize> = 2..=1000;
/// Largest mesh file that is read, bytes.
const MOST_MESH_BYTES: u64 = 4 << 30;

/// Reads the block `[materials.NAME.solid]`.
pub(super) fn read_solid_material(block: &Block<'_>) -> Option<Material> {
    let extrapolate = block.cx.extrapolate.get();
    let tissue = match block.exactly_one(&["contents", "map"]) {
        Some("contents") => block.optional_block("contents").map(|inner| {
            require_prospect(block.cx, &inner.at);
            SolidTissue::Contents {
                contents: read_held(&inner),
                extrapolate,
            }
        }),
        Some(_) => block.optional_block("map").and_then(|inner| {
            require_prospect(block.cx, &inner.at);
            read_map(&inner).map(|file| SolidTissue::Map { file, extrapolate })
        }),
        None => None,
    };
    let pigments = read_pigments(block);
    let optics = read_optics(block);
    Some(Material::Solid {
        tissue: tissue?,
        pigments: Box::new(pigments?),
        optics,
    })
}

/// Reads one block of `[solids]`.
pub(crate) fn read_solid(block: &Block<'_>) -> Option<Solid> {
    require_prospect(block.cx, &block.at);
    let seed = block.integer_or("seed", 0, u64::MAX, 0);
    let map_size = block.integer_or("map_size", 16, 8192, MAP_SIZE) as u32;
    let shape = block
        .block("shape", &SHAPES)
        .and_then(|inner| read_shape(&inner));
    let contents = block.block("contents", &[]);
    let contents = contents.map(|inner| read_held(&inner));
    let is_patterned = block.entry("mosaic").is_some();
    let mosaic = read_mosaic(block, contents.unwrap_or(NOTHING));
    refuse_faces(block);
    let pigments = read_pigments(block);
    let optics = read_optics(block);
    block.finish();
    if is_patterned && mosaic.is_none() {
        return None;
    }
    let plan = SolidPlan {
        shape: shape?,
        seed,
        contents: contents?,
        mosaic,
        pigments: pigments?,
        map_size,
    };
    tell_of_mixed_cells(block, &plan);
    Some(Solid {
        plan,
        optics,
        extrapolate: block.cx.extrapolate.get(),
    })
}

/// Contents of which all may be left out: there is none of those.
fn read_held(block: &Block<'_>) -> Contents {
    let contents = read_changed(block, NOTHING);
    if contents.mixes_betalains_and_anthocyanins() {
        tell_of_mixture(block, "this tissue holds");
    }
    contents
}

/// Tells of anthocyanins and betalains in unlike cells of one body; what the body itself holds is told there.
fn tell_of_mixed_cells(block: &Block<'_>, plan: &SolidPlan) {
    let cells = plan.mosaic.iter().flat_map(|mosaic| &mosaic.contents);
    // Under a mosaic the body itself shows only where no cell may be.
    let shows = |mosaic: &MosaicPattern| mosaic.may_leave_bare();
    let own = plan.mosaic.as_ref().is_none_or(shows);
    let parts = own.then_some(&plan.contents).into_iter().chain(cells);
    if plan.contents.mixes_betalains_and_anthocyanins() {
        return;
    }
    let most = parts.fold(PerConstituent::splat(0.0), |most, part| {
        most.zip_with(part.0, f64::max)
    });
    if Contents(most).mixes_betalains_and_anthocyanins() {
        tell_of_mixture(block, "cells of this body hold");
    }
}

fn tell_of_mixture(block: &Block<'_>, what: &str) {
    block.cx.warn(
        &block.at,
        "scene::betalains_and_anthocyanins",
        format!("{what} betalains and anthocyanins, which never occur in the same plant"),
        Contents::NEVER_TOGETHER,
    );
}

/// A body has one skin: a mosaic on it has no `faces`.
fn refuse_faces(block: &Block<'_>) {
    let faces = block.table.get("mosaic").and_then(|entry| {
        let table = entry.node.table()?;
        table.get("faces")
    });
    if let Some(entry) = faces {
        let error = SceneError::Impossible {
            key: "faces".to_owned(),
            problem: "a body of solid tissue has one skin, not two faces".to_owned(),
            help: "leave `faces` out".to_owned(),
        };
        block.cx.error(&entry.key_at, error);
    }
}

/// Reads `depth_mm`, `scattering_per_mm`, `eta` and `coat`, all of which may be left out.
fn read_optics(block: &Block<'_>) -> SolidOptics {
    let per_mm = Limits::closed(0.001, 1000.0);
    let tissue = Tissue {
        depth_mm: block.number_or("depth_mm", per_mm, DEPTH_MM),
        scattering_per_mm: block.number_or("scattering_per_mm", per_mm, SCATTERING_PER_MM),
        eta: block.number_or("eta", Limits::closed(1.0, 2.0), ETA),
    };
    let tissue = tissue
        .checked()
        .expect("what the keys allow lies within the ranges of the model");
    let (mut eta, mut alpha) = (tissue.eta, COAT_ALPHA);
    if let Some(coat) = block.optional_block("coat") {
        eta = coat.number_or("eta", Limits::closed(1.0, 2.5), eta);
        alpha = coat.number_or("alpha", Limits::closed(0.02, 1.0), alpha);
        coat.finish();
    }
    SolidOptics {
        tissue,
        coat: Coat {
            eta,
            alpha_across: alpha,
            alpha_along: alpha,
        },
    }
}

fn read_shape(section: &Block<'_>) -> Option<SolidShape> {
    let (kind, block) = section.variant(&SHAPES)?;
    let shape = match kind {
        "sphere" => {
            let radius = block.number("radius_mm", EXTENTS_MM);
            radius.map(|radius| SolidShape::Ellipsoid {
                semi_axes_mm: DVec3::splat(radius),
            })
        }
        "ellipsoid" => {
            let axes = block.numbers::<3>("semi_axes_mm", EXTENTS_MM);
            axes.map(|axes| SolidShape::Ellipsoid {
                semi_axes_mm: DVec3::from_array(axes),
            })
        }
        "rounded_cube" => {
            let side = block.number("side_mm", EXTENTS_MM);
            let half = side.map_or(1e5, |side| 0.5 * side);
            let radius = block.number("corner_radius_mm", Limits::above(0.0, half));
            side.zip(radius)
                .map(|(side_mm, corner_radius_mm)| SolidShape::RoundedCube {
                    side_mm,
                    corner_radius_mm,
                })
        }
        "lathe" => read_profile(&block).map(|profile_mm| SolidShape::Lathe { profile_mm }),
        _ => read_mesh(&block).map(|mesh| SolidShape::Mesh(Arc::new(mesh))),
    };
    block.finish();
    // What the points of a profile make together is known once they are turned about the axis.
    if let Some(lathe @ SolidShape::Lathe { .. }) = &shape
        && let Err(error) = lathe.area()
    {
        let key = "profile_mm";
        let error = SceneError::Impossible {
            key: key.to_owned(),
            problem: error.to_string(),
            help: "let the profile run from below, on one side of the axis".to_owned(),
        };
        let at = block
            .table
            .get(key)
            .map_or(&block.at, |entry| &entry.key_at);
        block.cx.error(at, error);
        return None;
    }
    shape
}

fn read_profile(block: &Block<'_>) -> Option<Vec<DVec2>> {
    const WANTED: &str = "a list of 2 to 1000 points, [distance from the axis, height]";
    let key = "profile_mm";
    let node = block.needed(key, || format!("`{key} = […]`, {WANTED}"))?;
    let Value::List(list) = &node.value else {
        wrong_type(block.cx, node, key, WANTED);
        return None;
    };
    if !PROFILE.contains(&list.len()) {
        wrong_length(block.cx, &node.at, key, "a list", list.len(), WANTED);
        return None;
    }
    let points: Vec<Option<[f64; 2]>> = list
        .iter()
        .map(|point| numbers_at(block.cx, point, key, Limits::closed(-1e5, 1e5)))
        .collect();
    points
        .into_iter()
        .map(|point| point.map(DVec2::from_array))
        .collect()
}

/// Reads the mesh of a file, which must be one on which cells can live.
fn read_mesh(block: &Block<'_>) -> Option<SolidMesh> {
    let wanted = Wanted {
        endings: &["ply", "obj"],
        most_bytes: MOST_MESH_BYTES,
    };
    let path = block.text("path", "the path of a PLY or OBJ file");
    let scale_mm = block.number_or("scale_mm", Limits::above(0.0, 1e6), 1.0);
    let (written, at) = path?;
    let file = resolve(block.cx, written, at, wanted)?;
    let mend = "mend the mesh: each edge has at most two faces, both turned the same way, and the faces around a point hang together";
    let shape = assets::read(&file)
        .map_err(|error| (error.without_path(&file), "make the file readable"))
        .and_then(|bytes| {
            let extension = file.extension().and_then(|ending| ending.to_str());
            let mesh = geometry::import(&bytes, extension.unwrap_or(""), scale_mm as f32);
            mesh.map_err(|error| (error.to_string(), "save the mesh anew as PLY or OBJ"))
        })
        .and_then(|mesh| {
            let dropped = mesh.dropped();
            if dropped.total() > 0 {
                let code = "scene::faces_left_out";
                let help = "mend the mesh: each face has an area and corners of its own";
                block.cx.warn(at, code, dropped.to_string(), help);
            }
            let positions: Vec<DVec3> = mesh.positions().iter().map(|p| p.as_dvec3()).collect();
            let faces = mesh.triangles().to_vec();
            leafmodel::mosaic::Surface::new(positions.clone(), faces.clone())
                .and_then(|surface| surface.check_vertices())
                .map_err(|error| (error.to_string(), mend))?;
            Ok(match mesh.normals() {
                Some(normals) => Shape {
                    normals: unit(normals, &positions, &faces),
                    positions,
                    faces,
                },
                None => leafmodel::solid::creased(&positions, &faces),
            })
        });
    match shape {
        Ok(shape) => Some(SolidMesh {
            file: written.to_owned(),
            scale_mm,
            shape,
        }),
        Err((problem, help)) => {
            refuse(block, at, written, &problem, help);
            None
        }
    }
}

fn refuse(block: &Block<'_>, at: &Place, path: &str, problem: &str, help: &str) {
    let error = SceneError::BadFile {
        path: escaped(path, 2 * QUOTED),
        problem: escaped(problem, 8 * QUOTED),
        help: help.to_owned(),
    };
    block.cx.error(at, error);
}

/// Normals of a file at length 1; those that have none are the mean of the faces around.
fn unit(normals: &[glam::Vec3], positions: &[DVec3], faces: &[[u32; 3]]) -> Vec<DVec3> {
    let smooth = leafmodel::solid::smooth_normals(positions, faces);
    let of_file = normals.iter().map(|normal| normal.as_dvec3());
    let both = of_file.zip(smooth);
    both.map(|(normal, smooth)| normal.try_normalize().unwrap_or(smooth))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use crate::scene::load::parse;

    #[test]
    fn faces_that_a_mesh_of_a_body_loses_are_told() {
        let sphere = SolidShape::Ellipsoid {
            semi_axes_mm: DVec3::splat(10.0),
        };
        let ball = sphere.triangles(2.0).expect("a sphere");
        assert!(ball.faces.len() > 100);
        let mut text = String::new();
        for DVec3 { x, y, z } in ball.positions {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in ball.faces {
            let [a, b, c] = face.map(|corner| corner + 1);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
        let folder = tempfile::tempdir().expect("a folder");
        let warnings = |text: &str| -> Vec<String> {
            std::fs::write(folder.path().join("ball.obj"), text).expect("a file");
            let scene = "format = 1\n[film.rgb]\nsize = [4, 4]\nspp = 1\n[camera.perspective]\n\
                position_m = [0, -1, 0]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 40\n\
                [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n[objects.fruit]\nsolid = \"fruit\"\n\
                [solids.fruit.contents]\n[solids.fruit.shape.mesh]\npath = \"ball.obj\"\n";
            let loaded = parse(scene, "fruit.toml", folder.path(), &[]);
            let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
            let warnings = loaded.warnings.iter();
            warnings.map(|warning| warning.render(false)).collect()
        };
        assert_eq!(warnings(&text), [""; 0]);
        let told = warnings(&(text + "f 1 1 2\n"));
        assert_eq!(told.len(), 1, "{told:?}");
        for part in [
            "1 faces left out (0 not finite, 1 without area, 0 duplicate)",
            "path = \"ball.obj\"",
        ] {
            assert!(told[0].contains(part), "{}", told[0]);
        }
    }
}
