//! `AgX`: a picture from light of any strength, as a photograph has it.
//!
//! Light is seen by three channels that overlap more than those of a display; each is bent by one
//! curve over 16.5 stops, and the overlap is taken back in part. So colours lose chroma with light
//! instead of clipping channel by channel, and a leaf's small blue is never crushed to nothing.
//!
//! The bending of single channels turns hues (a bright red goes to yellow). Here the hue of the
//! light is put back in Oklab, so that a leaf and its highlights have one hue.
//!
//! # Source
//!
//! \[sobotka2022\] as \[chow2023\] generates it for Blender: the two matrices over Rec. 2020, the
//! range of the logarithm and the constants of the curve. The curve is J. Smith's sigmoid: through
//! its pivot with a slope, into both ends with a power. Departures: negative channels are
//! compressed by [`super::gamut`] and hue is kept whole, where the source lifts the first by a rule
//! of thumb and keeps six tenths of the turn.

use super::gamut::Gamut;
use super::oklab::{Oklab, times};

/// Stops from middle grey to black and to white.
const STOPS: [f64; 2] = [-10.0, 6.5];
const MIDDLE_GREY: f64 = 0.18;
/// Exponent of what the curve's output stands for.
const DISPLAY_POWER: f64 = 2.4;
/// Slope of the curve at middle grey, with a contrast of 1.
const SLOPE: f64 = 2.4;
/// Power with which it runs into both ends.
const POWER: f64 = 1.5;

/// Linear sRGB to Rec. 2020, both with white D65.
const TO_REC2020: [[f64; 3]; 3] = [
    [0.6274038959, 0.3292830384, 0.0433130657],
    [0.0690972894, 0.9195403951, 0.0113623156],
    [0.0163914389, 0.0880133079, 0.8955952532],
];

const FROM_REC2020: [[f64; 3]; 3] = [
    [1.6604910021, -0.5876411388, -0.0728498633],
    [-0.1245504745, 1.1328998971, -0.0083494226],
    [-0.0181507634, -0.1005788980, 1.1187296614],
];

/// From Rec. 2020 to the channels that overlap.
const INSET: [[f64; 3]; 3] = [
    [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
    [0.137318972929847, 0.761241990602591, 0.101439036467562],
    [0.11189821299995, 0.0767994186031903, 0.811302368396859],
];

/// And back, without the turn and not all the way.
const OUTSET: [[f64; 3]; 3] = [
    [
        1.1271005818144368,
        -0.11060664309660323,
        -0.016493938717834573,
    ],
    [
        -0.1413297634984383,
        1.157823702216272,
        -0.016493938717834257,
    ],
    [
        -0.14132976349843826,
        -0.11060664309660294,
        1.2519364065950405,
    ],
];

/// The curve of one channel over the logarithm of light, with a contrast.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve {
    slope: f64,
    /// Middle grey as the curve gives it out.
    middle_out: f64,
    /// How far it runs from middle grey into black, and into white.
    scales: [f64; 2],
}

impl Curve {
    /// With `contrast` times the slope at middle grey, more than 0.54: a straight line of that slope
    /// just reaches white.
    pub(super) fn new(contrast: f64) -> Self {
        let slope = SLOPE * contrast;
        let scale = |run: f64, rise: f64| {
            let straight = slope * run;
            straight / libm::pow(libm::pow(straight / rise, POWER) - 1.0, 1.0 / POWER)
        };
        let [low, high] = STOPS;
        let middle = -low / (high - low);
        let middle_out = libm::pow(MIDDLE_GREY, 1.0 / DISPLAY_POWER);
        Self {
            slope,
            middle_out,
            scales: [
                scale(middle, middle_out),
                scale(1.0 - middle, 1.0 - middle_out),
            ],
        }
    }

    /// What the display shows for linear sRGB light: linear sRGB from 0 to 1.
    pub(super) fn formed(&self, light: Oklab) -> [f64; 3] {
        let seen = times(&INSET, times(&TO_REC2020, Gamut::Light.hold(light)));
        let bent = seen.map(|channel| self.at(channel));
        let formed = Oklab::of(times(&FROM_REC2020, times(&OUTSET, bent)));
        Gamut::Display.hold(formed.with_hue_of(light))
    }

    /// Linear light to linear light from 0 to 1. Middle grey stays.
    fn at(&self, light: f64) -> f64 {
        let [low, high] = STOPS;
        let stops = libm::log2(light.max(1e-30) / MIDDLE_GREY).clamp(low, high);
        let from_pivot = stops / (high - low);
        let scale = self.scales[usize::from(from_pivot >= 0.0)];
        let x = self.slope * from_pivot.abs() / scale;
        let bent = scale * x / libm::pow(1.0 + libm::pow(x, POWER), 1.0 / POWER);
        let out = self.middle_out + if from_pivot >= 0.0 { bent } else { -bent };
        libm::pow(out.clamp(0.0, 1.0), DISPLAY_POWER)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTRASTS: [f64; 4] = [0.6, 1.0, 1.4, 2.0];

    #[test]
    fn the_curve_runs_from_black_through_middle_grey_to_white() {
        for contrast in CONTRASTS {
            let curve = Curve::new(contrast);
            let at = |stops: f64| curve.at(MIDDLE_GREY * libm::exp2(stops));
            assert!(curve.at(0.0) < 1e-12 && at(-11.0) < 1e-12, "{contrast}");
            assert!((at(0.0) - MIDDLE_GREY).abs() < 1e-12, "{contrast}");
            assert!((at(7.0) - 1.0).abs() < 1e-9, "{contrast}");
            let mut last = 0.0;
            for step in 1..165 {
                let now = at(-10.0 + 0.1 * f64::from(step));
                assert!(now > last, "{contrast}: step {step}");
                last = now;
            }
            // The slope at the pivot, by differences: 2.4 a range of logarithm.
            let out = |stops: f64| libm::pow(at(stops), 1.0 / 2.4);
            let slope = (out(0.001) - out(-0.001)) / 0.002 * 16.5;
            assert!((slope / contrast - 2.4).abs() < 0.01, "{contrast}: {slope}");
        }
    }

    #[test]
    fn grey_stays_grey() {
        let curve = Curve::new(1.0);
        for light in [0.001, 0.18, 0.8, 5.0] {
            let [r, g, b] = curve.formed(Oklab::of([light; 3]));
            assert!((r - g).abs() < 1e-4 && (b - g).abs() < 1e-4, "{r} {g} {b}");
            assert!((g - curve.at(light)).abs() < 1e-4, "{g}");
        }
    }

    #[test]
    fn a_leaf_against_the_sun_keeps_its_hue_and_some_blue_at_any_exposure_and_contrast() {
        // Light through a green leaf: blue is below 0 in sRGB.
        let light = [0.32, 0.45, -0.012];
        let hue = |lab: Oklab| libm::atan2(lab.b, lab.a).to_degrees();
        let before = hue(Oklab::of(light));
        for (contrast, ev) in CONTRASTS
            .iter()
            .flat_map(|own| (-4..=4).map(move |ev| (*own, ev)))
        {
            let factor = libm::exp2(f64::from(ev));
            let shown = Curve::new(contrast).formed(Oklab::of(light.map(|value| factor * value)));
            // A contrast of 2 lets darks run into black: four steps of 16 bits are left.
            let least = if contrast > 1.0 { 5e-6 } else { 1e-4 };
            assert!(
                shown.iter().all(|&value| value > least && value < 1.0),
                "{shown:?} at {ev} EV with {contrast}"
            );
            let after = hue(Oklab::of(shown));
            assert!(
                (after - before).abs() < 0.05,
                "{after}, not {before}, at {ev} EV with {contrast}"
            );
        }
    }
}
