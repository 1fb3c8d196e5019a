//! What makes a contour that of a specimen: its base, its apex, and sides that differ.
//!
//! Each of these is a continuous one-to-one map of the plane that keeps base and apex in place, so
//! that it goes with every contour and a margin that did not cross itself does not do so after.
//! They apply in this order: breadth, base, unequal halves at the base, apex, asymmetry.
//!
//! - **In**: an [`Outline`] whose base is the origin and whose midrib goes along +y.
//! - **Out**: the outline of the specimen; its midrib is as long as before.
//! - **Always true**: without any of them the outline is the same, bit for bit.

mod asymmetry;
mod ends;
#[cfg(test)]
mod tests;

use glam::DVec2;

pub use self::asymmetry::Asymmetry;
pub use self::ends::{ApexShape, BaseShape};
use super::outline::Outline;
use super::teeth::LobeTips;
use super::tips::Tip;
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::plane::polygon;

/// Longest edge of a margin that is to be bent, as a share of the midrib's length.
const LONGEST_EDGE: f64 = 0.004;

/// How the margin of a specimen departs from its contour.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Specimen {
    /// Factor on the width of the contour.
    #[key("breadth", 0.2..=5.0)]
    pub breadth: f64,
    /// The base, where it is not the contour's.
    #[key("base", block, default = BaseShape::Cordate { depth: 0.08, width: 0.3 })]
    pub base: Option<BaseShape>,
    /// How much lower the right half of the blade begins than the left, as a share of the length.
    #[key("oblique", -0.3..=0.3)]
    pub oblique: f64,
    /// The apex, where it is not the contour's.
    #[key("apex", block, default = ApexShape::Acuminate { length: 0.15, narrowing: 0.6 })]
    pub apex: Option<ApexShape>,
    /// How left and right differ by chance.
    #[key("asymmetry", block)]
    pub asymmetry: Asymmetry,
    /// What ends pointed lobes and the apex.
    #[key("lobe_tip", block)]
    pub lobe_tip: Option<Tip>,
}

impl Default for Specimen {
    /// The contour as it is.
    fn default() -> Self {
        Self {
            breadth: 1.0,
            base: None,
            oblique: 0.0,
            apex: None,
            asymmetry: Asymmetry::default(),
            lobe_tip: None,
        }
    }
}

impl Specimen {
    /// Whether the contour stays as it is but for tips.
    pub(crate) fn keeps_contour(&self) -> bool {
        let Self {
            breadth,
            base,
            oblique,
            apex,
            asymmetry,
            lobe_tip: _,
        } = *self;
        let apex = apex.is_none_or(|apex| apex.tip().is_some());
        breadth == 1.0 && base.is_none() && oblique == 0.0 && apex && asymmetry.is_none()
    }

    /// Whether nothing is changed at all.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The tips that do not stand on teeth.
    pub fn tips(&self) -> LobeTips {
        LobeTips {
            lobes: self.lobe_tip,
            apex: self.apex.and_then(ApexShape::tip),
        }
    }

    /// The outline of the specimen. `seed` decides how its sides differ.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn applied(&self, outline: Outline, seed: u64) -> Result<Outline, NotGrown> {
        self.in_range()?;
        if self.keeps_contour() {
            return Ok(outline);
        }
        let length = outline.length();
        // In lengths of the midrib.
        let mut points = finely(outline.points(), LONGEST_EDGE * length);
        for p in &mut points {
            *p /= length;
            p.x *= self.breadth;
        }
        if let Some(base) = self.base {
            base.shape(&mut points)?;
        }
        if self.oblique != 0.0 {
            ends::lower_right(&mut points, self.oblique);
        }
        if let Some(apex) = self.apex {
            apex.shape(&mut points)?;
        }
        self.asymmetry.shape(&mut points, seed);
        for p in &mut points {
            *p *= length;
        }
        Outline::new(points, outline.base(), outline.apex()).map_err(|error| {
            let error = not_grown!("the margin of the specimen is none: {error}");
            error.mend("asymmetry", "ask for smaller differences")
        })
    }
}

/// A closed polygon with corners added, so that no edge is longer than `longest`.
fn finely(polygon: &[DVec2], longest: f64) -> Vec<DVec2> {
    let sides = polygon::sides(polygon);
    sides
        .flat_map(|(from, to)| {
            let pieces = (from.distance(to) / longest).ceil().clamp(1.0, 1e4);
            (0..pieces as u32).map(move |i| from.lerp(to, f64::from(i) / pieces))
        })
        .collect()
}
