//! Measured values of a BSDF, and their directions.

/// Directions that differ by less are the same, degrees.
pub(super) const SAME_DEG: f64 = 0.01;

/// A direction, degrees: θ from the normal, φ around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// 0 to 180.
    pub theta: f64,
    /// Any.
    pub phi: f64,
}

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Whence light comes.
    pub incident: Direction,
    /// Whither it goes.
    pub scattered: Direction,
    /// Wavelength, nm.
    pub nm: f64,
    /// sr⁻¹, ≥ 0.
    pub value: f64,
    /// Line of the file.
    pub line: usize,
}

/// A direction and a wavelength in whole steps, to be compared.
pub(super) type Steps = [i64; 2];

pub(super) fn steps(direction: Direction) -> Steps {
    let step = |angle: f64| (angle / SAME_DEG).round() as i64;
    let theta = step(direction.theta);
    // At a pole there is no azimuth.
    let is_pole = theta == 0 || theta == step(180.0);
    let phi = if is_pole {
        0
    } else {
        step(direction.phi.rem_euclid(360.0)) % step(360.0)
    };
    [theta, phi]
}

pub(super) fn wavelength_steps(nm: f64) -> i64 {
    (nm * 1000.0).round() as i64
}
