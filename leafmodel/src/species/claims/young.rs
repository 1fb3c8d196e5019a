//! The paper's claims about each figure, tested on measures of the outlines.

use crate::measure::{Measures, shape};
use crate::shape::growth_form::{GrowthForm, RowGrowth, Side};
use crate::shape::outline::Outline;
use crate::species::{PRESETS, find};

const LENGTH: f64 = 100.0;

/// The paper's typical number of rows of cells.
const ROWS: usize = 150;

fn form(panel: &str) -> GrowthForm {
    let found = find(&format!("young-{panel}"));
    let plan = found.unwrap_or_else(|| panic!("no figure {panel}")).plan();
    plan.outline.growth_form().expect("it grows").clone()
}

fn outline(panel: &str) -> Outline {
    form(panel).grow(LENGTH).expect("a form of the paper")
}

fn number(measures: &Measures, key: &str) -> f64 {
    let number = measures.number(key);
    number.unwrap_or_else(|| panic!("{key} is missing"))
}

/// One measure for each of the four panels of a figure.
fn row(figure: u8, key: &str) -> [f64; 4] {
    ["a", "b", "c", "d"].map(|panel| number(&shape(&outline(&format!("{figure}{panel}"))), key))
}

fn near(found: [f64; 4], expected: [f64; 4], tolerance: f64) {
    let off = found.iter().zip(expected).map(|(f, e)| (f - e).abs());
    assert!(
        off.fold(0.0, f64::max) < tolerance,
        "{found:?} are not {expected:?}"
    );
}

fn rises(values: [f64; 4]) -> bool {
    values.windows(2).all(|pair| pair[0] < pair[1])
}

/// Half width at each row, for forms without slopes.
fn half_widths(panel: &str) -> Vec<f64> {
    outline(panel).points()[1..=ROWS]
        .iter()
        .map(|p| p.x)
        .collect()
}

#[test]
fn from_broadly_ovate_to_lanceolate_leaves_narrow_as_the_closed_form_says() {
    let closed = [1.07, 1.2, 1.5, 1.71].map(|ratio| {
        let power = libm::log(1.0 + 0.1 / ratio) / libm::log(1.1) - 1.0;
        2.0 * libm::pow(1000.0, power)
    });
    near(row(3, "width_over_length"), closed, 1e-12);
    near(closed, [1.298, 0.661, 0.215, 0.123], 0.0005);
}

#[test]
fn from_deltoid_to_obdeltoid_the_widest_place_follows_the_fastest_growth() {
    // Tolerance: half a row.
    near(
        row(4, "widest_at"),
        [0.1, 0.4, 0.7, 0.9],
        0.5 / 149.0 + 1e-12,
    );
    near(row(4, "width_over_length"), [0.661; 4], 0.0005);
}

#[test]
fn deltoid_and_obdeltoid_are_exact_mirror_images() {
    let (mut low, high) = (half_widths("4a"), half_widths("4d"));
    low.reverse();
    assert_eq!(low, high);
}

#[test]
fn the_concave_leaf_is_concave_and_the_oblong_one_convex() {
    let bend = |panel: &str| -> Vec<f64> {
        let widths = half_widths(panel);
        widths
            .windows(3)
            .map(|w| w[0] - 2.0 * w[1] + w[2])
            .collect()
    };
    // Of 148 inner rows, 73 and 74 are next to the widest place, where concave branches meet in a
    // point.
    let concave = bend("5a");
    for (row, bend) in concave.iter().enumerate() {
        assert!(*bend > 0.0 || row.abs_diff(73) <= 1, "row {row}: {bend}");
    }
    // A convex margin has its inflection at 9 T ln(1 + gL0) u⁹ = 8: u = 0.81.
    let convex = bend("5d");
    for (row, bend) in convex.iter().enumerate() {
        let away = (row as f64 - 73.5).abs() / 74.5;
        assert!(*bend <= 0.0 || away > 0.8, "row {row}: {bend}");
    }
    let solidity = row(5, "solidity");
    near(solidity, [0.352, 0.565, 0.849, 0.970], 0.003);
    assert!(rises(solidity));
    // Orbiculate: nearer to round than its neighbours.
    let round = row(5, "circularity");
    assert!(round[2] > round[1] && round[2] > round[0], "{round:?}");
}

#[test]
fn slopes_make_the_base_cordate_and_the_tip_obcordate() {
    let reach = ["6a", "6b", "6c", "6d"].map(|panel| {
        let (low, high) = outline(panel).bounds();
        (low.y / LENGTH, high.y / LENGTH)
    });
    // Cordate: lobes below the petiole. Deltoid: no lower than the primordium's own half width of
    // 0.001 slopes down.
    assert!(reach[0].0 < -0.08, "{reach:?}");
    assert!((reach[1].0 + 0.0007).abs() < 1e-9, "{reach:?}");
    assert_eq!((reach[2].0, reach[3].0), (0.0, 0.0));
    assert!((reach[3].1 - 1.55).abs() < 0.01, "{reach:?}");
    assert!(reach[..3].iter().all(|reach| reach.1 < 1.01), "{reach:?}");
    assert!(rises(row(6, "widest_at")));
    // A shear along the midrib leaves the area alone.
    let areas = row(6, "area_mm2");
    near(areas, [areas[0]; 4], 1e-9 * areas[0]);
}

#[test]
fn oak_leaves_are_the_more_dissected_the_larger_the_decay() {
    near(row(7, "circularity"), [0.633, 0.592, 0.450, 0.248], 0.01);
    near(row(7, "solidity"), [0.849, 0.832, 0.784, 0.675], 0.01);
    near(row(8, "circularity"), [0.633, 0.572, 0.471, 0.243], 0.01);
    for figure in [7, 8, 9] {
        let mut dissected = row(figure, "circularity");
        if figure < 9 {
            dissected.reverse();
        }
        assert!(rises(dissected), "Fig. {figure}: {dissected:?}");
    }
}

#[test]
fn both_rows_of_oaks_begin_with_the_same_entire_leaf() {
    assert_eq!(outline("7a"), outline("8a"));
}

#[test]
fn lobes_of_white_oaks_are_rounded_and_those_of_red_oaks_pointed() {
    // With ten times as many rows, the turn from edge to edge falls to a tenth at the tip of a
    // rounded lobe and stays at that of a pointed one.
    let turn_at_a_tip = |panel: &str, finer: usize| {
        let mut shape = form(panel);
        let half = &mut shape.midrib.right;
        half.lobe_decay *= libm::pow(finer as f64, -half.lobe_exponent);
        shape.midrib.rows = 149 * finer + 1;
        let outline = shape.grow(LENGTH).expect("a form of the paper");
        let tip = 1 + 44 * finer;
        let [before, here, after] = [tip - 1, tip, tip + 1].map(|i| outline.points()[i]);
        (here - before).angle_to(after - here)
    };
    for panel in ["7c", "7d"] {
        let (coarse, fine) = (turn_at_a_tip(panel, 1), turn_at_a_tip(panel, 10));
        assert!(
            coarse > 0.0 && fine < 0.15 * coarse,
            "{panel}: {coarse}, {fine}"
        );
    }
    for panel in ["8c", "8d"] {
        let (coarse, fine) = (turn_at_a_tip(panel, 1), turn_at_a_tip(panel, 10));
        assert!(
            coarse > 0.2 && fine > 0.9 * coarse,
            "{panel}: {coarse}, {fine}"
        );
    }
}

#[test]
fn the_maple_fills_in_between_its_lobes_until_it_is_entire() {
    let solidity = row(9, "solidity");
    assert!(rises(solidity), "{solidity:?}");
    near(solidity, [0.40, 0.68, 0.88, 0.88], 0.01);
    // Lobes are rows that reach farther out than those beside them.
    let lobes = |panel: &str| {
        let rows = form(panel).row_growth(Side::Right).expect("a good form");
        let reach: Vec<f64> = rows.iter().map(|row| row.half_width).collect();
        let tips = reach.windows(3).filter(|row| row[1] > row[0].max(row[2]));
        tips.filter(|row| row[1] > 0.02).count()
    };
    // The lowest becomes one with that above it as the decay falls.
    assert_eq!(["9a", "9b", "9c"].map(lobes), [4, 3, 3]);
    assert_eq!(lobes("9d"), 1);
}

#[test]
fn botanical_names_are_what_region_of_width_and_proportions_say() {
    // A name says where the leaf is widest (below, about or above the middle) and how long it is
    // relative to its width.
    let of = |panel: &str| {
        let measures = shape(&outline(panel));
        let lengths = 1.0 / number(&measures, "width_over_length");
        (lengths, number(&measures, "widest_at"))
    };
    let ovate = |at: f64| (0.2..0.45).contains(&at);
    for (panel, low, high) in [
        ("3a", 0.7, 1.3),  // broadly ovate: about as long as broad
        ("3b", 1.3, 2.0),  // ovate
        ("3c", 3.0, 6.0),  // broadly lanceolate
        ("3d", 6.0, 12.0), // lanceolate
        ("4b", 1.3, 2.0),  // ovate
    ] {
        let (lengths, at) = of(panel);
        assert!((low..high).contains(&lengths), "{panel}: {lengths}");
        assert!(ovate(at), "{panel}: {at}");
    }
    // Deltoid: widest near the base; obdeltoid and obovate: the same near the tip, and above the
    // middle.
    assert!(of("4a").1 < 0.2 && of("4d").1 > 0.8);
    assert!((0.55..0.8).contains(&of("4c").1), "{:?}", of("4c"));
    assert!(of("6c").1 > 0.6 && of("6d").1 > 0.6);
    assert!(of("6a").1 < 0.45 && of("6b").1 < 0.45);
    // Fig. 5 is widest in the middle, and oblong has parallel flanks.
    for panel in ["5a", "5b", "5c", "5d"] {
        assert!((of(panel).1 - 0.5).abs() < 0.01, "{panel}");
    }
    let width_at = |panel: &str, row: usize| {
        let widths = half_widths(panel);
        widths[row] / widths.iter().copied().fold(0.0, f64::max)
    };
    // A quarter and three quarters up an oblong leaf is as wide as in the middle, a concave one
    // narrower than a rhombic one.
    for row in [37, 112] {
        assert!(width_at("5d", row) > 0.95);
        assert!(
            width_at("5a", row) < width_at("5b", row) && width_at("5b", row) < width_at("5c", row)
        );
    }
}

#[test]
fn exponential_growth_amplifies_the_growth_rate_in_the_outline() {
    // Fig. 2: k = 2.5, yd = 0.3, R = 1.2, s = 0, as Fig. 3b.
    let rows = form("3b").row_growth(Side::Right);
    let rows = rows.expect("a form of the paper");
    assert_eq!(rows.len(), 150);
    let ends = [rows[0], rows[149]].map(|row| [row.place, row.rate]);
    assert_eq!(ends, [[0.0, 0.0], [1.0, 0.0]]);
    let fastest = rows.iter().max_by(|p, q| p.rate.total_cmp(&q.rate));
    let &RowGrowth {
        place: at,
        rate: greatest,
        ..
    } = fastest.expect("150 rows");
    assert!((at - 0.3).abs() < 0.5 / 149.0 && (greatest - 0.1 / 1.2).abs() < 1e-15);
    // The growth beyond the primordium's half width.
    let grown = |row: &RowGrowth| row.half_width - 0.001;
    let widest = rows.iter().map(grown).fold(0.0, f64::max);
    for (row, x) in rows.iter().zip(half_widths("3b")) {
        assert!((row.half_width * LENGTH - x).abs() < 1e-12);
    }
    for row in &rows[1..149] {
        // Eq. 3.
        let u = (row.place - at).abs() / if row.place <= at { at } else { 1.0 - at };
        let expected = greatest * (1.0 - libm::pow(u, 2.5));
        assert!((row.rate - expected).abs() < 1e-15, "{row:?}");
        assert!(
            row.place == at || grown(row) / widest < row.rate / greatest,
            "{row:?}"
        );
    }
}

#[test]
#[ignore = "deep: 5 s"]
fn every_form_becomes_a_leaf() {
    let forms = PRESETS
        .iter()
        .filter(|preset| preset.name.starts_with("young-"));
    for form in forms {
        let leaf = crate::leaf::Leaf::grow(&form.plan());
        let leaf = leaf.unwrap_or_else(|error| panic!("{}: {error}", form.name));
        assert_eq!(
            leaf.mesh.validate(leaf.lamina.outline.area()),
            Ok(()),
            "{}",
            form.name
        );
    }
}
