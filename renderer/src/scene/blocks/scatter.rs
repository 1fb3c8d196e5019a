//! `[objects.NAME.scatter]`: many copies of an object on the surface of another.

use glam::DVec2;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{Degrees, Flag, Integer, Number, Numbers};
use leafmodel::plan_file::DAYS;

use super::camera::COORDINATES_M;
use super::name_list::NamesIn;
use super::placement::SCALES;
use crate::geometry::scatter::{Amount, MOST_AT_REST, MOST_THINGS, Rest, Scatter};
use crate::scene::description::{Object, ObjectShape, StrewnOn};

impl StrewnOn {
    /// With all defaults.
    fn usual() -> Self {
        Self {
            on: 0,
            over: Vec::new(),
            plan: Scatter {
                amount: Amount::Count(1),
                within: None,
                least_distance: 0.0,
                scale: [1.0; 2],
                tilt: 0.0,
                turn: std::f64::consts::PI,
                flipped: 0.0,
                upright: false,
                rest: Rest::Fixed { sink: 0.0 },
                furrows: 0.0,
                merge: false,
                seed: 0,
            },
            individuals: 1,
            days: None,
        }
    }
}

/// The key `scatter` of an object, which may be a plant.
pub(super) fn scatter(object: &mut Object, is_plant: bool, keys: &mut Keys<'_>) {
    keys.exclude("instances", "scatter");
    let mut strewn = object.strewn.take().map(|strewn| *strewn);
    let about = "Where copies of the object are strewn, instead of its own place.";
    keys.optional_block("scatter", &mut strewn, StrewnOn::usual, about, strewn_on);
    if let Some(strewn) = &strewn {
        let is_leaf = |shape: &ObjectShape| matches!(shape, ObjectShape::Leaf { .. });
        let only_leaves = !is_plant && object.shapes.iter().all(is_leaf);
        let differ = strewn.individuals > 1 || strewn.days.is_some();
        if keys.is_sound() && differ && !only_leaves {
            let key = if strewn.days.is_some() {
                "days"
            } else {
                "individuals"
            };
            let problem = "only leaves are grown apart".to_owned();
            let help = "take it out; a plant has its own `individuals` and `days`";
            keys.refuse(&["scatter", key], problem, help);
        }
        if keys.is_sound() && is_plant && is_at_rest(strewn) {
            let problem = "a plant stands where it grows".to_owned();
            keys.refuse(&["scatter", "settle"], problem, "take it out");
        }
    }
    object.strewn = strewn.map(Box::new);
}

fn is_at_rest(strewn: &StrewnOn) -> bool {
    matches!(strewn.plan.rest, Rest::Settled { .. })
}

fn strewn_on(strewn: &mut StrewnOn, keys: &mut Keys<'_>) {
    let kind = NameIn("objects", "the name of an object");
    let about = "The object over whose surface they are strewn, in all its places.";
    keys.required("on", &mut strewn.on, kind, about);
    let mut over = Vec::new();
    let kind = NamesIn("objects", "the name of an object");
    let about = "Other objects on which they come to rest.";
    keys.key("over", &mut over, kind, about);
    strewn.over = over.into_iter().map(|(object, _)| object).collect();
    let plan = &mut strewn.plan;
    amount(plan, keys);
    let mut within = None;
    let about = "The rectangle to which they keep: least x and y, greatest x and y.";
    keys.optional("within_m", &mut within, Numbers::<4>(COORDINATES_M), about);
    if let Some([x0, y0, x1, y1]) = within {
        if x0 >= x1 || y0 >= y1 {
            let problem = "the rectangle has no area".to_owned();
            let help = "write the least x and y first: `within_m = [-1, -1, 1, 1]`";
            keys.refuse(&["within_m"], problem, help);
        }
        plan.within = Some([DVec2::new(x0, y0), DVec2::new(x1, y1)]);
    }
    let mut least_mm = 1e3 * plan.least_distance;
    let about = "Least distance between the points where they stand.";
    let limits = Number(Limits::closed(0.0, 1e9));
    keys.key("least_distance_mm", &mut least_mm, limits, about);
    plan.least_distance = 1e-3 * least_mm;
    let about = "Least and greatest factor on their size.";
    keys.key("scale", &mut plan.scale, Numbers::<2>(SCALES), about);
    if plan.scale[0] > plan.scale[1] {
        let problem = "the least factor is greater than the greatest".to_owned();
        keys.refuse(&["scale"], problem, "write the smaller one first");
    }
    let about = "Greatest lean from the surface's normal, before they come to rest; all directions within it are equally likely.";
    let limits = Degrees(Limits::closed(0.0, 180.0));
    keys.key("tilt_deg", &mut plan.tilt, limits, about);
    let about = "Greatest turn to either side about their own z.";
    keys.key("turn_deg", &mut plan.turn, limits, about);
    let about = "Share of them that lies upside down, turned about its y.";
    let share = Number(Limits::closed(0.0, 1.0));
    keys.key("flipped", &mut plan.flipped, share, about);
    let about = "Whether they stand upright instead of along the surface's normal.";
    keys.key("upright", &mut plan.upright, Flag, about);
    rest(plan, keys);
    let about = "Share of what does not settle that stands in hollows of the surface, such as the \
        furrows above veins.";
    let share = Number(Limits::closed(0.0, 1.0));
    keys.key("furrows", &mut plan.furrows, share, about);
    let about = "Whether what touches runs together into one of the summed volume, as drops do; \
        there are fewer then.";
    keys.key("merge", &mut plan.merge, Flag, about);
    let settles = matches!(plan.rest, Rest::Settled { .. });
    let amount = plan.amount;
    for (key, needs_rest) in [
        ("over", true),
        ("gap_mm", true),
        ("sink_mm", false),
        ("furrows", false),
        ("merge", false),
        ("upright", false),
    ] {
        if keys.reader().is_some() && keys.has(key) && needs_rest != settles {
            let (problem, help) = if settles {
                (
                    "has no effect on what settles",
                    "take it out, or leave `settle` out",
                )
            } else {
                (
                    "has an effect only on what settles",
                    "write `settle = true` beside it",
                )
            };
            keys.refuse(&[key], problem.to_owned(), help);
        }
    }
    if let Amount::Count(count) = amount
        && settles
        && count as usize > MOST_AT_REST
    {
        let problem = format!("{count} are more than the {MOST_AT_REST} that may settle");
        keys.refuse(&["count"], problem, "use fewer");
    }
    let about = "Different leaves of each kind that are grown for it.";
    let count = Integer::within(1, 1000);
    keys.key("individuals", &mut strewn.individuals, count, about);
    let about = "Days of ageing of the first and the last of them, the others between; the leaves \
        need `senescence` by `day`.";
    keys.optional("days", &mut strewn.days, Numbers::<2>(DAYS), about);
    refuse_ages_of_one(strewn.individuals, strewn.days, keys);
    let seed = Integer::within(0, u64::MAX);
    let about = "Same numbers and seed, same places.";
    keys.key("seed", &mut strewn.plan.seed, seed, about);
}

/// Refuses two ages of one individual.
pub(super) fn refuse_ages_of_one(individuals: u32, days: Option<[f64; 2]>, keys: &mut Keys<'_>) {
    if individuals == 1 && days.is_some_and(|[first, last]| first != last) {
        let problem = "one individual has one age".to_owned();
        let help = "write `individuals = 5` beside it, or the same day twice";
        keys.refuse(&["days"], problem, help);
    }
}

fn amount(plan: &mut Scatter, keys: &mut Keys<'_>) {
    let current = match plan.amount {
        Amount::Count(_) => "count",
        Amount::PerSquareMetre(_) => "per_m2",
    };
    for chosen in keys.one_of(&["count", "per_m2"], Some(current)) {
        if chosen == "count" {
            let mut count = match plan.amount {
                Amount::Count(count) => count,
                Amount::PerSquareMetre(_) => 1,
            };
            let about = "How many.";
            let limits = Integer::within(1, MOST_THINGS as u64);
            keys.needed("count", &mut count, limits, about);
            plan.amount = Amount::Count(count);
        } else {
            let mut density = match plan.amount {
                Amount::PerSquareMetre(density) => density,
                Amount::Count(_) => 1.0,
            };
            let about = "How many for each square metre of the surface; of its ground plan if they \
                come to rest.";
            let limits = Number(Limits::above(0.0, 1e12));
            keys.needed("per_m2", &mut density, limits, about);
            plan.amount = Amount::PerSquareMetre(density);
        }
    }
}

fn rest(plan: &mut Scatter, keys: &mut Keys<'_>) {
    let (mut settles, mut gap_mm, mut sink_mm) = match plan.rest {
        Rest::Settled { gap } => (true, 1e3 * gap, 0.0),
        Rest::Fixed { sink } => (false, 0.1, 1e3 * sink),
    };
    let about = "Whether they fall straight down, one after the other, and turn until they lie \
        still on the surface, on `over` and on one another.";
    keys.key("settle", &mut settles, Flag, about);
    let about = "What is kept between things at rest, for their thickness.";
    let limits = Number(Limits::closed(0.0, 1000.0));
    keys.key("gap_mm", &mut gap_mm, limits, about);
    let about = "How deep the origin of what does not settle lies below the surface; above it if \
        negative.";
    let limits = Number(Limits::closed(-1e6, 1e6));
    keys.key("sink_mm", &mut sink_mm, limits, about);
    plan.rest = if settles {
        Rest::Settled { gap: 1e-3 * gap_mm }
    } else {
        Rest::Fixed {
            sink: 1e-3 * sink_mm,
        }
    };
}
