//! Tables of instances as text: a header with the columns' names, then one row per line.
//!
//! Fields are separated by comma, semicolon, tab or spaces, or by the one that the scene names; `#`
//! begins a comment; empty lines are ignored. Where anything but commas separates them, commas are
//! decimal marks.

use super::super::table_file::tell;
use super::columns::{Header, HeaderError, Row, SHAPE};
use super::table::{RowError, Rows, Table, WrongRow};
use crate::scene::description::InstancePlace;
use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::encoding::decoded;
use leafmodel::document::rows::{Decimal, Form, Guess, Separator, number};
use leafmodel::document::source::{Place, escaped};

/// Separators of the fields of a line.
const SEPARATORS: [char; 5] = [';', ' ', '\t', '\r', ','];
/// The same where commas are decimal marks.
const ALL_BUT_COMMAS: &[char] = &[';', ' ', '\t', '\r'];

/// Longest line that may be a row, bytes.
const LONGEST: usize = 1 << 14;

/// Reads the rows; `None`, after a report, if the file has no readable rows.
pub(super) fn read(
    cx: &Context,
    table: &Table<'_>,
    at: &Place,
    bytes: &[u8],
    form: Form,
) -> Option<Rows> {
    let decoded = decoded(bytes)
        .map_err(|error| table.refuse(cx, at, error.to_string(), "save it as UTF-8 text"))
        .ok()?;
    let text = &*decoded.text;
    let (marks, guess) = Marks::of(text, form);
    for guess in decoded.guess().into_iter().chain(guess) {
        let help = guess.key().unwrap_or_default();
        tell(cx, &table.name, at, &guess, &help);
    }
    let mut rest = text;
    let mut line_number = 0;
    let line = loop {
        let (line, below) = rest.split_once('\n').unwrap_or((rest, ""));
        line_number += 1;
        if marks.fields(line).next().is_some() {
            rest = below;
            break line;
        }
        if below.is_empty() {
            table.refuse(cx, at, "is empty".to_owned(), "write a header and rows");
            return None;
        }
        rest = below;
    };
    if line.len() > LONGEST {
        let problem = format!("has a header of {} bytes", line.len());
        table.refuse(cx, at, problem, "end header and rows with line feeds");
        return None;
    }
    let header = read_header(cx, table, line, line_number, marks)?;
    // Counts lines, including comments and empty ones, which is accurate enough for a bound.
    let lines = rest.bytes().filter(|byte| *byte == b'\n').count();
    if !table.bear(cx, at, lines.max(1)) {
        return None;
    }
    let lines = (line_number + 1..).zip(rest.lines());
    let is_row = |line: &str| line.len() > LONGEST || marks.fields(line).next().is_some();
    let rows: Vec<(usize, &str)> = lines.filter(|(_, line)| is_row(line)).collect();
    let read = |line| read_row(table, &header, line, marks);
    let wrong = |number, line: &str, errors| {
        let mut shown = line.to_owned();
        let mut fields: Vec<_> = marks.fields(line).map(|field| span(line, field)).collect();
        if line.len() > LONGEST {
            shown = line.chars().take(QUOTED).collect();
            fields.clear();
            fields.push(0..shown.len());
        }
        WrongRow::new((number, shown), &header.columns, &fields, errors)
    };
    table
        .bear(cx, at, rows.len())
        .then(|| Rows::read(&rows, read, wrong))
}

/// How a table is written.
#[derive(Clone, Copy, Debug)]
struct Marks {
    /// What separates fields.
    separators: &'static [char],
    /// The decimal mark, if it is known.
    decimal: Option<Decimal>,
}

impl Marks {
    /// What the scene says, and else what the text shows; with a guess, if it is one.
    fn of(text: &str, Form { separator, decimal }: Form) -> (Self, Option<Guess>) {
        let is_guess = separator.is_none() && decimal.is_none() && Self::has_decimal_commas(text);
        let separators: &[char] = match separator {
            Some(Separator::Tab) => &['\t', '\r'],
            Some(Separator::Semicolon) => &[';', '\r'],
            Some(Separator::Comma) => &[',', '\r'],
            Some(Separator::Blanks) => &[' ', '\t', '\r'],
            None if is_guess || decimal == Some(Decimal::Comma) => ALL_BUT_COMMAS,
            None => &SEPARATORS,
        };
        let marks = Self {
            separators,
            decimal,
        };
        (marks, is_guess.then(Guess::decimal_commas))
    }

    /// Whether there are commas, something else separates the names, and every field with a comma is
    /// a number.
    fn has_decimal_commas(text: &str) -> bool {
        const SAMPLE: usize = 64;
        let marks = Self {
            separators: ALL_BUT_COMMAS,
            decimal: None,
        };
        let has_comma = |field: &str| field.contains(',');
        let mut sample = text.lines().take(SAMPLE);
        Separator::of(text) != Separator::Comma
            && sample.all(|line| {
                let mut fields = marks.fields(line);
                fields.all(|field| !has_comma(field) || number(field).is_some())
            })
            && has_comma(text)
            && text.lines().any(|line| marks.fields(line).any(has_comma))
    }

    /// The fields of a line before its comment, without the quotes that spreadsheets write.
    fn fields(self, line: &str) -> impl Iterator<Item = &str> {
        let line = line.split_once('#').map_or(line, |(fields, _)| fields);
        let fields = line.split(self.separators).map(str::trim);
        fields.filter(|field| !field.is_empty()).map(|field| {
            let inner = field
                .strip_prefix('"')
                .and_then(|rest| rest.strip_suffix('"'));
            inner.filter(|inner| !inner.is_empty()).unwrap_or(field)
        })
    }

    /// The number in a field.
    fn number(self, field: &str) -> Option<f64> {
        match self.decimal {
            Some(Decimal::Point) => field.parse().ok(),
            Some(Decimal::Comma) | None => number(field),
        }
    }
}

fn read_header(
    cx: &Context,
    table: &Table<'_>,
    line: &str,
    number: usize,
    marks: Marks,
) -> Option<Header> {
    let names: Vec<&str> = marks.fields(line).collect();
    let errors = if names[0].parse::<f64>().is_ok() {
        vec![HeaderError {
            field: Some(0),
            problem: format!("is missing: the table begins with `{}`", escaped(names[0], QUOTED)),
            help: "begin with a line of the columns' names, such as `x_m, y_m, z_m, rotate_z_deg, scale`"
                .to_owned(),
        }]
    } else {
        match Header::of(&names, table.shapes.len()) {
            Ok(header) => return Some(header),
            Err(errors) => errors,
        }
    };
    let source = cx
        .sources
        .borrow_mut()
        .add_excerpt(table.name.clone(), line, number);
    let all = span(line, names[0]).start..span(line, names[names.len() - 1]).end;
    for error in errors {
        let span = error
            .field
            .map_or_else(|| all.clone(), |field| span(line, names[field]));
        cx.error(&Place { source, span }, error.of_file(table));
    }
    None
}

fn read_row(
    table: &Table<'_>,
    header: &Header,
    line: &str,
    marks: Marks,
) -> Result<InstancePlace, Vec<RowError>> {
    if line.len() > LONGEST {
        let problem = format!("has a line of {} bytes", line.len());
        return Err(vec![bad_row(
            table,
            problem,
            "end each row with a line feed",
        )]);
    }
    let mut row = Row::of(header);
    let mut found = 0;
    for field in marks.fields(line) {
        found += 1;
        let Some(&column) = header.columns.get(found - 1) else {
            continue;
        };
        if column == SHAPE {
            row.shape_named(table, field);
        } else {
            row.number(column, marks.number(field), || escaped(field, QUOTED));
        }
    }
    let wanted = header.columns.len();
    if found != wanted {
        // Fields cannot be assigned to columns.
        let problem = format!("has {found} fields in this row, its header names {wanted}");
        let help = "give every row a field for each column, with decimal points";
        return Err(vec![bad_row(table, problem, help)]);
    }
    row.place(table)
}

/// An error of a row as a whole.
fn bad_row(table: &Table<'_>, problem: String, help: &str) -> RowError {
    let error = table.bad_file(problem, help);
    let column = None;
    RowError { column, error }
}

/// The range of bytes of a piece within its line.
fn span(line: &str, piece: &str) -> std::ops::Range<usize> {
    let start = piece.as_ptr() as usize - line.as_ptr() as usize;
    start..start + piece.len()
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec3};

    use super::*;
    use leafmodel::document::error::DocumentError;
    use leafmodel::document::source::Sources;

    /// The rows of a table for the shapes `a`, `b` and twice `c`, or the errors with their lines.
    fn read_all(text: &str) -> Result<Vec<InstancePlace>, Vec<(usize, DocumentError)>> {
        let cx = Context::new(Sources::default(), std::path::PathBuf::new());
        let frame = DMat4::from_translation(DVec3::new(0.0, 0.0, 1.0));
        let names = ["a", "b", "c", "c"].map(str::to_owned);
        let table = Table::new("t.csv".to_owned(), &names, frame);
        let at = Place {
            source: usize::MAX,
            span: 0..0,
        };
        let rows = read(&cx, &table, &at, text.as_bytes(), Form::default());
        let rows = rows.and_then(|rows| {
            table.report(&cx, &at, &rows)?;
            Some(rows.places)
        });
        let (sources, errors, _) = cx.into_parts();
        let line = |source| sources.get(source).map_or(0, |source| source.first_line);
        let errors = errors.into_iter().map(|located| {
            let source = located.at.map_or(usize::MAX, |at| at.source);
            (line(source), located.error)
        });
        rows.ok_or_else(|| errors.collect())
    }

    #[test]
    fn a_row_is_scaled_then_turned_then_moved_then_carried_by_the_object() {
        let text = "\u{feff}# made up\n\nx_m,y_m,z_m;rotate_z_deg\tscale_x scale_y scale_z,shape\r\n\
                    1, 2, 3, 90, 2, 3, 4, b # a leaf\r\n\n0,0,0,0,1,1,1,0";
        let places = read_all(text).expect("two good rows");
        // x = (2, 0, 0) turns to y, y = (0, 3, 0) to −x.
        let linear = [0.0, 2.0, 0.0, -3.0, 0.0, 0.0, 0.0, 0.0, 4.0];
        let turned = places[0].linear.to_cols_array();
        assert_eq!(turned, linear);
        assert_eq!(places[0].translation, DVec3::new(1.0, 2.0, 4.0));
        assert_eq!((places[0].shape, places[1].shape), (1, 0));
        assert_eq!(places.len(), 2);
    }

    #[test]
    fn decimal_commas_give_the_same_places_as_points() {
        let plain = "x_m,y_m,z_m,shape\n0.5,1.25,-2,a\n1,2,3,b # 1,5\n";
        let places = read_all(plain).expect("good rows");
        let german = |separator: &str| plain.replace(',', separator).replace('.', ",");
        for text in [german(";"), german("; "), german("\t"), german("  ")] {
            let found = read_all(&text).unwrap_or_else(|errors| panic!("{text:?}: {errors:?}"));
            assert!(found == places, "{text:?}");
        }
        // Commas between blanks, or in rows alone, separate.
        for text in [
            "x_m y_m z_m shape\n1, 2, 3, a\n",
            "x_m y_m z_m shape\n1,2,3,a\n",
            "x_m;y_m;z_m;shape\n1, 2;3;a\n",
        ] {
            assert_eq!(read_all(text).map(|places| places.len()), Ok(1), "{text}");
        }
    }

    #[test]
    fn what_the_scene_says_of_a_table_counts_and_a_guess_names_its_key() {
        let marks = |text: &str, form: Form| {
            let (marks, guess) = Marks::of(text, form);
            let fields = marks.fields(text.lines().last().expect("a row"));
            let key = guess.and_then(|guess| guess.key()).unwrap_or_default();
            (fields.map(str::to_owned).collect::<Vec<_>>(), key)
        };
        let form = |separator, decimal| Form { separator, decimal };
        let german = "x_m;y_m;z_m\n0,5; 1;2";
        let (fields, key) = marks(german, Form::default());
        assert_eq!(fields, ["0,5", "1", "2"]);
        assert!(key.contains("`decimal = \"point\"`"), "{key}");
        let (fields, key) = marks(german, form(None, Some(Decimal::Point)));
        assert_eq!((fields.len(), key.as_str()), (4, ""));
        for known in [
            form(Some(Separator::Semicolon), None),
            form(None, Some(Decimal::Comma)),
        ] {
            let (fields, key) = marks(german, known);
            assert_eq!((fields.len(), key.as_str()), (3, ""));
        }
        // Commas in comments are none in numbers.
        let commented = "# made by a, b\nx_m y_m z_m\n0.5 1 2";
        assert_eq!(marks(commented, Form::default()).1, "");
    }

    #[test]
    fn a_quaternion_turns_as_its_angles_do() {
        let angles = read_all("x_m y_m z_m rotate_x_deg shape\n0 0 0 60 a\n");
        // Half of 60° about x.
        let text = "x_m y_m z_m quaternion_w quaternion_x quaternion_y quaternion_z shape\n\
                    0 0 0 0.8660254037844387 0.5 0 0 a\n";
        let quaternion = read_all(text).expect("a rotation");
        let [turned, by_quaternion] =
            [&angles.expect("a turn"), &quaternion].map(|places| places[0].linear);
        assert!(turned.abs_diff_eq(by_quaternion, 1e-6), "{turned}");
        let long = text.replace("0.866", "1.0");
        assert_eq!(
            read_all(&long).expect_err("no rotation")[0].1.code(),
            "scene::impossible"
        );
    }

    #[test]
    fn rows_keep_their_order_and_their_lines_on_many_threads() {
        let mut text = "x_m y_m z_m shape\n".to_owned();
        let count = 80_000;
        for row in 0..count {
            text += &format!("{row:>30} 0 0 a # row {row:>8}\n");
        }
        let places = read_all(&text).expect("good rows");
        assert_eq!(places.len(), count);
        for (row, place) in places.iter().enumerate() {
            assert_eq!(place.translation.x, row as f64);
        }
        // Line numbers include the header.
        let broken = text.replace(&format!("{:>30} 0 0 a", count - 2), "x 0 0 a");
        let errors = read_all(&broken).expect_err("one is no number");
        assert_eq!(errors.len(), 1);
        assert_eq!(errors[0].0, count, "{:?}", errors[0].1);
    }

    #[test]
    fn of_many_wrong_rows_the_first_are_reported_and_the_others_counted() {
        let text = "x_m y_m z_m shape\n".to_owned() + &"nan 0 inf d\n".repeat(100_000);
        let errors = read_all(&text).expect_err("all are wrong");
        assert_eq!(errors.len(), 20 * 3 + 1);
        let last = errors[60].1.to_string();
        assert!(last.contains("99980 more wrong rows"), "{last}");
    }

    #[test]
    fn tables_without_header_or_rows_are_refused() {
        let code = |text: &str| read_all(text).expect_err("refused")[0].1.code();
        assert_eq!(code(""), "scene::bad_file");
        assert_eq!(code("# nothing\n\n"), "scene::bad_file");
        assert_eq!(code("x_m y_m z_m shape\n"), "scene::bad_file");
        assert_eq!(code("x_m y_m z_m shape\n# none\n"), "scene::bad_file");
        assert_eq!(code("0 0 0 a\n"), "scene::header");
        assert_eq!(code("x_m y_m z_m shape\n0 0 0\n"), "scene::bad_file");
        assert_eq!(
            code("x_m y_m z_m shape\n0 0 0 0.5\n"),
            "scene::out_of_range"
        );
        assert_eq!(code("x_m y_m z_m shape\n0 0 0 -1\n"), "scene::out_of_range");
        assert_eq!(code("x_m y_m z_m shape\n0 0 0 4\n"), "scene::out_of_range");
        // A name that occurs twice is ambiguous; its numbers in the list are not.
        assert_eq!(code("x_m y_m z_m shape\n0 0 0 c\n"), "scene::impossible");
        assert!(read_all("x_m y_m z_m shape\n0 0 0 2\n0 0 0 3\n").is_ok());
        let long = "0 ".repeat(LONGEST);
        assert_eq!(code(&long), "scene::bad_file");
        assert_eq!(
            code(&format!("x_m y_m z_m shape\n{long}\n")),
            "scene::bad_file"
        );
    }
}
