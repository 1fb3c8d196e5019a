use std::path::Path;

use clap::Parser;
use leafmodel::optics::{Contents, ProspectD};
use proptest::prelude::*;

use super::*;
use crate::cli::arguments::{Arguments, Command};

/// What a command line with these words chooses for what a table lacks.
fn chosen(words: &[&str]) -> Chosen {
    let line = ["lamina", "optics", "--out", "x.csv"].iter().chain(words);
    let Some(Command::Optics(arguments)) = Arguments::parse_from(line).command else {
        panic!("it is this command");
    };
    leaf::choose(&arguments).expect("the words are good")
}

fn read_with(words: &[&str], text: &str) -> Result<Leaves, String> {
    read(&chosen(words), Form::default(), Path::new("t.csv"), text)
        .map_err(|errors| errors.to_string())
}

fn refused(words: &[&str], text: &str) -> String {
    read_with(words, text).err().expect("it is refused")
}

#[test]
fn contents_go_by_options_by_names_by_keys_and_by_letters() {
    let text = "id,N,chlorophyll,water_cm,CM\na,2,30,0.02,0.004\n";
    let leaves = read_with(&["--car", "5"], text).expect("a good table");
    let leaf = leaves.contents[0];
    let wanted = [
        (Constituent::Structure, 2.0),
        (Constituent::Chlorophyll, 30.0),
        (Constituent::Carotenoids, 5.0),
        (Constituent::Water, 0.02),
        (Constituent::DryMatter, 0.004),
    ];
    assert_eq!(leaf, Contents::of(&wanted));
    assert_eq!(
        (leaves.column.as_str(), leaves.names[0].as_str()),
        ("id", "a")
    );
}

#[test]
fn rows_without_names_are_numbered_and_decimals_may_have_commas() {
    let leaves = read_with(&[], "cab;cw\n30,5;0,01\n20;0,02\n").expect("a good table");
    assert_eq!(leaves.names, ["1", "2"]);
    assert_eq!(leaves.contents[0][Constituent::Chlorophyll], 30.5);
}

#[test]
fn columns_of_fits_that_are_no_contents_are_passed_over() {
    let text = "leaf,chlorophyll_ug_per_cm2,chlorophyll_ug_per_cm2_standard_error,face_contrast,\
                face_contrast_standard_error,rms,values\nx,30,,0.3,,0.001,2101\n";
    let leaves = read_with(&[], text).expect("a good table");
    assert_eq!(leaves.contents[0][Constituent::Chlorophyll], 30.0);
}

#[test]
fn all_that_is_wrong_is_reported_at_once_with_line_column_and_range() {
    let report = refused(
        &["--cab", "30"],
        "leaf,cab,watr,cm,dry_matter,n\na,1,1,,0.1,0.5\na,1,1,nan,x,2\nb,1,1,90,0.1,2\n",
    );
    for told in [
        "`cab` and `--cab` exclude each other",
        "no key `watr`",
        "did you mean `water`",
        "`dry_matter` and `cm` exclude each other",
        "`cm`: has an empty value",
        "`n` is 0.5, outside 1 to 10",
        "t.csv:2:7",
        "`leaf`: there is another leaf `a`",
        "`cm` is nan",
        "`dry_matter`: `x` is not a number",
        "`cm` is 90, outside 0 to 1 g/cm²",
        "t.csv:4:7",
    ] {
        assert!(report.contains(told), "{told}:\n{report}");
    }
    assert!(refused(&[], "cab\n").contains("has no leaves"));
    assert!(refused(&[], "").contains("has no leaves"));
}

proptest! {
    #[test]
    fn arrays_and_tables_hold_the_same_whatever_their_number(count in 1_usize..150, nm in 400.0..2500.0) {
        let rows: String = (0..count).map(|row| format!("{}\n", row as f64 / 3.0)).collect();
        let leaves = read_with(&[], &format!("cab\n{rows}")).expect("a good table");
        let at = [ProspectD::coefficients_extrapolated(nm)];
        let (mut array, mut table) = (Vec::new(), Vec::new());
        spectra::npy(&leaves, &at, &mut array).expect("memory takes all");
        spectra::csv(&leaves, &[nm], &at, &mut table).expect("memory takes all");
        let shape = format!("'shape': ({count}, 2, 1), }}");
        prop_assert!(String::from_utf8_lossy(&array[10..128]).contains(&shape));
        let numbers = array[128..].as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
        let text = String::from_utf8(table).expect("it is text");
        let written: Vec<&str> = text.lines().skip(1).flat_map(|line| line.split(',').skip(2)).collect();
        prop_assert_eq!(numbers.map(|number| format!("{number}")).collect::<Vec<_>>(), written);
    }
}
