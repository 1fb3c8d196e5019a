//! The report as a page.

use leafmodel::measure::comparison::{Effect, Summary};

use super::Findings;
use super::cells::{DASH, capital, key, list, pair_title, shown_tests, three, unit_words};
use super::compared::{LEVEL, Measure};
use super::overlay::{MOST, overlay};
use super::page::{anchor, figure, page, table};
use super::words::{conclusions, label, shown_effect, test_of_means};
use super::{figures, methods, spreads};
use crate::checkpoint::PROGRAM;
use crate::cli::Failure;
use crate::cli::arguments::CompareNetworksArguments;
use crate::plot::{escaped, short};

/// One HTML file that needs no other.
pub(super) fn html(
    findings: &Findings,
    arguments: &CompareNetworksArguments,
) -> Result<String, Failure> {
    let mut body = format!(
        "<header>\n<h1>{}</h1>\n<p class=\"soft\">{} of leaf veins, compared by Lamina {PROGRAM}.</p>\n\
         </header>\n",
        escaped(&findings.title),
        if findings.is_single {
            "Networks"
        } else {
            "Groups of networks"
        },
    );
    let sections = [
        ("leaves", "What is compared", compared(findings)),
        ("overview", "At a glance", overview(findings)),
        ("overlay", "Over each other", overlays(findings, arguments)?),
        ("table", "All measures", tables(findings)),
        ("measures", "Each measure", cards(findings)),
        ("distributions", "Single values", spreads::section(findings)),
        (
            "methods",
            "How it was done",
            methods::section(findings, arguments),
        ),
        ("remarks", "Remarks on the networks", remarks(findings)),
    ];
    let sections = sections.into_iter().filter(|(_, _, text)| !text.is_empty());
    let sections: Vec<_> = sections.collect();
    body += "<nav aria-label=\"Contents\">\n";
    for (place, title, _) in &sections {
        body += &format!("<a href=\"#{place}\">{title}</a>\n");
    }
    body += "</nav>\n<main>\n";
    for (place, title, text) in &sections {
        body += &format!("<section id=\"{place}\">\n<h2>{title}</h2>\n{text}</section>\n");
    }
    body += "</main>\n";
    Ok(page(&findings.title, &body))
}

fn compared(findings: &Findings) -> String {
    let area = |area: Option<f64>| area.map_or_else(|| DASH.to_owned(), |area| short(area, 4));
    let header = [
        "group",
        "leaf",
        "file",
        "nodes",
        "edges",
        "areoles",
        "blade, mm²",
    ];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for leaf in &findings.leaves {
        rows.push(vec![
            key(findings, leaf.group),
            escaped(&leaf.name),
            escaped(&leaf.given),
            leaf.nodes.to_string(),
            leaf.edges.to_string(),
            leaf.areoles.to_string(),
            area(leaf.area_mm2),
        ]);
    }
    let notes = findings.notes.iter().map(|note| escaped(note));
    table("", "names", &rows, &[]) + &list(notes)
}

/// Faults and gaps of the networks.
fn remarks(findings: &Findings) -> String {
    let leaves = findings.leaves.iter();
    let remarks = leaves.flat_map(|leaf| leaf.remarks.iter().map(move |remark| (leaf, remark)));
    list(remarks.map(|(leaf, remark)| format!("{}: {}", escaped(&leaf.name), escaped(remark))))
}

fn overview(findings: &Findings) -> String {
    let mut text = String::new();
    for line in conclusions(findings) {
        text += &format!("<p>{}.</p>\n", escaped(&capital(&line)));
    }
    for (number, pair) in findings.compared.pairs.iter().enumerate() {
        let (drawn, caption) = if findings.is_single {
            (
                figures::ratios(findings, number),
                "Ratio of each measure on a logarithmic axis. Marks beyond the axis are told by \
                 their number."
                    .to_owned(),
            )
        } else {
            (
                figures::effects(findings, number),
                format!(
                    "Hedges' g of each measure with its 95 % interval; above 0, {} has the larger \
                     mean. Full marks: p of Welch's test is at most {LEVEL} after Holm's \
                     correction. Arrows: the interval goes on.",
                    escaped(&findings.groups[pair[1]])
                ),
            )
        };
        if let Some(drawn) = drawn {
            text += &format!("<h3>{}</h3>\n", pair_title(findings, *pair));
            text += &figure(&drawn, &caption);
        }
    }
    text
}

fn overlays(findings: &Findings, arguments: &CompareNetworksArguments) -> Result<String, Failure> {
    let mut text = String::new();
    for pair in &findings.overlays {
        let leaves = pair.map(|leaf| &findings.leaves[leaf]);
        let Some(drawn) = overlay(leaves, arguments.align)? else {
            continue;
        };
        let [one, other] = leaves.map(|leaf| escaped(&leaf.name));
        text += &format!(
            "<h3><span class=\"key b0\"></span>{one} (margin drawn through) and \
             <span class=\"key b1\"></span>{other} (margin dashed)</h3>\n"
        );
        text += &figure(&drawn.figure, &escaped(&drawn.caption));
    }
    if arguments.overlay.is_empty() && findings.groups.len() > MOST + 1 {
        text += &format!(
            "<p class=\"soft\">The first {MOST} only; --overlay NAME NAME draws others.</p>\n"
        );
    }
    Ok(text)
}

fn tables(findings: &Findings) -> String {
    if findings.compared.measures.is_empty() {
        return String::new();
    }
    let pairs = findings.compared.pairs.iter().enumerate();
    let text = pairs.map(|(number, pair)| {
        if findings.is_single {
            single_table(findings, number, *pair)
        } else {
            group_table(findings, number, *pair)
        }
    });
    text.collect()
}

fn link(measure: &Measure) -> String {
    let place = anchor(measure.key, measure.part);
    let name = escaped(&label(measure.key, measure.part));
    format!("<a href=\"#{place}\">{name}</a>")
}

fn four(value: Option<f64>) -> String {
    value.map_or_else(|| DASH.to_owned(), |value| short(value, 4))
}

fn single_table(findings: &Findings, number: usize, pair: [usize; 2]) -> String {
    let [one, other] = pair.map(|group| key(findings, group));
    let header = ["measure", &one, &other, "difference", "ratio", "unit"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for measure in &findings.compared.measures {
        let [first, second] = pair.map(|group| measure.summaries[group].map(|found| found.mean));
        let contrast = measure.contrasts[number];
        rows.push(vec![
            link(measure),
            four(first),
            four(second),
            four(contrast.difference),
            three(contrast.ratio),
            escaped(measure.unit),
        ]);
    }
    table(&pair_title(findings, pair), "", &rows, &[])
}

/// Mean ± standard deviation, and the number of leaves.
fn shown_summary(summary: Option<Summary>) -> String {
    summary.map_or_else(
        || DASH.to_owned(),
        |found| {
            let mean = short(found.mean, 4);
            let spread = found
                .deviation
                .map(|spread| format!(" ± {}", short(spread, 2)));
            format!("{mean}{} ({})", spread.unwrap_or_default(), found.count)
        },
    )
}

fn group_table(findings: &Findings, number: usize, pair: [usize; 2]) -> String {
    let [one, other] = pair.map(|group| key(findings, group));
    let header = [
        "measure",
        &one,
        &other,
        "unit",
        "ratio",
        "Hedges' g [95 %]",
        "Cliff's δ [95 %]",
        test_of_means(findings, pair),
        "Holm",
        "FDR",
        "M–W p",
        "Holm",
        "FDR",
    ];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    let mut sure = Vec::new();
    for measure in &findings.compared.measures {
        let contrast = measure.contrasts[number];
        let untested = || contrast.untested.unwrap_or(DASH).to_owned();
        let effect = |effect: Option<Effect>| effect.map_or_else(|| DASH.to_owned(), shown_effect);
        let [first, second] = pair.map(|group| shown_summary(measure.summaries[group]));
        let mut row = vec![
            link(measure),
            first,
            second,
            escaped(measure.unit),
            three(contrast.ratio),
            contrast.g.map_or_else(untested, shown_effect),
            effect(contrast.delta),
        ];
        row.extend(shown_tests(contrast.means));
        row.extend(shown_tests(contrast.orders));
        rows.push(row);
        sure.push(contrast.means.is_some_and(|tested| tested.holm <= LEVEL));
    }
    let caption = format!(
        "{}: mean ± standard deviation (leaves). Bold: p of the test of means is at most {LEVEL} after Holm's \
         correction. FDR: corrected by Benjamini and Hochberg.",
        pair_title(findings, pair)
    );
    table(&caption, "", &rows, &sure)
}

fn cards(findings: &Findings) -> String {
    let mut text = String::new();
    if findings.compared.measures.is_empty() {
        return text;
    }
    if !findings.is_single {
        text += "<p class=\"soft\">Marks are leaves; bars are means, lines their 95 % intervals by \
                 Student's t.</p>\n";
    }
    text += "<div class=\"cards\">\n";
    for measure in &findings.compared.measures {
        let place = anchor(measure.key, measure.part);
        let of_order = measure
            .part
            .map_or_else(String::new, |part| format!(", part {part}"));
        text += &format!(
            "<article class=\"card\" id=\"{place}\">\n<h3>{}</h3>\n<p class=\"soft small\">{}{of_order}\
             {}</p>\n{}</article>\n",
            escaped(&label(measure.key, measure.part)),
            escaped(&capital(measure.definition)),
            unit_words(measure.unit),
            figure(&figures::strip(findings, measure), ""),
        );
    }
    text + "</div>\n"
}
