//! What is known of a preset's species: ranges of sizes and contents, each with its source.
//!
//! - **In**: a preset's file.
//! - **Out**: its [`Traits`]. Their values are those of the block `leaf`, so that documented and grown
//!   numbers agree.
//! - **Always true**: every value lies within its range.
//! - **Left out**: the form of the blade (fold, curl, ruffle, relief), which is all by eye.

use super::file::{self, BLOCKS};
use crate::document::{
    Keys, Limits, MapOf, NamedList, Number, Numbers, Opened, Table, Text, Value,
};
use crate::optics::Constituent;

/// Where a number comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// What kind of source it is: one of [`Provenance::KINDS`].
    kind: usize,
    /// Key of the publication in `docs/references.bib`, unless it is by eye.
    pub key: Option<String>,
    /// What the source says, and for which leaves; by eye, the reason.
    pub says: String,
}

impl Provenance {
    /// The kinds of sources, as files name them: the range was measured on leaves of the species, or a
    /// flora of the species gives it; the value was computed by a relation that was fitted to leaves of
    /// other species; the range is close to what was measured on a related species; the value was
    /// chosen by eye in the range of a collection of other leaves; it was chosen by eye without a
    /// publication.
    pub const KINDS: [&'static str; 6] = [
        "measured", "flora", "fitted", "relative", "estimate", BY_EYE,
    ];

    /// One or two words for tables, such as `measured`.
    pub fn word(&self) -> String {
        Self::KINDS[self.kind].replace('_', " ")
    }

    /// The reason or source in words, with the bibliography key if it is published.
    pub fn words(&self) -> String {
        match &self.key {
            Some(key) => format!("{} [{key}]", self.says),
            None => self.says.clone(),
        }
    }
}

const BY_EYE: &str = "by_eye";

/// A number, the range that its provenance allows, and that provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// What it is.
    pub name: String,
    /// Its unit, empty for counts and ratios.
    pub unit: &'static str,
    /// The preset's value; none for what is measured on the grown leaf.
    pub value: Option<f64>,
    /// From least to greatest.
    pub range: [f64; 2],
    /// Provenance of the range.
    pub from: Provenance,
}

/// What is known of the species of a preset.
#[derive(Clone, Debug, PartialEq)]
pub struct Traits {
    /// The species, in Latin, and which leaf or part of it.
    pub species: String,
    /// Sizes and contents of the mature leaf in summer.
    pub summer: Vec<Quantity>,
    /// What differs in a leaf of another colour: contents of its tissues, and the days of its ageing.
    pub differs: Vec<Quantity>,
}

impl Traits {
    /// A trait of the mature leaf in summer.
    pub fn summer(&self, name: &str) -> Option<&Quantity> {
        self.summer.iter().find(|quantity| quantity.name == name)
    }

    /// Whether the leaf has another colour than summer's green.
    pub(crate) fn is_coloured(&self) -> bool {
        !self.differs.is_empty()
    }
}

/// What floras count and measure on leaves of a species, by the names of [`COUNTS`].
pub(crate) type Counts = Vec<Quantity>;

/// The names of what is counted, with their units.
pub(super) const COUNTS: [(&str, &str); 8] = [
    ("width_over_length", ""),
    ("lobes", ""),
    ("primaries", ""),
    ("pairs", ""),
    ("teeth_per_side", ""),
    ("teeth_per_cm", ""),
    ("petiole_mm", "mm"),
    ("petiole_over_length", ""),
];

/// Traits in the order of tables: name, unit, and where in `leaf` the value is.
const SUMMER: [(&str, &str, &str); 10] = [
    ("length", "mm", "length_mm"),
    ("thickness", "mm", "blade.thickness_mm"),
    ("structure", "", "contents.structure"),
    ("chlorophyll", "µg/cm²", "contents.chlorophyll_ug_per_cm2"),
    ("carotenoids", "µg/cm²", "contents.carotenoids_ug_per_cm2"),
    ("anthocyanins", "µg/cm²", "contents.anthocyanins_ug_per_cm2"),
    ("water", "cm", "contents.water_cm"),
    ("dry_matter", "g/cm²", "contents.dry_matter_g_per_cm2"),
    ("width", "mm", ""),
    ("widest_at", "", ""),
];

/// The days of ageing: name, and where in `leaf` the value is.
const AGE: [(&str, &str); 3] = [
    ("day", "senescence.day"),
    ("half_of_chlorophyll_gone", "senescence.half_days"),
    ("first_tissue_dies", "senescence.death_day"),
];

/// A quantity as its file has it.
#[derive(Clone, Default)]
struct Entry {
    value: Option<f64>,
    range: Option<[f64; 2]>,
    range_over_value: Option<[f64; 2]>,
    from: Provenance,
}

/// A tissue as its file has it.
struct Tissue {
    name: String,
    contents: Vec<Quantity>,
}

/// What the file of a preset knows of its species.
pub(super) fn read(opened: Opened) -> (Option<Traits>, Counts) {
    let leaf = table(&opened.tree, "leaf").cloned().unwrap_or_default();
    let value = |path: &str| value_at(&leaf, path);
    let has_traits = opened.tree.get("traits").is_some();
    let mut traits = Traits {
        species: String::new(),
        summer: Vec::new(),
        differs: Vec::new(),
    };
    let mut counts = Vec::new();
    let mut sources = Vec::new();
    let mut tissues = Vec::new();
    file::read(opened, |keys| {
        let says = MapOf(Text("a text"));
        let about = "What publications say that several numbers refer to.";
        keys.key("sources", &mut sources, says, about);
        let about = "What is known of the species.";
        keys.block("traits", about, |keys| {
            let species = &mut traits.species;
            keys.key("species", species, Text("a text"), "Its name in Latin.");
            for (name, unit, path) in SUMMER {
                traits
                    .summer
                    .extend(quantity(keys, name, unit, value(path), &sources));
            }
        });
        let list = NamedList {
            required: false,
            new: &|name: &str| Tissue {
                name: name.replace('_', " "),
                contents: Vec::new(),
            },
            name_of: |tissue: &Tissue| &tissue.name,
        };
        let about = "Tissues whose contents differ from the green leaf's.";
        keys.named("tissues", &mut tissues, &list, about, |tissue, keys| {
            for constituent in Constituent::ALL {
                let [name, unit] = [constituent.name(), constituent.unit()];
                let content = quantity(keys, name, unit, None, &sources);
                tissue.contents.extend(content);
            }
        });
        for Tissue { name, contents } in tissues {
            traits
                .differs
                .extend(contents.into_iter().map(|content| Quantity {
                    name: format!("{name}: {}", content.name),
                    ..content
                }));
        }
        keys.block("age", "The days of its ageing.", |keys| {
            for (name, path) in AGE {
                let days = quantity(keys, name, "days", value(path), &sources);
                traits.differs.extend(days);
            }
        });
        keys.block("counts", "What floras count.", |keys| {
            for (name, unit) in COUNTS {
                counts.extend(quantity(keys, name, unit, None, &sources));
            }
        });
        keys.leave(&BLOCKS);
    });
    (has_traits.then_some(traits), counts)
}

/// Reads a quantity, whose value is `of_leaf` unless its file says another.
fn quantity(
    keys: &mut Keys<'_>,
    name: &'static str,
    unit: &'static str,
    of_leaf: Option<f64>,
    sources: &[(String, String)],
) -> Option<Quantity> {
    let mut read = None;
    keys.optional_block(
        name,
        &mut read,
        Entry::default,
        "A number.",
        |entry, keys| {
            let any = Limits::closed(-1e6, 1e6);
            let about = "Its value, if no key of the leaf has it.";
            keys.optional("value", &mut entry.value, Number(any), about);
            let about = "From least to greatest.";
            keys.optional("range", &mut entry.range, Numbers(any), about);
            let about = "Instead: from least to greatest, over the value.";
            let relative = &mut entry.range_over_value;
            keys.optional("range_over_value", relative, Numbers(any), about);
            provenance(&mut entry.from, keys, sources);
        },
    );
    let entry = read?;
    let value = entry.value.or(of_leaf);
    let scaled = |range: [f64; 2]| value.map(|value| range.map(|over| over * value));
    let relative = entry.range_over_value.and_then(scaled);
    Some(Quantity {
        name: name.replace('_', " "),
        unit,
        value,
        range: entry.range.or(relative).unwrap_or([f64::NAN; 2]),
        from: entry.from,
    })
}

/// Reads where a number comes from.
fn provenance(from: &mut Provenance, keys: &mut Keys<'_>, sources: &[(String, String)]) {
    let about = "Where the number comes from.";
    for name in keys.one_of(&Provenance::KINDS, None) {
        from.kind = Provenance::KINDS
            .iter()
            .position(|kind| *kind == name)
            .unwrap_or_default();
        let mut text = String::new();
        keys.required(name, &mut text, Text("a text"), about);
        if name == BY_EYE {
            from.says = text;
        } else {
            let known = sources.iter().find(|(key, _)| *key == text);
            from.says = known.map_or_else(String::new, |(_, says)| says.clone());
            from.key = Some(text);
        }
    }
    let about = "What the source says, if the block `sources` says something else.";
    keys.key("says", &mut from.says, Text("a text"), about);
}

fn table<'t>(tree: &'t Table, key: &str) -> Option<&'t Table> {
    tree.get(key)?.node.table()
}

/// The number at a path of keys.
fn value_at(tree: &Table, path: &str) -> Option<f64> {
    if let Some((block, rest)) = path.split_once('.') {
        return value_at(table(tree, block)?, rest);
    }
    let value = &tree.get(path)?.node.value;
    if let Value::Integer(whole) = value {
        return Some(*whole as f64);
    }
    if let Value::Number(number) = value {
        Some(*number)
    } else {
        None
    }
}
