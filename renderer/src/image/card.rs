//! What a picture shows of one object: a grey card, by which light is balanced and exposed.
//!
//! - **In**: a picture with the layer `id.object` and the attribute `lamina:objects`, as it is
//!   rendered; an object's name.
//! - **Out**: the mean of its colours, linear sRGB.
//! - **Left out**: edges: pixels that another object or the background shares, if there are others.

use super::error::ImageError;
use super::picture::Picture;

/// Mean of linear sRGB `colours`, one a pixel, over an object.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] if the picture does not tell objects apart, or shows no light from
/// this one.
pub fn colour_of(
    picture: &Picture,
    colours: &[[f32; 3]],
    object: &str,
) -> Result<[f64; 3], ImageError> {
    let untold = || ImageError::inconsistent("it does not tell which objects it shows");
    let layer = &picture.layer("id.object").ok_or_else(untold)?.data;
    let names = picture.text("lamina:objects").ok_or_else(untold)?;
    let named = names.lines().filter_map(|line| line.split_once(' '));
    let number = named
        .filter(|(_, name)| *name == object)
        .find_map(|(number, _)| number.parse::<f32>().ok());
    let shown = |pixel: usize| Some(layer[pixel]) == number;
    let width = picture.width as usize;
    let height = layer.len() / width;
    let is_inside = |pixel: usize| {
        let (x, y) = (pixel % width, pixel / width);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        rows.flat_map(|y| {
            (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |x| y * width + x)
        })
        .all(shown)
    };
    let mean = mean_of(colours, is_inside).or_else(|| mean_of(colours, shown));
    mean.filter(|mean| mean.iter().all(|value| *value > 0.0))
        .ok_or_else(|| {
            let object = object.escape_debug();
            ImageError::inconsistent(format_args!("it shows no light from the object `{object}`"))
        })
}

/// Mean over the pixels that are wanted and finite.
fn mean_of(colours: &[[f32; 3]], wanted: impl Fn(usize) -> bool) -> Option<[f64; 3]> {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (pixel, colour) in colours.iter().enumerate() {
        if wanted(pixel) && colour.iter().all(|value| value.is_finite()) {
            for (sum, value) in sum.iter_mut().zip(colour) {
                *sum += f64::from(*value);
            }
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum.map(|sum| sum / count))
}

#[cfg(test)]
mod tests {
    use super::super::{Attribute, Layer};
    use super::*;

    /// Five columns: background, an edge pixel of the card, two inside of it, a leaf.
    fn picture() -> (Picture, Vec<[f32; 3]>) {
        let row = [0.0, 2.0, 2.0, 2.0, 1.0];
        let picture = Picture {
            width: 5,
            height: 3,
            layers: vec![Layer::new("id.object", row.repeat(3))],
            attributes: vec![(
                "lamina:objects".to_owned(),
                Attribute::Text("1 leaf\n2 grey card\n3 unseen".to_owned()),
            )],
        };
        let colours = [
            [9.0; 3],
            [5.0; 3],
            [0.2, 0.3, 0.4],
            [5.0; 3],
            [0.0, 1.0, 0.0],
        ];
        (picture, colours.repeat(3))
    }

    #[test]
    fn an_object_has_the_mean_colour_of_its_inside() {
        let (picture, colours) = picture();
        let found = colour_of(&picture, &colours, "grey card").expect("it is there");
        for (found, expected) in found.into_iter().zip([0.2, 0.3, 0.4]) {
            assert!((found - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn what_is_not_seen_dark_or_unreported_is_refused_by_name() {
        let (mut picture, mut colours) = picture();
        for object in ["unseen", "nobody"] {
            let error = colour_of(&picture, &colours, object).expect_err(object);
            assert!(error.to_string().contains(object), "{error}");
        }
        // A leaf without red and blue cannot be grey.
        assert!(colour_of(&picture, &colours, "leaf").is_err());
        colours[7] = [f32::NAN; 3];
        let found = colour_of(&picture, &colours, "grey card").expect("two of three pixels");
        assert!(found[1] > 0.2);
        picture.attributes.clear();
        assert!(colour_of(&picture, &colours, "leaf").is_err());
    }
}
