//! A blade that grows thinner towards its margin.
//!
//! Within a distance of the margin the thickness falls smoothly to a share of that of the blade.
//! The contents per area fall with it: the tissue stays the same and there is less of it, so the
//! contents per volume are those of the rest of the blade. The structure parameter is no content
//! and stays.

use crate::document::Declared;
use crate::numeric::smooth_step;

/// How thick the margin is.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct MarginThickness {
    /// Thickness at the margin over that between veins; contents per area fall with it.
    #[key("margin_thickness", 0.05..=1.0)]
    pub share: f64,
    /// Distance from the margin within which the thickness falls to that.
    #[key("margin_width_mm", 0.01..=100.0)]
    pub width_mm: f64,
}

impl MarginThickness {
    /// A margin as thick as the blade.
    pub const EVEN: Self = Self {
        share: 1.0,
        width_mm: 1.0,
    };

    /// Whether no place is thinner than another.
    pub(super) fn is_even(&self) -> bool {
        self.share == 1.0
    }

    /// Thickness over that of the blade at a distance from the margin, mm.
    pub(crate) fn at(&self, distance: f64) -> f64 {
        self.share + (1.0 - self.share) * smooth_step(distance / self.width_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::UvFrame;
    use crate::blade::contents_map::ContentsMap;
    use crate::blade::tests::ellipse;
    use crate::optics::{Constituent, PerConstituent};
    use glam::DVec2;

    const THIN: MarginThickness = MarginThickness {
        share: 0.4,
        width_mm: 3.0,
    };

    #[test]
    fn the_thickness_falls_smoothly_to_its_share_at_the_margin() {
        assert_eq!([0.0, 3.0, 50.0].map(|d| THIN.at(d)), [0.4, 1.0, 1.0]);
        assert!((THIN.at(1.5) - 0.7).abs() < 1e-12);
        assert_eq!(MarginThickness::EVEN.at(0.0), 1.0);
    }

    #[test]
    fn contents_fall_with_the_thickness_and_the_structure_stays() {
        let outline = ellipse(20.0, 40.0, 200);
        let frame = UvFrame::around(outline.points());
        let mut map = ContentsMap {
            width: 100,
            height: 200,
            texels: vec![PerConstituent::splat(2.0); 20_000],
        };
        THIN.thin(&mut map, &frame, &outline);
        let mut thinned = 0;
        for (number, texel) in map.texels.iter().enumerate() {
            assert_eq!(texel[Constituent::Structure], 2.0);
            let place = DVec2::new((number % 100) as f64 + 0.5, (number / 100) as f64 + 0.5);
            let p = frame.min + 0.2 * place;
            let wanted = 2.0 * THIN.at(outline.distance_to_margin(p));
            let held = f64::from(texel[Constituent::Water]);
            if outline.contains(p) {
                assert!(
                    (held - wanted).abs() < 1e-6,
                    "{held} is not {wanted} at {p}"
                );
                thinned += usize::from(held < 1.99);
            }
        }
        assert!(thinned > 3000, "{thinned}");
    }
}
