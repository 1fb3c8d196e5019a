//! A stack of fixed size whose memory is not cleared: clearing would cost a ray more time than a
//! node.

use std::mem::MaybeUninit;

/// At most `N` values.
pub(crate) struct Stack<T, const N: usize> {
    /// The first `height` of them are initialised.
    values: [MaybeUninit<T>; N],
    height: usize,
}

impl<T: Copy, const N: usize> Stack<T, N> {
    /// An empty stack.
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self {
            values: [const { MaybeUninit::uninit() }; N],
            height: 0,
        }
    }

    /// Number of values.
    #[inline(always)]
    pub(crate) fn height(&self) -> usize {
        self.height
    }

    /// Pushes a value.
    ///
    /// # Panics
    ///
    /// If the stack is full.
    #[inline(always)]
    pub(crate) fn push(&mut self, value: T) {
        self.values[self.height].write(value);
        self.height += 1;
    }

    /// Removes and returns the topmost value.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<T> {
        self.height = self.height.checked_sub(1)?;
        // SAFETY: what lies below the height is initialised.
        Some(unsafe { self.values[self.height].assume_init() })
    }
}

impl<T: Copy + Ord, const N: usize> Stack<T, N> {
    /// Inserts a value below all topmost values that are less, but not below the first `base` values.
    ///
    /// # Panics
    ///
    /// If the stack is full.
    #[inline(always)]
    pub(crate) fn push_in_order(&mut self, base: usize, value: T) {
        let mut place = self.height;
        self.push(value);
        while place > base {
            // SAFETY: `place ≤ height` before the push, so the value below it is initialised.
            let below = unsafe { self.values[place - 1].assume_init() };
            if below >= value {
                break;
            }
            self.values[place].write(below);
            place -= 1;
        }
        self.values[place].write(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_comes_off_first_and_the_base_stays_below() {
        let mut stack = Stack::<(u32, char), 8>::new();
        stack.push((100, 'a'));
        stack.push((0, 'b'));
        let base = stack.height();
        for value in [(4, 'c'), (1, 'd'), (9, 'e'), (1, 'f'), (7, 'g')] {
            stack.push_in_order(base, value);
        }
        let off: String = std::iter::from_fn(|| stack.pop())
            .map(|(_, letter)| letter)
            .collect();
        assert_eq!(off, "dfcgeba");
        assert_eq!(stack.pop(), None);
    }
}
