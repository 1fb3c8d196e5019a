//! Presets' margins and veins, grown once for all tests of a program: many claims look at the same leaf.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use super::find;
use crate::leaf::Lamina;
use crate::measure::{Measures, measure};

/// A preset's margin and veins, and what was measured of them.
#[derive(Default)]
struct Kept {
    lamina: OnceLock<Lamina>,
    measures: OnceLock<Measures>,
}

static GROWN: LazyLock<Mutex<HashMap<String, Arc<Kept>>>> = LazyLock::new(Mutex::default);

fn kept(name: &str) -> Arc<Kept> {
    let mut grown = GROWN.lock().expect("no test fails in here");
    Arc::clone(grown.entry(name.to_owned()).or_default())
}

fn lamina_of<'a>(kept: &'a Kept, name: &str) -> &'a Lamina {
    kept.lamina.get_or_init(|| {
        let plan = find(name).expect("a preset").plan();
        plan.grow_lamina().expect("a good plan")
    })
}

/// Margin and veins of the preset of this name.
pub(crate) fn lamina(name: &str) -> Lamina {
    lamina_of(&kept(name), name).clone()
}

/// What is measured of the preset of this name.
pub(crate) fn measures(name: &str) -> Measures {
    let kept = kept(name);
    let measured = kept.measures.get_or_init(|| {
        let lamina = lamina_of(&kept, name);
        let exponent = find(name)
            .expect("a preset")
            .plan()
            .venation
            .murray_exponent();
        measure(&lamina.outline, &lamina.network, exponent)
    });
    measured.clone()
}
