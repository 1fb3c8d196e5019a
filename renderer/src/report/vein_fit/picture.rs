//! A drawing of the posterior: for each parameter a histogram over its prior.

use leafmodel::inference::{Fit, ParameterEstimate, Problem};

use crate::plot::{Anchor, Axis, Canvas};

const PANEL: [f64; 2] = [260.0, 150.0];
const GAP: [f64; 2] = [30.0, 56.0];
/// Bins over the range of the prior.
const BINS: usize = 40;

/// SVG with a panel for each parameter, all in one row. The grey area is the prior, bars are the
/// posterior, the thick line below is the 95 % interval and the mark on it the median.
pub(crate) fn marginals(problem: &Problem, found: &Fit) -> String {
    let count = found.parameters.len() as f64;
    let mut canvas = Canvas::new([
        GAP[0] + count * (PANEL[0] + GAP[0]),
        PANEL[1] + 1.5 * GAP[1],
    ]);
    for (index, told) in found.parameters.iter().enumerate() {
        let left = GAP[0] + index as f64 * (PANEL[0] + GAP[0]);
        canvas.shifted([left, 0.5 * GAP[1]], |canvas| {
            panel(canvas, told, &heights(problem, found, index));
        });
    }
    canvas.file()
}

/// The prior's range, in which it is uniform, over these pixels.
fn axis(told: &ParameterEstimate, width: f64) -> Axis {
    let (range, pixels) = (told.parameter.range(), [0.0, width]);
    if told.parameter.is_logarithmic() {
        Axis::logarithmic(range, pixels)
    } else {
        Axis::linear(range, pixels)
    }
}

/// The density of each bin over that of the prior.
fn heights(problem: &Problem, found: &Fit, index: usize) -> [f64; BINS] {
    debug_assert!(index < problem.parameters().len());
    let mut heights = [0.0; BINS];
    let axis = axis(&found.parameters[index], BINS as f64);
    for (values, weight) in &found.sample {
        let place = axis.at(values[index]);
        heights[(place as usize).min(BINS - 1)] += weight * BINS as f64;
    }
    heights
}

fn panel(canvas: &mut Canvas, told: &ParameterEstimate, heights: &[f64; BINS]) {
    let [width, height] = PANEL;
    let highest = heights.iter().copied().fold(1.0, f64::max);
    let scale = height / highest;
    let x = axis(told, width);
    let bin = width / BINS as f64;
    let bold = "font-weight=\"bold\"";
    canvas.text([0.0, -8.0], Anchor::Start, bold, told.parameter.name());
    canvas.rectangle([0.0, height - scale], [width, scale], "fill=\"#ddd\"");
    for (number, tall) in heights.iter().enumerate().filter(|(_, tall)| **tall > 0.0) {
        canvas.rectangle(
            [number as f64 * bin, height - tall * scale],
            [bin, tall * scale],
            "fill=\"#4a8f3c\" fill-opacity=\"0.8\"",
        );
    }
    let [_, _, [low, high]] = told.intervals;
    let below = height + 8.0;
    canvas.line([0.0, height], [width, height], "stroke=\"#333\"");
    canvas.line(
        [x.at(low), below],
        [x.at(high), below],
        "stroke=\"#4a8f3c\" stroke-width=\"4\"",
    );
    canvas.circle([x.at(told.median), below], 4.0, "fill=\"#333\"");
    for tick in x.ticks(4) {
        canvas.line(
            [tick.at, height],
            [tick.at, height + 4.0],
            "stroke=\"#333\"",
        );
        canvas.text([tick.at, height + 26.0], Anchor::Middle, "", &tick.label);
    }
}
