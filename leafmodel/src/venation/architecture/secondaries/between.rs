//! Intersecondaries: veins between two secondaries, along them for a part of their length.

use super::laid::Laid;
use crate::venation::architecture::course::Course;
use crate::venation::architecture::{Lots, Secondaries};

/// Veins of a part of the length between two secondaries, and along them.
pub(super) fn intersecondaries(
    plan: &Secondaries,
    courses: &[Course],
    lots: Lots,
    number: usize,
    side: f64,
    laid: &mut Laid,
) {
    for (k, pair) in courses.windows(2).enumerate() {
        let vein = (number as u64) << 16 | u64::from(side < 0.0) << 12 | 1 << 11 | k as u64;
        let whole = plan.intersecondaries.floor();
        let more = lots.share(3, vein, 0) < plan.intersecondaries - whole;
        let count = whole as u32 + u32::from(more);
        for i in 0..count {
            let between = f64::from(i + 1) / f64::from(count + 1);
            let at = |t: f64| pair[0].at(t).0.lerp(pair[1].at(t).0, between);
            let reach = 0.26 + 0.14 * lots.share(3, vein, 1 + u64::from(i));
            let bends = [at(0.5 * reach), at(reach)];
            let course = Course::curve(at(0.0), &bends, lots, 3, vein + u64::from(i), 0.5);
            laid.finer.push(course);
        }
    }
}
