//! The version of PROSPECT that a command uses, with a constituent of the user's own.

use leafmodel::optics::extra::ExtraTable;
use leafmodel::optics::{Contents, Model, Pigments};

use super::arguments::ModelArguments;
use super::terminal::Failure;
use super::texts::text_of;
use crate::measured::{Fault, What};

/// What each constituent absorbs.
pub(super) fn pigments(arguments: &ModelArguments) -> Result<Pigments, Failure> {
    let extra = arguments.extra_absorption.as_ref().map(|file| {
        let text = text_of(file)?;
        ExtraTable::parse(&text).map_err(|bad| {
            let (problem, help) = (bad.problem, bad.help);
            let what = What::Words { problem, help };
            let span = bad.span;
            Failure::bad(Fault { span, what }.shown(file, &text))
        })
    });
    Ok(Pigments {
        model: arguments.model.unwrap_or_default(),
        extra: extra.transpose()?,
        ..Pigments::default()
    })
}

/// What is wrong with contents in this model.
pub(super) fn refusal(pigments: &Pigments, contents: &Contents) -> Option<String> {
    let refused = pigments.model.refusal(contents);
    let refused = refused.map(|(_, problem, help)| format!("{problem}: {help}"));
    refused.or_else(|| pigments.lacks_extra(contents).map(str::to_owned))
}

/// The model and the source of its numbers, for the line that a command ends with.
pub(super) fn source(model: Model) -> String {
    format!("{}, table of {}", model.title(), model.source())
}
