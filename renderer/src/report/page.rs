//! Pages of HTML from templates: one file with its own style, without a script.
//!
//! A template is Jinja's; all that it prints is escaped but for what is marked as safe. Its filters
//! write numbers as people read them, and a dash where there is none.

use leafmodel::measure::comparison::Effect;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, merge_maps};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, Value, context};

use super::comparison::words::{shown_effect, shown_p};
use crate::checkpoint::PROGRAM;
use crate::plot::{escaped, short};

/// What stands where there is nothing.
const DASH: &str = "–";

/// The hues of [`hue`] are those of this style.
const STYLE: &str = include_str!("page.css");
const HUES: usize = 7;

/// The hue of a group, by number: `f0` fills with it, `s0` draws with it, `b0` lies behind.
pub(crate) fn hue(group: usize) -> usize {
    group % HUES
}

/// A name as the anchor of a place in the page: letters, digits and signs between them.
pub(crate) fn anchor(key: &str, part: Option<usize>) -> String {
    part.map_or_else(|| key.to_owned(), |part| format!("{key}-{part}"))
}

/// A sentence that begins with a capital letter.
fn capital(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// A page of a template and of the members of these objects, which it shows.
///
/// # Panics
///
/// If the template is wrong.
pub(crate) fn page(template: &str, shown: &[&serde_json::Value]) -> String {
    let mut pages = Environment::new();
    // Blocks may have lines of their own.
    let syntax = SyntaxConfig::builder()
        .trim_blocks(true)
        .lstrip_blocks(true)
        .keep_trailing_newline(true)
        .build();
    pages.set_syntax(syntax.expect("the delimiters are Jinja's"));
    pages.set_undefined_behavior(UndefinedBehavior::Chainable);
    pages.set_auto_escape_callback(|_| AutoEscape::Html);
    pages.set_formatter(|out, state, value| match value.as_str() {
        Some(text) if !value.is_safe() => out
            .write_str(&escaped(text))
            .map_err(minijinja::Error::from),
        Some(_) | None => minijinja::escape_formatter(out, state, value),
    });
    pages.add_filter("anchor", |key: &str, part: Option<usize>| anchor(key, part));
    pages.add_filter("capital", |line: &str| capital(line));
    pages.add_filter("hue", hue);
    pages.add_filter("fixed", |value: &Value, digits: usize| {
        number(value, |number| format!("{number:.digits$}"))
    });
    pages.add_filter("short", |value: &Value, digits: i32| {
        number(value, |number| short(number, digits))
    });
    pages.add_filter("p", |value: &Value| number(value, shown_p));
    pages.add_filter("effect", |effect: &Value| {
        let of = |value: Result<Value, _>| f64::try_from(value.ok()?).ok();
        let end = |index: usize| {
            let ends = effect.get_attr("interval_95").ok()?;
            of(ends.get_item_by_index(index))
        };
        let found = || {
            Some(Effect {
                value: of(effect.get_attr("value"))?,
                interval: [end(0)?, end(1)?],
            })
        };
        found().map_or_else(|| DASH.to_owned(), shown_effect)
    });
    let own = context! { style => STYLE, program => PROGRAM };
    let shown = shown.iter().map(|shown| Value::from(Serde(shown)));
    let shown = merge_maps(shown.chain([own]));
    let page = pages.render_str(template, shown);
    page.expect("templates are tested with all that they show")
}

/// A number in words; a dash without one.
fn number(value: &Value, shown: impl FnOnce(f64) -> String) -> String {
    let number = f64::try_from(value.clone()).ok();
    number.map_or_else(|| DASH.to_owned(), shown)
}
