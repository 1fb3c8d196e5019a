//! Architectures that contradict themselves or their outline.

use super::ground::Ground;
use super::margin::Margin;
use super::primaries;
use super::secondaries::{self, agrophic};
use super::{
    Agrophic, Architecture, Lots, PrimaryPattern, QuaternaryCourse, SecondaryEnding, TertiaryCourse,
};
use crate::document::{Declared, Words};
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::outline::Outline;

/// Secondaries of one side are at least so many segments of the young leaf apart.
const CLOSEST: f64 = 4.0;

/// Tertiaries between which quaternaries can be laid out are at least so many segments of the young
/// leaf apart.
const LADDER: f64 = 5.0;

/// Veins nearer to each other than so many segments of the young leaf run into one.
const APART: f64 = 2.5;

/// The block of an architecture.
const KEY: &str = "venation.*.architecture";
const ANGLES: &str = "lateral_primary_angles_deg";
const AGROPHIC: &str = "secondaries.agrophic";
const ENDING: &str = "secondaries.ending";
const PAIRS: &str = "secondaries.pairs";
const WIDER: &str = "use a wider spacing, or a longer young leaf: initial_length_segments";

impl Architecture {
    /// Checks all that needs no outline.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn validate(&self) -> Result<(), NotGrown> {
        let help = "use a number in range";
        let checked = self.in_range();
        checked.map_err(|error| not_grown!("architecture: {error}").mend(KEY, help))?;
        let angles = &self.primaries.lateral_angles_deg;
        let named = angles.len();
        let pattern = self.primaries.pattern.word();
        let (wanted, fits) = match self.primaries.pattern {
            PrimaryPattern::Pinnate => ("no", named == 0),
            PrimaryPattern::Palinactinodromous => ("2 to 6", (2..=6).contains(&named)),
            PrimaryPattern::Acrodromous => ("1 to 3", (1..=3).contains(&named)),
            PrimaryPattern::Actinodromous | PrimaryPattern::Flabellate => {
                ("1 to 6", (1..=6).contains(&named))
            }
            PrimaryPattern::Parallelodromous | PrimaryPattern::Campylodromous => {
                ("no angles of", named == 0)
            }
        };
        let problem = || {
            format!(
                "{pattern} venation has {wanted} lateral primaries a side; \
                 lateral_primary_angles_deg names {named}"
            )
        };
        let help = "name an angle for each lateral primary of one side, or choose another pattern";
        unless(fits, ANGLES, problem, help)?;
        let many = matches!(
            self.primaries.pattern,
            PrimaryPattern::Parallelodromous | PrimaryPattern::Campylodromous
        );
        let laterals = self.primaries.laterals;
        let problem = || {
            let wanted = if many { "1 to 30" } else { "0" };
            format!("{pattern} venation has {wanted} lateral_primaries a side, not {laterals}")
        };
        let help = "only parallelodromous and campylodromous leaves have a number of them";
        let fits = many == (laterals > 0);
        unless(fits, "lateral_primaries", problem, help)?;
        let has_secondaries = !many && self.primaries.pattern != PrimaryPattern::Flabellate;
        let pairs = self.secondaries.pairs;
        let problem = || {
            format!(
                "{pattern} venation has no secondaries between its primaries, not {pairs} pairs"
            )
        };
        let help = "use 0, or choose another pattern";
        unless(has_secondaries || pairs == 0, PAIRS, problem, help)?;
        self.check_bearers(pattern)?;
        let fits = self.quaternaries.course == QuaternaryCourse::Reticulate
            || self.tertiaries.course != TertiaryCourse::Reticulate;
        let problem = || {
            "quaternaries that are laid out lie between percurrent tertiaries, and the tertiaries \
             are reticulate"
                .to_owned()
        };
        let help = "use \"reticulate\", or percurrent tertiaries";
        unless(fits, "quaternaries.course", problem, help)?;
        let lists: [(&str, &[f64], _); 2] = [
            (ANGLES, angles, "begin with the angle nearest to the midrib"),
            (
                "secondaries.span",
                &self.secondaries.span,
                "write the lower place first",
            ),
        ];
        for (path, list, help) in lists {
            if let Some(pair) = list.windows(2).find(|pair| pair[0] >= pair[1]) {
                let (key, first, second) =
                    (path.rsplit('.').next().unwrap_or(path), pair[0], pair[1]);
                let problem = || format!("{key} does not ascend: {first} is followed by {second}");
                unless(false, path, problem, help)?;
            }
        }
        Ok(())
    }

    /// Refuses agrophic veins where no secondary can bear them.
    fn check_bearers(&self, pattern: &str) -> Result<(), NotGrown> {
        let plan = &self.secondaries;
        let bearers = match plan.agrophic {
            Agrophic::Absent => return Ok(()),
            Agrophic::Simple => "lowest pair of secondaries",
            Agrophic::Compound => "two lowest pairs of secondaries",
        };
        let there = if self.primaries.pattern != PrimaryPattern::Pinnate {
            format!("{pattern} venation has lateral primaries, whose outer secondaries they are")
        } else if (plan.pairs as usize) < plan.agrophic.combs() {
            format!("{} pairs are asked for", plan.pairs)
        } else {
            return Ok(());
        };
        let problem = || {
            let kind = plan.agrophic.word();
            format!("{kind} agrophic veins leave the {bearers} of pinnate venation; {there}")
        };
        let help = "use \"absent\", or pinnate primaries with as many pairs";
        unless(false, AGROPHIC, problem, help)
    }

    /// Checks what only the outline can tell; `blade` is full-grown in segments, base at the
    /// origin, `young` the length of the leaf when veins are laid out, over its full length.
    pub(crate) fn validate_on(&self, blade: &Outline, young: f64) -> Result<(), NotGrown> {
        let plan = &self.secondaries;
        let pairs = plan.pairs;
        let apex = blade.apex();
        let fits = !blade.is_crossed_by(apex * 0.01, apex * 0.99);
        let problem = || {
            "the straight way from base to apex leaves the blade: a midrib cannot be laid out on it"
                .to_owned()
        };
        let help = "leave the architecture out, or draw an outline that holds its midrib";
        unless(fits, "", problem, help)?;
        let length = young * blade.length();
        let reach = (plan.span[1] - plan.span[0]) * length;
        let apart = reach / f64::from(pairs.max(1));
        let problem = || {
            let fit = (reach / CLOSEST) as u32;
            format!(
                "{pairs} pairs of secondaries lie {apart:.1} segments apart in the young leaf, \
                 less than 4; {fit} pairs fit"
            )
        };
        let help = "use fewer pairs, a wider span, or a longer young leaf: initial_length_segments";
        let is_crowded = pairs > 0 && apart < CLOSEST;
        unless(!is_crowded, PAIRS, problem, help)?;
        self.check_spacing(blade, young)?;
        let margin = Margin::new(blade);
        self.check_ends(&margin)?;
        let lots = Lots::new(0, 0.0);
        let ground = Ground {
            blade,
            margin: &margin,
            lots,
        };
        let axes = primaries::lay_out(self, ground);
        let asked = 2 * self.primaries.lateral_angles_deg.len();
        let problem = || {
            let fit = axes.len() - 1;
            format!(
                "of {asked} lateral primaries only {fit} point into the blade where they part from \
                 the midrib"
            )
        };
        let help = "use smaller angles, or a greater part_at: higher up the blade is wider";
        unless(axes.len() > asked, ANGLES, problem, help)?;
        let site = secondaries::Site {
            ground,
            axes: &axes,
        };
        let laid = secondaries::lay_out(self, site);
        let of = |side: f64| {
            let on = laid.veins.iter().filter(|v| v.axis == 0 && v.side == side);
            on.count() as u32
        };
        let fit = of(1.0).min(of(-1.0));
        let problem = || {
            format!(
                "of {pairs} pairs of secondaries only {fit} on one side of the midrib have a way to \
                 the margin"
            )
        };
        let help = "use fewer pairs, or a span that starts above the lateral primaries";
        unless(fit >= pairs, PAIRS, problem, help)?;
        let bearers = agrophic::bearers(plan, &laid.veins);
        let fit = laid.agrophic.poorest(&bearers);
        let problem = || {
            let ending = plan.ending.word();
            let to = match plan.ending {
                SecondaryEnding::Craspedodromous => "to a tooth",
                SecondaryEnding::Sinus => "to a sinus",
                SecondaryEnding::Semicraspedodromous
                | SecondaryEnding::Eucamptodromous
                | SecondaryEnding::Brochidodromous
                | SecondaryEnding::Festooned => "to the margin",
            };
            format!(
                "a comb of agrophic veins has 2 or more; {fit} of one {ending} comb find a way \
                 {to} outside its secondary"
            )
        };
        let help = "use \"absent\", a span that starts higher, or an outline that is wider or has \
                    more teeth near its base";
        let fits = plan.agrophic == Agrophic::Absent || fit >= agrophic::LEAST;
        unless(fits, AGROPHIC, problem, help)
    }

    /// Refuses tertiaries, quaternaries and primaries too near to each other.
    fn check_spacing(&self, blade: &Outline, young: f64) -> Result<(), NotGrown> {
        let length = young * blade.length();
        let close = |veins: &str, apart: f64, least: f64| {
            format!(
                "{veins} {apart:.2} segments of the young leaf apart, less than {least}, cannot be \
                 told from each other"
            )
        };
        let enough = |veins: &str, apart: f64| {
            let (close, least) = (close(veins, apart, APART), APART / length);
            format!("{close}; a spacing of {least:.4} or more can")
        };
        let key = "tertiaries.spacing";
        let apart = self.tertiaries.spacing * length;
        let fits = self.tertiaries.course == TertiaryCourse::Reticulate || apart >= APART;
        unless(fits, key, || enough("tertiaries", apart), WIDER)?;
        if self.quaternaries.course != QuaternaryCourse::Reticulate {
            let problem = || {
                let least = LADDER / length;
                format!(
                    "tertiaries {apart:.2} segments of the young leaf apart leave quaternaries no \
                     room, which takes 5; a spacing of {least:.4} or more does"
                )
            };
            unless(apart >= LADDER, key, problem, WIDER)?;
            let key = "quaternaries.spacing";
            let apart = self.quaternaries.spacing * length;
            unless(apart >= APART, key, || enough("quaternaries", apart), WIDER)?;
        }
        let (low, high) = blade.bounds();
        let apart = if self.primaries.pattern == PrimaryPattern::Flabellate {
            self.primaries.fork_spacing * length
        } else if self.primaries.laterals > 0 {
            let width = young * (high.x - low.x);
            0.5 * width / f64::from(self.primaries.laterals + 1)
        } else {
            f64::INFINITY
        };
        let help = "use fewer primaries or a wider fork_spacing, or a longer young leaf: \
                    initial_length_segments";
        unless(apart >= 3.0, "", || close("primaries", apart, 3.0), help)
    }

    /// Refuses secondaries that run to teeth or sinuses which are not there.
    fn check_ends(&self, margin: &Margin) -> Result<(), NotGrown> {
        let pairs = self.secondaries.pairs;
        let ending = self.secondaries.ending.word();
        let ([right, left], ends, wanted, help) = match self.secondaries.ending {
            SecondaryEnding::Sinus => (
                margin.sinuses_a_side(),
                "between teeth or lobes",
                "as many sinuses",
                "give the outline lobes or teeth, use fewer pairs, or let the secondaries end inside \
                 the margin: eucamptodromous or brochidodromous",
            ),
            SecondaryEnding::Craspedodromous | SecondaryEnding::Semicraspedodromous => (
                margin.tips_a_side(),
                "in teeth or lobes",
                "as many",
                "give the outline teeth, use fewer pairs, or let the secondaries end inside the \
                 margin: eucamptodromous or brochidodromous",
            ),
            SecondaryEnding::Eucamptodromous
            | SecondaryEnding::Brochidodromous
            | SecondaryEnding::Festooned => return Ok(()),
        };
        let problem = || {
            format!(
                "{ending} secondaries end {ends}: {pairs} pairs need {wanted} a side, and the \
                 outline has {right} on the right and {left} on the left"
            )
        };
        let fits = right.min(left) >= pairs as usize;
        unless(fits, ENDING, problem, help)
    }
}

/// Refuses what a key of the architecture says unless it is `valid`; the empty key is the whole block.
fn unless(
    valid: bool,
    key: &str,
    problem: impl FnOnce() -> String,
    help: &'static str,
) -> Result<(), NotGrown> {
    let path = [KEY, key].join(if key.is_empty() { "" } else { "." });
    let refused = || NotGrown::because(problem()).mend(&path, help);
    valid.then_some(()).ok_or_else(refused)
}
