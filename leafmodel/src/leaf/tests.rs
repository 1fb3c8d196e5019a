//! Whole leaves from plans.

mod combinations;

use proptest::prelude::*;

use crate::blade::BladeForm;
use crate::blade::stance::Stance;
use crate::blade::tissue::Tissue;
use crate::leaf::outline_plan::OutlinePlan;
use crate::leaf::venation_plan::VenationPlan;

use super::*;
use crate::leaf::outline_plan::Contour;
use crate::optics::Pigments;
use crate::optics::{Constituent, Contents, VeinFactors};
use crate::shape::growth_form::{Axis, GrowthForm, HalfForm, VeinRow};
use crate::transport::VeinStyle;
use crate::venation::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};
use properties::fixed;

fn outline_of(half: HalfForm) -> OutlinePlan {
    let midrib = Axis {
        rows: 80,
        ..half.into()
    };
    let form: GrowthForm = midrib.into();
    Contour::GrowthAlgorithm(form).into()
}

fn ovate() -> OutlinePlan {
    outline_of(HalfForm::entire(1.3, 0.4, 3.0))
}

fn auxin() -> AuxinPlan {
    AuxinPlan {
        pattern: Pattern::Closed(Neighbourhood::Relative),
        final_length: 100.0,
        kill_distance: 1.5,
        source_birth_distance: 3.0,
        vein_birth_distance: 3.0,
        darts_per_area: 0.01,
        growth: Growth::Marginal {
            initial_length: 15.0,
            length_step: 1.0,
        },
        murray_exponent: 2.0,
        veinlet_radius_mm: 0.03,
        ..AuxinPlan::default()
    }
}

/// A small broad leaf with everything that a leaf can have.
pub(super) fn plan() -> LeafPlan {
    LeafPlan {
        length_mm: 50.0,
        seed: 3,
        outline: ovate(),
        venation: auxin().into(),
        tissue: Tissue {
            lamina: Contents::of(&[
                (Constituent::Structure, 1.5),
                (Constituent::Chlorophyll, 40.0),
                (Constituent::Carotenoids, 9.0),
                (Constituent::Anthocyanins, 0.5),
                (Constituent::Brown, 0.01),
                (Constituent::Water, 0.01),
                (Constituent::DryMatter, 0.006),
            ]),
            vein_factors: VeinFactors::of(&[
                (Constituent::Structure, 1.3),
                (Constituent::Chlorophyll, 0.25),
                (Constituent::Carotenoids, 0.25),
                (Constituent::Water, 2.0),
                (Constituent::DryMatter, 2.5),
            ]),
            vein_body: None,
            full_vein_radius_mm: 0.25,
            sheath_width_mm: 0.1,
            mottle: 0.1,
            mottle_scale_mm: 2.0,
        },
        unevenness: None,
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        damage: None,
        form: BladeForm {
            fold: 0.3,
            curl: 0.5,
            ruffle: 0.01,
            ruffle_waves: 3.0,
            pleat: 0.0,
            relief: 0.5,
            thickness_mm: 0.2,
            margin: crate::blade::MarginThickness::EVEN,
            closed: false,
            max_edge_mm: 2.0,
            meshed_vein_radius_mm: 0.1,
        },
        stance: Stance::default(),
        surface: None,
        hairs: Vec::new(),
        petiole: None,
        compound: None,
        pigments: Pigments::default(),
        map_size: 64,
    }
}

proptest! {
    #![proptest_config(fixed(12))]
    #[test]
    fn grown_leaves_are_sound(
        rate_ratio in 1.1..1.8,
        widest_at in 0.15..0.8,
        falloff in 1.2..6.0,
        lobe_decay in 0.0..3.0,
        seed in 0_u64..1000,
    ) {
        let mut plan = plan();
        let lobe = |position| VeinRow::straight(position, 0.6);
        plan.outline = outline_of(HalfForm {
            lobe_decay,
            veins: [0.2, 0.4, 0.6, 0.8].map(lobe).to_vec(),
            ..HalfForm::entire(rate_ratio, widest_at, falloff)
        });
        plan.seed = seed;
        let leaf = Leaf::grow(&plan).expect("a good plan");
        prop_assert_eq!(leaf.lamina.network.validate(), Ok(()));
        prop_assert_eq!(leaf.mesh.validate(leaf.lamina.outline.area()), Ok(()));
        prop_assert!(leaf.mesh.uvs.iter().all(|uv| uv.min_element() >= -1e-12 && uv.max_element() <= 1.0 + 1e-12));
        let longer = leaf.contents.width.max(leaf.contents.height);
        prop_assert_eq!(longer, plan.map_size);
        for texel in &leaf.contents.texels {
            let contents = Contents::from_texel(*texel);
            prop_assert!(contents.checked().is_ok(), "{:?}", contents);
        }
    }
}

#[test]
fn the_same_plan_gives_the_same_leaf_bit_for_bit() {
    let one = Leaf::grow(&plan()).expect("a good plan");
    assert_eq!(one, Leaf::grow(&plan()).expect("a good plan"));
    let other = LeafPlan { seed: 4, ..plan() };
    assert_ne!(one, Leaf::grow(&other).expect("a good plan"));
}

#[test]
fn the_form_alone_is_that_of_the_whole_leaf() {
    let mut plan = crate::species::find("birch-autumn")
        .expect("a preset")
        .plan();
    plan.length_mm = 20.0;
    plan.venation = auxin().into();
    plan.map_size = 300;
    let whole = Leaf::grow(&plan).expect("a good plan");
    let form = Leaf::grow(&plan.form_alone().expect("good numbers")).expect("a good plan");
    assert_eq!(form.mesh, whole.mesh);
    assert_eq!(form.petiole, whole.petiole);
    assert!(form.contents.texels.len() <= 256);
    assert!(form.surface.is_some_and(|map| map.texels.len() <= 256));
    plan.tissue.mottle = -1.0;
    assert!(plan.form_alone().is_err());
}

#[test]
fn each_stage_refuses_in_its_own_name() {
    type Spoil = fn(&mut LeafPlan);
    let spoils: [(Spoil, &str); 6] = [
        (|p| p.length_mm = f64::NAN, "outline: length_mm"),
        (
            |p| {
                p.venation = AuxinPlan {
                    kill_distance: -1.0,
                    ..auxin()
                }
                .into();
            },
            "venation: kill_distance_segments is -1",
        ),
        (
            |p| {
                let style = VeinStyle {
                    base_radius_mm: 0.4,
                    least_cells: 3,
                };
                p.venation = VenationPlan::Cells(style);
            },
            "venation: veins of the cells need",
        ),
        (|p| p.form.curl = f64::INFINITY, "blade: curl_deg is inf"),
        (|p| p.tissue.mottle = 2.0, "tissue: mottle.share is 2"),
        (|p| p.map_size = 3, "tissue: map_size is 3"),
    ];
    for (spoil, start) in spoils {
        let mut plan = plan();
        spoil(&mut plan);
        let message = Leaf::grow(&plan).expect_err("a bad plan").to_string();
        assert!(message.starts_with(start), "{message}");
    }
}
