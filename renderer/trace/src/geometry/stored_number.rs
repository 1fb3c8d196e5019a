//! Numbers as other programs store them in binary files.

/// How a number is stored, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoredNumber {
    /// A float of 4 bytes.
    F32,
    /// One of 8 bytes.
    F64,
    /// An integer of so many bytes.
    Signed(usize),
    /// One without a sign.
    Unsigned(usize),
}

impl StoredNumber {
    /// Its bytes.
    pub fn size(self) -> usize {
        match self {
            Self::F32 => 4,
            Self::F64 => 8,
            Self::Signed(size) | Self::Unsigned(size) => size,
        }
    }

    /// The number in [`StoredNumber::size`] bytes.
    pub fn read(self, bytes: &[u8]) -> f64 {
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        let unsigned = u64::from_le_bytes(word);
        match self {
            Self::F32 => f64::from(f32::from_bits(unsigned as u32)),
            Self::F64 => f64::from_bits(unsigned),
            Self::Signed(size) => {
                let unused = 64 - 8 * size as u32;
                ((unsigned << unused).cast_signed() >> unused) as f64
            }
            Self::Unsigned(_) => unsigned as f64,
        }
    }
}
