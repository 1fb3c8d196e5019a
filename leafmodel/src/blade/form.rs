//! The flat lamina bent in space: ruffle, fold, curl.

use glam::DVec3;

use super::BladeForm;

/// Distance from the midrib, over the leaf's half width, within which the fold is rounded.
const FOLD_ROUNDING: f64 = 0.12;

/// A smooth map from the lamina with relief to space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    form: BladeForm,
    length: f64,
    half_width: f64,
}

impl Bend {
    /// For a leaf of the given length and half width, mm.
    pub(super) fn new(form: BladeForm, length: f64, half_width: f64) -> Self {
        Self {
            form,
            length,
            half_width,
        }
    }

    /// Where the point `flat` (x across, y along the midrib, z adaxial height) comes to lie, mm.
    ///
    /// Ruffle: `z += A L (x/w)² sin(2π n y/L)`, opposite on the two sides. Fold: `z += tan φ (√(x² + c²) − c)`, `x` made
    /// shorter by `cos φ`, so that lengths away from the midrib are kept. Curl: the y axis wound on a circle of radius
    /// `L / angle` with its centre on the abaxial side.
    pub(super) fn apply(&self, flat: DVec3) -> DVec3 {
        let mut point = flat;
        let across = flat.x / self.half_width;
        if self.form.ruffle > 0.0 {
            let phase = std::f64::consts::TAU * self.form.ruffle_waves * flat.y / self.length;
            let side = libm::sin(phase + if flat.x < 0.0 { 1.0 } else { 0.0 });
            point.z += self.form.ruffle * self.length * across * across * side;
        }
        if self.form.fold != 0.0 {
            let (sin, cos) = libm::sincos(self.form.fold);
            let c = FOLD_ROUNDING * self.half_width;
            point.z += sin / cos * ((flat.x * flat.x + c * c).sqrt() - c) * cos;
            point.x *= cos;
        }
        if self.form.curl != 0.0 {
            let radius = self.length / self.form.curl;
            let (sin, cos) = libm::sincos(point.y / radius);
            let out = radius + point.z;
            point.y = out * sin;
            point.z = out * cos - radius;
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORM: BladeForm = BladeForm {
        fold: 0.4,
        curl: 0.8,
        ruffle: 0.0,
        ruffle_waves: 3.0,
        relief: 0.0,
        thickness_mm: 0.2,
        max_edge_mm: 1.0,
        meshed_vein_radius_mm: 0.1,
    };

    #[test]
    fn the_midrib_keeps_its_length_and_turns_by_the_curl() {
        let bend = Bend::new(FORM, 80.0, 25.0);
        let at = |y: f64| bend.apply(DVec3::new(0.0, y, 0.0));
        let length: f64 = (0..8000)
            .map(|i| at(f64::from(i) * 0.01).distance(at(f64::from(i + 1) * 0.01)))
            .sum();
        assert!((length - 80.0).abs() < 1e-4, "{length}");
        let end = (at(80.0) - at(79.99)).normalize();
        assert!((end.angle_between(DVec3::Y) - 0.8).abs() < 1e-3);
        assert!(end.z < 0.0, "it bends to the abaxial side");
    }

    #[test]
    fn both_halves_rise_by_the_fold_and_keep_their_width() {
        let bend = Bend::new(BladeForm { curl: 0.0, ..FORM }, 80.0, 25.0);
        let (inner, outer) = (DVec3::new(15.0, 40.0, 0.0), DVec3::new(25.0, 40.0, 0.0));
        let step = bend.apply(outer) - bend.apply(inner);
        assert!((step.length() - 10.0).abs() < 0.1, "{step}");
        assert!((libm::atan2(step.z, step.x) - 0.4).abs() < 0.02, "{step}");
        let mirrored = bend.apply(DVec3::new(-25.0, 40.0, 0.0));
        assert_eq!(mirrored.z, bend.apply(outer).z);
    }
}
