//! `preset`: the name of a leaf, or of a colour, whose numbers hold where a file says nothing else.

use super::leaf::leaf_of_preset;
use crate::document::context::{Context, QUOTED};
use crate::document::nearest::meant;
use crate::document::schema::Type;
use crate::document::source::escaped;
use crate::document::values::{listed, text_at};
use crate::document::{DocumentError, Integer, Keys, Kind, Node, Value};
use crate::leaf::LeafPlan;
use crate::optics::{Contents, presets};
use crate::species::{self, BLOCKS, Preset};

impl Preset {
    /// The whole plan of the leaf.
    pub fn plan(&self) -> LeafPlan {
        let plan = self.plan.get_or_init(|| {
            let mut plan = LeafPlan::of_length(100.0);
            species::read(self.opened(), |keys| {
                let about = "The plan.";
                keys.required_block("leaf", about, &[], |keys| leaf_of_preset(&mut plan, keys));
                keys.leave(&BLOCKS);
            });
            plan
        });
        plan.clone()
    }
}

/// One of many things by name.
pub(super) struct Chosen<T: 'static> {
    pub(super) kind: &'static str,
    pub(super) all: &'static [T],
    pub(super) name_of: fn(&'static T) -> &'static str,
    /// What it is, in words.
    pub(super) about: fn(&'static T) -> &'static str,
}

impl<T> Kind for Chosen<T> {
    type Of = &'static T;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<&'static T> {
        let (written, at) = text_at(cx, node, key)?;
        let found = self.all.iter().find(|one| (self.name_of)(one) == written);
        if found.is_none() {
            let names = || self.all.iter().map(|one| (self.name_of)(one));
            let error = DocumentError::UnknownName {
                kind: self.kind,
                name: escaped(written, QUOTED),
                nearest: meant(
                    written,
                    self.all
                        .iter()
                        .map(|one| ((self.name_of)(one), (self.about)(one))),
                ),
                known: listed(names()),
            };
            cx.error(at, error);
        }
        found
    }

    fn write(&self, value: &&'static T) -> Value {
        Value::Text((self.name_of)(value).to_owned())
    }

    fn describe(&self) -> Type {
        let names = self.all.iter().map(|one| (self.name_of)(one).to_owned());
        Type::Name(names.collect(), self.kind)
    }
}

/// The keys `preset` and `individual` of a leaf. Where `preset` is there the plan is that of the species, and no other key
/// is required.
pub fn leaf_preset(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let chosen = Chosen {
        kind: "preset",
        all: species::PRESETS,
        name_of: |preset| preset.name,
        about: Preset::about,
    };
    let mut preset = None;
    let about = "A leaf whose numbers hold where nothing else is said: see `lamina grow --list`.";
    keys.optional("preset", &mut preset, chosen, about);
    let mut individual = None;
    let count = Integer::within(1, 1_000_000);
    let about = "Which leaf of the preset's plant it is: each number is another one, the same \
        wherever it is asked for. Left out, it is the preset itself.";
    keys.optional("individual", &mut individual, count, about);
    match (preset, individual) {
        (Some(preset), individual) => {
            *plan = preset.plan();
            if let Some(number) = individual {
                *plan = plan.individual(Some(preset.name), number);
            }
            keys.set_base(preset.name);
        }
        // Whatever is missing would be the preset's.
        (None, _) if keys.has_path(&["preset"]) => keys.set_unknown_base(),
        (None, Some(_)) => keys.refuse(
            &["individual"],
            "a leaf without a preset is of no plant".to_owned(),
            "write `preset` beside it, or take it out",
        ),
        (None, None) => {}
    }
}

/// The key `preset` of contents. Where it is there they are that colour's, and no other key is
/// required.
pub fn colour_preset(contents: &mut Contents, keys: &mut Keys<'_>) {
    let chosen = Chosen {
        kind: "preset",
        all: &presets::ALL,
        name_of: |preset| preset.name,
        about: |preset| preset.about,
    };
    let mut preset = None;
    let about =
        "A colour whose contents hold where nothing else is said: see `lamina optics --list`.";
    keys.optional("preset", &mut preset, chosen, about);
    if let Some(preset) = preset {
        *contents = preset.contents;
        keys.set_base(preset.name);
    } else if keys.has_path(&["preset"]) {
        keys.set_unknown_base();
    }
}
