//! Properties are tried on the same cases on every run, in all crates.

use numerics::random::{bits_of, share};
use proptest::test_runner::{Config, RngSeed};

/// Properties are tried on the same cases on every run, on `LAMINA_CASES` times as many where that is set.
pub fn fixed(cases: u32) -> Config {
    let factor = std::env::var("LAMINA_CASES")
        .map_or(1, |text| text.parse().expect("LAMINA_CASES is a count"));
    Config {
        cases: cases * factor,
        max_global_rejects: 1024 * factor,
        rng_seed: RngSeed::Fixed(2005),
        failure_persistence: None,
        ..Config::default()
    }
}

/// A uniform number in [0, 1) for a use that only a test has.
pub fn uniform(seed: u64, purpose: u64, counter: u64) -> f64 {
    share(bits_of(seed, purpose, counter))
}
