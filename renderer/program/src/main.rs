//! The `lamina` command.

use std::process::ExitCode;

/// The version, and the commit of a build from a checkout: `0.1.0 (0123456789ab-dirty)`.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("LAMINA_COMMIT"));

fn main() -> ExitCode {
    renderer::cli::run(std::env::args_os(), VERSION)
}
