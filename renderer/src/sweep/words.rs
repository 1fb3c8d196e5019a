//! Sweeps in the words of a command line: `KEY=a,b,c`, `KEY=lo..hi/n`.

use leafmodel::document::context::Context;
use leafmodel::document::source::{Place, Sources};
use toml::value::{Datetime, Time};

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
        range_of(cx, &key.path, values, &whole)?
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

/// `lo..hi/n`: the values, of numbers or times.
fn range_of(cx: &Context, key: &str, text: &str, at: &Place) -> Option<Vec<Vec<Cell>>> {
    let refuse = |problem: String| {
        let help = "write lo..hi/n, as in 10..60/6 for 10, 20, 30, 40, 50 and 60";
        impossible(cx, at, key, problem, help);
        None
    };
    let Some((ends, count)) = text.split_once('/') else {
        return refuse(format!("{text} lacks the number of values"));
    };
    let (from, to) = ends.split_once("..").unwrap_or((ends, ""));
    let count_of = |count: &str| {
        let number = count.trim().parse::<usize>().ok();
        let number = number.filter(|count| (2..=MOST_TASKS).contains(count));
        number
            .ok_or_else(|| format!("{count} values, which must be a number from 2 to {MOST_TASKS}"))
    };
    if let [Ok(from), Ok(to)] = [from, to].map(|end| end.trim().parse::<Datetime>()) {
        let times = count_of(count).and_then(|count| times([from, to], count));
        return match times {
            Ok(times) => Some(range::cells(times, at)),
            Err(problem) => refuse(problem),
        };
    }
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
    match count_of(count) {
        Ok(count) => {
            let is_range = range::check(cx, key, at, &range);
            is_range.then(|| range::cells(range.values(count), at))
        }
        Err(problem) => refuse(problem),
    }
}

/// Times of one day, evenly from one to the other, to whole seconds.
fn times([from, to]: [Datetime; 2], count: usize) -> Result<Vec<String>, String> {
    let (Some(first), Some(last)) = (from.time, to.time) else {
        return Err("a range of times needs the time of day at both ends".to_owned());
    };
    if (from.date, from.offset) != (to.date, to.offset) {
        return Err("both ends of a range of times lie on one day, with one offset".to_owned());
    }
    let seconds = |time: Time| {
        let [hour, minute] = [time.hour, time.minute].map(f64::from);
        hour * 3600.0 + minute * 60.0 + f64::from(time.second.unwrap_or(0))
    };
    let (first_s, last_s) = (seconds(first), seconds(last));
    if first_s == last_s {
        return Err("the range begins and ends at one time".to_owned());
    }
    let at = |step: usize| {
        let share = step as f64 / (count - 1) as f64;
        let second = (first_s + (last_s - first_s) * share).round() as u32;
        let time = Time {
            hour: (second / 3600) as u8,
            minute: (second / 60 % 60) as u8,
            second: Some((second % 60) as u8),
            nanosecond: None,
        };
        format!(
            "\"{}\"",
            Datetime {
                time: Some(time),
                ..from
            }
        )
    };
    Ok((0..count).map(at).collect())
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
