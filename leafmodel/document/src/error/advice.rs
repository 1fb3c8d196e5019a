//! What reports say of an error beside its message: code, label, and what to write instead.

use super::{DocumentError, NONE};
use crate::names::LONGEST;

impl DocumentError {
    /// The stable name of the kind of error, shown in brackets.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Syntax { .. } => "scene::syntax",
            Self::NotAnOverride { .. } => "scene::override",
            Self::Duplicate { .. } => "scene::duplicate",
            Self::UnknownKey { .. } => "scene::unknown_key",
            Self::UnknownVariant { .. } => "scene::unknown_variant",
            Self::MissingKey { .. } => "scene::missing_key",
            Self::NotOne { .. } => "scene::not_one",
            Self::Conflict { .. } => "scene::conflict",
            Self::WrongType { .. } => "scene::wrong_type",
            Self::OutOfRange { .. } => "scene::out_of_range",
            Self::NotFinite { .. } => "scene::not_finite",
            Self::Impossible { .. } => "scene::impossible",
            Self::NotRising { .. } => "scene::not_rising",
            Self::UnknownName { .. } => "scene::unknown_name",
            Self::BadName { .. } => "scene::bad_name",
            Self::UnknownWord { .. } => "scene::unknown_word",
            Self::PathOutside { .. } => "scene::path_outside",
            Self::FileMissing { .. } => "scene::file_missing",
            Self::NotARegularFile { .. } => "scene::not_a_regular_file",
            Self::BadFile { .. } => "scene::bad_file",
            Self::Header { .. } => "scene::header",
            Self::NotUtf8 { .. } => "scene::not_utf8",
            Self::UnsupportedFormat { .. } => "scene::unsupported_format",
            Self::Coverage { .. } => "scene::coverage",
            Self::EnergyNotConserved { .. } => "scene::energy_not_conserved",
            Self::NoLight => "scene::no_light",
            Self::DarkLight { .. } => "scene::dark_light",
            Self::NoObject => "scene::no_object",
            Self::CannotShine { .. } => "scene::cannot_shine",
            Self::BadView { .. } => "scene::bad_view",
            Self::BadMatrix { .. } => "scene::bad_matrix",
        }
    }

    /// What to write instead, if that can be said.
    pub fn help(&self) -> Option<String> {
        let meant = |nearest: &Option<String>, known: &String, what: &str| match nearest {
            Some(nearest) => format!("did you mean `{nearest}`?"),
            None if known.is_empty() => format!("there are no {what} in the file"),
            None => format!("{what}: {known}"),
        };
        Some(match self {
            Self::Syntax { help, .. } => return help.clone(),
            Self::Duplicate { .. } | Self::Conflict { .. } => "keep one of the two".to_owned(),
            Self::NotAnOverride { .. } => {
                "write it as in the file, text in quotes: `-D film.rgb.spp=16`, \
                 `-D 'picture.tone=\"filmic\"'`"
                    .to_owned()
            }
            Self::UnknownKey {
                nearest,
                unit,
                known,
                ..
            } => {
                let help = meant(nearest, known, "keys here");
                unit.iter().fold(help, |help, unit| format!("{help} {unit}"))
            }
            Self::UnknownVariant { nearest, known, .. } => meant(nearest, known, "kinds"),
            Self::MissingKey { wanted, .. } => format!("add {wanted}"),
            Self::NotOne { found, .. } if found == NONE => "add one of them".to_owned(),
            Self::NotOne { .. } => "keep one of them".to_owned(),
            Self::WrongType { help, .. }
            | Self::OutOfRange { help, .. }
            | Self::Impossible { help, .. }
            | Self::Header { help, .. }
            | Self::BadFile { help, .. } => help.clone(),
            Self::NotFinite { .. } => "write a finite number".to_owned(),
            Self::NotRising { .. } => {
                "sort the entries, and keep one of those that are equal".to_owned()
            }
            Self::UnknownName {
                nearest,
                known,
                kind,
                ..
            } => meant(nearest, known, &plural(kind)),
            Self::BadName { allowed, .. } => format!("use {allowed}, at most {LONGEST} of them"),
            Self::UnknownWord { nearest, known, .. } => meant(nearest, known, "choices"),
            Self::PathOutside { .. } => {
                "copy the file into the scene's folder and name it by its path from there, or allow \
                 its folder with `--allow DIR`"
                    .to_owned()
            }
            Self::FileMissing {
                nearest: Some(nearest),
                ..
            } => format!("did you mean \"{nearest}\"?"),
            Self::FileMissing { nearest: None, .. } => {
                "check the path; those in a scene start at its folder".to_owned()
            }
            Self::NotARegularFile { .. } => "name a file".to_owned(),
            Self::NotUtf8 { .. } => "save the file with the encoding UTF-8".to_owned(),
            Self::UnsupportedFormat { .. } => {
                "write `format = 1`, or use a newer version of the program".to_owned()
            }
            Self::Coverage { by, .. } => format!(
                "narrow {by}'s range, bring data that reach further, or write \
                 `extrapolate = true` at the top of the file to go on with the end values"
            ),
            Self::EnergyNotConserved { sum, .. } => {
                let most = (1e4 / sum).floor() / 1e4;
                format!("scale both spectra by {most:.4} or less, or mend the data")
            }
            Self::NoLight => "add a light, for example `[lights.sky.constant]` with \
                 `radiance_w_m2_sr_nm = 1`"
                .to_owned(),
            Self::DarkLight { .. } => "give it a spectrum above 0, or take it out".to_owned(),
            Self::NoObject => {
                "add an object, for example `[objects.leaf]` with a `mesh` and a `material`"
                    .to_owned()
            }
            Self::CannotShine { .. } => "give each area light a mesh object of its own".to_owned(),
            Self::BadView { help, .. } | Self::BadMatrix { help, .. } => (*help).to_owned(),
        })
    }

    /// What stands beside the underlined piece of text.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Syntax { .. } | Self::NotAnOverride { .. } => "here",
            Self::Duplicate { .. } => "the second one",
            Self::UnknownKey { .. } => "unknown key",
            Self::Header { .. } => "this header",
            Self::UnknownVariant { .. } => "unknown kind",
            Self::MissingKey { .. } => "in this block",
            Self::NotOne { .. } => "this block",
            Self::Conflict { .. } => "this one too",
            Self::WrongType { .. }
            | Self::OutOfRange { .. }
            | Self::Impossible { .. }
            | Self::NotFinite { .. } => "this value",
            Self::NotRising { .. } => "not greater than the one before",
            Self::UnknownName { .. } | Self::BadName { .. } => "this name",
            Self::UnknownWord { .. } => "this word",
            Self::PathOutside { .. }
            | Self::FileMissing { .. }
            | Self::NotARegularFile { .. }
            | Self::BadFile { .. }
            | Self::NotUtf8 { .. } => "this file",
            Self::UnsupportedFormat { .. } => "this number",
            Self::Coverage { .. } => "these data",
            Self::EnergyNotConserved { .. } => "these spectra",
            Self::NoLight | Self::NoObject => "no such block",
            Self::DarkLight { .. } => "this light",
            Self::CannotShine { .. } => "this object",
            Self::BadView { .. } => "this view",
            Self::BadMatrix { .. } => "this matrix",
        }
    }

    /// Whether the error stands on its own when the file has syntax errors elsewhere: what is
    /// missing, unknown or unmatched may only be a consequence of them.
    pub(crate) fn is_about_a_value(&self) -> bool {
        matches!(
            self,
            Self::OutOfRange { .. } | Self::NotFinite { .. } | Self::WrongType { .. }
        )
    }
}

/// More than one of a kind of thing.
fn plural(kind: &str) -> String {
    match kind {
        "mesh" => "meshes".to_owned(),
        "leaf" => "leaves".to_owned(),
        "medium" => "media".to_owned(),
        other => format!("{other}s"),
    }
}
