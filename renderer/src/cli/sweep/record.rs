//! Records of tasks that are done: which files they have made, and what is in them in numbers.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value, json};

use super::tasks::hexadecimal;
use crate::checkpoint::PROGRAM;
use crate::cli::places::write_whole;
use crate::image::{Layer, openexr};
use crate::sweep::{Sweep, Target, Task};

/// What a task has made.
#[derive(Debug)]
pub(super) struct Record {
    identity: u64,
    /// Names of its files, in the folder of the record; the one to look at last.
    pub(super) files: Vec<String>,
    /// Numbers, by name.
    pub(super) outputs: Vec<(String, f64)>,
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
                let mut numbers = Vec::new();
                flatten(&measures, "", &mut numbers);
                numbers
            }
        };
        Ok(Self {
            identity,
            files,
            outputs,
            settings: task.overrides().collect(),
        })
    }

    fn name(identity: u64) -> String {
        format!("{}.json", hexadecimal(identity))
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), String> {
        let outputs = self.outputs.iter();
        let outputs: Map<String, Value> = outputs
            .map(|(name, number)| (name.clone(), json!(number)))
            .collect();
        let record = json!({
            "program": PROGRAM,
            "id": hexadecimal(self.identity),
            "settings": self.settings,
            "files": self.files,
            "outputs": outputs,
        });
        let text = format!("{record:#}\n");
        write_whole(&folder.join(Self::name(self.identity)), text.as_bytes())
            .map_err(|_| "the record cannot be written".to_owned())
    }

    /// Whether a task is done: its record and all files of it are there.
    pub(super) fn is_there(folder: &Path, identity: u64) -> bool {
        Self::read(folder, identity).is_ok_and(|record| record.is_some())
    }

    /// The record of a task; `None` if it is not done. A damaged one counts as none.
    pub(super) fn read(folder: &Path, identity: u64) -> Result<Option<Self>, String> {
        let path = folder.join(Self::name(identity));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("{}: {error}", path.display())),
        };
        let Ok(told) = serde_json::from_str::<Value>(&text) else {
            return Ok(None);
        };
        let texts = |key: &str| -> Vec<String> {
            let list = told[key].as_array().into_iter().flatten();
            list.filter_map(|text| Some(text.as_str()?.to_owned()))
                .collect()
        };
        let files = texts("files");
        let are_there = !files.is_empty() && files.iter().all(|file| folder.join(file).is_file());
        let is_ours = told["id"].as_str() == Some(&hexadecimal(identity));
        let outputs = told["outputs"].as_object().into_iter().flatten();
        let record = Self {
            identity,
            files,
            outputs: outputs
                .filter_map(|(name, number)| Some((name.clone(), number.as_f64()?)))
                .collect(),
            settings: texts("settings"),
        };
        Ok((are_there && is_ours).then_some(record))
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
fn flatten(value: &Value, before: &str, numbers: &mut Vec<(String, f64)>) {
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
        let layer = |name: &str| Layer {
            name: name.to_owned(),
            data: vec![1.0, 3.0, 5.0, 7.0],
        };
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
            identity: 7,
            files: vec!["a.exr".to_owned()],
            outputs: vec![("mean.R".to_owned(), 0.1)],
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
        let path = folder.path().join(Record::name(7));
        fs::write(path, b"{ \"id\"").expect("the folder can be written");
        assert!(!Record::is_there(folder.path(), 7));
    }
}
