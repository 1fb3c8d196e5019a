//! A picture at infinity.

use std::path::PathBuf;

use leafmodel::document::declared::{Declared, Defaults};

use super::surroundings::{LightError, PICTURE, Surroundings, read_picture};
use crate::light::environment::EnvironmentLight;
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::description::layer::ChosenLayer;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A latitude–longitude picture at infinity, up is +z.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Environment {
    /// The picture.
    ///
    /// EXR, Radiance HDR, PNG or JPEG with RGB, resolved and inside the scene's folder.
    #[key("path", required, PICTURE)]
    pub file: PathBuf,
    /// The layer of the picture.
    #[key(flat)]
    pub layer: ChosenLayer,
    /// Factor on the picture.
    #[key("scale", above(0.0, 1e12), default = 1.0)]
    pub scale: f64,
    /// Turn about +z.
    #[key("rotation_deg", degrees(-360.0..=360.0))]
    pub rotation: f64,
    /// What RGB 1 1 1 stands for.
    ///
    /// W m⁻² sr⁻¹ nm⁻¹.
    #[key("white_w_m2_sr_nm", SpectrumOf::Emission, default = Spectrum::D65 { scale: 1.0 })]
    pub white: Spectrum,
}

impl Environment {
    pub(super) fn built(
        &self,
        mut around: Surroundings<'_>,
    ) -> Result<EnvironmentLight, LightError> {
        let picture = read_picture(&self.file, self.layer.name(), &mut around)?;
        let (width, mut texels) = (picture.width, picture.texels);
        let height = texels.len() / width;
        if width != 2 * height {
            around.notes.push(format!(
                "lights.{}: {}: a picture of {width} × {height} pixels is not twice as wide as high; \
                 it is stretched over the whole sphere",
                around.name,
                self.file.display()
            ));
        }
        // Seen from within, the azimuth grows to the left.
        for row in texels.chunks_mut(width) {
            row.reverse();
        }
        let white = Curve::from_description(&self.white).scaled(self.scale as f32);
        let rotation = self.rotation as f32;
        Ok(EnvironmentLight::new(texels, width, white, rotation))
    }
}
