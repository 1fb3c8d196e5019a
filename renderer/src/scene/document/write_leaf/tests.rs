mod bodies;
mod outlines;
pub(in crate::scene::document) mod palettes;
mod patterns;
mod veins;

use leafmodel::blade::petiole::PetiolePlan;
use leafmodel::compound::{Arrangement, CompoundForm, Feather};
use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::optics::{Constituent, Contents, PerConstituent, Pigments, Texel};
use leafmodel::shape::contour_curve::{ContourCurve, ControlPoint};
use leafmodel::shape::cubic_margin::CubicMargin;
use leafmodel::shape::growth::RateCurve;
use leafmodel::shape::growth_form::{
    Axis, GrowthForm, HalfForm, LateralGrowth, SecondaryAxis, VeinRow,
};
use leafmodel::shape::svg_path::SvgContour;
use leafmodel::shape::teeth::ToothWave;
use leafmodel::transport::{FilledPlan, Ladder, TransportPlan, VeinStyle};
use leafmodel::venation::arcuate::{ArcuatePlan, PalmateVeins};
use leafmodel::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use self::bodies::{petiole_or_compound, tissue_and_form};
use self::outlines::{contour, teeth};
use self::palettes::pigments;
use self::patterns::{layers_by_chance, mosaic_by_chance, senescence};
use self::veins::venation;
use super::*;
use crate::scene::document::outline::STEPS;
use crate::scene::load::{leaf_to_toml, parse_leaves};

const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\">\
    <path d=\"M0 0H9V9Z\"/><path id=\"kite\" d=\"M5 9 C6 8 6 7 5 5 L4 7 Z\"/></svg>";

/// One of these for each constituent.
pub(in crate::scene::document) fn of_each<S: Strategy>(
    one: S,
) -> impl Strategy<Value = PerConstituent<S::Value>> {
    let values = prop::array::uniform::<_, { Constituent::COUNT }>(one);
    values.prop_map(PerConstituent::new)
}

fn ovate() -> GrowthForm {
    HalfForm::entire(1.2, 0.3, 3.0).into()
}

fn plain() -> LeafPlan {
    LeafPlan {
        length_mm: 80.0,
        seed: 0,
        outline: Contour::GrowthAlgorithm(ovate()).into(),
        venation: AuxinPlan::default().into(),
        tissue: default_tissue(Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.006),
        ])),
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        form: default_form(80.0),
        petiole: None,
        compound: None,
        pigments: Pigments::default(),
        map_size: 1024,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    #[test]
    fn a_written_plan_reads_back_to_the_same(
        contour in contour(), teeth in teeth(), venation in venation(), (tissue, form) in tissue_and_form(),
        seed in any::<u64>(), map_size in 16_u32..8192, senescence in senescence(), stalks in petiole_or_compound(),
        layers in layers_by_chance(), mosaic in mosaic_by_chance(), pigments in pigments(),
    ) {
        let outline = OutlinePlan { contour, teeth };
        let (petiole, compound) = stalks;
        let plan = LeafPlan { length_mm: 80.0, seed, outline, venation, tissue, layers, mosaic, senescence, form, petiole, compound, pigments, map_size };
        // Only cells that earn anything die when they do not.
        let plan = LeafPlan { senescence: plan.senescence.filter(|_| plan.check_senescence().is_ok()), ..plan };
        // What cannot be grown is refused by the reader, as it should be.
        prop_assume!(plan.check_lamina().is_ok());
        // It tries the outline at 1 mm, where teeth on a ragged margin may just touch.
        prop_assume!(plan.outline.grow(1.0, seed).is_ok());
        prop_assume!(plan.compound.as_ref().is_none_or(|form| form.arrange(&plan).is_ok()));
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("leaf.svg"), SVG).expect("the folder was just made");
        let text = leaf_to_toml("beech", &plan);
        let leaves = match parse_leaves(&text, "beech", folder.path(), &[]) {
            Ok(leaves) => leaves,
            Err(errors) => return Err(TestCaseError::fail(format!("{errors}\n{text}"))),
        };
        prop_assert_eq!(&leaves[0].value.plan, &plan, "{}", text);
        prop_assert_eq!(leaf_to_toml("beech", &leaves[0].value.plan), text);
    }

    #[test]
    fn whole_degrees_stay_whole(angle in -355..355_i32) {
        prop_assert_eq!(degrees(f64::from(angle).to_radians()), f64::from(angle));
    }
}

#[test]
fn layers_and_days_read_back_to_the_same() {
    use leafmodel::blade::ageing_courses::{COURSES, LITTER};
    use leafmodel::blade::layers::{Change, Layer, Mode};
    use leafmodel::blade::masks::{Mask, RimWidth};

    let folder = tempfile::tempdir().expect("a folder");
    let mut number = 0;
    let mut layer = |mask, mode, share| {
        number += 1;
        let values = PerConstituent::splat(None).with(&[
            (Constituent::ALL[number], Some(0.25)),
            (Constituent::Brown, Some(1.0)),
        ]);
        Layer {
            name: format!("layer-{number}"),
            mask,
            share,
            change: Change::Values { mode, values },
        }
    };
    let rim = |width| Mask::Margin {
        width,
        softness_mm: 0.7,
        wander: 0.4,
        wander_scale_mm: 8.0,
    };
    let layers = vec![
        layer(Mask::Everywhere, Mode::Replace, 1.0),
        layer(rim(RimWidth::Mm(3.0)), Mode::Add, 0.5),
        layer(rim(RimWidth::HalfWidths(0.3)), Mode::Multiply, 0.25),
        layer(
            Mask::Veins {
                orders: [2, 4],
                width_mm: 0.6,
                softness_mm: 0.5,
                outside: true,
            },
            Mode::Multiply,
            1.0,
        ),
        layer(
            Mask::Midrib {
                width_mm: 2.0,
                softness_mm: 1.0,
            },
            Mode::Replace,
            1.0,
        ),
        layer(Mask::BaseToTip { from: 0.9, to: 0.1 }, Mode::Replace, 1.0),
        layer(
            Mask::Noise {
                scale_mm: 3.0,
                threshold: -0.2,
                softness: 0.5,
                repeat_cells: Some(6),
            },
            Mode::Replace,
            0.0,
        ),
    ];
    for (name, mut course) in COURSES {
        course.half_days = 12.5;
        course.onset.tip_days = -3.0;
        course.death.veins_order = 3;
        let plan = LeafPlan {
            layers: layers.clone(),
            senescence: Some(Senescence {
                source: AgeSource::Day { day: 21.5, course },
                blend: 6.0,
                contents: LITTER.with(&[(Constituent::Brown, 0.8)]),
            }),
            ..plain()
        };
        let text = leaf_to_toml("beech", &plan);
        let leaves = parse_leaves(&text, "beech", folder.path(), &[]);
        let leaves = leaves.unwrap_or_else(|errors| panic!("{name}: {errors}\n{text}"));
        assert_eq!(leaves[0].value.plan, plan, "{text}");
        // By its name alone.
        let named = text.replace("day = 21.5", &format!("day = 21.5\ncourse = \"{name}\""));
        assert!(parse_leaves(&named, "beech", folder.path(), &[]).is_ok());
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
    let text = leaf_to_toml("beech", &plain())
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
    // As written, not as light; the lowest row first.
    let share = |byte: u8| [f32::from(byte) / 255.0];
    let weights = [255, 102, 0, 51].map(share);
    assert!(matches!(&rim.mask, Mask::Picture(picture) if picture.texels == weights));
    assert!(matches!(&part.mask, Mask::Picture(picture) if picture.texels == [[0.5]; 6]));
    assert_eq!(read(&leaf_to_toml("beech", &plan)), plan);
}

#[test]
fn a_mosaic_with_all_that_it_can_have_reads_back_to_the_same() {
    use leafmodel::mosaic::pattern::LeafFaces;

    let folder = tempfile::tempdir().expect("a folder");
    let grey = [0, 0, 0, 51, 51, 51, 255, 255, 255, 102, 102, 102];
    crate::image::portable_network::write(&folder.path().join("g.png"), 2, 2, &grey)
        .expect("a picture");
    let mosaic = r#"
[leaves.beech.mosaic]
cells = 300
days = 12.5
radius_weight = 2
relaxations_per_day = 3
step = 0.05
initial_relaxations = 20
initial_step = 0.01
radius = "daily"
blend_mm = 0.4
faces = "both"
growth = { start = [0.3, 0.2, 1], middle = 0.4, steepness = 6 }
[leaves.beech.mosaic.types.yellow]
initial_share = 0.25
division_days = 6
adhesion = { yellow = 0.5, white = 0.2 }
contents = { chlorophyll_ug_per_cm2 = 3, betaxanthins_ug_per_cm2 = 2 }
[leaves.beech.mosaic.types.green]
initial_share = 0.5
division_days = 9
switching = { yellow = 0.125 }
[leaves.beech.mosaic.types.white]
initial_share = 0.25
[leaves.beech.mosaic.controls.a]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
radius_mm = 20
steers = "initial_type"
type = "yellow"
stripes = { count = 5, share = 0.3, waviness = 0.1 }
[leaves.beech.mosaic.controls.b]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "division_rate"
low = 0.5
rings = { count = 4 }
[leaves.beech.mosaic.controls.c]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "adhesion"
type = "yellow"
other_type = "green"
noise = { around = 3, octaves = 2, threshold = 0.5, seed = 7 }
[leaves.beech.mosaic.controls.d]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "blocked"
picture = { path = "g.png" }
[leaves.beech.mosaic.controls.e]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "division_rate"
type = "green"
constant = 0.5
"#;
    let read = |text: &str| match parse_leaves(text, "beech", folder.path(), &[]) {
        Ok(mut leaves) => leaves.remove(0).value.plan,
        Err(errors) => panic!("{errors}\n{text}"),
    };
    let plan = read(&(leaf_to_toml("beech", &plain()) + mosaic));
    let pattern = plan.mosaic.as_ref().expect("it has a mosaic");
    assert_eq!(pattern.validate(), Ok(()));
    assert_eq!(pattern.faces, LeafFaces::Both);
    let [yellow, green, white] = pattern.plan.types.as_slice() else {
        panic!("three types: {:?}", pattern.plan.types);
    };
    assert_eq!(green.switching, [0.125, 0.875, 0.0]);
    assert_eq!((white.adhesion[0], yellow.adhesion[2]), (0.2, 0.2));
    assert_eq!(white.division_days, f64::INFINITY);
    assert_eq!(pattern.contents[0][Constituent::Betaxanthins], 2.0);
    assert_eq!(pattern.contents[1], plan.tissue.lamina);
    assert_eq!(pattern.plan.controls.len(), 5);
    assert_eq!(read(&leaf_to_toml("beech", &plan)), plan);
}

#[test]
fn what_has_its_default_is_left_out() {
    assert_eq!(
        leaf_to_toml("beech", &plain()),
        "format = 1

[leaves.beech]
length_mm = 80

[leaves.beech.outline.growth_algorithm]
rate_ratio = 1.2
widest_at = 0.3
falloff = 3

[leaves.beech.venation.closed]
final_length_segments = 350
kill_distance_segments = 1
birth_distance_segments = 2
darts_per_segment2 = 0.0002
veinlet_radius_mm = 0.02

[leaves.beech.venation.closed.growth.isogonic]
initial_length_segments = 11.5
length_step_segments = 0.9

[leaves.beech.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
"
    );
}
