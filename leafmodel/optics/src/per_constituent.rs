//! Something for each constituent: contents, factors, absorptions, texels, names of columns.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::{Index, IndexMut};

use super::constituent::Constituent;

/// A value for each [`Constituent`], found by it: `absorption[Constituent::Water]`.
#[derive(Clone, Copy, Deserialize, Eq, Hash, PartialEq, Serialize)]
#[repr(transparent)]
pub struct PerConstituent<T>([T; Constituent::COUNT]);

impl<T> PerConstituent<T> {
    /// The values in the order of [`Constituent::ALL`].
    pub const fn new(values: [T; Constituent::COUNT]) -> Self {
        Self(values)
    }

    /// What a function makes of each constituent.
    #[inline]
    pub fn from_fn(f: impl FnMut(Constituent) -> T) -> Self {
        Self(Constituent::ALL.map(f))
    }

    /// The same for all.
    pub const fn splat(value: T) -> Self
    where
        T: Copy,
    {
        Self([value; Constituent::COUNT])
    }

    /// The same but for these.
    #[must_use]
    pub const fn with(mut self, named: &[(Constituent, T)]) -> Self
    where
        T: Copy,
    {
        let mut next = 0;
        while next < named.len() {
            let (constituent, value) = named[next];
            self.0[constituent as usize] = value;
            next += 1;
        }
        self
    }

    /// The value of one of them, as [`Index`] gives it, in constants.
    pub const fn of(&self, constituent: Constituent) -> T
    where
        T: Copy,
    {
        self.0[constituent as usize]
    }

    /// What a function makes of each value.
    #[inline]
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> PerConstituent<U> {
        PerConstituent(self.0.map(f))
    }

    /// What a function makes of each value and the same constituent's of another map.
    #[inline]
    pub fn zip_with<U: Copy, V>(
        self,
        other: PerConstituent<U>,
        mut f: impl FnMut(T, U) -> V,
    ) -> PerConstituent<V>
    where
        T: Copy,
    {
        PerConstituent::from_fn(|constituent| f(self[constituent], other[constituent]))
    }

    /// Each constituent with its value.
    pub fn iter(&self) -> impl Iterator<Item = (Constituent, &T)> {
        Constituent::ALL.into_iter().zip(&self.0)
    }

    /// Each constituent with its value, which may be changed.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (Constituent, &mut T)> {
        Constituent::ALL.into_iter().zip(&mut self.0)
    }

    /// The values in the order of [`Constituent::ALL`].
    #[inline]
    pub fn as_array(&self) -> &[T; Constituent::COUNT] {
        &self.0
    }
}

impl<T> Index<Constituent> for PerConstituent<T> {
    type Output = T;

    #[inline]
    fn index(&self, constituent: Constituent) -> &T {
        &self.0[constituent as usize]
    }
}

impl<T> IndexMut<Constituent> for PerConstituent<T> {
    #[inline]
    fn index_mut(&mut self, constituent: Constituent) -> &mut T {
        &mut self.0[constituent as usize]
    }
}

impl<T> IntoIterator for PerConstituent<T> {
    type Item = (Constituent, T);
    type IntoIter = std::iter::Zip<
        std::array::IntoIter<Constituent, { Constituent::COUNT }>,
        std::array::IntoIter<T, { Constituent::COUNT }>,
    >;

    fn into_iter(self) -> Self::IntoIter {
        Constituent::ALL.into_iter().zip(self.0)
    }
}

impl<T: fmt::Debug> fmt::Debug for PerConstituent<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = self
            .iter()
            .map(|(constituent, value)| (constituent.name(), value));
        out.debug_map().entries(named).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_constituent_finds_its_own_value() {
        let names = PerConstituent::from_fn(Constituent::name);
        for constituent in Constituent::ALL {
            assert_eq!(names[constituent], constituent.name());
            assert_eq!(names.of(constituent), constituent.name());
        }
        assert!(
            names
                .into_iter()
                .all(|(constituent, name)| constituent.name() == name)
        );
    }

    #[test]
    fn one_value_changes_and_the_others_stay() {
        const ONE: PerConstituent<f64> = PerConstituent::splat(1.0);
        let mut changed = ONE
            .with(&[(Constituent::Brown, 3.0)])
            .map(|value| 2.0 * value);
        changed[Constituent::Water] = 0.0;
        for (constituent, difference) in changed.zip_with(ONE, |changed, one| changed - one) {
            let expected = [(Constituent::Brown, 5.0), (Constituent::Water, -1.0)];
            let told = expected.into_iter().find(|(told, _)| *told == constituent);
            assert_eq!(
                difference,
                told.map_or(1.0, |(_, value)| value),
                "{constituent:?}"
            );
        }
    }
}
