//! One value for each wavelength that a path carries.

use std::array;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// `N` values, one a wavelength; arithmetic goes lane by lane.
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

    /// Applies `f` to every lane.
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// Mean over the lanes: what decisions along a path rest on.
    pub fn mean(self) -> f32 {
        self.0.iter().sum::<f32>() / N as f32
    }

    /// Greatest lane.
    pub fn max_lane(self) -> f32 {
        self.0.iter().copied().fold(f32::NEG_INFINITY, f32::max)
    }

    /// Whether every lane is exactly zero.
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|&lane| lane == 0.0)
    }

    /// Lane-wise smaller one.
    pub fn min(self, other: Self) -> Self {
        Self::from_fn(|i| self.0[i].min(other.0[i]))
    }

    /// Lane-wise greater one.
    pub fn max(self, other: Self) -> Self {
        Self::from_fn(|i| self.0[i].max(other.0[i]))
    }
}

macro_rules! lane_wise {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self::from_fn(|i| self.0[i] $operator other.0[i])
            }
        }
        impl<const N: usize> $trait<f32> for Lanes<N> {
            type Output = Self;
            fn $method(self, other: f32) -> Self {
                Self::from_fn(|i| self.0[i] $operator other)
            }
        }
    };
}

lane_wise!(Add, add, +);
lane_wise!(Sub, sub, -);
lane_wise!(Mul, mul, *);
lane_wise!(Div, div, /);

impl<const N: usize> AddAssign for Lanes<N> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> MulAssign for Lanes<N> {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for Lanes<N> {
    fn mul_assign(&mut self, other: f32) {
        *self = *self * other;
    }
}
