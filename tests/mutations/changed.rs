//! Files changed at random, the same for each number.

use support::mixer;

/// Bytes that mean something to one format or another.
const BYTES: &[u8] =
    b"[]{}=\"'#,.-+_/\n\t 0123456789eEnxaifMLCQAZ<>&;\\\x00\x01\x7f\x80\x1b\xc3\xa4\xff";

/// Words in place of a number in a text.
const NUMBERS: [&str; 16] = [
    "0",
    "-0",
    "-1",
    "1",
    "1e-300",
    "1e400",
    "-1e38",
    "nan",
    "inf",
    "-inf",
    "4294967295",
    "2147483648",
    "18446744073709551616",
    "99999999",
    "0.5",
    "",
];

/// Values in place of an integer in a binary file.
const INTEGERS: [u64; 10] = [
    0,
    1,
    0x7f,
    0xff,
    0xffff,
    0x0001_0000,
    0x7fff_ffff,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    0xffff_ffff_ffff_ffff,
];

/// A well-mixed number for each counter.
fn mixed(counter: u64) -> u64 {
    mixer::mixed(counter.wrapping_mul(mixer::STEP))
}

/// Random numbers of one case.
struct Draws {
    case: u64,
    count: u64,
}

impl Draws {
    fn below(&mut self, most: usize) -> usize {
        self.count += 1;
        let drawn = mixed(mixed(self.case).wrapping_add(self.count));
        (drawn % most.max(1) as u64) as usize
    }
}

/// One of the seeds with one to four changes; half of all have one.
pub(crate) fn changed(seeds: &[Vec<u8>], case: u64) -> Vec<u8> {
    let mut draws = Draws { case, count: 0 };
    let mut bytes = seeds[draws.below(seeds.len())].clone();
    let more = draws.below(2) * draws.below(4);
    for _ in 0..=more {
        change(&mut bytes, seeds, &mut draws);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, seeds: &[Vec<u8>], draws: &mut Draws) {
    if bytes.is_empty() {
        bytes.push(BYTES[draws.below(BYTES.len())]);
        return;
    }
    let at = draws.below(bytes.len());
    let piece = at..(at + 1 + draws.below(40)).min(bytes.len());
    match draws.below(12) {
        0 => bytes[at] = BYTES[draws.below(BYTES.len())],
        1 => bytes[at] ^= 1 << draws.below(8),
        2 => drop(bytes.remove(at)),
        3 => bytes.insert(at, BYTES[draws.below(BYTES.len())]),
        // A piece doubled, left out, or moved.
        4 => {
            let doubled = bytes[piece].to_vec();
            bytes.splice(at..at, doubled);
        }
        5 => drop(bytes.drain(piece)),
        6 => {
            let moved: Vec<u8> = bytes.drain(piece).collect();
            let to = draws.below(bytes.len() + 1);
            bytes.splice(to..to, moved);
        }
        // The end left out, or that of another file.
        7 => bytes.truncate(at),
        8 => {
            let other = &seeds[draws.below(seeds.len())];
            bytes.truncate(at);
            bytes.extend(&other[draws.below(other.len())..]);
        }
        9 => overwrite(bytes, at, draws),
        _ => renumber(bytes, at, draws),
    }
}

/// An integer of two, four or eight bytes, either end first.
fn overwrite(bytes: &mut [u8], at: usize, draws: &mut Draws) {
    let value = INTEGERS[draws.below(INTEGERS.len())];
    let width = [2, 4, 8][draws.below(3)].min(bytes.len() - at);
    let mut word = value.to_le_bytes();
    if draws.below(2) == 1 {
        word[..width].reverse();
    }
    bytes[at..at + width].copy_from_slice(&word[..width]);
}

/// Another number in place of the next one of a text.
fn renumber(bytes: &mut Vec<u8>, at: usize, draws: &mut Draws) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b".-+eE".contains(byte);
    let Some(start) = bytes[at..].iter().position(u8::is_ascii_digit) else {
        return;
    };
    let start = at + start;
    let rest = &bytes[start..];
    let end = start
        + rest
            .iter()
            .position(|byte| !is_part(byte))
            .unwrap_or(rest.len());
    bytes.splice(start..end, NUMBERS[draws.below(NUMBERS.len())].bytes());
}
