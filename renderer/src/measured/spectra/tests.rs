use std::path::Path;

use super::super::Slack;
use super::super::known::Measure;
use super::*;
use crate::measured::series;

fn shown(found: &Spectra) -> Vec<String> {
    found.notes.iter().map(ToString::to_string).collect()
}

/// Reads and checks, as a fit does; errors as messages.
fn parsed(text: &str, slack: Slack) -> Result<Spectra, String> {
    let message = |fault: &Fault| fault.shown(Path::new("x.csv"), text);
    let found = read(text, &Known::default()).map_err(|fault| message(&fault))?;
    for leaf in &found.leaves {
        leaf.check(text, slack).map_err(|fault| message(&fault))?;
    }
    Ok(found)
}

#[test]
fn columns_of_several_leaves_are_distinguished_by_their_names() {
    let text = "# a comment\nwavelength_nm,birch_R,birch_T,leaf 3 reflectance\n\
        400,0.05,0.01,0.1\n410,0.06,0.02,0.2\n";
    let found = parsed(text, Slack::NOISE).expect("a good table");
    assert_eq!(found.leaves.len(), 2);
    assert_eq!(found.leaves[0].name, "birch");
    assert_eq!(found.leaves[0].transmittance, [0.01, 0.02]);
    assert_eq!(found.leaves[0].lines, [3, 4]);
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
        let found = parsed(&text, Slack::NOISE).expect("a good table");
        assert_eq!(found.leaves.len(), 1, "{r}");
        assert_eq!(found.leaves[0].name, leaf);
        assert_eq!(found.leaves[0].transmittance, [0.01, 0.02]);
    }
}

#[test]
fn columns_in_percent_beside_fractions_are_refused_unless_their_names_say_it() {
    let mixed = "nm,R,T\n400,5,0.02\n500,10,0.08\n550,12,0.1\n800,45,0.48\n";
    let error = parsed(mixed, Slack::NOISE).expect_err("two units");
    assert!(
        error.contains("R looks like percent, up to 45, and T like fractions, up to 0.48"),
        "{error}"
    );
    let leaves = "nm,oak_R,elm_R\n400,5,0.02\n500,10,0.08\n800,45,0.48\n";
    let error = parsed(leaves, Slack::NOISE).expect_err("two units");
    assert!(
        error.contains("oak: R looks") && error.contains("elm: R like"),
        "{error}"
    );
    let known = Known {
        values: Some(ValueUnit::Percent),
        ..Known::default()
    };
    let found = read(mixed, &known).expect("a person knows").leaves;
    assert_eq!(
        (found[0].reflectance[3], found[0].transmittance[3]),
        (0.45, 0.0048)
    );
    // A name says it of its own column.
    let found = parsed(&mixed.replace(",R,", ",R [%],"), Slack::NOISE).expect("a good table");
    let leaf = &found.leaves[0];
    assert_eq!((leaf.reflectance[3], leaf.transmittance[3]), (0.45, 0.48));
    assert_eq!(
        shown(&found),
        [
            "T is taken for fractions, up to 0.48: only other columns are named percent (if not, say \
          --values percent)"
        ]
    );
    // With T as fractions R + T would be above 1, so all are percent.
    let dark = "nm,R,T\n400,5,1\n500,10,1\n800,45,1\n";
    let leaf = &parsed(dark, Slack::NOISE).expect("a good table").leaves[0];
    assert_eq!((leaf.reflectance[2], leaf.transmittance[2]), (0.45, 0.01));
    // Nothing goes through: zeros are zeros in both units.
    let opaque = "nm,R,T\n400,5,0\n500,10,0\n800,45,0\n";
    let leaf = &parsed(opaque, Slack::NOISE).expect("a good table").leaves[0];
    assert_eq!((leaf.reflectance[2], leaf.transmittance[2]), (0.45, 0.0));
}

#[test]
fn a_name_that_says_percent_over_fractions_is_noted() {
    let text = "nm,R [%]\n400,0.05\n500,0.1\n800,0.45\n";
    let found = parsed(text, Slack::NOISE).expect("a good table");
    assert_eq!(
        shown(&found),
        [
            "the column R [%] says percent, but its values are at most 0.45; they are divided by 100 \
          (if not, say --values fraction)"
        ]
    );
    assert_eq!(found.leaves[0].reflectance[2], 0.45 / 100.0);
}

#[test]
fn one_value_that_is_wrong_does_not_make_a_table_percent() {
    let lines = (0..20).map(|i| format!("{},{}\n", 400 + i, if i == 7 { 9.9 } else { 0.1 }));
    let text = "nm,R\n".to_owned() + &lines.collect::<String>();
    let error = parsed(&text, Slack::NOISE).expect_err("9.9 is no share");
    assert!(error.contains("line 9: R is 9.9 at 407 nm"), "{error}");
}

#[test]
fn lines_of_several_leaves_are_distinguished_by_a_column() {
    let text = "case;um;R;T;remark\na;0.4;5;1;x\na;0.41;6;2;x\nb;0.4;10;30;x\n";
    let found = parsed(text, Slack::NOISE).expect("a good table");
    assert_eq!(
        shown(&found),
        [
            "columns that are not read: remark",
            "values are taken for percent (if not, say --values fraction)",
        ]
    );
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
fn both_faces_of_a_leaf_have_columns_of_their_own() {
    let text = "nm,R_adaxial,R_abaxial,T\n400,0.05,0.09,0.01\n410,0.06,0.1,0.02\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    let [leaf] = &found.leaves[..] else {
        panic!("one leaf");
    };
    assert_eq!(leaf.reflectance, [0.05, 0.06]);
    assert_eq!(leaf.abaxial, [0.09, 0.1]);
    assert_eq!(leaf.transmittance, [0.01, 0.02]);
}

#[test]
fn what_is_wrong_is_named_with_its_line_or_wavelength() {
    for (text, part) in [
        ("", "is empty"),
        ("nm,R\n", "no lines"),
        ("a,b\n1,2\n", "wavelengths"),
        ("nm,x\n400,0.1\n", "no column"),
        ("nm,R,R\n400,0.1,0.1\n", "twice"),
        (
            "frequency_THz,R\n400,0.1\n",
            "the column frequency_THz holds frequencies",
        ),
        ("Wave number (1/cm),R\n4000,0.1\n", "holds wavenumbers"),
        (
            "nm,log(1/R)\n400,0.1\n",
            "the column log(1/R) holds absorbances",
        ),
        (
            "nm;R\n980;0.1\n990;0.1\n1,000;0.2\n",
            "line 4: wavelength 1 after 990: a comma within a number is read as its decimal mark",
        ),
        ("nm,R\n400,0.1\n410,abc\n", "line 3: R is \"abc\""),
        ("nm,R,T\n400,0.1,0.1\n,0.1,0.1\n", "line 3: nm is missing"),
        ("nm,R\n400,NaN\n", "no lines of numbers"),
        ("nm,R\n400,inf\n", "line 2: R is \"inf\""),
        (
            "nm,R\n400,0.1\n420,0.1\n410,0.1\n",
            "line 4: wavelength 410 after 420",
        ),
        (
            "nm,R\n430,0.1\n420,0.1\n400,0.1\n410,0.1\n",
            "line 5: wavelength 410 after 400",
        ),
        (
            "nm,R\n400,0.1\n400,0.1\n",
            "line 3: wavelength 400 is there twice",
        ),
        ("nm,R\n400,-0.2\n", "line 2: R is -0.2 at 400 nm"),
        ("nm,R,T\n400,0.6,0.6\n", "line 2: R + T is 1.2"),
        (
            "nm,R,R_abaxial,T\n400,0.1,0.7,0.4\n",
            "line 2: abaxial R + T is 1.1",
        ),
        (
            "nm,R,T\n400,0.6\n",
            "line 2: the line has 2 values, but there are 3 columns",
        ),
        // Ends of lines of two characters, empty lines and comments count.
        ("nm,R\r\n400,0.1\r\n410,x\r\n", "line 3: R is \"x\""),
        (
            "# a\nnm,R\n# b\n\n400,0.1\n\n# c\n# d\n410,x\n",
            "line 9: R is \"x\"",
        ),
        (
            "# a\r\nnm,R\r\n\r\n# b\r\n400,0.1,3\r\n",
            "line 5: the line has 3 values",
        ),
        (
            "nm,R\n\"400\",\"0.1\"\n# c\n410,0.1\n390,0.1\n",
            "line 5: wavelength 390 after 410",
        ),
    ] {
        let error = parsed(text, Slack::NOISE).expect_err(text);
        assert!(
            error.contains(part) && error.starts_with("x.csv"),
            "{text:?}: {error}"
        );
    }
}

#[test]
fn noise_that_a_fit_lets_pass_is_refused_where_light_is_to_be_scattered() {
    let text = "nm,R,T\n400,0.1,-0.01\n";
    assert!(parsed(text, Slack::NOISE).is_ok());
    let error = parsed(text, Slack::NONE).expect_err("less than nothing");
    assert!(error.contains("T is -0.01 at 400 nm"), "{error}");
}

#[test]
fn files_of_one_spectrum_each_become_a_leaf_where_all_have_values() {
    let [r, t] = ["400 0.1\n410 0.2\n420 0.3\n", "405 0.3\n415 0.5\n430 0.5\n"]
        .map(|text| series::series(text, &Known::default()).expect("a good file"));
    let leaf = of_files("oak", [Some(&r), None, Some(&t)]);
    assert_eq!(leaf.nm, [410.0, 420.0]);
    assert_eq!(leaf.reflectance, [0.2, 0.3]);
    assert!(leaf.abaxial.is_empty());
    assert_eq!(leaf.transmittance, [0.4, 0.5]);
}

#[test]
fn names_that_instruments_and_spreadsheets_write_are_read_whatever_separates_them() {
    let plain = "wl,refl,tran\n400,0.05,0.01\n410,0.25,0.125\n";
    for text in [
        plain.to_owned(),
        plain.replace(',', ";").replace('.', ","),
        plain.replace(',', "\t").replace('.', ","),
        plain.replace(',', "  "),
        format!("\u{feff}{}", plain.replace('\n', "\r\n")),
        plain.replace("wl,refl,tran", "Wavelength (nm),Reflectance,Transmission"),
        plain.replace("wl,refl,tran", "\"Wvl\",\"R\",\"T\""),
        format!("Instrument: 3, serial; 4\nmade 2024-05-01\n\n{plain}"),
        plain.replace('\n', ",,\n"),
        format!("{plain},,\n"),
        "wl,refl,tran\n410,0.25,0.125\n400,0.05,0.01\n".to_owned(),
    ] {
        let found = parsed(&text, Slack::NONE).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        let [leaf] = &found.leaves[..] else {
            panic!("one leaf: {text:?}");
        };
        assert_eq!(leaf.nm, [400.0, 410.0], "{text:?}");
        assert_eq!(leaf.reflectance, [0.05, 0.25], "{text:?}");
        assert_eq!(leaf.transmittance, [0.01, 0.125], "{text:?}");
    }
}

#[test]
fn every_column_that_is_not_read_is_named() {
    let text = "nm,R,T_abaxial,remark,\u{1b}[31m\n400,0.1,0.2,x,y\n410,0.1,0.2,x,y\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    let note = "columns that are not read: T_abaxial, remark, \\u{1b}[31m";
    assert_eq!(shown(&found), [note]);
}

#[test]
fn masked_bands_are_left_out_and_named_and_zeros_are_a_guess() {
    let text =
        "nm,a_R,a_T,b_R\n400,0.1,0.1,\n410,NaN,0.1,\n420,0.1,-9999,\n430,0.1,0.1,\n440,0.1,n/a,\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    let [leaf] = &found.leaves[..] else {
        panic!("the other has no values");
    };
    assert_eq!(leaf.nm, [400.0, 430.0]);
    assert_eq!(leaf.lines, [2, 5]);
    let notes = shown(&found);
    assert!(
        notes[0].starts_with("a: 3 of 5 wavelengths have no value"),
        "{notes:?}"
    );
    assert!(
        notes[0].ends_with("left out: 410 to 420 nm, 440 nm"),
        "{notes:?}"
    );
    assert_eq!(notes[1], "b: no band has a reflectance");
    let text = "nm,R\n400,0.1\n410,0\n420,0\n430,0.0\n440,0.1\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    assert_eq!(found.leaves[0].nm.len(), 5);
    let notes = shown(&found);
    assert!(
        notes[0].contains("410 to 430 nm (if not, say --masked 0)"),
        "{notes:?}"
    );
    let known = Known {
        masked: Some(0.0),
        ..Known::default()
    };
    let found = read(text, &known).expect("a good table");
    assert_eq!(found.leaves[0].nm, [400.0, 440.0]);
}

#[test]
fn a_table_may_have_a_leaf_in_each_row() {
    let text = "species,sample_id,Measurement,X700,X600,X500\n\
        oak,o1,Reflectance,30,20,10\noak,o1,Transmittance,3,2,1\noak,o2,reflectance,31,21,11\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    let [one, two] = &found.leaves[..] else {
        panic!("two leaves: {:?}", found.leaves);
    };
    assert_eq!((one.name.as_str(), two.name.as_str()), ("o1", "o2"));
    assert_eq!(one.nm, [500.0, 600.0, 700.0]);
    assert_eq!(one.reflectance, [0.1, 0.2, 0.3]);
    assert_eq!(one.transmittance, [0.01, 0.02, 0.03]);
    assert_eq!(two.reflectance, [0.11, 0.21, 0.31]);
    assert!(two.transmittance.is_empty());
    let notes = shown(&found);
    assert_eq!(notes.len(), 2, "{notes:?}");
    assert_eq!(notes[0], "columns that are not read: species");
    // Without a column that says so, values are reflectances, and rows of one name are leaves each.
    let text = "name;0,45;0,55;0,65\nx;0,1;0,2;0,3\nx;0,2;0,3;0,4\n";
    let text = text.replacen("0,45;0,55;0,65", "0.45;0.55;0.65", 1);
    let found = parsed(&text, Slack::NONE).expect("a good table");
    let names: Vec<&str> = found.leaves.iter().map(|leaf| leaf.name.as_str()).collect();
    assert_eq!(names, ["x", "x, line 3"]);
    assert_eq!(found.leaves[0].nm, [450.0, 550.0, 650.0]);
    assert!(
        shown(&found)[1].contains("--quantity transmittance"),
        "{:?}",
        shown(&found)
    );
    let known = Known {
        quantity: Some(Measure::Transmittance),
        ..Known::default()
    };
    let found = read(&text, &known).expect("a good table");
    assert_eq!(found.leaves[1].transmittance, [0.2, 0.3, 0.4]);
    let wrong = text.replace("name", "quantity").replace("x;", "height;");
    let error = parsed(&wrong, Slack::NONE).expect_err("no height");
    assert!(error.contains("line 2: quantity is \"height\""), "{error}");
}

#[test]
fn numbers_of_samples_are_no_wavelengths_beside_a_column_of_those() {
    let text = "Wavelength (nm),1001,1002,1003\n400,0.1,0.2,0.3\n410,0.1,0.2,0.3\n";
    let known = Known {
        quantity: Some(Measure::Reflectance),
        ..Known::default()
    };
    let found = read(text, &known).expect("a good table");
    assert_eq!(found.leaves.len(), 3);
    assert_eq!(found.leaves[2].name, "1003");
    assert_eq!(found.leaves[2].nm, [400.0, 410.0]);
}

#[test]
fn columns_of_leaves_are_what_a_person_says() {
    let text = "Wavelength\toak.asd\telm.asd\n400\t0.1\t0.2\n410\t0.2\t0.3\n";
    let error = parsed(text, Slack::NONE).expect_err("nothing says R or T");
    assert!(error.contains("--quantity reflectance"), "{error}");
    let known = Known {
        quantity: Some(Measure::Reflectance),
        ..Known::default()
    };
    let found = read(text, &known).expect("a good table");
    assert_eq!(found.leaves[1].name, "elm.asd");
    assert_eq!(found.leaves[1].reflectance, [0.2, 0.3]);
}

#[test]
fn a_name_that_says_percent_counts_more_than_small_values() {
    let text = "nm,R (%)\n400,0.5\n410,0.75\n";
    let found = parsed(text, Slack::NONE).expect("a good table");
    assert_eq!(found.leaves[0].reflectance, [0.005, 0.0075]);
    assert_eq!(found.notes.len(), 1, "{:?}", found.notes);
}

#[test]
fn values_in_messages_are_escaped_and_cut() {
    let long = "9".repeat(5000);
    for cell in ["\u{1b}[2J\u{7}", long.as_str(), "\u{202e}x"] {
        let error = parsed(&format!("nm,R\n400,{cell}x\n"), Slack::NOISE).expect_err(cell);
        assert!(
            !error.contains(|c: char| c.is_control() || c == '\u{202e}'),
            "{error:?}"
        );
        assert!(error.chars().count() < 200, "{error}");
        let error = parsed(&format!("nm,R{cell}\n400,1\n"), Slack::NOISE).expect_err(cell);
        assert!(
            !error.contains(|c: char| c.is_control() || c == '\u{202e}'),
            "{error:?}"
        );
        assert!(error.chars().count() < 400, "{error}");
    }
}
