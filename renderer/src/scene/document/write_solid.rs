//! A body of solid tissue as the block of a file that reads back to it.
//!
//! The mirror image of [`super::solid`]: same keys, same defaults.

use glam::DVec3;
use leafmodel::optics::Contents;
use leafmodel::optics::solid::{ETA, SCATTERING_PER_MM};
use leafmodel::solid::SolidShape;

use super::leaf::MAP_SIZE;
use super::solid::{COAT_ALPHA, DEPTH_MM, NOTHING};
use super::tree::Value;
use super::write;
use super::write_leaf::{Keys, list, mosaic, number, pigments};
use crate::scene::description::{Solid, SolidOptics};

/// Text of a file with `format = 1` and the one body.
pub(crate) fn to_toml(name: &str, body: &Solid) -> String {
    let mut root = Keys::default();
    root.integer("format", 1);
    root.block("solids", Keys::default().with(name, solid(body)));
    write::to_toml(&root.0)
}

fn solid(body: &Solid) -> Keys {
    let plan = &body.plan;
    let mut keys = Keys::default();
    if plan.seed != 0 {
        keys.integer("seed", plan.seed);
    }
    if u64::from(plan.map_size) != MAP_SIZE {
        keys.integer("map_size", plan.map_size.into());
    }
    optics(&mut keys, &body.optics);
    let (kind, block) = shape(&plan.shape);
    keys.block("shape", Keys::default().with(kind, block));
    keys.block("contents", contents(&plan.contents));
    if let Some(pattern) = &plan.mosaic {
        keys.block("mosaic", mosaic(pattern));
    }
    keys.block_if_any("pigments", pigments(&plan.pigments));
    keys
}

fn optics(keys: &mut Keys, optics: &SolidOptics) {
    let (tissue, coat) = (&optics.tissue, &optics.coat);
    keys.number_unless("depth_mm", tissue.depth_mm, DEPTH_MM);
    let scattering = tissue.scattering_per_mm;
    keys.number_unless("scattering_per_mm", scattering, SCATTERING_PER_MM);
    keys.number_unless("eta", tissue.eta, ETA);
    let mut block = Keys::default();
    block.number_unless("eta", coat.eta, tissue.eta);
    block.number_unless("alpha", coat.alpha_across, COAT_ALPHA);
    keys.block_if_any("coat", block);
}

/// What of contents is there.
fn contents(contents: &Contents) -> Keys {
    let mut keys = Keys::default();
    for (constituent, value) in **contents {
        keys.number_unless(constituent.key(), value, NOTHING[constituent]);
    }
    keys
}

fn shape(shape: &SolidShape) -> (&'static str, Keys) {
    let mut keys = Keys::default();
    let kind = match shape {
        SolidShape::Ellipsoid { semi_axes_mm } if *semi_axes_mm == DVec3::splat(semi_axes_mm.x) => {
            keys.number("radius_mm", semi_axes_mm.x);
            "sphere"
        }
        SolidShape::Ellipsoid { semi_axes_mm } => {
            keys.value("semi_axes_mm", list(semi_axes_mm.to_array().map(number)));
            "ellipsoid"
        }
        SolidShape::RoundedCube {
            side_mm,
            corner_radius_mm,
        } => {
            keys.number("side_mm", *side_mm);
            keys.number("corner_radius_mm", *corner_radius_mm);
            "rounded_cube"
        }
        SolidShape::Lathe { profile_mm } => {
            let points = profile_mm.iter();
            let points = points.map(|point| list(point.to_array().map(number)));
            keys.value("profile_mm", list(points));
            "lathe"
        }
        SolidShape::Mesh(mesh) => {
            keys.value("path", Value::Text(mesh.file.clone()));
            keys.number_unless("scale_mm", mesh.scale_mm, 1.0);
            "mesh"
        }
    };
    (kind, keys)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use leafmodel::mosaic::control::{ControlImage, CylinderControl, Steered};
    use leafmodel::mosaic::pattern::{LeafFaces, MosaicPattern};
    use leafmodel::mosaic::plan::{CellType, MosaicPlan};
    use leafmodel::optics::solid::Solid as Tissue;
    use leafmodel::solid::SolidPlan;
    use proptest::prelude::*;

    use super::*;
    use crate::scene::description::Coat;
    use crate::scene::load::{parse, solid_to_toml};
    use leafmodel::optics::Constituent;

    const SCENE: &str = "[film.rgb]\nsize = [4, 4]\nspp = 1\n[camera.perspective]\n\
        position_m = [0, -1, 0]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 40\n\
        [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n[objects.fruit]\nsolid = \"fruit\"\n";

    fn read_back(solid: &Solid, folder: &Path) -> Solid {
        let text = solid_to_toml("fruit", solid) + SCENE;
        let loaded = parse(&text, "fruit.toml", folder, &[]);
        let mut scene = loaded.unwrap_or_else(|errors| panic!("{errors}\n{text}"));
        scene.description.solids.remove(0).value
    }

    fn pattern(held: Contents) -> MosaicPattern {
        let kind = |name: &str, days, own: f64| CellType {
            name: name.to_owned(),
            division_days: days,
            initial_probability: own,
            switching: vec![own, 1.0 - own],
            adhesion: vec![0.5, 0.25],
        };
        MosaicPattern {
            plan: MosaicPlan {
                days: 3.0,
                types: vec![kind("pale", 10.0, 0.75), {
                    let mut dark = kind("dark", f64::INFINITY, 0.25);
                    dark.adhesion = vec![0.25, 0.0];
                    dark
                }],
                controls: vec![CylinderControl {
                    from: DVec3::new(0.0, 0.0, -9.0),
                    to: DVec3::new(0.0, 0.0, 9.0),
                    radius_mm: None,
                    image: ControlImage::Rings {
                        count: 3,
                        share: 0.25,
                    },
                    steers: Steered::InitialType(1),
                }],
                ..MosaicPlan::default()
            },
            contents: vec![held, held.with(&[(Constituent::Chlorophyll, 60.0)])],
            blend_mm: 1.5,
            faces: LeafFaces::Through,
        }
    }

    fn shapes() -> impl Strategy<Value = SolidShape> {
        prop_oneof![
            (1.0..100.0).prop_map(|radius| SolidShape::Ellipsoid {
                semi_axes_mm: DVec3::splat(radius)
            }),
            (1.0..100.0, 1.0..100.0, 1.0..100.0).prop_map(|(x, y, z)| SolidShape::Ellipsoid {
                semi_axes_mm: DVec3::new(x, y, z)
            }),
            (1.0..100.0, 0.1..0.5).prop_map(|(side_mm, share)| SolidShape::RoundedCube {
                side_mm,
                corner_radius_mm: share * side_mm
            }),
            (1.0..100.0, 1.0..100.0).prop_map(|(wide, tall)| SolidShape::Lathe {
                profile_mm: [(0.0, 0.0), (wide, 0.5 * tall), (0.0, tall)]
                    .map(glam::DVec2::from)
                    .to_vec()
            }),
        ]
    }

    proptest! {
        #[test]
        fn a_body_that_is_written_reads_back_to_the_same_plan(
            shape in shapes(),
            optics in (0.1..5.0, prop_oneof![Just(SCATTERING_PER_MM), 0.1..5.0], 1.0..2.0),
            coat in prop_oneof![Just(None), (1.0..2.0, 0.02..1.0).prop_map(Some)],
            held in super::super::write_leaf::tests::of_each(prop_oneof![Just(0.0), 0.0..1.0]),
            pigments in super::super::write_leaf::tests::palettes::pigments(),
            (seed, map_size, patterned) in (any::<u64>(), 16_u32..2000, any::<bool>()),
        ) {
            let contents = Contents(held).with(&[(Constituent::Structure, 1.0)]);
            let (depth_mm, scattering_per_mm, eta) = optics;
            let (coat_eta, alpha) = coat.unwrap_or((eta, COAT_ALPHA));
            let solid = Solid {
                plan: SolidPlan {
                    shape,
                    seed,
                    contents,
                    mosaic: patterned.then(|| pattern(contents)),
                    pigments,
                    map_size,
                },
                optics: SolidOptics {
                    tissue: Tissue { depth_mm, scattering_per_mm, eta },
                    coat: Coat { eta: coat_eta, alpha_across: alpha, alpha_along: alpha },
                },
                extrapolate: false,
            };
            let back = read_back(&solid, Path::new("."));
            prop_assert_eq!(back.plan, solid.plan);
            prop_assert_eq!(back.optics, solid.optics);
        }
    }

    #[test]
    fn a_mesh_is_written_as_the_file_that_it_comes_from() {
        let folder = tempfile::tempdir().expect("a folder");
        let corners = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n";
        let text = format!("{corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        std::fs::write(folder.path().join("stone.obj"), text).expect("a file");
        let text = "format = 1\n[solids.fruit.shape.mesh]\npath = \"stone.obj\"\nscale_mm = 2.5\n\
            [solids.fruit.contents]\nbrown = 1\n";
        let loaded = parse(&(text.to_owned() + SCENE), "fruit.toml", folder.path(), &[]);
        let mut scene = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        let solid = scene.description.solids.remove(0).value;
        assert_eq!(read_back(&solid, folder.path()).plan, solid.plan);
    }
}
