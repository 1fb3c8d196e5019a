//! Means, spreads and medians of lists that may be empty.

/// Bins in which [`mode`] counts.
const BINS: usize = 64;

/// Arithmetic mean; `None` for an empty list.
pub(super) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Median, for an even count the mean of the middle two; `None` for an empty list. Reorders the
/// values.
pub(super) fn median(values: &mut [f64]) -> Option<f64> {
    let count = values.len();
    if count == 0 {
        return None;
    }
    let (below, &mut upper, _) = values.select_nth_unstable_by(count / 2, f64::total_cmp);
    if count % 2 == 1 {
        return Some(upper);
    }
    let lower = below.iter().copied().max_by(f64::total_cmp);
    lower.map(|lower| 0.5 * (lower + upper))
}

/// The value below which a share of the list lies, on straight lines between neighbours, of which
/// the first is at 0 and the last at 1; `None` for an empty list. Reorders the values.
pub(super) fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    values.sort_unstable_by(f64::total_cmp);
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (place.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let part = place - below as f64;
    Some(values[below] + (values[above] - values[below]) * part)
}

/// Variance of a sample (`n − 1`); `None` for fewer than two values.
pub(super) fn variance(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    // The mean of equal values may differ from them by rounding.
    let is_even = values.iter().all(|value| *value == values[0]);
    let square = |v: &f64| {
        if is_even {
            0.0
        } else {
            (v - mean) * (v - mean)
        }
    };
    let squares: f64 = values.iter().map(square).sum();
    (values.len() > 1).then(|| squares / (values.len() - 1) as f64)
}

/// Standard deviation (of a sample, `n − 1`) over mean; `None` for fewer than two values or a mean
/// of 0.
pub(super) fn variation(values: &[f64]) -> Option<f64> {
    let mean = mean(values).filter(|mean| *mean != 0.0)?;
    Some(variance(values)?.sqrt() / mean)
}

/// Middle of the fullest of 64 equal bins from 0 to the largest value, the first of equally full
/// ones; values ≥ 0.
pub(super) fn mode(values: &[f64]) -> Option<f64> {
    let largest = values.iter().copied().max_by(f64::total_cmp)?;
    let width = largest / BINS as f64;
    let mut counts = [0_u32; BINS];
    for value in values {
        counts[((value / width) as usize).min(BINS - 1)] += 1;
    }
    let fullest = counts.iter().max()?;
    let bin = counts.iter().position(|count| count == fullest)?;
    Some((bin as f64 + 0.5) * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_medians_of_few_values_are_what_they_are() {
        assert_eq!(median(&mut []), None);
        assert_eq!(mean(&[]), None);
        assert_eq!(mode(&[]), None);
        assert_eq!(variation(&[1.0]), None);
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 3.0, 2.0]), Some(2.5));
        assert_eq!(quantile(&mut [], 0.5), None);
        assert_eq!(quantile(&mut [7.0], 0.9), Some(7.0));
        assert_eq!(quantile(&mut [4.0, 0.0, 3.0, 1.0, 2.0], 0.25), Some(1.0));
        assert_eq!(quantile(&mut [2.0, 1.0], 0.75), Some(1.75));
        assert_eq!(variation(&[1.0, 3.0]), Some(2.0_f64.sqrt() / 2.0));
        assert_eq!(mode(&[0.1, 0.1, 0.1, 3.0, 6.4]), Some(0.15000000000000002));
    }
}
