//! How primary veins run over a blade.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::course::{Axis, Course};
use super::ground::Ground;
use super::{Architecture, PrimaryPattern, ends, fan};

/// Where along the innermost lateral primary the others of a palinactinodromous leaf leave it.
const RADIATES_AT: f64 = 0.16;

/// The primaries of an architecture, the midrib first, each after the one that it leaves. None for
/// an axis that does not fit.
pub(crate) fn lay_out(architecture: &Architecture, ground: Ground<'_>) -> Vec<Axis> {
    let plan = &architecture.primaries;
    let Ground { blade, lots, .. } = ground;
    let apex = blade.apex();
    let length = apex.length();
    let up = apex / length;
    let to = [apex - up * (0.004 * length)];
    let midrib = Course::curve(DVec2::ZERO, &to, lots, 1, 0, 0.15);
    let mut axes = vec![Axis::new(midrib, 0.0, 0)];
    match plan.pattern {
        PrimaryPattern::Pinnate => {}
        PrimaryPattern::Actinodromous
        | PrimaryPattern::Palinactinodromous
        | PrimaryPattern::Acrodromous => diverging(architecture, ground, &mut axes),
        PrimaryPattern::Parallelodromous | PrimaryPattern::Campylodromous => {
            converging(architecture, ground, &mut axes);
        }
        PrimaryPattern::Flabellate => fan::lay_out(plan, ground, &mut axes),
    }
    axes.sort_by_key(|axis| axis.generation);
    axes
}

/// Lateral primaries at angles of their own.
fn diverging(architecture: &Architecture, ground: Ground<'_>, axes: &mut Vec<Axis>) {
    let plan = &architecture.primaries;
    let Ground {
        blade,
        margin,
        lots,
    } = ground;
    let apex = blade.apex();
    let length = apex.length();
    let up = apex / length;
    let part = up * (plan.part_at * length);
    for side in [1.0, -1.0] {
        let mut innermost: Option<Course> = None;
        for (number, &degrees) in plan.lateral_angles_deg.iter().enumerate() {
            let vein = 1 + 2 * number as u64 + u64::from(side < 0.0);
            let turn = 3.0 * lots.jitter(1, vein, 200);
            let angle = (degrees + turn).to_radians();
            let way = ends::aside(up, angle, side);
            let radiates = plan.pattern == PrimaryPattern::Palinactinodromous;
            let (from, generation) = match &innermost {
                Some(inner) if radiates => (inner.at(RADIATES_AT).0, 2),
                Some(_) | None => (part, 1),
            };
            let (bends, tip): (Vec<DVec2>, _) = if plan.pattern == PrimaryPattern::Acrodromous {
                // Out at its angle, along the margin at a distance, and in towards the apex.
                let across = ends::aside(up, FRAC_PI_2, side);
                let left = 1.0 - plan.part_at;
                let wide = (degrees / 90.0).clamp(0.25, 0.75);
                let at = |along: f64, aside: f64| {
                    let on = part + up * (along * left * length);
                    on + across * (aside * wide * ground.half_width(on, across))
                };
                let arch = vec![at(0.2, 0.9), at(0.45, 1.0), at(0.72, 0.9)];
                (arch, at(0.93, 0.6))
            } else {
                let Some(hit) = margin.hit(from, way) else {
                    continue;
                };
                let reach = (hit.place - from).length();
                let tip = margin.lobe_near(hit.at, 0.35 * reach).unwrap_or(hit.place);
                let inner = tip - (tip - from).normalize_or_zero() * (0.012 * length);
                (Vec::new(), inner)
            };
            let points: Vec<DVec2> = bends.into_iter().chain([tip]).collect();
            let course = Course::curve(from, &points, lots, 1, vein, 0.5);
            innermost.get_or_insert_with(|| course.clone());
            axes.push(Axis::new(course, side, generation));
        }
    }
}

/// Lateral primaries beside each other at even shares of the blade's width, from the base to the
/// apex.
fn converging(architecture: &Architecture, ground: Ground<'_>, axes: &mut Vec<Axis>) {
    let plan = &architecture.primaries;
    let Ground { blade, lots, .. } = ground;
    let apex = blade.apex();
    let length = apex.length();
    let up = apex / length;
    for side in [1.0, -1.0] {
        let across = ends::aside(up, FRAC_PI_2, side);
        for number in 0..plan.laterals {
            let vein = 1 + 2 * u64::from(number) + u64::from(side < 0.0);
            let turn = 0.25 * lots.jitter(1, vein, 200);
            let share = (f64::from(number) + 1.0 + turn) / (f64::from(plan.laterals) + 1.0);
            let at = |along: f64, aside: f64| {
                let on = up * (along * length);
                on + across * (aside * share * ground.half_width(on, across))
            };
            let points: Vec<DVec2> = if plan.pattern == PrimaryPattern::Campylodromous {
                // Down and out from the base first, the outer ones more.
                let (sin, cos) = libm::sincos((50.0 + 75.0 * share).to_radians());
                let out = (up * cos + across * sin) * (0.16 * share * length);
                let arch = [
                    (0.3, 0.98),
                    (0.5, 1.0),
                    (0.7, 0.95),
                    (0.86, 0.8),
                    (0.97, 0.5),
                ];
                let out = Some(out).filter(|out| blade.contains(*out));
                out.into_iter()
                    .chain(arch.map(|(along, aside)| at(along, aside)))
                    .collect()
            } else {
                let ends = 0.985 - 0.04 * share;
                let inner = [0.05, 0.12, 0.25, 0.4, 0.55, 0.7, 0.82, 0.91];
                let along = inner.into_iter().chain([ends]);
                along.map(|along| at(along, 0.97)).collect()
            };
            let course = Course::curve(DVec2::ZERO, &points, lots, 1, vein, 0.1);
            axes.push(Axis::new(course.crowded(), side, 1));
        }
    }
}
