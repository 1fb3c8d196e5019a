//! The same light from everywhere.

use leafmodel::document::declared::Declared;

use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// The same radiance from everywhere.
#[derive(Clone, Debug, Declared, Default)]
pub struct Constant {
    /// Its radiance.
    ///
    /// W m⁻² sr⁻¹ nm⁻¹.
    #[key("radiance_w_m2_sr_nm", required, SpectrumOf::Emission)]
    pub radiance: Spectrum,
}

impl Constant {
    pub(super) fn built(&self) -> spectrum::Spectrum {
        Curve::from_description(&self.radiance).into()
    }
}
