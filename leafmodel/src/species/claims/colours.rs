//! What the documentation says of coloured leaves, tested on their contents and reflectances.

use glam::DVec2;

use crate::blade::frame::UvFrame;
use crate::blade::senescence::AgeSource;
use crate::grow_options::GrowOptions;
use crate::leaf::LeafPlan;
use crate::leaf::venation_plan::VenationPlan;
use crate::optics::Constituent::{
    Anthocyanins, Betacyanins, Brown, Carotenoids, Chlorophyll, Water,
};
use crate::optics::{Constituent, Contents, ProspectD};
use crate::species::traits::Traits;
use crate::species::{PRESETS, Preset, find};
use crate::venation::architecture::PrimaryPattern;
use crate::venation::network::VeinSegment;
use crate::venation::plan::{AuxinPlan, Growth};

/// A point of a grown leaf and its contents.
struct Point {
    contents: Contents,
    /// Distance from the margin, mm.
    margin: f64,
    /// Distance from the edge of the nearest vein of the first two orders, mm; negative inside the
    /// vein.
    vein: f64,
    /// 0 at the base, 1 at the apex.
    along: f64,
}

/// The leaf of a preset with a coarser net, so that it grows fast.
fn points(plan: &LeafPlan) -> Vec<Point> {
    let mut plan = LeafPlan {
        map_size: 360,
        compound: None,
        ..plan.clone()
    };
    if let VenationPlan::Auxin(auxin) = &plan.venation {
        // The primaries of a fan leave no room for a coarser net.
        let is_fan = auxin.architecture.as_ref().is_some_and(|architecture| {
            architecture.primaries.pattern == PrimaryPattern::Flabellate
        });
        let coarser = if is_fan { 1.0 } else { 2.5 };
        let growth = match auxin.growth.clone() {
            Growth::Isogonic {
                initial_length,
                length_step,
            } => Growth::Isogonic {
                initial_length: initial_length / coarser,
                length_step,
            },
            Growth::Marginal {
                initial_length,
                length_step,
            } => Growth::Marginal {
                initial_length: initial_length / coarser,
                length_step,
            },
            other @ (Growth::None | Growth::Anisotropic { .. }) => other,
        };
        plan.venation = VenationPlan::Auxin(AuxinPlan {
            final_length: auxin.final_length / coarser,
            growth,
            ..auxin.clone()
        });
    }
    let lamina = plan.grow_lamina().expect("a good plan");
    let map = GrowOptions::default()
        .contents(&plan, &lamina)
        .expect("a good plan");
    let frame = UvFrame::around(lamina.outline.points());
    let segments: Vec<VeinSegment> = lamina.network.segments().filter(|s| s.order <= 2).collect();
    let (base, apex) = (lamina.outline.base(), lamina.outline.apex());
    let mut found = Vec::new();
    for row in (0..map.height).step_by(3) {
        for column in (0..map.width).step_by(3) {
            let at = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
            let p = frame.point(DVec2::new(at(column, map.width), at(row, map.height)));
            if !lamina.outline.contains(p) {
                continue;
            }
            let texel = map.texels[(row * map.width + column) as usize];
            let vein = segments
                .iter()
                .map(|s| beyond(s, p))
                .fold(f64::INFINITY, f64::min);
            found.push(Point {
                contents: Contents::from_texel(texel),
                margin: lamina.outline.distance_to_margin(p),
                vein,
                along: (p - base).dot(apex - base) / (apex - base).length_squared(),
            });
        }
    }
    assert!(found.len() > 1000, "{} points", found.len());
    found
}

/// Distance of a point from a vein's edge, mm.
fn beyond(vein: &VeinSegment, p: DVec2) -> f64 {
    let axis = vein.to - vein.from;
    let t = ((p - vein.from).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    let radius = vein.radius_from + t * (vein.radius_to - vein.radius_from);
    p.distance(vein.from + axis * t) - radius
}

fn plan(preset: &str) -> LeafPlan {
    find(preset).expect("a preset").plan()
}

fn grown(preset: &str) -> Vec<Point> {
    points(&plan(preset))
}

fn all_coloured() -> impl Iterator<Item = &'static Preset> {
    PRESETS.iter().filter(|preset| preset.is_coloured())
}

fn traits(preset: &str) -> &'static Traits {
    let traits = find(preset).and_then(Preset::traits);
    traits.expect("a coloured leaf")
}

/// What the lamina holds in summer.
fn green(traits: &Traits) -> Contents {
    let mut contents = Contents::NOTHING;
    for (constituent, held) in contents.iter_mut() {
        let name = constituent.name().replace('_', " ");
        *held = traits.summer(&name).and_then(|q| q.value).unwrap_or(0.0);
    }
    contents
}

/// What a tissue holds; what its file leaves out is as in summer.
fn held(traits: &Traits, tissue: &str) -> Contents {
    let mut contents = green(traits);
    let value = |constituent: Constituent| {
        let name = format!("{tissue}: {}", constituent.name().replace('_', " "));
        traits.differs.iter().find(|quantity| quantity.name == name)
    };
    for (constituent, held) in contents.iter_mut() {
        *held = value(constituent).and_then(|q| q.value).unwrap_or(*held);
    }
    contents
}

/// Mean over the points that `of` picks.
fn mean(points: &[Point], of: impl Fn(&Point) -> bool, what: impl Fn(&Contents) -> f64) -> f64 {
    let picked = || points.iter().filter(|point| of(point));
    assert!(picked().count() > 20, "{} points", picked().count());
    picked().map(|point| what(&point.contents)).sum::<f64>() / picked().count() as f64
}

fn blade(point: &Point) -> bool {
    point.vein > 0.3
}

fn rim(point: &Point) -> bool {
    point.margin < 1.5
}

fn core(point: &Point) -> bool {
    point.margin > 8.0 && point.vein > 0.3
}

fn chlorophyll(contents: &Contents) -> f64 {
    contents[Chlorophyll]
}

fn anthocyanins(contents: &Contents) -> f64 {
    contents[Anthocyanins]
}

fn brown(contents: &Contents) -> f64 {
    contents[Brown]
}

fn reflectance(nm: f64) -> impl Fn(&Contents) -> f64 {
    let at = ProspectD::coefficients(nm).expect("in range");
    move |contents| at.reflectance_transmittance(contents).reflectance
}

#[test]
fn fourteen_presets_have_another_colour_than_summers_green() {
    assert_eq!(all_coloured().count(), 14);
}

#[test]
fn a_course_leads_from_the_green_leaf_to_what_is_reported_of_turned_tissue() {
    let mut count = 0;
    for leaf in all_coloured() {
        let Some(senescence) = leaf.plan().senescence else {
            continue;
        };
        count += 1;
        let AgeSource::Day { course, .. } = senescence.source else {
            panic!("{} has no days", leaf.name);
        };
        let traits = traits(leaf.name);
        let (living, turned) = (green(traits), held(traits, "turned"));
        assert_eq!(course.senescent(living, 0.0), living);
        let late = course.senescent(living, 3.5 * course.half_days);
        let near = |value: f64, told: f64, share: f64| (value - told).abs() <= share * told + 0.35;
        assert!(
            near(late[Chlorophyll], turned[Chlorophyll], 0.0),
            "{late:?}"
        );
        // Even long-lived pigments fade a little.
        assert!(
            near(late[Carotenoids], turned[Carotenoids], 0.25),
            "{late:?}"
        );
        assert!(
            near(late[Anthocyanins], turned[Anthocyanins], 0.1),
            "{late:?}"
        );
        assert!((late[Brown] - turned[Brown]).abs() < 0.01, "{late:?}");
        let rest = [course.chlorophyll_rest, course.anthocyanins, course.brown];
        assert_eq!(
            rest,
            [turned[Chlorophyll], turned[Anthocyanins], turned[Brown]]
        );
        let kept = turned[Carotenoids] / living[Carotenoids];
        assert_eq!(
            course.labile_carotenoids,
            (1.0 - kept).max(0.0),
            "{}",
            leaf.name
        );
    }
    assert_eq!(count, 7);
}

#[test]
fn on_its_last_day_a_leaf_is_dead_everywhere_and_a_day_earlier_it_need_not_be() {
    for preset in ["birch-autumn", "red-maple-autumn"] {
        let plan = plan(preset);
        let senescence = plan.senescence.expect("it ages");
        let last = senescence.last_day().expect("by days");
        let dead = senescence.contents[Brown];
        let browns = |day| {
            let senescence = senescence.on_day(day);
            points(&LeafPlan {
                senescence,
                ..plan.clone()
            })
        };
        let least = |points: &[Point]| {
            let browns = points.iter().map(|point| point.contents[Brown]);
            browns.fold(f64::INFINITY, f64::min)
        };
        assert!((least(&browns(last)) - dead).abs() < 1e-6, "{preset}");
        assert!(least(&browns(0.6 * last)) < 0.9 * dead, "{preset}");
        assert_eq!(mean(&browns(0.0), |_| true, brown), 0.0);
    }
}

#[test]
fn yellow_leaves_are_bright_in_green_and_red_light_and_not_in_blue() {
    for preset in ["ginkgo-autumn", "birch-autumn", "poplar-autumn"] {
        let points = grown(preset);
        let green = green(traits(preset));
        let of = |nm| mean(&points, blade, reflectance(nm));
        assert!(
            mean(&points, blade, chlorophyll) < 0.25 * green[Chlorophyll],
            "{preset}"
        );
        assert!(mean(&points, blade, anthocyanins) < 1.0, "{preset}");
        // Some brown keeps the leaf from looking like a lemon.
        assert!(mean(&points, blade, brown) > 0.05, "{preset}");
        assert!(
            of(550.0) > 1.5 * reflectance(550.0)(&green),
            "{preset}: {}",
            of(550.0)
        );
        assert!(
            of(680.0) > 3.0 * reflectance(680.0)(&green),
            "{preset}: {}",
            of(680.0)
        );
        assert!(of(450.0) < 0.45 * of(550.0), "{preset}: {}", of(450.0));
    }
}

#[test]
fn from_yellow_over_orange_and_scarlet_to_purple_less_green_light_comes_back() {
    let mut before = [f64::INFINITY, 0.0];
    for (preset, least, most) in [
        ("poplar-autumn", 0.0, 1.0),
        ("sugar-maple-autumn", 2.0, 6.0),
        ("red-maple-autumn", 8.0, 16.0),
        ("sweetgum-autumn", 18.0, 31.0),
    ] {
        let points = grown(preset);
        let held = mean(&points, blade, anthocyanins);
        assert!((least..=most).contains(&held), "{preset} holds {held}");
        assert!(held > before[1], "{preset}");
        let of = |nm| mean(&points, blade, reflectance(nm));
        // Red light against green.
        let share = of(550.0) / of(640.0);
        assert!(
            share < 0.93 * before[0],
            "{preset}: {share} after {before:?}"
        );
        before = [share, held];
    }
}

#[test]
fn green_lasts_at_veins_and_brown_comes_from_the_margin() {
    for preset in [
        "birch-autumn",
        "poplar-autumn",
        "sugar-maple-autumn",
        "red-maple-autumn",
    ] {
        let points = grown(preset);
        let at_veins = mean(&points, |p| (0.3..0.9).contains(&p.vein), chlorophyll);
        let between = mean(&points, |p| p.vein > 2.5, chlorophyll);
        assert!(at_veins > 1.2 * between, "{preset}: {at_veins}, {between}");
        let [outer, inner] = [mean(&points, rim, brown), mean(&points, core, brown)];
        assert!(outer > 1.15 * inner, "{preset}: {outer}, {inner}");
    }
}

#[test]
fn litter_is_brown_dry_and_without_green() {
    let points = grown("oak-litter");
    let green = green(traits("oak-litter"));
    assert!(mean(&points, blade, brown) > 0.8);
    assert!(mean(&points, blade, chlorophyll) < 2.0);
    assert!(mean(&points, blade, |c| c[Water]) < 0.4 * green[Water]);
    let [blue, yellow, red] = [450.0, 550.0, 680.0].map(|nm| mean(&points, blade, reflectance(nm)));
    assert!(
        blue < 0.75 * yellow && yellow < 0.85 * red,
        "{blue} {yellow} {red}"
    );
    assert!(yellow < 0.4, "{yellow}");
}

#[test]
fn a_purple_smoke_tree_is_green_under_its_red() {
    let points = grown("cotinus");
    let green = green(traits("cotinus"));
    assert!(mean(&points, core, chlorophyll) > 28.0);
    assert!(mean(&points, core, anthocyanins) > 25.0);
    let of = |nm| mean(&points, core, reflectance(nm));
    assert!(
        of(550.0) < 0.6 * reflectance(550.0)(&green),
        "{}",
        of(550.0)
    );
    assert!(
        (of(680.0) / reflectance(680.0)(&green) - 1.0).abs() < 0.3,
        "{}",
        of(680.0)
    );
    // Redder at its rim.
    assert!(mean(&points, |p| p.margin < 0.4, chlorophyll) < 24.0);
}

#[test]
fn variegated_leaves_are_pale_at_the_margin_and_green_inside() {
    for (preset, pale) in [("acer-variegated", "white"), ("ivy-variegated", "cream")] {
        let points = grown(preset);
        let green = green(traits(preset));
        let sector = held(traits(preset), pale);
        let core = |p: &Point| p.margin > 11.0 && p.vein > 0.3;
        assert!(
            mean(&points, core, chlorophyll) > 0.6 * green[Chlorophyll],
            "{preset}"
        );
        let rim = |p: &Point| p.margin < 1.0 && p.vein > 0.3;
        assert!(
            mean(&points, rim, chlorophyll) < sector[Chlorophyll] + 8.0,
            "{preset}"
        );
        for nm in [550.0, 680.0] {
            let [outer, inner] = [
                mean(&points, rim, reflectance(nm)),
                mean(&points, core, reflectance(nm)),
            ];
            assert!(outer > 1.6 * inner, "{preset} at {nm}: {outer}, {inner}");
        }
    }
    // Each leaflet has sectors of its own.
    let plan = plan("acer-variegated");
    let other = LeafPlan {
        seed: plan.seed + 1,
        ..plan.clone()
    };
    let [one, two] = [plan, other].map(|plan| points(&plan));
    let differ = one
        .iter()
        .zip(&two)
        .filter(|(a, b)| (a.contents[Chlorophyll] - b.contents[Chlorophyll]).abs() > 10.0);
    assert!(10 * differ.count() > one.len());
}

#[test]
fn without_iron_veins_stay_green_in_a_pale_blade() {
    let points = grown("iron-chlorosis");
    let at_veins = mean(&points, |p| (0.1..0.5).contains(&p.vein), chlorophyll);
    let between = mean(&points, |p| p.vein > 2.0, chlorophyll);
    assert!(
        at_veins > 2.2 * between && between < 11.0,
        "{at_veins}, {between}"
    );
    for nm in [550.0, 680.0] {
        let near = mean(&points, |p| (0.1..0.5).contains(&p.vein), reflectance(nm));
        let far = mean(&points, |p| p.vein > 2.0, reflectance(nm));
        assert!(far > 1.3 * near, "{nm}: {far}, {near}");
    }
}

#[test]
fn a_croton_has_yellow_blotches_and_little_between_yellow_and_green() {
    let points = grown("croton-variegated");
    let share = |of: &dyn Fn(f64) -> bool| {
        let blade = points.iter().filter(|point| blade(point));
        let all = blade.clone().count() as f64;
        blade
            .filter(|point| of(point.contents[Chlorophyll]))
            .count() as f64
            / all
    };
    let [yellow, green] = [share(&|c| c < 8.0), share(&|c| c > 38.0)];
    assert!((0.05..0.5).contains(&yellow), "{yellow}");
    assert!(yellow + green > 0.75, "{yellow} {green}");
}

#[test]
fn josephs_coat_is_red_at_the_base_green_at_the_tip_and_holds_no_anthocyanin() {
    let points = grown("amaranth");
    assert_eq!(mean(&points, |_| true, anthocyanins), 0.0);
    let base = |p: &Point| p.along < 0.2 && blade(p);
    let tip = |p: &Point| p.along > 0.88;
    let betacyanins = |c: &Contents| c[Betacyanins];
    assert!(mean(&points, base, betacyanins) > 15.0);
    assert!(mean(&points, tip, betacyanins) < 7.0);
    assert!(mean(&points, tip, chlorophyll) > 2.5 * mean(&points, base, chlorophyll));
    let [red, green] = [base as fn(&Point) -> bool, tip]
        .map(|of| mean(&points, of, reflectance(640.0)) / mean(&points, of, reflectance(550.0)));
    assert!(red > 1.8 && green < 1.2, "{red} {green}");
}
