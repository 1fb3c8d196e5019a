//! Round trips through text: bodies, and blocks that name pictures and meshes.

use std::fmt::Write as _;
use std::path::Path;

use glam::DVec3;
use leafmodel::document::written::Extent;
use leafmodel::mosaic::control::{ControlImage, CylinderControl, Steered};
use leafmodel::mosaic::pattern::{LeafFaces, MosaicPattern};
use leafmodel::mosaic::plan::{CellType, MosaicPlan};
use leafmodel::optics::betalains::Betalains;
use leafmodel::optics::solid::{SCATTERING_PER_MM, Solid as Tissue};
use leafmodel::optics::{Constituent, Contents, PerConstituent, Pigments, Texel};
use leafmodel::plan_file::leaf_to_toml;
use leafmodel::solid::{Raised, SolidPlan, SolidShape};
use proptest::prelude::*;

use super::*;
use crate::scene::description::{Coat, SolidOptics};
use properties::fixed;

const PLAIN: &str = "format = 1
[leaves.beech]
length_mm = 80
outline.cubic = {}
venation.arcuate = {}
[leaves.beech.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
";

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
        (1.0..100.0).prop_map(|radius_mm| SolidShape::Sphere { radius_mm }),
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
    #![proptest_config(fixed(256))]

    #[test]
    fn a_body_that_is_written_reads_back_to_the_same_plan(
        shape in shapes(),
        optics in (0.1..5.0, prop_oneof![Just(SCATTERING_PER_MM), 0.1..5.0], 1.0..2.0),
        coat in prop_oneof![Just(None), (1.0..2.0, 0.02..1.0).prop_map(Some)],
        held in prop::collection::vec(prop_oneof![Just(0.0), 0.0..1.0], Constituent::COUNT),
        packaging in 0.1..1.0,
        (seed, map_size, patterned) in (any::<u64>(), 16_u32..2000, any::<bool>()),
    ) {
        let contents = Contents(PerConstituent::from_fn(|one| held[one as usize]))
            .with(&[
                (Constituent::Structure, 1.0),
                (Constituent::Proteins, 0.0),
                (Constituent::CarbonBased, 0.0),
                (Constituent::Extra, 0.0),
            ]);
        let (depth_mm, scattering_per_mm, eta) = optics;
        let (coat_eta, alpha) = coat.unwrap_or((eta, 0.3));
        let solid = Solid {
            plan: SolidPlan {
                shape,
                seed,
                contents,
                mosaic: patterned.then(|| pattern(contents)),
                raised: (patterned && seed % 2 == 0).then(|| Raised {
                    heights_mm: vec![0.0, packaging],
                    over_mm: 2.0 * packaging,
                }),
                pigments: Pigments {
                    betalains: Betalains { packaging, ..Betalains::default() },
                    ..Pigments::default()
                },
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

#[test]
fn faces_that_a_mesh_of_a_body_loses_are_reported() {
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
        "1 face left out (0 not finite, 1 without area, 0 duplicate)",
        "path = \"ball.obj\"",
    ] {
        assert!(told[0].contains(part), "{}", told[0]);
    }
}

#[test]
fn pictures_of_layers_are_read_and_written_back_by_their_paths() {
    use leafmodel::blade::layers::Change;
    use leafmodel::blade::masks::Mask;

    use crate::export::mitsuba::map_picture;
    use crate::image::{openexr, portable_network};
    use crate::material::contents_texture::ContentsTexture;

    let folder = tempfile::tempdir().expect("a folder");
    let grey = [0, 0, 0, 51, 51, 51, 255, 255, 255, 102, 102, 102];
    portable_network::write(&folder.path().join("rim.png"), 2, 2, &grey).expect("a picture");
    let texel = Texel::from_fn(|constituent| constituent.least() as f32 + 0.5);
    let texels = vec![texel; 6];
    let map = map_picture(&ContentsTexture::new(3, 2, texels));
    openexr::write(&map, &folder.path().join("map.exr")).expect("a map");
    let text = PLAIN.to_owned()
        + "[leaves.beech.layers.all]\nmap = \"map.exr\"\n\
           [leaves.beech.layers.rim]\nimage = { file = \"rim.png\" }\ncontents = { brown = 1 }\n\
           [leaves.beech.layers.part]\nimage = { file = \"map.exr\", channel = \"brown\" }\ncontents = { brown = 1 }\n";
    let read = |text: &str| match parse_leaves(text, "beech", folder.path(), &[]) {
        Ok(mut leaves) => leaves.remove(0).value.plan,
        Err(errors) => panic!("{errors}\n{text}"),
    };
    let plan = read(&text);
    let [all, rim, part] = plan.layers.as_slice() else {
        panic!("three layers: {:?}", plan.layers);
    };
    assert!(matches!(&all.change, Change::Map(map) if map.texels == [*texel.as_array(); 6]));
    // Values as stored, not linear light; the lowest row first.
    let share = |byte: u8| [f32::from(byte) / 255.0];
    let weights = [255, 102, 0, 51].map(share);
    assert!(matches!(&rim.mask, Mask::Picture(picture) if picture.texels == weights));
    assert!(matches!(&part.mask, Mask::Picture(picture) if picture.texels == [[0.5]; 6]));
    assert_eq!(read(&leaf_to_toml("beech", &plan, Extent::Changed)), plan);
}

#[test]
fn raised_tissue_is_of_types_that_the_mosaic_has() {
    let body = "format = 1\n[solids.cap]\nraised = { heights_mm = { wrt = 1.0 } }\n\
        [solids.cap.shape.sphere]\nradius_mm = 10\n[solids.cap.contents]\nwater_cm = 0.01\n";
    let mosaic = "[solids.cap.mosaic]\ndays = 1\n\
        [solids.cap.mosaic.types.wart]\ninitial_share = 1\n";
    let refused = |text: String| match parse(&text, "cap.toml", Path::new("."), &[]) {
        Ok(_) => panic!("it is taken: {text}"),
        Err(errors) => errors.to_string(),
    };
    let with = refused(body.to_owned() + mosaic + SCENE);
    assert!(
        with.contains("`wrt` is no type of cell of the mosaic"),
        "{with}"
    );
    assert!(with.contains("write one of wart"), "{with}");
    let without = refused(body.to_owned() + SCENE);
    assert!(without.contains("give the body a `mosaic`"), "{without}");
}

#[test]
fn a_scene_has_the_name_of_its_file_in_every_script() {
    for (file, name) in [
        ("Blätter.toml", "Blätter"),
        ("Bla\u{308}tter.toml", "Bla\u{308}tter"),
        ("my leaf (2).toml", "my-leaf--2-"),
        ("葉.toml", "葉"),
        ("a.b.toml", "a-b"),
    ] {
        assert_eq!(default_name(Path::new(file)), name);
    }
    let long = default_name(Path::new(&format!("{}.toml", "葉".repeat(80))));
    assert!(
        long.len() <= 200 && long.chars().all(|letter| letter == '葉'),
        "{long}"
    );
}

#[test]
fn the_plan_of_a_plant_is_what_its_keys_say() {
    let scene = SCENE.replace("solid = \"fruit\"", "plant = \"shoot\"");
    let text = format!(
        "{PLAIN}{scene}[plants.shoot]\nleaf = \"beech\"\nseed = 3\nindividuals = 2\n\
         nodes = 5\nper_node = 2\ndivergence_deg = 100\n[plants.shoot.branches]\norder = 2\nshare = 0.8\n\
         [plants.shoot.posture]\nlight = [0, 1, 1]\ncluster = 3\n[plants.shoot.buds]\nlength_mm = 3\n"
    );
    let opened = Opened::text(&text, "shoot.toml", Path::new("."), &[], schema);
    let opened = opened.expect("it is a document");
    let purpose = Purpose::Picture;
    let authored = blocks::read(&opened.cx, &opened.tree, "shoot", String::new(), purpose);
    let read = opened.finish(authored);
    let (mut authored, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
    let plan = authored.plants.remove(0).value.plan;
    assert_eq!((plan.seed, plan.individuals, plan.axis.nodes), (3, 2, 5));
    let phyllotaxis = plan.axis.phyllotaxis;
    assert_eq!((phyllotaxis.per_node, plan.posture.cluster), (2, 3));
    let off = phyllotaxis.divergence - 100_f64.to_radians();
    assert!(off.abs() < 1e-12, "{off}");
    let branching = plan.branching.expect("it has branches");
    assert_eq!((branching.order, branching.share), (2, 0.8));
    assert_eq!(plan.buds.expect("it has buds").length_mm, 3.0);
    assert!((plan.posture.light.y - 0.5_f64.sqrt()).abs() < 1e-12);
}
