//! `lamina schema`: the schema of scene files, for editors and for the book.

use std::fs;
use std::io::Write as _;

use leafmodel::document::schema::filled;

use crate::cli::arguments::SchemaArguments;
use crate::cli::{Failure, check_writable, say};
use crate::image::atomic;
use crate::scene::load;

pub(super) fn run(arguments: &SchemaArguments) -> Result<(), Failure> {
    let schema = load::schema();
    for page in &arguments.pages {
        let unreadable = |error| Failure::bad(format!("{}: {error}", page.display()));
        let text = fs::read_to_string(page).map_err(unreadable)?;
        let filled = filled(&text, &schema)
            .map_err(|problem| Failure::bad(format!("{}: {problem}", page.display())))?;
        if filled != text {
            atomic::replace(page, |file| file.write_all(filled.as_bytes()))
                .map_err(Failure::system)?;
            say(page.display());
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
            atomic::replace(path, |file| file.write_all(text.as_bytes()))
                .map_err(Failure::system)?;
            say(path.display());
        }
    }
    Ok(())
}
