//! Statistics for comparing leaves: how large a difference is, and whether chance may have made it.
//!
//! - **In**: finite values of two groups, one for each leaf; or many values of each network (areas of
//!   areoles); or p-values of many tests.
//! - **Out**: means with intervals, effects with intervals, p-values, corrected p-values.
//! - **Always true**: the second group less the first; p in (0, 1] or 0 where a difference has no
//!   spread beside it; `None` where there are too few values, never NaN. The same values give the
//!   same bits on every machine.
//! - **Left out**: what the values are. Areoles of one leaf are not independent of each other:
//!   [`permuted_leaves`] takes leaves as the unit, [`kolmogorov_smirnov`] and [`mann_whitney`] of
//!   areoles do not.
//!
//! `docs/src/theory/comparison.md` tells which test stands where and why.
//!
//! ```
//! use leafmodel::measure::comparison::{hedges_g, holm, mann_whitney, welch};
//!
//! // Densities of veins of five and four leaves, mm/mm².
//! let [sun, shade] = [vec![7.9, 8.4, 8.1, 7.6, 8.8], vec![6.2, 6.9, 6.4, 7.1]];
//! let means = welch(&sun, &shade).ok_or("two leaves at least")?;
//! let ranks = mann_whitney(&sun, &shade).ok_or("one leaf at least")?;
//! let effect = hedges_g(&sun, &shade).ok_or("two leaves at least")?;
//! assert!(means.difference < 0.0 && effect.value < 0.0);
//! // All of the first are above all of the second: 2 in C(9, 4) = 126 orders are that extreme.
//! assert!(ranks.exact && (ranks.p - 2.0 / 126.0).abs() < 1e-15);
//! assert!(holm(&[means.p, ranks.p])[1] <= 2.0 * ranks.p);
//! # Ok::<(), &str>(())
//! ```

mod corrected;
mod cumulative;
mod dominance;
mod effect;
mod leaves;
mod noncentral;
mod ranks;
mod student;

pub use self::corrected::{benjamini_hochberg, holm};
pub use self::cumulative::{Steps, kolmogorov_smirnov};
pub use self::dominance::cliffs_delta;
pub use self::effect::Effect;
pub use self::leaves::{Permuted, permuted_leaves};
pub use self::noncentral::hedges_g;
pub use self::ranks::{Ranks, mann_whitney, smallest_p};
pub use self::student::{Among, Summary, Welch, one_among, summary, welch};
