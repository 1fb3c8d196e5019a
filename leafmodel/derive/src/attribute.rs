//! What `#[key(…)]` says.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::punctuated::Punctuated;
use syn::{Attribute, Error, Expr, ExprCall, ExprLit, Lit, Meta, RangeLimits, Result, Token, Type};

/// One `#[key(…)]`.
#[derive(Default)]
pub(crate) struct Key {
    pub(crate) name: Option<String>,
    pub(crate) value: Option<ValueKind>,
    /// `required`: it must be there, unless a preset lies beneath.
    pub(crate) is_required: bool,
    /// `skip`: the variant is no kind of block.
    pub(crate) is_skipped: bool,
    /// The first paragraph of the doc comment above it.
    pub(crate) sentence: String,
    /// `about = "…"`: its sentence, where it is another one.
    pub(crate) about: Option<Expr>,
    /// `default = …`: what a block has that is left out.
    pub(crate) default: Option<Expr>,
    /// `when = …`: whether the key is there at all.
    pub(crate) when: Option<Expr>,
    /// `at = 0`: the key is that of one element of an array.
    pub(crate) at: Option<Expr>,
    /// `with = function`: what declares the keys instead.
    pub(crate) with: Option<Expr>,
    /// `last = function`: what is called after all keys.
    pub(crate) last: Option<Expr>,
}

/// What the value of a key is.
pub(crate) enum ValueKind {
    /// Numbers within limits, perhaps in degrees.
    Numbers { limits: Limits, degrees: bool },
    /// Numbers within limits, in a file in this part of the program's unit.
    Scaled {
        limits: Limits,
        prefix: &'static str,
    },
    /// A word of an enum.
    Word,
    /// A block of its own.
    Block,
    /// Keys among those of the block around.
    Flat,
    /// A list of blocks.
    List { most: Expr, wanted: Expr },
    /// A kind as written.
    Other(Expr),
}

/// Ends of a range.
pub(crate) enum Limits {
    /// How it is made, and both ends.
    Ends(&'static str, Expr, Expr),
    /// An expression of type `Limits`.
    Named(Expr),
}

impl Key {
    /// Its sentence, as an expression.
    pub(crate) fn about(&self) -> TokenStream {
        let sentence = &self.sentence;
        self.about
            .as_ref()
            .map_or_else(|| quote! { #sentence }, ToTokens::to_token_stream)
    }
}

impl Limits {
    /// As an expression of type `Limits`.
    pub(crate) fn of_numbers(&self) -> TokenStream {
        match self {
            Self::Ends(made, low, high) => {
                let made = syn::Ident::new(made, proc_macro2::Span::call_site());
                quote! { ::document::limits::Limits::#made(#low, #high) }
            }
            Self::Named(limits) => limits.to_token_stream(),
        }
    }
}

/// All `#[key(…)]` among attributes, each with the doc comment between it and the one before.
pub(crate) fn keys(attributes: &[Attribute]) -> Result<Vec<Key>> {
    let (mut keys, mut lines) = (Vec::new(), Vec::new());
    for attribute in attributes {
        lines.extend(doc_line(attribute));
        if attribute.path().is_ident("key") {
            let mut key = key(attribute)?;
            key.sentence = first_paragraph(std::mem::take(&mut lines));
            keys.push(key);
        }
    }
    Ok(keys)
}

/// The `#[key(…)]` of a variant, which may be left out.
pub(crate) fn key_of_variant(attributes: &[Attribute]) -> Result<Key> {
    let found = keys(attributes)?.into_iter().next();
    Ok(found.unwrap_or_else(|| Key {
        sentence: first_paragraph(attributes.iter().filter_map(doc_line)),
        ..Key::default()
    }))
}

fn first_paragraph(lines: impl IntoIterator<Item = String>) -> String {
    let lines = lines.into_iter().take_while(|line| !line.is_empty());
    lines.collect::<Vec<String>>().join(" ")
}

fn doc_line(attribute: &Attribute) -> Option<String> {
    let Meta::NameValue(meta) = &attribute.meta else {
        return None;
    };
    match &meta.value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) if meta.path.is_ident("doc") => Some(text.value().trim().to_owned()),
        _ => None,
    }
}

fn key(attribute: &Attribute) -> Result<Key> {
    let mut key = Key::default();
    for part in attribute.parse_args_with(Punctuated::<Expr, Token![,]>::parse_terminated)? {
        match &part {
            Expr::Lit(ExprLit {
                lit: Lit::Str(name),
                ..
            }) => key.name = Some(name.value()),
            Expr::Assign(assign) => {
                let value = Some((*assign.right).clone());
                match word(&assign.left).as_deref() {
                    Some("about") => key.about = value,
                    Some("default") => key.default = value,
                    Some("when") => key.when = value,
                    Some("at") => key.at = value,
                    Some("with") => key.with = value,
                    Some("last") => key.last = value,
                    Some(_) | None => return Err(Error::new_spanned(&part, "no such setting")),
                }
            }
            other => match word(other).as_deref() {
                Some("required") => key.is_required = true,
                Some("skip") => key.is_skipped = true,
                Some("block") => key.value = Some(ValueKind::Block),
                Some("flat") => key.value = Some(ValueKind::Flat),
                Some("word") => key.value = Some(ValueKind::Word),
                Some(_) | None => key.value = Some(value(other)?),
            },
        }
    }
    Ok(key)
}

/// The word, if an expression is a single one.
fn word(expr: &Expr) -> Option<String> {
    let Expr::Path(path) = expr else {
        return None;
    };
    path.path.get_ident().map(ToString::to_string)
}

fn value(expr: &Expr) -> Result<ValueKind> {
    if let Some(limits) = limits(expr) {
        let degrees = false;
        return Ok(ValueKind::Numbers { limits, degrees });
    }
    if let Expr::Call(call) = expr {
        match word(&call.func).as_deref() {
            Some("degrees") => {
                let inner = call.args.first().and_then(limits);
                let limits = inner.ok_or_else(|| Error::new_spanned(call, "expected a range"))?;
                let degrees = true;
                return Ok(ValueKind::Numbers { limits, degrees });
            }
            Some("milli") => return scaled(call, "milli"),
            Some("nano") => return scaled(call, "nano"),
            Some("list") => return list(call),
            Some(_) | None => {}
        }
    }
    Ok(ValueKind::Other(expr.clone()))
}

/// `milli(low..=high)`, `nano(low..=high)`.
fn scaled(call: &ExprCall, prefix: &'static str) -> Result<ValueKind> {
    let limits = call.args.first().and_then(limits);
    let limits = limits.ok_or_else(|| Error::new_spanned(call, "expected a range"))?;
    Ok(ValueKind::Scaled { limits, prefix })
}

/// `low..=high`, `low..high`, `above(low, high)`, `open(low, high)` or `within(LIMITS)`.
fn limits(expr: &Expr) -> Option<Limits> {
    match expr {
        Expr::Range(range) => {
            let made = match range.limits {
                RangeLimits::Closed(_) => "closed",
                RangeLimits::HalfOpen(_) => "below",
            };
            let (low, high) = (range.start.as_ref()?, range.end.as_ref()?);
            Some(Limits::Ends(made, (**low).clone(), (**high).clone()))
        }
        Expr::Call(call) => {
            let made = match word(&call.func)?.as_str() {
                "above" => "above",
                "open" => "open",
                "within" => return Some(Limits::Named(call.args.first()?.clone())),
                _ => return None,
            };
            Some(Limits::Ends(
                made,
                call.args[0].clone(),
                call.args[1].clone(),
            ))
        }
        _ => None,
    }
}

/// `list(most = 9, wanted = "a list of at most 9 …")`.
fn list(call: &ExprCall) -> Result<ValueKind> {
    let named = |name: &str| {
        let found = call.args.iter().find_map(|part| match part {
            Expr::Assign(assign) if word(&assign.left).as_deref() == Some(name) => {
                Some((*assign.right).clone())
            }
            _ => None,
        });
        found.ok_or_else(|| Error::new_spanned(call, format!("`{name} = …` is missing")))
    };
    let (most, wanted) = (named("most")?, named("wanted")?);
    Ok(ValueKind::List { most, wanted })
}

/// The `T` of an `Option<T>`.
pub(crate) fn inside_option(ty: &Type) -> Option<&Type> {
    let Type::Path(path) = ty else {
        return None;
    };
    let last = path.path.segments.last()?;
    let syn::PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return None;
    };
    match arguments.args.first()? {
        syn::GenericArgument::Type(inner) if last.ident == "Option" => Some(inner),
        _ => None,
    }
}
