//! Warnings about unusual but allowed properties of a grown leaf.

use leafmodel::leaf::{Lamina, LeafPlan};
use leafmodel::optics::Contents;
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::Ending;

/// Greatest plausible width of the midrib as a share of the leaf's; some needles come close to it.
const WIDEST_SHARE: f64 = 0.2;
/// Least share of a primary vein's length; a shorter one does not lead into its lobe.
const STUB: f64 = 0.5;

/// Warnings about a lamina grown from this plan.
pub(crate) fn of(plan: &LeafPlan, lamina: &Lamina) -> Vec<String> {
    let mut warnings = Vec::new();
    let network = &lamina.network;
    match network.ending() {
        Ending::Settled | Ending::Growing => {}
        Ending::StepLimit => warnings.push(format!(
            "the pattern had not settled after {} steps",
            network.steps()
        )),
    }
    if let Some([anthocyanins, betalains]) = plan.anthocyanins_beside_betalains() {
        warnings.push(format!(
            "the leaf holds anthocyanins ({anthocyanins}) and betalains ({betalains}), which never occur in the same plant: {}",
            Contents::NEVER_TOGETHER
        ));
    }
    if network.edges().is_empty() {
        let advice = plan.venation.advice_without_veins();
        warnings.push(format!("no vein grew; {advice}"));
    }
    let width = width(&lamina.outline);
    let too_wide = |what: &str, radius: f64, key: &str| {
        let across = 2.0 * radius;
        (across > WIDEST_SHARE * width).then(|| {
            format!(
                "{what} is {across:.3} mm across, and the leaf {width:.3} mm wide; a smaller {key} makes it thinner"
            )
        })
    };
    let widest = network
        .edges()
        .iter()
        .map(|edge| edge.radius_from.max(edge.radius_to))
        .fold(0.0, f64::max);
    let key = plan.venation.width_key();
    warnings.extend(too_wide("the widest vein", widest, key));
    // Without its own radius it has that of the midrib.
    let petiole = plan.petiole.as_ref().and_then(|petiole| petiole.radius_mm);
    warnings
        .extend(petiole.and_then(|radius| too_wide("the petiole", radius, "petiole.radius_mm")));
    warnings.extend(stubs(plan, lamina));
    warnings
}

/// A warning about primaries that end at the margin long before the tip of their lobe.
fn stubs(plan: &LeafPlan, lamina: &Lamina) -> Option<String> {
    let shares = plan
        .venation
        .arcuate()?
        .primaries_laid(&lamina.outline)
        .ok()?;
    let cut = shares.iter().filter(|&&share| share < STUB).count();
    let all = shares.len();
    (cut > 0).then(|| {
        format!(
            "{cut} of {all} primary veins are cut at the margin before half of their length: bays of the blade lie in their \
             way; try another palmate.spread or per_side, or shallower lobes"
        )
    })
}

/// Greatest extent across the midrib, mm.
fn width(outline: &Outline) -> f64 {
    let along = (outline.apex() - outline.base()).normalize_or_zero();
    let across = outline.points().iter().map(|p| along.perp_dot(*p));
    let (low, high) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    high - low
}

#[cfg(test)]
mod tests {
    use leafmodel::blade::petiole::PetiolePlan;
    use leafmodel::leaf::venation_plan::VenationPlan;
    use leafmodel::species::find;
    use leafmodel::transport::VeinStyle;
    use leafmodel::venation::arcuate::{ArcuatePlan, PalmateVeins};

    use super::*;

    fn preset(name: &str) -> LeafPlan {
        find(name).expect("a preset").plan()
    }

    fn told(plan: &LeafPlan) -> Vec<String> {
        of(plan, &plan.grow_lamina().expect("a good plan"))
    }

    fn styled(base_radius_mm: f64, least_cells: u32) -> LeafPlan {
        LeafPlan {
            venation: VenationPlan::Cells(VeinStyle {
                base_radius_mm,
                least_cells,
            }),
            ..preset("xia-1")
        }
    }

    #[test]
    fn presets_as_they_are_need_no_warning() {
        for name in ["poplar", "xia-1", "arcuate", "young-9a"] {
            assert_eq!(told(&preset(name)), [""; 0], "{name}");
        }
    }

    #[test]
    fn veins_and_petioles_too_wide_for_the_leaf_are_reported() {
        let warnings = told(&styled(50.0, 1));
        assert_eq!(warnings.len(), 1);
        assert!(
            warnings[0].contains("the widest vein is 100.000 mm across"),
            "{warnings:?}"
        );
        let mut plan = preset("poplar");
        plan.petiole = Some(PetiolePlan {
            length: 1.0,
            radius_mm: Some(100.0),
            curl: 0.0,
            course: leafmodel::blade::petiole::Course::STRAIGHT,
            section: leafmodel::blade::petiole::Section::default(),
        });
        let warnings = told(&plan);
        assert_eq!(warnings.len(), 1);
        assert!(
            warnings[0].contains("the petiole is 200.000 mm across"),
            "{warnings:?}"
        );
    }

    #[test]
    fn a_leaf_without_veins_is_reported_what_its_own_kind_needs() {
        let warnings = told(&styled(0.3, 1_000_000));
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].contains("least_cells"), "{warnings:?}");
    }

    #[test]
    fn primaries_cut_short_by_deep_bays_are_reported() {
        let palmate = |name| LeafPlan {
            venation: ArcuatePlan {
                palmate: Some(PalmateVeins {
                    per_side: 2,
                    spread: 0.8,
                    bow: 0.15,
                }),
                ..ArcuatePlan::default()
            }
            .into(),
            ..preset(name)
        };
        let warnings = told(&palmate("young-9a"));
        assert!(
            warnings.iter().any(|w| w.contains("primary veins are cut")),
            "{warnings:?}"
        );
        assert_eq!(told(&palmate("poplar")), [""; 0]);
    }
}
