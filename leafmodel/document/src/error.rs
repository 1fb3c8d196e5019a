//! Why a scene was refused.

mod advice;

use thiserror::Error;

use super::source::Place;

/// One thing that is wrong with a scene. Text from the file is already safe to print.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DocumentError {
    /// Not TOML.
    #[error("{message}")]
    Syntax {
        /// What the parser says.
        message: String,
        /// What to write instead, if that is known.
        help: Option<String>,
    },
    /// An override that is not `key=value`.
    #[error("an override is one `key=value`, this is {problem}")]
    NotAnOverride {
        /// What it is instead.
        problem: String,
    },
    /// A key that stands there twice.
    #[error("`{key}` is there twice")]
    Duplicate {
        /// The key.
        key: String,
    },
    /// A key that the block does not have.
    #[error("{block} has no key `{key}`")]
    UnknownKey {
        /// The key as written.
        key: String,
        /// The block it stands in.
        block: String,
        /// The key that was probably meant.
        nearest: Option<String>,
        /// What makes the value one of that key, if its unit is another.
        unit: Option<String>,
        /// All keys that the block has.
        known: String,
    },
    /// A kind of block that there is not.
    #[error("{block} cannot be `{variant}`")]
    UnknownVariant {
        /// The kind as written.
        variant: String,
        /// The block it stands in.
        block: String,
        /// The kind that was probably meant.
        nearest: Option<String>,
        /// All kinds that there are.
        known: String,
    },
    /// A key that must be there and is not.
    #[error("{block} lacks `{key}`")]
    MissingKey {
        /// The key.
        key: String,
        /// The block that needs it.
        block: String,
        /// What to write.
        wanted: String,
    },
    /// None of keys of which one is needed, or more than one of keys that exclude each other.
    #[error("{block} {allows} one of {alternatives}, it has {found}")]
    NotOne {
        /// The block.
        block: String,
        /// What it needs or takes.
        allows: &'static str,
        /// The keys to choose from.
        alternatives: String,
        /// Which are there.
        found: String,
    },
    /// Two keys that shut each other out.
    #[error("`{first}` and `{second}` exclude each other")]
    Conflict {
        /// One key.
        first: String,
        /// The other.
        second: String,
    },
    /// A value of another type.
    #[error("`{key}` is {found}, it must be {wanted}")]
    WrongType {
        /// The key.
        key: String,
        /// What is there.
        found: String,
        /// What should be.
        wanted: String,
        /// What to write instead.
        help: String,
    },
    /// A number outside the range in which its model holds.
    #[error("`{key}` is {value}, outside {range}")]
    OutOfRange {
        /// The key.
        key: String,
        /// The number as written.
        value: String,
        /// What is allowed.
        range: String,
        /// What to write instead.
        help: String,
    },
    /// NaN or infinity.
    #[error("`{key}` is {value}, which is not a finite number")]
    NotFinite {
        /// The key.
        key: String,
        /// The number as written.
        value: String,
    },
    /// Values that are allowed one by one and cannot be carried out together.
    #[error("`{key}`: {problem}")]
    Impossible {
        /// The key to change.
        key: String,
        /// What is wrong.
        problem: String,
        /// What to write instead.
        help: String,
    },
    /// Numbers that should rise and do not.
    #[error("`{key}` must rise, but {after} follows {before}")]
    NotRising {
        /// The key.
        key: String,
        /// A number.
        before: f64,
        /// The one behind it, which is not greater.
        after: f64,
    },
    /// The name of something that is not in the file.
    #[error("there is no {kind} `{name}`")]
    UnknownName {
        /// What was looked for.
        kind: &'static str,
        /// The name as written.
        name: String,
        /// The name that was probably meant, or several with backticks between them.
        nearest: Option<String>,
        /// All names that there are.
        known: String,
    },
    /// A name with characters that file names and other programs cannot bear.
    #[error("`{name}` is not a name")]
    BadName {
        /// The name as written.
        name: String,
        /// What names are made of here.
        allowed: &'static str,
    },
    /// A choice among words, and another word.
    #[error("`{key}` is \"{word}\", it must be one of {known}")]
    UnknownWord {
        /// The key.
        key: String,
        /// The word as written.
        word: String,
        /// The word that was probably meant.
        nearest: Option<String>,
        /// The words to choose from.
        known: String,
    },
    /// A path that leads out of the scene's folder and of those that are allowed.
    #[error("\"{path}\" leads out of the scene's folder")]
    PathOutside {
        /// The path as written.
        path: String,
    },
    /// A file that is not there.
    #[error("there is no file \"{path}\"")]
    FileMissing {
        /// The path as written.
        path: String,
        /// A file in the same folder that was probably meant.
        nearest: Option<String>,
    },
    /// A folder, device or pipe where a file is wanted.
    #[error("\"{path}\" is not a regular file")]
    NotARegularFile {
        /// The path as written.
        path: String,
    },
    /// A file that cannot be used.
    #[error("\"{path}\" {problem}")]
    BadFile {
        /// The path as written.
        path: String,
        /// What is wrong with it.
        problem: String,
        /// What to do about it.
        help: String,
    },
    /// Columns of a table of instances that are not what its rows need.
    #[error("the header of \"{path}\" {problem}")]
    Header {
        /// The table's path as written.
        path: String,
        /// What is wrong with the columns.
        problem: String,
        /// What to write instead.
        help: String,
    },
    /// Bytes that are not text.
    #[error("\"{path}\" is not UTF-8 text: byte {byte} (line {line}) belongs to no character")]
    NotUtf8 {
        /// The file.
        path: String,
        /// Place of the first such byte, from 0.
        byte: usize,
        /// Its line, from 1.
        line: usize,
    },
    /// Another version of the format.
    #[error("format {found} is unknown to this version, which reads format 1")]
    UnsupportedFormat {
        /// The number as written.
        found: String,
    },
    /// A spectrum that does not reach over the wavelengths that are needed.
    #[error("{what} covers {from_nm} to {to_nm} nm, {by} needs {need_from_nm} to {need_to_nm} nm")]
    Coverage {
        /// Whose data.
        what: String,
        /// First wavelength of the data.
        from_nm: f64,
        /// Last wavelength of the data.
        to_nm: f64,
        /// First wavelength that is needed.
        need_from_nm: f64,
        /// Last wavelength that is needed.
        need_to_nm: f64,
        /// Who needs them, such as "the film".
        by: &'static str,
    },
    /// More light comes back than arrives.
    #[error("reflectance + transmittance is {sum:.4} at {wavelength_nm} nm, more than 1")]
    EnergyNotConserved {
        /// Where the sum is greatest.
        wavelength_nm: f64,
        /// The sum there.
        sum: f64,
    },
    /// Nothing shines.
    #[error("the scene has no light, so its picture is black")]
    NoLight,
    /// A light without power.
    #[error("light `{name}` gives no light at any wavelength of the film")]
    DarkLight {
        /// The light.
        name: String,
    },
    /// Nothing to see.
    #[error("the scene has no object")]
    NoObject,
    /// A light bound to an object that cannot shine, or shines already.
    #[error("object `{object}` {problem}")]
    CannotShine {
        /// The object.
        object: String,
        /// Why not.
        problem: String,
    },
    /// A view that is no view.
    #[error("{problem}")]
    BadView {
        /// What is wrong.
        problem: &'static str,
        /// What to write instead.
        help: &'static str,
    },
    /// A matrix that flattens space, or is not affine.
    #[error("the matrix {problem}")]
    BadMatrix {
        /// What is wrong.
        problem: &'static str,
        /// What to write instead.
        help: &'static str,
    },
}

/// What [`DocumentError::NotOne`] says of a block that has none of the keys.
pub const NONE: &str = "none";

/// An error with the place it is at, if it is at one.
#[derive(Clone, Debug, PartialEq)]
pub struct LocatedError {
    /// What is wrong.
    pub error: DocumentError,
    /// Where.
    pub at: Option<Place>,
}
