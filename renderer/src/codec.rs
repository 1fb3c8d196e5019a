//! Values as bytes, for files that programs of one version keep for themselves: checkpoints, parts, grown leaves.
//!
//! - **In**: values whose types derive serde's traits; or a file's bytes.
//! - **Out**: bytes in postcard's format, in sections of a length, a checksum and that many bytes.
//! - **Always true**: whatever bytes hold, reading ends with a value or with `None`, and no count in
//!   them is trusted with memory.
//! - **Left out**: what a file begins with, and which version has written it.

use std::io::{self, Read, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A value as bytes.
pub(crate) fn to_bytes(value: &impl Serialize) -> Vec<u8> {
    postcard::to_allocvec(value).expect("memory takes all bytes, and lists know their lengths")
}

/// The value that these bytes encode; `None` if they are something else or some are left over.
pub(crate) fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (value, rest) = postcard::take_from_bytes(bytes).ok()?;
    rest.is_empty().then_some(value)
}

/// What stands before the bytes of a section.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SectionHead {
    /// Number of bytes.
    pub(crate) length: u64,
    checksum: u32,
}

impl SectionHead {
    /// Bytes that it takes.
    pub(crate) const LENGTH: u64 = 12;

    /// Reads the head of a section.
    ///
    /// # Errors
    ///
    /// What the system reports; [`io::ErrorKind::UnexpectedEof`] if the file ends in it.
    pub(crate) fn read(file: &mut impl Read) -> io::Result<Self> {
        let (mut length, mut checksum) = ([0; 8], [0; 4]);
        file.read_exact(&mut length)?;
        file.read_exact(&mut checksum)?;
        Ok(Self {
            length: u64::from_le_bytes(length),
            checksum: u32::from_le_bytes(checksum),
        })
    }

    /// Reads the bytes behind it; `None` if some are missing or the checksum is wrong.
    ///
    /// # Errors
    ///
    /// What the system reports.
    pub(crate) fn bytes(self, file: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
        let mut bytes = Vec::new();
        file.take(self.length).read_to_end(&mut bytes)?;
        let is_whole = bytes.len() as u64 == self.length;
        Ok((is_whole && crc32fast::hash(&bytes) == self.checksum).then_some(bytes))
    }
}

/// Writes a section.
///
/// # Errors
///
/// What the system reports.
pub(crate) fn write_section(file: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    file.write_all(&(bytes.len() as u64).to_le_bytes())?;
    file.write_all(&crc32fast::hash(bytes).to_le_bytes())?;
    file.write_all(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_back_and_other_bytes_are_refused() {
        let value = (vec![[1.5_f32; 3]; 4], "ä".to_owned(), Some(u64::MAX));
        let bytes = to_bytes(&value);
        assert_eq!(from_bytes(&bytes), Some(value.clone()));
        for length in 0..bytes.len() {
            assert_eq!(
                from_bytes::<(Vec<[f32; 3]>, String, Option<u64>)>(&bytes[..length]),
                None
            );
        }
        let longer = [&bytes[..], &[0]].concat();
        assert_eq!(
            from_bytes::<(Vec<[f32; 3]>, String, Option<u64>)>(&longer),
            None
        );
        // A list that claims to be longer than memory.
        assert_eq!(
            from_bytes::<Vec<[f64; 4]>>(&[0xff, 0xff, 0xff, 0xff, 0xff, 0x0f]),
            None
        );
    }

    #[test]
    fn a_section_is_whole_or_nothing() {
        let mut file = Vec::new();
        write_section(&mut file, b"sums").expect("memory takes all bytes");
        assert_eq!(file.len() as u64, SectionHead::LENGTH + 4);
        let read = |file: &[u8]| {
            let mut file = file;
            SectionHead::read(&mut file).and_then(|head| head.bytes(&mut file))
        };
        assert_eq!(read(&file).expect("memory"), Some(b"sums".to_vec()));
        for place in 0..file.len() {
            let mut flipped = file.clone();
            flipped[place] ^= 4;
            assert_eq!(read(&flipped).expect("memory"), None, "{place}");
            assert!(!matches!(read(&file[..place]), Ok(Some(_))));
        }
    }
}
