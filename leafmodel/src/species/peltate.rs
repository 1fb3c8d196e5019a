//! A peltate leaf: garden nasturtium, whose petiole meets the blade inside its margin.
//!
//! The Flora of Victoria (\[vicflora\]) gives a blade from circular to kidney-shaped of 3 to 13 cm,
//! about nine main veins that radiate, and a petiole of up to 60 cm, attached a little off the
//! middle; the flora of New Zealand (\[nzflora\]) an entire margin that often is sinuate. The rest
//! is by eye: depth and places of its undulations, the net, contents, surface and form.

use super::trees::dense_net;
use super::{contours, green_leaf};
use crate::blade::MarginThickness;
use crate::blade::petiole::{Course, PetiolePlan, Section};
use crate::blade::stance::MarginGrowth;
use crate::blade::surface::SurfacePlan;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::OutlinePlan;
use crate::shape::specimen::{Asymmetry, BaseShape, Specimen};
use crate::venation::architecture::{
    Agrophic, Architecture, Arrangement, Attachment, Primaries, PrimaryPattern, Secondaries,
    SecondaryCourse, SecondaryEnding, SecondarySpacing, Tertiaries, TertiaryCourse,
};
use crate::venation::plan::AuxinPlan;

/// From the petiole to the apex, mm.
const LENGTH_MM: f64 = 50.0;
/// How far the blade reaches below the petiole, over that.
const INSET: f64 = 0.45;

/// A circle about a point above the petiole that stands out a little where a primary ends.
fn outline() -> OutlinePlan {
    let places = [
        (0.0, 0.0),
        (0.078, -0.001),
        (0.157, 0.006),
        (0.234, 0.031),
        (0.309, 0.062),
        (0.391, 0.092),
        (0.474, 0.131),
        (0.542, 0.181),
        (0.601, 0.236),
        (0.663, 0.297),
        (0.709, 0.366),
        (0.716, 0.441),
        (0.695, 0.519),
        (0.659, 0.61),
        (0.587, 0.711),
        (0.469, 0.811),
        (0.326, 0.895),
        (0.171, 0.967),
        (0.0, 1.0),
    ];
    OutlinePlan {
        specimen: Specimen {
            base: Some(BaseShape::Peltate { inset: INSET }),
            asymmetry: Asymmetry {
                width: 0.03,
                bow: 0.008,
                wander: 0.004,
            },
            ..Specimen::default()
        },
        ..contours::curve(&places, &[], true).into()
    }
}

/// Nine primaries from the petiole, whose secondaries join in loops before the margin.
fn architecture() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Actinodromous,
            lateral_angles_deg: vec![40.0, 80.0, 120.0, 160.0],
            ..Architecture::default().primaries
        },
        secondaries: Secondaries {
            pairs: 3,
            angles_deg: [42.0, 40.0, 38.0],
            course: SecondaryCourse::Upturned,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Brochidodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.42, 0.8],
            inset: 0.05,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: Tertiaries {
            course: TertiaryCourse::Reticulate,
            spacing: 0.04,
            angle_deg: 90.0,
        },
        irregularity: 0.3,
        ..Architecture::default()
    }
}

pub(super) fn nasturtium() -> LeafPlan {
    let net = dense_net(LENGTH_MM, architecture(), 3.4);
    let venation = AuxinPlan {
        veinlet_radius_mm: 0.09 * LENGTH_MM / net.final_length,
        ..net
    };
    let mut leaf = green_leaf(LENGTH_MM, 1, outline(), venation);
    // The blade is a shield, which undulates at its rim; it has no halves to fold.
    leaf.form.fold = 0.0;
    leaf.form.curl = 0.0;
    leaf.form.ruffle = 0.0;
    leaf.form.margin = MarginThickness {
        share: 0.6,
        width_mm: 0.8,
    };
    leaf.stance.margin_growth = Some(MarginGrowth {
        excess: 0.04,
        width: 0.08,
    });
    leaf.petiole = Some(PetiolePlan {
        length: 2.4,
        radius_mm: Some(1.1),
        curl: 30_f64.to_radians(),
        course: Course {
            sag: 20_f64.to_radians(),
            neck: -15_f64.to_radians(),
            sway: 12_f64.to_radians(),
            stray: 8_f64.to_radians(),
            ..Course::STRAIGHT
        },
        section: Section {
            groove: 0.0,
            flatness: 0.0,
            foot: 0.1,
            head: 0.1,
        },
    });
    // Wax on both faces sheds the rain.
    leaf.surface = Some(SurfacePlan {
        raised: 0.3,
        bulge_mm: 0.03,
        cells_um: 35.0,
        bloom: [0.08, 0.2],
        ..SurfacePlan::SMOOTH
    });
    leaf
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::blade::frame::UvFrame;
    use crate::leaf::Leaf;
    use crate::measure::description::describe;
    use crate::optics::Constituent;

    #[test]
    fn a_nasturtium_is_a_round_shield_on_nine_veins_as_floras_say() {
        let plan = nasturtium();
        let lamina = plan.grow_lamina().expect("a good plan");
        let (low, high) = lamina.outline.bounds();
        for diameter in (high - low).to_array() {
            assert!((30.0..=130.0).contains(&diameter), "{diameter} mm");
        }
        let round = (high.x - low.x) / (high.y - low.y);
        assert!((0.9..1.3).contains(&round), "{round}");
        let found = describe(&lamina.outline, &lamina.network);
        assert_eq!(1 + found.lateral_primaries, 9);
        let petiole = plan.petiole.expect("it has a stalk");
        assert!(petiole.length * plan.length_mm <= 600.0);
        // Off the middle, but well inside the margin.
        let inside = lamina.outline.distance_to_margin(DVec2::ZERO);
        assert!(
            (0.3..0.5).contains(&(inside / (high.y - low.y))),
            "{inside} mm"
        );
    }

    #[test]
    fn a_thin_margin_takes_from_the_contents_what_it_lacks_in_thickness() {
        let thin = LeafPlan {
            map_size: 800,
            ..nasturtium()
        };
        let mut even = thin.clone();
        even.form.margin = MarginThickness::EVEN;
        let [thin, even] = [thin, even].map(|plan| Leaf::grow(&plan).expect("a good plan"));
        let outline = &thin.lamina.outline;
        let frame = UvFrame::around(outline.points());
        let (mut sums, mut shares, mut count) = ([0.0; 2], 0.0, 0.0);
        let map = &even.contents;
        for (number, texel) in map.texels.iter().enumerate() {
            let at = [number % map.width as usize, number / map.width as usize];
            let at = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
            let size = DVec2::new(f64::from(map.width), f64::from(map.height));
            let p = frame.min + frame.size * at / size;
            if outline.contains(p) {
                let dry = [&thin.contents.texels[number], texel];
                for (sum, texel) in sums.iter_mut().zip(dry) {
                    *sum += f64::from(texel[Constituent::DryMatter]);
                }
                shares += nasturtium().form.margin.at(outline.distance_to_margin(p));
                count += 1.0;
            }
        }
        // The mean falls with the mean thickness: the rim holds what tissue as thin as it holds.
        let [found, wanted] = [sums[0] / sums[1], shares / count];
        assert!((found / wanted - 1.0).abs() < 2e-3, "{found} for {wanted}");
        assert!((0.98..0.999).contains(&wanted), "{wanted}");
    }
}
