//! Kinds of values: how one is read with its errors, written, and told in a schema.

use std::marker::PhantomData;

use glam::DVec3;

use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::limits::Limits;
use super::nearest::nearest;
use super::reader::Block;
use super::schema::Type;
use super::source::escaped;
use super::tree::{Node, Table, Value};
use super::values::{
    integer_at, list, listed, number, number_at, numbers_at, text_at, wrong_length, wrong_type,
};

/// How the value of a key is read, written and described.
pub trait Kind {
    /// What it is in the program.
    type Of;

    /// The value of a node; `None` with an error left in the context.
    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Self::Of>;

    /// The same for a value that has keys of its own, which belong to the block around it.
    fn read_in(&self, block: &Block<'_>, node: &Node, key: &str) -> Option<Self::Of> {
        self.read(block.cx, node, key)
    }

    /// The value as it stands in a file.
    fn write(&self, value: &Self::Of) -> Value;

    /// What a schema says of it.
    fn describe(&self) -> Type;
}

/// A real number in a range.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub Limits);

impl Kind for Number {
    type Of = f64;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<f64> {
        number_at(cx, node, key, self.0)
    }

    fn write(&self, value: &f64) -> Value {
        number(*value)
    }

    fn describe(&self) -> Type {
        Type::Number(self.0)
    }
}

/// An angle: degrees in the file, radians in the program.
#[derive(Clone, Copy, Debug)]
pub struct Degrees(pub Limits);

impl Kind for Degrees {
    type Of = f64;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<f64> {
        number_at(cx, node, key, self.0).map(f64::to_radians)
    }

    fn write(&self, value: &f64) -> Value {
        number(degrees(*value))
    }

    fn describe(&self) -> Type {
        Type::Number(self.0)
    }
}

/// Degrees that read back to the same radians if any do; the shortest that do if they are short.
pub fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    let short = (near * 1e6).round() / 1e6;
    [short, near, near.next_up(), near.next_down()]
        .into_iter()
        .find(|degrees| degrees.to_radians() == radians)
        .unwrap_or(near)
}

/// An integer in a range, both ends included.
#[derive(Clone, Copy, Debug)]
pub struct Integer<T> {
    least: u64,
    most: u64,
    of: PhantomData<T>,
}

impl<T> Integer<T> {
    /// From `least` to `most`, both of which a `T` can hold.
    pub const fn within(least: u64, most: u64) -> Self {
        Self {
            least,
            most,
            of: PhantomData,
        }
    }
}

impl<T: Copy + TryFrom<u64> + TryInto<u64>> Kind for Integer<T> {
    type Of = T;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<T> {
        T::try_from(integer_at(cx, node, key, self.least, self.most)?).ok()
    }

    fn write(&self, value: &T) -> Value {
        Value::Integer((*value).try_into().unwrap_or(u64::MAX).into())
    }

    fn describe(&self) -> Type {
        Type::Integer {
            least: self.least,
            most: self.most,
        }
    }
}

/// True or false.
#[derive(Clone, Copy, Debug)]
pub struct Flag;

impl Kind for Flag {
    type Of = bool;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<bool> {
        if let Value::Flag(flag) = node.value {
            return Some(flag);
        }
        wrong_type(cx, node, key, "true or false");
        None
    }

    fn write(&self, value: &bool) -> Value {
        Value::Flag(*value)
    }

    fn describe(&self) -> Type {
        Type::Flag
    }
}

/// Any text; holds what the text is, such as "the path of a CSV file".
#[derive(Clone, Copy, Debug)]
pub struct Text(pub &'static str);

impl Kind for Text {
    type Of = String;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<String> {
        text_at(cx, node, key).map(|(text, _)| text.to_owned())
    }

    fn write(&self, value: &String) -> Value {
        Value::Text(value.clone())
    }

    fn describe(&self) -> Type {
        Type::Text(self.0)
    }
}

/// One of several words, each of which stands for a value.
#[derive(Clone, Copy, Debug)]
pub struct Word<'w, T>(pub &'w [(&'static str, T)]);

impl<T: Clone + PartialEq> Kind for Word<'_, T> {
    type Of = T;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<T> {
        let (written, at) = text_at(cx, node, key)?;
        if let Some((_, value)) = self.0.iter().find(|(word, _)| *word == written) {
            return Some(value.clone());
        }
        let words = || self.0.iter().map(|(word, _)| *word);
        let error = DocumentError::UnknownWord {
            key: key.to_owned(),
            word: escaped(written, QUOTED),
            nearest: nearest(written, words()).map(str::to_owned),
            known: listed(words()),
        };
        cx.error(at, error);
        None
    }

    fn write(&self, value: &T) -> Value {
        let found = self.0.iter().find(|(_, of)| of == value);
        Value::Text(found.map_or("", |(word, _)| *word).to_owned())
    }

    fn describe(&self) -> Type {
        Type::Word(self.0.iter().map(|(word, _)| (*word).to_owned()).collect())
    }
}

/// A list of `N` numbers in a range.
#[derive(Clone, Copy, Debug)]
pub struct Numbers<const N: usize>(pub Limits);

impl<const N: usize> Kind for Numbers<N> {
    type Of = [f64; N];

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<[f64; N]> {
        numbers_at(cx, node, key, self.0)
    }

    fn write(&self, value: &[f64; N]) -> Value {
        list(value.map(number))
    }

    fn describe(&self) -> Type {
        Type::Tuple(vec![Type::Number(self.0); N])
    }
}

/// A list of `N` angles: degrees in the file, radians in the program.
#[derive(Clone, Copy, Debug)]
pub struct DegreesList<const N: usize>(pub Limits);

impl<const N: usize> Kind for DegreesList<N> {
    type Of = [f64; N];

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<[f64; N]> {
        numbers_at::<N>(cx, node, key, self.0).map(|list| list.map(f64::to_radians))
    }

    fn write(&self, value: &[f64; N]) -> Value {
        list(value.map(|angle| number(degrees(angle))))
    }

    fn describe(&self) -> Type {
        Numbers::<N>(self.0).describe()
    }
}

/// A vector of three numbers in a range.
#[derive(Clone, Copy, Debug)]
pub struct Vector(pub Limits);

impl Kind for Vector {
    type Of = DVec3;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<DVec3> {
        numbers_at(cx, node, key, self.0).map(DVec3::from_array)
    }

    fn write(&self, value: &DVec3) -> Value {
        list(value.to_array().map(number))
    }

    fn describe(&self) -> Type {
        Numbers::<3>(self.0).describe()
    }
}

/// Numbers that a file has in another unit than the program.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<K> {
    of: K,
    /// The file's units in one of the program, and the inverse.
    factors: [f64; 2],
}

impl<K> Scaled<K> {
    /// Thousandths: millimetres of metres.
    pub const fn milli(of: K) -> Self {
        let factors = [1e3, 1e-3];
        Self { of, factors }
    }

    /// Billionths: microlitres of cubic metres.
    pub const fn nano(of: K) -> Self {
        let factors = [1e9, 1e-9];
        Self { of, factors }
    }
}

impl<K: Kind<Of: Copy + Times>> Kind for Scaled<K> {
    type Of = K::Of;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<K::Of> {
        Some(self.of.read(cx, node, key)?.times(self.factors[1]))
    }

    fn write(&self, value: &K::Of) -> Value {
        self.of.write(&value.times(self.factors[0]))
    }

    fn describe(&self) -> Type {
        self.of.describe()
    }
}

/// Numbers that can be multiplied by one.
pub trait Times {
    /// The product.
    #[must_use]
    fn times(self, factor: f64) -> Self;
}

impl Times for f64 {
    fn times(self, factor: f64) -> Self {
        factor * self
    }
}

impl<const N: usize> Times for [f64; N] {
    fn times(self, factor: f64) -> Self {
        self.map(|number| factor * number)
    }
}

/// A list of values of one kind; `wanted` says so in words, such as "a list of 1 to 9 numbers".
#[derive(Clone, Copy, Debug)]
pub struct ListOf<K> {
    /// The kind of each.
    pub of: K,
    /// How many there are at least.
    pub least: usize,
    /// How many there are at most.
    pub most: usize,
    /// What messages call the list.
    pub wanted: &'static str,
}

impl<K: Kind> Kind for ListOf<K> {
    type Of = Vec<K::Of>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<K::Of>> {
        let Value::List(nodes) = &node.value else {
            wrong_type(cx, node, key, self.wanted);
            return None;
        };
        if !(self.least..=self.most).contains(&nodes.len()) {
            wrong_length(cx, &node.at, key, "a list", nodes.len(), self.wanted);
            return None;
        }
        // All are read before one that is wrong decides.
        let values: Vec<Option<K::Of>> = nodes
            .iter()
            .map(|node| self.of.read(cx, node, key))
            .collect();
        values.into_iter().collect()
    }

    fn write(&self, value: &Vec<K::Of>) -> Value {
        list(value.iter().map(|one| self.of.write(one)))
    }

    fn describe(&self) -> Type {
        Type::List {
            of: Box::new(self.of.describe()),
            least: self.least,
            most: self.most,
            wanted: self.wanted,
        }
    }
}

/// A table of values of one kind under names, in the file's order.
#[derive(Clone, Copy, Debug)]
pub struct MapOf<K>(pub K);

impl<K: Kind> Kind for MapOf<K> {
    type Of = Vec<(String, K::Of)>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Self::Of> {
        let Some(table) = node.table() else {
            wrong_type(cx, node, key, "a table");
            return None;
        };
        let values: Vec<Option<(String, K::Of)>> = table
            .0
            .iter()
            .map(|entry| {
                let value = self.0.read(cx, &entry.node, &escaped(&entry.key, QUOTED))?;
                Some((entry.key.clone(), value))
            })
            .collect();
        values.into_iter().collect()
    }

    fn write(&self, value: &Self::Of) -> Value {
        let entries = value.iter();
        Value::Table(Table::of(
            entries.map(|(name, value)| (name.as_str(), self.0.write(value))),
        ))
    }

    fn describe(&self) -> Type {
        Type::Map(Box::new(self.0.describe()))
    }
}

/// The file behind a path, and the path as written: see [`super::path::resolve`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamedFile {
    /// As the document names it.
    pub written: String,
    /// Resolved, inside the document's folder.
    pub file: std::path::PathBuf,
}

/// The path of a file that must be there, inside the document's folder.
#[derive(Clone, Copy, Debug)]
pub struct FilePath {
    /// What messages call it, such as "the path of a CSV file".
    pub what: &'static str,
    /// What it may lead to.
    pub wanted: super::path::Wanted,
}

impl FilePath {
    /// A file with one of the `endings` and at most so many bytes.
    pub const fn of(what: &'static str, endings: &'static [&'static str], most_bytes: u64) -> Self {
        let wanted = super::path::Wanted {
            endings,
            most_bytes,
        };
        Self { what, wanted }
    }
}

impl Kind for FilePath {
    type Of = NamedFile;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<NamedFile> {
        let (written, at) = text_at(cx, node, key)?;
        let file = super::path::resolve(cx, written, at, self.wanted)?;
        Some(NamedFile {
            written: written.to_owned(),
            file,
        })
    }

    fn write(&self, value: &NamedFile) -> Value {
        Value::Text(value.written.clone())
    }

    fn describe(&self) -> Type {
        Type::Text(self.what)
    }
}

/// The file behind such a path; the path as written is not kept.
#[derive(Clone, Copy, Debug)]
pub struct FileOnly(pub FilePath);

impl Kind for FileOnly {
    type Of = std::path::PathBuf;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Self::Of> {
        self.0.read(cx, node, key).map(|named| named.file)
    }

    fn write(&self, value: &Self::Of) -> Value {
        Value::Text(value.display().to_string())
    }

    fn describe(&self) -> Type {
        self.0.describe()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn whole_degrees_stay_whole(angle in -355..355_i32) {
            prop_assert_eq!(degrees(f64::from(angle).to_radians()), f64::from(angle));
        }
    }
}
