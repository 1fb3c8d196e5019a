//! How tables are written, where that is not left to be found.

use clap::Args;
use leafmodel::document::rows::{Decimal, Form, Separator};

use crate::measured::known::{Known, WavelengthUnit};

/// The form of a table.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TableArguments {
    /// What separates the fields of tables: tab, semicolon, comma or blanks; the default is found
    /// from their first lines
    #[arg(long, value_name = "WORD", value_parser = separator)]
    pub separator: Option<Separator>,
    /// The decimal mark of tables: point or comma; by default a comma within a field is one
    #[arg(long, value_name = "WORD", value_parser = decimal)]
    pub decimal: Option<Decimal>,
}

/// The form of a table of measurements, and its units.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadingTablesArguments {
    /// The form.
    #[command(flatten)]
    pub form: TableArguments,
    /// Unit of wavelengths: nm or um; by default µm if all are below 30
    #[arg(long, value_name = "UNIT", value_parser = |text: &str| word(text, &WavelengthUnit::ALL))]
    pub wavelengths: Option<WavelengthUnit>,
}

impl TableArguments {
    /// As the reader of tables takes it.
    pub fn form(self) -> Form {
        let Self { separator, decimal } = self;
        Form { separator, decimal }
    }
}

impl ReadingTablesArguments {
    /// As the readers of measurements take it.
    pub fn known(self) -> Known {
        Known {
            form: self.form.form(),
            wavelengths: self.wavelengths,
            ..Known::default()
        }
    }
}

/// What separates fields.
pub(super) fn separator(text: &str) -> Result<Separator, String> {
    word(text, &Separator::ALL)
}

/// The decimal mark.
pub(super) fn decimal(text: &str) -> Result<Decimal, String> {
    word(text, &Decimal::ALL)
}

/// What a word stands for.
pub(super) fn word<T: Copy>(text: &str, all: &[(&'static str, T)]) -> Result<T, String> {
    let found = all.iter().find(|(known, _)| *known == text);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let known: Vec<&str> = all.iter().map(|(known, _)| *known).collect();
        format!("it must be one of {}", known.join(", "))
    })
}
