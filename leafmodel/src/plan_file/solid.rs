//! A body of solid tissue, such as a fruit or the cap of a mushroom.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::mosaic::{self, mosaic};
use crate::document::assets::Triangles;
use crate::document::declared::Declared;
use crate::document::keys::{Keys, Variant};
use crate::document::limits::Limits;
use crate::document::named_asset::{asset, bad_file};
use crate::document::value_kind::{Integer, ListOf, MapOf, Number, Numbers, Text, Vector};
use crate::mosaic::Surface;
use crate::mosaic::pattern::MosaicPattern;
use crate::mosaic::shapes::Shape;
use crate::optics::contents_keys::{changed_contents, warn_of_mixture};
use crate::optics::{Contents, Pigments};
use crate::solid::{Raised, SolidMesh, SolidPlan, SolidShape, creased, smooth_normals};

/// Extents of bodies.
const EXTENTS_MM: Limits = Limits::closed(0.01, 1e5);
/// Texels of maps where nothing is said.
pub(super) const MAP_SIZE: u32 = 1024;
/// Width of the slopes of raised tissue where nothing is said, mm.
const OVER_MM: f64 = 1.0;

/// A body of which nothing is said.
pub fn usual_solid() -> SolidPlan {
    SolidPlan {
        shape: sphere(),
        seed: 0,
        contents: Contents::NOTHING,
        mosaic: None,
        raised: None,
        pigments: Pigments::default(),
        map_size: MAP_SIZE,
    }
}

fn sphere() -> SolidShape {
    SolidShape::Ellipsoid {
        semi_axes_mm: DVec3::ONE,
    }
}

/// The keys of a body.
pub fn solid(plan: &mut SolidPlan, keys: &mut Keys<'_>) {
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut plan.seed,
        seed,
        "Same plan and seed, same body, bit for bit.",
    );
    let size = Integer::within(16, 8192);
    let about = "Texels of the map of contents along a side; a body without a mosaic needs none.";
    keys.key("map_size", &mut plan.map_size, size, about);
    let names = SHAPES.map(|shape| shape.name);
    keys.required_block("shape", "See below.", &names, |keys| {
        keys.kind(&mut plan.shape, &SHAPES);
    });
    let held = &mut plan.contents;
    let about = "What the outer tissue holds per area of the surface, see below.";
    keys.required_block("contents", about, &[], |keys| held_contents(held, keys));
    let base = plan.contents;
    let about = "Cells of several types.";
    keys.optional_block(
        "mosaic",
        &mut plan.mosaic,
        mosaic::usual,
        about,
        |pattern, keys| {
            mosaic(pattern, keys, base);
        },
    );
    if keys.has_path(&["mosaic", "faces"]) {
        let problem = "a body of solid tissue has one skin, not two faces";
        keys.refuse(
            &["mosaic", "faces"],
            problem.to_owned(),
            "leave `faces` out",
        );
    }
    raised(plan, keys);
    let about = "Which substances its pigments are.";
    keys.block("pigments", about, |keys| plan.pigments.declare(keys));
    if keys.is_sound() {
        warn_of_mixed_cells(plan, keys);
    }
}

/// The keys of `raised`.
fn raised(plan: &mut SolidPlan, keys: &mut Keys<'_>) {
    let types = plan.mosaic.iter().flat_map(|mosaic| &mosaic.plan.types);
    let names: Vec<String> = types.map(|one| one.name.clone()).collect();
    let about = "Cells whose tissue stands out from the shape, as warts do, or lies below it.";
    let new = || Raised {
        heights_mm: Vec::new(),
        over_mm: OVER_MM,
    };
    keys.optional_block("raised", &mut plan.raised, new, about, |raised, keys| {
        let of_types = names.iter().cloned().zip(raised.heights_mm.iter().copied());
        let mut heights: Vec<(String, f64)> = of_types.filter(|(_, mm)| *mm != 0.0).collect();
        let limits = Number(Limits::closed(-1000.0, 1000.0));
        let about = "A table from types of cells to how high their tissue stands; others have 0.";
        keys.required("heights_mm", &mut heights, MapOf(limits), about);
        let limits = Number(Limits::above(0.0, 1000.0));
        let about = "Width over which it rises, from the border of the tissue inwards.";
        keys.key("over_mm", &mut raised.over_mm, limits, about);
        raised.heights_mm = vec![0.0; names.len()];
        for (name, mm) in heights {
            if let Some(kind) = names.iter().position(|one| *one == name) {
                raised.heights_mm[kind] = mm;
                continue;
            }
            let problem = format!("`{name}` is no type of cell of the mosaic");
            let help = if names.is_empty() {
                "give the body a `mosaic`".to_owned()
            } else {
                format!("write one of {}", names.join(", "))
            };
            keys.refuse(&["heights_mm", &name], problem, &help);
        }
    });
}

/// The keys of what solid tissue holds; a key that is left out means none.
pub fn held_contents(contents: &mut Contents, keys: &mut Keys<'_>) {
    changed_contents(contents, keys);
    warn_of_mixture(contents, keys, "this tissue holds");
}

/// Warns of anthocyanins and betalains in unlike cells of one body; what the body itself holds is
/// told there.
fn warn_of_mixed_cells(plan: &SolidPlan, keys: &Keys<'_>) {
    let cells = plan.mosaic.iter().flat_map(|mosaic| &mosaic.contents);
    // Under a mosaic the body itself shows only where no cell may be.
    let shows = |mosaic: &MosaicPattern| mosaic.may_leave_bare();
    let own = plan.mosaic.as_ref().is_none_or(shows);
    let parts = own.then_some(&plan.contents).into_iter().chain(cells);
    if plan.contents.mixes_betalains_and_anthocyanins() {
        return;
    }
    let most = parts.fold(Contents::NOTHING, |most, part| {
        Contents(most.zip_with(part.0, f64::max))
    });
    warn_of_mixture(&most, keys, "cells of this body hold");
}

const SHAPES: [Variant<SolidShape>; 5] = [
    Variant {
        name: "sphere",
        about: "About the origin.",
        new: sphere,
        is: |shape| {
            matches!(shape, SolidShape::Ellipsoid { semi_axes_mm }
                if *semi_axes_mm == DVec3::splat(semi_axes_mm.x))
        },
        declare: |shape, keys| {
            if let SolidShape::Ellipsoid { semi_axes_mm } = shape {
                let mut radius = semi_axes_mm.x;
                keys.required("radius_mm", &mut radius, Number(EXTENTS_MM), "Its radius.");
                *semi_axes_mm = DVec3::splat(radius);
            }
        },
    },
    Variant {
        name: "ellipsoid",
        about: "About the origin.",
        new: sphere,
        is: |shape| matches!(shape, SolidShape::Ellipsoid { .. }),
        declare: |shape, keys| {
            if let SolidShape::Ellipsoid { semi_axes_mm } = shape {
                let axes = Vector(EXTENTS_MM);
                let about = "Half its extents along x, y and z.";
                keys.required("semi_axes_mm", semi_axes_mm, axes, about);
            }
        },
    },
    Variant {
        name: "rounded_cube",
        about: "About the origin.",
        new: || SolidShape::RoundedCube {
            side_mm: 2e5,
            corner_radius_mm: 1.0,
        },
        is: |shape| matches!(shape, SolidShape::RoundedCube { .. }),
        declare: |shape, keys| {
            if let SolidShape::RoundedCube {
                side_mm,
                corner_radius_mm,
            } = shape
            {
                keys.required("side_mm", side_mm, Number(EXTENTS_MM), "Its side.");
                let radii = Number(Limits::above(0.0, 0.5 * *side_mm));
                let about = "Radius of the edges, half a side at most.";
                keys.required("corner_radius_mm", corner_radius_mm, radii, about);
            }
        },
    },
    Variant {
        name: "lathe",
        about: "Turned about the z axis.",
        new: || SolidShape::Lathe {
            profile_mm: Vec::new(),
        },
        is: |shape| matches!(shape, SolidShape::Lathe { .. }),
        declare: |shape, keys| {
            let SolidShape::Lathe { profile_mm } = shape else {
                return;
            };
            let mut points: Vec<[f64; 2]> = profile_mm.iter().map(DVec2::to_array).collect();
            let list = ListOf {
                of: Numbers::<2>(Limits::closed(-1e5, 1e5)),
                least: 2,
                most: 1000,
                wanted: "a list of 2 to 1000 points, [distance from the axis, height]",
            };
            let about = "Points from below, [distance from the axis, height].";
            keys.required("profile_mm", &mut points, list, about);
            *profile_mm = points.into_iter().map(DVec2::from_array).collect();
            // What the points make together is known once they are turned about the axis.
            if keys.is_sound()
                && let Err(error) = shape.area()
            {
                let help = "let the profile run from below, on one side of the axis";
                keys.refuse(&["profile_mm"], error.to_string(), help);
            }
        },
    },
    Variant {
        name: "mesh",
        about: "A file.",
        new: || {
            SolidShape::Mesh(Arc::new(SolidMesh {
                file: String::new(),
                scale_mm: 1.0,
                shape: Shape {
                    positions: Vec::new(),
                    normals: Vec::new(),
                    faces: Vec::new(),
                },
            }))
        },
        is: |shape| matches!(shape, SolidShape::Mesh(_)),
        declare: |shape, keys| {
            if let SolidShape::Mesh(mesh) = shape {
                declare_mesh(mesh, keys);
            }
        },
    },
];

fn declare_mesh(mesh: &mut Arc<SolidMesh>, keys: &mut Keys<'_>) {
    let (mut file, mut scale_mm) = (mesh.file.clone(), mesh.scale_mm);
    let path = Text("the path of a PLY or OBJ file");
    keys.required("path", &mut file, path, "The file.");
    let limits = Number(Limits::above(0.0, 1e6));
    keys.key("scale_mm", &mut scale_mm, limits, "The file's unit.");
    if keys.reader().is_none() || !keys.is_sound() {
        return;
    }
    let Some((assets, found, at)) = asset(keys, "path", &["ply", "obj"]) else {
        return;
    };
    let shape = assets.mesh(&found, scale_mm).and_then(|read| {
        if let (Some(dropped), Some(block)) = (&read.dropped, keys.reader()) {
            let code = "scene::faces_left_out";
            let help = "mend the mesh: each face has an area and corners of its own";
            block.cx.warn(&at, code, dropped.clone(), help);
        }
        shape_of(read)
    });
    match (shape, keys.reader()) {
        (Ok(shape), _) => {
            *mesh = Arc::new(SolidMesh {
                file,
                scale_mm,
                shape,
            });
        }
        (Err((problem, help)), Some(block)) => bad_file(block.cx, &at, &file, &problem, help),
        (Err(_), None) => {}
    }
}

/// A mesh on which cells can live, with normals of length 1.
fn shape_of(read: Triangles) -> Result<Shape, (String, &'static str)> {
    const MEND: &str = "mend the mesh: each edge has at most two faces, both turned the same way, and the faces around a point hang together";
    let Triangles {
        positions, faces, ..
    } = read;
    Surface::new(positions.clone(), faces.clone())
        .and_then(|surface| surface.check_vertices())
        .map_err(|error| (error.to_string(), MEND))?;
    let Some(normals) = read.normals else {
        return Ok(creased(&positions, &faces));
    };
    // Those that have none are the mean of the faces around.
    let smooth = smooth_normals(&positions, &faces);
    let both = normals.iter().zip(smooth);
    let normals = both.map(|(normal, smooth)| normal.try_normalize().unwrap_or(smooth));
    Ok(Shape {
        normals: normals.collect(),
        positions,
        faces,
    })
}
