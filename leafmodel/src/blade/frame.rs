//! The box in which a blade's texture coordinates are measured.

use glam::DVec2;

/// The bounding box of a margin, in millimetres, and the texture coordinates over it.
///
/// `u = (x − min.x) / size.x` and `v = (y − min.y) / size.y`: both run from 0 to 1 over the box,
/// and `v` grows with `y`, from the leaf's base to its apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvFrame {
    /// The corner with the least x and y, mm.
    pub min: DVec2,
    /// Width and height, mm, both > 0.
    pub size: DVec2,
}

impl UvFrame {
    /// The bounding box of a margin given as points in millimetres.
    ///
    /// A margin without area has no coordinates across its flat direction; its side is then taken
    /// as the smallest positive number, so that the frame stays finite (`uv` of every margin point
    /// is 0 there).
    #[must_use]
    pub fn around(margin: &[DVec2]) -> Self {
        let Some(&first) = margin.first() else {
            return Self {
                min: DVec2::ZERO,
                size: DVec2::ONE,
            };
        };
        let (min, max) = margin.iter().fold((first, first), |(min, max), &point| {
            (min.min(point), max.max(point))
        });
        Self {
            min,
            size: (max - min).max(DVec2::splat(f64::MIN_POSITIVE)),
        }
    }

    /// Texture coordinates of a point given in millimetres; outside 0 to 1 for points outside the
    /// box.
    #[must_use]
    pub fn uv(&self, point: DVec2) -> DVec2 {
        (point - self.min) / self.size
    }

    /// The point, in millimetres, that has these texture coordinates.
    #[must_use]
    pub fn point(&self, uv: DVec2) -> DVec2 {
        self.min + uv * self.size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARGIN: [DVec2; 4] = [
        DVec2::new(0.0, 0.0),
        DVec2::new(12.0, 20.0),
        DVec2::new(0.0, 60.0),
        DVec2::new(-18.0, 25.0),
    ];

    #[test]
    fn the_box_touches_the_margin_on_all_four_sides() {
        let frame = UvFrame::around(&MARGIN);
        assert_eq!(frame.min, DVec2::new(-18.0, 0.0));
        assert_eq!(frame.size, DVec2::new(30.0, 60.0));
        assert_eq!(frame.uv(DVec2::new(-18.0, 0.0)), DVec2::ZERO);
        assert_eq!(frame.uv(DVec2::new(12.0, 60.0)), DVec2::ONE);
    }

    #[test]
    fn point_undoes_uv() {
        let frame = UvFrame::around(&MARGIN);
        for point in MARGIN {
            assert!((frame.point(frame.uv(point)) - point).length() < 1e-12);
        }
    }

    #[test]
    fn a_margin_without_area_still_has_finite_coordinates() {
        for margin in [&[][..], &[DVec2::ONE][..]] {
            let frame = UvFrame::around(margin);
            assert!(frame.uv(DVec2::ONE).is_finite());
        }
    }
}
