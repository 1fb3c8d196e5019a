//! Helpers for tests of several modules.

use proptest::test_runner::{Config, RngSeed};

/// Configuration for property tests with the same cases on every run.
pub(crate) fn fixed(cases: u32) -> Config {
    Config {
        cases,
        rng_seed: RngSeed::Fixed(2005),
        failure_persistence: None,
        ..Config::default()
    }
}
