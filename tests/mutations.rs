//! Every parser under files that are changed at random: they are read or refused, without a panic,
//! in seconds, and in bounded memory.
//!
//! A program of its own: its allocator counts what a parser takes, and others would count with it.
//! `LAMINA_MUTATIONS=20000` is the long run.

mod mutations {
    pub(crate) mod changed;
    mod parsers;
    mod seeds;
    pub(crate) mod trial;
}

/// Counts the memory in use, and its peak.
#[global_allocator]
static MEMORY: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;
