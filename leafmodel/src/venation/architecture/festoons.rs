//! Loops outside the arches of secondaries, and the vein along the margin.

use glam::DVec2;

use super::Lots;
use super::course::Course;
use super::margin::Margin;

/// Loops to an arch.
const LOOPS: u32 = 3;

/// Part of an arch that bears them, as shares of its places: from the knee to where it ends.
const ARCH: [f64; 2] = [0.6, 0.97];

/// A row of loops between an arch and the margin, from the base of the arch to its end; each runs
/// out from the arch and joins it again.
pub(super) fn outside(
    arch: &Course,
    margin: &Margin,
    inset: f64,
    lots: Lots,
    vein: u64,
) -> Vec<Course> {
    let step = (ARCH[1] - ARCH[0]) / f64::from(LOOPS);
    let loops = (0..LOOPS).filter_map(|k| {
        let key = vein | 1 << 40 | u64::from(k);
        let first = ARCH[0] + step * (f64::from(k) + 0.2 * lots.jitter(3, key, 0));
        let (from, ahead) = arch.at(first);
        let (to, _) = arch.at(first + 0.9 * step);
        // Out towards the nearer margin.
        let out = [ahead.perp(), -ahead.perp()].into_iter().filter_map(|way| {
            let hit = margin.hit(from.lerp(to, 0.5), way)?;
            Some(((hit.place - from.lerp(to, 0.5)).length(), way))
        });
        let (room, way) = out.min_by(|a, b| a.0.total_cmp(&b.0))?;
        if room < 0.35 * inset {
            return None;
        }
        let height = 0.55 * room.min(1.6 * inset);
        let bends: Vec<DVec2> = [0.2, 0.5, 0.8]
            .into_iter()
            .map(|share| {
                let rise = if share == 0.5 { 1.0 } else { 0.75 };
                from.lerp(to, share) + way * (height * rise)
            })
            .chain([to])
            .collect();
        Some(Course::curve(from, &bends, lots, 3, key, 0.3).joined())
    });
    loops.collect()
}

/// The vein that runs along the margin, from near the base to the apex on either side.
pub(crate) fn fimbrial(margin: &Margin, length: f64) -> [Course; 2] {
    const PLACES: u32 = 160;
    let depth = 0.007 * length;
    let apex = margin.apex_at();
    [[0.006, apex - 0.004], [0.994, apex + 0.004]].map(|[from, to]| {
        let place = |k: u32| {
            let share = f64::from(k) / f64::from(PLACES);
            margin.inside(from + (to - from) * share, depth)
        };
        let points: Vec<DVec2> = (0..=PLACES).map(place).collect();
        Course::through(points)
    })
}
