//! The pictures that a leaf's plan names.

use super::plan::LeafPlan;
use crate::blade::layers::Change;
use crate::blade::masks::Mask;
use crate::mosaic::control::{ControlImage, Pixels};

impl LeafPlan {
    /// What a file of the plan does not say of its pictures, since it only names them: of each the
    /// pixels across, and then all values.
    pub fn pictures(&self) -> Vec<f64> {
        let mut all = Vec::new();
        let mut add = |width: usize, values: &[f32]| {
            all.push(width as f64);
            all.extend(values.iter().copied().map(f64::from));
        };
        for layer in &self.layers {
            if let Mask::Picture(picture) = &layer.mask {
                add(picture.width, picture.texels.as_flattened());
            }
            if let Change::Map(map) = &layer.change {
                add(map.width, map.texels.as_flattened());
            }
        }
        let controls = self.mosaic.iter().flat_map(|mosaic| &mosaic.plan.controls);
        for control in controls {
            if let ControlImage::Picture(Pixels { width, values, .. }) = &control.image {
                all.push(*width as f64);
                all.extend(values);
            }
        }
        all
    }
}
