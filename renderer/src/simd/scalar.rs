//! The level without vector instructions, the reference for the others.

use super::wide::Halves;
use super::{Eight, LANES, Row};

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

    #[inline(always)]
    fn add(self, a: Row, b: Row) -> Row {
        lanes(|i| a.0[i] + b.0[i])
    }

    #[inline(always)]
    fn sub(self, a: Row, b: Row) -> Row {
        lanes(|i| a.0[i] - b.0[i])
    }

    #[inline(always)]
    fn mul(self, a: Row, b: Row) -> Row {
        lanes(|i| a.0[i] * b.0[i])
    }

    #[inline(always)]
    fn div(self, a: Row, b: Row) -> Row {
        lanes(|i| a.0[i] / b.0[i])
    }

    #[inline(always)]
    fn less(self, a: Row, b: Row) -> Row {
        lanes(|i| if a.0[i] < b.0[i] { a.0[i] } else { b.0[i] })
    }

    #[inline(always)]
    fn greater(self, a: Row, b: Row) -> Row {
        lanes(|i| if a.0[i] > b.0[i] { a.0[i] } else { b.0[i] })
    }

    #[inline(always)]
    fn at_most(self, a: Row, b: Row) -> u32 {
        bits(|i| a.0[i] <= b.0[i])
    }

    #[inline(always)]
    fn below(self, a: Row, b: Row) -> u32 {
        bits(|i| a.0[i] < b.0[i])
    }
}

impl Halves for Scalar {}
