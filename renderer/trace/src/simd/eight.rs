//! Rows of eight numbers, and the operations on them.

/// Number of lanes of a row.
pub(crate) const LANES: usize = 8;

/// A row of numbers, aligned for the widest unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Row(pub(crate) [f32; LANES]);

/// The operations on rows, by the instructions of one level.
///
/// A value of an implementing type proves that the machine has these instructions. Methods are
/// inlined into the function of [`Level::run`](super::Level::run) that is compiled for them.
pub(crate) trait Eight: Copy {
    /// Eight numbers in registers.
    type F: Copy;

    /// The same number in every lane.
    fn splat(self, value: f32) -> Self::F;
    /// A row from memory.
    fn load(self, row: &Row) -> Self::F;
    /// The row in memory.
    fn store(self, row: Self::F) -> Row;
    /// `a + b`.
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a − b`.
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a · b`.
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a / b`.
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a` where it is less, else `b`; so `b` where either is NaN.
    fn less(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a` where it is greater, else `b`; so `b` where either is NaN.
    fn greater(self, a: Self::F, b: Self::F) -> Self::F;
    /// Bit `i` is set where `a ≤ b` in lane `i`.
    fn at_most(self, a: Self::F, b: Self::F) -> u32;
    /// Bit `i` is set where `a < b` in lane `i`.
    fn below(self, a: Self::F, b: Self::F) -> u32;
}

/// Implements operations on two rows, each by an expression.
macro_rules! of_two_rows {
    ($row:ty: $($name:ident($a:ident, $b:ident) -> $result:ty { $value:expr })*) => {
        $(
            #[inline(always)]
            fn $name(self, $a: $row, $b: $row) -> $result {
                $value
            }
        )*
    };
}
pub(super) use of_two_rows;
