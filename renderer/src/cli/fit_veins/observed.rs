//! The measures of the leaf that is to be matched.

use std::path::Path;

use leafmodel::document::source::quoted;
use leafmodel::inference::{Observation, Role};
use leafmodel::measure::fitting::{FITTED, HELD_OUT, possible};
use serde_json::{Map, Value};

use crate::cli::arguments::FitVeinsArguments;
use crate::cli::terminal::{Failure, did_you_mean};
use crate::cli::texts::bytes_of;

/// Most bytes of a file of measures; those of a leaf have a few thousand.
const MOST_BYTES: u64 = 1 << 24;

/// What was measured, and what it is for.
#[derive(Debug)]
pub(super) struct Observed {
    pub(super) list: Vec<Observation>,
    /// Area of the blade, mm², if the file has it.
    pub(super) area_mm2: Option<f64>,
    /// What was left out, in words.
    pub(super) notes: Vec<String>,
}

impl Observed {
    /// Reads the file that the command line names.
    pub(super) fn read(arguments: &FitVeinsArguments) -> Result<Self, Failure> {
        let path = arguments.measures.as_path();
        let members = members(path)?;
        Self::of(&members, &arguments.fit, &arguments.hold_out)
            .map_err(|problem| bad_at!(path, "{problem}"))
    }

    fn of(members: &Map<String, Value>, fit: &[String], held: &[String]) -> Result<Self, String> {
        if let Some(both) = fit.iter().find(|key| held.contains(key)) {
            return Err(format!("`{both}` is both fitted and held out"));
        }
        let mut observed = Self {
            list: Vec::new(),
            area_mm2: members.get("area_mm2").and_then(Value::as_f64),
            notes: Vec::new(),
        };
        let roles = [
            (Role::Fitted, fit, FITTED.as_slice(), held),
            (Role::HeldOut, held, HELD_OUT.as_slice(), fit),
        ];
        for (role, named, usual, elsewhere) in roles {
            if named.is_empty() {
                let keys = usual.iter().filter(|key| {
                    let is_it = |other: &String| other == **key;
                    !elsewhere.iter().any(is_it)
                });
                observed.add_usual(members, role, keys.copied())?;
            } else {
                observed.add_named(members, role, named)?;
            }
        }
        if observed.list.iter().any(|one| one.role == Role::Fitted) {
            return Ok(observed);
        }
        Err(format!(
            "it has none of the measures that are fitted ({}): write them with lamina grow LEAF \
             --measure, or name others by --fit",
            FITTED.join(", ")
        ))
    }

    /// Measures that the command line names: each has to be there.
    fn add_named(
        &mut self,
        members: &Map<String, Value>,
        role: Role,
        keys: &[String],
    ) -> Result<(), String> {
        let possible = possible();
        for key in keys {
            if !possible.contains(&key.as_str()) {
                let meant = did_you_mean(key, possible.iter().copied());
                return Err(format!(
                    "`{}` is no number that is measured of leaves that grow{meant}\n  These can be \
                     fitted or held out: {}",
                    quoted(key),
                    possible.join(", ")
                ));
            }
            let Some(value) = members.get(key) else {
                return Err(format!("the measure `{key}` is not in the file"));
            };
            let value = number(key, value)?
                .ok_or_else(|| format!("`{key}` is null: the leaf has nothing to measure"))?;
            self.list
                .push(Observation::from((key.as_str(), value, role)));
        }
        Ok(())
    }

    /// The usual measures, as far as the leaf has them.
    fn add_usual(
        &mut self,
        members: &Map<String, Value>,
        role: Role,
        keys: impl Iterator<Item = &'static str>,
    ) -> Result<(), String> {
        let mut missing = Vec::new();
        for key in keys {
            let value = members.get(key).map(|value| number(key, value));
            match value.transpose()?.flatten() {
                Some(value) => self.list.push(Observation::from((key, value, role))),
                None => missing.push(key),
            }
        }
        if !missing.is_empty() {
            let what = match role {
                Role::Fitted => "fitted",
                Role::HeldOut => "foretold",
            };
            let missing = missing.join(", ");
            self.notes
                .push(format!("the measures lack {missing}, which are not {what}"));
        }
        Ok(())
    }
}

/// A measure as a number; `None` for null.
fn number(key: &str, value: &Value) -> Result<Option<f64>, String> {
    let refused = |what: String| Err(format!("`{key}` is {what}, not a number"));
    match value {
        Value::Null => Ok(None),
        Value::Number(number) => Ok(number.as_f64()),
        Value::Bool(flag) => refused(flag.to_string()),
        Value::String(text) => refused(format!("the text \"{}\"", quoted(text))),
        Value::Array(_) => refused("a list".to_owned()),
        Value::Object(_) => refused("an object".to_owned()),
    }
}

/// The members of the object in a JSON file.
fn members(path: &Path) -> Result<Map<String, Value>, Failure> {
    let shown = path.display();
    let bytes = bytes_of(path, MOST_BYTES)?;
    let value = serde_json::from_slice::<Value>(&bytes).map_err(|error| {
        bad!(
            "{shown}:{}:{}: not JSON: {error}",
            error.line(),
            error.column()
        )
    })?;
    match value {
        Value::Object(members) => Ok(members),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) | Value::Array(_) => {
            Err(bad!(
                "{shown}: not an object of measures, as lamina grow --measure writes it"
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn read(value: &Value, fit: &[&str], held: &[&str]) -> Result<Observed, String> {
        let owned = |keys: &[&str]| keys.iter().map(|key| (*key).to_owned()).collect::<Vec<_>>();
        let members = value.as_object().expect("an object");
        Observed::of(members, &owned(fit), &owned(held))
    }

    #[test]
    fn measures_have_their_roles_and_what_is_missing_is_reported() {
        let leaf = json!({
            "area_mm2": 900.0, "areoles_per_mm2": 0.5, "areole_area_cv": null,
            "spanning_tree_ratio": 0.7, "elliptic_fourier": [1, 2],
        });
        let observed = read(&leaf, &[], &[]).expect("measures");
        assert_eq!(observed.area_mm2, Some(900.0));
        let roles: Vec<(&str, Role)> = observed
            .list
            .iter()
            .map(|one| (one.key.as_str(), one.role))
            .collect();
        let wanted = [
            ("areoles_per_mm2", Role::Fitted),
            ("spanning_tree_ratio", Role::HeldOut),
        ];
        assert_eq!(roles, wanted);
        assert!(
            observed.notes[0].contains("areole_area_cv"),
            "{:?}",
            observed.notes
        );
        // A measure that is fitted is not held out as well.
        let other = read(&leaf, &["spanning_tree_ratio"], &[]).expect("measures");
        assert_eq!(other.list.len(), 1);
    }

    #[test]
    fn measures_that_are_none_are_refused_by_name() {
        let leaf = json!({
            "areoles_per_mm2": "many", "loop_nesting": null, "widest_at": [1],
            "conductance_mm3_per_s_mpa": 3.0,
        });
        let refusal =
            |fit: &[&str], held: &[&str]| read(&leaf, fit, held).expect_err("something is wrong");
        assert!(refusal(&[], &[]).contains("`areoles_per_mm2` is the text \"many\""));
        assert!(refusal(&["loop_nestin"], &[]).contains("did you mean `loop_nesting`?"));
        assert!(refusal(&["loop_nesting"], &[]).contains("is null"));
        assert!(refusal(&["widest_at"], &[]).contains("is a list, not a number"));
        let both = ["widest_at"];
        assert!(refusal(&both, &both).contains("both fitted and held out"));
        assert!(refusal(&["solidity"], &[]).contains("`solidity` is not in the file"));
        // Measured of a file, but never of a leaf that grows: no range of --free would help.
        for key in ["conductance_mm3_per_s_mpa", "elliptic_fourier"] {
            let told = refusal(&[key], &[]);
            assert!(
                told.contains("no number that is measured of leaves that grow"),
                "{told}"
            );
            assert!(told.contains("areoles_per_mm2, "), "{told}");
        }
        let empty = read(&json!({}), &[], &[]).expect_err("nothing is there");
        assert!(empty.contains("none of the measures that are fitted"));
    }
}
