//! Enums: the kinds of a block, and words.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{DataEnum, DeriveInput, Error, Fields, Result, Variant};

use crate::attribute::{key_of_variant, keys};
use crate::fields::of_field;

/// `Declared` and `Kinds` of an enum: one block for each of its variants.
pub(crate) fn of_enum(input: &DeriveInput, data: &DataEnum) -> Result<TokenStream> {
    let name = &input.ident;
    let mut kinds = Vec::new();
    for variant in &data.variants {
        kinds.extend(of_variant(variant)?);
    }
    Ok(quote! {
        #[automatically_derived]
        impl ::document::declared::Kinds for #name {
            const KINDS: &'static [::document::keys::kinds::Variant<Self>] = &[#(#kinds),*];
        }
        #[automatically_derived]
        impl ::document::declared::Declared for #name {
            fn declare(&mut self, keys: &mut ::document::keys::Keys<'_>) {
                keys.kind(self, <Self as ::document::declared::Kinds>::KINDS);
            }

            fn kinds() -> ::std::vec::Vec<&'static str> {
                let kinds = <Self as ::document::declared::Kinds>::KINDS;
                kinds.iter().map(|kind| kind.name).collect()
            }
        }
    })
}

/// The kind of a variant, unless it is none.
fn of_variant(variant: &Variant) -> Result<Option<TokenStream>> {
    let ident = &variant.ident;
    let key = key_of_variant(&variant.attrs)?;
    if key.is_skipped {
        return Ok(None);
    }
    let about = key.about();
    let name = key.name.unwrap_or_else(|| snake_case(&ident.to_string()));
    let last = key.last.map(|last| quote! { #last(value, keys); });
    let (new, declare) = match &variant.fields {
        Fields::Unit => (quote! { Self::#ident }, TokenStream::new()),
        Fields::Unnamed(_) => {
            let default = key.default.as_ref().map_or_else(
                || quote! { ::core::default::Default::default() },
                |default| quote! { #default },
            );
            let declare = key.with.as_ref().map_or_else(
                || quote! { ::document::declared::Declared::declare },
                |with| quote! { #with },
            );
            let declare = quote! {
                if let Self::#ident(inner) = value {
                    #declare(inner, keys);
                }
            };
            (quote! { Self::#ident(#default) }, declare)
        }
        Fields::Named(fields) => {
            let (mut names, mut defaults, mut calls) = (Vec::new(), Vec::new(), Vec::new());
            for field in &fields.named {
                let Some(name) = &field.ident else {
                    continue;
                };
                let own = keys(&field.attrs)?;
                let default = own.iter().find_map(|key| key.default.as_ref());
                let default = default.map_or_else(
                    || quote! { ::core::default::Default::default() },
                    |default| quote! { #default },
                );
                defaults.push(quote! { #name: #default });
                if !own.is_empty() {
                    names.push(name);
                    calls.push(of_field(field, &quote! { (&mut *#name) })?);
                }
            }
            let declare = quote! {
                if let Self::#ident { #(#names,)* .. } = value {
                    #(#calls)*
                }
            };
            (quote! { Self::#ident { #(#defaults),* } }, declare)
        }
    };
    let arguments = if declare.is_empty() && last.is_none() {
        quote! { |_, _| }
    } else {
        quote! { |value, keys| }
    };
    Ok(Some(quote! {
        ::document::keys::kinds::Variant {
            name: #name,
            about: #about,
            new: || #new,
            is: |value| ::core::matches!(value, Self::#ident { .. }),
            declare: #arguments { #declare #last },
        }
    }))
}

/// `Words` of an enum without data.
pub(crate) fn words(input: &DeriveInput) -> Result<TokenStream> {
    let syn::Data::Enum(data) = &input.data else {
        return Err(Error::new_spanned(input, "words are those of an enum"));
    };
    let name = &input.ident;
    let words = data.variants.iter().map(|variant| {
        let ident = &variant.ident;
        let own = variant.attrs.iter().find(|one| one.path().is_ident("word"));
        let word = match own {
            Some(own) => own.parse_args::<syn::LitStr>()?.value(),
            None => snake_case(&ident.to_string()),
        };
        Ok(quote! { (#word, Self::#ident) })
    });
    let words = words.collect::<Result<Vec<TokenStream>>>()?;
    Ok(quote! {
        #[automatically_derived]
        impl ::document::declared::Words for #name {
            const WORDS: &'static [(&'static str, Self)] = &[#(#words),*];
        }
    })
}

/// `GrowthForm` as a file writes it: `growth_form`.
fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}
