//! What tissue holds and reflects is as the file says: bodies of solid tissue, pigments, and what
//! never occurs together.

use glam::DVec3;
use leafmodel::document::declared::Declared as _;
use leafmodel::optics::betalains::{Betacyanin, Betalains, Betaxanthin};
use leafmodel::optics::pigments::{
    AnthocyaninMix, CarotenoidMix, ChlorophyllBands, ChlorophyllMix,
};
use leafmodel::optics::{Constituent, Model, Pigments};
use leafmodel::solid::SolidShape;
use renderer::scene::description::material::leaf::PlainLeaf;
use renderer::scene::description::material::solid::PlainSolid;
use renderer::scene::description::{Held, Material};

use super::{accept, text_of};

#[test]
fn bodies_of_solid_tissue_are_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let solid = |number: usize| &scene.solids[number].value;
    let melon = solid(0);
    assert_eq!((melon.plan.seed, melon.plan.map_size), (3, 256));
    let optics = melon.optics;
    assert_eq!(
        (
            optics.tissue.depth_mm,
            optics.tissue.scattering_per_mm,
            optics.tissue.eta
        ),
        (2.0, 1.0, 1.36)
    );
    // The coat's index is the tissue's where it says nothing.
    assert_eq!((optics.coat.eta, optics.coat.alpha_along), (1.36, 0.2));
    let held = melon.plan.contents;
    assert_eq!(
        (
            held[Constituent::Structure],
            held[Constituent::Chlorophyll],
            held[Constituent::Carotenoids],
            held[Constituent::Water]
        ),
        (1.0, 7.0, 0.0, 0.09)
    );
    let mosaic = melon.plan.mosaic.as_ref().expect("it has a mosaic");
    assert_eq!(
        (
            mosaic.contents[0][Constituent::Chlorophyll],
            mosaic.contents[0][Constituent::Water]
        ),
        (60.0, 0.09)
    );
    let axes = |x, y, z| SolidShape::Ellipsoid {
        semi_axes_mm: DVec3::new(x, y, z),
    };
    assert_eq!(melon.plan.shape, axes(115.0, 110.0, 100.0));
    assert_eq!(solid(1).plan.shape, SolidShape::Sphere { radius_mm: 20.0 });
    assert_eq!(solid(1).optics.tissue.eta, solid(1).optics.coat.eta);
    let dice = SolidShape::RoundedCube {
        side_mm: 20.0,
        corner_radius_mm: 5.0,
    };
    assert_eq!(solid(2).plan.shape, dice);
    assert!(
        matches!(&solid(3).plan.shape, SolidShape::Lathe { profile_mm } if profile_mm.len() == 4)
    );
    let SolidShape::Mesh(stone) = &solid(4).plan.shape else {
        panic!("the shape is {:?}", solid(4).plan.shape);
    };
    assert_eq!((stone.file.as_str(), stone.scale_mm), ("body.obj", 2.0));
    assert!(stone.shape.positions.contains(&DVec3::new(20.0, 0.0, 0.0)));
    assert!(
        stone
            .shape
            .normals
            .iter()
            .all(|n| (n.length() - 1.0).abs() < 1e-12)
    );
    let Some(mix) = solid(1).plan.pigments.chlorophyll else {
        panic!("the ball's pigments are {:?}", solid(1).plan.pigments);
    };
    assert_eq!((mix.a_to_b, mix.bands), (6.0, ChlorophyllBands::Leaf));
    assert_eq!(solid(2).plan.pigments, Pigments::default());
    let Material::Solid(PlainSolid {
        held,
        pigments,
        optics,
    }) = &scene.materials[5].value
    else {
        panic!("rind is {:?}", scene.materials[5].value);
    };
    assert!(
        matches!(held, Held::Contents { contents, extrapolate: true } if contents[Constituent::Betaxanthins] == 1.0)
    );
    assert_eq!((optics.tissue.depth_mm, optics.coat.eta), (0.5, 1.33));
    assert_eq!(pigments.betalains.betaxanthin, Betaxanthin::Vulgaxanthin);
}

#[test]
fn pigments_are_those_that_are_written_and_else_prospects() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let Material::Leaf(PlainLeaf { pigments, .. }) = &scene.materials[2].value else {
        panic!("green is {:?}", scene.materials[2].value);
    };
    let green = Pigments {
        model: Model::ProspectPro,
        extra: pigments.extra.clone(),
        chlorophyll: Some(ChlorophyllMix {
            bands: ChlorophyllBands::Solution,
            a_to_b: 3.1,
            shift_per_cm: -380.0,
            packaging: 0.4,
        }),
        carotenoids: Some(CarotenoidMix {
            shares: [0.25, 0.5, 0.1, 0.15, 0.0],
            shift_per_cm: -900.0,
            packaging: 0.3,
        }),
        anthocyanins: Some(AnthocyaninMix {
            shares: [0.1, 0.5, 0.1, 0.1, 0.1, 0.1],
            shift_nm: 15.0,
            blue_fraction: 0.05,
        }),
        betalains: Betalains {
            betacyanin: Betacyanin::Amaranthine,
            betaxanthin: Betaxanthin::Vulgaxanthin,
            packaging: 0.45,
        },
    };
    assert_eq!(**pigments, green);
    assert_eq!(green.in_range(), Ok(()));
    let Material::Leaf(PlainLeaf { pigments, .. }) = &scene.materials[3].value else {
        panic!("mapped is {:?}", scene.materials[3].value);
    };
    assert_eq!(**pigments, Pigments::default());
    let shifted = accept(
        &text_of("whole.toml"),
        "whole.toml",
        &["leaves.beech.pigments.anthocyanins.shift_nm=20"],
    );
    let Some(AnthocyaninMix {
        shares, shift_nm, ..
    }) = shifted.description.leaves[0]
        .value
        .plan
        .pigments
        .anthocyanins
    else {
        panic!("the override is read");
    };
    assert_eq!((shares, shift_nm), ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], 20.0));
}

#[test]
fn betalains_and_anthocyanins_in_one_leaf_are_a_warning() {
    let leaf = "\n[materials.odd.leaf.contents]\nstructure = 1.5\nchlorophyll_ug_per_cm2 = 30\n\
                carotenoids_ug_per_cm2 = 8\nbetacyanins_ug_per_cm2 = 5\nwater_cm = 0.01\n\
                dry_matter_g_per_cm2 = 0.005\n";
    let codes = |text: &str| -> Vec<&'static str> {
        let scene = text_of("minimal.toml") + leaf + text;
        let loaded = accept(&scene, "minimal.toml", &[]);
        let codes = loaded.warnings.iter();
        codes
            .map(leafmodel::document::report::Warning::code)
            .collect()
    };
    assert_eq!(codes(""), ["scene::unused"]);
    let both = codes("anthocyanins_ug_per_cm2 = 2\n");
    assert!(
        both.contains(&"scene::betalains_and_anthocyanins"),
        "{both:?}"
    );
}

#[test]
fn betalains_and_anthocyanins_in_cells_of_one_body_are_a_warning() {
    let told = |own: &str, cells: &str, more: &str| {
        let solid = format!(
            "\n[solids.odd.shape.sphere]\nradius_mm = 10\n[solids.odd.contents]\n{own}\n\
             [solids.odd.mosaic]\ndays = 3\n[solids.odd.mosaic.types.red]\ninitial_share = 1\n\
             contents = {{ {cells} }}\n{more}"
        );
        let loaded = accept(&(text_of("minimal.toml") + &solid), "minimal.toml", &[]);
        let codes = loaded
            .warnings
            .iter()
            .map(leafmodel::document::report::Warning::code);
        codes
            .filter(|code| *code == "scene::betalains_and_anthocyanins")
            .count()
    };
    let (red, yellow) = ("anthocyanins_ug_per_cm2 = 3", "betaxanthins_ug_per_cm2 = 2");
    assert_eq!(told(red, red, ""), 0);
    assert_eq!(told(red, yellow, ""), 1);
    // The body itself shows where no cell may be, and only there.
    let yellow = "anthocyanins_ug_per_cm2 = 0, betaxanthins_ug_per_cm2 = 2";
    assert_eq!(told(red, yellow, ""), 0);
    let control = |steers: &str| {
        format!(
            "[solids.odd.mosaic.controls.ring]\nfrom_mm = [0, 0, -10]\nto_mm = [0, 0, 0]\nconstant = 1\n{steers}"
        )
    };
    assert_eq!(told(red, yellow, &control("steers = \"blocked\"")), 1);
}

#[test]
fn betalains_and_anthocyanins_in_parts_of_one_leaf_are_one_warning_that_names_them() {
    let leaf = "\n[leaves.beet]\nlength_mm = 50\n[leaves.beet.outline.cubic]\n[leaves.beet.venation.arcuate]\n\
                [leaves.beet.contents]\nstructure = 1.5\nchlorophyll_ug_per_cm2 = 30\ncarotenoids_ug_per_cm2 = 8\n\
                betacyanins_ug_per_cm2 = 5\nwater_cm = 0.01\ndry_matter_g_per_cm2 = 0.005\n";
    let told = |text: &str| -> Vec<String> {
        let scene = text_of("minimal.toml") + leaf + text;
        let loaded = accept(&scene, "minimal.toml", &[]);
        let found = loaded.warnings.iter();
        let found = found.filter(|warning| warning.code() == "scene::betalains_and_anthocyanins");
        found.map(|warning| warning.render(false)).collect()
    };
    assert!(told("").is_empty());
    for (part, text) in [
        (
            "layers.spots",
            "[leaves.beet.layers.spots]\nmidrib = { width_mm = 2 }\ncontents = { anthocyanins_ug_per_cm2 = 3 }\n",
        ),
        (
            "senescence",
            "[leaves.beet.senescence]\nday = 20\ncourse = \"red\"\n",
        ),
        (
            "mosaic.types.red",
            "[leaves.beet.mosaic]\ndays = 3\n[leaves.beet.mosaic.types.green]\ninitial_share = 0.5\n\
             [leaves.beet.mosaic.types.red]\ninitial_share = 0.5\n\
             contents = { betacyanins_ug_per_cm2 = 0, anthocyanins_ug_per_cm2 = 3 }\n",
        ),
    ] {
        let told = told(text);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].contains(&format!("`{part}`")), "{}", told[0]);
        assert!(told[0].contains("[leaves.beet"), "{}", told[0]);
    }
}
