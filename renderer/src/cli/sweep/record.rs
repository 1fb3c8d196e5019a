//! Records of tasks that are done: which files they have made, and what is in them in numbers.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::checkpoint::PROGRAM;
use crate::cli::places::{has_ending, write_whole};
use crate::cli::terminal::Failure;
use crate::image::{Layer, openexr};
use crate::scene::fingerprint::hexadecimal;
use crate::sweep::{Sweep, Target, Task};

/// What a task has made.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Record {
    /// The version that has done it.
    program: String,
    id: String,
    /// Names of its files, in the folder of the record; the one to look at last.
    pub(super) files: Vec<String>,
    /// Numbers, by name.
    pub(super) outputs: BTreeMap<String, f64>,
    settings: Vec<String>,
}

/// Pixels along the longer side of a leaf's small picture, for contact sheets.
const SKETCH_PIXELS: u32 = 400;

/// The files that a task writes, and the words that ask for them.
pub(super) fn files(
    sweep: &Sweep,
    folder: &Path,
    identity: u64,
    words: &mut Vec<String>,
) -> Vec<String> {
    let name = hexadecimal(identity);
    let at = |file: &str| folder.join(file).display().to_string();
    match &sweep.target {
        Target::Scene(_) => {
            words.extend(["--out".to_owned(), at(&name)]);
            if folder.join(format!("{name}.checkpoint")).exists() {
                words.push("--resume".to_owned());
            }
            ["exr", "png"]
                .map(|ending| format!("{name}.{ending}"))
                .into()
        }
        Target::Leaf(_) => {
            let measures = format!("{name}.measures.json");
            let [sketch, picture] = ["png", "svg"].map(|ending| format!("{name}.{ending}"));
            words.extend(["--out".to_owned(), at(&picture), at(&sketch)]);
            words.extend(["--size".to_owned(), SKETCH_PIXELS.to_string()]);
            words.extend(["--measure".to_owned(), at(&measures)]);
            vec![measures, sketch, picture]
        }
    }
}

impl Record {
    /// The record of a task that has just been done.
    pub(super) fn of(
        sweep: &Sweep,
        task: &Task<'_>,
        identity: u64,
        folder: &Path,
        files: Vec<String>,
    ) -> Result<Self, String> {
        let path = folder.join(&files[0]);
        let outputs = match &sweep.target {
            Target::Scene(_) => {
                let picture = openexr::read(&path).map_err(|error| error.to_string())?;
                picture.layers.iter().filter_map(mean).collect()
            }
            Target::Leaf(_) => {
                let text = fs::read_to_string(&path);
                let text = text.map_err(|error| format!("{}: {error}", path.display()))?;
                let measures: Value = serde_json::from_str(&text)
                    .map_err(|error| format!("{}: {error}", path.display()))?;
                let mut numbers = BTreeMap::new();
                flatten(&measures, "", &mut numbers);
                numbers
            }
        };
        Ok(Self {
            program: PROGRAM.to_owned(),
            id: hexadecimal(identity),
            files,
            outputs,
            settings: task.overrides().collect(),
        })
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), String> {
        // Members in alphabetical order.
        let text = serde_json::to_value(self).map(|record| format!("{record:#}\n"));
        let text = text.map_err(|error| error.to_string())?;
        write_whole(&folder.join(format!("{}.json", self.id)), text)
            .map_err(|_| "the record cannot be written".to_owned())
    }

    /// Whether a task is done: its record and all files of it are there.
    pub(super) fn is_there(folder: &Path, identity: u64) -> bool {
        Self::read(folder, identity).is_ok_and(|record| record.is_some())
    }

    /// The record of a task; `None` if it is not done. A damaged one counts as none.
    pub(super) fn read(folder: &Path, identity: u64) -> Result<Option<Self>, String> {
        let id = hexadecimal(identity);
        let path = folder.join(format!("{id}.json"));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("{}: {error}", path.display())),
        };
        let record = serde_json::from_str::<Self>(&text).ok();
        Ok(record.filter(|record| {
            let mut files = record.files.iter();
            record.id == id
                && !record.files.is_empty()
                && files.all(|file| folder.join(file).is_file())
        }))
    }
}

/// Fails if another version has done tasks in this folder: it would do all of them again.
pub(super) fn check_version(folder: &Path) -> Result<(), Failure> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let records = entries.filter_map(|entry| {
        let path = entry.path();
        // Records are called by their identities.
        let is_record = path.file_stem()?.len() == 16 && has_ending(&path, "json");
        let text = is_record.then(|| fs::read_to_string(path).ok())??;
        serde_json::from_str::<Record>(&text).ok()
    });
    match records
        .map(|record| record.program)
        .find(|by| by != PROGRAM)
    {
        None => Ok(()),
        Some(version) => Err(bad_at!(
            folder,
            "its tasks were done by Lamina {version}: continue the sweep with that version, or \
             name another folder by --out"
        )),
    }
}

/// The mean of a channel of light over the picture, or the standard error of that mean from a
/// channel of variances; `None` for other layers.
fn mean(layer: &Layer) -> Option<(String, f64)> {
    let channel = layer.name.strip_prefix("variance.").unwrap_or(&layer.name);
    let shown = match channel.strip_prefix("S0.") {
        Some(band) => format!(
            "{}nm",
            band.strip_suffix("nm")?
                .replace(',', ".")
                .parse::<f64>()
                .ok()?
        ),
        None if ["R", "G", "B", "A"].contains(&channel) => channel.to_owned(),
        None => return None,
    };
    let sum: f64 = layer.data.iter().map(|value| f64::from(*value)).sum();
    let count = layer.data.len() as f64;
    Some(if channel.len() < layer.name.len() {
        (format!("error.{shown}"), sum.sqrt() / count)
    } else {
        (format!("mean.{shown}"), sum / count)
    })
}

/// The numbers of an object by their paths; lists are left out.
fn flatten(value: &Value, before: &str, numbers: &mut BTreeMap<String, f64>) {
    match value {
        Value::Object(object) => {
            for (key, inner) in object {
                let path = if before.is_empty() {
                    key.clone()
                } else {
                    format!("{before}.{key}")
                };
                flatten(inner, &path, numbers);
            }
        }
        Value::Number(number) => numbers.extend(number.as_f64().map(|n| (before.to_owned(), n))),
        Value::Null | Value::Bool(_) | Value::String(_) | Value::Array(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_errors_are_those_of_light() {
        let layer = |name: &str| Layer::new(name, vec![1.0, 3.0, 5.0, 7.0]);
        assert_eq!(mean(&layer("G")), Some(("mean.G".to_owned(), 4.0)));
        // Variances of pixels add up, that of the mean is their sum over the square of the count.
        assert_eq!(
            mean(&layer("variance.G")),
            Some(("error.G".to_owned(), 1.0))
        );
        assert_eq!(
            mean(&layer("S0.450,500000nm")),
            Some(("mean.450.5nm".to_owned(), 4.0))
        );
        assert_eq!(
            mean(&layer("variance.S0.450,000000nm")),
            Some(("error.450nm".to_owned(), 1.0))
        );
        assert_eq!(mean(&layer("albedo.R")), None);
        assert_eq!(mean(&layer("depth.Z")), None);
    }

    #[test]
    fn a_damaged_record_or_one_without_its_files_is_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let record = Record {
            program: "0.0.9".to_owned(),
            id: hexadecimal(7),
            files: vec!["a.exr".to_owned()],
            outputs: [("mean.R".to_owned(), 0.1)].into(),
            settings: vec!["x=1".to_owned()],
        };
        record
            .write(folder.path())
            .expect("the folder can be written");
        assert!(!Record::is_there(folder.path(), 7));
        fs::write(folder.path().join("a.exr"), b"").expect("the folder can be written");
        let read = Record::read(folder.path(), 7)
            .expect("readable")
            .expect("it is done");
        assert_eq!(read.outputs, record.outputs);
        assert!(!Record::is_there(folder.path(), 8));
        let Err(Failure::BadInput(message)) = check_version(folder.path()) else {
            panic!("another version has done the task");
        };
        assert!(
            message.contains("were done by Lamina 0.0.9: continue"),
            "{message}"
        );
        let path = folder.path().join(format!("{}.json", record.id));
        fs::write(path, b"{ \"id\"").expect("the folder can be written");
        assert!(!Record::is_there(folder.path(), 7));
        assert!(check_version(folder.path()).is_ok());
    }
}
