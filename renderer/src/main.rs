//! The `lamina` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    renderer::cli::run(std::env::args_os())
}
