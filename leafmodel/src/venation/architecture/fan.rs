//! Flabellate primaries: veins that radiate from the base and fork where there is room.
//!
//! Each side of the blade is divided into sectors, one a vein; a sector is a range of shares of the
//! way from the midrib to the lower margin, at equal distance from the base. A vein runs along the
//! middle of its sector and, once that is wide enough for two, forks: one branch goes on, the other
//! is a vein of its own. Sectors do not overlap, so no vein crosses another.

use glam::DVec2;

use super::Primaries;
use super::course::{Axis, Course};
use super::ends::aside;
use super::ground::Ground;
use crate::shape::outline::Outline;

/// How far the place of a fork strays, share of its distance from the base.
const FORK_JITTER: f64 = 0.45;

/// Where veins end, share of the way to the margin.
const REACH: f64 = 0.985;

/// Distances between veins over which a branch turns into its own sector.
const TURNING: f64 = 3.0;

/// Distances from the base at which the width of the blade is looked up.
const RADII: usize = 96;

/// Degrees by which the margin is looked for.
const DEGREES: u32 = 150;

/// One side of a blade in shares of its fan.
struct Side {
    up: DVec2,
    /// 1 the right, −1 the left.
    sign: f64,
    /// Distance from one radius to the next.
    step: f64,
    /// Angle of the lower margin at each radius, radians.
    widths: Vec<f64>,
    /// Where the fan is widest.
    widest: usize,
}

impl Side {
    fn new(blade: &Outline, side: f64, inset: f64) -> Self {
        let apex = blade.apex();
        let up = apex.normalize_or(DVec2::Y);
        let farthest = |p: &DVec2| p.length();
        let reach = blade.points().iter().map(farthest).fold(0.0, f64::max);
        let step = reach / RADII as f64;
        // The last angle before the blade ends, coming from the midrib.
        let width = |i: usize| {
            let radius = step * (i as f64 + 1.0);
            let inner = (0..DEGREES).take_while(|&degrees| {
                let way = aside(up, f64::from(degrees).to_radians(), side);
                blade.contains(way * radius)
            });
            let degrees = f64::from(inner.count().saturating_sub(1) as u32);
            (degrees.to_radians() - inset / radius).max(0.0)
        };
        let widths: Vec<f64> = (0..RADII).map(width).collect();
        let most = |i: &usize, j: &usize| widths[*i].total_cmp(&widths[*j]);
        let widest = (0..RADII).max_by(most).unwrap_or(0);
        Self {
            up,
            sign: side,
            step,
            widths,
            widest,
        }
    }

    /// Angle of the lower margin at a distance from the base; beyond where the fan is widest it
    /// stays.
    fn width(&self, radius: f64) -> f64 {
        let place = (radius / self.step - 1.0).clamp(0.0, self.widest as f64);
        let i = (place as usize).min(self.widest);
        let next = (i + 1).min(self.widest);
        self.widths[i] + (self.widths[next] - self.widths[i]) * (place - i as f64)
    }

    /// A place by its share of the fan and its distance from the base.
    fn at(&self, share: f64, radius: f64) -> DVec2 {
        aside(self.up, share * self.width(radius), self.sign) * radius
    }

    /// How far a vein at a share of the fan can run.
    fn end(&self, share: f64, blade: &Outline) -> f64 {
        let radii = (1..=4 * RADII).map(|i| 0.25 * self.step * i as f64);
        let inside = radii.take_while(|&radius| blade.contains(self.at(share, radius)));
        REACH * inside.last().unwrap_or(0.0)
    }

    /// Where a sector is wide enough for two veins `spacing` apart.
    fn fork(&self, [a, b]: [f64; 2], spacing: f64) -> f64 {
        let wide = |radius: &f64| (b - a) * self.width(*radius) * radius >= 2.0 * spacing;
        let mut radii = (1..=4 * RADII).map(|i| 0.25 * self.step * i as f64);
        radii.find(wide).unwrap_or(f64::INFINITY)
    }
}

/// A vein that is to be laid out.
struct Branch {
    /// Bounds of its sector, shares of the fan.
    sector: [f64; 2],
    /// Where it starts, and how far that is from the base.
    from: DVec2,
    radius: f64,
    generation: u32,
}

/// Adds the veins beside the midrib.
pub(super) fn lay_out(plan: &Primaries, ground: Ground<'_>, axes: &mut Vec<Axis>) {
    let blade = ground.blade;
    let spacing = plan.fork_spacing * blade.apex().length();
    for side in [1.0, -1.0] {
        let fan = Side::new(blade, side, 0.5 * spacing);
        let widest = fan.widths[fan.widest].max(1e-6);
        let angles = &plan.lateral_angles_deg;
        let share = |degrees: f64| (degrees.to_radians() / widest).min(1.0);
        let mut branches = Vec::new();
        for (i, &angle) in angles.iter().enumerate() {
            // The midrib has a narrow sector, in which it never forks.
            let below = match i {
                0 => 0.5 * plan.fork_spacing / widest,
                _ => f64::midpoint(share(angles[i - 1]), share(angle)),
            };
            let above = match angles.get(i + 1) {
                Some(&next) => f64::midpoint(share(angle), share(next)),
                None => 1.0,
            };
            branches.push(Branch {
                sector: [below, above],
                from: DVec2::ZERO,
                radius: 0.0,
                generation: 1,
            });
        }
        while let Some(branch) = branches.pop() {
            let vein = axes.len() as u64;
            let generation = branch.generation;
            let points = one(&branch, &fan, ground, spacing, vein, &mut branches);
            if points.len() > 1 {
                let course = Course::curve(points[0], &points[1..], ground.lots, 1, vein, 0.05);
                axes.push(Axis::new(course.crowded(), side, generation));
            }
        }
    }
}

/// The start and the bends of a vein; branches that leave it are added.
fn one(
    branch: &Branch,
    fan: &Side,
    ground: Ground<'_>,
    spacing: f64,
    vein: u64,
    branches: &mut Vec<Branch>,
) -> Vec<DVec2> {
    let (mut sector, mut from) = (branch.sector, branch.radius);
    let mut points = vec![branch.from];
    for fork in 0_u64.. {
        let [a, b] = sector;
        let middle = f64::midpoint(a, b);
        let end = fan.end(middle, ground.blade);
        let jitter = 1.0 + FORK_JITTER * ground.lots.loose(1, vein, 2 * fork);
        // A vein has turned into its sector before it forks again or ends.
        let turned = (from + TURNING * spacing).min(f64::midpoint(from, end));
        let stop = (fan.fork(sector, spacing) * jitter).max(turned + 0.5 * TURNING * spacing);
        let forks = stop < end - 2.0 * TURNING * spacing;
        let next = if forks { stop } else { end };
        // Along the sector, which bends with the margin.
        let pieces = ((next - turned) / (4.0 * TURNING * spacing))
            .ceil()
            .max(1.0) as u32;
        let first = u32::from(from <= 0.0);
        for piece in first..=pieces {
            let radius = turned + (next - turned) * f64::from(piece) / f64::from(pieces);
            if radius > from + 0.3 * spacing {
                points.push(fan.at(middle, radius));
            }
        }
        if !forks {
            break;
        }
        let keeps_inner = ground.lots.share(1, vein, 2 * fork + 1) < 0.5;
        let (mine, other) = if keeps_inner {
            ([a, middle], [middle, b])
        } else {
            ([middle, b], [a, middle])
        };
        branches.push(Branch {
            sector: other,
            from: fan.at(middle, next),
            radius: next,
            generation: branch.generation + 1,
        });
        sector = mine;
        from = next;
    }
    points
}
