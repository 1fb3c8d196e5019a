//! One spectrum a file: a plain table of two columns, ASCII export of an ASD, or an SVC's `.sig`.
//!
//! | form | told by | columns |
//! | --- | --- | --- |
//! | table | anything else | wavelength and value; comma, semicolon, tab or spaces; `#` before comments; an optional line of names |
//! | ASD | a line that begins with `Wavelength`, below any lines about the instrument | wavelength and value |
//! | SVC | `/*** Spectra Vista SIG Data ***/` in the first line | behind `data=`: wavelength, radiance of the reference, of the target, and their ratio in percent, which is taken |

use std::ops::Range;

use super::units::{MICROMETRES, PERCENT, are_micrometres, are_percent};
use super::{Fault, Slack, What, quoted};

/// How a file of one spectrum is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Two columns.
    Table,
    /// ASCII export of a spectrometer by ASD.
    Asd,
    /// A `.sig` file of a spectrometer by SVC.
    Svc,
}

/// One spectrum, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// How the file is laid out.
    pub form: Form,
    /// Wavelengths and values.
    pub points: Vec<(f64, f64)>,
    /// Bytes of the text where wavelength and value of each stand.
    pub spans: Vec<[Range<usize>; 2]>,
    /// Whether the values are percent because the form says so.
    is_percent: bool,
}

/// First words of a `.sig` file.
const SVC: &str = "/*** Spectra Vista SIG Data";
/// First bytes of binary files of ASD, by version.
const ASD_BINARY: [&[u8]; 4] = [b"ASD", b"as6", b"as7", b"as8"];

impl Series {
    /// Refuses wavelengths that do not rise, and files without any.
    ///
    /// # Errors
    ///
    /// A [`Fault`] with the wavelength's place.
    pub fn require_rising(&self) -> Result<(), Fault> {
        if self.points.is_empty() {
            return Err(Fault::of_file("there are no lines of numbers", ""));
        }
        let falls = (1..self.points.len()).find(|&i| self.points[i].0 <= self.points[i - 1].0);
        falls.map_or(Ok(()), |i| {
            let [before, after] = [self.points[i - 1].0, self.points[i].0];
            let problem = format!("has wavelength {after} behind {before}");
            Err(Fault::at(
                self.spans[i][0].clone(),
                problem,
                "sort the lines",
            ))
        })
    }

    /// Refuses shares below 0 and above 1.
    ///
    /// # Errors
    ///
    /// A [`Fault`] with the value's place.
    pub fn require_shares(&self, Slack(slack): Slack) -> Result<(), Fault> {
        let is_bad = |(_, value): &(f64, f64)| !(-slack..=1.0 + slack).contains(value);
        self.points.iter().position(is_bad).map_or(Ok(()), |i| {
            let (nm, value) = self.points[i];
            let problem = format!("has {value} at {nm} nm, allowed is 0 to 1");
            Err(Fault::at(self.spans[i][1].clone(), problem, ""))
        })
    }

    /// Brings the spectrum into nm and shares of 0 to 1; what was taken for granted in words.
    pub fn to_nm_and_shares(&mut self) -> Vec<String> {
        let mut notes = Vec::new();
        if are_micrometres(self.points.iter().map(|point| point.0)) {
            notes.push(MICROMETRES.to_owned());
            for point in &mut self.points {
                point.0 *= 1000.0;
            }
        }
        if self.is_percent {
            notes.push("values are percent, as in every .sig file".to_owned());
        } else if are_percent(self.points.iter().map(|point| point.1)) {
            notes.push(PERCENT.to_owned());
        } else {
            return notes;
        }
        for point in &mut self.points {
            point.1 /= 100.0;
        }
        notes
    }
}

/// Reads a file; its text, into which spans point, and its spectrum.
///
/// # Errors
///
/// The first [`Fault`].
pub fn read(bytes: &[u8]) -> Result<(&str, Series), Fault> {
    let text = text(bytes)?;
    series(text).map(|series| (text, series))
}

/// The text of a file without the mark that programs put in front.
///
/// # Errors
///
/// A [`Fault`] if it is not UTF-8.
pub fn text(bytes: &[u8]) -> Result<&str, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let byte = error.valid_up_to();
        if ASD_BINARY.iter().any(|start| bytes.starts_with(start)) {
            let problem = "is a binary file of an ASD";
            let help = "export it as text: in ViewSpec Pro, Process, ASCII Export";
            return Fault::of_file(problem, help);
        }
        Fault::at(byte..byte, "is not UTF-8", "save it as UTF-8 text")
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// The spectrum of a text.
///
/// # Errors
///
/// The first [`Fault`].
pub fn series(text: &str) -> Result<Series, Fault> {
    let (form, start, columns) = form(text)?;
    let mut found = Series {
        form,
        points: Vec::new(),
        spans: Vec::new(),
        is_percent: form == Form::Svc,
    };
    let mut names_allowed = form == Form::Table;
    let mut at = start;
    for line in text[start..].split_inclusive('\n') {
        let fields = fields(line, at);
        at += line.len();
        let [first, .., last] = fields.as_slice() else {
            if let [(field, span)] = fields.as_slice() {
                if names_allowed && field.parse::<f64>().is_err() {
                    names_allowed = false;
                    continue;
                }
                return Err(wrong_columns(span.clone(), 1, columns));
            }
            continue;
        };
        if names_allowed && first.0.parse::<f64>().is_err() {
            names_allowed = false;
            continue;
        }
        names_allowed = false;
        if fields.len() != columns {
            let span = first.1.start..last.1.end;
            return Err(wrong_columns(span, fields.len(), columns));
        }
        let numbers = [first, last].map(number);
        let [wavelength, value] = numbers;
        let (wavelength, value) = (wavelength?, value?);
        if form == Form::Svc && found.points.last().is_some_and(|(nm, _)| *nm >= wavelength) {
            let before = found.points[found.points.len() - 1].0;
            let problem = format!("has wavelength {wavelength} behind {before}");
            let help = "detectors overlap there: let the instrument's program remove the overlap";
            return Err(Fault::at(first.1.clone(), problem, help));
        }
        found.points.push((wavelength, value));
        found.spans.push([first.1.clone(), last.1.clone()]);
    }
    Ok(found)
}

/// The form of a text, where its numbers begin, and how many columns they have.
fn form(text: &str) -> Result<(Form, usize, usize), Fault> {
    if text.starts_with(SVC) {
        let mut at = 0;
        for line in text.split_inclusive('\n') {
            at += line.len();
            if line.trim() == "data=" {
                return Ok((Form::Svc, at, 4));
            }
        }
        let help = "behind it stand wavelength, reference, target and percent";
        return Err(Fault::of_file("has no line `data=`", help));
    }
    let mut at = 0;
    for line in text.split_inclusive('\n').take(200) {
        at += line.len();
        let first = line
            .split(['\t', ',', ';'])
            .next()
            .unwrap_or_default()
            .trim();
        // Plain tables may name their columns so too: then nothing is above.
        if first.eq_ignore_ascii_case("wavelength") && at > line.len() {
            return Ok((Form::Asd, at, 2));
        }
    }
    let is_export = text
        .lines()
        .next()
        .is_some_and(|line| line.starts_with("Wavelength\t"));
    let form = if is_export { Form::Asd } else { Form::Table };
    let start = if is_export {
        text.find('\n').map_or(text.len(), |end| end + 1)
    } else {
        0
    };
    Ok((form, start, 2))
}

fn wrong_columns(span: Range<usize>, found: usize, wanted: usize) -> Fault {
    let problem = format!("has {found} columns in this line, wanted are {wanted}");
    let help = if wanted == 2 {
        "keep the wavelength in nm and the value, with a decimal point"
    } else {
        "a .sig file has wavelength, reference, target and percent"
    };
    Fault::at(span, problem, help)
}

pub(super) fn number((field, span): &(&str, Range<usize>)) -> Result<f64, Fault> {
    match field.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(Fault {
            span: Some(span.clone()),
            what: What::NotFinite {
                value: quoted(field),
            },
        }),
        Err(_) => {
            let problem = format!("has `{}` where a number is wanted", quoted(field));
            let help = "write a number, or `#` before a comment";
            Err(Fault::at(span.clone(), problem, help))
        }
    }
}

/// The columns of a line before its comment, each with its bytes.
pub(super) fn fields(line: &str, start: usize) -> Vec<(&str, Range<usize>)> {
    let line = line.split('#').next().unwrap_or("");
    let separator =
        |character: char| character == ',' || character == ';' || character.is_whitespace();
    let base = line.as_ptr().addr();
    line.split(separator)
        .filter(|field| !field.is_empty())
        .map(|field| {
            let from = start + (field.as_ptr().addr() - base);
            (field, from..from + field.len())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn points(text: &str) -> Vec<(f64, f64)> {
        read(text.as_bytes()).expect("a good file").1.points
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
    fn a_sig_file_gives_its_ratio_as_a_share_and_says_so() {
        let (_, mut found) = read(SIG.as_bytes()).expect("a good file");
        assert_eq!(found.form, Form::Svc);
        let notes = found.to_nm_and_shares();
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert_eq!(found.points, [(450.1, 0.05), (550.2, 0.12), (800.3, 0.48)]);
        let overlap = SIG.replace("800.3", "549.0");
        let fault = read(overlap.as_bytes()).expect_err("wavelengths fall");
        let shown = fault.shown(Path::new("oak.sig"), &overlap);
        assert!(shown.starts_with("oak.sig, line 9: has wavelength 549 behind 550.2"));
        let without = SIG.replace("data=", "date=");
        assert!(read(without.as_bytes()).is_err());
    }

    #[test]
    fn an_export_of_an_asd_is_read_with_and_without_its_header() {
        let short = "Wavelength\toak00001.asd\r\n350\t0.04\r\n351\t0.05\r\n";
        let long = "Text conversion of header file oak00001.asd\r\n\r\n\
            The instrument number was 18140/2.\r\nSpectrum was saved 06/01/2024, 11:02\r\n\r\n\
            Wavelength\toak00001.asd\r\n350\t0.04\r\n351\t0.05\r\n";
        for text in [short, long] {
            let (_, found) = read(text.as_bytes()).expect("a good file");
            assert_eq!(found.form, Form::Asd);
            assert_eq!(found.points, [(350.0, 0.04), (351.0, 0.05)]);
        }
        let several = "Wavelength\ta.asd\tb.asd\n350\t0.04\t0.05\n";
        let fault = read(several.as_bytes()).expect_err("two spectra");
        assert!(fault.to_string().contains("3 columns"), "{fault}");
        let binary = read(b"as7\0\xff\xfe\x80").expect_err("no text");
        assert!(binary.to_string().contains("binary"), "{binary}");
    }

    #[test]
    fn micrometres_and_percent_are_recognised_and_told() {
        let (_, mut found) = read(b"um R\n0.4 5\n0.5 10\n0.8 50\n").expect("a good file");
        assert_eq!(found.to_nm_and_shares(), [MICROMETRES, PERCENT]);
        assert_eq!(found.points, [(400.0, 0.05), (500.0, 0.1), (800.0, 0.5)]);
        let (_, mut plain) = read(b"400 0.5\n500 0.6\n").expect("a good file");
        assert!(plain.to_nm_and_shares().is_empty());
    }

    #[test]
    fn what_is_no_number_is_told_with_its_line_below_the_names() {
        for (text, line) in [
            ("nm,R\nnm,R\n", 2),
            ("400,0.1,3\n", 1),
            ("400;0,1\n", 1),
            ("400,0.1\n410\n", 2),
            ("400,0.1\n410,nan\n", 2),
            ("400,0.1\n410,--\n", 2),
        ] {
            let fault = read(text.as_bytes()).expect_err(text);
            let shown = fault.shown(Path::new("x.csv"), text);
            let start = format!("x.csv, line {line}: ");
            assert!(shown.starts_with(&start), "{text:?}: {shown}");
        }
    }
}
