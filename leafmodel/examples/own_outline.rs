//! A leaf within a margin of one's own:
//! `cargo run --release -p leafmodel --example own_outline -- [margin.svg [leaf.svg]]`.
//!
//! The margin is the first path of an SVG file, traced from a scan for example; without a file it
//! is the drawing below. The veins are those of a magnolia, which join in arches along any margin. The measures go to the standard output as
//! CSV, the leaf is drawn into the second file if one is named.

use std::error::Error;
use std::io::Write as _;

use leafmodel::export::{SvgStyle, svg};
use leafmodel::leaf::outline_plan::Contour;
use leafmodel::measure::{Value, measure};
use leafmodel::shape::svg_path::SvgContour;
use leafmodel::species;

/// A blade as a drawing program would save it. The lowest point becomes the base, the highest the
/// apex.
const DRAWN: &str = r#"<svg xmlns="http://www.w3.org/2000/svg">
    <path d="M50 95 C80 88 96 52 74 30 C66 22 58 18 50 5 C42 18 34 22 26 30 C4 52 20 88 50 95 Z"/>
</svg>"#;

/// What the drawing does not say: how long the midrib is, mm.
const LENGTH_MM: f64 = 45.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut files = std::env::args().skip(1);
    let (name, drawing) = match files.next() {
        Some(file) => (file.clone(), std::fs::read_to_string(file)?),
        None => ("drawn.svg".to_owned(), DRAWN.to_owned()),
    };
    let margin = SvgContour::parse(&name, &drawing, None)?;

    let magnolia = species::find("magnolia").ok_or("the magnolia is a preset")?;
    let mut plan = magnolia.plan();
    plan.length_mm = LENGTH_MM;
    plan.outline = Contour::Svg(margin).into();
    let lamina = plan.grow_lamina()?;

    if let Some(file) = files.next() {
        let style = SvgStyle::default();
        std::fs::write(file, svg(&lamina.outline, &lamina.network, style))?;
    }
    let exponent = plan.venation.murray_exponent();
    let mut out = std::io::stdout().lock();
    writeln!(out, "measure,value,unit")?;
    for entry in measure(&lamina.outline, &lamina.network, exponent).entries() {
        let value = match &entry.value {
            Value::Count(count) => count.to_string(),
            Value::Number(Some(number)) => number.to_string(),
            // What the leaf does not have, and series of numbers, which need a table of their own.
            Value::Number(None) | Value::List(_) | Value::Orders(_) => continue,
        };
        writeln!(out, "{},{value},{}", entry.key, entry.unit)?;
    }
    Ok(())
}
