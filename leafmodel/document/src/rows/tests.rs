use proptest::prelude::*;

use super::*;

fn fields(rows: &Rows<'_>) -> Vec<Vec<String>> {
    let rows = rows.records().map(|row| row.expect("as many as names"));
    let texts = rows.map(|row| row.fields.into_iter().map(|field| field.text).collect());
    texts.collect()
}

#[test]
fn a_field_lies_where_it_is_written_below_comments_that_hold_it_too() {
    let text = "\u{feff}a;b;c\n\n# 7 and 8\n 7;;\"8\"\r\n  # 9\n9;9;9";
    for text in [
        text.to_owned(),
        text.replace(';', "\t"),
        text.replace(';', ","),
    ] {
        let rows: Vec<Row> = Rows::of(&text).records().flatten().collect();
        assert_eq!(
            [rows[0].line, rows[1].line, rows[2].line],
            [1, 4, 6],
            "{text:?}"
        );
        for (row, line) in rows.iter().zip(["a;b;c", "7;;\"8\"", "9;9;9"]) {
            let line = text
                .find(&line.replace(';', &text[4..5]))
                .expect("it is there");
            let mut offset = 0;
            for field in &row.fields {
                assert_eq!(&text[field.span.clone()], field.text, "{text:?}");
                assert!(field.span.start >= line + offset, "{text:?}: {row:?}");
                assert!(field.span.start <= line + offset + 1, "{text:?}: {row:?}");
                offset += field.text.len() + 1;
            }
        }
    }
}

#[test]
fn a_row_with_other_than_the_wanted_fields_is_reported_and_others_follow() {
    let rows: Vec<_> = Rows::of("a,b\n# x\n1,2\n3\n5,6,\n7,8,9\n")
        .records()
        .collect();
    let lines: Vec<Result<usize, usize>> = rows
        .iter()
        .map(|row| row.as_ref().map(|row| row.line).map_err(|bad| bad.line))
        .collect();
    assert_eq!(lines, [Ok(1), Ok(3), Err(4), Ok(5), Err(6)]);
    let shown = rows[2].as_ref().expect_err("one value").to_string();
    assert_eq!(shown, "the line has 1 values, but there are 2 columns");
}

#[test]
fn every_separator_is_found_with_decimal_points_and_commas_and_every_end_of_line() {
    let wanted = [["nm", "R"], ["400.5", "0.25"], ["410", "0.5"]];
    for separator in [",", ", ", ";", " ; ", "\t", " ", "   "] {
        for end in ["\n", "\r\n", "\r"] {
            let lines = wanted.map(|row| row.join(separator) + end);
            let text = lines.concat();
            let rows = Rows::of(&text);
            assert_eq!(fields(&rows), wanted, "{text:?}");
            assert_eq!(rows.guesses(), []);
            if separator.trim() == "," {
                continue;
            }
            let text = text.replace('.', ",");
            let rows = Rows::of(&text);
            let second: Vec<f64> = rows
                .records()
                .flatten()
                .filter_map(|row| rows.number(&row.fields[1]))
                .collect();
            assert_eq!(second, [0.25, 0.5], "{text:?}");
            assert_eq!(rows.guesses().len(), 1, "{text:?}");
        }
    }
}

#[test]
fn blanks_separate_numbers_that_another_separator_would_leave_together() {
    let wanted = [["400", "0", "0.5"], ["410", "0.1", "0.6"]];
    for text in ["400\t0 0.5\n410\t0.1 0.6\n", "400 0\t0.5\n410 0.1\t0.6\n"] {
        assert_eq!(fields(&Rows::of(text)), wanted, "{text:?}");
    }
    let text = "400,0  0,5  1,5\n410,0  0,6  1,0\n";
    assert_eq!(fields(&Rows::of(text))[0], ["400,0", "0,5", "1,5"]);
}

#[test]
fn numbers_in_quotes_may_have_decimal_commas_between_commas() {
    let rows = Rows::of("nm,R\n\"400,5\",\"0,25\"\n");
    let row = rows.records().flatten().nth(1).expect("two rows");
    assert_eq!(rows.number(&row.fields[0]), Some(400.5));
}

#[test]
fn commas_that_are_no_decimal_marks_make_no_number() {
    for text in [
        "1,234,5", "1.234,5", ",", "1,", ",x", "1,e5", "", "a,5", "1,-5",
    ] {
        assert_eq!(number(text), None, "{text}");
    }
    for (text, value) in [(",5", 0.5), ("-1,5", -1.5), ("1,5e-2", 0.015), ("2", 2.0)] {
        assert_eq!(number(text), Some(value), "{text}");
    }
    let form = Form {
        decimal: Some(Decimal::Point),
        ..Form::default()
    };
    let rows = Rows::written("a;b\n1,5;2\n", form);
    let row = rows.records().flatten().nth(1).expect("two rows");
    assert_eq!(rows.number(&row.fields[0]), None);
    assert_eq!(rows.guesses(), []);
}

#[test]
fn a_known_separator_counts_more_than_the_looks_of_the_text() {
    let text = "400,1;0,5\n410,1;0,6\n";
    assert_eq!(fields(&Rows::of(text))[0], ["400,1", "0,5"]);
    let form = Form {
        separator: Some(Separator::Comma),
        ..Form::default()
    };
    let rows = Rows::written(text, form);
    assert_eq!(fields(&rows)[0], ["400", "1;0", "5"]);
}

#[test]
fn what_may_separate_as_well_is_a_guess_and_the_usual_table_has_none() {
    let said = |text: &str| {
        let rows = Rows::of(text);
        let all: Vec<Row> = rows.of_any_length().collect();
        let fields = all.iter().flat_map(|row| &row.fields);
        for field in fields {
            let _ = rows.number(field);
        }
        let guesses = rows.guesses().into_iter();
        guesses.map(|guess| guess.to_string()).collect::<Vec<_>>()
    };
    let usual = [
        "a,b\n1.5,x y\n",
        "a, b\n1, 2\n",
        "a;b\n1,x;2\n",
        "a b\n1 2\n",
        "",
    ];
    for text in usual {
        assert_eq!(said(text), [""; 0], "{text}");
    }
    let semicolon = "each semicolon separates fields (if not, say --separator comma)";
    assert_eq!(said("oak, red;R\nelm, white;T\n"), [semicolon]);
    let comma = "commas in numbers are decimal marks (if not, say --decimal point)";
    assert_eq!(said("1,5;2,5\n3,5;4,5\n"), [comma]);
    // Lines of unlike lengths: the first one decides.
    let tab = "each tab separates fields (if not, say --separator semicolon)";
    assert_eq!(said("a\tb\tc;d\n1\t2\n"), [tab]);
}

#[test]
fn rows_of_numbers_may_end_in_comments_and_have_separators_of_their_own() {
    let text = "nm,R\n400,0.1\n500; 0.2 # peak, high\n\n600\t0.3\n700 4e-1# x";
    let rows = Rows::of(text).of_numbers();
    let wanted = [
        ["nm", "R"],
        ["400", "0.1"],
        ["500", "0.2"],
        ["600", "0.3"],
        ["700", "4e-1"],
    ];
    assert_eq!(fields(&rows), wanted);
    for row in rows.records().flatten() {
        for field in row.fields {
            assert_eq!(text[field.span], field.text);
        }
    }
}

proptest! {
    #[test]
    fn whatever_is_written_its_fields_lie_within_the_text(text in "[,;\t \"#\r\n1.é\u{feff}-]{0,40}") {
        for rows in [Rows::of(&text), Rows::of(&text).of_numbers()] {
            let mut line = 0;
            for row in rows.of_any_length() {
                prop_assert!(row.line >= line && row.line <= text.len() + 1);
                line = row.line;
                for field in row.fields {
                    prop_assert!(text.get(field.span.clone()).is_some(), "{field:?}");
                }
            }
            for ragged in rows.records().filter_map(Result::err) {
                prop_assert!(text.get(ragged.span.clone()).is_some(), "{ragged:?}");
            }
        }
    }
}
