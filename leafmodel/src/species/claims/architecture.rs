//! What the presets' architectures ask for, held against what is found on the grown leaves.

mod asked;

use super::Grown;
use crate::measure::description::{Description, MarginalVenation, describe};
use crate::species::PRESETS;
use crate::venation::architecture::{
    Architecture, PrimaryPattern, SecondaryCourse, SecondaryEnding, TertiaryCourse,
};

/// How far the mean angle of a third may be from what was asked for, degrees.
const ANGLE: f64 = 10.0;

/// Where a grown leaf is not what its architecture says, in words.
fn disagreements(asked: &Architecture, found: &Description) -> Vec<String> {
    let mut all = Vec::new();
    let mut hold = |holds: bool, what: String| {
        if !holds {
            all.push(what);
        }
    };
    let primaries = &asked.primaries;
    hold(
        found.primaries == Some(primaries.pattern),
        format!("primaries {:?}", found.primaries),
    );
    // A flabellate leaf has as many as its forks give.
    let wanted = 2 * (primaries.lateral_angles_deg.len() + primaries.laterals as usize);
    hold(
        primaries.pattern == PrimaryPattern::Flabellate || found.lateral_primaries == wanted,
        format!("{} lateral primaries", found.lateral_primaries),
    );
    let bent = found.midrib_over_chord.unwrap_or(9.0);
    hold(bent <= 1.02, format!("midrib over chord {bent}"));
    let secondaries = &asked.secondaries;
    if secondaries.pairs == 0 {
        return all;
    }
    hold(
        found.secondaries == [secondaries.pairs as usize; 2],
        format!("secondaries {:?}", found.secondaries),
    );
    hold(
        found.ending == Some(secondaries.ending),
        format!("ending {:?}", found.ending),
    );
    let thirds = secondaries.angles_deg.iter().zip(found.angles_deg);
    for (third, (asked, found)) in thirds.enumerate() {
        let found = found.unwrap_or(*asked);
        hold(
            (found - asked).abs() <= ANGLE,
            format!("angle {found:.1}, not {asked} in third {third}"),
        );
    }
    let is_straight = secondaries.course == SecondaryCourse::Straight;
    hold(
        found.are_straight == Some(is_straight),
        format!("straight: {:?}", found.are_straight),
    );
    hold(
        found
            .spacing
            .is_none_or(|found| found == secondaries.spacing),
        format!("spacing {:?}", found.spacing),
    );
    if secondaries.ending == SecondaryEnding::Craspedodromous {
        let share = found.in_teeth.unwrap_or(0.0);
        hold(
            share >= 0.9,
            format!("{share} of the secondaries end in teeth"),
        );
    }
    let between = found.intersecondaries.unwrap_or(0.0);
    hold(
        (between - secondaries.intersecondaries).abs() <= 0.5,
        format!("{between} intersecondaries"),
    );
    hold(
        found.attachment == Some(secondaries.attachment),
        format!("attachment {:?}", found.attachment),
    );
    // Outer secondaries of lateral primaries are agrophic veins too.
    let is_pinnate = primaries.pattern == PrimaryPattern::Pinnate;
    hold(
        !is_pinnate || found.agrophic == secondaries.agrophic,
        format!("agrophic veins {:?}", found.agrophic),
    );
    let is_fimbrial = found.marginal == Some(MarginalVenation::Fimbrial);
    hold(
        is_fimbrial == asked.is_fimbrial,
        format!("a vein beside {} of the margin", found.accompanied_margin),
    );
    let are_chevrons = asked.tertiaries.course == TertiaryCourse::ChevronPercurrent;
    hold(
        found.tertiaries.are_chevrons() == are_chevrons,
        format!("chevrons {:?}", found.tertiaries.chevrons),
    );
    hold(
        found
            .quaternaries
            .quaternary_course()
            .is_none_or(|course| course == asked.quaternaries.course),
        format!("quaternaries {:?}", found.quaternaries),
    );
    let across = found.tertiaries.across.unwrap_or(0.0);
    let is_percurrent = asked.tertiaries.course != TertiaryCourse::Reticulate;
    hold(
        (across > 0.5) == is_percurrent,
        format!("{across} of the tertiaries run across"),
    );
    if let Some(angle) = found.tertiaries.angle_deg.filter(|_| is_percurrent) {
        hold(
            (angle - asked.tertiaries.angle_deg).abs() <= ANGLE,
            format!("tertiaries at {angle:.1}"),
        );
    }
    all
}

#[test]
fn each_species_is_what_its_architecture_says() {
    let mut described = 0;
    let mut wrong = Vec::new();
    for preset in PRESETS {
        let plan = preset.plan();
        let asked = plan.venation.auxin();
        let Some(asked) = asked.and_then(|plan| plan.architecture.clone()) else {
            continue;
        };
        if preset.is_coloured() {
            continue;
        }
        let leaf = Grown::preset(preset.name);
        let found = describe(&leaf.outline, &leaf.network);
        let mut all = disagreements(&asked, &found);
        let measures = leaf.measures();
        // The 25th to the 75th percentile of cleared leaves of 75 species, but for crossings.
        let all_ranges = [
            ("crossing_count", 0.0..0.5),
            ("vein_density_mm_per_mm2", 2.9..6.0),
            ("areoles_per_mm2", 1.5..7.0),
            ("areole_circularity_median", 0.72..0.82),
            ("areole_elongation_median", 1.54..1.69),
            ("areole_area_cv", 0.9..1.5),
        ];
        // Ginkgo and grass have no net, a trillium a loose one.
        let has_net = !["ginkgo-leaf", "grass-blade"].contains(&preset.name)
            && !preset.name.starts_with("trillium-");
        let ranges = if has_net {
            &all_ranges[..]
        } else {
            &all_ranges[..1]
        };
        for (key, range) in ranges {
            let value = measures.number(key).expect("a net has it");
            if !range.contains(&value) {
                all.push(format!("{key} {value}"));
            }
        }
        wrong.extend(all.iter().map(|what| format!("{}: {what}", preset.name)));
        described += 1;
    }
    assert_eq!(wrong, [""; 0]);
    assert!(described >= 16, "{described}");
}
