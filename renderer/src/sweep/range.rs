//! Ranges of numbers: evenly spaced, or by equal ratios.

use leafmodel::document::context::Context;
use leafmodel::document::reader::Block;
use leafmodel::document::value_kind::{Flag, Kind, Word};
use leafmodel::document::values::{finite_at, integer_at};

use super::values::{Cell, MOST_TASKS, impossible, number_text};
use leafmodel::document::source::Place;

/// From one number to another, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether ratios are equal instead of steps; both ends are positive then.
    pub(super) logarithmic: bool,
    /// Whether values are integers.
    pub(super) whole: bool,
}

impl Range {
    /// The number at a share of the way, 0 to 1.
    pub(super) fn at(&self, share: f64) -> f64 {
        if share == 1.0 {
            return self.to;
        }
        if self.logarithmic {
            self.from * libm::pow(self.to / self.from, share)
        } else {
            self.from * (1.0 - share) + self.to * share
        }
    }

    /// `count` numbers from end to end; `count` is at least 2.
    pub(super) fn values(&self, count: usize) -> Vec<String> {
        let steps = count - 1;
        let exact = |step: usize| {
            if step == steps {
                self.to
            } else if self.logarithmic {
                self.at(step as f64 / steps as f64)
            } else {
                // One rounding only, so that 0.1 to 0.5 in 4 steps gives 0.3.
                (self.from * (steps - step) as f64 + self.to * step as f64) / steps as f64
            }
        };
        let values = (0..count).map(exact);
        values.map(|value| self.text(value)).collect()
    }

    /// A value as TOML.
    pub(super) fn text(&self, value: f64) -> String {
        if self.whole {
            format!("{:.0}", value.round())
        } else {
            number_text(value)
        }
    }
}

/// A range of a file: `{ from, to }` with `scale` and `whole`, and the number of values if it is
/// `counted`.
pub(super) fn read(block: &Block<'_>, counted: bool) -> Option<(Range, usize)> {
    let cx = block.cx;
    let end = |key: &'static str, what: &str| {
        let node = block.needed(key, || format!("`{key} = …`, where the range {what}"))?;
        finite_at(cx, node, key, "a number")
    };
    let (from, to) = (end("from", "begins"), end("to", "ends"));
    let count = if counted {
        let node = block.needed("count", || {
            "`count = …`, the number of values with both ends, 2 or more".to_owned()
        });
        node.and_then(|node| integer_at(cx, node, "count", 2, MOST_TASKS as u64))
    } else {
        Some(0)
    };
    let scales = [("linear", false), ("logarithmic", true)];
    let scale = block.node("scale");
    let logarithmic = scale.map_or(Some(false), |node| Word(&scales).read(cx, node, "scale"));
    let whole = block.node("whole");
    let whole = whole.and_then(|node| Flag.read(cx, node, "whole"));
    let whole = whole.unwrap_or_default();
    block.finish();
    let (from, to, logarithmic, count) = (from?, to?, logarithmic?, count?);
    let range = Range {
        from,
        to,
        logarithmic,
        whole,
    };
    check(cx, &block.path, &block.at, &range).then_some((range, count as usize))
}

/// Reports a range that is none.
pub(super) fn check(cx: &Context, key: &str, at: &Place, range: &Range) -> bool {
    let Range { from, to, .. } = *range;
    if from == to {
        let problem = format!("the range begins and ends at {from}");
        impossible(cx, at, key, problem, "let it end elsewhere, or set the key");
        return false;
    }
    if range.logarithmic && !(from > 0.0 && to > 0.0) {
        let problem = format!("a logarithmic range from {from} to {to}");
        impossible(cx, at, key, problem, "let both ends be greater than 0");
        return false;
    }
    true
}

/// The cells of a range, all at one place.
pub(super) fn cells(values: Vec<String>, at: &Place) -> Vec<Vec<Cell>> {
    values
        .into_iter()
        .map(|text| {
            let at = at.clone();
            vec![Cell { text, at }]
        })
        .collect()
}
