//! `lamina completions` and `lamina man` as written.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

/// `lamina completions`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CompletionsArguments {
    /// The shell
    pub shell: Shell,
}

/// `lamina man`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct ManArguments {
    /// Folder for a page of each command; without it the page of `lamina` itself goes to stdout
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
