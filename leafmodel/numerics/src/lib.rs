//! Mathematics that the models of leaves share.
//!
//! - **Knows**: numbers, points, lists of members.
//! - **Must not know**: leaves, files, light.
//!
//! | question | where |
//! | --- | --- |
//! | points, segments, polylines and polygons of the plane | [`plane`] |
//! | random numbers, each a function of its seed, its use and its number | [`random`] |
//! | roots, smooth steps, joined sets | [`numeric`] |
//! | members by bucket | [`buckets`] |
//! | turns in space | [`rotation`] |
//! | parameters of a simulator from what was measured | [`inference`] |
//! | how a body lies on others | [`rest`] |
//! | memory for large arrays | [`memory`] |

pub mod buckets;
pub mod inference;
pub mod memory;
pub mod numeric;
pub mod plane;
pub mod random;
pub mod rest;
pub mod rotation;
