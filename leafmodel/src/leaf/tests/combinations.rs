//! Any outline with any venation.

use super::super::*;
use crate::blade::tissue::Tissue;
use crate::leaf::outline_plan::OutlinePlan;
use crate::leaf::tests::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::cubic_margin::CubicMargin;
use crate::shape::svg_path::SvgContour;
use crate::species::find;
use crate::transport::{FilledPlan, VeinStyle};

/// A leaf as one would trace it from a photograph: oblique, with one lobe more on its right, drawn
/// upside down.
const TRACED: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M210 30 C260 90 330 120 300 190 \
    C360 200 380 260 300 330 C290 390 250 420 205 470 C150 430 90 380 80 300 C70 200 150 120 210 30 Z\"/></svg>";

fn preset(name: &str) -> LeafPlan {
    find(name).expect("a preset").plan()
}

fn outlines() -> Vec<(&'static str, OutlinePlan)> {
    let traced = SvgContour::parse("leaf.svg", TRACED, None).expect("a good file");
    let mut outlines = vec![
        ("traced", Contour::Svg(traced).into()),
        ("cubic", Contour::Cubic(CubicMargin::default()).into()),
    ];
    // Growth algorithm, lobed and with unlike halves and axes; a toothed curve; transport.
    let presets = [
        "young-3b",
        "young-7d",
        "begonia",
        "maple-palmate",
        "birch",
        "xia-1",
    ];
    outlines.extend(presets.map(|name| (name, preset(name).outline)));
    outlines
}

fn venations() -> [(&'static str, VenationPlan); 4] {
    let style = VeinStyle {
        base_radius_mm: 0.5,
        least_cells: 3,
    };
    let filled = FilledPlan {
        cells_along: 40,
        style,
        ..FilledPlan::default()
    };
    [
        ("closed", preset("young-3b").venation),
        ("open", preset("runions-9b").venation),
        ("arcuate", preset("pinnate").venation),
        ("transport", filled.into()),
    ]
}

#[test]
#[ignore = "deep: 9 s"]
fn any_outline_goes_with_any_venation_and_becomes_a_blade() {
    for (outline_name, outline) in outlines() {
        for (venation_name, venation) in venations() {
            let name = format!("{outline_name} with {venation_name} veins");
            let plan = LeafPlan {
                outline: outline.clone(),
                venation,
                map_size: 32,
                tissue: Tissue {
                    mottle: 0.0,
                    ..preset("young-3b").tissue
                },
                ..preset("young-3b")
            };
            plan.check_lamina()
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            let leaf = Leaf::grow(&plan).unwrap_or_else(|e| panic!("{name}: {e}"));
            let Lamina {
                outline, network, ..
            } = &leaf.lamina;
            assert_eq!(network.validate(), Ok(()), "{name}");
            assert!(
                network.edges().len() > 20,
                "{name}: {}",
                network.edges().len()
            );
            let covered = |p| outline.covers(p);
            let slack = 1e-6 * outline.length();
            for node in network.nodes() {
                let p = node.position;
                assert!(
                    covered(p) || outline.distance_to_margin(p) < slack,
                    "{name}: {p}"
                );
            }
            assert_eq!(leaf.mesh.validate(outline.area()), Ok(()), "{name}");
        }
    }
}
