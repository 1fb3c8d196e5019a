//! Sums as bytes: rows of blocks that are stored, and added to another film's.
//!
//! - **In**: the sums of a row of blocks; or bytes that [`Film::packed_row`] made.
//! - **Out**: bytes; or the sums of both films.
//! - **Always true**: nothing is rounded, and sums add up exactly. Damaged bytes are
//!   an error, never a panic; what they added until then must be thrown away.
//! - **Left out**: checksums, which the file has.
//!
//! The numbers of a kind in a block (a channel's sums, a channel's squares, a word) have similar
//! sizes. Each is stored without the bytes that are zero below, or repeat the sign above, in all
//! numbers of its kind. Of 189 bytes per pixel of colour, some 65 to 130 remain.

use rayon::prelude::*;

use super::batches::{BATCH, OpenBatches, Squares, series_of};
use super::block::BLOCK_SIDE;
use super::features::Words;
use super::halves::{Halves, octave_of};
use super::moments::Moments;
use super::sums::{Film, MOST_SAMPLES, chunks_or_nothing};

/// Bytes that are not those of a row of this film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DamagedRow;

impl Film {
    /// Number of rows of blocks.
    pub fn rows(&self) -> usize {
        self.drawn.len() / self.blocks_across()
    }

    /// The sums of one row of blocks.
    ///
    /// # Panics
    ///
    /// If there is no such row.
    pub fn packed_row(&self, row: usize) -> Vec<u8> {
        let (across, channels) = (self.blocks_across(), self.channels());
        let words = &self.words;
        let first = row * (BLOCK_SIDE * self.width) as usize;
        let height = self.height_of(row);
        let mut out = Vec::new();
        for (column, &drawn) in self.drawn[row * across..][..across].iter().enumerate() {
            let first = first + column * (BLOCK_SIDE as usize * height);
            let pixels = self.pixels_of(row * across + column) as usize;
            out.extend(drawn.to_le_bytes());
            let moments = &self.moments[first * channels..][..pixels * channels];
            for channel in 0..channels {
                for part in 0..2 {
                    let of = moments[channel..].iter().step_by(channels);
                    pack(&mut out, of.map(|moments| moments.bits()[part]));
                }
            }
            let series = series_of(channels);
            let squares = &self.squares[first * series..][..pixels * series];
            for number in 0..series {
                let of = squares[number..].iter().step_by(series);
                pack(&mut out, of.map(|sum| i128::from(sum.bits())));
            }
            pack_open(&mut out, &self.open[row * across + column]);
            pack_halves(&mut out, &self.halves[row * across + column]);
            let wide = &self.wide[first * words.wide..][..pixels * words.wide];
            for word in 0..words.wide {
                let of = wide[word..].iter().step_by(words.wide);
                pack(&mut out, of.map(|&sum| i128::from(sum)));
            }
            let narrow = &self.narrow[first * words.narrow..][..pixels * words.narrow];
            for word in 0..words.narrow {
                let of = narrow[word..].iter().step_by(words.narrow);
                pack(&mut out, of.map(|&sum| i128::from(sum)));
            }
        }
        out
    }

    /// Lets `add` add packed rows to every row of blocks, on the current thread pool.
    ///
    /// # Errors
    ///
    /// That of the first row, from the top, for which `add` fails.
    pub fn add_rows<E: Send>(
        &mut self,
        add: impl Fn(usize, &mut RowSums<'_>) -> Result<(), E> + Sync,
    ) -> Result<(), E> {
        let (across, rows) = (self.blocks_across(), self.rows());
        let (width, height, channels) = (self.width, self.height, self.channels());
        let words = &self.words;
        let row_pixels = (BLOCK_SIDE * width) as usize;
        let wide = chunks_or_nothing(&mut self.wide, row_pixels * words.wide, rows);
        let results: Vec<Result<(), E>> = self
            .drawn
            .par_chunks_mut(across)
            .zip(self.open.par_chunks_mut(across))
            .zip(self.halves.par_chunks_mut(across))
            .zip(self.moments.par_chunks_mut(row_pixels * channels))
            .zip(
                self.squares
                    .par_chunks_mut(row_pixels * series_of(channels)),
            )
            .zip(wide)
            .zip(self.narrow.par_chunks_mut(row_pixels * words.narrow))
            .with_max_len(1)
            .enumerate()
            .map(
                |(row, ((((((drawn, open), halves), moments), squares), wide), narrow))| {
                    let mut sums = RowSums {
                        width: width as usize,
                        height: BLOCK_SIDE.min(height - row as u32 * BLOCK_SIDE) as usize,
                        channels,
                        words,
                        drawn,
                        open,
                        halves,
                        moments,
                        squares,
                        wide,
                        narrow,
                    };
                    add(row, &mut sums)
                },
            )
            .collect();
        results.into_iter().collect()
    }

    /// Counts of rejected samples and clamped values: the clamped values, then place and count of
    /// each pixel with rejected samples.
    pub fn fault_counts(&self) -> Vec<u64> {
        let rejected = self.faults.rejected.iter();
        let rejected = rejected.flat_map(|(&place, &count)| [place as u64, u64::from(count)]);
        let faults = &self.faults;
        let counts = [faults.clamped, faults.cut, faults.missing].into_iter();
        counts.chain(rejected).collect()
    }

    /// Adds what [`Film::fault_counts`] gave of another film of this size.
    ///
    /// # Errors
    ///
    /// [`DamagedRow`] if it names a pixel that this film does not have.
    pub fn add_fault_counts(&mut self, counts: &[u64]) -> Result<(), DamagedRow> {
        let (&[clamped, cut, missing], rejected) = counts.split_first_chunk().ok_or(DamagedRow)?;
        let pixels = u64::from(self.width) * u64::from(self.height);
        for pair in rejected.chunks(2) {
            let &[place, count] = pair else {
                return Err(DamagedRow);
            };
            let count = u32::try_from(count).map_err(|_| DamagedRow)?;
            if place >= pixels {
                return Err(DamagedRow);
            }
            let own = self.faults.rejected.entry(place as usize).or_default();
            *own = own.checked_add(count).ok_or(DamagedRow)?;
        }
        let faults = &mut self.faults;
        for (own, added) in [
            (&mut faults.clamped, clamped),
            (&mut faults.cut, cut),
            (&mut faults.missing, missing),
        ] {
            *own = own.saturating_add(added);
        }
        Ok(())
    }

    /// Whether no pixel has more rejected samples than samples.
    pub fn is_sound(&self) -> bool {
        let mut rejected = self.faults.rejected.iter();
        rejected.all(|(&place, &count)| count <= self.drawn[self.block_of(place)])
    }

    /// Height of the blocks of a row, pixels.
    fn height_of(&self, row: usize) -> usize {
        BLOCK_SIDE.min(self.height - row as u32 * BLOCK_SIDE) as usize
    }

    /// The block of the pixel at a place.
    fn block_of(&self, place: usize) -> usize {
        let row_pixels = (BLOCK_SIDE * self.width) as usize;
        let row = place / row_pixels;
        let column = place % row_pixels / (BLOCK_SIDE as usize * self.height_of(row));
        row * self.blocks_across() + column
    }
}

/// The sums of a row of blocks, to which those of other films are added.
#[derive(Debug)]
pub struct RowSums<'a> {
    width: usize,
    /// Height of its blocks, pixels.
    height: usize,
    channels: usize,
    words: &'a Words,
    drawn: &'a mut [u32],
    open: &'a mut [OpenBatches],
    halves: &'a mut [Halves],
    moments: &'a mut [Moments],
    squares: &'a mut [Squares],
    wide: &'a mut [i64],
    narrow: &'a mut [i32],
}

impl RowSums<'_> {
    /// Adds what [`Film::packed_row`] made of the same row of a film of the same size and layout.
    ///
    /// # Errors
    ///
    /// [`DamagedRow`] if the bytes are too few, too many or contradict the film.
    pub fn add(&mut self, packed: &[u8]) -> Result<(), DamagedRow> {
        let mut rest = packed;
        let side = BLOCK_SIDE as usize;
        let (channels, words) = (self.channels, self.words);
        let blocks = self.drawn.iter_mut().zip(self.open.iter_mut());
        let blocks = blocks.zip(self.halves.iter_mut());
        for (column, ((drawn, open), halves)) in blocks.enumerate() {
            let first = column * side * self.height;
            let pixels = side.min(self.width - column * side) * self.height;
            let (count, behind) = rest.split_first_chunk().ok_or(DamagedRow)?;
            rest = behind;
            let sum = drawn.checked_add(u32::from_le_bytes(*count));
            *drawn = sum.ok_or(DamagedRow)?;
            let moments = &mut self.moments[first * channels..][..pixels * channels];
            for channel in 0..channels {
                for part in 0..2 {
                    let of = moments[channel..].iter_mut().step_by(channels);
                    rest = unpack(rest, of, |moments, bits| moments.add_bits(part, bits))?;
                }
            }
            let series = series_of(channels);
            let squares = &mut self.squares[first * series..][..pixels * series];
            for number in 0..series {
                let of = squares[number..].iter_mut().step_by(series);
                rest = unpack(rest, of, |sum, bits| sum.add(bits as u64))?;
            }
            rest = unpack_open(rest, open, pixels * series)?;
            open.close(squares);
            rest = unpack_halves(rest, halves, self.height * channels)?;
            if open.samples() > *drawn || halves.samples() != u64::from(*drawn) {
                return Err(DamagedRow);
            }
            let wide = &mut self.wide[first * words.wide..][..pixels * words.wide];
            for word in 0..words.wide {
                let of = wide[word..].iter_mut().step_by(words.wide);
                rest = unpack(rest, of, |sum, bits| *sum = sum.wrapping_add(bits as i64))?;
            }
            let narrow = &mut self.narrow[first * words.narrow..][..pixels * words.narrow];
            for word in 0..words.narrow {
                let of = narrow[word..].iter_mut().step_by(words.narrow);
                rest = unpack(rest, of, |sum, bits| *sum = sum.wrapping_add(bits as i32))?;
            }
        }
        if rest.is_empty() {
            Ok(())
        } else {
            Err(DamagedRow)
        }
    }
}

/// Appends the number of bytes left out below, that of the bytes kept, and these for each number.
fn pack(out: &mut Vec<u8>, numbers: impl Iterator<Item = i128> + Clone) {
    let (mut any, mut size) = (0, 0);
    for number in numbers.clone() {
        any |= number;
        // All bits that differ from the sign.
        size |= number ^ number >> 127;
    }
    if any == 0 {
        out.extend([0, 0]);
        return;
    }
    let below = any.trailing_zeros() / 8;
    let bits_with_sign = 129 - size.leading_zeros();
    let kept = bits_with_sign.div_ceil(8) - below;
    out.extend([below as u8, kept as u8]);
    for number in numbers {
        out.extend_from_slice(&(number >> (8 * below)).to_le_bytes()[..kept as usize]);
    }
}

/// Appends the number of open batches, then number, count and sums of each.
fn pack_open(out: &mut Vec<u8>, open: &OpenBatches) {
    out.extend((open.iter().len() as u16).to_le_bytes());
    for open in open.iter() {
        out.extend(open.number.to_le_bytes());
        out.push(open.count as u8);
        pack(out, open.sums.iter().map(|&sum| i128::from(sum)));
    }
}

/// Adds the packed open batches of a block of so many sums; returns what follows them.
fn unpack_open<'a>(
    bytes: &'a [u8],
    target: &mut OpenBatches,
    count_of_sums: usize,
) -> Result<&'a [u8], DamagedRow> {
    let (&number, mut rest) = bytes.split_first_chunk().ok_or(DamagedRow)?;
    let mut sums = vec![0; count_of_sums];
    for _ in 0..u16::from_le_bytes(number) {
        let (&number, behind) = rest.split_first_chunk().ok_or(DamagedRow)?;
        let (&count, behind) = behind.split_first().ok_or(DamagedRow)?;
        if count == 0 || u32::from(count) >= BATCH {
            return Err(DamagedRow);
        }
        sums.fill(0);
        rest = unpack(behind, sums.iter_mut(), |sum, bits| *sum = bits as i64)?;
        target.add_all(u32::from_le_bytes(number), u32::from(count), &sums);
    }
    Ok(rest)
}

/// Appends the last octave, then for each range of samples its number of samples and its sums.
fn pack_halves(out: &mut Vec<u8>, halves: &Halves) {
    out.extend(halves.last.to_le_bytes());
    for (range, count) in halves.counts.into_iter().enumerate() {
        out.extend(count.to_le_bytes());
        pack(out, halves.sums.iter().map(|sums| i128::from(sums[range])));
    }
}

/// Adds the packed halves of a block of so many sums; returns what follows them.
fn unpack_halves<'a>(
    bytes: &'a [u8],
    target: &mut Halves,
    count_of_sums: usize,
) -> Result<&'a [u8], DamagedRow> {
    let (&last, mut rest) = bytes.split_first_chunk().ok_or(DamagedRow)?;
    let mut halves = Halves {
        last: u32::from_le_bytes(last),
        counts: [0; 3],
        sums: vec![[0; 3]; count_of_sums],
    };
    if halves.last > octave_of(MOST_SAMPLES - 1) {
        return Err(DamagedRow);
    }
    for range in 0..halves.counts.len() {
        let (&count, behind) = rest.split_first_chunk().ok_or(DamagedRow)?;
        halves.counts[range] = u32::from_le_bytes(count);
        let sums = halves.sums.iter_mut().map(|sums| &mut sums[range]);
        rest = unpack(behind, sums, |sum, bits| *sum = bits as i64)?;
    }
    if halves.samples() > 0 {
        target.merge(&halves);
    }
    Ok(rest)
}

/// Gives each of the packed numbers to `add` with its target; returns what follows them.
fn unpack<'a, 'b, T: 'b>(
    bytes: &'a [u8],
    targets: impl ExactSizeIterator<Item = &'b mut T>,
    add: impl Fn(&mut T, i128),
) -> Result<&'a [u8], DamagedRow> {
    let (&[below, kept], bytes) = bytes.split_first_chunk().ok_or(DamagedRow)?;
    let kept = usize::from(kept);
    if usize::from(below) + kept > 16 {
        return Err(DamagedRow);
    }
    if kept == 0 {
        return Ok(bytes);
    }
    let whole = targets.len() * kept;
    if bytes.len() < whole {
        return Err(DamagedRow);
    }
    let (above, below) = (128 - 8 * kept as u32, 8 * u32::from(below));
    for (number, target) in targets.enumerate() {
        let at = number * kept;
        // Sixteen bytes at once wherever there are as many, because copies of other lengths are
        // slow.
        let word = if let Some(word) = bytes[at..].first_chunk() {
            i128::from_le_bytes(*word)
        } else {
            let mut word = [0; 16];
            word[..kept].copy_from_slice(&bytes[at..at + kept]);
            i128::from_le_bytes(word)
        };
        add(target, (word << above >> above) << below);
    }
    Ok(&bytes[whole..])
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::film::tests::added;
    use crate::film::{Series, Sum};
    use properties::fixed;

    /// A film whose border blocks are narrower and lower, with samples that differ from pixel to
    /// pixel, rejected and clamped ones among them.
    fn film(first: u32, end: u32) -> Film {
        let sums = [
            Sum::Wide { fraction_bits: 24 },
            Sum::Narrow { fraction_bits: 22 },
            Sum::First,
        ];
        let mut film = Film::new(21, 13, &[0.25, 0.75], &sums).expect("a small film");
        film.expose(|block| {
            block.expose(end - first, |x, y, pixel| {
                for number in first..end {
                    let wave = ((x * 31 + y * 17 + number * 7) % 101) as f32 - 30.0;
                    let values = match (x + y + number) % 50 {
                        7 => [f32::NAN, 1.0],
                        8 => [1e30, -2e30],
                        _ => [wave * 1e-6, wave * wave],
                    };
                    let features = [wave, wave / 64.0, x as f32];
                    pixel.add(number, &values, (y > 3).then_some(&features));
                }
            });
        });
        film
    }

    #[test]
    fn packed_rows_add_up_to_the_film_in_one_go() {
        let whole = film(0, 300);
        let mut parts = film(0, 0);
        for (first, end) in [(100, 299), (0, 100), (299, 300)] {
            added(&mut parts, &film(first, end));
        }
        assert!(whole.rejected() > 0 && whole.clamped() > 0);
        assert_eq!(parts, whole);
        assert!(parts.is_sound());
    }

    #[test]
    fn damaged_rows_are_errors() {
        let whole = film(0, 20);
        let row = whole.packed_row(0);
        let rest: Vec<_> = (1..whole.rows()).map(|row| whole.packed_row(row)).collect();
        for length in 0..row.len() {
            let mut target = film(0, 0);
            let result = target.add_rows(|_, sums| sums.add(&row[..length]));
            assert_eq!(result, Err(DamagedRow), "{length} bytes");
        }
        for place in 0..row.len() {
            let mut damaged = row.clone();
            damaged[place] ^= 0x55;
            // Whatever is added, nothing panics.
            let rows = |row: usize| if row == 0 { &damaged } else { &rest[row - 1] };
            let mut target = film(0, 0);
            if target.add_rows(|row, sums| sums.add(rows(row))).is_ok() && target.is_sound() {
                let found = target.variance(Series::Luminance);
                assert!(found.iter().all(|found| !found.is_nan()), "byte {place}");
            }
        }
        let mut target = film(0, 0);
        for counts in [
            &[][..],
            &[1, 2],
            &[1, 0, 0, 2],
            &[1, 0, 0, 273, 1],
            &[1, 0, 0, 0, 1 << 40],
        ] {
            assert_eq!(target.add_fault_counts(counts), Err(DamagedRow));
        }
        target
            .add_fault_counts(&[3, 5, 7, 272, 1])
            .expect("the last pixel");
        assert_eq!((target.clamped(), target.cut()), (3, 5));
        assert!(!target.is_sound(), "rejected but never drawn");
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn numbers_of_any_size_come_back(
            numbers in proptest::collection::vec((any::<i128>(), 0_u32..128, 0_u32..128), 1..20),
        ) {
            let numbers: Vec<i128> = numbers.iter().map(|&(n, right, left)| n >> right << left).collect();
            let mut packed = Vec::new();
            pack(&mut packed, numbers.iter().copied());
            let mut back = vec![0; numbers.len()];
            let rest = unpack(&packed, back.iter_mut(), |target, number| *target = number);
            prop_assert_eq!(rest, Ok(&[][..]));
            prop_assert_eq!(back, numbers);
        }
    }
}
