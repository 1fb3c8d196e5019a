//! A chart: lines with error bars over two straight axes, and a legend.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas};

/// Size of a chart, px, and its margins: left, top, right (for the legend) and bottom.
pub(crate) const CHART_SIZE: [f64; 2] = [760.0, 340.0];
const MARGINS: [f64; 4] = [64.0, 34.0, 230.0, 46.0];
/// Lines that have colours and places in the legend of their own.
const MOST_LINES: usize = 16;
/// Colours that people with any colour vision tell apart (Okabe and Ito), then the same dashed.
const COLOURS: [&str; 8] = [
    "#000000", "#e69f00", "#56b4e9", "#009e73", "#b8a900", "#0072b2", "#d55e00", "#cc79a7",
];

/// A line of a chart.
#[derive(Clone, Debug)]
pub(crate) struct ChartLine {
    pub(crate) label: String,
    /// x, y and the standard error of y, in the order of x.
    pub(crate) points: Vec<[f64; 3]>,
}

/// A chart.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: String,
    /// What the axes show, with units.
    pub(crate) axes: [String; 2],
    /// Lines; those beyond the first 16 are not drawn, and the legend says how many.
    pub(crate) lines: Vec<ChartLine>,
}

impl Chart {
    /// Draws it into the upper left corner of a canvas, [`CHART_SIZE`] large.
    pub(crate) fn draw(&self, canvas: &mut Canvas) {
        let [left, top, right, bottom] = MARGINS;
        let [width, height] = CHART_SIZE;
        let drawn = &self.lines[..self.lines.len().min(MOST_LINES)];
        let points = || drawn.iter().flat_map(|line| &line.points);
        let x = Axis::around(points().map(|point| point[0]), [left, width - right]);
        let ends = points().flat_map(|[_, y, error]| [y - error, y + error]);
        // From 0 on: shares and factors are to be compared by their size.
        let ends = ends.filter(|end| end.is_finite()).chain([0.0]);
        let y = Axis::around(ends, [height - bottom, top]);
        canvas.text(
            [left, 18.0],
            Anchor::Start,
            "font-weight=\"bold\"",
            &self.title,
        );
        let grey = "stroke=\"#ddd\"";
        for tick in y.ticks(5) {
            canvas.line([left, tick.at], [width - right, tick.at], grey);
            canvas.text([left - 6.0, tick.at + 4.0], Anchor::End, "", &tick.label);
        }
        for tick in x.ticks(7) {
            canvas.line([tick.at, top], [tick.at, height - bottom], grey);
            let place = [tick.at, height - bottom + 15.0];
            canvas.text(place, Anchor::Middle, "", &tick.label);
        }
        let middle = 0.5 * (left + width - right);
        canvas.text([middle, height - 12.0], Anchor::Middle, "", &self.axes[0]);
        canvas.text([left, top - 4.0], Anchor::Start, "", &self.axes[1]);
        for (number, line) in drawn.iter().enumerate() {
            let colour = COLOURS[number % COLOURS.len()];
            let dashes = if number < COLOURS.len() {
                ""
            } else {
                " stroke-dasharray=\"5 3\""
            };
            let style = format!("stroke=\"{colour}\" stroke-width=\"1.3\"{dashes}");
            let places = line.points.iter().filter(|point| point[1].is_finite());
            canvas.polyline(places.clone().map(|[a, b, _]| [x.at(*a), y.at(*b)]), &style);
            for [a, b, error] in places.filter(|point| point[2] > 0.0) {
                let thin = format!("stroke=\"{colour}\" stroke-width=\"0.6\"");
                canvas.line(
                    [x.at(*a), y.at(b - error)],
                    [x.at(*a), y.at(b + error)],
                    &thin,
                );
            }
            let at = top + 10.0 + 15.0 * number as f64;
            let from = width - right + 12.0;
            canvas.line([from, at - 4.0], [from + 22.0, at - 4.0], &style);
            canvas.text([from + 28.0, at], Anchor::Start, "", &line.label);
        }
        let left_out = self.lines.len() - drawn.len();
        if left_out > 0 {
            let at = [width - right + 12.0, top + 10.0 + 15.0 * MOST_LINES as f64];
            let text = format!("and {left_out} more, not drawn");
            canvas.text(at, Anchor::Start, "fill=\"#666\"", &text);
        }
    }
}
