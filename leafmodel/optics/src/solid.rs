//! Solid tissue: fruit rind, a mushroom's cap; so thick that no light comes out at the back.
//!
//! A half-space of refractive index `n` with a smooth boundary, which scatters isotropically
//! (anisotropy is folded into the reduced scattering `µs'`) and absorbs by the same pigments as a
//! leaf, spread over a depth. A clear pigmented skin may lie between boundary and scatterer.
//! Without boundary and skin the exact answer is Chandrasekhar's `H` function; the boundary adds a
//! linear system over directions, split where internal reflection becomes total.
//!
//! - **In**: single-scattering albedo `a = µs' / (µs' + µa)`, index `n ≥ 1`, optical depth of the
//!   skin.
//! - **Out**: directional–hemispherical reflectance, specular part included, at normal or diffuse
//!   incidence, in [0, 1].
//! - **Always true**: grows with `a`, falls with the skin; without scattering Fresnel's reflection
//!   remains; at `a = 1` it is 1.
//! - **Left out**: lateral spread of light (a map's contents act where they are), a rough boundary,
//!   a scattering skin.
//!
//! `docs/src/theory/solid-tissue.md` derives it.

mod half_space;
mod table;

pub use half_space::{HalfSpace, Reflected};
pub use table::ReflectanceTable;

use thiserror::Error;

/// Reduced scattering of fruit flesh, per mm: an estimate, 0.5 to 3 are as likely in the visible
/// and near infrared.
pub const SCATTERING_PER_MM: f64 = 1.5;
/// Refractive index of watery tissue: an estimate, 1.33 (water) to 1.5 (dry).
pub const ETA: f64 = 1.38;

/// How contents per area fill a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Depth over which the contents are spread, mm, > 0.
    pub depth_mm: f64,
    /// `µs'`, reduced scattering, per mm, > 0.
    pub scattering_per_mm: f64,
    /// `n`, refractive index over that of air, 1 to 2.
    pub eta: f64,
}

/// A parameter of a solid outside the range in which its model holds.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{field} is {value}, it must be {range}")]
pub struct SolidError {
    /// Which parameter.
    pub field: &'static str,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Solid {
    /// The solid itself if every parameter is in range.
    ///
    /// # Errors
    ///
    /// [`SolidError`] for the first parameter outside its range.
    pub fn checked(self) -> Result<Self, SolidError> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let rules = [
            (
                "depth_mm",
                self.depth_mm,
                positive(self.depth_mm),
                "finite and above 0",
            ),
            (
                "scattering_per_mm",
                self.scattering_per_mm,
                positive(self.scattering_per_mm),
                "finite and above 0",
            ),
            (
                "eta",
                self.eta,
                (1.0..=2.0).contains(&self.eta),
                "from 1 to 2",
            ),
        ];
        for (field, value, good, range) in rules {
            if !good {
                return Err(SolidError {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(self)
    }

    /// `a = µs' / (µs' + µa)`, in (0, 1], of contents that absorb `whole = Σᵢ Cᵢ Kᵢ(λ)` in all, so
    /// that `µa = whole / depth` per mm. The structure `N` has no part in it.
    pub fn albedo_of(&self, whole: f64) -> f64 {
        self.scattering_per_mm / (self.scattering_per_mm + whole / self.depth_mm)
    }
}

#[cfg(test)]
mod tests;
