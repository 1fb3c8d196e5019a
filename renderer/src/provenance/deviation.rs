//! Two results compared number by number.

use csv::ReaderBuilder;
use serde_json::Value as Json;

use super::{Contents, MEMBER};
use crate::image::Picture;

/// How far the numbers of one result are from those of another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Numbers that were compared.
    pub numbers: u64,
    /// Numbers that differ.
    pub different: u64,
    /// Greatest |a − b| / max(|a|, |b|) of them, infinite if only one is a finite number.
    pub greatest: f64,
    /// The place of the greatest.
    pub place: String,
    /// Texts that differ, such as the name of a scene.
    pub texts: u64,
    /// What only one of the results has: columns, rows, channels, members.
    pub unlike: Option<String>,
}

impl Deviation {
    /// Compares two results; comments, attributes and provenances do not count.
    pub fn between(a: &Contents, b: &Contents) -> Self {
        let mut found = Self::default();
        match (a, b) {
            (Contents::Picture(a), Contents::Picture(b)) => found.add_pictures(a, b),
            (Contents::Json(a), Contents::Json(b)) => found.add_json("", a, b),
            (Contents::Table(a), Contents::Table(b)) => found.add_tables(a, b),
            (Contents::Picture(_) | Contents::Json(_) | Contents::Table(_), _) => {
                found.is_unlike("they are files of two kinds");
            }
        }
        found
    }

    /// Whether every number is there and the same.
    pub fn is_none(&self) -> bool {
        self.different == 0 && self.unlike.is_none()
    }

    fn is_unlike(&mut self, what: impl Into<String>) {
        self.unlike.get_or_insert(what.into());
    }

    fn add(&mut self, a: f64, b: f64, place: impl FnOnce() -> String) {
        self.numbers += 1;
        if a == b || a.to_bits() == b.to_bits() {
            return;
        }
        self.different += 1;
        let deviation = (a - b).abs() / a.abs().max(b.abs());
        let deviation = if deviation.is_finite() {
            deviation
        } else {
            f64::INFINITY
        };
        if deviation > self.greatest {
            (self.greatest, self.place) = (deviation, place());
        }
    }

    fn add_pictures(&mut self, a: &Picture, b: &Picture) {
        if [a.width, a.height] != [b.width, b.height] || a.layers.len() != b.layers.len() {
            self.is_unlike("they have other sizes or channels");
        }
        for one in &a.layers {
            let Some(other) = b.layer(&one.name) else {
                self.is_unlike(format!("only one has the channel {}", one.name));
                continue;
            };
            for (at, (&x, &y)) in one.data.iter().zip(&other.data).enumerate() {
                let width = a.width as usize;
                let place = || format!("{} at pixel ({}, {})", one.name, at % width, at / width);
                self.add(f64::from(x), f64::from(y), place);
            }
        }
    }

    fn add_json(&mut self, place: &str, a: &Json, b: &Json) {
        match (a, b) {
            (Json::Object(a), Json::Object(b)) => {
                let names = a
                    .keys()
                    .chain(b.keys().filter(|name| !a.contains_key(*name)));
                // What the file is of, which is read by itself.
                let names = names.filter(|name| {
                    !(place.is_empty() && [MEMBER, "program"].contains(&name.as_str()))
                });
                for name in names {
                    match (a.get(name), b.get(name)) {
                        (Some(a), Some(b)) => self.add_json(&format!("{place}/{name}"), a, b),
                        _ => self.is_unlike(format!("only one has {place}/{name}")),
                    }
                }
            }
            (Json::Array(a), Json::Array(b)) => {
                if a.len() != b.len() {
                    self.is_unlike(format!("{place} has {} and {} entries", a.len(), b.len()));
                }
                for (at, (a, b)) in a.iter().zip(b).enumerate() {
                    self.add_json(&format!("{place}/{at}"), a, b);
                }
            }
            (Json::Number(a), Json::Number(b)) => {
                let [a, b] = [a, b].map(|number| number.as_f64().unwrap_or(f64::NAN));
                self.add(a, b, || place.to_owned());
            }
            (Json::String(a), Json::String(b)) => self.texts += u64::from(a != b),
            (a, b) if a != b => self.is_unlike(format!("{place} is {a} and {b}")),
            _ => {}
        }
    }

    fn add_tables(&mut self, a: &str, b: &str) {
        let [a, b] = [a, b].map(rows);
        if a.len() != b.len() || a.first() != b.first() {
            self.is_unlike("they have other columns, or other numbers of rows");
        }
        for (row, (one, other)) in a.iter().zip(&b).enumerate().skip(1) {
            for (column, (x, y)) in one.iter().zip(other).enumerate() {
                let number = |cell: &String| cell.parse::<f64>().ok();
                match (number(x), number(y)) {
                    (Some(x), Some(y)) => {
                        self.add(x, y, || format!("{} in row {row}", a[0][column]));
                    }
                    (None, None) => self.texts += u64::from(x != y),
                    _ => self.is_unlike(format!("row {row} has `{x}` and `{y}`")),
                }
            }
        }
    }
}

/// The cells of a table of this program's, without comments.
fn rows(text: &str) -> Vec<Vec<String>> {
    let mut form = ReaderBuilder::new();
    form.comment(Some(b'#')).has_headers(false).flexible(true);
    let records = form.from_reader(text.as_bytes()).into_records();
    let cells = |record: csv::StringRecord| record.iter().map(str::to_owned).collect();
    records.map_while(Result::ok).map(cells).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn of_tables(a: &str, b: &str) -> Deviation {
        let [a, b] = [a, b].map(|text| Contents::Table(text.to_owned()));
        Deviation::between(&a, &b)
    }

    #[test]
    fn the_greatest_relative_deviation_of_a_table_has_its_place() {
        let found = of_tables(
            "# one\nname,x,y\na,1,0\nb,2,4\n",
            "name,x,y\nc,1.1,0\nb,2,8\n",
        );
        assert_eq!((found.numbers, found.different, found.texts), (4, 2, 1));
        assert_eq!((found.greatest, found.place.as_str()), (0.5, "y in row 2"));
        assert!(!found.is_none());
        assert!(of_tables("x\n1\n", "# other\nx\n1.0\n").is_none());
    }

    #[test]
    fn what_only_one_has_is_no_equal_result() {
        for other in ["x\n1\n", "x,y\n1,\n", "x,z\n1,2\n", "x,y\n1,2\n3,4\n"] {
            assert!(!of_tables("x,y\n1,2\n", other).is_none(), "{other}");
        }
        let of = |a: Json, b: Json| Deviation::between(&Contents::Json(a), &Contents::Json(b));
        assert!(!of(json!({"a": [1, 2]}), json!({"a": [1]})).is_none());
        assert!(!of(json!({"a": 1}), json!({"a": null})).is_none());
        assert!(!of(json!({"a": 1}), json!({"b": 1})).is_none());
        assert!(
            of(
                json!({"a": 1, "program": "1"}),
                json!({"a": 1, "program": "2"})
            )
            .is_none()
        );
    }

    #[test]
    fn numbers_that_are_none_differ_from_numbers_alone() {
        let mut found = Deviation::default();
        found.add(f64::NAN, f64::NAN, String::new);
        assert!(found.is_none());
        found.add(1.0, f64::NAN, || "here".to_owned());
        assert_eq!(
            (found.greatest, found.place.as_str()),
            (f64::INFINITY, "here")
        );
    }
}
