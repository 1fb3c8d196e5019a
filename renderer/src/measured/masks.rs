//! Bands that were masked: wavelengths without a value.

use leafmodel::document::rows::{Field, Guess, Rows};

use super::units::note;

/// Words for no value, in lower case.
const WORDS: [&str; 10] = [
    "", "na", "n/a", "#n/a", "nan", "-nan", "null", "none", "-", "--",
];
/// Numbers for no value, none of which was measured of a leaf.
const NUMBERS: [f64; 3] = [-9999.0, -999.0, -99.0];
/// Below this a number is one for no value, as the -1.23e34 of the USGS.
const LEAST: f64 = -1e30;
/// Ranges that a message names.
const MOST: usize = 5;

/// Whether a field has no value; the number that says so may be known.
pub(super) fn is_masked(rows: &Rows<'_>, field: &Field, known: Option<f64>) -> bool {
    let lower = field.text.to_ascii_lowercase();
    if WORDS.contains(&lower.as_str()) {
        return true;
    }
    let Some(number) = rows.number(field) else {
        return false;
    };
    known.map_or_else(
        || number < LEAST || NUMBERS.contains(&number),
        |known| number == known,
    )
}

/// What is said about wavelengths that are masked; nothing if none is. `name` stands before it.
pub(super) fn left_out(name: &str, nm: &[f64], masked: &[bool]) -> Option<Guess> {
    let ranges = masked_ranges(nm, masked);
    let count = masked.iter().filter(|masked| **masked).count();
    (count > 0).then(|| {
        note(format!(
            "{name}{count} of {} wavelengths have no value (empty, NA, NaN, -9999 or such) and are \
             left out: {ranges}",
            nm.len()
        ))
    })
}

/// The ranges of wavelengths that are marked, in words; empty if none is.
pub(super) fn masked_ranges(nm: &[f64], marked: &[bool]) -> String {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut is_open = false;
    for (&nm, &is_marked) in nm.iter().zip(marked) {
        match ranges.last_mut().filter(|_| is_open) {
            Some(range) if is_marked => range[1] = nm,
            None if is_marked => ranges.push([nm, nm]),
            Some(_) | None => {}
        }
        is_open = is_marked;
    }
    let shown = ranges.iter().take(MOST).map(|[from, to]| {
        if from == to {
            format!("{from} nm")
        } else {
            format!("{from} to {to} nm")
        }
    });
    let mut shown: Vec<String> = shown.collect();
    if ranges.len() > MOST {
        shown.push(format!("{} more ranges", ranges.len() - MOST));
    }
    shown.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_numbers_for_no_value_are_known_and_a_person_may_name_another() {
        let masked = |text: &str, known: Option<f64>| {
            let table = format!("nm;R\n400;{text}\n");
            let rows = Rows::of(&table);
            let row = rows.records().flatten().nth(1).expect("two rows");
            is_masked(&rows, &row.fields[1], known)
        };
        for text in ["", "NA", "NaN", "-", "-9999", "-9999,0", "-1.23e34"] {
            assert!(masked(text, None), "{text}");
        }
        for text in ["0", "0,5", "-0.01", "x", "inf"] {
            assert!(!masked(text, None), "{text}");
        }
        assert!(masked("0.0", Some(0.0)) && masked("", Some(0.0)));
        assert!(!masked("-9999", Some(0.0)));
    }

    #[test]
    fn ranges_of_marked_wavelengths_are_named_up_to_five() {
        let nm = [1.0, 2.0, 3.0, 4.0, 5.0];
        let marked = [true, true, false, true, false];
        assert_eq!(masked_ranges(&nm, &marked), "1 to 2 nm, 4 nm");
        assert_eq!(masked_ranges(&nm, &[false; 5]), "");
        let many: Vec<f64> = (0..20).map(f64::from).collect();
        let every: Vec<bool> = (0..20).map(|i| i % 2 == 0).collect();
        let shown = masked_ranges(&many, &every);
        assert!(shown.ends_with("8 nm, 5 more ranges"), "{shown}");
    }
}
