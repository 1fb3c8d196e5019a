//! Growth compared with its definitions, carried out pair by pair.

mod agreement;
mod all_pairs;
