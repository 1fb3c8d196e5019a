//! Absorption bands as sums of Gaussians in wavenumber, within the range in which they were fitted.

use numerics::numeric::smooth_step;

/// Width in nm over which a band falls to zero beyond the range of its fit.
const TAPER_NM: f64 = 30.0;

/// One Gaussian: height over the spectrum's peak, centre cm⁻¹, standard deviation cm⁻¹.
pub(super) type Gaussian = [f64; 3];

/// A pigment's absorption in solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bands {
    /// The Gaussians, relative to the peak.
    pub(super) gaussians: &'static [Gaussian],
    /// Range of the fit, nm, in solution.
    pub(super) range_nm: [f64; 2],
    /// Molar absorptivity at the peak, L mol⁻¹ cm⁻¹.
    pub(super) epsilon: f64,
    /// Molar mass, g mol⁻¹.
    pub(super) molar_mass: f64,
}

impl Bands {
    /// Absorption over that of the peak in solution, with all bands moved by `shift` cm⁻¹, at a
    /// wavelength in nm.
    pub(super) fn shape(&self, wavelength_nm: f64, shift: f64) -> f64 {
        let in_solution = 1e7 / wavelength_nm - shift;
        self.sum(in_solution) * window(1e7 / in_solution, self.range_nm)
    }

    /// Specific absorption in solution, cm² µg⁻¹, of all bands moved by `shift` cm⁻¹, going on
    /// beyond the range of the fit.
    pub(super) fn unbounded(&self, wavelength_nm: f64, shift: f64) -> f64 {
        let peak = crate::betalains::in_solution(self.epsilon, self.molar_mass);
        peak * self.sum(1e7 / wavelength_nm - shift)
    }

    /// The Gaussians at a wavenumber in solution, cm⁻¹.
    fn sum(&self, in_solution: f64) -> f64 {
        let gaussians = self.gaussians.iter();
        gaussians
            .map(|[height, centre, deviation]| {
                let z = (in_solution - centre) / deviation;
                height * libm::exp(-0.5 * z * z)
            })
            .sum()
    }

    /// Specific absorption in the leaf, cm² µg⁻¹: the shape times the peak in solution times
    /// `packaging`.
    pub(super) fn specific(&self, wavelength_nm: f64, shift: f64, packaging: f64) -> f64 {
        let peak = crate::betalains::in_solution(self.epsilon, self.molar_mass);
        packaging * peak * self.shape(wavelength_nm, shift)
    }
}

/// 1 in the range, falling to 0 over [`TAPER_NM`] on both sides, with a continuous slope.
pub(super) fn window(nm: f64, range_nm: [f64; 2]) -> f64 {
    let outside = (range_nm[0] - nm).max(nm - range_nm[1]).max(0.0);
    smooth_step(1.0 - outside / TAPER_NM)
}
