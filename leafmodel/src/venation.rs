//! Veins: networks drawn towards auxin, and their widths.

pub mod network;
