//! Angles: sine and cosine of degrees, exact at quarter turns; azimuths by compass.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::Number;

/// Compass bearings and azimuths as they may be written.
pub(crate) const TURNS_DEG: Limits = Limits::closed(-360.0, 360.0);

/// The azimuth of a compass bearing, degrees. North is +y and east is +x, so bearings grow from +y towards
/// +x, and azimuths from +x towards +y.
pub(crate) fn azimuth_of_bearing(bearing_deg: f64) -> f64 {
    90.0 - bearing_deg
}

/// The key `compass_deg`, which stands instead of `azimuth_deg`: the azimuth that it gives, degrees.
pub(crate) fn declare_compass(keys: &mut Keys<'_>) -> Option<f64> {
    let mut bearing = None;
    let about =
        "The same as a compass bearing instead: clockwise from north, which is +y. East is 90, +x.";
    keys.optional("compass_deg", &mut bearing, Number(TURNS_DEG), about);
    keys.exclude("compass_deg", "azimuth_deg");
    bearing.map(azimuth_of_bearing)
}

/// Sine and cosine of an angle in degrees: 90° gives exactly 1 and 0, so that a turned floor
/// stays level. The same bits on every machine.
pub(crate) fn sin_cos_deg(deg: f64) -> (f64, f64) {
    let turned = deg.rem_euclid(360.0);
    let quarter = (turned / 90.0).floor();
    let rest = (turned - 90.0 * quarter).to_radians();
    let (sin, cos) = (libm::sin(rest), libm::cos(rest));
    match quarter as u32 % 4 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact_and_others_agree_with_the_definition() {
        for (deg, expected) in [
            (0.0, (0.0, 1.0)),
            (90.0, (1.0, 0.0)),
            (180.0, (0.0, -1.0)),
            (-90.0, (-1.0, 0.0)),
        ] {
            assert_eq!(sin_cos_deg(deg), expected, "{deg}");
        }
        for tenth in -7200..7200 {
            let deg = f64::from(tenth) / 10.0;
            let (sin, cos) = sin_cos_deg(deg);
            let rad = deg.to_radians();
            assert!(
                (sin - libm::sin(rad)).abs() < 1e-14 && (cos - libm::cos(rad)).abs() < 1e-14,
                "{deg}"
            );
        }
    }
}
