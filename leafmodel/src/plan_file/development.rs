//! `development`: a leaf that develops from its margin.

use crate::development::{DevelopmentError, DevelopmentPlan, Sequence, Wave};
use crate::document::keys::{BlockList, Keys};
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number, Numbers, Word};

const SHARE: Number = Number(Limits::closed(0.0, 1.0));

/// Sequences by name.
const SEQUENCES: [(&str, Sequence); 3] = [
    ("basipetal", Sequence::Basipetal),
    ("acropetal", Sequence::Acropetal),
    ("intercalary", Sequence::Intercalary),
];

/// The keys of `outline.development`.
pub(super) fn development(plan: &mut DevelopmentPlan, keys: &mut Keys<'_>) {
    let form = &mut plan.primordium;
    let limits = Number(Limits::closed(0.02, 3.0));
    let about = "Greatest width of the primordium over its length.";
    keys.key("width", &mut form.width, limits, about);
    let limits = Number(Limits::closed(0.05, 0.95));
    let about = "Where along its midrib the primordium is widest.";
    keys.key("widest_at", &mut form.widest_at, limits, about);
    let limits = Number(Limits::closed(0.2, 3.0));
    let about = "How pointed its base is: 0.5 an ellipse, 1 a lens, 2 drawn out.";
    keys.key("taper_base", &mut form.taper_base, limits, about);
    let about = "How pointed its tip is.";
    keys.key("taper_tip", &mut form.taper_tip, limits, about);
    let limits = Number(Limits::closed(1.1, 1000.0));
    let about = "Length of the full-grown leaf, in primordia.";
    keys.key("growth", &mut plan.growth, limits, about);
    let limits = Number(Limits::closed(-0.9, 0.9));
    let about = "Where the leaf grows faster: 0 nowhere, towards 1 at the base, −1 at the tip.";
    keys.key("basal_growth", &mut plan.basal_growth, limits, about);
    let about =
        "How unlike distances, lengths and angles are by chance; the leaf's `seed` decides.";
    keys.key("irregularity", &mut plan.irregularity, SHARE, about);
    let count = Integer::within(20, 400);
    let about = "Points of the margin per length of the leaf, at least.";
    keys.key("resolution", &mut plan.resolution, count, about);
    let new = Wave::default;
    let waves = BlockList {
        most: 4,
        new: &new,
        wanted: "a list of at most 4 waves, such as { spacing = 0.3, hold = 0.2 }",
        is_inside_itself: false,
    };
    let about = "Waves of initiation of convergence points, each with a vein of its own.";
    keys.blocks("waves", &mut plan.waves, &waves, about, wave);
}

fn wave(wave: &mut Wave, keys: &mut Keys<'_>) {
    let lengths = Number(Limits::closed(1.0, 1000.0));
    let about = "Length of the leaf, in primordia, when the first may appear.";
    keys.key("from", &mut wave.from, lengths, about);
    let about = "Length of the leaf after which none appears.";
    keys.key("until", &mut wave.until, lengths, about);
    let limits = Number(Limits::closed(0.01, 10.0));
    let about = "Least distance from other convergence points along the margin, in primordia.";
    keys.key("spacing", &mut wave.spacing, limits, about);
    let about = "`basipetal` from the tip to the base, `acropetal` from the base to the tip, \
        `intercalary` in the middle of gaps.";
    keys.key("sequence", &mut wave.sequence, Word(&SEQUENCES), about);
    let zone = Numbers(Limits::closed(0.0, 1.0));
    let about = "The part of each side's margin where they appear: 0 the base, 1 the tip.";
    keys.key("zone", &mut wave.zone, zone, about);
    let about = "What transport along veins costs over that through other tissue: with 0 veins \
        join the nearest one squarely, with 1 they run to the base (palmate).";
    keys.key("transport", &mut wave.transport, SHARE, about);
    let [low, high] = &mut wave.rates;
    let rate = Number(Limits::closed(0.5, 1.5));
    let about = "How fast veins elongate, over the leaf, that end at the base of the margin.";
    keys.key("rate_base", low, rate, about);
    let about = "The same of veins that end at its tip; between, in between.";
    keys.key("rate_tip", high, rate, about);
    let about = "How much growth is held back between them: 0 an entire margin, 1 leaflets.";
    keys.key("hold", &mut wave.hold, SHARE, about);
    let about = "How much of that applies below the lowest of them.";
    keys.key("hold_base", &mut wave.hold_base, SHARE, about);
    let limits = Number(Limits::closed(0.1, 0.9));
    let about = "How much of the margin between the uppermost and the tip is the terminal lobe's.";
    keys.key("terminal", &mut wave.terminal, limits, about);
    let form = Number(Limits::closed(0.3, 8.0));
    let about = "Form of sinuses: 1 pointed, 2 rounded, 4 broad.";
    keys.key("sinus", &mut wave.sinus, form, about);
    let about = "Form of lobes and teeth: 1 pointed, 2 rounded, 4 broad.";
    keys.key("blunt", &mut wave.blunt, form, about);
    let limits = Number(Limits::closed(-0.9, 0.9));
    let about = "Where sinuses lie: 0 in the middle, towards 1 above the lower tooth, so that \
        teeth point to the apex.";
    keys.key("lean", &mut wave.lean, limits, about);
    let bend = Number(Limits::closed(-0.3, 0.3));
    let about = "How far veins arch towards the tip, in shares of their length.";
    keys.key("bow", &mut wave.bow, bend, about);
    let about = "How much the angles of veins widen per e-fold of the leaf's length.";
    keys.key("splay", &mut wave.splay, bend, about);
}

/// Reports a development that each of its numbers allows and that gives no leaf all the same;
/// `keys` are the leaf's.
pub(super) fn report(keys: &Keys<'_>, error: &DevelopmentError) {
    let block = ["outline", "development"];
    let of_wave = |wave: &usize, key: &'static str, help: &str| {
        let number = wave.to_string();
        let path = ["outline", "development", "waves", &number, key];
        let list = &path[..3];
        let there = if keys.has_path(&path) { &path } else { list };
        keys.refuse(there, error.to_string(), help);
    };
    match error {
        DevelopmentError::NoTime { wave, .. } => {
            of_wave(wave, "until", "let the wave end at a larger length");
        }
        DevelopmentError::TooLate { wave, .. } => {
            of_wave(
                wave,
                "from",
                "let the wave start earlier, or the leaf grow longer",
            );
        }
        DevelopmentError::NoZone { wave, .. } => {
            of_wave(wave, "zone", "give the lower end first");
        }
        DevelopmentError::TooManyVeins { wave, .. } => {
            of_wave(
                wave,
                "spacing",
                "use a larger spacing, or end the wave earlier",
            );
        }
        DevelopmentError::OfWave { wave, key, .. } => {
            of_wave(wave, key, "use a value within the range");
        }
        DevelopmentError::TooManyWaves { .. } => {
            let path = [block[0], block[1], "waves"];
            keys.refuse(&path, error.to_string(), "use fewer waves");
        }
        DevelopmentError::TooLongMargin { .. } => {
            let help = "use larger spacings, a lower resolution, or rates nearer to 1";
            let path = [block[0], block[1], "waves"];
            keys.refuse(&path, error.to_string(), help);
        }
        DevelopmentError::Margin(_) | DevelopmentError::BareVein => {
            let help = "use less splay, rates that differ less, or less hold";
            let path = [block[0], block[1], "waves"];
            keys.refuse(&path, error.to_string(), help);
        }
        DevelopmentError::OutOfRange { key, .. } => {
            let path = [block[0], block[1], key];
            keys.refuse(&path, error.to_string(), "use a value within the range");
        }
    }
}
