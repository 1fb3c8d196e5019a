//! What was traced from a picture: notes, warnings, JSON, and the network as a file.

use glam::DVec2;
use leafmodel::export::SvgStyle;
use leafmodel::tracing::{Finding, FindingKind, Traced};
use serde_json::json;

use crate::export::drawing::{Style, Subject, draw_within};
use crate::export::veins::VeinFormat;
use crate::image::ImageError;

/// What was traced, in a format.
pub(crate) fn drawn(
    format: VeinFormat,
    traced: &Traced,
    pixels: u32,
) -> Result<Vec<u8>, ImageError> {
    let page = traced.outline.bounds();
    let subject = Subject {
        outlines: std::slice::from_ref(&traced.outline),
        network: &traced.network,
        sources: &[],
    };
    let text = format.text(page, subject.outlines, subject.network, SvgStyle::default());
    if let Some(text) = text {
        return Ok(text.into_bytes());
    }
    let drawing = draw_within(page, subject, pixels, Style::OnPaper);
    drawing.and_then(|drawing| drawing.png())
}

/// A note on a leaf that is longer than any, mm, and so on the flag that says how large it is.
pub(crate) fn note_on_length(points: impl Iterator<Item = DVec2>, flag: &str) -> Option<String> {
    /// The longest undivided leaves have less.
    const LONGEST_MM: f64 = 4000.0;
    let nowhere = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let [low, high] = points.fold(nowhere, |[low, high], p| [low.min(p), high.max(p)]);
    let length_mm = (high - low).max_element();
    (length_mm > LONGEST_MM).then(|| {
        format!(
            "note: the leaf is {:.1} m long, and the longest in nature have some {} m: check {flag}",
            length_mm / 1000.0,
            LONGEST_MM / 1000.0
        )
    })
}

/// A warning about a length of veins per area, mm/mm², that no leaf has; `flag` gives the scale.
pub(crate) fn implausible_density(density: Option<f64>, flag: &str) -> Option<String> {
    const DENSEST: f64 = 50.0;
    density.filter(|density| *density > DENSEST).map(|density| {
        format!(
            "warning: there are {density:.0} mm of veins in each mm², and hardly a leaf has more than 25: \
             check the scale ({flag})"
        )
    })
}

/// Findings as notes: of parts that are apart, the longest few.
pub(crate) fn of_findings(findings: &[Finding]) -> Vec<String> {
    const MOST: usize = 5;
    let length = |finding: &Finding| match finding.kind {
        FindingKind::Apart { length_mm } => Some(length_mm),
        FindingKind::Specks { .. }
        | FindingKind::Holes { .. }
        | FindingKind::Spurs { .. }
        | FindingKind::Crossings { .. }
        | FindingKind::Thin { .. }
        | FindingKind::Petiole
        | FindingKind::BaseGuessed { .. }
        | FindingKind::Moved { .. } => None,
    };
    let (mut apart, others): (Vec<&Finding>, Vec<&Finding>) = findings
        .iter()
        .partition(|finding| length(finding).is_some());
    let others = others
        .into_iter()
        .filter(|finding| !matches!(finding.kind, FindingKind::Moved { .. }));
    apart.sort_by(|a, b| {
        length(b)
            .unwrap_or(0.0)
            .total_cmp(&length(a).unwrap_or(0.0))
    });
    let mut lines: Vec<String> = others.map(ToString::to_string).collect();
    lines.extend(apart.iter().take(MOST).map(ToString::to_string));
    if apart.len() > MOST {
        let rest = apart[MOST..].iter().filter_map(|finding| length(finding));
        lines.push(format!(
            "{} more parts do not hang together with the base, {:.2} mm in all; --findings tells \
             where they are",
            apart.len() - MOST,
            rest.sum::<f64>(),
        ));
    }
    lines
}

/// Findings and the frame as JSON.
pub(crate) fn json(traced: &Traced) -> serde_json::Value {
    let findings = traced.findings.iter().map(|finding| {
        json!({
            "finding": finding.to_string(),
            "place_px": finding.place_px.map(|place| place.to_array()),
            "place_mm": finding.place_px.map(|place| traced.frame.to_mm(place).to_array()),
        })
    });
    json!({
        "base_px": traced.frame.base_px.to_array(),
        "axis_px": traced.frame.axis.to_array(),
        "mm_per_pixel": traced.frame.mm_per_pixel,
        "findings": findings.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leaf_longer_than_any_is_noted_with_the_flag_that_makes_it_so() {
        let leaf = |length_mm: f64| {
            let points = [
                DVec2::ZERO,
                DVec2::new(30.0, 0.5 * length_mm),
                length_mm * DVec2::Y,
            ];
            note_on_length(points.into_iter(), "--mm-per-pixel")
        };
        assert_eq!(leaf(3900.0), None);
        let note = leaf(11_800.0).expect("it is too long");
        assert!(note.starts_with("note: the leaf is 11.8 m long"), "{note}");
        assert!(note.ends_with("check --mm-per-pixel"), "{note}");
    }
}
