//! Times of cell divisions, and the types and places of children.

use glam::DVec2;

use crate::random::{Use, bits, uniform};

/// Diameter of the disc in which a child lies, over the repulsion radius.
pub(super) const CHILD_DISC: f64 = 0.01;

/// Beyond this mean (days) the spread of a Poisson number is below a third of a per cent and left
/// away.
const LARGE_MEAN: f64 = 1e5;

/// Greatest part of the mean handled at once; `exp(-mean)` of greater ones would lose precision.
const PART: f64 = 500.0;

/// Number of the draw of the time of day; parts of a mean have those before.
const TIME_OF_DAY: u64 = 255;

/// Days after which a cell divides: a whole number, Poisson distributed with mean `mean`, then any
/// time of that day, −½ to ½, so that a day's divisions do not all fall together. None if never.
///
/// A value of 0 or less means division at once.
pub(super) fn days_to_division(id: u64, counter: u64, mean: f64) -> Option<f64> {
    if !mean.is_finite() {
        return None;
    }
    if mean > LARGE_MEAN {
        return Some(mean);
    }
    let mut left = mean;
    let mut drawn = 0;
    let mut part = 0;
    while left > 0.0 {
        let now = left.min(PART);
        drawn += poisson(now, uniform(id, Use::MosaicDivision, counter * 256 + part));
        left -= now;
        part += 1;
    }
    let time_of_day = uniform(id, Use::MosaicDivision, counter * 256 + TIME_OF_DAY);
    Some(drawn as f64 + time_of_day - 0.5)
}

/// A Poisson variate from a uniform one, by inversion.
fn poisson(mean: f64, u: f64) -> u64 {
    let mut probability = libm::exp(-mean);
    let mut up_to = probability;
    let mut number = 0;
    while u >= up_to && (number as f64) < mean + 40.0 * (mean + 1.0).sqrt() {
        number += 1;
        probability *= mean / number as f64;
        up_to += probability;
    }
    number
}

/// The type of a cell from the probabilities of all types and a uniform number.
pub(super) fn chosen(probabilities: impl IntoIterator<Item = f64>, u: f64) -> u16 {
    let mut up_to = 0.0;
    let mut last = 0;
    for (kind, probability) in probabilities.into_iter().enumerate() {
        up_to += probability;
        if probability > 0.0 {
            last = kind as u16;
            if u < up_to {
                break;
            }
        }
    }
    last
}

/// The type of the child that a cell has at its division number `counter`, from the probabilities
/// of all types.
pub(super) fn kind_of_child(switching: &[f64], id: u64, counter: u64) -> u16 {
    let u = uniform(id, Use::MosaicKind, counter);
    chosen(switching.iter().copied(), u)
}

/// The child's identifier, from which all its random numbers derive.
pub(super) fn child_id(parent: u64, counter: u64) -> u64 {
    bits(parent, Use::MosaicDivision, u64::MAX - counter)
}

/// Offset of the child from its parent for a radius of 1, uniform in a disc. Each `attempt` gives
/// another offset.
pub(super) fn place_of_child(id: u64, attempt: u64) -> DVec2 {
    let u = [0, 1].map(|k| uniform(id, Use::MosaicPlace, 2 * attempt + k));
    let angle = u[1] * std::f64::consts::TAU;
    DVec2::new(libm::cos(angle), libm::sin(angle)) * (0.5 * CHILD_DISC * u[0].sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_division_are_poisson_distributed() {
        for mean in [2.0, 20.0, 700.0] {
            let n = 20_000;
            let draws = (0..n).map(|i| days_to_division(i, 3, mean).expect("finite"));
            let draws: Vec<f64> = draws.collect();
            let average = draws.iter().sum::<f64>() / n as f64;
            let variance = draws.iter().map(|x| (x - average).powi(2)).sum::<f64>() / n as f64;
            // Poisson's variance is its mean; the time of day adds a twelfth.
            let expected = mean + 1.0 / 12.0;
            let standard_error = (expected / n as f64).sqrt();
            assert!((average - mean).abs() < 4.5 * standard_error, "{average}");
            assert!((variance / expected - 1.0).abs() < 0.05, "{variance}");
        }
        assert_eq!(days_to_division(1, 0, f64::INFINITY), None);
        assert_eq!(days_to_division(1, 0, 3e6), Some(3e6));
    }
}
