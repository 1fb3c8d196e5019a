//! The noise of the article's shader: OSL's `cellnoise` of an integer.
//!
//! The Open Shading Language specifies a constant pseudo-random value for each integer. Its
//! implementation hashes one word by Jenkins' lookup3 (public domain, 2006) with the initial
//! value 13.

/// `cellnoise(k)`, 0 to 1.
pub(super) fn cell_noise(k: u32) -> f64 {
    let start = 0xdead_beef_u32.wrapping_add(4).wrapping_add(13);
    let [_, _, hash] = last_mix([start.wrapping_add(k), start, start]);
    f64::from(hash) / f64::from(u32::MAX)
}

/// lookup3's mixing of the last words: each of seven rounds changes one word by the next.
fn last_mix(mut words: [u32; 3]) -> [u32; 3] {
    // The word that is changed, the word that changes it, and the number of bits by which the
    // latter is rotated.
    const ROUNDS: [(usize, usize, u32); 7] = [
        (2, 1, 14),
        (0, 2, 11),
        (1, 0, 25),
        (2, 1, 16),
        (0, 2, 4),
        (1, 0, 14),
        (2, 1, 24),
    ];
    for (word, by, bits) in ROUNDS {
        words[word] = (words[word] ^ words[by]).wrapping_sub(words[by].rotate_left(bits));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    /// lookup3's mixing of words before the last. A single word never needs it; a test does.
    fn mix([mut a, mut b, mut c]: [u32; 3]) -> [u32; 3] {
        for bits in [[4, 6, 8], [16, 19, 4]] {
            a = a.wrapping_sub(c) ^ c.rotate_left(bits[0]);
            c = c.wrapping_add(b);
            b = b.wrapping_sub(a) ^ a.rotate_left(bits[1]);
            a = a.wrapping_add(c);
            c = c.wrapping_sub(b) ^ b.rotate_left(bits[2]);
            b = b.wrapping_add(a);
        }
        [a, b, c]
    }

    /// lookup3's hash of bytes.
    fn hash(bytes: &[u8], initial: u32) -> u32 {
        let start = 0xdead_beef_u32
            .wrapping_add(bytes.len() as u32)
            .wrapping_add(initial);
        let mut words = [start; 3];
        let mut blocks = bytes.chunks(12).peekable();
        while let Some(block) = blocks.next() {
            for (i, byte) in block.iter().enumerate() {
                words[i / 4] = words[i / 4].wrapping_add(u32::from(*byte) << (8 * (i % 4)));
            }
            words = if blocks.peek().is_some() {
                mix(words)
            } else {
                last_mix(words)
            };
        }
        words[2]
    }

    #[test]
    fn the_hash_is_lookup3s_by_the_values_that_its_author_gives() {
        let text = b"Four score and seven years ago";
        assert_eq!(hash(text, 0), 0x1777_0551);
        assert_eq!(hash(text, 1), 0xcd62_8161);
        for k in [0_u32, 52, 59, u32::MAX] {
            let expected = f64::from(hash(&k.to_le_bytes(), 13)) / f64::from(u32::MAX);
            assert_eq!(cell_noise(k), expected);
        }
    }
}
