//! Tables of measured spectra: which column is what, in which unit.
//!
//! A table has a line of names. One column holds wavelengths. Either every other column belongs to
//! a leaf and ends in R or T (`birch_R`, `birch.T`, `leaf 3 reflectance`), or a column names the
//! leaf of each line and two others are R and T. Micrometres and percent are recognised and told.

use std::path::Path;

use csv::StringRecord;

/// A leaf's spectra, by rising wavelength.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Leaf {
    pub(super) name: String,
    pub(super) nm: Vec<f64>,
    /// As long as the wavelengths, or empty.
    pub(super) reflectance: Vec<f64>,
    /// As long as the wavelengths, or empty.
    pub(super) transmittance: Vec<f64>,
}

/// Leaves of a table, and what was taken for granted about it.
#[derive(Debug)]
pub(super) struct Spectra {
    pub(super) leaves: Vec<Leaf>,
    pub(super) notes: Vec<String>,
}

/// What a column holds.
#[derive(Clone, Debug, PartialEq)]
enum Column {
    Wavelength,
    /// The name of each line's leaf.
    Name,
    Reflectance(String),
    Transmittance(String),
    /// Something else, which is passed over.
    Other,
}

/// Wavelengths below this are micrometres: 0.4 to 2.5 against 400 to 2500.
const MOST_UM: f64 = 30.0;
/// Where the upper quarter of all values is above this they are percent.
const MOST_SHARE: f64 = 1.5;
/// Measured noise below 0, and of R + T beyond 1, that is let pass.
const NOISE: f64 = 0.05;

/// Reads a table; an error names line, column and value.
pub(super) fn read(file: &Path, text: &str) -> Result<Spectra, String> {
    let shown = file.display();
    let delimiter = delimiter(text);
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let names = reader
        .headers()
        .map_err(|error| format!("{shown}: {error}"))?
        .clone();
    let columns = columns(&names).map_err(|what| format!("{shown}: {what}"))?;
    let mut rows: Vec<(u64, StringRecord)> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| format!("{shown}: {error}"))?;
        let line = record.position().map_or(0, csv::Position::line);
        rows.push((line, record));
    }
    let mut leaves: Vec<Leaf> = Vec::new();
    let mut place = vec![None; columns.len()];
    for (line, record) in &rows {
        let number = |column: usize| number(record, &names, column);
        let at = |what: String| format!("{shown}, line {line}: {what}");
        let wavelength = columns
            .iter()
            .position(|column| *column == Column::Wavelength);
        let nm = number(wavelength.unwrap_or(0)).map_err(at)?;
        let of_line = columns.iter().position(|column| *column == Column::Name);
        for (column, kind) in columns.iter().enumerate() {
            let (leaf, is_r) = match kind {
                Column::Reflectance(leaf) => (leaf, true),
                Column::Transmittance(leaf) => (leaf, false),
                Column::Wavelength | Column::Name | Column::Other => continue,
            };
            let leaf = of_line.map_or(leaf.as_str(), |column| &record[column]);
            let value = number(column).map_err(at)?;
            let known = place[column].filter(|&i: &usize| leaves[i].name == leaf);
            let i = known
                .or_else(|| leaves.iter().position(|known| known.name == leaf))
                .unwrap_or_else(|| {
                    leaves.push(Leaf {
                        name: leaf.to_owned(),
                        ..Leaf::default()
                    });
                    leaves.len() - 1
                });
            place[column] = Some(i);
            let leaf = &mut leaves[i];
            if leaf.nm.last() != Some(&nm) {
                if leaf.nm.last().is_some_and(|last| nm < *last) {
                    let what = format!(
                        "wavelength {nm} after {}: sort the lines",
                        leaf.nm[leaf.nm.len() - 1]
                    );
                    return Err(at(what));
                }
                leaf.nm.push(nm);
            }
            let values = if is_r {
                &mut leaf.reflectance
            } else {
                &mut leaf.transmittance
            };
            values.push(value);
            if values.len() != leaf.nm.len() {
                return Err(at(format!("wavelength {nm} is there twice for one leaf")));
            }
        }
    }
    if leaves.is_empty() {
        return Err(format!("{shown}: there are no lines of numbers"));
    }
    let mut notes = Vec::new();
    to_nanometres(&mut leaves, &mut notes);
    to_shares(&mut leaves, &mut notes);
    for leaf in &leaves {
        check(leaf).map_err(|what| format!("{shown}: {what}"))?;
    }
    Ok(Spectra { leaves, notes })
}

/// The separator that the line of names has most of.
fn delimiter(text: &str) -> u8 {
    let names = text
        .lines()
        .find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let names = names.unwrap_or_default();
    let count = |separator: u8| names.bytes().filter(|byte| *byte == separator).count();
    // The last of equals is taken, so that the comma wins.
    [b'\t', b';', b',']
        .into_iter()
        .max_by_key(|separator| count(*separator))
        .unwrap_or(b',')
}

fn columns(names: &StringRecord) -> Result<Vec<Column>, String> {
    let columns: Vec<Column> = names.iter().map(column).collect();
    let count = |wanted: Column| columns.iter().filter(|column| **column == wanted).count();
    if count(Column::Wavelength) != 1 {
        return Err(format!(
            "one column must hold the wavelengths, named wavelength_nm, nm or um; it has {}",
            names.iter().take(8).collect::<Vec<_>>().join(", ")
        ));
    }
    if count(Column::Name) > 1 {
        return Err("only one column may name the leaf of each line".to_owned());
    }
    let has_value =
        |column: &Column| matches!(column, Column::Reflectance(_) | Column::Transmittance(_));
    if !columns.iter().any(has_value) {
        return Err("no column is named R, T, reflectance or transmittance, or ends so".to_owned());
    }
    for (i, column) in columns.iter().enumerate() {
        if has_value(column) && columns[..i].contains(column) {
            return Err(format!("the column {} is there twice", &names[i]));
        }
    }
    Ok(columns)
}

/// What a column's name says of it.
fn column(name: &str) -> Column {
    // Only ASCII changes its case, so that places in both are the same.
    let lower = name.to_ascii_lowercase();
    let words = words(&lower);
    let says = |of: &[&str]| words.iter().any(|(_, word)| of.contains(word));
    if says(&["wavelength", "wavelengths", "wl", "lambda"])
        || matches!(words[..], [(_, "nm" | "um" | "µm")])
    {
        return Column::Wavelength;
    }
    if matches!(words[..], [(_, "leaf" | "case" | "sample" | "name" | "id")]) {
        return Column::Name;
    }
    let is_unit = |(_, word): &(usize, &str)| ["percent", "pct"].contains(word);
    let Some(&(place, last)) = words.iter().rfind(|word| !is_unit(word)) else {
        return Column::Other;
    };
    let is_r = match last {
        "r" | "refl" | "reflectance" => true,
        "t" | "trans" | "transmittance" => false,
        _ => return Column::Other,
    };
    // The leaf's name is what stands before, as written.
    let leaf = name[..place].trim_end_matches(|c: char| !c.is_alphanumeric());
    let leaf = leaf.to_owned();
    if is_r {
        Column::Reflectance(leaf)
    } else {
        Column::Transmittance(leaf)
    }
}

/// The words of a name, each with its place.
fn words(name: &str) -> Vec<(usize, &str)> {
    let parts = name.split(|c: char| !c.is_alphanumeric() && c != 'µ');
    // Each part lies within the name.
    let placed = parts.map(|part| (part.as_ptr().addr() - name.as_ptr().addr(), part));
    placed.filter(|(_, part)| !part.is_empty()).collect()
}

fn number(record: &StringRecord, names: &StringRecord, column: usize) -> Result<f64, String> {
    let written = &record[column];
    let value = written
        .parse::<f64>()
        .ok()
        .filter(|value| value.is_finite());
    value.ok_or_else(|| {
        let written: String = written.chars().take(40).collect();
        format!(
            "{} is \"{}\", not a number",
            &names[column],
            written.escape_debug()
        )
    })
}

fn to_nanometres(leaves: &mut [Leaf], notes: &mut Vec<String>) {
    let all = || leaves.iter().flat_map(|leaf| &leaf.nm);
    if all().all(|nm| *nm < MOST_UM) {
        notes.push("wavelengths are taken for µm".to_owned());
        for nm in leaves.iter_mut().flat_map(|leaf| &mut leaf.nm) {
            *nm *= 1000.0;
        }
    }
}

fn to_shares(leaves: &mut [Leaf], notes: &mut Vec<String>) {
    let mut values: Vec<f64> = leaves
        .iter()
        .flat_map(|leaf| leaf.reflectance.iter().chain(&leaf.transmittance))
        .copied()
        .collect();
    values.sort_by(f64::total_cmp);
    // One value that is wrong does not make a table percent: a quarter of all are that large.
    if values[values.len() * 3 / 4] > MOST_SHARE {
        notes.push("values are taken for percent".to_owned());
        for leaf in leaves {
            for value in leaf.reflectance.iter_mut().chain(&mut leaf.transmittance) {
                *value /= 100.0;
            }
        }
    }
}

/// Refuses what no leaf has, and spectra with gaps.
fn check(leaf: &Leaf) -> Result<(), String> {
    let name = if leaf.name.is_empty() {
        String::new()
    } else {
        format!("{}: ", leaf.name)
    };
    for (what, values) in [("R", &leaf.reflectance), ("T", &leaf.transmittance)] {
        if !values.is_empty() && values.len() != leaf.nm.len() {
            let (has, all) = (values.len(), leaf.nm.len());
            return Err(format!(
                "{name}{what} has {has} values at {all} wavelengths"
            ));
        }
        for (value, nm) in values.iter().zip(&leaf.nm) {
            if !(-NOISE..=1.0 + NOISE).contains(value) {
                return Err(format!(
                    "{name}{what} is {value} at {nm} nm, allowed is 0 to 1"
                ));
            }
        }
    }
    let both = leaf
        .reflectance
        .iter()
        .zip(&leaf.transmittance)
        .zip(&leaf.nm);
    for ((r, t), nm) in both {
        if r + t > 1.0 + NOISE {
            return Err(format!(
                "{name}R + T is {} at {nm} nm, allowed is up to 1",
                r + t
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Spectra, String> {
        read(Path::new("x.csv"), text)
    }

    #[test]
    fn columns_of_several_leaves_are_told_apart_by_their_names() {
        let text = "# a comment\nwavelength_nm,birch_R,birch_T,leaf 3 reflectance\n\
            400,0.05,0.01,0.1\n410,0.06,0.02,0.2\n";
        let found = parsed(text).expect("a good table");
        assert_eq!(found.leaves.len(), 2);
        assert_eq!(found.leaves[0].name, "birch");
        assert_eq!(found.leaves[0].transmittance, [0.01, 0.02]);
        assert_eq!(found.leaves[1].name, "leaf 3");
        assert_eq!(found.leaves[1].reflectance, [0.1, 0.2]);
        assert!(found.leaves[1].transmittance.is_empty() && found.notes.is_empty());
    }

    #[test]
    fn units_in_a_name_belong_to_no_leaf() {
        for (r, t, leaf) in [
            ("R_percent", "T_percent", ""),
            ("birch R (percent)", "birch T [pct]", "birch"),
            ("Béla_R_pct", "Béla_T", "Béla"),
        ] {
            let text = format!("nm,{r},{t}\n400,5,1\n410,6,2\n");
            let found = parsed(&text).expect("a good table");
            assert_eq!(found.leaves.len(), 1, "{r}");
            assert_eq!(found.leaves[0].name, leaf);
            assert_eq!(found.leaves[0].transmittance, [0.01, 0.02]);
        }
    }

    #[test]
    fn one_value_that_is_wrong_does_not_make_a_table_percent() {
        let lines = (0..20).map(|i| format!("{},{}\n", 400 + i, if i == 7 { 9.9 } else { 0.1 }));
        let text = "nm,R\n".to_owned() + &lines.collect::<String>();
        let error = parsed(&text).expect_err("9.9 is no share");
        assert!(error.contains("9.9 at 407 nm"), "{error}");
    }

    #[test]
    fn lines_of_several_leaves_are_told_apart_by_a_column() {
        let text = "case;um;R;T;remark\na;0.4;5;1;x\na;0.41;6;2;x\nb;0.4;10;30;x\n";
        let found = parsed(text).expect("a good table");
        assert_eq!(found.notes.len(), 2, "µm and percent: {:?}", found.notes);
        let [a, b] = &found.leaves[..] else {
            panic!("two leaves");
        };
        assert_eq!(
            (a.nm.as_slice(), a.reflectance.as_slice()),
            (&[400.0, 410.0][..], &[0.05, 0.06][..])
        );
        assert_eq!(
            (b.name.as_str(), b.transmittance.as_slice()),
            ("b", &[0.3][..])
        );
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line_or_wavelength() {
        for (text, part) in [
            ("", "wavelengths"),
            ("nm,R\n", "no lines"),
            ("a,b\n1,2\n", "wavelengths"),
            ("nm,x\n400,0.1\n", "no column"),
            ("nm,R,R\n400,0.1,0.1\n", "twice"),
            ("nm,R\n400,0.1\n410,abc\n", "line 3: R is \"abc\""),
            ("nm,R\n400,NaN\n", "NaN"),
            (
                "nm,R\n410,0.1\n400,0.1\n",
                "line 3: wavelength 400 after 410",
            ),
            ("nm,R\n400,0.1\n400,0.1\n", "twice"),
            ("nm,R\n400,-0.2\n", "-0.2 at 400 nm"),
            ("nm,R,T\n400,0.6,0.6\n", "R + T is 1.2"),
            ("nm,R,T\n400,0.6\n", "line: 2"),
        ] {
            let error = parsed(text).expect_err(text);
            assert!(
                error.contains(part) && error.starts_with("x.csv"),
                "{text:?}: {error}"
            );
        }
    }
}
