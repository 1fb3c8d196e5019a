//! Russian roulette.

/// The factor on light of a brightness if Russian roulette lets it continue, which it may end below
/// a threshold; `number` gives a random number in [0, 1) and is asked below the threshold only.
#[inline(always)]
pub fn roulette(brightness: f32, below: f32, number: impl FnOnce() -> f32) -> Option<f32> {
    if brightness < below {
        let survival = brightness / below;
        (number() < survival).then(|| 1.0 / survival)
    } else {
        Some(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roulette_keeps_the_mean_and_asks_no_number_of_bright_light() {
        let count = 1000_u16;
        let numbers = (0..count).map(|i| f32::from(i) / f32::from(count));
        let sum: f32 = numbers
            .filter_map(|number| roulette(0.02, 0.1, || number))
            .sum();
        assert!((sum / f32::from(count) - 1.0).abs() < 1e-5, "{sum}");
        assert_eq!(
            roulette(0.1, 0.1, || unreachable!("it is bright")),
            Some(1.0)
        );
        assert_eq!(roulette(0.0, 0.1, || 0.0), None);
    }
}
