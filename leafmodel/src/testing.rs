//! What tests of several modules share.

use proptest::test_runner::{Config, RngSeed};

/// Properties are tried on the same cases on every run.
pub(crate) fn fixed(cases: u32) -> Config {
    Config {
        cases,
        rng_seed: RngSeed::Fixed(2005),
        failure_persistence: None,
        ..Config::default()
    }
}
