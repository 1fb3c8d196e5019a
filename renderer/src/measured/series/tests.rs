use super::*;
use std::path::Path;

fn read(text: &str) -> Result<Series, Fault> {
    series(text, &Known::default())
}

fn points(text: &str) -> Vec<(f64, f64)> {
    read(text).expect("a good file").points
}

fn converted(found: &mut Series, known: &Known) -> Vec<Guess> {
    let notes = found.to_nm_and_fractions(known);
    notes.expect("values of the right kind")
}

fn shown(notes: &[Guess]) -> Vec<String> {
    notes.iter().map(ToString::to_string).collect()
}

#[test]
fn names_comments_and_every_separator_are_read() {
    let text = "\u{feff}# made up\nwavelength_nm,R\r\n400,0.1\r\n500; 0.2 # peak\n\n\
                600\t0.3\n700 4e-1";
    let expected = [(400.0, 0.1), (500.0, 0.2), (600.0, 0.3), (700.0, 0.4)];
    assert_eq!(points(text), expected);
}

/// As an SVC HR-1024i writes it, with numbers of our own.
const SIG: &str = "/*** Spectra Vista SIG Data ***/\r\nname= oak.sig\r\n\
    instrument= HI: 1152050 (HR-1024i)\r\nunits= Radiance, Radiance\r\n\
    time= 6/1/2024 11:02:03AM, 6/1/2024 11:03:03AM\r\ndata= \r\n\
    450.1 100.00 5.00 5.00\r\n550.2 200.00 24.00 12.00\r\n800.3 100.00 48.00 48.00\r\n";

#[test]
fn a_sig_file_gives_its_ratio_as_a_fraction_and_says_so() {
    let mut found = read(SIG).expect("a good file");
    assert_eq!(found.form, Form::Svc);
    let notes = shown(&converted(&mut found, &Known::default()));
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!(found.points, [(450.1, 0.05), (550.2, 0.12), (800.3, 0.48)]);
    let without = SIG.replace("data=", "date=");
    assert!(read(&without).is_err());
}

#[test]
fn a_sig_file_with_decimal_commas_holds_the_same() {
    let (head, data) = SIG.split_once("data= ").expect("it has data");
    let commas = format!("{head}data= {}", data.replace('.', ","));
    let found = read(&commas).expect("a good file");
    assert_eq!(found.points, read(SIG).expect("a good file").points);
    let notes = shown(&found.notes);
    assert!(
        notes[0].ends_with("(if not, say --decimal point)"),
        "{notes:?}"
    );
}

#[test]
fn of_detectors_that_overlap_the_first_counts_up_to_the_middle_or_as_a_person_says() {
    let lines = [
        (900, 10),
        (950, 20),
        (1000, 30),
        (940, 25),
        (960, 26),
        (1010, 40),
        (1900, 50),
        (1890, 60),
        (2000, 70),
    ];
    let lines = lines.map(|(nm, percent)| format!("{nm} 1 1 {percent}\n"));
    let text = SIG.split("450.1").next().unwrap_or_default().to_owned() + &lines.concat();
    let kept = |overlap: Option<Overlap>| {
        let known = Known {
            overlap,
            ..Known::default()
        };
        let found = series(&text, &known).expect("a good file");
        found.require_rising().expect("they rise");
        assert_eq!(found.spans.len(), found.points.len());
        for ([nm, _], point) in found.spans.iter().zip(&found.points) {
            assert_eq!(text[nm.clone()].parse(), Ok(point.0));
        }
        let nm: Vec<f64> = found.points.iter().map(|point| point.0).collect();
        (nm, shown(&found.notes))
    };
    let (middle, notes) = kept(None);
    assert_eq!(middle, [900.0, 950.0, 1010.0, 2000.0]);
    assert_eq!(notes.len(), 2);
    assert!(
        notes[0].contains("940 to 1000 nm") && notes[0].contains("--overlap first"),
        "{notes:?}"
    );
    let none: Vec<String> = Vec::new();
    assert_eq!(kept(Some(Overlap::Middle)), (middle, none.clone()));
    let first = vec![900.0, 950.0, 1000.0, 1010.0, 1900.0, 2000.0];
    assert_eq!(kept(Some(Overlap::First)), (first, none.clone()));
    let second = vec![900.0, 940.0, 960.0, 1010.0, 1890.0, 2000.0];
    assert_eq!(kept(Some(Overlap::Second)), (second, none));
    let jumping = text.clone() + "1 1 1 1\n2000 1 1 1\n1 1 1 1\n";
    let fault = read(&jumping).expect_err("five detectors");
    let message = fault.shown(Path::new("oak.sig"), &jumping);
    assert!(
        message.starts_with("oak.sig, line 10: has wavelength 940 behind 1000"),
        "{message}"
    );
}

#[test]
fn wavelengths_may_fall_and_bands_may_be_masked() {
    let text = "nm;R\n700;0,3\n600;NaN\n550;\n500;-9999\n400;0,1\n";
    let found = read(text).expect("a good file");
    assert_eq!(found.points, [(400.0, 0.1), (700.0, 0.3)]);
    let notes = shown(&found.notes);
    assert!(
        notes[1].starts_with("3 of 5 wavelengths have no value"),
        "{notes:?}"
    );
    let known = Known {
        masked: Some(0.1),
        ..Known::default()
    };
    let fault = series("400 0.1\n500 -0.5\n", &known).expect("a good file");
    assert_eq!(fault.points, [(500.0, -0.5)]);
}

#[test]
fn flags_count_more_than_guesses() {
    let read = |known: Known| {
        let mut found = series("0.4 5\n0.5 10\n0.8 50\n", &known).expect("a good file");
        let notes = shown(&converted(&mut found, &known));
        (found.points[1], notes.len())
    };
    let plain = Known::default();
    assert_eq!(read(plain), ((500.0, 0.1), 2));
    let nm = Some(WavelengthUnit::Nanometres);
    let fraction = Some(ValueUnit::Fraction);
    let known = Known {
        wavelengths: nm,
        ..plain
    };
    assert_eq!(read(known), ((0.5, 0.1), 1));
    let known = Known {
        values: fraction,
        ..known
    };
    assert_eq!(read(known), ((0.5, 10.0), 0));
}

#[test]
fn an_export_of_an_asd_is_read_with_and_without_its_header() {
    let short = "Wavelength\toak00001.asd\r\n350\t0.04\r\n351\t0.05\r\n";
    let long = "Text conversion of header file oak00001.asd\r\n\r\n\
        The instrument number was 18140/2.\r\nSpectrum was saved 06/01/2024, 11:02\r\n\r\n\
        Wavelength\toak00001.asd\r\n350\t0.04\r\n351\t0.05\r\n";
    for text in [short, long] {
        let found = read(text).expect("a good file");
        assert_eq!(found.form, Form::Asd);
        assert_eq!(found.points, [(350.0, 0.04), (351.0, 0.05)]);
    }
    let several: &str = "Wavelength\ta.asd\tb.asd\n350\t0.04\t0.05\n";
    let fault = read(several).expect_err("two spectra");
    assert!(fault.to_string().contains("3 columns"), "{fault}");
    let binary = text(b"as7\0\xff\xfe\x80").expect_err("no text");
    assert!(binary.to_string().contains("binary"), "{binary}");
}

#[test]
fn micrometres_and_percent_are_recognised_and_reported() {
    let mut found = read("0.4 5\n0.5 10\n0.8 50\n").expect("a good file");
    let notes = converted(&mut found, &Known::default());
    let micrometres = guess("wavelengths are taken for µm", "wavelengths", "nm");
    assert_eq!(notes, [micrometres, percent()]);
    assert_eq!(found.points, [(400.0, 0.05), (500.0, 0.1), (800.0, 0.5)]);
    let mut plain = read("400 0.5\n500 0.6\n").expect("a good file");
    assert!(converted(&mut plain, &Known::default()).is_empty());
}

#[test]
fn the_line_of_names_says_units_and_what_is_no_wavelength_or_reflectance() {
    // (the text, the second point, words of its notes)
    for (text, point, said) in [
        ("um,R\n0.4,0.1\n0.5,0.2\n", (500.0, 0.2), ""),
        (
            "Wavelength [µm]\tR (%)\n0.4\t1\n0.5\t2\n",
            (500.0, 0.02),
            "",
        ),
        (
            "Wavelength\tReflectance (%)\n400\t0.5\n500\t1.5\n",
            (500.0, 0.015),
            "",
        ),
        (
            "# a lamp\nnm;value\n400;0,1\n500;0,2\n",
            (500.0, 0.2),
            "decimal",
        ),
        (
            "nm,R [%]\n400,0.1\n500,0.2\n",
            (500.0, 0.002),
            "says percent, but",
        ),
        (
            "Licht,R\n400,0.1\n500,0.2\n",
            (500.0, 0.2),
            "`Licht` is taken",
        ),
        (",R\n400,0.1\n500,0.2\n", (500.0, 0.2), ""),
    ] {
        let mut found = read(text).expect("a good file");
        let notes = shown(&converted(&mut found, &Known::default()));
        assert_eq!(found.points[1], point, "{text}");
        assert_eq!(notes.len(), usize::from(!said.is_empty()), "{notes:?}");
        assert!(notes.iter().all(|note| note.contains(said)), "{notes:?}");
    }
    for (text, said) in [
        (
            "frequency_THz,R\n400,0.1\n500,0.2\n",
            "x.csv, line 1: has frequencies in the column `frequency_THz`: write wavelengths in nm",
        ),
        (
            "# FTIR\nwavenumber (cm-1);Reflectance\n4000;0,1\n5000;0,2\n",
            "x.csv, line 2: has wavenumbers in the column `wavenumber (cm-1)`",
        ),
        (
            "nm,log(1/R)\n400,0.1\n500,0.2\n",
            "x.csv, line 1: has absorbances in the column `log(1/R)`",
        ),
        (
            "R,nm\n0.1,400\n0.2,500\n",
            "x.csv, line 1: has `R` before the wavelengths",
        ),
        (
            "nm;R\n980;0.1\n990;0.1\n1,000;0.2\n",
            "x.csv, line 4: has wavelength 1 behind 990: a comma within a number is read as its \
             decimal mark, so write 1000",
        ),
    ] {
        let found = read(text).and_then(|mut found| {
            found.to_nm_and_fractions(&Known::default())?;
            found.require_rising()
        });
        let shown = found.expect_err(text).shown(Path::new("x.csv"), text);
        assert!(shown.starts_with(said), "{shown}");
    }
}

#[test]
fn what_is_no_number_is_reported_with_its_line_below_the_names() {
    for (text, line) in [
        ("nm,R\nnm,R\n", 2),
        ("400,0.1,3\n", 1),
        ("400,0.1\n410\n", 2),
        ("400,0.1\n410,inf\n", 2),
        ("400,0.1\nnan,0.1\n", 2),
        ("400,0.1\n410,0.1.2\n", 2),
    ] {
        let fault = read(text).expect_err(text);
        let shown = fault.shown(Path::new("x.csv"), text);
        let start = format!("x.csv, line {line}: ");
        assert!(shown.starts_with(&start), "{text:?}: {shown}");
    }
}
