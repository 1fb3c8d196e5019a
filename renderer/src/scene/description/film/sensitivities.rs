//! `sensitivities` of `[film.rgb]`: the CIE's observer, a camera by name, or one in a file.

use std::sync::Arc;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::nearest::nearest;
use leafmodel::document::reader::Block;
use leafmodel::document::schema::Type;
use leafmodel::document::source::{Place, escaped};
use leafmodel::document::tree::{Node, Table, Value};
use leafmodel::document::value_kind::{FilePath, Kind, NamedFile};
use leafmodel::document::values::{listed, wrong_type};

use crate::measured::sensitivities;
use crate::scene::blocks::table_file::TableFile;
use crate::spectrum::observer::{CHANNELS, Camera, NotACamera, Observer};

/// Least share of a channel's response that a film should record.
pub(super) const LEAST_SHARE: f64 = 0.95;

/// Share of a channel's greatest sensitivity that may be left where a table ends.
const MOST_AT_END: f64 = 0.05;

const WANTED: &str = "the name of a camera or \"cie-1931\", or `{ file = \"….csv\" }`";

/// Sensitivities of a film that records these wavelengths, nm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sensitivities {
    pub(super) range_nm: [f64; 2],
}

impl Kind for Sensitivities {
    type Of = Observer;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Observer> {
        self.form(cx, node, key, key.to_owned())
    }

    fn read_in(&self, block: &Block<'_>, node: &Node, key: &str) -> Option<Observer> {
        self.form(block.cx, node, key, block.path_of(key))
    }

    fn write(&self, value: &Observer) -> Value {
        if Observer::names().any(|name| name == value.name()) {
            return Value::Text(value.name().to_owned());
        }
        let file = Value::Text(value.name().to_owned());
        Value::Table(Table::of([("file", file)]))
    }

    fn describe(&self) -> Type {
        let form = Keys::describe(|keys| {
            keys.one_of(&["file"], None);
            keys.optional("file", &mut None, FILE, ABOUT_FILE);
        });
        let names = Observer::names().map(str::to_owned).collect();
        Type::AnyOf(vec![Type::Word(names), Type::Table(form)], WANTED)
    }
}

const FILE: FilePath = FilePath::of("the path of a CSV file", &["csv", "tsv", "txt"], 1 << 20);
const ABOUT_FILE: &str =
    "A table of wavelength in nm and the sensitivities of red, green and blue.";

impl Sensitivities {
    fn form(self, cx: &Context, node: &Node, key: &str, path: String) -> Option<Observer> {
        match &node.value {
            Value::Text(name) => {
                let found = Observer::by_name(name);
                if found.is_none() {
                    let error = DocumentError::UnknownWord {
                        key: key.to_owned(),
                        word: escaped(name, QUOTED),
                        nearest: nearest(name, Observer::names()).map(str::to_owned),
                        known: listed(Observer::names()),
                    };
                    cx.error(&node.at, error);
                }
                found
            }
            Value::Table(table) => {
                let mut observer = None;
                let form = Block::new(cx, table, path, node.at.clone());
                Keys::read(form, None, |keys| {
                    keys.one_of(&["file"], None);
                    let mut named = None;
                    keys.optional("file", &mut named, FILE, ABOUT_FILE);
                    let at = keys.reader().and_then(|form| form.node("file"));
                    observer = named
                        .zip(at)
                        .and_then(|(file, node)| self.of_file(cx, &file, &node.at));
                });
                observer
            }
            Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_) => {
                wrong_type(cx, node, key, WANTED);
                None
            }
        }
    }

    fn of_file(self, cx: &Context, named: &NamedFile, at: &Place) -> Option<Observer> {
        let file = TableFile::read(cx, &named.file, &named.written, at)?;
        let rows = file.sound(sensitivities::read(&file.text))?;
        match Camera::new(&named.written, rows) {
            Ok(camera) => {
                self.check(&camera, &file)?;
                Some(Observer::Camera(Arc::new(camera)))
            }
            Err(problem) => {
                let help = match problem {
                    NotACamera::Blind(_) => "give each channel a sensitivity above 0 somewhere",
                    NotACamera::Dependent => "give the three channels different sensitivities",
                    NotACamera::Disordered | NotACamera::Negative => "mend the table",
                };
                file.refuse(problem.to_string(), help);
                None
            }
        }
    }

    /// Refuses a camera with a channel that sees nothing on the film, and warns of what is left out.
    fn check(self, camera: &Camera, file: &TableFile<'_>) -> Option<()> {
        const HELP: &str = "widen `range_nm` of the film to what the camera sees";
        let [low, high] = self.range_nm;
        let shares = camera.share_within(self.range_nm);
        let rows = camera.rows();
        for (i, channel) in CHANNELS.into_iter().enumerate() {
            if shares[i] <= 0.0 {
                let problem = format!(
                    "has a channel `{channel}` that sees nothing from {low} to {high} nm, which the film \
                     records"
                );
                file.refuse(problem, HELP);
                return None;
            }
            if shares[i] < LEAST_SHARE {
                let percent = 100.0 * (1.0 - shares[i]);
                let message = format!(
                    "the film leaves out {percent:.0} % of what the channel `{channel}` sees"
                );
                file.warn("scene::range", &message, HELP);
            }
            let most = rows.iter().fold(0.0_f64, |most, row| most.max(row.1[i]));
            for (nm, values) in [&rows[0], &rows[rows.len() - 1]] {
                if values[i] > MOST_AT_END * most && *nm > low && *nm < high {
                    let share = 100.0 * values[i] / most;
                    let message = format!(
                        "the channel `{channel}` ends at {nm} nm with {share:.0} % of its greatest \
                         sensitivity, and counts as 0 beyond"
                    );
                    let help = "continue the table to where the camera sees nothing";
                    file.warn("scene::range", &message, help);
                }
            }
        }
        Some(())
    }
}
