//! Random text of a block, by the schema from which files are read and the book's tables are made.

use std::fmt::Write as _;

use leafmodel::document::limits::Limits;
use leafmodel::document::schema::{BlockSchema, EntrySchema, Is, Type};

use super::chance::Chance;

/// Names that a user would choose: of layers, of a mosaic's types.
pub(super) const NAMES: [&str; 2] = ["a", "b"];

/// Greatest values of what costs time and nothing else: leaves are small and their veins coarse, so
/// that thousands take minutes. Every other key has its whole documented range.
const MOST: [(&str, f64); 47] = [
    ("abaxial_per_mm2", 20.0),
    ("adaxial_per_mm2", 20.0),
    ("arches", 3.0),
    ("around", 50.0),
    ("bites", 12.0),
    ("cells", 400.0),
    ("cells_along", 30.0),
    ("darts_per_segment2", 0.5),
    ("days", 20.0),
    ("final_length_segments", 80.0),
    ("fringe_per_mm", 10.0),
    ("growth", 50.0),
    ("holes", 12.0),
    ("individuals", 2.0),
    ("initial_length_segments", 80.0),
    ("initial_relaxations", 30.0),
    ("laterals", 20.0),
    ("leaflets", 9.0),
    ("length_mm", 300.0),
    ("map_size", 48.0),
    ("most_cells", 3000.0),
    ("nodes", 25.0),
    ("pairs", 6.0),
    ("per_mm2", 20.0),
    ("ratio_steps", 50.0),
    ("relaxations_per_day", 4.0),
    ("repeat_cells", 64.0),
    ("resolution", 60.0),
    ("rows", 300.0),
    ("spots_per_cm2", 30.0),
    ("steps", 60.0),
    ("tears", 12.0),
    ("tension_rounds", 20.0),
    ("unseen_veinlets", 100.0),
    ("variants", 2.0),
    ("vein_count", 20.0),
    ("birth_distance_segments", 40.0),
    ("kill_distance_segments", 40.0),
    ("source_birth_distance_segments", 40.0),
    ("vein_birth_distance_segments", 40.0),
    ("count", 40.0),
    ("lai", 3.0),
    ("light_samples", 4.0),
    ("per_m2", 1000.0),
    ("segments", 40.0),
    ("slices", 8.0),
    ("seed", 1e9),
];

/// Least values of the same kind.
const LEAST: [(&str, f64); 5] = [
    ("birth_distance_segments", 0.2),
    ("division_days", 2.0),
    ("length_step_segments", 0.5),
    ("source_birth_distance_segments", 0.2),
    ("kill_distance_segments", 0.2),
];

/// Keys that are not drawn: the plan as a whole has the first, and no folder has maps of contents.
const ELSEWHERE: [&str; 2] = ["max_edge_mm", "map"];

/// Writes random blocks.
pub(super) struct Writer<'a> {
    pub(super) chance: &'a mut Chance,
    /// Share of the optional keys that are written.
    pub(super) share: f64,
    /// Share of the numbers that stay near their defaults.
    pub(super) tame: f64,
    pub(super) text: String,
}

impl Writer<'_> {
    /// Writes a block under its header. With `is_whole` false what is required is no more likely
    /// than the rest, since a preset has it.
    pub(super) fn block(
        &mut self,
        path: &str,
        schema: &BlockSchema,
        is_whole: bool,
        skip: &[&str],
    ) {
        let _ = writeln!(self.text, "[{path}]");
        let chosen = self.chosen(schema, is_whole, skip);
        let (values, blocks): (Vec<_>, Vec<_>) = chosen
            .into_iter()
            .partition(|entry| matches!(entry.is, Is::Value { .. }));
        for entry in values {
            if let Is::Value { of, default } = &entry.is {
                let default = default
                    .as_ref()
                    .map(leafmodel::document::schema::default_in_words);
                let default = default.and_then(|text| text.parse().ok());
                let value = self.value(&entry.key, of, default);
                let _ = writeln!(self.text, "{} = {value}", entry.key);
            }
        }
        for entry in blocks {
            let path = format!("{path}.{}", entry.key);
            match &entry.is {
                // What stands in a preset's place is whole: another kind of veins.
                Is::Block(inner) => {
                    let is_whole = is_whole || !schema.groups.is_empty() || self.chance.is(0.5);
                    self.block(&path, inner, is_whole, &[]);
                }
                Is::Named(inner) => {
                    for name in NAMES {
                        if name == NAMES[0] || self.chance.is(0.5) {
                            self.block(&format!("{path}.{name}"), inner, true, &[]);
                        }
                    }
                }
                Is::List {
                    of,
                    most,
                    again: false,
                } => {
                    for _ in 0..=self.chance.below(3.min(*most)) {
                        let header = self.text.len();
                        self.block(&path, of, true, &[]);
                        // The header of one of a list has two brackets.
                        let own = format!("[{path}]");
                        self.text
                            .replace_range(header..header + own.len(), &format!("[[{path}]]"));
                    }
                }
                Is::List { again: true, .. } | Is::Value { .. } => {}
            }
        }
    }

    /// The keys that are written: of those that shut each other out at most one.
    fn chosen<'s>(
        &mut self,
        schema: &'s BlockSchema,
        is_whole: bool,
        skip: &[&str],
    ) -> Vec<&'s EntrySchema> {
        let mut out: Vec<&str> = skip.to_vec();
        out.extend(ELSEWHERE);
        let mut must: Vec<&str> = Vec::new();
        for group in &schema.groups {
            let free: Vec<&str> = group
                .keys
                .iter()
                .copied()
                .filter(|key| !out.contains(key))
                .collect();
            let is_there = (group.required && is_whole) || self.chance.is(self.share);
            let one = (is_there && !free.is_empty()).then(|| free[self.chance.below(free.len())]);
            out.extend(free.iter().copied().filter(|key| Some(*key) != one));
            must.extend(one);
        }
        let entries = schema
            .entries
            .iter()
            .filter(|entry| !out.contains(&entry.key.as_str()));
        entries
            .filter(|entry| {
                let is_needed = (entry.required && is_whole) || must.contains(&entry.key.as_str());
                is_needed || self.chance.is(self.share)
            })
            .collect()
    }

    /// A value of a type as it stands in a file.
    fn value(&mut self, key: &str, of: &Type, default: Option<f64>) -> String {
        match of {
            Type::Number(limits) => format!("{:?}", self.number(key, *limits, default)),
            Type::Integer { least, most } => {
                let limits = Limits::closed(*least as f64, *most as f64);
                (self.number(key, limits, default).round() as u64)
                    .clamp(*least, *most)
                    .to_string()
            }
            Type::Flag => self.chance.is(0.5).to_string(),
            Type::Text(what) => format!("{:?}", self.file(what)),
            Type::Word(words) | Type::Name(words, _) => {
                format!("{:?}", words[self.chance.below(words.len())])
            }
            Type::Tuple(types) => {
                let values: Vec<String> =
                    types.iter().map(|one| self.value(key, one, None)).collect();
                format!("[{}]", values.join(", "))
            }
            Type::List {
                of, least, most, ..
            } => {
                let count = (*least + self.chance.below(4)).min(*most);
                let mut values: Vec<String> =
                    (0..count).map(|_| self.value(key, of, None)).collect();
                // Most lists of numbers have to rise.
                let number = |text: &String| text.parse::<f64>().unwrap_or(0.0);
                values.sort_by(|a, b| number(a).total_cmp(&number(b)));
                format!("[{}]", values.join(", "))
            }
            Type::Map(of) => format!("{{ a = {} }}", self.value(key, of, None)),
            Type::Table(schema) => {
                let entries = self.chosen(schema, true, &[]);
                let mut values = Vec::new();
                for entry in entries {
                    if let Is::Value { of, .. } = &entry.is {
                        values.push(format!(
                            "{} = {}",
                            entry.key,
                            self.value(&entry.key, of, None)
                        ));
                    }
                }
                format!("{{ {} }}", values.join(", "))
            }
            Type::AnyOf(types, _) => {
                let one = &types[self.chance.below(types.len())];
                self.value(key, one, default)
            }
        }
    }

    /// A number: mostly near its default, else anywhere, even or by magnitude, or one of the ends.
    fn number(&mut self, key: &str, limits: Limits, default: Option<f64>) -> f64 {
        let [(low, low_included), (high, high_included)] = limits.ends();
        let bound = |table: &[(&str, f64)]| {
            let found = table.iter().find(|(name, _)| *name == key);
            found.map(|(_, value)| *value)
        };
        let low = bound(&LEAST).map_or(low, |least| low.max(least));
        let high = bound(&MOST).map_or(high, |most| high.min(most)).max(low);
        let (low, high) = (low.max(-1e9), high.min(1e9));
        let value = match default {
            Some(default) if self.chance.is(self.tame) => {
                let scale = if default == 0.0 {
                    0.1 * high.min(1.0)
                } else {
                    default.abs()
                };
                default + scale * (self.chance.uniform() - 0.3)
            }
            _ if self.chance.is(0.1) && low_included => low,
            _ if self.chance.is(0.1) && high_included => high,
            _ if self.chance.is(0.5) => low + (high - low) * self.chance.uniform(),
            _ => {
                let least = low.abs().max(1e-6 * high.abs()).max(1e-12);
                least * (high.abs().max(least) / least).powf(self.chance.uniform())
            }
        };
        let value = value.clamp(low, high);
        if limits.contain(value) {
            value
        } else {
            0.5 * (low + high)
        }
    }

    /// What a text is: one of the folder's files, or a name.
    fn file(&mut self, what: &str) -> &'static str {
        match what {
            "the path of an SVG file" => "leaf.svg",
            "the path of a PNG file"
            | "the path of a PNG or EXR"
            | "the path of a PNG, JPEG or EXR picture"
            | "the path of an EXR, HDR, PNG or JPEG picture" => "grey.png",
            "the path of a PLY or OBJ file" => "cube.obj",
            "the path of an EXR with contents" => "contents.exr",
            "the path of a glTF file" => "model.glb",
            "the `id` of a path" => "margin",
            "the name of a channel" => "R",
            // There is always a first one.
            what if what.starts_with("the name of a medium") || what.contains("object") => NAMES[0],
            what if what.contains("path") || what.contains("file") => "ratio.csv",
            _ => NAMES[self.chance.below(NAMES.len())],
        }
    }
}
