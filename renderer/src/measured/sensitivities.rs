//! Spectral sensitivities of a camera: wavelength in nm, then red, green and blue.
//!
//! Four columns, separated by commas, semicolons, tabs or spaces; a line of names may stand first,
//! `#` begins a comment.

use leafmodel::document::rows::{Field, Rows};

use super::Fault;
use super::series::{number, refuse_other_axis};
use super::units::{WIDE_GAP, are_micrometres, gaps};

/// Reads a table: rows of wavelength, nm, and the sensitivities of red, green and blue.
///
/// # Errors
///
/// The first [`Fault`].
pub fn read(text: &str) -> Result<Vec<(f64, [f64; 3])>, Fault> {
    const COLUMNS: &str = "keep four columns: wavelength in nm, red, green, blue";
    let mut rows: Vec<(f64, [f64; 3])> = Vec::new();
    let mut spans = Vec::new();
    let mut names_allowed = true;
    let table = Rows::of(text).of_numbers();
    for mut row in table.of_any_length() {
        row.cut(4);
        let found = &row.fields;
        let is_name = |first: &Field| table.number(first).is_none();
        if std::mem::take(&mut names_allowed) && found.first().is_some_and(is_name) {
            refuse_other_axis(&found[0])?;
            require_order(found)?;
            continue;
        }
        let [nm, red, green, blue] = found.as_slice() else {
            let count = found.len();
            let problem = format!("has {count} columns in this line, wanted are 4");
            return Err(Fault::at(row.span(), problem, COLUMNS));
        };
        let wavelength = number(&table, nm)?;
        let mut row = [0.0; 3];
        for (value, field) in row.iter_mut().zip([red, green, blue]) {
            *value = number(&table, field)?;
            if *value < 0.0 {
                let problem = format!("has the sensitivity {value} at {wavelength} nm");
                let help = "a sensitivity is 0 or more: where noise made it negative write 0";
                return Err(Fault::at(field.span.clone(), problem, help));
            }
        }
        if let Some((before, _)) = rows.last()
            && *before >= wavelength
        {
            let problem = format!("has wavelength {wavelength} behind {before}");
            return Err(Fault::at(nm.span.clone(), problem, "sort the lines"));
        }
        rows.push((wavelength, row));
        spans.push(nm.span.clone());
    }
    if rows.len() < 2 {
        let problem = format!("has {} lines of numbers, wanted are 2 at least", rows.len());
        return Err(Fault::of_file(problem, COLUMNS));
    }
    let wavelengths: Vec<f64> = rows.iter().map(|row| row.0).collect();
    if are_micrometres(wavelengths.iter().copied()) {
        let help = "multiply them by 1000 to have nanometres";
        return Err(Fault::at(
            spans[0].clone(),
            "has wavelengths that look like micrometres",
            help,
        ));
    }
    if let Some(behind) = gaps(&wavelengths, WIDE_GAP).next() {
        let [from, to] = [wavelengths[behind - 1], wavelengths[behind]];
        let problem = format!("has a gap: nothing between {from} and {to} nm");
        let help = "measure or interpolate the values there and add their lines";
        return Err(Fault::at(spans[behind].clone(), problem, help));
    }
    Ok(rows)
}

/// Refuses names that say another order of columns than wavelength, red, green, blue.
fn require_order(names: &[Field]) -> Result<(), Fault> {
    for (place, wanted) in ["r", "g", "b"].into_iter().enumerate() {
        let Some(name) = names.get(place + 1) else {
            continue;
        };
        let initial = name
            .text
            .chars()
            .next()
            .map(|letter| letter.to_ascii_lowercase());
        let is_other = initial.is_some_and(|letter| "rgb".contains(letter))
            && initial != wanted.chars().next();
        if is_other {
            let problem = format!("has `{}` where `{wanted}` is wanted", name.shown());
            let help = "put the columns in the order wavelength, red, green, blue";
            return Err(Fault::at(name.span.clone(), problem, help));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_with_and_without_names_and_with_any_separator() {
        let expected = vec![(400.0, [0.0, 0.5, 1.0]), (410.0, [0.1, 0.6, 0.9])];
        for text in [
            "400,0,0.5,1\n410,0.1,0.6,0.9\n",
            "# by me\nwavelength_nm,r,g,b\n400,0,0.5,1 # first\n410,0.1,0.6,0.9",
            "nm;Red;Green;Blue\r\n400;0;0.5;1\r\n\r\n410;0.1;0.6;0.9\r\n",
            "400\t0 0.5 1\n410\t0.1 0.6 0.9\n",
        ] {
            assert_eq!(read(text), Ok(expected.clone()), "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_reported_at_its_place() {
        for (text, place, said) in [
            ("400,0,1,1\n410,0,1\n", "410,0,1", "3 columns"),
            ("400,0,1,1\n400,0,1,1\n", "400", "behind 400"),
            ("400,0,1,1\n410,0,-0.1,1\n", "-0.1", "0 or more"),
            ("400,0,1,1\n410,0,x,1\n", "x", "a number is wanted"),
            ("0.4,0,1,1\n0.5,0,1,1\n", "0.4", "micrometres"),
            ("nm,b,g,r\n400,0,1,1\n410,0,1,1\n", "b", "the order"),
            (
                "THz,r,g,b\n400,0,1,1\n410,0,1,1\n",
                "THz",
                "has frequencies",
            ),
            (
                "400,0,1,1\n405,0,1,1\n410,0,1,1\n600,0,1,1\n605,0,1,1\n",
                "600",
                "a gap",
            ),
        ] {
            let fault = read(text).expect_err(text);
            let span = fault.span.clone().expect("it has a place");
            assert_eq!(&text[span], place);
            let shown = fault.shown(std::path::Path::new("c.csv"), text);
            assert!(shown.contains(said), "{shown}");
        }
        assert!(read("nm,r,g,b\n").is_err() && read("").is_err());
        assert!(read("400,0,inf,1\n410,0,1,1\n").is_err());
    }
}
