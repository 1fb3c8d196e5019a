//! Colours that no display can show, brought among those that it can, with their hue.
//!
//! Lightness and hue in Oklab stay what they are; chroma is reduced. Not by clipping, which would
//! make one colour of all that lie outside, with a channel that is exactly 0: chroma up to
//! [`KEPT`] of the most that the gamut has at this lightness and hue is left alone, and all above
//! is compressed into the rest by a curve that never reaches the border. The map is continuous
//! and keeps the order of chroma.
//!
//! - **In**: linear sRGB with channels of either sign.
//! - **Out**: linear sRGB with every channel above 0, and below 1 in [`Gamut::Display`].
//!
//! # Source
//!
//! Reduction of chroma at constant lightness and hue: \[ottosson2021\] and CSS Color 4. The curve
//! is that of the ACES reference gamut compression, \[aces-rgc\], with its power and with infinity
//! as the limit: f(x) = t + (x − t) / (1 + ((x − t) / (1 − t))^p)^(1/p).

use super::oklab::Oklab;

/// Share of the most chroma up to which nothing changes.
const KEPT: f64 = 0.8;
/// Power of the curve.
const POWER: f64 = 1.2;
/// More chroma than any colour of sRGB has, by lightness; blue has 0.69.
const MOST_CHROMA: f64 = 1.0;

/// What is to be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gamut {
    /// No channel below 0: colours before they are exposed, however bright.
    Light,
    /// Every channel from 0 to 1.
    Display,
}

impl Gamut {
    fn holds(self, rgb: [f64; 3]) -> bool {
        rgb.into_iter().all(|value| {
            value >= 0.0
                && match self {
                    Self::Light => true,
                    Self::Display => value <= 1.0,
                }
        })
    }

    /// The colour inside the gamut; see the module.
    pub(super) fn hold(self, lab: Oklab) -> [f64; 3] {
        let l = match self {
            Self::Light => lab.l.max(0.0),
            Self::Display => lab.l.clamp(0.0, 1.0),
        };
        // The ends of the axis of grey.
        if l <= 0.0 {
            return [0.0; 3];
        }
        if self == Self::Display && l >= 1.0 {
            return [1.0; 3];
        }
        let lab = Oklab { l, ..lab };
        let chroma = lab.chroma();
        if chroma == 0.0 || self.holds(lab.with_chroma_times(1.0 / KEPT).rgb()) {
            return lab.rgb();
        }
        let most = self.most_chroma(lab);
        let over = (chroma / most - KEPT).max(0.0);
        let bent = 1.0 + libm::pow(over / (1.0 - KEPT), POWER);
        let kept = KEPT + over / libm::pow(bent, 1.0 / POWER);
        // A border that is met at no chroma at all, or rounding: never beyond it.
        let kept = (kept.min(1.0) * most / chroma).min(1.0);
        lab.with_chroma_times(kept)
            .rgb()
            .map(|value| value.max(0.0))
    }

    /// Most chroma at the lightness and hue of a colour that has some.
    fn most_chroma(self, lab: Oklab) -> f64 {
        let unit = 1.0 / lab.chroma();
        let (mut inside, mut outside) = (0.0, MOST_CHROMA * lab.l);
        // Halved to the last bits of `f32`.
        for _ in 0..30 {
            let middle = 0.5 * (inside + outside);
            if self.holds(lab.with_chroma_times(middle * unit).rgb()) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        inside.max(1e-9 * lab.l)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Colours of the spectrum and beyond, on both sides of sRGB's border.
    fn chart() -> impl Iterator<Item = [f64; 3]> {
        (0..9 * 9 * 9).map(|i| [i % 9, i / 9 % 9, i / 81].map(|c| 0.2 * f64::from(c) - 0.3))
    }

    fn degrees(lab: Oklab) -> f64 {
        libm::atan2(lab.b, lab.a).to_degrees()
    }

    #[test]
    fn every_channel_is_above_zero_and_lightness_and_hue_stay() {
        let mut moved = 0;
        for rgb in chart() {
            let before = Oklab::of(rgb);
            for gamut in [Gamut::Light, Gamut::Display] {
                let held = gamut.hold(before);
                assert!(gamut.holds(held), "{rgb:?} became {held:?}");
                let inside = before.l > 0.02 && before.l < 0.99;
                if !inside || before.chroma() < 0.01 {
                    continue;
                }
                assert!(held.iter().all(|&value| value > 0.0), "{rgb:?}: {held:?}");
                let after = Oklab::of(held);
                assert!((after.l - before.l).abs() < 1e-6, "{rgb:?}: {held:?}");
                let turned = (degrees(after) - degrees(before)).rem_euclid(360.0);
                assert!(turned.min(360.0 - turned) < 0.01, "{rgb:?} turned {turned}");
                moved += usize::from(after.chroma() < 0.999 * before.chroma());
            }
        }
        assert!(moved > 300, "{moved} colours were compressed");
    }

    #[test]
    fn colours_well_inside_stay_and_more_chroma_stays_more() {
        let grey_green = [0.3, 0.4, 0.2];
        for gamut in [Gamut::Light, Gamut::Display] {
            for (one, other) in gamut
                .hold(Oklab::of(grey_green))
                .into_iter()
                .zip(grey_green)
            {
                assert!((one - other).abs() < 1e-6);
            }
            let mut last = 0.0;
            for step in 1..400 {
                // Along a leaf's hue from grey to twice what any light has.
                let lab = Oklab::of([0.3, 0.4, 0.2]).with_chroma_times(0.02 * f64::from(step));
                let chroma = Oklab::of(gamut.hold(lab)).chroma();
                assert!(chroma > last, "step {step}");
                assert!(
                    chroma - last < 0.0021,
                    "a jump at step {step}: {chroma} after {last}"
                );
                last = chroma;
            }
        }
    }

    #[test]
    fn neither_black_nor_light_beyond_white_is_a_colour() {
        assert_eq!(Gamut::Light.hold(Oklab::of([0.0; 3])), [0.0; 3]);
        assert_eq!(Gamut::Light.hold(Oklab::of([-0.2, -0.1, -0.3])), [0.0; 3]);
        assert_eq!(Gamut::Display.hold(Oklab::of([9.0, 6.0, 4.0])), [1.0; 3]);
        let bright = Gamut::Light.hold(Oklab::of([9.0, 6.0, 4.0]));
        assert!((bright[0] - 9.0).abs() < 1e-5, "{bright:?}");
    }
}
