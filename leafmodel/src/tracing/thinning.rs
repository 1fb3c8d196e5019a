//! Thinning: from veins with widths to lines one pixel wide, with the same topology.
//!
//! Pixels are taken away in the order of their distance from the edge, so that what stays runs in
//! the middle. A pixel is taken away only if it is *simple*: the parts that hang together and the
//! holes stay the same ones. Ends of lines stay.
//!
//! # Source
//!
//! \[pudney1998\], distance-ordered homotopic thinning, in the plane, with ends of lines as what
//! stays. The test of simple pixels is the crossing number of \[yokoi1975\] for sets joined by
//! corners.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::grid::{Mask, beside};

/// For each of the 256 neighbourhoods whether the pixel in the middle may go; bit `k` is the
/// neighbour that the `k`-th step leads to.
static MAY_GO: [bool; 256] = neighbourhoods();

const fn neighbourhoods() -> [bool; 256] {
    let mut may_go = [false; 256];
    let mut bits = 0;
    while bits < 256 {
        may_go[bits] = is_simple(bits) && !is_end(bits);
        bits += 1;
    }
    may_go
}

const fn is_in(bits: usize, neighbour: usize) -> bool {
    bits >> (neighbour % 8) & 1 == 1
}

/// Whether the crossing number is 1: one part of the set around the pixel, and a gap at a side.
const fn is_simple(bits: usize) -> bool {
    let (mut crossings, mut side) = (0, 0);
    while side < 8 {
        let gap = !is_in(bits, side);
        if gap && (is_in(bits, side + 1) || is_in(bits, side + 2)) {
            crossings += 1;
        }
        side += 2;
    }
    crossings == 1
}

/// Whether the pixel is the end of a line: it has one neighbour, or two that share a side. Without
/// the latter, lines two pixels wide would be eaten up from their ends.
const fn is_end(bits: usize) -> bool {
    let (mut count, mut pairs, mut neighbour) = (0, 0, 0);
    while neighbour < 8 {
        if is_in(bits, neighbour) {
            count += 1;
            if is_in(bits, neighbour + 1) {
                pairs += 1;
            }
        }
        neighbour += 1;
    }
    count == 1 || count == 2 && pairs == 1
}

/// The neighbourhood of a cell.
fn neighbourhood(set: &Mask, cell: usize, steps: &[isize; 8]) -> usize {
    let mut bits = 0;
    for (neighbour, step) in steps.iter().enumerate() {
        bits |= usize::from(set.cells[beside(cell, *step)]) << neighbour;
    }
    bits
}

/// Thins a set, whose squares of distances are given, to lines.
pub(super) fn thinned(mut set: Mask, squares: &[u32]) -> Mask {
    let steps = set.steps();
    let mut is_waiting = vec![false; set.cells.len()];
    let first = (0..set.cells.len()).filter(|&cell| squares[cell] == 1);
    // The least distance comes first, then the pixel that began to wait first: pixels of one
    // distance go in rounds, from all sides alike.
    let mut round = 0_u64;
    let mut waiting: BinaryHeap<Reverse<(u32, u64, u32)>> = first
        .map(|cell| {
            is_waiting[cell] = true;
            round += 1;
            Reverse((squares[cell], round, cell as u32))
        })
        .collect();
    while let Some(Reverse((_, _, cell))) = waiting.pop() {
        let cell = cell as usize;
        is_waiting[cell] = false;
        if !MAY_GO[neighbourhood(&set, cell, &steps)] {
            continue;
        }
        set.cells[cell] = false;
        for step in steps {
            let other = beside(cell, step);
            if set.cells[other] && !is_waiting[other] {
                is_waiting[other] = true;
                round += 1;
                waiting.push(Reverse((squares[other], round, other as u32)));
            }
        }
    }
    set
}
