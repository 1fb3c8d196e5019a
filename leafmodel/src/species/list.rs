//! The presets, in the order in which a list shows them.

mod colours;
mod compound;
mod developed;
mod plants;
mod runions;
mod splines;
mod transport;

use super::young::{FORMS, Form};
use super::{PlanOf, Preset};

/// All presets: the figures of Runions et al. 2005 in their order, extensions of that paper, trees
/// and shrubs, leaves in other colours, splines, the examples of Xia 2007, leaves that develop from
/// their margin, extensions of Young 2010, compound leaves, then the figures of Young 2010.
pub static PRESETS: &[Preset] = &joined::<{ GROWN + FORMS.len() }>();

/// The presets with a function of their own.
static GROUPS: [&[Preset]; 7] = [
    runions::RUNIONS,
    plants::PLANTS,
    &colours::COLOURS,
    splines::SPLINES,
    transport::TRANSPORT,
    developed::DEVELOPED,
    compound::COMPOUND,
];

/// Their number.
const GROWN: usize = {
    let (mut count, mut group) = (0, 0);
    while group < GROUPS.len() {
        count += GROUPS[group].len();
        group += 1;
    }
    count
};

/// All groups in order, then the forms.
const fn joined<const N: usize>() -> [Preset; N] {
    let mut presets = [GROUPS[0][0]; N];
    let (mut next, mut group) = (0, 0);
    while group < GROUPS.len() {
        let mut i = 0;
        while i < GROUPS[group].len() {
            presets[next] = GROUPS[group][i];
            next += 1;
            i += 1;
        }
        group += 1;
    }
    while next < N {
        presets[next] = of_form(&FORMS[next - GROWN]);
        next += 1;
    }
    presets
}

const fn of_form(form: &'static Form) -> Preset {
    Preset {
        name: form.name,
        about: form.about,
        source: form.source(),
        row: None,
        plan: PlanOf::Form(form),
    }
}
