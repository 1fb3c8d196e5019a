//! What thick veins are made of.

use crate::optics::{Constituent, PerConstituent};

/// The tissue by which a vein is thicker than the blade: parenchyma, collenchyma and wood.
///
/// A vein is a cylinder. Where its chord `c` across the blade is longer than the blade's thickness
/// `d`, it holds `c / d − 1` times what a layer of this tissue as thick as the blade holds, beyond
/// what a thin vein does. A midrib of a thin leaf is therefore many leaves thick and dark against
/// the light, and the same vein in a thick leaf is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinBody {
    /// Thickness of the blade between veins, mm, 0.001 to 10; where a leaf is painted, that of its
    /// form.
    pub blade_mm: f64,
    /// What a layer as thick as the blade holds over what the blade does, 0 to 100.
    pub shares: PerConstituent<f64>,
}

impl VeinBody {
    /// The most that a share may be.
    pub const MOST: f64 = 100.0;

    /// The usual body of a vein, in a blade of 0.2 mm: compact tissue without the mesophyll's air,
    /// which scatters little and holds some chlorophyll in its outer layers.
    ///
    /// All by eye within what is known: water fills the third of a mesophyll that is air; green
    /// petioles hold a tenth of the blade's chlorophyll by fresh weight or less.
    pub const USUAL: Self = Self {
        blade_mm: 0.2,
        shares: PerConstituent::splat(0.0).with(&[
            (Constituent::Structure, 0.2),
            (Constituent::Chlorophyll, 0.1),
            (Constituent::Carotenoids, 0.1),
            (Constituent::Anthocyanins, 0.2),
            (Constituent::Betacyanins, 0.2),
            (Constituent::Betaxanthins, 0.2),
            (Constituent::Brown, 0.3),
            (Constituent::Water, 1.3),
            (Constituent::DryMatter, 0.8),
            (Constituent::Proteins, 0.8),
            (Constituent::CarbonBased, 0.8),
        ]),
    };

    /// Layers as thick as the blade by which a vein of radius `r` is thicker, at the distance `d`
    /// from its axis.
    pub(crate) fn layers(&self, d: f64, r: f64) -> f64 {
        let chord = 2.0 * (r * r - d * d).max(0.0).sqrt();
        (chord / self.blade_mm - 1.0).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tissue::Tissue;
    use super::super::tissue::tests::GREEN;
    use super::super::vein_cover::VeinCover;
    use super::*;
    use crate::optics::ProspectD;

    #[test]
    fn against_the_light_thin_veins_are_lighter_than_the_blade_and_thick_ones_darker() {
        let body = VeinBody::USUAL;
        let tissue = Tissue {
            vein_body: Some(body),
            ..GREEN
        };
        let at = ProspectD::coefficients(550.0).expect("in range");
        let through = |weight: f64, radius: f64| {
            let excess = body.layers(0.0, radius);
            let held = tissue.contents(VeinCover::of(weight, excess), 0.0);
            at.reflectance_transmittance(&held).transmittance
        };
        let blade = through(0.0, 0.0);
        assert!(through(0.5, 0.03) > 1.15 * blade && through(1.0, 0.1) > 1.3 * blade);
        assert!(through(1.0, 0.6) < 0.5 * blade && through(1.0, 1.0) < 0.25 * blade);
        let radii = (0..20).map(|i| 0.1 + 0.05 * f64::from(i));
        let falling: Vec<f64> = radii.map(|radius| through(1.0, radius)).collect();
        assert!(
            falling.is_sorted_by(|more, less| more > less),
            "{falling:?}"
        );
    }

    #[test]
    fn a_vein_adds_layers_only_where_it_is_thicker_than_the_blade() {
        let body = VeinBody::USUAL;
        assert_eq!(body.layers(0.0, 0.1), 0.0);
        assert_eq!(body.layers(0.0, 0.05), 0.0);
        assert!((body.layers(0.0, 0.5) - 4.0).abs() < 1e-12);
        // A chord of 0.6 mm, three blades thick.
        assert!((body.layers(0.4, 0.5) - 2.0).abs() < 1e-12);
        assert_eq!(body.layers(0.5, 0.5), 0.0);
        assert_eq!(body.layers(3.0, 0.5), 0.0);
    }
}
