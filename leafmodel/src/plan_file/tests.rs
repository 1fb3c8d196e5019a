mod bodies;
mod outlines;
mod palettes;
mod patterns;
mod veins;

use crate::blade::petiole::PetiolePlan;
use crate::compound::{Arrangement, CompoundForm, Feather};
use crate::development::{DevelopmentPlan, MainVeinStyle, Primordium, Sequence, Wave};
use crate::leaf::outline_plan::{Contour, OutlinePlan};
use crate::optics::{Constituent, Contents, PerConstituent, Pigments};
use crate::shape::contour_curve::{ContourCurve, ControlPoint};
use crate::shape::cubic_margin::CubicMargin;
use crate::shape::growth::RateCurve;
use crate::shape::growth_form::{
    Axis, GrowthForm, HalfForm, LateralGrowth, SecondaryAxis, VeinRow,
};
use crate::shape::specimen::{ApexShape, Asymmetry, BaseShape, Specimen};
use crate::shape::svg_path::SvgContour;
use crate::shape::teeth::ToothWave;
use crate::shape::tips::{Gland, Point, Tip};
use crate::transport::{FilledPlan, Ladder, TransportPlan, VeinStyle};
use crate::venation::arcuate::{ArcuatePlan, PalmateVeins};
use crate::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern,
};
use proptest::prelude::*;

use self::bodies::{hairs, petiole_or_compound, surface, tissue_and_form};
use self::outlines::{contour, damage, specimen, teeth};
use self::palettes::pigments;
use self::patterns::{layers_by_chance, mosaic_by_chance, senescence};
use self::veins::venation;
use super::{Extent, leaf_to_toml, parse};
use crate::blade::BladeForm;
use crate::blade::senescence::{AgeSource, Senescence};
use crate::blade::stance::Stance;
use crate::blade::tissue::Tissue;
use crate::leaf::LeafPlan;
use crate::leaf::damage::{Damage, Dieback};
use crate::leaf::venation_plan::VenationPlan;
use properties::fixed;

fn to_toml(plan: &LeafPlan) -> String {
    leaf_to_toml("beech", plan, Extent::Changed)
}

const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\">\
    <path d=\"M0 0H9V9Z\"/><path id=\"kite\" d=\"M5 9 C6 8 6 7 5 5 L4 7 Z\"/></svg>";

/// One of these for each constituent.
pub(super) fn of_each<S: Strategy>(one: S) -> impl Strategy<Value = PerConstituent<S::Value>> {
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
        tissue: Tissue::of(Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.006),
        ])),
        unevenness: None,
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        form: BladeForm::nearly_flat(80.0),
        stance: Stance::default(),
        surface: None,
        hairs: Vec::new(),
        petiole: None,
        compound: None,
        damage: None,
        pigments: Pigments::default(),
        map_size: 1024,
    }
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn a_written_plan_reads_back_to_the_same(
        contour in contour(), teeth in teeth(), specimen in specimen(), venation in venation(), (tissue, form) in tissue_and_form(),
        seed in any::<u64>(), map_size in 16_u32..8192, senescence in senescence(), stalks in petiole_or_compound(),
        layers in layers_by_chance(), mosaic in mosaic_by_chance(), pigments in pigments(), damage in damage(),
        (stance, surface, hairs, unevenness) in (bodies::stance(), surface(), hairs(), bodies::unevenness()),
    ) {
        let outline = OutlinePlan { teeth, specimen, contour };
        let (petiole, compound) = stalks;
        let plan = LeafPlan { length_mm: 80.0, seed, outline, venation, tissue, unevenness, layers, mosaic, senescence, form, stance, surface, hairs, petiole, compound, pigments, map_size, damage };
        // Only cells that earn anything die when they do not.
        let plan = LeafPlan { senescence: plan.senescence.filter(|_| plan.check_senescence().is_ok()), ..plan };
        // What cannot be grown is refused by the reader, as it should be.
        prop_assume!(plan.check_lamina().is_ok());
        // It tries the outline at 1 mm, where teeth on a ragged margin may just touch.
        prop_assume!(plan.outline.grow(1.0, seed).is_ok());
        prop_assume!(plan.compound.as_ref().is_none_or(|form| form.arrange(&plan).is_ok()));
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("leaf.svg"), SVG).expect("the folder was just made");
        for extent in [Extent::Changed, Extent::All] {
            let text = leaf_to_toml("beech", &plan, extent);
            let leaves = match parse(&text, "beech", folder.path(), &[]) {
                Ok(leaves) => leaves,
                Err(errors) => return Err(TestCaseError::fail(format!("{errors}\n{text}"))),
            };
            prop_assert_eq!(&leaves[0].value, &plan, "{}", text);
            prop_assert_eq!(leaf_to_toml("beech", &leaves[0].value, extent), text);
        }
    }
}

#[test]
fn layers_and_days_read_back_to_the_same() {
    use crate::blade::ageing_courses::{COURSES, LITTER};
    use crate::blade::layers::{Change, Layer, Mode};
    use crate::blade::masks::{Mask, RimWidth};

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
        let text = to_toml(&plan);
        let leaves = parse(&text, "beech", folder.path(), &[]);
        let leaves = leaves.unwrap_or_else(|errors| panic!("{name}: {errors}\n{text}"));
        assert_eq!(leaves[0].value, plan, "{text}");
        // By its name alone.
        let named = text.replace("day = 21.5", &format!("day = 21.5\ncourse = \"{name}\""));
        assert!(parse(&named, "beech", folder.path(), &[]).is_ok());
    }
}

#[test]
fn a_mosaic_with_all_that_it_can_have_reads_back_to_the_same() {
    use crate::mosaic::pattern::LeafFaces;

    let folder = tempfile::tempdir().expect("a folder");
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
rings = { count = 9, share = 0.75 }
[leaves.beech.mosaic.controls.e]
from_mm = [0, 0, 0]
to_mm = [0, 80, 0]
steers = "division_rate"
type = "green"
constant = 0.5
"#;
    let read = |text: &str| match parse(text, "beech", folder.path(), &[]) {
        Ok(mut leaves) => leaves.remove(0).value,
        Err(errors) => panic!("{errors}\n{text}"),
    };
    let plan = read(&(to_toml(&plain()) + mosaic));
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
    assert_eq!(read(&to_toml(&plan)), plan);
}

#[test]
fn what_has_its_default_is_left_out() {
    assert_eq!(
        to_toml(&plain()),
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

#[test]
fn a_leaf_starts_from_another_leaf_of_the_file() {
    let read = |text: &str| {
        let text = format!("format = 1\n{text}");
        parse(&text, "x", std::path::Path::new("."), &[]).expect("it is sound")
    };
    let inherited = read(
        "[leaves.last]
        base = \"middle\"
        without = [\"outline\", \"blade.fold_deg\"]
        [leaves.middle]
        base = \"first\"
        length_mm = 30
        [leaves.first]
        preset = \"birch\"
        map_size = 64
        outline.curve.points = [[0, 0, \"corner\"], [0.3, 0.5], [0, 1, \"corner\"]]
        blade = { fold_deg = 3, curl_deg = 1 }",
    );
    let alone = read(
        "[leaves.last]
        preset = \"birch\"
        map_size = 64
        length_mm = 30
        blade.curl_deg = 1
        [leaves.middle]
        preset = \"birch\"
        map_size = 64
        length_mm = 30
        outline.curve.points = [[0, 0, \"corner\"], [0.3, 0.5], [0, 1, \"corner\"]]
        blade = { fold_deg = 3, curl_deg = 1 }",
    );
    assert_eq!(inherited.len(), 3);
    for (inherited, alone) in inherited.iter().zip(&alone) {
        assert_eq!(inherited.value, alone.value, "{}", alone.name);
    }
}
