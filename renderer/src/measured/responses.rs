//! Responses by wavelength in nm: sensitivities of a camera to red, green and blue, or bands of a sensor.
//!
//! One column of wavelengths and one for each channel or band, separated by commas, semicolons, tabs or
//! spaces; a line of names may stand first, `#` begins a comment.

use leafmodel::document::rows::{Field, Rows};

use super::Fault;
use super::series::{number, refuse_other_axis};
use super::units::{WIDE_GAP, are_micrometres, gaps};
use crate::spectrum::sensor::NamedRows;

/// A table of responses.
#[derive(Debug, Default)]
struct Responses {
    /// The fields of the line of names, if there is one.
    names: Vec<Field>,
    /// Wavelengths, nm, and the values of all columns.
    rows: Vec<(f64, Vec<f64>)>,
}

/// Reads a table of sensitivities: rows of wavelength, nm, and the sensitivities of red, green and blue.
///
/// # Errors
///
/// The first [`Fault`].
pub fn sensitivities(text: &str) -> Result<Vec<(f64, [f64; 3])>, Fault> {
    const COLUMNS: &str = "keep four columns: wavelength in nm, red, green, blue";
    let table = read(text, Some(3), 3, ["sensitivity", COLUMNS])?;
    let rows = table.rows.into_iter();
    Ok(rows
        .map(|(nm, values)| (nm, std::array::from_fn(|channel| values[channel])))
        .collect())
}

/// Reads a table of at most so many bands: the name of each, and its rows of wavelength, nm, and response.
/// Bands without names are B1, B2 and so on.
///
/// # Errors
///
/// The first [`Fault`].
pub fn responses(text: &str, most: usize) -> Result<Vec<NamedRows>, Fault> {
    const COLUMNS: &str = "keep a column of wavelengths in nm and one of responses for each band";
    let Responses { names, rows } = read(text, None, most, ["response", COLUMNS])?;
    let bands = 0..rows[0].1.len();
    let of = |band: usize| {
        let name = names.get(band + 1).map(Field::shown);
        let rows = rows.iter().map(|(nm, values)| (*nm, values[band]));
        (
            name.unwrap_or_else(|| format!("B{}", band + 1)),
            rows.collect(),
        )
    };
    Ok(bands.map(of).collect())
}

/// Reads rows of so many values, or of as many as the first has, at most `most`. `words` is what a value
/// is, and which columns should be there.
fn read(
    text: &str,
    mut count: Option<usize>,
    most: usize,
    [value_is, columns]: [&'static str; 2],
) -> Result<Responses, Fault> {
    let mut found = Responses::default();
    let mut spans = Vec::new();
    let mut names_allowed = true;
    let table = Rows::of(text).of_numbers();
    for mut row in table.of_any_length() {
        row.cut(most + 1);
        let fields = &row.fields;
        let is_name = |first: &Field| table.number(first).is_none();
        if std::mem::take(&mut names_allowed) && fields.first().is_some_and(is_name) {
            refuse_other_axis(&fields[0])?;
            if count == Some(3) {
                require_order(fields)?;
            }
            found.names.clone_from(fields);
            continue;
        }
        let wanted = *count.get_or_insert(fields.len().saturating_sub(1)) + 1;
        if fields.len() != wanted || wanted < 2 {
            let problem = format!(
                "has {} columns in this line, wanted are {}",
                fields.len(),
                wanted.max(2)
            );
            return Err(Fault::at(row.span(), problem, columns));
        }
        let (nm, values) = (&fields[0], &fields[1..]);
        let wavelength = number(&table, nm)?;
        let mut row = Vec::with_capacity(values.len());
        for field in values {
            let value = number(&table, field)?;
            if value < 0.0 {
                let problem = format!("has the {value_is} {value} at {wavelength} nm");
                let help = "it is 0 or more: where noise made it negative write 0";
                return Err(Fault::at(field.span.clone(), problem, help));
            }
            row.push(value);
        }
        if let Some((before, _)) = found.rows.last()
            && *before >= wavelength
        {
            let problem = format!("has wavelength {wavelength} behind {before}");
            return Err(Fault::at(nm.span.clone(), problem, "sort the lines"));
        }
        found.rows.push((wavelength, row));
        spans.push(nm.span.clone());
    }
    let rows = &found.rows;
    if rows.len() < 2 {
        let problem = format!("has {} lines of numbers, wanted are 2 at least", rows.len());
        return Err(Fault::of_file(problem, columns));
    }
    let wavelengths: Vec<f64> = rows.iter().map(|row| row.0).collect();
    if are_micrometres(wavelengths.iter().copied()) {
        let help = "multiply them by 1000 to have nanometres";
        let problem = "has wavelengths that look like micrometres";
        return Err(Fault::at(spans[0].clone(), problem, help));
    }
    // Where nothing is seen on either side, nothing is missing between.
    let is_seen = |row: &(f64, Vec<f64>)| row.1.iter().any(|value| *value > 0.0);
    let mut wide = gaps(&wavelengths, WIDE_GAP);
    if let Some(behind) = wide.find(|&behind| is_seen(&rows[behind - 1]) || is_seen(&rows[behind]))
    {
        let [from, to] = [wavelengths[behind - 1], wavelengths[behind]];
        let problem = format!("has a gap: nothing between {from} and {to} nm");
        let help = "measure or interpolate the values there and add their lines";
        return Err(Fault::at(spans[behind].clone(), problem, help));
    }
    Ok(found)
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
            assert_eq!(sensitivities(text), Ok(expected.clone()), "{text}");
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
            let fault = sensitivities(text).expect_err(text);
            let span = fault.span.clone().expect("it has a place");
            assert_eq!(&text[span], place);
            let shown = fault.shown(std::path::Path::new("c.csv"), text);
            assert!(shown.contains(said), "{shown}");
        }
        assert!(sensitivities("nm,r,g,b\n").is_err() && sensitivities("").is_err());
        assert!(sensitivities("400,0,inf,1\n410,0,1,1\n").is_err());
    }

    #[test]
    fn bands_of_a_sensor_are_columns_with_or_without_names() {
        let named = responses("nm;red;nir\n600;0;0\n650;1;0\n800;0;0,5\n", 8);
        let named = named.expect("it is a table");
        assert_eq!(named[1].0, "nir");
        assert_eq!(named[1].1, [(600.0, 0.0), (650.0, 0.0), (800.0, 0.5)]);
        let unnamed = responses("600 0 1\n650 1 0\n", 8).expect("it is a table");
        assert_eq!((&*unnamed[0].0, &*unnamed[1].0), ("B1", "B2"));
        for (text, said) in [
            ("600\n650\n", "1 columns"),
            ("600 1\n650 1 2\n", "3 columns"),
            ("600 1\n650 -1\n", "the response -1"),
            ("600 1\n", "1 lines"),
        ] {
            let fault = responses(text, 8).expect_err(text);
            let shown = fault.shown(std::path::Path::new("s.csv"), text);
            assert!(shown.contains(said), "{shown}");
        }
    }
}
