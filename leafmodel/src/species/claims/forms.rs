//! What the presets that extend the papers look like: shields, unlike halves, bent veins, splines,
//! lobes on axes of their own, leaflets, litter.

use glam::DVec2;

use crate::blade::MarginThickness;
use crate::blade::frame::UvFrame;
use crate::blade::senescence::AgeSource;
use crate::leaf::{Fields, Leaf, LeafPlan};
use crate::measure::description::describe;
use crate::measure::shape;
use crate::optics::Constituent;
use crate::shape::growth_form::{GrowthForm, Side};
use crate::species::find;

fn plan(name: &str) -> LeafPlan {
    find(name).expect("a preset").plan()
}

fn form(name: &str) -> GrowthForm {
    plan(name).outline.growth_form().expect("it grows").clone()
}

#[test]
fn a_nasturtium_is_a_round_shield_on_nine_veins_as_floras_say() {
    let plan = plan("nasturtium");
    let lamina = plan.grow_lamina().expect("a good plan");
    let (low, high) = lamina.outline.bounds();
    for diameter in (high - low).to_array() {
        assert!((30.0..=130.0).contains(&diameter), "{diameter} mm");
    }
    let round = (high.x - low.x) / (high.y - low.y);
    assert!((0.9..1.3).contains(&round), "{round}");
    let found = describe(&lamina.outline, &lamina.network);
    assert_eq!(1 + found.lateral_primaries, 9);
    let petiole = plan.petiole.expect("it has a stalk");
    assert!(petiole.length * plan.length_mm <= 600.0);
    // Off the middle, but well inside the margin.
    let inside = lamina.outline.distance_to_margin(DVec2::ZERO);
    assert!(
        (0.3..0.5).contains(&(inside / (high.y - low.y))),
        "{inside} mm"
    );
}

#[test]
fn a_thin_margin_takes_from_the_contents_what_it_lacks_in_thickness() {
    let thin = LeafPlan {
        map_size: 800,
        ..plan("nasturtium")
    };
    let mut even = thin.clone();
    even.form.margin = MarginThickness::EVEN;
    let [thin, even] = [thin, even].map(|plan| Leaf::grow(&plan).expect("a good plan"));
    let outline = &thin.lamina.outline;
    let frame = UvFrame::around(outline.points());
    let (mut sums, mut shares, mut count) = ([0.0; 2], 0.0, 0.0);
    let map = &even.contents;
    for (number, texel) in map.texels.iter().enumerate() {
        let at = [number % map.width as usize, number / map.width as usize];
        let at = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
        let size = DVec2::new(f64::from(map.width), f64::from(map.height));
        let p = frame.min + frame.size * at / size;
        if outline.contains(p) {
            let dry = [&thin.contents.texels[number], texel];
            for (sum, texel) in sums.iter_mut().zip(dry) {
                *sum += f64::from(texel[Constituent::DryMatter]);
            }
            shares += plan("nasturtium")
                .form
                .margin
                .at(outline.distance_to_margin(p));
            count += 1.0;
        }
    }
    // The mean falls with the mean thickness: the rim holds what tissue as thin as it holds.
    let [found, wanted] = [sums[0] / sums[1], shares / count];
    assert!((found / wanted - 1.0).abs() < 2e-3, "{found} for {wanted}");
    assert!((0.98..0.999).contains(&wanted), "{wanted}");
}

#[test]
fn a_begonia_is_broad_and_hangs_down_on_one_side_only() {
    let outline = form("begonia").grow(1.0).expect("a good form");
    let (low, high) = outline.bounds();
    assert!(high.x > 1.4 * -low.x, "{low} {high}");
    let depth = |side: f64| {
        let points = outline.points().iter().filter(|p| side * p.x > 0.0);
        points.map(|p| p.y).fold(0.0, f64::min)
    };
    assert!(depth(1.0) < -0.05 && depth(-1.0) > -0.01);
}

#[test]
fn a_dogwoods_veins_steepen_outwards() {
    let plan = plan("dogwood");
    let lamina = plan.grow_lamina().expect("a good plan");
    let Some(Fields::Arcuate(veins)) = plan.fields(&lamina).expect("a good plan") else {
        panic!("splines have fields");
    };
    for i in 0..veins.laterals() {
        let [a, b, c] = veins.lateral(i).expect("there are so many");
        let turn = (b - a).angle_to(c - b) * c.x.signum();
        assert!(turn > 0.2, "vein {i} turns by {turn}");
    }
    for line in form("dogwood").vein_lines(1.0).expect("a good form") {
        let rise = |i: usize| (line[i + 1] - line[i]).y / (line[i + 1] - line[i]).x.abs();
        assert!((1..line.len() - 1).all(|i| rise(i) > rise(i - 1)));
    }
    let widest = form("dogwood")
        .row_growth(Side::Right)
        .expect("a good form");
    let widest = widest.iter().map(|row| row.half_width).fold(0.0, f64::max);
    assert!((0.2..0.35).contains(&widest), "{widest}");
}

/// Mean turn of laterals towards the tip from their first piece to their last, in radians, and
/// the mean height of their ends, in leaf lengths.
fn sweep(name: &str) -> (f64, f64) {
    let plan = plan(name);
    let lamina = plan.grow_lamina().expect("a good plan");
    let fields = plan.fields(&lamina).expect("a good plan");
    let Some(Fields::Arcuate(veins)) = fields else {
        panic!("splines have fields");
    };
    let count = veins.laterals();
    let of = |i: usize| veins.lateral(i).expect("there are so many");
    let turn = |[a, b, c]: [DVec2; 3]| (b - a).angle_to(c - b) * c.x.signum();
    let turns: f64 = (0..count).map(|i| turn(of(i))).sum();
    let ends: f64 = (0..count).map(|i| of(i)[2].y / plan.length_mm).sum();
    (turns / count as f64, ends / count as f64)
}

#[test]
fn from_pinnate_to_arcuate_veins_bend_more_and_end_nearer_the_tip() {
    let steps = [
        "pinnate",
        "pinnate-to-arcuate-1",
        "pinnate-to-arcuate-2",
        "pinnate-to-arcuate-3",
        "arcuate",
    ]
    .map(sweep);
    for pair in steps.windows(2) {
        assert!(pair[1].0 > pair[0].0 && pair[1].1 > pair[0].1, "{steps:?}");
    }
}

#[test]
fn a_maple_has_five_lobes_that_end_where_its_axes_do() {
    let palm = form("maple-palmate");
    let outline = palm.grow(80.0).expect("a good form");
    let polar = |p: &DVec2| (libm::atan2(p.x, p.y).to_degrees(), p.length());
    let margin: Vec<(f64, f64)> = outline.points().iter().map(polar).collect();
    let mut tips = Vec::new();
    for [_, tip] in palm.axis_lines(80.0).expect("a good form") {
        assert!(outline.distance_to_margin(tip) < 1e-6 * 80.0, "{tip}");
        let (direction, length) = polar(&tip);
        // The farthest point of the margin within 15 degrees of the axis.
        let near = margin.iter().filter(|p| (p.0 - direction).abs() < 15.0);
        let farthest = near.map(|p| p.1).fold(0.0, f64::max);
        // The last row keeps its width of a thousandth and slopes up.
        assert!(farthest <= length + 0.2, "{farthest} beyond {length}");
        tips.push((direction, length));
    }
    assert_eq!(tips.len(), 5);
    tips.sort_by(|p, q| p.0.total_cmp(&q.0));
    for pair in tips.windows(2) {
        let between = margin.iter().filter(|p| p.0 > pair[0].0 && p.0 < pair[1].0);
        let bay = between.map(|p| p.1).fold(f64::INFINITY, f64::min);
        assert!(
            bay < 0.85 * pair[0].1.min(pair[1].1),
            "{bay} between {pair:?}"
        );
    }
    let solidity = shape(&outline).number("solidity").expect("it has one");
    assert!((0.5..0.8).contains(&solidity), "{solidity}");
}

#[test]
fn compound_leaves_have_their_usual_leaflets_and_none_in_anothers_way() {
    for (name, leaflets) in [
        ("ash", 11),
        ("rose", 7),
        ("horse-chestnut", 7),
        ("mimosa", 360),
        ("clover", 3),
    ] {
        let plan = plan(name);
        let form = plan.compound.as_ref().expect("it is compound");
        let leaf = form
            .arrange(&plan)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(leaf.leaflets.len(), leaflets, "{name}");
    }
}

#[test]
fn no_tissue_of_oak_litter_is_left_alive() {
    let plan = plan("oak-litter");
    let senescence = plan.senescence.expect("it has aged");
    let AgeSource::Day { day, .. } = senescence.source else {
        panic!("it ages by days");
    };
    let last = senescence.last_day().expect("it ages by days");
    assert!(last <= day, "the last tissue dies on day {last} of {day}");
}
