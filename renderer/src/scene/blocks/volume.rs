//! `[objects.NAME.volume]`: leaves afloat in a box, even, in rows or in crowns.

pub(in crate::scene) mod inclination;

use glam::DVec3;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Integer, ListOf, Number, Numbers, Vector};

use crate::geometry::instance::COORDINATES_M;
use crate::geometry::scatter::{Arrangement, Centres, Inclination, Volume};
use crate::scene::description::Object;

/// Lengths of rows and crowns, m.
const LENGTHS_M: Limits = Limits::above(0.0, 1e6);
/// Most crowns.
const MOST_CROWNS: usize = 1 << 20;

fn usual() -> Volume {
    Volume {
        within: [DVec3::ZERO, DVec3::ONE],
        lai: 1.0,
        inclination: Inclination::Spherical,
        arrangement: Arrangement::Even,
        seed: 0,
    }
}

/// The key `volume` of an object.
pub(super) fn volume(object: &mut Object, keys: &mut Keys<'_>) {
    for other in ["instances", "scatter", "plant"] {
        keys.exclude(other, "volume");
    }
    let mut volume = object.volume.take().map(|volume| *volume);
    let about = "A box in which copies of the object float, instead of its own place.";
    keys.optional_block("volume", &mut volume, usual, about, afloat);
    object.volume = volume.map(Box::new);
}

fn afloat(volume: &mut Volume, keys: &mut Keys<'_>) {
    let mut within = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    let kind = Numbers::<6>(COORDINATES_M);
    let about = "The box for their origins: least x, y and z, greatest x, y and z.";
    keys.required("within_m", &mut within, kind, about);
    let [x0, y0, z0, x1, y1, z1] = within;
    if x0 >= x1 || y0 >= y1 || z0 > z1 {
        let problem = "the box has no ground plan".to_owned();
        let help = "write the least x, y and z first: `within_m = [0, 0, 0, 1, 1, 0.5]`";
        keys.refuse(&["within_m"], problem, help);
    }
    volume.within = [DVec3::new(x0, y0, z0), DVec3::new(x1, y1, z1)];
    let about = "Leaf area index: area of all copies over the area of the box's ground plan, gaps \
        between rows and crowns included; 0 leaves the box empty.";
    let limits = Number(Limits::closed(0.0, 1000.0));
    keys.required("lai", &mut volume.lai, limits, about);
    inclination::declare(&mut volume.inclination, keys);
    arrangement(volume, keys);
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut volume.seed,
        seed,
        "Same numbers and seed, same places.",
    );
}

fn arrangement(volume: &mut Volume, keys: &mut Keys<'_>) {
    keys.exclude("rows", "crowns");
    let mut rows = None;
    let mut in_crowns = None;
    match &volume.arrangement {
        Arrangement::Even => {}
        Arrangement::Rows { spacing, width } => rows = Some([*spacing, *width]),
        Arrangement::Crowns { radius, centres } => in_crowns = Some((*radius, centres.clone())),
    }
    let [least, most] = volume.within;
    let size = most - least;
    let about = "Rows along y in which they float, instead of the whole box.";
    let new = || [1.0, 1.0];
    keys.optional_block("rows", &mut rows, new, about, |[spacing, width], keys| {
        let about = "From the middle of one row to that of the next; the box is a whole number of \
            spacings wide.";
        keys.required("spacing_m", spacing, Number(LENGTHS_M), about);
        let about = "Width of a row, at most the spacing.";
        keys.required("width_m", width, Number(LENGTHS_M), about);
        let count = size.x / *spacing;
        let is_whole = count >= 0.5 && (count - count.round()).abs() < 1e-6 * count;
        if keys.is_sound() && !is_whole {
            let problem = format!("the box is {count:.3} spacings wide along x");
            let help = "let it be a whole number, so that rows keep their distance where the box \
                repeats itself";
            keys.refuse(&["spacing_m"], problem, help);
        }
        if keys.is_sound() && *width > *spacing {
            let problem = format!("rows of {width} m every {spacing} m would overlap");
            keys.refuse(&["width_m"], problem, "make it at most `spacing_m`");
        }
    });
    let about = "Balls in which they float, clumped, instead of the whole box.";
    let new = || (1.0, Centres::Random(1));
    keys.optional_block("crowns", &mut in_crowns, new, about, |crowns, keys| {
        let (radius, centres) = crowns;
        let about = "Radius of each.";
        keys.required("radius_m", radius, Number(LENGTHS_M), about);
        crown_centres(centres, volume.within, *radius, keys);
    });
    volume.arrangement = match (rows, in_crowns) {
        (Some([spacing, width]), _) => Arrangement::Rows { spacing, width },
        (None, Some((radius, centres))) => Arrangement::Crowns { radius, centres },
        (None, None) => Arrangement::Even,
    };
}

fn crown_centres(
    centres: &mut Centres,
    [least, most]: [DVec3; 2],
    radius: f64,
    keys: &mut Keys<'_>,
) {
    let current = match centres {
        Centres::Random(_) => "count",
        Centres::At(_) => "at_m",
    };
    for way in keys.one_of(&["count", "at_m"], Some(current)) {
        if way == "count" {
            let mut count = match centres {
                Centres::Random(count) => *count,
                Centres::At(_) => 1,
            };
            let kind = Integer::within(1, MOST_CROWNS as u64);
            let about = "So many at random, without regard to each other, within the height of the \
                box.";
            keys.required("count", &mut count, kind, about);
            *centres = Centres::Random(count);
            let height = most.z - least.z;
            if keys.is_sound() && 2.0 * radius > height {
                let problem = format!("crowns of {radius} m do not fit into a box {height} m high");
                keys.refuse(
                    &["radius_m"],
                    problem,
                    "make the box higher or the crowns smaller",
                );
            }
        } else {
            let mut places = match centres {
                Centres::Random(_) => Vec::new(),
                Centres::At(places) => places.clone(),
            };
            let kind = ListOf {
                of: Vector(COORDINATES_M),
                least: 1,
                most: MOST_CROWNS,
                wanted: "a list of middles [x, y, z]",
            };
            let about = "Their middles.";
            keys.required("at_m", &mut places, kind, about);
            let is_out = |at: &&DVec3| !(at.cmpge(least) & at.cmple(most)).all();
            if let Some(at) = places.iter().find(is_out).filter(|_| keys.is_sound()) {
                let problem = format!("{}, {}, {} lies outside of the box", at.x, at.y, at.z);
                keys.refuse(&["at_m"], problem, "move it, or widen `within_m`");
            }
            *centres = Centres::At(places);
        }
    }
}
