//! The level without vector instructions, the reference for the others.

use super::eight::{Eight, LANES, Row, of_two_rows};
use super::wide::Halves;

#[derive(Clone, Copy)]
pub(super) struct Scalar;

#[inline(always)]
fn lanes(f: impl FnMut(usize) -> f32) -> Row {
    Row(std::array::from_fn(f))
}

#[inline(always)]
fn bits(mut f: impl FnMut(usize) -> bool) -> u32 {
    (0..LANES).fold(0, |bits, lane| bits | u32::from(f(lane)) << lane)
}

impl Eight for Scalar {
    type F = Row;

    #[inline(always)]
    fn splat(self, value: f32) -> Row {
        Row([value; LANES])
    }

    #[inline(always)]
    fn load(self, row: &Row) -> Row {
        *row
    }

    #[inline(always)]
    fn store(self, row: Row) -> Row {
        row
    }

    of_two_rows! { Row:
        add(a, b) -> Row { lanes(|i| a.0[i] + b.0[i]) }
        sub(a, b) -> Row { lanes(|i| a.0[i] - b.0[i]) }
        mul(a, b) -> Row { lanes(|i| a.0[i] * b.0[i]) }
        div(a, b) -> Row { lanes(|i| a.0[i] / b.0[i]) }
        less(a, b) -> Row { lanes(|i| if a.0[i] < b.0[i] { a.0[i] } else { b.0[i] }) }
        greater(a, b) -> Row { lanes(|i| if a.0[i] > b.0[i] { a.0[i] } else { b.0[i] }) }
        at_most(a, b) -> u32 { bits(|i| a.0[i] <= b.0[i]) }
        below(a, b) -> u32 { bits(|i| a.0[i] < b.0[i]) }
    }
}

impl Halves for Scalar {}
