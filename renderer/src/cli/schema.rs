//! `lamina schema`: the schema of scene files, for editors and for the book.

use std::fs;

use leafmodel::document::schema::tables::filled;

use crate::cli::arguments::SchemaArguments;
use crate::cli::places::{check_writable, write_and_say};
use crate::cli::terminal::{Failure, say};
use crate::scene::load;

pub(super) fn run(arguments: &SchemaArguments) -> Result<(), Failure> {
    let schema = load::schema();
    for page in &arguments.pages {
        let unreadable = Failure::at(page);
        let text = fs::read_to_string(page).map_err(unreadable)?;
        let filled = filled(&text, &schema).map_err(|problem| bad_at!(page, "{problem}"))?;
        if filled != text {
            write_and_say(page, filled)?;
        }
    }
    if !arguments.pages.is_empty() {
        return Ok(());
    }
    let json = load::json_schema();
    let text = format!("{json:#}\n");
    match &arguments.out {
        None => say(text.trim_end()),
        Some(path) => {
            check_writable(path)?;
            write_and_say(path, text)?;
        }
    }
    Ok(())
}
