//! Uneven ground.

use std::f64::consts::TAU;

use document::declared::{Declared, Defaults};
use document::keys::Keys;
use glam::{DVec2, Vec2, Vec3};
use rayon::prelude::*;

use crate::geometry::{MeshError, TriangleMesh};
use crate::sampling::mixer::random;

/// A rectangle around the origin whose height is a sum of waves with random directions and phases.
/// A wave of length λ has an amplitude ∝ λ^H, with H the roughness exponent (Hurst): a profile of
/// natural soil has some 0.5 to 0.9.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Terrain {
    /// Extent along x.
    #[key("width_m", required, above(0.0, 1e6), at = 0, default = [1.0; 2])]
    /// Extent along y.
    #[key("height_m", required, above(0.0, 1e6), at = 1)]
    pub size: [f64; 2],
    /// Standard deviation of the height.
    ///
    /// In m, of a ground that is large compared with the longest wave.
    #[key("deviation_mm", milli(0.0..=1e6), default = 0.002)]
    pub deviation: f64,
    /// Longest and shortest wave of which the ground is made.
    #[key("waves_mm", milli(1e-3..=1e9), default = [0.2, 0.004])]
    pub waves: [f64; 2],
    /// Roughness exponent: 0 is as rough at all sizes, 1 smooth in the small.
    ///
    /// It is H.
    #[key("exponent", 0.0..=1.0, default = 0.7)]
    pub exponent: f64,
    /// Same numbers and seed, same ground.
    #[key("seed")]
    pub seed: u64,
}

/// Most squares of a shape whose size decides how many it has.
pub(super) const MOST_SQUARES: f64 = 8e6;
/// Number of waves.
const WAVES: u64 = 192;
/// Vertices along the shortest wave.
const PER_WAVE: f64 = 6.0;

/// A wave: its vector (rad/m), amplitude (m) and phase.
#[derive(Clone, Copy, Debug)]
struct Wave {
    vector: DVec2,
    amplitude: f64,
    phase: f64,
}

impl Terrain {
    /// Refuses waves in the wrong order, and more squares than fit in memory.
    fn check(&mut self, keys: &mut Keys<'_>) {
        if self.waves[0] < self.waves[1] {
            let problem = "the longest wave is shorter than the shortest".to_owned();
            keys.refuse(&["waves_mm"], problem, "write the longer one first");
        }
        let [across, along] = self.squares();
        if across * along > MOST_SQUARES {
            let problem = format!(
                "the ground would have {:.0} million squares, more than {:.0}",
                1e-6 * across * along,
                1e-6 * MOST_SQUARES
            );
            // Rounded up to two digits, so that what is reported fits.
            let fits_mm = 1e3 * self.waves[1] * (across * along / MOST_SQUARES).sqrt();
            let decimals = 1.0 - libm::log10(fits_mm).floor();
            let digit = libm::exp10(-decimals);
            let (fits_mm, decimals) =
                ((fits_mm / digit).ceil() * digit, decimals.max(0.0) as usize);
            let help =
                format!("make it smaller, or its shortest wave {fits_mm:.decimals$} mm or longer");
            keys.refuse(&["waves_mm"], problem, &help);
        }
    }

    /// Number of squares along x and y.
    pub fn squares(&self) -> [f64; 2] {
        let edge = self.waves[1] / PER_WAVE;
        self.size.map(|size| (size / edge).ceil().max(1.0))
    }

    /// Its mesh, with exact normals.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it has too many triangles, or is too large or too small for single
    /// precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let waves = self.spectrum();
        let [across, along] = self.squares().map(|count| count as u32);
        let place = |x: u32, y: u32| {
            let uv = DVec2::new(
                f64::from(x) / f64::from(across),
                f64::from(y) / f64::from(along),
            );
            (uv, (uv - 0.5) * DVec2::from_array(self.size))
        };
        // A wave at (x, y) by sine and cosine of its part along x and of its part along y: of those
        // there are as many as columns and rows, not as vertices.
        let columns: Vec<(f64, f64)> = (0..=across)
            .into_par_iter()
            .flat_map_iter(|x| {
                let (_, at) = place(x, 0);
                let waves = waves.iter();
                waves.map(move |wave| libm::sincos(wave.vector.x * at.x))
            })
            .collect();
        let vertex = |x: u32, y: u32, row: &[(f64, f64)]| {
            let (uv, at) = place(x, y);
            let column = &columns[x as usize * waves.len()..][..waves.len()];
            let (mut height, mut slope) = (0.0, DVec2::ZERO);
            for ((wave, (sin_x, cos_x)), (sin_y, cos_y)) in waves.iter().zip(column).zip(row) {
                height += cos_x * cos_y - sin_x * sin_y;
                slope -= (sin_x * cos_y + cos_x * sin_y) * wave.vector;
            }
            let normal = (-slope).extend(1.0).normalize();
            (at.extend(height).as_vec3(), normal.as_vec3(), uv.as_vec2())
        };
        let rows = (0..=along).into_par_iter();
        let vertices: Vec<(Vec3, Vec3, Vec2)> = rows
            .flat_map_iter(|y| {
                let (_, at) = place(0, y);
                let waves = waves.iter();
                let row: Vec<(f64, f64)> = waves
                    .map(|wave| {
                        let (sin, cos) = libm::sincos(wave.vector.y * at.y + wave.phase);
                        (wave.amplitude * sin, wave.amplitude * cos)
                    })
                    .collect();
                (0..=across).map(move |x| vertex(x, y, &row))
            })
            .collect();
        let positions = vertices.iter().map(|vertex| vertex.0).collect();
        let normals = vertices.iter().map(|vertex| vertex.1).collect();
        let uvs = vertices.iter().map(|vertex| vertex.2).collect();
        let corner = |x: u32, y: u32| y * (across + 1) + x;
        let squares = (0..along).flat_map(|y| (0..across).map(move |x| (x, y)));
        let triangles = squares.flat_map(|(x, y)| {
            let [a, b] = [corner(x, y), corner(x + 1, y)];
            let [c, d] = [corner(x + 1, y + 1), corner(x, y + 1)];
            [[a, b, c], [a, c, d]]
        });
        TriangleMesh::new(positions, Some(normals), Some(uvs), triangles.collect())
    }

    /// Waves whose lengths are spread evenly on a logarithmic scale.
    fn spectrum(&self) -> Vec<Wave> {
        let [longest, shortest] = self.waves;
        let waves = (0..WAVES).map(|number| {
            let at = |what: u64| random(self.seed, 4 * number + what);
            let share = (number as f64 + at(0)) / WAVES as f64;
            let length = longest * libm::pow(shortest / longest, share);
            let (sin, cos) = libm::sincos(TAU * at(1));
            Wave {
                vector: DVec2::new(cos, sin) * (TAU / length),
                amplitude: libm::pow(length, self.exponent),
                phase: TAU * at(2),
            }
        });
        let mut waves: Vec<Wave> = waves.collect();
        // The variance of a sum of waves is half the sum of their squares.
        let variance: f64 = waves
            .iter()
            .map(|wave| 0.5 * wave.amplitude * wave.amplitude)
            .sum();
        let scale = self.deviation / variance.sqrt();
        for wave in &mut waves {
            wave.amplitude *= scale;
        }
        waves
    }
}
