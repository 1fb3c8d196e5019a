//! Plots of the report.

use leafmodel::measure::comparison::Effect;

use super::words::{label, shown_effect};
use crate::comparison::Findings;
use crate::comparison::compared::{Distribution, LEVEL, Measure, values};
use crate::plot::{Anchor, Axis, Canvas, short};
use crate::report::page::{anchor, hue};

/// Width of a figure in a card, pixels.
const CARD: f64 = 450.0;
/// Room for names of groups.
const NAMES: f64 = 104.0;
/// Characters of a name that fit into it.
const LETTERS: usize = 16;
/// Height of a group's row.
const ROW: f64 = 30.0;
/// Marks nearer to each other than this stand in different lanes.
const APART: f64 = 6.5;
/// Lanes of marks, pixels from the first.
const LANES: [f64; 5] = [0.0, -4.5, 4.5, -9.0, 9.0];

/// A name that fits into so many letters.
fn fitting(name: &str, letters: usize) -> String {
    if name.chars().count() <= letters {
        return name.to_owned();
    }
    let kept: String = name.chars().take(letters - 1).collect();
    format!("{}…", kept.trim_end())
}

/// The values of each leaf, a row for each group, with the mean and its interval.
pub(super) fn strip(findings: &Findings, measure: &Measure) -> String {
    let rows = measure.values.len() as f64;
    let floor = 6.0 + rows * ROW;
    let mut canvas = Canvas::new([CARD, floor + 36.0]);
    let all = measure.values.iter().flatten().map(|(_, value)| *value);
    let ends = measure.summaries.iter().flatten();
    let ends = ends.filter_map(|found| found.interval).flatten();
    let x = Axis::around(all.chain(ends), [NAMES + 10.0, CARD - 14.0]);
    axis(&mut canvas, &x, [6.0, floor], &unit_label(measure.unit));
    for (group, values) in measure.values.iter().enumerate() {
        let middle = 6.0 + (group as f64 + 0.5) * ROW;
        let name = fitting(&findings.groups[group], LETTERS);
        canvas.text([NAMES, middle + 4.0], Anchor::End, "", &name);
        if values.is_empty() {
            canvas.text(
                [NAMES + 16.0, middle + 4.0],
                Anchor::Start,
                "class=\"soft\"",
                "missing",
            );
        }
        if let Some(summary) = measure.summaries[group]
            && let Some([low, high]) = summary.interval
        {
            let style = format!("class=\"s{}\" stroke-width=\"2\"", hue(group));
            canvas.line([x.at(low), middle], [x.at(high), middle], &style);
            let at = x.at(summary.mean);
            let style = format!("class=\"s{}\" stroke-width=\"3\"", hue(group));
            canvas.line([at, middle - 9.0], [at, middle + 9.0], &style);
        }
        let mut places: Vec<f64> = values.iter().map(|(_, value)| x.at(*value)).collect();
        places.sort_by(f64::total_cmp);
        let mut last = [f64::NEG_INFINITY; LANES.len()];
        for at in places {
            let free = last.iter().position(|last| at - last >= APART);
            let lane = free.unwrap_or(0);
            last[lane] = at;
            mark(&mut canvas, group, [at, middle + LANES[lane]], true);
        }
    }
    let title = label(measure.key, measure.part);
    canvas.figure(&format!("Values of {title} of each leaf, by group"))
}

/// The mark of a group: its hue and its form.
fn mark(canvas: &mut Canvas, group: usize, [x, y]: [f64; 2], is_full: bool) {
    let hue = hue(group);
    let style = if is_full {
        format!("class=\"f{hue}\" fill-opacity=\"0.8\"")
    } else {
        format!("class=\"paper s{hue}\" stroke-width=\"1.5\"")
    };
    match group % 4 {
        0 => canvas.circle([x, y], 3.2, &style),
        1 => canvas.path(&format!("M{:.1} {:.1}l3.8 6.6h-7.6Z", x, y - 4.4), &style),
        2 => canvas.rectangle([x - 2.9, y - 2.9], [5.8, 5.8], &style),
        _ => canvas.path(&format!("M{:.1} {:.1}l4 4l-4 4l-4-4Z", x, y - 4.0), &style),
    }
}

/// An axis below a plot, with lines up from its ticks and what it counts.
fn axis(canvas: &mut Canvas, x: &Axis, [top, floor]: [f64; 2], title: &str) {
    let [left, right] = x.pixels();
    for tick in x.ticks(5) {
        canvas.line([tick.at, top], [tick.at, floor], "class=\"grid\"");
        canvas.line([tick.at, floor], [tick.at, floor + 4.0], "class=\"axis\"");
        canvas.text([tick.at, floor + 16.0], Anchor::Middle, "", &tick.label);
    }
    canvas.line([left, floor], [right, floor], "class=\"axis\"");
    let at = [0.5 * (left + right), floor + 31.0];
    canvas.text(at, Anchor::Middle, "class=\"soft\"", title);
}

fn unit_label(unit: &str) -> String {
    if unit.is_empty() {
        "pure number".to_owned()
    } else {
        unit.to_owned()
    }
}

/// The cumulative curves of single values: of each leaf, and the mean of each group.
pub(super) fn curves(findings: &Findings, distribution: &Distribution) -> String {
    const HEIGHT: f64 = 210.0;
    const TOP: f64 = 26.0;
    const STEPS: usize = 160;
    let mut canvas = Canvas::new([CARD, TOP + HEIGHT + 38.0]);
    let ([low, high], is_logarithmic) = range(findings, distribution);
    let pixels = [44.0, CARD - 14.0];
    let x = if is_logarithmic {
        Axis::logarithmic([low, high], pixels)
    } else {
        Axis::linear([low, high], pixels)
    };
    let floor = TOP + HEIGHT;
    axis(
        &mut canvas,
        &x,
        [TOP, floor],
        &unit_label(distribution.unit),
    );
    let y = Axis::linear([0.0, 1.0], [floor, TOP]);
    for tick in y.ticks(5) {
        canvas.line([pixels[0], tick.at], [pixels[1], tick.at], "class=\"grid\"");
        canvas.text(
            [pixels[0] - 6.0, tick.at + 4.0],
            Anchor::End,
            "",
            &tick.label,
        );
    }
    let at = |step: usize| {
        let share = step as f64 / STEPS as f64;
        if is_logarithmic {
            low * libm::pow(high / low, share)
        } else {
            low + share * (high - low)
        }
    };
    let below = |leaf: usize, value: f64| {
        let values = values(&findings.leaves[leaf], distribution.kind);
        values.partition_point(|other| *other <= value) as f64 / values.len() as f64
    };
    for (group, members) in distribution.leaves.iter().enumerate() {
        let hue = hue(group);
        if members.len() > 1 {
            for leaf in members {
                let points = (0..=STEPS).map(|step| [x.at(at(step)), y.at(below(*leaf, at(step)))]);
                let style =
                    format!("class=\"s{hue}\" stroke-width=\"0.8\" stroke-opacity=\"0.35\"");
                canvas.polyline(points, &style);
            }
        }
        let count = members.len() as f64;
        let mean = |value: f64| members.iter().map(|leaf| below(*leaf, value)).sum::<f64>() / count;
        if !members.is_empty() {
            let points = (0..=STEPS).map(|step| [x.at(at(step)), y.at(mean(at(step)))]);
            let style = format!("class=\"s{hue}\" stroke-width=\"2\"{}", dash(group));
            canvas.polyline(points, &style);
        }
    }
    legend(&mut canvas, findings, [pixels[0], 12.0]);
    canvas.figure(&format!(
        "Cumulative curves of {} of each group",
        distribution.kind
    ))
}

/// How the line of a group is broken.
fn dash(group: usize) -> &'static str {
    match group % 4 {
        0 => "",
        1 => " stroke-dasharray=\"7 3\"",
        2 => " stroke-dasharray=\"2 3\"",
        _ => " stroke-dasharray=\"9 3 2 3\"",
    }
}

/// The names of all groups beside their lines, in one row as far as there is room.
fn legend(canvas: &mut Canvas, findings: &Findings, [mut x, y]: [f64; 2]) {
    for (group, name) in findings.groups.iter().enumerate() {
        let name = fitting(name, LETTERS);
        let wide = 30.0 + 6.4 * name.chars().count() as f64 + 12.0;
        if x + wide > CARD {
            canvas.text([x, y], Anchor::Start, "class=\"soft\"", "…");
            return;
        }
        let style = format!(
            "class=\"s{}\" stroke-width=\"2\"{}",
            hue(group),
            dash(group)
        );
        canvas.line([x, y - 4.0], [x + 24.0, y - 4.0], &style);
        canvas.text([x + 29.0, y], Anchor::Start, "", &name);
        x += wide;
    }
}

/// From the least half percent of any leaf's values to the most; and whether the middle nine tenths
/// differ so much in size that their logarithms are drawn.
fn range(findings: &Findings, distribution: &Distribution) -> ([f64; 2], bool) {
    let ends = |share: f64| {
        let leaves = distribution.leaves.iter().flatten();
        let ends = leaves.filter_map(|leaf| {
            let values = values(&findings.leaves[*leaf], distribution.kind);
            let last = values.len().checked_sub(1)? as f64;
            Some([share, 1.0 - share].map(|share| values[(share * last) as usize]))
        });
        ends.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)])
    };
    let [low, high] = match ends(0.005) {
        Some([low, high]) if low < high => [low, high],
        Some([low, _]) => [low - 0.5, low + 0.5],
        None => [0.0, 1.0],
    };
    let is_wide = ends(0.05).is_some_and(|[low, high]| low > 0.0 && high > 10.0 * low);
    (
        [low, high],
        is_wide && low > 0.0 && distribution.unit != "°",
    )
}

/// A row of an overview.
struct Line {
    key: &'static str,
    part: Option<usize>,
    effect: Effect,
    shown: String,
    is_sure: bool,
}

/// Hedges' g of all measures with its interval; full marks remain after Holm's correction.
pub(super) fn effects(findings: &Findings, pair: usize) -> Option<String> {
    let lines: Vec<Line> = findings
        .compared
        .measures
        .iter()
        .filter_map(|measure| {
            let contrast = measure.contrasts[pair];
            let effect = contrast.hedges_g?;
            Some(Line {
                key: measure.key,
                part: measure.part,
                effect,
                shown: shown_effect(effect),
                is_sure: contrast.means().is_some_and(|tested| tested.holm <= LEVEL),
            })
        })
        .collect();
    let farthest = |line: &Line| {
        line.effect
            .interval
            .map(f64::abs)
            .into_iter()
            .fold(0.0, f64::max)
    };
    let mut sizes: Vec<f64> = lines.iter().map(farthest).collect();
    sizes.sort_by(f64::total_cmp);
    // A few huge effects must not make all others invisible.
    let most = sizes.get(sizes.len() * 9 / 10)?;
    let reach = most.clamp(2.0, 40.0);
    let title = "Hedges' g (difference of means in standard deviations)";
    let axis = |pixels| Axis::linear([-reach, reach], pixels);
    Some(overview(
        &lines,
        &axis,
        0.0,
        title,
        reach,
        findings.compared.pairs[pair][1],
    ))
}

/// Ratios of all measures of two networks.
pub(super) fn ratios(findings: &Findings, pair: usize) -> Option<String> {
    let lines: Vec<Line> = findings
        .compared
        .measures
        .iter()
        .filter_map(|measure| {
            let ratio = measure.contrasts[pair].ratio?;
            Some(Line {
                key: measure.key,
                part: measure.part,
                effect: Effect {
                    value: ratio,
                    interval: [ratio, ratio],
                },
                shown: short(ratio, 4),
                is_sure: true,
            })
        })
        .collect();
    let size = |line: &Line| libm::log(line.effect.value).abs();
    let mut sizes: Vec<f64> = lines.iter().map(size).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes.get(sizes.len() * 9 / 10)?;
    let reach = libm::exp((1.3 * most).clamp(0.05, 3.0));
    let [one, other] = findings.compared.pairs[pair].map(|group| &findings.groups[group]);
    let title = format!("{} over {}", fitting(other, 30), fitting(one, 30));
    let axis = |pixels| Axis::logarithmic([1.0 / reach, reach], pixels);
    Some(overview(
        &lines,
        &axis,
        1.0,
        &title,
        reach,
        findings.compared.pairs[pair][1],
    ))
}

/// A row for each measure: its name, its effect with the interval, and the numbers.
fn overview(
    lines: &[Line],
    axis_of: &dyn Fn([f64; 2]) -> Axis,
    none: f64,
    title: &str,
    reach: f64,
    group: usize,
) -> String {
    const LINE: f64 = 19.0;
    const WIDTH: f64 = 960.0;
    const PIXELS: [f64; 2] = [300.0, 790.0];
    let floor = 4.0 + LINE * lines.len() as f64;
    let mut canvas = Canvas::new([WIDTH, floor + 38.0]);
    for number in (0..lines.len()).step_by(2) {
        let corner = [0.0, 4.0 + LINE * number as f64];
        canvas.rectangle(corner, [WIDTH, LINE], "class=\"band\"");
    }
    let x = axis_of(PIXELS);
    axis(&mut canvas, &x, [4.0, floor], title);
    let at = x.at(none);
    canvas.line([at, 4.0], [at, floor], "class=\"axis\"");
    let lowest = if none > 0.0 { 1.0 / reach } else { -reach };
    for (number, line) in lines.iter().enumerate() {
        let middle = 4.0 + LINE * (number as f64 + 0.5);
        canvas.linked(&anchor(line.key, line.part), |canvas| {
            let name = fitting(&label(line.key, line.part), 44);
            canvas.text([PIXELS[0] - 10.0, middle + 4.0], Anchor::End, "", &name);
        });
        let style = format!("class=\"s{}\" stroke-width=\"1.5\"", hue(group));
        let [low, high] = line.effect.interval;
        canvas.line([x.at(low), middle], [x.at(high), middle], &style);
        // An arrow where it goes on.
        if high > reach {
            let end = PIXELS[1];
            canvas.path(
                &format!("M{:.1} {:.1}l5 4l-5 4", end - 5.0, middle - 4.0),
                &open(group),
            );
        }
        if low < lowest {
            let end = PIXELS[0];
            canvas.path(
                &format!("M{:.1} {:.1}l-5 4l5 4", end + 5.0, middle - 4.0),
                &open(group),
            );
        }
        if (lowest..=reach).contains(&line.effect.value) {
            mark(
                &mut canvas,
                group,
                [x.at(line.effect.value), middle],
                line.is_sure,
            );
        }
        let at = [PIXELS[1] + 14.0, middle + 4.0];
        canvas.text(at, Anchor::Start, "class=\"soft\"", &line.shown);
    }
    canvas.figure(title)
}

fn open(group: usize) -> String {
    format!(
        "class=\"s{}\" fill=\"none\" stroke-width=\"1.5\"",
        hue(group)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_cut_between_letters() {
        assert_eq!(fitting("short", 16), "short");
        assert_eq!(fitting("blätter von der Südseite", 10), "blätter v…");
        assert_eq!(fitting("one two three", 5), "one…");
    }
}
