//! Sweeps in the words of a command line: `KEY=a,b,c`, `KEY=lo..hi/n`.

use leafmodel::document::context::Context;
use leafmodel::document::source::{Place, Sources};

use super::draft::Draft;
use super::range::{self, Range};
use super::tasks::{Sweep, Target};
use super::values::{Axis, Cell, Key, MOST_TASKS, cell, impossible};
use leafmodel::document::report::DocumentErrors;

/// What a command line adds to a sweep file, or says instead of one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Words<'w> {
    /// `KEY=a,b,c` or `KEY=lo..hi/n`, each an axis of the grid.
    pub over: &'w [String],
    /// Seeds 1 to this number.
    pub seeds: Option<u16>,
    /// Overrides of all tasks.
    pub fixed: &'w [String],
    /// Samples a pixel.
    pub spp: Option<u32>,
    /// Target noise.
    pub noise: Option<f64>,
}

impl Sweep {
    /// A sweep of `target`, which reports call `shown`.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] with all errors of the words.
    pub fn words(target: Target, shown: &str, words: &Words<'_>) -> Result<Self, DocumentErrors> {
        let mut sources = Sources::default();
        sources.add(shown, "");
        let cx = Context::new(sources, ".".into());
        let mut draft = Draft {
            target: Some(target),
            ..Draft::default()
        };
        draft.add(&cx, words);
        draft.finish(cx)
    }
}

impl Draft {
    /// Takes in what the command line says.
    pub(super) fn add(&mut self, cx: &Context, words: &Words<'_>) {
        self.fixed.extend_from_slice(words.fixed);
        self.spp = words.spp.or(self.spp);
        self.noise = words.noise.or(self.noise);
        if let Some(count) = words.seeds {
            self.seeds = (1..=u64::from(count)).collect();
        }
        let axes = words.over.iter().filter_map(|word| axis(cx, word));
        self.axes.extend(axes);
    }
}

/// The axis of one word.
fn axis(cx: &Context, word: &str) -> Option<Axis> {
    let source = cx.sources.borrow_mut().add("--over", word);
    let place = |span| Place { source, span };
    let Some((path, values)) = word.split_once('=') else {
        let help = "write KEY=a,b,c or KEY=lo..hi/n";
        impossible(cx, &place(0..word.len()), word, "lacks its values", help);
        return None;
    };
    let start = path.len() + 1;
    let key = Key {
        path: path.trim().to_owned(),
        at: place(0..path.len()),
    };
    if key.path.is_empty() {
        let help = "write KEY=a,b,c or KEY=lo..hi/n";
        impossible(cx, &place(0..word.len()), word, "lacks its key", help);
        return None;
    }
    let whole = place(start..word.len());
    let rows = if values.contains("..") && !values.contains(['"', '\'', '[', '{', ',']) {
        let (range, count) = range_of(cx, &key.path, values, &whole)?;
        range::cells(&range, count, &whole)
    } else {
        let cells = pieces(values).into_iter().map(|(offset, text)| {
            let from = start + offset;
            cell(cx, &key.path, text, place(from..from + text.len()))
        });
        // Every empty value is told.
        let cells: Vec<Option<Cell>> = cells.collect();
        let cells: Option<Vec<Cell>> = cells.into_iter().collect();
        cells?.into_iter().map(|cell| vec![cell]).collect()
    };
    let keys = vec![key];
    Some(Axis { keys, rows })
}

/// `lo..hi/n`: the range, and the number of its values.
fn range_of(cx: &Context, key: &str, text: &str, at: &Place) -> Option<(Range, usize)> {
    let refuse = |problem: String| {
        let help = "write lo..hi/n, as in 10..60/6 for 10, 20, 30, 40, 50 and 60";
        impossible(cx, at, key, problem, help);
        None
    };
    let Some((ends, count)) = text.split_once('/') else {
        return refuse(format!("{text} lacks the number of values"));
    };
    let (from, to) = ends.split_once("..").unwrap_or((ends, ""));
    let number = |text: &str| {
        let number = text.parse::<f64>().ok();
        number.filter(|number| number.is_finite())
    };
    let (from, to) = match [from.trim(), to.trim()] {
        [_, ""] => return refuse(format!("{text} lacks its end")),
        ["", _] => return refuse(format!("{text} lacks its start")),
        ends => match ends.map(number) {
            [Some(from), Some(to)] => (from, to),
            [None, _] => return refuse(format!("{} is no finite number", ends[0])),
            [_, None] => return refuse(format!("{} is no finite number", ends[1])),
        },
    };
    let range = Range {
        from,
        to,
        logarithmic: false,
        whole: false,
    };
    match count.trim().parse::<usize>() {
        Ok(count) if (2..=MOST_TASKS).contains(&count) => {
            range::check(cx, key, at, &range).then_some((range, count))
        }
        Ok(_) | Err(_) => refuse(format!(
            "{count} values, which must be a number from 2 to {MOST_TASKS}"
        )),
    }
}

/// The pieces between commas that stand outside of brackets and quotes, with their places.
fn pieces(text: &str) -> Vec<(usize, &str)> {
    let (mut depth, mut quote, mut from) = (0_i32, None, 0);
    let mut found = Vec::new();
    for (index, letter) in text.char_indices() {
        match letter {
            _ if quote == Some(letter) => quote = None,
            '"' | '\'' if quote.is_none() => quote = Some(letter),
            '[' | '{' if quote.is_none() => depth += 1,
            ']' | '}' if quote.is_none() => depth -= 1,
            ',' if quote.is_none() && depth == 0 => {
                found.push((from, &text[from..index]));
                from = index + 1;
            }
            _ => {}
        }
    }
    found.push((from, &text[from..]));
    found
}
