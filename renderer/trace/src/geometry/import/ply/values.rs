//! The values of a PLY file, one after the other.

use super::header::{Body, Format, Kind};
use crate::geometry::import::raw::{ImportError, shown};
use crate::geometry::stored_number::StoredNumber;

/// A place in the values of a file.
#[derive(Debug)]
pub(super) struct Values<'a> {
    format: Format,
    bytes: &'a [u8],
    byte: usize,
    line: usize,
}

impl<'a> Values<'a> {
    pub(super) fn new(format: Format, bytes: &'a [u8], body: Body) -> Self {
        Self {
            format,
            bytes,
            byte: body.byte,
            line: body.line,
        }
    }

    /// An error at this place.
    pub(super) fn wrong(&self, what: String) -> ImportError {
        match self.format {
            Format::Ascii => ImportError::Line {
                line: self.line,
                what,
            },
            Format::LittleEndian | Format::BigEndian => ImportError::Byte {
                byte: self.byte,
                what,
            },
        }
    }

    /// The next number.
    pub(super) fn scalar(&mut self, scalar: StoredNumber) -> Result<f64, ImportError> {
        if self.format == Format::Ascii {
            let word = self.word()?;
            let number: f64 = word
                .parse()
                .map_err(|_| self.wrong(format!("{} is not a number", shown(word))))?;
            return Ok(number);
        }
        let size = scalar.size();
        let Some(bytes) = self.bytes[self.byte..].get(..size) else {
            return Err(self.wrong("the file ends before all that its header claims".to_owned()));
        };
        self.byte += size;
        let mut word = [0; 8];
        let word = &mut word[..size];
        word.copy_from_slice(bytes);
        if self.format == Format::BigEndian {
            word.reverse();
        }
        Ok(scalar.read(word))
    }

    /// Reads a value that nobody asks for.
    pub(super) fn pass_over(&mut self, kind: Kind) -> Result<(), ImportError> {
        match kind {
            Kind::Scalar(scalar) => self.scalar(scalar).map(|_| ()),
            Kind::List { count, item } => self.list(count, item, |_| Ok(())),
        }
    }

    /// Reads a list: its length, then its numbers, each of which is passed to `item`.
    pub(super) fn list(
        &mut self,
        count: StoredNumber,
        kind: StoredNumber,
        mut item: impl FnMut(f64) -> Result<(), String>,
    ) -> Result<(), ImportError> {
        let length = self.scalar(count)?;
        if length < 0.0 || length.fract() != 0.0 {
            return Err(self.wrong(format!("{length} is not the length of a list")));
        }
        for _ in 0..length as u64 {
            let value = self.scalar(kind)?;
            item(value).map_err(|what| self.wrong(what))?;
        }
        Ok(())
    }

    /// Ends a vertex or a face; in a text file that is the end of a line.
    pub(super) fn end_of_item(&mut self) -> Result<(), ImportError> {
        if self.format != Format::Ascii {
            return Ok(());
        }
        while let Some(&byte) = self.bytes.get(self.byte) {
            match byte {
                b'\n' => {
                    self.byte += 1;
                    self.line += 1;
                    return Ok(());
                }
                b' ' | b'\t' | b'\r' => self.byte += 1,
                _ => return Err(self.wrong("more numbers than the header says".to_owned())),
            }
        }
        Ok(())
    }

    /// The next word of this line; empty lines are skipped at the beginning of an item only,
    /// because a line that ends too early must not continue on the next.
    fn word(&mut self) -> Result<&'a str, ImportError> {
        let mut at_start = self.byte == 0 || self.bytes[self.byte - 1] == b'\n';
        loop {
            match self.bytes.get(self.byte) {
                Some(b' ' | b'\t' | b'\r') => self.byte += 1,
                Some(b'\n') if at_start => {
                    self.byte += 1;
                    self.line += 1;
                    at_start = true;
                }
                Some(b'\n') => {
                    return Err(self.wrong("fewer numbers than the header says".to_owned()));
                }
                None => {
                    return Err(
                        self.wrong("the file ends before all that its header claims".to_owned())
                    );
                }
                Some(_) => break,
            }
        }
        let rest = &self.bytes[self.byte..];
        let length = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let word =
            std::str::from_utf8(&rest[..length]).map_err(|_| self.wrong("not text".to_owned()))?;
        self.byte += length;
        Ok(word)
    }
}
