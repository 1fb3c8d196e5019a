//! The files that are asked for, checked before any work is done.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use crate::cli::arguments::{CaptionedKinds, GrowArguments, VeinColour};
use crate::cli::places::{check_outputs, check_writable, require_ending, write_and_say};
use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::veins::VeinFormat;
use crate::image::animation::Format;

/// The kind of a file, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) enum Kind {
    /// Margin and veins, which exist at every stage of growth.
    Veins(VeinFormat),
    /// Several stages one after another, written by the program itself.
    Film(Format),
    /// The same, written by another program.
    Mp4,
    Ply,
    Obj,
    Toml,
}

impl Kind {
    pub(super) const SVG: Self = Self::Veins(VeinFormat::Svg);
    pub(in crate::cli) const PNG: Self = Self::Veins(VeinFormat::Png);

    pub(in crate::cli) fn of(path: &Path) -> Result<Self, Failure> {
        Ok(match path.extension().and_then(|ending| ending.to_str()) {
            Some("gif") => Self::Film(Format::Gif),
            Some("apng") => Self::Film(Format::Apng),
            Some("mp4") => Self::Mp4,
            Some("ply") => Self::Ply,
            Some("obj") => Self::Obj,
            Some("toml") => Self::Toml,
            _ => VeinFormat::of(path).map(Self::Veins).ok_or_else(|| {
                bad_at!(
                    path,
                    "the ending tells what is written: svg, png, json, graphml, geojson or csv (veins), gif, apng or mp4 \
                     (films of them), ply or obj (blade), toml (plan)"
                )
            })?,
        })
    }

    /// Whether it shows several stages one after another.
    pub(in crate::cli) fn is_film(self) -> bool {
        matches!(self, Self::Film(_) | Self::Mp4)
    }

    /// Whether it shows drawn veins in colours.
    fn is_drawn(self) -> bool {
        self.is_film() || self == Self::PNG
    }

    fn needs_blade(self) -> bool {
        matches!(self, Self::Ply | Self::Obj)
    }
}

/// All files given by `--out`.
#[derive(Debug)]
pub(super) struct Outputs {
    /// Files of the full-grown leaf.
    pub(super) whole: Vec<(PathBuf, Kind)>,
    /// Files of each stage, without the stage's number.
    pub(super) staged: Vec<(PathBuf, Kind)>,
    /// Whether the blade and its contents are needed.
    pub(super) blade: bool,
    /// Whether veins are needed.
    pub(super) veins: bool,
}

impl Outputs {
    pub(super) fn planned(arguments: &GrowArguments) -> Result<Self, Failure> {
        let kinds = arguments.out.iter().map(|path| Kind::of(path));
        let kinds: Vec<Kind> = kinds.collect::<Result<_, _>>()?;
        let files = arguments.out.iter().cloned().zip(kinds);
        let in_stages = arguments.frames.is_some();
        let in_ages = arguments.ages.is_some();
        let (staged, whole): (Vec<_>, Vec<_>) = files.partition(|(_, kind)| {
            let is_film = kind.is_film();
            (in_stages && (is_film || matches!(kind, Kind::Veins(_))))
                || (in_ages && (is_film || *kind == Kind::PNG))
        });
        if let Some((path, _)) = whole.iter().find(|(_, kind)| kind.is_film()) {
            bail_at!(
                path,
                "a film needs --frames N, which shows growth, or --ages N, which shows ageing"
            );
        }
        check_look(arguments, whole.iter().chain(&staged))?;
        if in_ages && staged.is_empty() && arguments.contents.is_none() {
            bail!(
                "--ages needs an --out that shows colours (png, gif, apng or mp4), or --contents"
            );
        }
        if in_stages && staged.is_empty() {
            bail!(
                "--frames needs an --out that shows veins: svg, png, json, graphml, geojson, csv, gif, apng or mp4"
            );
        }
        let is_obj = |path: &&PathBuf| Kind::of(path).is_ok_and(|kind| kind == Kind::Obj);
        let materials = arguments.out.iter().filter(is_obj);
        let materials: Vec<_> = materials.map(|path| path.with_extension("mtl")).collect();
        let reports = [&arguments.measure, &arguments.stats, &arguments.fields];
        let reports = reports.into_iter().flatten();
        let what = "--fields writes a texture with float channels";
        require_ending(&arguments.fields, "exr", what)?;
        let named = arguments.out.iter().chain(&materials);
        check_outputs(named.chain(reports), &[], "the command")?;
        if let Some(folder) = &arguments.contents {
            check_folder(folder)?;
        }
        let blade = (arguments.contents.is_some() && !in_ages)
            || whole.iter().any(|(_, kind)| kind.needs_blade());
        let only_plan = !whole.is_empty() && whole.iter().all(|(_, kind)| *kind == Kind::Toml);
        let counts = arguments.describe
            || arguments.measure.is_some()
            || arguments.stats.is_some()
            || arguments.fields.is_some();
        Ok(Self {
            veins: blade || counts || in_stages || in_ages || !only_plan,
            whole,
            staged,
            blade,
        })
    }
}

impl Outputs {
    /// Whether the blade is painted for an output.
    pub(super) fn show_colours(&self) -> bool {
        self.whole.iter().any(|(_, kind)| *kind == Kind::Obj)
    }

    /// Whether no output depends on the contents of the leaf.
    pub(super) fn show_only_veins(&self, arguments: &GrowArguments) -> bool {
        let has_plan = self.whole.iter().any(|(_, kind)| *kind == Kind::Toml);
        let shows_contents = self.blade || arguments.contents.is_some() || arguments.ages.is_some();
        !has_plan && !shows_contents
    }
}

/// Fails if something is asked for that no file can show.
fn check_look<'a>(
    arguments: &GrowArguments,
    files: impl IntoIterator<Item = &'a (PathBuf, Kind)>,
) -> Result<(), Failure> {
    let (mut is_drawn, mut has_svg) = (false, false);
    for (_, kind) in files {
        is_drawn |= kind.is_drawn();
        has_svg |= *kind == Kind::SVG;
    }
    let refused = |flag: &str, needs: &str| Err(bad!("{flag} {needs}"));
    let is_plain =
        arguments.colour == VeinColour::Plain && arguments.caption == CaptionedKinds::default();
    if arguments.individuals.is_some() && !is_plain {
        return refused(
            "--individuals",
            "draws leaves without --colour and --caption",
        );
    }
    if arguments.sources {
        if arguments.frames.is_none() {
            return refused(
                "--sources",
                "needs --frames: a full-grown leaf has none left",
            );
        }
        if !is_drawn || has_svg {
            return refused("--sources", "is shown by png, gif, apng and mp4 alone");
        }
    }
    match arguments.colour {
        VeinColour::Order | VeinColour::Age if arguments.ages.is_some() => refused(
            "--colour",
            "colours veins, and --ages shows the blade in its own colours",
        ),
        VeinColour::Age if !is_drawn || has_svg => {
            refused("--colour age", "is shown by png, gif, apng and mp4 alone")
        }
        VeinColour::Order if !is_drawn && !has_svg => refused(
            "--colour order",
            "is shown by svg, png, gif, apng and mp4 alone",
        ),
        VeinColour::Plain | VeinColour::Order | VeinColour::Age => Ok(()),
    }
}

/// Fails if a folder can neither be written to nor be made.
fn check_folder(folder: &Path) -> Result<(), Failure> {
    let there = folder
        .ancestors()
        .find(|path| path.as_os_str().is_empty() || path.exists());
    match there {
        Some(path) if path == folder && !path.is_dir() => {
            Err(bad!("{} is a file: name a folder", folder.display()))
        }
        Some(path) => check_writable(&path.join("map.exr")),
        None => Ok(()),
    }
}

/// The file of stage `number`, counted from 1: `leaf-0001.png` for `leaf.png`.
pub(in crate::cli) fn numbered(path: &Path, number: usize) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:04}"));
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

/// Writes a file and prints its name, unless the run was interrupted.
pub(super) fn finish(path: &Path, bytes: &[u8], stop: &AtomicBool) -> Result<(), Failure> {
    signals::check(stop)?;
    write_and_say(path, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_numbered_before_the_ending() {
        for (path, expected) in [
            ("leaf.png", "leaf-0001.png"),
            ("a.b/leaf.x.svg", "a.b/leaf.x-0001.svg"),
        ] {
            assert_eq!(numbered(Path::new(path), 1), Path::new(expected));
        }
        assert_eq!(
            numbered(Path::new("leaf.png"), 12_345),
            Path::new("leaf-12345.png")
        );
    }
}
