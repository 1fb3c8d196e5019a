//! `lamina optics`: PROSPECT-D as a table.

use std::fmt::Write as _;
use std::io::Write as _;

use leafmodel::optics::{Contents, ProspectD};

use crate::cli::arguments::OpticsArguments;
use crate::cli::{Failure, check_writable, say};
use crate::image::atomic;

pub(super) fn run(arguments: &OpticsArguments) -> Result<(), Failure> {
    let contents = Contents::new(
        arguments.n,
        arguments.cab,
        arguments.car,
        arguments.ant,
        arguments.brown,
        arguments.cw,
        arguments.cm,
    )
    .map_err(Failure::bad)?;
    check_writable(&arguments.out)?;
    let mut table = String::from("wavelength_nm,R,T\n");
    for nm in 400..=2500 {
        let optics = ProspectD::coefficients(f64::from(nm))
            .map_err(Failure::bad)?
            .reflectance_transmittance(&contents);
        // Seventeen digits give back the very number.
        writeln!(
            table,
            "{nm},{:.17},{:.17}",
            optics.reflectance, optics.transmittance
        )
        .map_err(Failure::system)?;
    }
    atomic::replace(&arguments.out, |file| file.write_all(table.as_bytes()))
        .map_err(Failure::system)?;
    eprintln!(
        "PROSPECT-D, table of Feret, Gitelson, Noble and Jacquemoud (2017), N {} Cab {} Car {} Ant {} brown {} \
         Cw {} Cm {}",
        arguments.n,
        arguments.cab,
        arguments.car,
        arguments.ant,
        arguments.brown,
        arguments.cw,
        arguments.cm
    );
    say(arguments.out.display());
    Ok(())
}
