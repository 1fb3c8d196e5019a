//! The examples of the book load.

use std::fs;
use std::path::{Path, PathBuf};

use super::{accept, text_of};

/// Every page of the book.
pub(super) fn pages() -> Vec<(PathBuf, String)> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src")];
    let mut pages = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("the book is part of the repository") {
            let path = entry.expect("the folder is readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                let text = fs::read_to_string(&path).expect("pages are UTF-8");
                pages.push((path, text));
            }
        }
    }
    pages.sort();
    pages
}

/// The blocks of a page that start with ` ```toml`, each with what follows that word.
fn examples(page: &str) -> Vec<(String, String)> {
    let mut examples = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(kind) = line.strip_prefix("```toml") {
            let block = lines.by_ref().take_while(|line| *line != "```");
            let block: Vec<&str> = block.collect();
            examples.push((kind.to_owned(), block.join("\n") + "\n"));
        }
    }
    examples
}

/// A fragment with what a scene needs besides; what it brings itself is left out.
fn wrapped(fragment: &str) -> String {
    let mut scene = format!("format = 1\n{fragment}\n");
    for section in text_of("minimal.toml").split("\n\n").skip(1) {
        let name = section.split(['[', '.', ']']).nth(1).unwrap_or_default();
        let alone = matches!(name, "film" | "camera" | "lights");
        if !(alone && fragment.contains(&format!("[{name}."))) {
            scene.push_str(section);
            scene.push_str("\n\n");
        }
    }
    scene
}

#[test]
fn every_example_of_the_book_is_a_scene() {
    let mut count = 0;
    for (path, page) in pages() {
        for (kind, example) in examples(&page) {
            let shown = path
                .file_name()
                .and_then(|name| name.to_str())
                .unwrap_or("page.md");
            match kind.as_str() {
                "" => accept(&example, shown, &[]),
                ",fragment" => accept(&wrapped(&example), shown, &[]),
                other => panic!("{shown} has an example of the unknown kind `{other}`"),
            };
            count += 1;
        }
    }
    assert!(count >= 10, "only {count} examples were found");
}
