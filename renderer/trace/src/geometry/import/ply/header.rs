//! The header of a PLY file: its elements and their properties.

use crate::geometry::import::raw::{ImportError, shown};
use crate::geometry::stored_number::StoredNumber;

/// Longest header that is read, bytes; useful headers are much shorter.
const LONGEST: usize = 1 << 16;

/// How the values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number by its name.
fn scalar_named(name: &str) -> Option<StoredNumber> {
    Some(match name {
        "char" | "int8" => StoredNumber::Signed(1),
        "uchar" | "uint8" => StoredNumber::Unsigned(1),
        "short" | "int16" => StoredNumber::Signed(2),
        "ushort" | "uint16" => StoredNumber::Unsigned(2),
        "int" | "int32" => StoredNumber::Signed(4),
        "uint" | "uint32" => StoredNumber::Unsigned(4),
        "float" | "float32" => StoredNumber::F32,
        "double" | "float64" => StoredNumber::F64,
        _ => return None,
    })
}

/// A number, or a list of numbers preceded by its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(StoredNumber),
    List {
        count: StoredNumber,
        item: StoredNumber,
    },
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    /// The claimed count, for which nothing is allocated.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
}

/// Where the values begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub(super) byte: usize,
    pub(super) line: usize,
}

impl Header {
    /// Reads the header.
    pub(super) fn parse(bytes: &[u8]) -> Result<(Self, Body), ImportError> {
        let mut format = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut byte = 0;
        let mut line = 0;
        loop {
            line += 1;
            let wrong = |what: String| ImportError::Line { line, what };
            let rest = &bytes[byte..];
            let length = rest.iter().take(LONGEST).position(|&byte| byte == b'\n');
            let Some(length) = length.filter(|length| byte + length < LONGEST) else {
                return Err(wrong("the header has no end_header".to_owned()));
            };
            let text = std::str::from_utf8(&rest[..length])
                .map_err(|_| wrong("the header is not text".to_owned()))?;
            byte += length + 1;
            let words: Vec<_> = text.split_ascii_whitespace().collect();
            if line == 1 {
                if words != ["ply"] {
                    return Err(wrong("the file does not begin with \"ply\"".to_owned()));
                }
                continue;
            }
            match words[..] {
                ["format", name, "1.0"] => {
                    format = Some(match name {
                        "ascii" => Format::Ascii,
                        "binary_little_endian" => Format::LittleEndian,
                        "binary_big_endian" => Format::BigEndian,
                        _ => return Err(wrong(format!("the format {} is not known", shown(name)))),
                    });
                }
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| {
                        wrong(format!("{} is not a number of elements", shown(count)))
                    })?;
                    if elements.iter().any(|element| element.name == name) {
                        return Err(wrong(format!("a second element {}", shown(name))));
                    }
                    elements.push(Element {
                        name: name.to_owned(),
                        count,
                        properties: Vec::new(),
                    });
                }
                ["property", ref words @ ..] => {
                    let element = elements
                        .last_mut()
                        .ok_or_else(|| wrong("a property before any element".to_owned()))?;
                    let scalar = |name: &str| {
                        scalar_named(name)
                            .ok_or_else(|| wrong(format!("the type {} is not known", shown(name))))
                    };
                    let (kind, name) = match *words {
                        ["list", count, item, name] => {
                            let count = scalar(count)?;
                            if matches!(count, StoredNumber::F32 | StoredNumber::F64) {
                                return Err(wrong(
                                    "the length of a list is not an integer type".to_owned(),
                                ));
                            }
                            let item = scalar(item)?;
                            (Kind::List { count, item }, name)
                        }
                        [kind, name] => (Kind::Scalar(scalar(kind)?), name),
                        _ => {
                            return Err(wrong(
                                "a property is `property TYPE NAME` or a list".to_owned(),
                            ));
                        }
                    };
                    element.properties.push(Property {
                        name: name.to_owned(),
                        kind,
                    });
                }
                ["end_header"] => break,
                ["comment" | "obj_info", ..] | [] => {}
                _ => {
                    return Err(wrong(format!(
                        "{} is not a line of a PLY header",
                        shown(text)
                    )));
                }
            }
        }
        let format = format.ok_or(ImportError::Line {
            line,
            what: "the header names no format".to_owned(),
        })?;
        Ok((
            Self { format, elements },
            Body {
                byte,
                line: line + 1,
            },
        ))
    }
}
