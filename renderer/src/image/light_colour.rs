//! What colours the lights of a scene have on its film, by which a picture is balanced.
//!
//! - **In**: names and colours, linear sRGB as the film records the spectrum of each light.
//! - **Out**: the attribute `lamina:lights` of a picture, and the colour of a light that is named.
//! - **Always true**: a colour that is found can be made neutral.
//!
//! Each line of the attribute is a name and three numbers, of the luminance 1; a light without
//! power has three zeros.

use leafmodel::document::context::QUOTED;
use leafmodel::document::nearest::nearest;
use leafmodel::document::source::escaped;
use serde::{Deserialize, Serialize};

use super::error::ImageError;
use super::picture::{Attribute, Picture, luminance};
use super::white::is_balanceable;

/// The attribute that holds them.
const NAME: &str = "lamina:lights";

/// A light's name and the colour of its spectrum.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct LightColour {
    /// Name in the scene; daylight has the parts `NAME.sun` and `NAME.sky` too.
    pub name: String,
    /// Linear sRGB of the luminance 1; zeros if the film sees nothing of it.
    pub colour: [f64; 3],
}

impl LightColour {
    /// The colour on a scale of its own: whatever the unit of the light is.
    pub fn new(name: String, recorded: [f64; 3]) -> Self {
        let y = luminance(recorded);
        let has_power = y > 0.0 && recorded.iter().all(|value| value.is_finite());
        Self {
            name,
            colour: if has_power {
                recorded.map(|value| value / y)
            } else {
                [0.0; 3]
            },
        }
    }

    /// Its colour, if that can come out white.
    ///
    /// # Errors
    ///
    /// Why not, as a sentence that follows "the light".
    pub fn balanceable(&self) -> Result<[f64; 3], &'static str> {
        if self.colour == [0.0; 3] {
            Err("has no power that the film sees")
        } else if is_balanceable(self.colour) {
            Ok(self.colour)
        } else {
            Err("lacks a part of the spectrum that no balance can bring back")
        }
    }
}

/// The attribute of a picture that tells the colours of its lights.
pub fn attribute(lights: &[LightColour]) -> (String, Attribute) {
    let lines = lights.iter().map(|LightColour { name, colour }| {
        let [r, g, b] = colour;
        format!("{name} {r} {g} {b}")
    });
    let lines: Vec<String> = lines.collect();
    (NAME.to_owned(), Attribute::Text(lines.join("\n")))
}

/// The colours that a picture tells of its lights, by name.
fn of_picture(picture: &Picture) -> Option<Vec<LightColour>> {
    let parsed = picture.text(NAME)?.lines().filter_map(|line| {
        let mut words = line.split(' ');
        let name = words.next()?.to_owned();
        let mut number = || words.next()?.parse().ok().filter(|n: &f64| n.is_finite());
        let colour = [number()?, number()?, number()?];
        Some(LightColour { name, colour })
    });
    Some(parsed.collect())
}

/// Linear sRGB of the luminance 1 of the light with this name.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] if the picture does not tell its lights, has none of this name, or
/// one that cannot come out white.
pub fn colour_of(picture: &Picture, light: &str) -> Result<[f64; 3], ImageError> {
    let lights = of_picture(picture).ok_or_else(|| {
        ImageError::inconsistent(
            "it does not tell the colours of its lights: render it again, or write `white` or \
             `white_object` instead",
        )
    })?;
    let shown = escaped(light, QUOTED);
    let Some(found) = lights.iter().find(|known| known.name == light) else {
        let names = || lights.iter().map(|light| light.name.as_str());
        let meant = nearest(light, names()).map_or_else(
            || {
                let known: Vec<_> = names().map(|name| escaped(name, QUOTED)).collect();
                format!("it has {}", known.join(", "))
            },
            |name| format!("did you mean `{}`?", escaped(name, QUOTED)),
        );
        return Err(ImageError::inconsistent(format_args!(
            "there is no light `{shown}`; {meant}"
        )));
    };
    found
        .balanceable()
        .map_err(|why| ImageError::inconsistent(format_args!("the light `{shown}` {why}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie::{d65, observer, srgb_from_xyz, xyz_of};

    fn picture(lights: &[LightColour]) -> Picture {
        Picture {
            attributes: vec![attribute(lights)],
            ..Picture::default()
        }
    }

    #[test]
    fn a_light_is_found_again_by_its_name_whatever_its_unit() {
        let recorded = [3.0e7, 2.0e7, 0.5e7];
        let lights = ["key", "day.sun"].map(|name| LightColour::new(name.to_owned(), recorded));
        let found = colour_of(&picture(&lights), "day.sun").expect("it is there");
        assert_eq!(found, lights[1].colour, "no digit is lost");
        let y = luminance(found);
        assert!((y - 1.0).abs() < 1e-12 && (found[0] / found[1] - 1.5).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_white_is_refused_by_name() {
        let sodium = srgb_from_xyz(observer(589.0));
        let white = srgb_from_xyz(xyz_of(d65));
        let lights = [
            LightColour::new("lamp".to_owned(), white),
            LightColour::new("sodium".to_owned(), sodium),
            LightColour::new("dark".to_owned(), [0.0; 3]),
        ];
        let picture = picture(&lights);
        let refusal = |picture: &Picture, light| {
            let error = colour_of(picture, light).expect_err("it is refused");
            error.to_string()
        };
        assert!(colour_of(&picture, "lamp").is_ok());
        assert!(refusal(&picture, "sodium").contains("lacks a part"));
        assert!(refusal(&picture, "dark").contains("no power"));
        assert!(refusal(&picture, "lmap").contains("did you mean `lamp`?"));
        assert!(refusal(&picture, "other").contains("it has lamp, sodium, dark"));
        assert!(refusal(&Picture::default(), "lamp").contains("does not tell"));
    }
}
