//! Prints the table of Fig. 6 of \[xia2007\] with our leaf's lengths, as CSV:
//! `cargo run --release -p leafmodel --example transport_lengths`.
//!
//! Lengths of the secondary veins of the leaf in the photograph (mean of both sides), of the
//! paper's leaf and of Example 4, cm, of leaves 4.5 cm long, numbered from the base.

#![allow(
    clippy::print_stdout,
    reason = "an example shows what it found on standard output"
)]

use std::error::Error;

use leafmodel::transport::example;

const PHOTOGRAPHED: [f64; 5] = [2.76, 2.48, 1.91, 1.52, 1.05];
const PAPER: [f64; 5] = [2.2, 2.0, 1.7, 1.2, 0.9];
/// Length of all three leaves, cm.
const LENGTH: f64 = 4.5;

fn main() -> Result<(), Box<dyn Error>> {
    let leaf = example(4).ok_or("there are five examples")?.grow(1)?;
    let rows = leaf.cells().iter().map(|cell| cell.n);
    let (low, high) = (rows.clone().min(), rows.max());
    let extent = f64::from(high.unwrap_or(0) - low.unwrap_or(0) + 1);
    let veins = leaf.secondaries();
    let right = veins.iter().filter(|vein| vein.tip.m > 0);
    println!("vein,photographed,paper,ours");
    for (((number, vein), photographed), paper) in (1..).zip(right).zip(PHOTOGRAPHED).zip(PAPER) {
        let ours = vein.length * LENGTH / extent;
        println!("{number},{photographed},{paper},{ours:.3}");
    }
    Ok(())
}
