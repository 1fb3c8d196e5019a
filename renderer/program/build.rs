//! Finds the commit that a build from a checkout is made of.
//!
//! Only this crate reads it, so that a commit rebuilds no library.

use std::path::Path;
use std::process::Command;

/// What the program is made of, seen from this crate's folder.
const SOURCES: [&str; 5] = [
    "../../Cargo.lock",
    "../../Cargo.toml",
    "../../leafmodel",
    "../../scenes",
    "..",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // A package has no repository of its own; one that it was unpacked into says nothing about it.
    let in_checkout = Path::new("../../Cargo.lock").exists() && Path::new("../src/cli.rs").exists();
    let commit = if in_checkout { commit() } else { None };
    println!(
        "cargo::rustc-env=LAMINA_COMMIT={}",
        commit.unwrap_or_default()
    );
}

/// ` (0123456789ab)`, with `-dirty` if a source differs from that commit; `None` without git or a repository.
fn commit() -> Option<String> {
    let head = git(&["rev-parse", "--short=12", "HEAD"])?;
    for name in ["HEAD", "index", "logs/HEAD"] {
        let path = git(&["rev-parse", "--git-path", name])?;
        // A file that is not there would run this script at each build.
        if Path::new(&path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
    }
    // A file that git does not know is part of nothing that is built; a scene of the user's may lie there.
    let status = ["status", "--porcelain", "--untracked-files=no", "--"];
    let status = [&status[..], &SOURCES].concat();
    let dirty = if git(&status)?.is_empty() {
        ""
    } else {
        "-dirty"
    };
    Some(format!(" ({head}{dirty})"))
}

/// What git prints, without the end of the line.
fn git(arguments: &[&str]) -> Option<String> {
    // `status` would write the index, a build must not; nor wait for another git that does.
    let output = Command::new("git")
        .arg("--no-optional-locks")
        .args(arguments)
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim_end().to_owned())
}
