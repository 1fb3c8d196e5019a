//! The header of a `NumPy` file: the fields of a row, the number of rows, and the offset of the
//! first.
//!
//! It is a Python literal; only the forms written by `np.save` are understood.

use leafmodel::document::context::{ENOUGH, QUOTED};
use leafmodel::document::source::escaped;
use serde::Deserialize;
use serde_json::Value;

use crate::geometry::stored_number::StoredNumber;

const MAGIC: &[u8] = b"\x93NUMPY";
/// Longest header that is read, bytes.
const MOST_HEADER: usize = 1 << 16;

/// The type with a `NumPy` code such as `<f4`.
fn number_of(code: &str) -> Option<StoredNumber> {
    let (order, rest) = code.split_at_checked(1)?;
    let (kind, size) = rest.split_at_checked(1)?;
    let size: usize = size.parse().ok()?;
    // A single byte has no byte order.
    if order != "<" && !(order == "|" && size == 1) {
        return None;
    }
    match (kind, size) {
        ("f", 4) => Some(StoredNumber::F32),
        ("f", 8) => Some(StoredNumber::F64),
        ("i", 1 | 2 | 4 | 8) => Some(StoredNumber::Signed(size)),
        ("u", 1 | 2 | 4 | 8) => Some(StoredNumber::Unsigned(size)),
        _ => None,
    }
}

/// A field of the array: its offset in a row and its type.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) start: usize,
    pub(super) number: StoredNumber,
}

/// The contents of a header.
#[derive(Debug, PartialEq)]
pub(super) struct Array {
    pub(super) fields: Vec<Field>,
    /// Bytes of a row.
    pub(super) stride: usize,
    pub(super) rows: usize,
    /// Where the rows begin.
    pub(super) start: usize,
}

impl Array {
    /// Reads the file's header; the error is a message.
    pub(super) fn of(bytes: &[u8]) -> Result<Self, String> {
        let cut = || "ends within its header".to_owned();
        let Some(rest) = bytes.strip_prefix(MAGIC) else {
            return Err("does not begin as a NumPy file does".to_owned());
        };
        let (&version, rest) = rest.split_first().ok_or_else(cut)?;
        let rest = rest.get(1..).ok_or_else(cut)?;
        let width = match version {
            1 => 2,
            2 | 3 => 4,
            _ => {
                return Err(format!(
                    "has version {version} of NumPy's format, read are 1 to 3"
                ));
            }
        };
        let (length, rest) = rest.split_at_checked(width).ok_or_else(cut)?;
        let length = StoredNumber::Unsigned(width).read(length) as usize;
        if length > MOST_HEADER {
            return Err(format!(
                "has a header of {length} bytes, more than the {MOST_HEADER} that are read"
            ));
        }
        let text = rest.get(..length).ok_or_else(cut)?;
        let start = bytes.len() - rest.len() + length;
        let text =
            std::str::from_utf8(text).map_err(|_| "has a header that is no text".to_owned())?;
        Self::from_literal(text, start)
    }

    /// Reads the dictionary in the header.
    fn from_literal(text: &str, start: usize) -> Result<Self, String> {
        let dictionary: Dictionary = serde_json::from_str(&as_json(text))
            .map_err(|error| format!("has a header that is not understood: {error}"))?;
        let Value::Array(described) = &dictionary.descr else {
            let code = dictionary.descr.as_str().unwrap_or_default();
            return Err(format!(
                "is an array of `{}`, without names for its columns",
                escaped(code, QUOTED)
            ));
        };
        let [length] = &dictionary.shape[..] else {
            return Err("has another number of dimensions than 1".to_owned());
        };
        let rows = length.as_u64().and_then(|rows| rows.try_into().ok());
        let rows = rows.ok_or_else(|| {
            let shown = escaped(&length.to_string(), QUOTED);
            format!("has a header with `{shown}` where a length is wanted")
        })?;
        let (mut fields, mut stride) = (Vec::new(), 0);
        for described in described {
            stride += Field::add(described, stride, &mut fields)?;
            if fields.len() > ENOUGH {
                return Err(format!("has more than {ENOUGH} fields"));
            }
        }
        Ok(Self {
            fields,
            stride,
            rows,
            start,
        })
    }
}

impl Field {
    /// Adds `["x_m", "<f4"]`, which begins at `start`, and returns its bytes.
    fn add(described: &Value, start: usize, fields: &mut Vec<Self>) -> Result<usize, String> {
        let shown = |text: &str| escaped(text, QUOTED);
        let parts = described.as_array().map_or(&[][..], Vec::as_slice);
        let (name, code) = match parts {
            [Value::String(name), Value::String(code)] => (name, code),
            [Value::String(name), Value::String(_), _] => {
                return Err(format!("has a field `{}` of several numbers", shown(name)));
            }
            _ => {
                return Err(format!(
                    "has a header with `{}` where a name and a type are wanted",
                    shown(&described.to_string())
                ));
            }
        };
        // Padding in aligned rows has no name: '|V4' is four bytes of padding.
        let gap = code
            .strip_prefix("|V")
            .and_then(|size| size.parse::<u16>().ok());
        if let (Some(gap), true) = (gap, name.is_empty()) {
            return Ok(gap.into());
        }
        let number = number_of(code).ok_or_else(|| {
            format!(
                "has a field `{}` of type `{}`; read are little-endian floats of 4 or 8 bytes and integers",
                shown(name),
                shown(code)
            )
        })?;
        fields.push(Self {
            name: name.clone(),
            start,
            number,
        });
        Ok(number.size())
    }
}

/// The dictionary of a header.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Dictionary {
    descr: Value,
    /// With one dimension both orders are the same.
    #[serde(rename = "fortran_order")]
    _fortran_order: bool,
    shape: Vec<Value>,
}

/// A Python literal as `np.save` writes it, in JSON, which has other quotes and brackets and no commas
/// before brackets.
fn as_json(literal: &str) -> String {
    let literal = literal
        .replace('\'', "\"")
        .replace('(', "[")
        .replace(')', "]");
    let literal = literal.replace("False", "false").replace("True", "true");
    let mut json = String::new();
    for (number, piece) in literal.split(',').enumerate() {
        if number > 0 && !piece.trim_start().starts_with([']', '}']) {
            json.push(',');
        }
        json += piece;
    }
    json
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(literal: &str) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend([1, 0]);
        bytes.extend((literal.len() as u16).to_le_bytes());
        bytes.extend(literal.as_bytes());
        bytes
    }

    #[test]
    fn a_header_as_numpy_writes_it_is_understood() {
        // Written by numpy 2: np.save of a record array, aligned, then padded to 64 bytes.
        let literal = "{'descr': [('x_m', '<f4'), ('shape', '|u1'), ('', '|V3'), ('y_m', '<f8'), ('n', '<i2')], \
                       'fortran_order': False, 'shape': (12,), }   \n";
        let array = Array::of(&file(literal)).expect("a good header");
        assert_eq!((array.rows, array.stride), (12, 18));
        assert_eq!(array.start, 10 + literal.len());
        let starts: Vec<usize> = array.fields.iter().map(|field| field.start).collect();
        assert_eq!(starts, [0, 4, 8, 16]);
    }

    #[test]
    fn numbers_are_those_that_were_stored() {
        let read = |code: &str, bytes: &[u8]| number_of(code).expect(code).read(bytes);
        assert_eq!(read("<f4", &1.5_f32.to_le_bytes()), 1.5);
        assert_eq!(read("<f8", &(-0.1_f64).to_le_bytes()), -0.1);
        assert_eq!(read("<i2", &(-3_i16).to_le_bytes()), -3.0);
        assert_eq!(read("|i1", &(-128_i8).to_le_bytes()), -128.0);
        assert_eq!(read("<i8", &(-5_i64).to_le_bytes()), -5.0);
        assert_eq!(read("<u4", &u32::MAX.to_le_bytes()), f64::from(u32::MAX));
        assert!(read("<f4", &f32::NAN.to_le_bytes()).is_nan());
    }

    #[test]
    fn what_is_no_structured_little_endian_array_of_rows_is_refused_with_its_reason() {
        let of = |fields: &str, shape: &str| {
            let literal =
                format!("{{'descr': {fields}, 'fortran_order': False, 'shape': {shape}, }}");
            Array::of(&file(&literal)).expect_err("it is refused")
        };
        for (fields, shape, said) in [
            ("'<f4'", "(3, 4)", "without names"),
            ("[('x_m', '>f4')]", "(3,)", "little-endian"),
            ("[('x_m', '|S4')]", "(3,)", "`|S4`"),
            ("[('x_m', '<f4', (3,))]", "(3,)", "several numbers"),
            ("[('x_m', '<f4')]", "(3, 4)", "dimensions"),
            ("[('x_m', '<f4')]", "()", "dimensions"),
            ("[('x_m', '<f4')]", "(99999999999999999999,)", "length"),
            ("[('x_m', [('y_m', '<f4')])]", "(3,)", "wanted"),
            ("[('x_m", "(3,)", "not understood"),
        ] {
            let problem = of(fields, shape);
            assert!(problem.contains(said), "{fields} {shape}: {problem}");
        }
        for length in 0..100 {
            let whole =
                file("{'descr': [('x_m', '<f4')], 'fortran_order': False, 'shape': (3,), }");
            let cut = &whole[..length.min(whole.len() - 1)];
            assert!(Array::of(cut).is_err(), "{length} bytes");
        }
    }
}
