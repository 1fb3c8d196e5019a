//! Petioles and compound leaves as the blocks that read back to them: the mirror image of [`super::compound`] and
//! [`super::petiole`].

use leafmodel::blade::petiole::PetiolePlan;
use leafmodel::compound::{Arrangement, CompoundForm, Feather};

use super::tree::Value;
use super::write_leaf::{Keys, degrees, list, number};

/// The block `petiole`.
pub(super) fn petiole(plan: &PetiolePlan) -> Keys {
    let mut keys = Keys::default();
    keys.number("length", plan.length);
    if let Some(radius) = plan.radius_mm {
        keys.number("radius_mm", radius);
    }
    keys.number_unless("curl_deg", degrees(plan.curl), 0.0);
    keys
}

/// The block `compound`.
pub(super) fn compound(form: &CompoundForm) -> Keys {
    let mut keys = Keys::default();
    let kind = match &form.arrangement {
        Arrangement::Pinnate(rows) => {
            feather(&mut keys, rows);
            "pinnate"
        }
        Arrangement::Palmate {
            leaflets,
            spread,
            sizes,
        } => {
            keys.integer("leaflets", (*leaflets).into());
            keys.number("spread_deg", degrees(*spread));
            numbers_unless(&mut keys, "sizes", sizes, &[1.0; 2]);
            "palmate"
        }
        Arrangement::Bipinnate { stalk, .. } => {
            keys.number("stalk", *stalk);
            "bipinnate"
        }
    };
    let usual = CompoundForm::new(form.arrangement.clone());
    keys.number_unless("petiole", form.petiole, usual.petiole);
    keys.number_unless("petiolule", form.petiolule, usual.petiolule);
    keys.number_unless(
        "stalk_radius_mm",
        form.stalk_radius_mm,
        usual.stalk_radius_mm,
    );
    if form.variants != usual.variants {
        keys.integer("variants", form.variants.into());
    }
    keys.number_unless("curl_deg", degrees(form.curl), 0.0);
    keys.number_unless("fold_deg", degrees(form.fold), 0.0);
    keys.number_unless("tilt_deg", degrees(form.tilt), 0.0);
    if let Arrangement::Bipinnate {
        pinnae, leaflets, ..
    } = &form.arrangement
    {
        for (key, rows) in [("pinnae", pinnae), ("leaflets", leaflets)] {
            let mut block = Keys::default();
            feather(&mut block, rows);
            keys.block(key, block);
        }
    }
    Keys::default().with(kind, keys)
}

fn feather(keys: &mut Keys, rows: &Feather) {
    keys.number("rachis", rows.rachis);
    keys.integer("pairs", rows.pairs.into());
    if !rows.terminal {
        keys.value("terminal", Value::Flag(false));
    }
    keys.number_unless("alternation", rows.alternation, 0.0);
    let angles = rows.angles.map(|angle| number(degrees(angle)));
    keys.value("angles_deg", list(angles));
    numbers_unless(keys, "sizes", &rows.sizes, &[1.0; 3]);
    keys.number_unless("turn_deg", degrees(rows.turn), 0.0);
}

fn numbers_unless(keys: &mut Keys, key: &str, values: &[f64], usual: &[f64]) {
    if values != usual {
        keys.value(key, list(values.iter().copied().map(number)));
    }
}
