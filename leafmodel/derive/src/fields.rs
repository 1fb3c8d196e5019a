//! Keys of fields, one call of `Keys` for each.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{DataStruct, DeriveInput, Error, Field, Member, Result, Type};

use crate::attribute::{Key, ValueKind, inside_option, keys};

/// `Declared` of a struct.
pub(crate) fn of_struct(input: &DeriveInput, data: &DataStruct) -> Result<TokenStream> {
    let (name, mut calls) = (&input.ident, Vec::new());
    for (field, member) in data.fields.iter().zip(data.fields.members()) {
        calls.push(of_field(field, &at_self(&member))?);
    }
    for last in keys(&input.attrs)?.into_iter().filter_map(|key| key.last) {
        calls.push(quote! { #last(self, keys); });
    }
    Ok(quote! {
        #[automatically_derived]
        impl ::document::declared::Declared for #name {
            fn declare(&mut self, keys: &mut ::document::keys::Keys<'_>) {
                #(#calls)*
            }
        }
    })
}

/// `Default` of a struct: what `default = …` says at each field, else the field's own.
pub(crate) fn defaults(input: &DeriveInput) -> Result<TokenStream> {
    let syn::Data::Struct(data) = &input.data else {
        return Err(Error::new_spanned(input, "defaults are those of a struct"));
    };
    let name = &input.ident;
    let fields = data.fields.iter().zip(data.fields.members());
    let fields = fields.map(|(field, member)| {
        let own = keys(&field.attrs)?.into_iter().find_map(|key| key.default);
        // At an optional block it is that of the block, which is left out by default.
        let own = own.filter(|_| inside_option(&field.ty).is_none());
        let value = own.map_or_else(
            || quote! { ::core::default::Default::default() },
            |own| quote! { #own },
        );
        Ok(quote! { #member: #value })
    });
    let fields = fields.collect::<Result<Vec<TokenStream>>>()?;
    Ok(quote! {
        #[automatically_derived]
        impl ::core::default::Default for #name {
            fn default() -> Self {
                Self { #(#fields),* }
            }
        }
    })
}

fn at_self(member: &Member) -> TokenStream {
    quote! { (&mut self.#member) }
}

/// The calls for a field; `place` is a mutable reference to it.
pub(crate) fn of_field(field: &Field, place: &TokenStream) -> Result<TokenStream> {
    let mut calls = TokenStream::new();
    for key in keys(&field.attrs)? {
        let mut call = of_key(field, &key, place)?;
        if let Some(when) = &key.when {
            call = quote! { if #when { #call } };
        }
        calls.extend(call);
    }
    Ok(calls)
}

fn of_key(field: &Field, key: &Key, place: &TokenStream) -> Result<TokenStream> {
    let value = key.value.as_ref();
    let is_flat = matches!(value, Some(ValueKind::Flat));
    if let (Some(with), None, false) = (&key.with, &key.name, is_flat) {
        return Ok(quote! { #with(self, keys); });
    }
    if is_flat {
        let declare = key.with.as_ref().map_or_else(
            || quote! { ::document::declared::Declared::declare },
            |with| quote! { #with },
        );
        return Ok(quote! { #declare(#place, keys); });
    }
    if let (Some(with), None) = (&key.with, &key.name) {
        return Ok(quote! { #with(self, keys); });
    }
    let Some(name) = &key.name else {
        if key.default.is_some() {
            return Ok(TokenStream::new());
        }
        return Err(Error::new_spanned(
            field,
            "a key has a name: #[key(\"name\")]",
        ));
    };
    let about = key.about();
    let (place, ty) = match (&key.at, &field.ty) {
        (Some(index), Type::Array(array)) => (quote! { (&mut #place[#index]) }, &*array.elem),
        (Some(_), other) => return Err(Error::new_spanned(other, "`at` is for arrays")),
        (None, ty) => (place.clone(), ty),
    };
    let inner = inside_option(ty);
    let of = inner.unwrap_or(ty);
    let kind = match value {
        Some(ValueKind::Block) => return Ok(block(key, name, &about, &place, ty)),
        Some(ValueKind::List { most, wanted }) => {
            return Ok(quote! {
                let list = ::document::keys::lists::BlockList {
                    most: #most,
                    new: &::core::default::Default::default,
                    wanted: #wanted,
                    is_inside_itself: false,
                };
                let declare = ::document::declared::Declared::declare;
                keys.blocks(#name, #place, &list, #about, declare);
            });
        }
        Some(ValueKind::Flat) | None => of_type(of)?,
        Some(ValueKind::Word) => quote! {
            ::document::value_kind::Word(
                <#of as ::document::declared::Words>::WORDS
            )
        },
        Some(ValueKind::Numbers { limits, degrees }) => numbers(of, limits, *degrees)?,
        Some(ValueKind::Scaled { limits, prefix }) => {
            let (prefix, numbers) = (format_ident!("{prefix}"), numbers(of, limits, false)?);
            quote! { ::document::value_kind::Scaled::#prefix(#numbers) }
        }
        Some(ValueKind::Other(kind)) => quote! { #kind },
    };
    Ok(match (inner, key.is_required) {
        (Some(_), _) => quote! { keys.optional(#name, #place, #kind, #about); },
        (None, true) => quote! { keys.required(#name, #place, #kind, #about); },
        (None, false) => quote! { keys.key(#name, #place, #kind, #about); },
    })
}

fn block(
    key: &Key,
    name: &str,
    about: &TokenStream,
    place: &TokenStream,
    ty: &Type,
) -> TokenStream {
    let inner = inside_option(ty);
    let of = inner.unwrap_or(ty);
    let declare = if let Some(with) = &key.with {
        quote! { #with }
    } else {
        quote! { <#of as ::document::declared::Declared>::declare }
    };
    match (inner, key.is_required) {
        (Some(_), _) => {
            let new = if let Some(default) = &key.default {
                quote! { #default }
            } else {
                quote! { <#of as ::core::default::Default>::default() }
            };
            quote! { keys.optional_block(#name, #place, || #new, #about, #declare); }
        }
        (None, true) => {
            let kinds = if key.with.is_some() {
                quote! { &[] }
            } else {
                quote! { &<#of as ::document::declared::Declared>::kinds() }
            };
            quote! {
                keys.required_block(#name, #about, #kinds, |keys| #declare(#place, keys));
            }
        }
        (None, false) => quote! { keys.block(#name, #about, |keys| #declare(#place, keys)); },
    }
}

/// The kind that follows from a type alone.
fn of_type(ty: &Type) -> Result<TokenStream> {
    match last_word(ty).as_deref() {
        Some("bool") => Ok(quote! { ::document::value_kind::Flag }),
        Some("u64") => Ok(quote! {
            ::document::value_kind::Integer::within(0, ::core::primitive::u64::MAX)
        }),
        Some(_) | None => Err(Error::new_spanned(
            ty,
            "what is the key's range, or its kind?",
        )),
    }
}

fn numbers(ty: &Type, limits: &crate::attribute::Limits, degrees: bool) -> Result<TokenStream> {
    let within = limits.of_numbers();
    if let Type::Array(array) = ty {
        let length = &array.len;
        return Ok(if degrees {
            quote! { ::document::value_kind::DegreesList::<{ #length }>(#within) }
        } else {
            quote! { ::document::value_kind::Numbers::<{ #length }>(#within) }
        });
    }
    match last_word(ty).as_deref() {
        Some("f64") if degrees => Ok(quote! { ::document::value_kind::Degrees(#within) }),
        Some("f64") => Ok(quote! { ::document::value_kind::Number(#within) }),
        Some("DVec3") => Ok(quote! { ::document::value_kind::Vector(#within) }),
        Some("u8" | "u16" | "u32" | "u64" | "usize") => match limits {
            crate::attribute::Limits::Ends("closed", low, high) => {
                Ok(quote! { ::document::value_kind::Integer::within(#low, #high) })
            }
            crate::attribute::Limits::Ends(..) | crate::attribute::Limits::Named(_) => {
                Err(Error::new_spanned(ty, "integers lie within `low..=high`"))
            }
        },
        Some(_) | None => Err(Error::new_spanned(
            ty,
            "this type has no range; name its kind",
        )),
    }
}

fn last_word(ty: &Type) -> Option<String> {
    let Type::Path(path) = ty else {
        return None;
    };
    path.path.segments.last().map(|last| last.ident.to_string())
}
