//! Leaves are planned as the file says.

use std::path::Path;

use leafmodel::leaf::LeafPlan;
use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::shape::growth::RateCurve;
use leafmodel::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern,
};

use leafmodel::compound::{Arrangement, Feather};
use renderer::scene::load::{count_veins, load_for_instruments, load_leaves};

use super::accepted::assert_near;
use super::{accept, codes, folder, text_of};
use leafmodel::optics::Constituent;

/// The plan of veins that grow towards auxin.
fn auxin(plan: &LeafPlan) -> &AuxinPlan {
    plan.venation.auxin().expect("the leaf has such veins")
}

#[test]
fn a_leaf_is_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let beech = &scene.leaves[0].value;
    let venation = auxin(&beech.plan);
    assert_eq!(
        (venation.pattern, venation.final_length),
        (Pattern::Closed(Neighbourhood::Relative), 350.0)
    );
    assert_eq!(
        (venation.source_birth_distance, venation.vein_birth_distance),
        (3.0, 4.0)
    );
    let isogonic = Growth::Isogonic {
        initial_length: 11.5,
        length_step: 0.9,
    };
    assert_eq!(venation.growth, isogonic);
    assert_near(beech.plan.form.fold, std::f64::consts::PI / 20.0);
    assert_eq!(beech.plan.tissue.vein_factors[Constituent::DryMatter], 4.0);
    assert_eq!(beech.plan.tissue.lamina[Constituent::Anthocyanins], 0.0);
    let [adaxial, abaxial] = beech.faces.coats;
    assert_eq!(
        (adaxial.eta, adaxial.alpha_across, adaxial.alpha_along),
        (1.5, 0.2, 0.2)
    );
    assert_eq!((abaxial.alpha_across, abaxial.alpha_along), (0.45, 0.3));
    let simple = &scene.leaves[1].value;
    assert_eq!(auxin(&simple.plan).vein_birth_distance, 4.0);
    let Contour::GrowthAlgorithm(shape) = &simple.plan.outline.contour else {
        panic!("the outline is {:?}", simple.plan.outline);
    };
    let positions: Vec<f64> = shape
        .midrib
        .right
        .veins
        .iter()
        .map(|vein| vein.position)
        .collect();
    assert_eq!(positions, [0.1, 0.3, 0.5, 0.7, 0.9]);
    assert!(simple.faces.abaxial_ratio.is_none());
}

#[test]
fn an_outline_may_be_drawn_or_traced_and_toothed() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let outline = |leaf: usize| -> &OutlinePlan { &scene.leaves[leaf].value.plan.outline };
    let Contour::Curve(curve) = &outline(2).contour else {
        panic!("the outline is {:?}", outline(2));
    };
    let corners: Vec<bool> = curve.points.iter().map(|point| point.corner).collect();
    assert_eq!(
        (corners, curve.mirrored),
        (vec![false, true, false, true], true)
    );
    assert_eq!(curve.points[1].place, [0.3, -0.1]);
    let [coarse, fine] = outline(2).teeth.as_slice() else {
        panic!("the teeth are {:?}", outline(2).teeth);
    };
    assert_eq!(
        (
            coarse.per_side,
            coarse.lean,
            coarse.fade_base,
            coarse.fade_apex
        ),
        (12, 0.8, 0.1, 0.2)
    );
    assert_eq!(
        (fine.per_side, fine.height, fine.lean, fine.fade_apex),
        (48, 0.005, 0.0, 0.0)
    );
    let Contour::Svg(svg) = &outline(3).contour else {
        panic!("the outline is {:?}", outline(3));
    };
    assert_eq!(
        (svg.file.as_str(), svg.id.as_deref()),
        ("margin.svg", Some("blade"))
    );
    assert_eq!((svg.base, svg.apex), ([50.0, 90.0], [50.0, 10.0]));
}

#[test]
fn what_a_drawing_leaves_open_is_reported() {
    let warnings = |id: &str| {
        let text = text_of("broken/outline_svg_parts.toml").replace("id = \"ring\"", id);
        let loaded = accept(&text, "drawn.toml", &[]);
        let messages = loaded.warnings.iter();
        messages
            .map(|warning| warning.message().to_owned())
            .collect::<Vec<_>>()
    };
    assert!(warnings("id = \"blade\"").is_empty());
    let [several] = &warnings("")[..] else {
        panic!("one warning");
    };
    assert!(
        several.contains("4 paths that are drawn, of which the first"),
        "{several}"
    );
    // From (20, 70) to (50, 90), of 80 in height; curves stay within 80 in width.
    let [open] = &warnings("id = \"open\"")[..] else {
        panic!("one warning");
    };
    assert!(open.contains("over 0.45 of its extent"), "{open}");
}

#[test]
fn veins_are_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let drawn = auxin(&scene.leaves[2].value.plan);
    assert_eq!(drawn.pattern, Pattern::Closed(Neighbourhood::Urquhart));
    assert_eq!(drawn.origins, [[0.0, 0.0], [0.1, 0.2]]);
    assert_eq!(
        (drawn.unseen_veinlets, drawn.gaussian_curvature),
        (3.0, -0.5)
    );
    let free_endings = FreeEndings {
        birth_distance: 1.5,
        kill_distance: 1.0,
        darts_per_area: 2.0,
    };
    let margin_clearance = MarginClearance {
        distance: 0.05,
        until: 0.6,
        arches: 0,
    };
    assert_eq!(drawn.free_endings, Some(free_endings));
    assert_eq!(drawn.margin_clearance, Some(margin_clearance));
    let curve = |knots: &[[f64; 2]]| RateCurve::new(knots.to_vec()).expect("good knots");
    let anisotropic = Growth::Anisotropic {
        initial_length: 10.0,
        across: curve(&[[0.0, 0.02], [1.0, 0.01]]),
        along: curve(&[[0.0, 0.01], [0.5, 0.03], [1.0, 0.01]]),
    };
    let traced = auxin(&scene.leaves[3].value.plan);
    assert_eq!(
        (&traced.pattern, &traced.growth),
        (&Pattern::Open, &anisotropic)
    );
    assert!(traced.origins.is_empty() && traced.free_endings.is_none());
}

#[test]
fn leaves_can_be_read_from_a_file_that_has_nothing_else() {
    let whole = text_of("whole.toml");
    let start = whole
        .find("[leaves.beech]")
        .expect("the scene has a beech leaf");
    let end = whole.find("[lights.sun").expect("the scene has a sun");
    let folder = folder();
    let path = folder.path().join("leaf.toml");
    let write = |text: &str| std::fs::write(&path, text).expect("the folder was just made");
    write(&format!("format = 1\n{}", &whole[start..end]));
    let overrides = ["leaves.beech.seed=9".to_owned()];
    let leaves = load_leaves(&path, &overrides).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((leaves.len(), leaves[1].name.as_str()), (4, "simple"));
    assert_eq!(leaves[0].value.plan.seed, 9);
    write(&format!(
        "format = 1\n{}",
        whole[start..end].replace("rows = 100", "rows = 1")
    ));
    let errors = load_leaves(&path, &[]).expect_err("one row is no leaf");
    assert_eq!(codes(&errors), ["scene::out_of_range"]);
    write("format = 1\n");
    let errors = load_leaves(&path, &[]).expect_err("there is no leaf");
    assert_eq!(codes(&errors), ["scene::missing_key"]);
}

#[test]
fn petioles_and_compound_leaves_mean_what_the_book_says() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let petiole = scene.leaves[1].value.plan.petiole;
    let petiole = petiole.expect("the simple leaf has one");
    assert_eq!((petiole.length, petiole.radius_mm), (0.4, Some(0.5)));
    assert_eq!(petiole.curl, 30.0_f64.to_radians());
    let compound = scene.leaves[2].value.plan.compound.as_ref();
    let compound = compound.expect("the drawn leaf is");
    assert_eq!(
        (
            compound.petiole,
            compound.petiolule,
            compound.stalk_radius_mm,
            compound.variants
        ),
        (1.5, 0.2, 0.2, 2)
    );
    let bends = [compound.curl, compound.fold, compound.tilt];
    assert_eq!(bends, [30.0_f64, -10.0, 5.0].map(f64::to_radians));
    let Arrangement::Bipinnate {
        pinnae,
        leaflets,
        stalk,
    } = &compound.arrangement
    else {
        panic!("{:?}", compound.arrangement);
    };
    let expected = Feather {
        pairs: 1,
        terminal: false,
        rachis: 3.0,
        alternation: 0.3,
        angles: [80.0_f64, 70.0].map(f64::to_radians),
        sizes: [0.5; 3],
        turn: 10.0_f64.to_radians(),
    };
    assert_eq!((*stalk, *pinnae), (2.0, expected));
    assert!(leaflets.terminal && leaflets.sizes == [1.0; 3]);
    assert!(scene.leaves[0].value.plan.petiole.is_none());
    assert!(scene.leaves[0].value.plan.compound.is_none());
}

#[test]
fn leaves_of_all_scenes_of_the_repository_can_be_grown_alone() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let folders = std::fs::read_dir(scenes).expect("there are scenes");
    let files = folders.flat_map(|folder| {
        let folder = folder.expect("it can be read").path();
        let files = std::fs::read_dir(folder).into_iter().flatten();
        files.map(|file| file.expect("it can be read").path())
    });
    let files = files.filter(|file| file.extension().is_some_and(|ending| ending == "toml"));
    let mut count = 0;
    for file in files {
        let Ok(scene) = load_for_instruments(&file, &[]) else {
            continue;
        };
        let leaves = scene.description.leaves.len();
        let alone = count_veins(&file, &[]);
        // A leaf may stand in a picture at several ages.
        let is_read = alone.is_some_and(|alone| (1..=leaves).contains(&alone));
        assert!(leaves == 0 || is_read, "{}", file.display());
        count += alone.unwrap_or_default();
    }
    assert!(count > 100, "{count} leaves");
}
