//! Ageing: an age field decides where and when tissue dies; dead tissue has other contents.

use glam::DVec2;

use super::ageing::leaf::AgeingLeaf;
use super::ageing::{Course, Place};
use super::ageing_courses::{COURSES, LITTER, YELLOW};
use crate::document::{Declared, Keys, Limits, Number, Word};
use crate::numeric::smooth_step;
use crate::optics::Contents;
use crate::optics::contents_keys::contents;
use crate::transport::DeathField;

/// How far a leaf has aged, and the contents of its dead tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Senescence {
    /// The order in which tissue dies, and how far ageing has come.
    pub source: AgeSource,
    /// Width of the transition from living to dead, in the unit of the source: 0.001 to 1 of the
    /// revenue, 0.001 to 1000 days.
    pub blend: f64,
    /// Contents of dead tissue between veins; veins change them as they do those of living tissue.
    pub contents: Contents,
}

/// The order in which tissue dies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a leaf has one, and what copies freely is easier to change"
)]
pub enum AgeSource {
    /// The cells of a transport leaf die when their revenue no longer covers their supply (Remark
    /// 3.6 of \[xia2007\]).
    Revenue {
        /// The cells' revenue as a share of that of the full-grown leaf: 1 is summer, at 0 all are
        /// dead.
        share: f64,
    },
    /// Tissue follows a course, counted at each place from the day on which it begins to age.
    Day {
        /// Days since the first place of the leaf began to age, 0 to 10000; at 0 it has not aged.
        day: f64,
        /// The course of ageing, and its delays.
        course: Course,
    },
}

impl Senescence {
    /// Latest day that a leaf may have.
    pub const LATEST_DAY: f64 = 1e4;
    /// Days for which a leaf may have aged.
    pub const DAYS: Limits = Limits::closed(0.0, Self::LATEST_DAY);
}

impl Senescence {
    /// The day from which on all tissue is dead, if it ages by days; may come after
    /// [`Senescence::LATEST_DAY`].
    pub fn last_day(&self) -> Option<f64> {
        match self.source {
            AgeSource::Revenue { .. } => None,
            AgeSource::Day { course, .. } => {
                Some(course.death_day + course.death.most() + self.blend)
            }
        }
    }

    /// The same ageing on another day; `None` if it is not by days.
    #[must_use]
    pub fn on_day(&self, day: f64) -> Option<Self> {
        match self.source {
            AgeSource::Revenue { .. } => None,
            AgeSource::Day { course, .. } => Some(Self {
                source: AgeSource::Day { day, course },
                ..*self
            }),
        }
    }

    /// Whether it needs the cells of a transport leaf.
    pub(crate) fn needs_cells(&self) -> bool {
        match self.source {
            AgeSource::Revenue { .. } => true,
            AgeSource::Day { course, .. } => {
                course.onset.deaths_days > 0.0 || course.death.deaths_days > 0.0
            }
        }
    }
}

/// Width of the transition from living to dead where nothing is said.
const BLEND: f64 = 0.08;
/// Days from living to dead where nothing is said.
const BLEND_DAYS: f64 = 4.0;

impl Default for Senescence {
    /// Ageing of which nothing is said.
    fn default() -> Self {
        Self {
            source: AgeSource::Day {
                day: 0.0,
                course: YELLOW,
            },
            blend: BLEND_DAYS,
            contents: LITTER,
        }
    }
}

impl Declared for Senescence {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let current = match self.source {
            AgeSource::Day { .. } => "day",
            AgeSource::Revenue { .. } => "revenue_share",
        };
        let has_base = keys.base().is_some();
        let chosen = keys.one_of(&["day", "revenue_share"], Some(current));
        // With none, or both, the other keys may still be wrong.
        let chosen = match (chosen.is_empty(), has_base) {
            (false, _) => chosen,
            (true, true) => vec![current],
            (true, false) => vec![""],
        };
        for name in chosen {
            if name == "revenue_share" {
                by_revenue(self, keys);
            } else {
                by_days(self, keys, name == "day");
            }
        }
    }
}

fn by_revenue(value: &mut Senescence, keys: &mut Keys<'_>) {
    let mut share = match value.source {
        AgeSource::Revenue { share } => share,
        AgeSource::Day { .. } => {
            value.blend = BLEND;
            1.0
        }
    };
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "What cells earn now as a share of what they earned when full-grown: 1 is \
        summer, 0 all are dead. Cells whose supply no longer pays die, tips first. Needs \
        `outline.transport` or `venation.transport`; with both, the cells of the venation \
        decide.";
    keys.required("revenue_share", &mut share, limits, about);
    let limits = Number(Limits::closed(0.001, 1.0));
    let about = "Width of the transition from living to dead in that share.";
    keys.key("blend", &mut value.blend, limits, about);
    let held = &mut value.contents;
    let about = "What dead tissue holds.";
    keys.required_block("contents", about, &[], |keys| contents(held, keys));
    value.source = AgeSource::Revenue { share };
}

fn by_days(value: &mut Senescence, keys: &mut Keys<'_>, has_day: bool) {
    let (mut day, mut course) = match value.source {
        AgeSource::Day { day, course } => (day, course),
        AgeSource::Revenue { .. } => {
            value.blend = BLEND_DAYS;
            value.contents = LITTER;
            (0.0, YELLOW)
        }
    };
    if has_day {
        let limits = Number(Senescence::DAYS);
        let about = "Since the leaf began to age where it does first; at 0 it has not.";
        keys.required("day", &mut day, limits, about);
    }
    let limits = Number(Limits::closed(0.001, 1e3));
    let about = "From living to dead.";
    keys.key("blend_days", &mut value.blend, limits, about);
    let mut named = None;
    let about = "Whence the numbers below are taken where they are left out; the defaults here \
        are those of yellow.";
    keys.optional("course", &mut named, Word(&COURSES), about);
    course = named.unwrap_or(course);
    course.declare(keys);
    let mut held = (value.contents != LITTER).then_some(value.contents);
    let about = "What dead tissue holds; left out, litter.";
    keys.optional_block("contents", &mut held, || LITTER, about, contents);
    value.contents = held.unwrap_or(LITTER);
    value.source = AgeSource::Day { day, course };
}

/// The ageing of a leaf at each of its places.
#[derive(Clone, Debug)]
pub struct Withering(Way);

#[derive(Clone, Debug)]
enum Way {
    Revenue {
        field: Box<DeathField>,
        /// Tissue with a greater age value than this has begun to die.
        threshold: f64,
        blend: f64,
        dead: Contents,
    },
    Day(Box<AgeingLeaf>),
}

impl Withering {
    /// Ageing of the leaf that `place` describes. `deaths` is the death field of its cells, if it
    /// has any; `seed` decides which patches come first.
    ///
    /// `None` if cells are needed but missing.
    pub fn new(
        senescence: &Senescence,
        place: &Place<'_>,
        deaths: Option<DeathField>,
        seed: u64,
    ) -> Option<Self> {
        let Senescence {
            source,
            blend,
            contents,
        } = *senescence;
        if senescence.needs_cells() && deaths.is_none() {
            return None;
        }
        match source {
            AgeSource::Revenue { share } => {
                deaths.map(|field| Self::by_revenue(field, share, blend, contents))
            }
            AgeSource::Day { day, course } => {
                let end = (blend, contents);
                let leaf = AgeingLeaf::new(&course, day, end, place, deaths.as_ref(), seed);
                Some(Self(Way::Day(Box::new(leaf))))
            }
        }
    }

    /// Ageing by the deaths of a transport leaf's cells.
    pub(crate) fn by_revenue(field: DeathField, share: f64, blend: f64, dead: Contents) -> Self {
        // At a share of 1 even the first tissue to die is still alive; at 0 even the last is dead.
        let threshold = share * (1.0 + blend) - blend;
        Self(Way::Revenue {
            field: Box::new(field),
            threshold,
            blend,
            dead,
        })
    }

    /// Dead share of the tissue at a point (mm): 0 alive, 1 dead, with a smooth step over the blend
    /// between.
    pub(crate) fn dead_share(&self, point: DVec2) -> f64 {
        match &self.0 {
            Way::Revenue {
                field,
                threshold,
                blend,
                ..
            } => smooth_step((field.at(point) - threshold) / blend),
            Way::Day(leaf) => leaf.dead_share(point),
        }
    }

    /// Contents of the tissue between veins at a point (mm); `living` are its contents before
    /// ageing.
    pub fn contents(&self, living: Contents, point: DVec2) -> Contents {
        match &self.0 {
            Way::Revenue { dead, .. } => living.towards(*dead, self.dead_share(point)),
            Way::Day(leaf) => leaf.contents(living, point),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::Constituent;
    use crate::transport::example;

    const DEAD: Contents = Contents::of(&[
        (Constituent::Structure, 2.0),
        (Constituent::Chlorophyll, 1.0),
        (Constituent::Carotenoids, 3.0),
        (Constituent::Brown, 1.0),
        (Constituent::Water, 0.001),
        (Constituent::DryMatter, 0.005),
    ]);

    const LIVING: Contents = Contents::of(&[
        (Constituent::Structure, 1.5),
        (Constituent::Chlorophyll, 40.0),
        (Constituent::Carotenoids, 9.0),
        (Constituent::Anthocyanins, 0.5),
        (Constituent::Water, 0.01),
        (Constituent::DryMatter, 0.005),
    ]);

    fn withering(share: f64, blend: f64) -> Withering {
        let leaf = example(1)
            .expect("there is one")
            .grow(1)
            .expect("a good plan");
        let field = leaf.death_field(60.0).expect("a margin");
        Withering::by_revenue(field, share, blend, DEAD)
    }

    fn points() -> impl Iterator<Item = DVec2> {
        (-25..=25).flat_map(|x| (-5..=60).map(move |y| DVec2::new(f64::from(x), f64::from(y))))
    }

    #[test]
    fn in_summer_all_is_alive_and_without_revenue_all_is_dead() {
        for blend in [0.001, 0.1, 1.0] {
            let (summer, end) = (withering(1.0, blend), withering(0.0, blend));
            for p in points() {
                assert_eq!(summer.contents(LIVING, p), LIVING);
                assert_eq!(end.dead_share(p), 1.0);
            }
        }
    }

    #[test]
    fn tissue_only_dies_as_revenue_falls() {
        let stages = [1.0, 0.9, 0.7, 0.4, 0.1].map(|share| withering(share, 0.1));
        let mut half_dead = 0;
        for p in points() {
            for pair in stages.windows(2) {
                assert!(pair[1].dead_share(p) >= pair[0].dead_share(p));
            }
            half_dead += usize::from((0.1..0.9).contains(&stages[1].dead_share(p)));
        }
        assert!(half_dead > 50, "a transition has a width: {half_dead}");
    }

    #[test]
    fn each_number_out_of_range_is_refused_by_name() {
        let good = Senescence {
            source: AgeSource::Revenue { share: 0.5 },
            blend: 0.1,
            contents: DEAD,
        };
        assert_eq!(good.in_range(), Ok(()));
        let field = |bad: Senescence| bad.in_range().expect_err("out of range").path;
        let source = AgeSource::Revenue { share: 1.1 };
        assert_eq!(field(Senescence { source, ..good }), "revenue_share");
        let source = AgeSource::Revenue { share: f64::NAN };
        assert_eq!(field(Senescence { source, ..good }), "revenue_share");
        assert_eq!(field(Senescence { blend: 0.0, ..good }), "blend");
        let contents = DEAD.with(&[(Constituent::Structure, 0.5)]);
        assert_eq!(field(Senescence { contents, ..good }), "contents.structure");
    }
}
