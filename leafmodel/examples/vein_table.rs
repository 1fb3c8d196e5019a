//! A network of veins as a table, for R or pandas:
//! `cargo run --release -p leafmodel --example vein_table -- [preset [seed]]`.
//!
//! The standard output holds a CSV with a row for each piece of vein between two neighbouring
//! nodes: its nodes, where they are (mm, the leaf's base at 0, 0 and the midrib along y), its order
//! (1 is the midrib), mean radius and length. The measures of the whole network go to the standard
//! error.

use std::error::Error;
use std::io::Write as _;

use leafmodel::measure::measure;
use leafmodel::species;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or("birch".to_owned());
    let preset = species::find(&name).ok_or("`lamina grow --list` names the presets")?;
    let mut plan = preset.plan();
    if let Some(seed) = arguments.next() {
        plan.seed = seed.parse()?;
    }
    let lamina = plan.grow_lamina()?;
    let network = &lamina.network;

    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    writeln!(
        out,
        "from,to,from_x_mm,from_y_mm,to_x_mm,to_y_mm,order,radius_mm,length_mm"
    )?;
    for (edge, segment) in network.edges().iter().zip(network.segments()) {
        let (start, end) = (segment.from, segment.to);
        let radius = 0.5 * (segment.radius_from + segment.radius_to);
        writeln!(
            out,
            "{},{},{},{},{},{},{},{radius},{}",
            edge.from,
            edge.to,
            start.x,
            start.y,
            end.x,
            end.y,
            segment.order,
            start.distance(end),
        )?;
    }
    out.flush()?;
    let measures = measure(&lamina.outline, network, plan.venation.murray_exponent());
    eprint!("{}", measures.table());
    Ok(())
}
