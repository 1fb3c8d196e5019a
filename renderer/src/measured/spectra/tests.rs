use std::path::Path;

use super::*;
use crate::measured::series;

/// Reads and checks, as a fit does; errors as messages.
fn parsed(text: &str, slack: Slack) -> Result<Spectra, String> {
    let shown = |fault: &Fault| fault.shown(Path::new("x.csv"), text);
    let found = read(text).map_err(|fault| shown(&fault))?;
    for leaf in &found.leaves {
        leaf.check(text, slack).map_err(|fault| shown(&fault))?;
    }
    Ok(found)
}

#[test]
fn columns_of_several_leaves_are_told_apart_by_their_names() {
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
fn one_value_that_is_wrong_does_not_make_a_table_percent() {
    let lines = (0..20).map(|i| format!("{},{}\n", 400 + i, if i == 7 { 9.9 } else { 0.1 }));
    let text = "nm,R\n".to_owned() + &lines.collect::<String>();
    let error = parsed(&text, Slack::NOISE).expect_err("9.9 is no share");
    assert!(error.contains("line 9: R is 9.9 at 407 nm"), "{error}");
}

#[test]
fn lines_of_several_leaves_are_told_apart_by_a_column() {
    let text = "case;um;R;T;remark\na;0.4;5;1;x\na;0.41;6;2;x\nb;0.4;10;30;x\n";
    let found = parsed(text, Slack::NOISE).expect("a good table");
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
        ("", "wavelengths"),
        ("nm,R\n", "no lines"),
        ("a,b\n1,2\n", "wavelengths"),
        ("nm,x\n400,0.1\n", "no column"),
        ("nm,R,R\n400,0.1,0.1\n", "twice"),
        ("nm,R\n400,0.1\n410,abc\n", "line 3: R is \"abc\""),
        ("nm,R,T\n400,0.1,0.1\n410,,0.1\n", "line 3: R is missing"),
        ("nm,R\n400,NaN\n", "NaN"),
        (
            "nm,R\n410,0.1\n400,0.1\n",
            "line 3: wavelength 400 after 410",
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
            "nm,R\n\"400\",\"0.1\"\n# c\n390,0.1\n",
            "line 4: wavelength 390 after 400",
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
        .map(|text| series::series(text).expect("a good file"));
    let leaf = of_files("oak", [Some(&r), None, Some(&t)]);
    assert_eq!(leaf.nm, [410.0, 420.0]);
    assert_eq!(leaf.reflectance, [0.2, 0.3]);
    assert!(leaf.abaxial.is_empty());
    assert_eq!(leaf.transmittance, [0.4, 0.5]);
}
