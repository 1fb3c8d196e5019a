//! Encodings of text files: from bytes to characters.
//!
//! A byte order mark decides first, then an XML declaration, then whether the bytes are UTF-8. What is
//! none of these is read as Windows-1252, which contains Latin-1, and a note says so.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use thiserror::Error;

use super::rows::Guess;

/// How many bytes of a file may hold its XML declaration.
const DECLARATION: usize = 256;

/// The characters of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded<'b> {
    /// The text, without a byte order mark.
    pub text: Cow<'b, str>,
    /// Whether nothing says how it is encoded, and it is not UTF-8: it is read as Windows-1252.
    pub is_guessed: bool,
}

impl Decoded<'_> {
    /// The guess, as a note.
    pub fn guess(&self) -> Option<Guess> {
        self.is_guessed.then(Guess::latin_1)
    }
}

/// Bytes that are no text.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum NotText {
    /// The encoding that the file declares is not known.
    #[error("declares the encoding \"{name}\", which is not known")]
    Unknown {
        /// Its name.
        name: String,
    },
    /// Bytes do not fit the encoding.
    #[error("is no text in {encoding}, which it declares")]
    Malformed {
        /// The encoding.
        encoding: &'static str,
    },
    /// There are bytes that no text has.
    #[error(
        "is no text: byte {at} is not part of a character of UTF-8, and others are control codes"
    )]
    Binary {
        /// The first byte that is not UTF-8.
        at: usize,
    },
}

/// Decodes the bytes of a file.
///
/// # Errors
///
/// [`NotText`] if they are no text, or not in the encoding that they declare. Messages are written to
/// follow the name of the file.
pub fn decoded(bytes: &[u8]) -> Result<Decoded<'_>, NotText> {
    let (encoding, skipped) = match Encoding::for_bom(bytes) {
        Some((encoding, length)) => (Some(encoding), length),
        None => (declared(bytes)?, 0),
    };
    let body = &bytes[skipped..];
    if let Some(encoding) = encoding {
        let whole = encoding.decode_without_bom_handling_and_without_replacement(body);
        let text = whole.ok_or(NotText::Malformed {
            encoding: encoding.name(),
        })?;
        return Ok(Decoded {
            text,
            is_guessed: false,
        });
    }
    let error = match std::str::from_utf8(body) {
        Ok(text) => {
            return Ok(Decoded {
                text: text.into(),
                is_guessed: false,
            });
        }
        Err(error) => error,
    };
    if body
        .iter()
        .any(|byte| *byte < b' ' && !b"\t\n\r\x0c".contains(byte))
    {
        return Err(NotText::Binary {
            at: error.valid_up_to(),
        });
    }
    let (text, _) = WINDOWS_1252.decode_without_bom_handling(body);
    Ok(Decoded {
        text,
        is_guessed: true,
    })
}

/// The encoding that an XML declaration names, or that its first letters show; `None` without one.
fn declared(bytes: &[u8]) -> Result<Option<&'static Encoding>, NotText> {
    if bytes.starts_with(b"<\0?\0") {
        return Ok(Some(UTF_16LE));
    }
    if bytes.starts_with(b"\0<\0?") {
        return Ok(Some(UTF_16BE));
    }
    if !bytes.starts_with(b"<?xml") {
        return Ok(None);
    }
    let head = &bytes[..bytes.len().min(DECLARATION)];
    let head = String::from_utf8_lossy(head);
    let head = head.split_once("?>").map_or("", |(head, _)| head);
    let Some((_, after)) = head.split_once("encoding") else {
        return Ok(None);
    };
    let after = after.trim_start().trim_start_matches('=').trim_start();
    let name = after.split(['"', '\'']).nth(1).unwrap_or_default();
    let encoding = Encoding::for_label(name.as_bytes()).ok_or_else(|| NotText::Unknown {
        name: name.chars().take(40).collect(),
    })?;
    // What begins with ASCII is not in UTF-16, whatever it says; UTF-8 is tried in any case.
    let is_utf = [UTF_8, UTF_16LE, UTF_16BE].contains(&encoding);
    Ok((!is_utf).then_some(encoding))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn utf_16(text: &str, to_bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(to_bytes).collect()
    }

    #[test]
    fn a_text_is_the_same_in_every_encoding() {
        let text = "<?xml version=\"1.0\"?>\n<a b=\"Blattader µm\"/>";
        let whole = Decoded {
            text: text.into(),
            is_guessed: false,
        };
        let marked = format!("\u{feff}{text}");
        for bytes in [
            text.as_bytes().to_vec(),
            marked.as_bytes().to_vec(),
            utf_16(&marked, u16::to_le_bytes),
            utf_16(&marked, u16::to_be_bytes),
            utf_16(text, u16::to_le_bytes),
            utf_16(text, u16::to_be_bytes),
        ] {
            assert_eq!(decoded(&bytes), Ok(whole.clone()));
        }
        let latin_1 = "<?xml version='1.0' encoding='ISO-8859-1'?><a b=\"µm\"/>";
        let bytes: Vec<u8> = latin_1.chars().map(|letter| letter as u8).collect();
        assert_eq!(
            decoded(&bytes).map(|found| (found.text.into_owned(), found.is_guessed)),
            Ok((latin_1.to_owned(), false))
        );
    }

    #[test]
    fn latin_1_that_nothing_declares_is_a_guess_and_what_is_no_text_is_refused() {
        let found = decoded(b"radius_\xb5m,x\n").expect("a table");
        assert_eq!((&*found.text, found.is_guessed), ("radius_µm,x\n", true));
        assert_eq!(decoded(b"PK\x03\x04\xff"), Err(NotText::Binary { at: 4 }));
        let unknown = b"<?xml version='1.0' encoding='leaf'?><a/>";
        assert!(matches!(decoded(unknown), Err(NotText::Unknown { .. })));
        assert!(matches!(
            decoded(b"\xff\xfe<\0\0\xd8"),
            Err(NotText::Malformed { .. })
        ));
    }
}
