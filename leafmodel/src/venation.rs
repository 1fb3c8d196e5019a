//! Veins: networks drawn towards auxin, and their widths.

pub mod network;
pub mod plan;
