//! The edge of a forest around a scene, as what a sky's directions show instead.
//!
//! - **In**: where the forest's middle stands, and the sun.
//! - **Out**: for each direction the share of foliage before the sky and how bright it is; the
//!   spectrum of foliage in daylight.
//! - **Left out**: stems, the shadow of the forest on the scene, and the sun's disc behind it.
//!
//! Crowns rise from some 8° on the open side to 60° in the middle of the forest. Their outline and
//! their clumps are a noise over directions: what one sees out of focus behind a leaf.

use std::f64::consts::{PI, TAU};

use numerics::numeric::smooth_step;
use optics::{Contents, ProspectD};

/// What foliage holds: a green leaf of a broad-leaved tree.
const FOLIAGE: Contents = Contents::prospect_d([1.6, 45.0, 9.0, 1.0, 0.0, 0.011, 0.006]);
/// Range of PROSPECT's table, nm, at whose ends foliage is held.
const KNOWN_NM: [f64; 2] = [400.0, 2500.0];
/// Share of light between the leaves of a crown that comes back out, single scattering alone: the
/// leaves shade one another.
const SEEN: f64 = 0.5;

/// Elevation of the crowns on the open side and in the middle of the forest, rad.
const CROWNS: [f64; 2] = [8.0 * PI / 180.0, 60.0 * PI / 180.0];
/// Width of the crowns' uneven edge, rad.
const EDGE: f64 = 14.0 * PI / 180.0;
/// Brightness of foliage in the deepest shade over that in the light.
const SHADE: f64 = 0.15;

/// A forest's edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forest {
    /// Azimuth of its middle, rad.
    pub(super) azimuth: f64,
    /// Azimuth of the sun, rad.
    pub(super) sun: f64,
}

/// Share of light that foliage sends back at a wavelength in nm.
pub(super) fn reflected(nm: f64) -> f64 {
    let [first, last] = KNOWN_NM;
    let at = ProspectD::coefficients(nm.clamp(first, last));
    // The table covers the range.
    at.map_or(0.0, |at| {
        let leaf = at.reflectance_transmittance(&FOLIAGE);
        SEEN * (leaf.reflectance + leaf.transmittance) / 2.0
    })
}

impl Forest {
    /// The share of a direction that foliage covers, and its brightness over that of foliage in
    /// full light, by azimuth and elevation above the horizon, rad.
    pub(super) fn seen(&self, azimuth: f64, elevation: f64) -> [f64; 2] {
        let inside = 0.5 + 0.5 * libm::cos(azimuth - self.azimuth);
        let crowns = CROWNS[0] + (CROWNS[1] - CROWNS[0]) * smooth_step(inside);
        let uneven = noise(azimuth, elevation, 24, 1) + 0.5 * noise(azimuth, elevation, 61, 2);
        let height = crowns - elevation + EDGE * (uneven / 1.5 - 0.5);
        let share = smooth_step(0.5 + height / (0.4 * EDGE));
        // What stands opposite the sun is seen from its bright side.
        let lit = 0.5 - 0.5 * libm::cos(azimuth - self.sun);
        let clumps = noise(azimuth, elevation, 37, 3) * (0.4 + 0.6 * lit);
        [share, SHADE + (1.0 - SHADE) * clumps]
    }
}

/// Values in [0, 1] that are smooth between the points of a lattice with this many columns around
/// the horizon.
fn noise(azimuth: f64, elevation: f64, columns: u32, seed: u32) -> f64 {
    let turns = azimuth / TAU;
    let x = (turns - turns.floor()) * f64::from(columns);
    let y = (elevation + PI) / TAU * f64::from(columns);
    let (x0, y0) = (x.floor(), y.floor());
    let [a, b] = [smooth_step(x - x0), smooth_step(y - y0)];
    let at = |dx: u32, dy: u32| random((x0 as u32 + dx) % columns, y0 as u32 + dy, seed);
    let low = at(0, 0) * (1.0 - a) + at(1, 0) * a;
    let high = at(0, 1) * (1.0 - a) + at(1, 1) * a;
    low * (1.0 - b) + high * b
}

/// A number in [0, 1) that looks random.
fn random(column: u32, row: u32, seed: u32) -> f64 {
    let mut bits = column
        .wrapping_mul(0x9E37_79B1)
        .wrapping_add(row.wrapping_mul(0x85EB_CA77))
        .wrapping_add(seed.wrapping_mul(0xC2B2_AE3D));
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2C1B_3C6D);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297A_2D39);
    f64::from((bits ^ (bits >> 15)) >> 8) / f64::from(1 << 24)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foliage_is_green_and_bright_in_the_near_infrared() {
        let [blue, green, red, infrared] = [450.0, 550.0, 675.0, 800.0].map(reflected);
        assert!(
            green > 2.0 * blue && green > 2.0 * red,
            "{blue} {green} {red}"
        );
        assert!(infrared > 3.0 * green && infrared < SEEN, "{infrared}");
    }

    #[test]
    fn crowns_stand_high_on_one_side_and_low_on_the_other() {
        let forest = Forest {
            azimuth: 1.0,
            sun: 4.0,
        };
        let mean = |azimuth: f64, degrees: f64| {
            let near = (-20..=20).map(|i| azimuth + 0.02 * f64::from(i));
            near.map(|azimuth| forest.seen(azimuth, degrees.to_radians())[0])
                .sum::<f64>()
                / 41.0
        };
        assert!(mean(1.0, 40.0) > 0.95 && mean(1.0, 75.0) < 0.05);
        assert!(mean(1.0 + PI, 25.0) < 0.05 && mean(1.0 + PI, 0.5) > 0.5);
    }

    #[test]
    fn noise_joins_where_the_horizon_closes() {
        for elevation in [0.0, 0.3, 1.2] {
            let [before, after] = [TAU - 1e-9, 1e-9].map(|at| noise(at, elevation, 24, 1));
            assert!((before - after).abs() < 1e-6, "{before} and {after}");
        }
    }
}
