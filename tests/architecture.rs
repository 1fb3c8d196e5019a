//! What `docs/src/architecture.md` says of who may import whom.
//!
//! Imports are read from `use` lines outside of tests, in the renderer from every path in the code. Files import
//! in one direction, in `leafmodel/optics` but for a file and those in the folder of its name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A module's path from the crate's root.
type Module = Vec<String>;

/// The files of a crate but for tests, and what each imports from which of the others.
struct House {
    imports: BTreeMap<Module, BTreeSet<Module>>,
}

impl House {
    fn of(krate: &str) -> Self {
        Self::by(krate, paths)
    }

    /// A crate whose imports are the paths that are found in a file's text.
    fn by(krate: &str, paths: impl Fn(&str) -> Vec<Vec<String>>) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("..")
            .join(krate)
            .join("src");
        let mut texts = BTreeMap::new();
        read(&root, &mut Vec::new(), &mut texts);
        let modules: BTreeSet<Module> = texts.keys().cloned().collect();
        let imports = texts
            .iter()
            .map(|(module, text)| {
                let found = paths(text).into_iter();
                let found = found.filter_map(|path| resolved(module, &path, &modules));
                (
                    module.clone(),
                    found.filter(|other| other != module).collect(),
                )
            })
            .collect();
        Self { imports }
    }

    /// Modules that import each other in a loop through the one given, itself last. `in_rooms` says
    /// whether a file and those in the folder of its name may be part of it.
    fn circle(&self, start: &Module, in_rooms: bool) -> Option<Vec<String>> {
        let mut before: BTreeMap<&Module, &Module> = BTreeMap::new();
        let mut open = vec![start];
        while let Some(module) = open.pop() {
            for other in &self.imports[module] {
                let one_room = other.starts_with(module) || module.starts_with(other);
                if one_room && !in_rooms {
                    continue;
                }
                if other == start {
                    let mut names = vec![module.join("::")];
                    let mut at = module;
                    while let Some(earlier) = before.get(at) {
                        at = earlier;
                        names.push(at.join("::"));
                    }
                    return Some(names);
                }
                if !before.contains_key(other) {
                    before.insert(other, module);
                    open.push(other);
                }
            }
        }
        None
    }
}

/// Reads the files of a folder under their modules' paths.
fn read(folder: &Path, module: &mut Module, texts: &mut BTreeMap<Module, String>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("sources are part of the repository")
        .map(|entry| entry.expect("the folder is readable").path())
        .collect();
    entries.sort();
    for path in entries {
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let stem = stem.expect("names are ASCII").to_owned();
        if stem == "tests" || stem == "testing" {
            continue;
        }
        let is_root = stem == "lib" || stem == "main";
        if !is_root {
            module.push(stem);
        }
        if path.is_dir() {
            read(&path, module, texts);
        } else if path.extension().is_some_and(|ending| ending == "rs") && !is_root {
            let text = fs::read_to_string(&path).expect("sources are UTF-8");
            let starts = ["", "pub(super) "].map(|scope| {
                let tests = format!("#[cfg(test)]\n{scope}mod tests {{");
                text.find(&tests).unwrap_or(text.len())
            });
            let tests = starts[0].min(starts[1]);
            texts.insert(module.clone(), text[..tests].to_owned());
        }
        if !is_root {
            module.pop();
        }
    }
}

/// The paths that `use` lines name.
fn paths(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut is_for_tests = false;
    for piece in text.split_inclusive(';') {
        let lines = piece
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        let code: String = lines.collect::<Vec<_>>().join(" ");
        is_for_tests |= code.contains("#[cfg(test)]");
        let Some(start) = code.find("use ").filter(|start| {
            let before = code[..*start].trim_end();
            before.is_empty() || before.ends_with(['}', ']', ')']) || before.ends_with("pub")
        }) else {
            is_for_tests = false;
            continue;
        };
        let tree = code[start + 4..].trim_end_matches(';').trim();
        if !std::mem::take(&mut is_for_tests) {
            expand("", tree, &mut found);
        }
    }
    found
}

/// The paths in code, whether a `use` line names them or not; those of trees are left out.
fn qualified(text: &str) -> Vec<Vec<String>> {
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let is_between = |letter: char| !letter.is_ascii_alphanumeric() && !"_:".contains(letter);
    let words: Vec<&str> = code.split(is_between).collect();
    let pairs = words.windows(2);
    // `pub(in crate::scene)` imports nothing.
    let named = pairs.filter(|pair| pair[0] != "in" && pair[1].contains("::"));
    let parts = named.map(|pair| pair[1].split("::").map(str::to_owned).collect::<Vec<_>>());
    parts
        .filter(|path| path.iter().all(|part| !part.is_empty()))
        .collect()
}

/// The single paths of a tree `a::{b, c::d}`.
fn expand(prefix: &str, tree: &str, found: &mut Vec<Vec<String>>) {
    if let Some(brace) = tree.find('{') {
        let inner = tree[brace + 1..].trim_end().trim_end_matches('}');
        let prefix = format!("{prefix}{}", &tree[..brace]);
        let (mut depth, mut from) = (0, 0);
        for (index, letter) in inner.char_indices() {
            match letter {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&prefix, inner[from..index].trim(), found);
                    from = index + 1;
                }
                _ => {}
            }
        }
        let last = inner[from..].trim();
        if !last.is_empty() {
            expand(&prefix, last, found);
        }
        return;
    }
    let path = format!("{prefix}{tree}");
    let path = path.split(" as ").next().unwrap_or_default();
    found.push(
        path.split("::")
            .map(|part| part.trim().to_owned())
            .collect(),
    );
}

/// The module of this crate that a path leads into.
fn resolved(module: &Module, path: &[String], modules: &BTreeSet<Module>) -> Option<Module> {
    let mut rest = path;
    let mut at = match rest.first().map(String::as_str)? {
        "crate" => Module::new(),
        "self" => module.clone(),
        "super" => {
            let mut above = module.clone();
            while rest.first().is_some_and(|part| part == "super") {
                above.pop();
                rest = &rest[1..];
            }
            return deepest(above, rest, modules);
        }
        // A child of the module, or another crate.
        _ => return deepest(module.clone(), rest, modules),
    };
    rest = &rest[1..];
    at = deepest(at, rest, modules)?;
    Some(at)
}

fn deepest(mut at: Module, rest: &[String], modules: &BTreeSet<Module>) -> Option<Module> {
    for part in rest {
        at.push(part.clone());
        if !modules.contains(&at) {
            at.pop();
            break;
        }
    }
    modules.contains(&at).then_some(at)
}

/// Crates, and the least number of their files.
const CRATES: [(&str, usize); 6] = [
    ("leafmodel/document", 20),
    ("leafmodel/numerics", 20),
    ("leafmodel/optics", 30),
    ("leafmodel", 200),
    ("renderer/trace", 100),
    ("renderer", 200),
];

#[test]
fn no_files_import_each_other_in_a_circle() {
    for (krate, files) in CRATES {
        let house = House::of(krate);
        let found = house.imports.len();
        assert!(found >= files, "{krate}: {found}");
        let some = house.imports.values().map(BTreeSet::len).sum::<usize>();
        assert!(
            some > files / 2,
            "{krate} has only {some} imports: they are not read"
        );
        let circles: Vec<_> = house
            .imports
            .keys()
            .filter_map(|module| house.circle(module, false))
            .collect();
        assert!(circles.is_empty(), "{krate}: {circles:#?}");
    }
}

#[test]
fn files_import_in_one_direction() {
    for (krate, reads_paths) in [
        ("leafmodel/document", false),
        ("leafmodel/numerics", false),
        ("leafmodel", false),
        ("renderer/trace", true),
        ("renderer", true),
    ] {
        let house = House::by(krate, |text| {
            let mut found = paths(text);
            if reads_paths {
                found.extend(qualified(text));
            }
            found
        });
        let files: Vec<_> = house.imports.keys().collect();
        assert!(files.len() > 15, "{}", files.len());
        let circles = files
            .into_iter()
            .filter_map(|module| house.circle(module, true));
        let circles: Vec<Vec<String>> = circles.collect();
        assert!(circles.is_empty(), "{krate}: {circles:#?}");
    }
}

#[test]
fn leaves_are_grown_behind_one_seam() {
    const ROOMS: [&str; 11] = [
        "leaf",
        "blade",
        "venation",
        "shape",
        "compound",
        "mosaic",
        "transport",
        "species",
        "measure",
        "solid",
        "tracing",
    ];
    const SEAM: [&str; 18] = [
        "scene/plants",
        "scene/expand/boughs",
        "scene/expand/individuals",
        "scene/plant_cache",
        "scene/description",
        "cli/grow",
        "cli/measure",
        "cli/compare_networks",
        "cli/fit_veins",
        "cli/trace",
        "comparison",
        "report",
        "export/blade",
        "export/daylight",
        "export/sheet",
        "export/drawing",
        "export/veins",
        "export/overlay",
    ];
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../renderer/src");
    let mut texts = BTreeMap::new();
    read(&root, &mut Vec::new(), &mut texts);
    let mut seen = 0;
    for (module, text) in &texts {
        let path = module.join("/");
        for room in ROOMS {
            let code = text
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"));
            let names = code.filter(|line| line.contains(&format!("leafmodel::{room}::")));
            let count = names.count();
            seen += count;
            let is_there = SEAM.iter().any(|part| path.starts_with(part));
            assert!(count == 0 || is_there, "{path} names leafmodel::{room}");
        }
    }
    assert!(seen > 20, "only {seen} names were found");
}
