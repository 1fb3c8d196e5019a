//! Files of blocks and keys: TOML whose every key is declared once.
//!
//! A block is declared by one function that names its keys, each with its type, unit, range,
//! meaning and the place of its value ([`keys::Keys`]). Everything else follows from that one
//! function: reading with all errors at their places, writing, and the schema that editors and
//! the book are made from ([`schema`]).
//!
//! - **In**: the text of a file, and overrides `key=value`.
//! - **Out**: the values, or a report of everything that is wrong ([`report::DocumentErrors`]).
//! - **Always true**: numbers are finite and in range; no file outside the document's folder is
//!   touched.
//! - **Left out**: what the blocks mean. Leaves are in `leafmodel::plan_file`, scenes in the
//!   renderer.

// Derived code names this crate as others do.
extern crate self as document;

pub mod assets;
pub mod context;
pub mod coverage;
pub mod declared;
pub mod encoding;
pub mod error;
mod inheritance;
pub mod keys;
pub mod limits;
pub mod named_asset;
pub mod names;
pub mod nearest;
pub mod number_lists;
pub mod opened;
mod other_format;
pub mod overrides;
pub mod path;
pub mod ranges;
pub mod reader;
pub mod report;
pub mod rows;
pub mod schema;
pub mod sections;
pub mod source;
pub mod tree;
pub mod value_kind;
pub mod values;
pub mod whole_file;
pub mod write;
pub mod written;

// What most blocks are declared with.
pub use context::Context;
pub use declared::{Declared, Kinds, Words};
pub use error::DocumentError;
pub use keys::Keys;
pub use keys::kinds::Variant;
pub use keys::lists::NamedList;
pub use limits::Limits;
pub use opened::Opened;
pub use ranges::RangeError;
pub use tree::{Node, Table, Value};
pub use value_kind::{Degrees, Flag, Integer, Kind, ListOf, MapOf, Number, Numbers, Text, Word};
