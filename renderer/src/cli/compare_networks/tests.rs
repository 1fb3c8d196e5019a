use clap::Parser as _;

use super::sources::Sources;
use crate::cli::arguments::{Arguments, Command, CompareNetworksArguments};
use crate::cli::terminal::Failure;

fn arguments() -> CompareNetworksArguments {
    let line = ["lamina", "compare-networks", "a", "b"];
    match Arguments::try_parse_from(line).map(|parsed| parsed.command) {
        Ok(Some(Command::CompareNetworks(compare))) => compare,
        other => panic!("{other:?}"),
    }
}

#[test]
fn cells_of_a_table_are_escaped_and_cut_in_messages_and_its_rows_may_have_semicolons() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("leaves.csv");
    let refused = |text: &str| {
        std::fs::write(&path, text).expect("the folder was just made");
        let mut arguments = arguments();
        arguments.table = Some(path.clone());
        match Sources::new(&arguments) {
            Err(Failure::BadInput(message)) => message.trim_end().to_owned(),
            other => panic!("{other:?}"),
        }
    };
    let long = "9".repeat(100_000);
    for (text, part) in [
        (
            format!("file,mm_per_unit\na.json,1\nb.json,{long}\n"),
            "leaves.csv:3: `mm_per_unit` is",
        ),
        (
            format!("file;mm_per_unit\na.json;1\nb.json;{long}\n"),
            "leaves.csv:3: `mm_per_unit` is",
        ),
        (
            format!("file,{long}\na.json,1\n"),
            "leaves.csv:1: there is no column",
        ),
        (
            "file,\u{1b}[31m\u{7}\na.json,1\n".to_owned(),
            "no column `\\u{1b}[31m\\u{7}`",
        ),
        (
            "file,y_down\na.json,\u{1b}[2J\n".to_owned(),
            "`y_down` is `\\u{1b}[2J`",
        ),
        (
            "file,group\n\u{1b}[2J,\n".to_owned(),
            "`group` of \\u{1b}[2J is empty",
        ),
        (
            "file,group\na.json\n".to_owned(),
            "leaves.csv:2: the line has 1 values",
        ),
    ] {
        let message = refused(&text);
        assert!(message.contains(part), "{message}");
        assert!(message.chars().count() < 400, "{message}");
        assert!(!message.contains(|c: char| c.is_control()), "{message:?}");
    }
}
