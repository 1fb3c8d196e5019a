//! A drawing of the posterior: for each parameter a histogram over its prior.

use leafmodel::inference::{Fit, Problem, Told};

use crate::checkpoint::PROGRAM;

const PANEL: [f64; 2] = [260.0, 150.0];
const GAP: [f64; 2] = [30.0, 56.0];
/// Bins over the range of the prior.
const BINS: usize = 40;

/// SVG with a panel for each parameter, all in one row. The grey area is the prior, bars are the
/// posterior, the thick line below is the 95 % interval and the mark on it the median.
pub(super) fn marginals(problem: &Problem, found: &Fit) -> String {
    let count = found.parameters.len() as f64;
    let [width, height] = [
        GAP[0] + count * (PANEL[0] + GAP[0]),
        PANEL[1] + 1.5 * GAP[1],
    ];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <desc>Written by Lamina {PROGRAM}.</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    for (index, told) in found.parameters.iter().enumerate() {
        let left = GAP[0] + index as f64 * (PANEL[0] + GAP[0]);
        svg += &format!("<g transform=\"translate({left} {})\">\n", 0.5 * GAP[1]);
        svg += &panel(told, &heights(problem, found, index));
        svg += "</g>\n";
    }
    svg + "</svg>\n"
}

/// Where a value stands in the prior, 0 to 1.
fn share(told: &Told, value: f64) -> f64 {
    let [low, high] = told.parameter.range();
    if told.parameter.is_logarithmic() {
        libm::log(value / low) / libm::log(high / low)
    } else {
        (value - low) / (high - low)
    }
}

/// The density of each bin over that of the prior.
fn heights(problem: &Problem, found: &Fit, index: usize) -> [f64; BINS] {
    debug_assert!(index < problem.parameters().len());
    let mut heights = [0.0; BINS];
    for (values, weight) in &found.sample {
        let place = share(&found.parameters[index], values[index]) * BINS as f64;
        heights[(place as usize).min(BINS - 1)] += weight * BINS as f64;
    }
    heights
}

fn panel(told: &Told, heights: &[f64; BINS]) -> String {
    let [width, height] = PANEL;
    let highest = heights.iter().copied().fold(1.0, f64::max);
    let scale = height / highest;
    let x = |value: f64| width * share(told, value);
    let bin = width / BINS as f64;
    let mut svg = format!(
        "<text y=\"-8\" font-weight=\"bold\">{}</text>\n\
         <rect y=\"{:.2}\" width=\"{width}\" height=\"{scale:.2}\" fill=\"#ddd\"/>\n",
        told.parameter
            .name()
            .replace('&', "&amp;")
            .replace('<', "&lt;"),
        height - scale,
    );
    for (number, tall) in heights.iter().enumerate().filter(|(_, tall)| **tall > 0.0) {
        svg += &format!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{bin:.2}\" height=\"{:.2}\" fill=\"#4a8f3c\" \
             fill-opacity=\"0.8\"/>\n",
            number as f64 * bin,
            height - tall * scale,
            tall * scale
        );
    }
    let [_, _, [low, high]] = told.intervals;
    let [from, to] = told.parameter.range();
    svg += &format!(
        "<path d=\"M0 {height}H{width}\" stroke=\"#333\"/>\n\
         <path d=\"M{:.2} {below}H{:.2}\" stroke=\"#4a8f3c\" stroke-width=\"4\"/>\n\
         <circle cx=\"{:.2}\" cy=\"{below}\" r=\"4\" fill=\"#333\"/>\n\
         <text y=\"{text}\">{from}</text>\n\
         <text x=\"{width}\" y=\"{text}\" text-anchor=\"end\">{to}</text>\n",
        x(low),
        x(high),
        x(told.median),
        below = height + 8.0,
        text = height + 26.0,
    );
    svg
}
