//! Derives the keys of a block from the fields of a struct: see `leafmodel::document::declared`.
//!
//! - **In**: a struct or enum whose fields or variants have `#[key(…)]`.
//! - **Out**: an implementation of `Declared`, of `Kinds`, of `Words` or of `Default`, which calls `Keys` as one
//!   would by hand.
//! - **Left out**: blocks whose keys depend on each other; they implement `Declared` by hand.

#![allow(
    clippy::wildcard_enum_match_arm,
    reason = "the enums of syn hold all of Rust, of which attributes use little"
)]

mod attribute;
mod fields;
mod kinds;

use proc_macro::TokenStream;
use syn::{Data, DeriveInput, Error, parse_macro_input};

/// The keys of a block, or the kinds that a block may be of.
#[proc_macro_derive(Declared, attributes(key))]
pub fn declared(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    let made = match &input.data {
        Data::Struct(data) => fields::of_struct(&input, data),
        Data::Enum(data) => kinds::of_enum(&input, data),
        Data::Union(_) => Err(Error::new_spanned(&input, "a union has no keys")),
    };
    made.unwrap_or_else(Error::into_compile_error).into()
}

/// `Default` of a struct by what `#[key(default = …)]` says at its fields.
#[proc_macro_derive(Defaults, attributes(key))]
pub fn defaults(input: TokenStream) -> TokenStream {
    fields::defaults(&parse_macro_input!(input as DeriveInput))
        .unwrap_or_else(Error::into_compile_error)
        .into()
}

/// The words of an enum without data: the names of its variants as a file writes them.
#[proc_macro_derive(Words, attributes(word))]
pub fn words(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    kinds::words(&input)
        .unwrap_or_else(Error::into_compile_error)
        .into()
}
