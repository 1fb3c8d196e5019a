//! Texels of several numbers as bytes that pack well.
//!
//! Number by number: one that is the same in all texels takes four bytes; of others come first the lowest bytes of
//! all texels, then the next ones. Used by `#[serde(with = "planes")]`.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::surface::SlopeMoments;
use crate::optics::{Constituent, PerConstituent, Texel};

/// A texel of `N` numbers.
pub(super) trait Numbers<const N: usize>: Copy {
    fn numbers(self) -> [f32; N];
    fn of(numbers: [f32; N]) -> Self;
}

impl<const N: usize> Numbers<N> for [f32; N] {
    fn numbers(self) -> [f32; N] {
        self
    }

    fn of(numbers: [f32; N]) -> Self {
        numbers
    }
}

impl Numbers<8> for [SlopeMoments; 2] {
    fn numbers(self) -> [f32; 8] {
        std::array::from_fn(|i| self.as_flattened()[i])
    }

    fn of(numbers: [f32; 8]) -> Self {
        std::array::from_fn(|face| std::array::from_fn(|i| numbers[4 * face + i]))
    }
}

impl Numbers<{ Constituent::COUNT }> for Texel {
    fn numbers(self) -> [f32; Constituent::COUNT] {
        *self.as_array()
    }

    fn of(numbers: [f32; Constituent::COUNT]) -> Self {
        PerConstituent::new(numbers)
    }
}

pub(super) fn serialize<const N: usize, T: Numbers<N>, S: Serializer>(
    texels: &[T],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut bytes = Vec::new();
    for plane in 0..N {
        let numbers = texels.iter().map(|texel| texel.numbers()[plane].to_bits());
        let first = numbers.clone().next().unwrap_or_default();
        let is_even = numbers.clone().all(|number| number == first);
        bytes.push(u8::from(is_even));
        if is_even {
            bytes.extend(first.to_le_bytes());
        } else {
            for byte in 0..4 {
                bytes.extend(numbers.clone().map(|number| number.to_le_bytes()[byte]));
            }
        }
    }
    (texels.len(), Bytes(&bytes)).serialize(serializer)
}

/// Bytes as a whole, not one by one.
struct Bytes<'a>(&'a [u8]);

impl Serialize for Bytes<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.0)
    }
}

pub(super) fn deserialize<'de, const N: usize, T: Numbers<N>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    let (count, mut rest) = <(usize, &[u8])>::deserialize(deserializer)?;
    if count > MOST_TEXELS {
        return Err(D::Error::custom("more texels than a map can have"));
    }
    let mut texels = vec![[0.0; N]; count];
    for plane in 0..N {
        let mut take = |length: usize| {
            let (taken, after) = rest
                .split_at_checked(length)
                .ok_or_else(|| D::Error::custom("planes of texels are too short"))?;
            rest = after;
            Ok(taken)
        };
        if take(1)? == [1] {
            let bytes = take(4)?;
            let number = f32::from_le_bytes(std::array::from_fn(|byte| bytes[byte]));
            for texel in &mut texels {
                texel[plane] = number;
            }
        } else {
            let [a, b, c, d] = [take(count)?, take(count)?, take(count)?, take(count)?];
            let bytes = a.iter().zip(b).zip(c.iter().zip(d));
            for (texel, ((&a, &b), (&c, &d))) in texels.iter_mut().zip(bytes) {
                texel[plane] = f32::from_le_bytes([a, b, c, d]);
            }
        }
    }
    Ok(texels.into_iter().map(T::of).collect())
}

/// Texels of the largest map, 8192 along both sides.
const MOST_TEXELS: usize = 8192 * 8192;

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    #[derive(Debug, Deserialize, PartialEq, Serialize)]
    struct Map {
        #[serde(with = "super")]
        texels: Vec<[f32; 3]>,
    }

    #[test]
    fn texels_come_back_bit_for_bit_and_short_bytes_are_refused() {
        let number = |i: u16| f32::from(i) / 7.0;
        let texels = (0..500).map(|i| [number(i), 0.25, -number(i)]).collect();
        let map = Map { texels };
        let bytes = postcard::to_allocvec(&map).expect("memory takes all bytes");
        let back: Map = postcard::from_bytes(&bytes).expect("it is whole");
        let bits = |map: &Map| -> Vec<[u32; 3]> {
            map.texels
                .iter()
                .map(|texel| texel.map(f32::to_bits))
                .collect()
        };
        assert_eq!(bits(&back), bits(&map));
        // Two planes of 500 numbers and one even one.
        assert!(bytes.len() < 2 * 2000 + 20, "{}", bytes.len());
        for length in [0, 1, 3, 500, bytes.len() - 1] {
            assert!(postcard::from_bytes::<Map>(&bytes[..length]).is_err());
        }
        let endless = postcard::to_allocvec(&(usize::MAX, &[1_u8][..])).expect("memory");
        assert!(postcard::from_bytes::<Map>(&endless).is_err());
    }
}
