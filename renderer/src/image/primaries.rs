//! Colours of other primaries than those of Rec. 709.
//!
//! - **In**: chromaticities of red, green, blue and white, as files give them.
//! - **Out**: the linear map to linear sRGB. What is neutral there is neutral here, whatever the
//!   white is: eyes and cameras adapt, and RGB 1 1 1 is the white that a scene chooses.
//! - **Always true**: a map that is found is finite, and maps 1 1 1 to 1 1 1.

use glam::{DMat3, DVec3};

use super::error::ImageError;
use super::picture::REC709_POINTS;
use super::white::srgb_seen_under;

/// Differences of x and y that are only rounding: files hold three to five digits.
const ROUNDING: f32 = 1e-3;

/// Rec. 2020 (ITU-R BT.2020), white D65.
pub(super) const REC2020: [[f32; 2]; 4] = [
    [0.708, 0.292],
    [0.170, 0.797],
    [0.131, 0.046],
    [0.3127, 0.3290],
];

/// The linear map from colours of these primaries to linear sRGB; `None` if they are those of
/// Rec. 709.
///
/// # Errors
///
/// [`ImageError::Malformed`] if no light has such primaries.
pub(super) fn to_rec709(points: [[f32; 2]; 4]) -> Result<Option<DMat3>, ImageError> {
    let mut differences = points.iter().flatten().zip(REC709_POINTS.iter().flatten());
    if differences.all(|(a, b)| (a - b).abs() <= ROUNDING) {
        return Ok(None);
    }
    let xyz = points.map(|[x, y]| {
        let (x, y) = (f64::from(x), f64::from(y));
        DVec3::new(x, y, 1.0 - x - y)
    });
    let [red, green, blue, white] = xyz;
    let white = white / white.y;
    let unscaled = DMat3::from_cols(red, green, blue);
    let scales = unscaled.inverse() * white;
    let map = srgb_seen_under(white) * unscaled * DMat3::from_diagonal(scales);
    if unscaled.determinant().abs() < 1e-6 || !map.is_finite() {
        return Err(ImageError::malformed(format_args!(
            "no colours have the chromaticities {points:?} of red, green, blue and white"
        )));
    }
    Ok(Some(map))
}

/// A colour through a map.
pub(super) fn mapped(map: DMat3, colour: [f32; 3]) -> [f32; 3] {
    let colour = DVec3::from_array(colour.map(f64::from));
    (map * colour).to_array().map(|value| value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn converted(points: [[f32; 2]; 4], colour: [f32; 3]) -> [f32; 3] {
        let map = to_rec709(points).expect("real primaries");
        mapped(map.expect("other primaries"), colour)
    }

    fn close(found: [f32; 3], expected: [f32; 3]) {
        let mut pairs = found.into_iter().zip(expected);
        assert!(
            pairs.all(|(a, b)| (a - b).abs() < 1e-3),
            "{found:?}, not {expected:?}"
        );
    }

    #[test]
    fn colours_of_rec_2020_become_those_of_rec_709() {
        // ITU-R BT.2087-0, the inverse of its matrix of Rec. 709 in Rec. 2020.
        close(
            converted(REC2020, [1.0, 0.0, 0.0]),
            [1.6605, -0.1246, -0.0182],
        );
        close(
            converted(REC2020, [0.0, 1.0, 0.0]),
            [-0.5876, 1.1329, -0.1006],
        );
        close(
            converted(REC2020, [0.0, 0.0, 1.0]),
            [-0.0728, -0.0083, 1.1187],
        );
    }

    #[test]
    fn what_is_neutral_stays_neutral_under_any_white() {
        // ACEScg, whose white is about D60; the matrix of colour-science 0.4 with Bradford's adaptation.
        let aces = [
            [0.713, 0.293],
            [0.165, 0.830],
            [0.128, 0.044],
            [0.32168, 0.33767],
        ];
        close(converted(aces, [1.0; 3]), [1.0; 3]);
        close(converted(aces, [1.0, 0.0, 0.0]), [1.7051, -0.1303, -0.0240]);
        // CIE XYZ itself, with equal energy as its white: primaries that no light has.
        let xyz = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]];
        close(converted(xyz, [0.5; 3]), [0.5; 3]);
    }

    #[test]
    fn primaries_that_are_rec_709_but_for_rounding_change_nothing() {
        let rounded = [
            [0.6400, 0.3300],
            [0.2999, 0.6001],
            [0.15, 0.06],
            [0.31269, 0.32899],
        ];
        assert!(to_rec709(rounded).expect("real primaries").is_none());
    }

    #[test]
    fn primaries_on_a_line_or_a_white_without_light_are_refused() {
        let white = [0.3127, 0.329];
        for points in [
            [[0.2, 0.2], [0.3, 0.3], [0.4, 0.4], white],
            [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3, 0.0]],
            [[f32::NAN, 0.33], [0.3, 0.6], [0.15, 0.06], white],
            [[0.0; 2]; 4],
        ] {
            assert!(to_rec709(points).is_err(), "{points:?}");
        }
    }
}
