//! One value for each wavelength that a path carries.

use std::array;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// `N` values, one per wavelength; arithmetic is lane by lane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lanes<const N: usize>(pub [f32; N]);

impl<const N: usize> Lanes<N> {
    /// Zero in every lane.
    pub const ZERO: Self = Self([0.0; N]);
    /// One in every lane.
    pub const ONE: Self = Self([1.0; N]);

    /// The same value in every lane.
    pub const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// The value that `f` gives for each lane's number.
    pub fn from_fn(f: impl FnMut(usize) -> f32) -> Self {
        Self(array::from_fn(f))
    }

    /// Sum over the lanes, by halves, which takes three steps for eight lanes.
    #[inline]
    pub fn sum(self) -> f32 {
        let mut values = self.0;
        let mut count = N;
        while count > 1 && count.is_multiple_of(2) {
            count /= 2;
            for i in 0..count {
                values[i] += values[i + count];
            }
        }
        values[..count].iter().sum()
    }

    /// Mean over the lanes.
    pub fn mean(self) -> f32 {
        self.sum() / N as f32
    }

    /// Greatest lane.
    pub fn max_lane(self) -> f32 {
        let mut greatest = self.0[0];
        for &lane in &self.0 {
            greatest = if lane > greatest { lane } else { greatest };
        }
        greatest
    }

    /// Whether every lane is exactly zero.
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|&lane| lane == 0.0)
    }
}

macro_rules! lane_wise {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut result = self;
                for i in 0..N {
                    result.0[i] = self.0[i] $operator other.0[i];
                }
                result
            }
        }
        impl<const N: usize> $trait<f32> for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                let mut result = self;
                for i in 0..N {
                    result.0[i] = self.0[i] $operator other;
                }
                result
            }
        }
    };
}

lane_wise!(Add, add, +);
lane_wise!(Sub, sub, -);
lane_wise!(Mul, mul, *);
lane_wise!(Div, div, /);

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> MulAssign for Lanes<N> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for Lanes<N> {
    #[inline(always)]
    fn mul_assign(&mut self, other: f32) {
        *self = *self * other;
    }
}
