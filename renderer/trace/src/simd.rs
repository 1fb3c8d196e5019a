//! Eight or sixteen `f32` numbers at a time, on whatever vector unit the machine has.
//!
//! Kernels are written once over `Eight` and compiled for each instruction set; which one runs is
//! chosen when the program starts ([`Level::best`]). Operations on eight numbers are those that
//! IEEE 754 rounds correctly, so that every level gives the same bits. Those on sixteen
//! (`Sixteen`) are rough, for bounds that leave room for it.
//!
//! - **In**: rows of eight numbers, or of sixteen.
//! - **Out**: rows of as many numbers, or a bit for each lane.
//! - **Always true**: lane `i` of a result depends on lane `i` of the operands alone; of a row of
//!   eight it has the same bits at every level.
//!
//! ```
//! use trace::simd::Level;
//!
//! // The best level is the last of those that this machine has; `scalar` is everywhere.
//! let levels = Level::all();
//! assert_eq!(levels[0].name(), "scalar");
//! assert_eq!(levels.last(), Some(&Level::best()));
//! ```
#![allow(
    unsafe_code,
    reason = "intrinsics; a token of a level exists only where its instructions do"
)]

mod eight;
#[cfg(target_arch = "aarch64")]
mod neon;
mod scalar;
mod stack;
mod whole;
mod wide;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use self::eight::{Eight, LANES, Row};
use self::scalar::Scalar;
pub(crate) use self::stack::Stack;
pub(crate) use self::whole::whole;
pub(crate) use self::wide::{Sixteen, Task, WIDE, WideRow};

/// Prefetches the memory of an element; places outside the slice do no harm. Only x86-64 has it in
/// stable Rust.
#[inline(always)]
#[cfg_attr(
    not(target_arch = "x86_64"),
    allow(unused_variables, reason = "nothing is prefetched there")
)]
pub(crate) fn prefetch<T>(slice: &[T], place: usize) {
    #[cfg(target_arch = "x86_64")]
    x86::prefetch(slice, place);
}

/// A set of vector instructions that this machine has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Scalar,
    #[cfg(target_arch = "x86_64")]
    Sse2,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "aarch64")]
    Neon,
}

impl Level {
    /// The levels that run here, the slowest first.
    pub fn all() -> Vec<Self> {
        #[allow(
            unused_mut,
            reason = "on other processors there is the one level alone"
        )]
        let mut levels = vec![Self(Kind::Scalar)];
        #[cfg(target_arch = "x86_64")]
        {
            levels.push(Self(Kind::Sse2));
            if x86::has_avx2() {
                levels.push(Self(Kind::Avx2));
            }
        }
        #[cfg(target_arch = "aarch64")]
        levels.push(Self(Kind::Neon));
        levels
    }

    /// The fastest level that runs here.
    pub fn best() -> Self {
        *Self::all().last().expect("one level runs everywhere")
    }

    /// Its name: `scalar`, `sse2`, `avx2` or `neon`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Kind::Scalar => "scalar",
            #[cfg(target_arch = "x86_64")]
            Kind::Sse2 => "sse2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => "avx2",
            #[cfg(target_arch = "aarch64")]
            Kind::Neon => "neon",
        }
    }

    /// Runs a task with the instructions of this level.
    #[inline]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            Kind::Scalar => task.run(Scalar),
            #[cfg(target_arch = "x86_64")]
            Kind::Sse2 => task.run(x86::Sse2),
            // SAFETY: `Level` has no public constructor; `all` makes this one where `has_avx2` is
            // true.
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => unsafe { x86::with_avx2(task) },
            #[cfg(target_arch = "aarch64")]
            Kind::Neon => task.run(neon::Neon),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on two rows.
    struct Operations(Row, Row);

    impl Task for Operations {
        type Output = ([Row; 6], [u32; 2]);

        #[inline(always)]
        fn run<E: Sixteen>(self, eight: E) -> Self::Output {
            let (a, b) = (eight.load(&self.0), eight.load(&self.1));
            let rows = [
                eight.add(a, b),
                eight.sub(a, b),
                eight.mul(a, b),
                eight.div(a, b),
                eight.less(a, b),
                eight.greater(a, eight.splat(self.1.0[0])),
            ];
            let bits = [eight.at_most(a, b), eight.below(a, b)];
            (rows.map(|row| eight.store(row)), bits)
        }
    }

    #[test]
    fn every_level_gives_the_same_bits() {
        let odd = [
            0.0,
            -0.0,
            1.0,
            -3.5,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e-42,
            f32::MAX,
            0.1,
        ];
        for shift in 0..odd.len() {
            for step in 1..odd.len() {
                let row = |start: usize, step: usize| {
                    Row(std::array::from_fn(|i| odd[(start + i * step) % odd.len()]))
                };
                let (a, b) = (row(0, 1), row(shift, step));
                let bits = |(rows, bits): ([Row; 6], [u32; 2])| {
                    // The bits of a NaN depend on the machine, so the test ignores them.
                    let words = rows.map(|row| {
                        row.0
                            .map(|value| if value.is_nan() { 1 } else { value.to_bits() })
                    });
                    (words, bits)
                };
                let expected = bits(Level(Kind::Scalar).run(Operations(a, b)));
                for level in Level::all() {
                    let got = bits(level.run(Operations(a, b)));
                    assert_eq!(got, expected, "{} on {a:?} and {b:?}", level.name());
                }
            }
        }
    }
}
