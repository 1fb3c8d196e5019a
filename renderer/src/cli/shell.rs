//! `lamina completions`, `lamina man` and `lamina licenses`: what shells, `man` and lawyers want to know.

use std::fs;

use clap::CommandFactory;
use clap_mangen::Man;

use crate::cli::arguments::{Arguments, CompletionsArguments, ManArguments};
use crate::cli::places::write_and_say;
use crate::cli::terminal::{Failure, say};

/// Lamina's own licences, the notices of its data, and those of the crates that it is built from:
/// written by `renderer/program/packaging/licenses`.
const LICENSES: &str = include_str!("licenses.txt");

pub(super) fn licenses() {
    say(LICENSES.trim_end());
}

pub(super) fn completions(arguments: &CompletionsArguments) {
    let mut script = Vec::new();
    let mut command = Arguments::command();
    clap_complete::generate(arguments.shell, &mut command, "lamina", &mut script);
    say(String::from_utf8_lossy(&script).trim_end());
}

pub(super) fn man(arguments: &ManArguments) -> Result<(), Failure> {
    let mut command = Arguments::command().disable_help_subcommand(true);
    command.build();
    let Some(folder) = &arguments.out else {
        say(page(command)?.trim_end());
        return Ok(());
    };
    let refused = Failure::system_at(folder);
    fs::create_dir_all(folder).map_err(refused)?;
    let mut open = vec![(String::from("lamina"), command)];
    while let Some((name, command)) = open.pop() {
        for inner in command.get_subcommands() {
            let name = format!("{name}-{}", inner.get_name());
            open.push((name, inner.clone()));
        }
        let path = folder.join(format!("{name}.1"));
        write_and_say(&path, page(command.display_name(name))?)?;
    }
    Ok(())
}

fn page(command: clap::Command) -> Result<String, Failure> {
    let mut page = Vec::new();
    Man::new(command)
        .render(&mut page)
        .map_err(Failure::system)?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}
