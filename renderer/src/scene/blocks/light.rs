//! `[lights.NAME.…]`: distant, constant, environment, daylight, area, spot.

use glam::DVec3;
use leafmodel::document::context::QUOTED;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::source::escaped;
use leafmodel::document::value_kind::{Degrees, FilePath, Flag, NamedFile, Number, Vector};

use super::camera::COORDINATES_M;
use super::daylight::daylight;
use super::report;
use super::rig::rig;
use super::spectrum::SpectrumOf;
use crate::light::daylight::Daylight;
use crate::light::daylight::spctrl2::Atmosphere;
use crate::scene::angle::sin_cos_deg;
use crate::scene::authored;
use crate::scene::authored::Light::{self as Authored, Rig, Single};
use crate::scene::description::{AreaPattern, Light, Spectrum};
use crate::spectrum::rgb;

/// A picture that shines, up to 4 GiB.
const PICTURE: FilePath = FilePath::of(
    "the path of an EXR, HDR, PNG or JPEG picture",
    &["exr", "hdr", "png", "jpg", "jpeg"],
    4 << 30,
);
const DARK: Spectrum = Spectrum::Constant(0.0);

/// The keys of one of `[lights]`.
pub(super) fn light(light: &mut Authored, keys: &mut Keys<'_>) {
    keys.kind(light, &KINDS);
}

const KINDS: [Variant<Authored>; 8] = [
    Variant {
        name: "distant",
        about: "A disc at infinity, like the sun.",
        new: || {
            Single(Light::Distant {
                towards: DVec3::Z,
                angular_diameter: 0.53_f64.to_radians(),
                irradiance: DARK,
            })
        },
        is: |light| matches!(light, Single(Light::Distant { .. })),
        declare: |light, keys| {
            if let Single(Light::Distant {
                towards,
                angular_diameter,
                irradiance,
            }) = light
            {
                let about = "On a surface that faces the light; the sun at the ground has about \
                    1.5 at 560 nm.";
                keys.required(
                    "irradiance_w_m2_nm",
                    irradiance,
                    SpectrumOf::Emission,
                    about,
                );
                let limits = Degrees(Limits::closed(0.01, 90.0));
                let about = "Angle that the disc fills; the default is the sun's. Larger gives \
                    softer shadows.";
                keys.key("angular_diameter_deg", angular_diameter, limits, about);
                direction(towards, keys);
                refuse_darkness(irradiance, keys);
            }
        },
    },
    Variant {
        name: "constant",
        about: "The same radiance from everywhere.",
        new: || Single(Light::Constant { radiance: DARK }),
        is: |light| matches!(light, Single(Light::Constant { .. })),
        declare: |light, keys| {
            if let Single(Light::Constant { radiance }) = light {
                let about = "Its radiance.";
                keys.required("radiance_w_m2_sr_nm", radiance, SpectrumOf::Emission, about);
                refuse_darkness(radiance, keys);
            }
        },
    },
    Variant {
        name: "environment",
        about: "A latitude–longitude picture at infinity, up is +z.",
        new: || {
            Single(Light::Environment {
                file: std::path::PathBuf::new(),
                layer: None,
                scale: 1.0,
                rotation: 0.0,
                white: Spectrum::D65 { scale: 1.0 },
            })
        },
        is: |light| matches!(light, Single(Light::Environment { .. })),
        declare: |light, keys| {
            if let Single(Light::Environment {
                file,
                layer,
                scale,
                rotation,
                white,
            }) = light
            {
                super::file(keys, "path", file, PICTURE, "The picture.");
                super::picture_layer(layer, keys);
                let limits = Number(Limits::above(0.0, 1e12));
                keys.key("scale", scale, limits, "Factor on the picture.");
                let limits = Degrees(Limits::closed(-360.0, 360.0));
                keys.key("rotation_deg", rotation, limits, "Turn about +z.");
                let about = "What RGB 1 1 1 stands for.";
                keys.key("white_w_m2_sr_nm", white, SpectrumOf::Emission, about);
                refuse_darkness(white, keys);
            }
        },
    },
    Variant {
        name: "daylight",
        about: "The sun and a clear sky, with the spectra of a day.",
        new: || Single(Light::Daylight(Daylight::usual())),
        is: |light| matches!(light, Single(Light::Daylight(_))),
        declare: |light, keys| {
            if let Single(Light::Daylight(day)) = light {
                daylight(day, keys);
            }
        },
    },
    Variant {
        name: "overcast",
        about: "A sky that is covered with cloud, brightest in the zenith.",
        new: || {
            Single(Light::Overcast {
                irradiance: DARK,
                ground_albedo: Atmosphere::default().ground_albedo,
            })
        },
        is: |light| matches!(light, Single(Light::Overcast { .. })),
        declare: |light, keys| {
            if let Single(Light::Overcast {
                irradiance,
                ground_albedo,
            }) = light
            {
                let about = "On a horizontal surface; a grey day gives some 0.1 to 0.4 at 560 nm.";
                keys.required(
                    "irradiance_w_m2_nm",
                    irradiance,
                    SpectrumOf::Emission,
                    about,
                );
                let about = "Share of light that the ground far around reflects, with which the \
                    directions below the horizon shine.";
                super::daylight::ground_albedo(ground_albedo, about, keys);
                refuse_darkness(irradiance, keys);
            }
        },
    },
    Variant {
        name: "area",
        about: "An object whose surface shines to the side of its normal.",
        new: || {
            Single(Light::Area {
                // Replaced when the key is read.
                object: usize::MAX,
                radiance: DARK,
                pattern: None,
            })
        },
        is: |light| matches!(light, Single(Light::Area { .. })),
        declare: |light, keys| {
            if let Single(Light::Area {
                object,
                radiance,
                pattern,
            }) = light
            {
                const OBJECT: NameIn = NameIn("objects", "the name of an object that shines");
                keys.required(
                    "object",
                    object,
                    OBJECT,
                    "An object with a mesh, in one place, \
                    with no other area light.",
                );
                let about =
                    "Its radiance; in the middle, where `edge_share` or a picture change it.";
                keys.required("radiance_w_m2_sr_nm", radiance, SpectrumOf::Emission, about);
                area_pattern(pattern, keys);
                refuse_darkness(radiance, keys);
            }
        },
    },
    Variant {
        name: "spot",
        about: "A point that shines into a cone.",
        new: || {
            Single(Light::Spot {
                position: DVec3::ZERO,
                look_at: DVec3::NEG_Z,
                cone_angle: 20.0_f64.to_radians(),
                penumbra_angle: 0.0,
                intensity: DARK,
            })
        },
        is: |light| matches!(light, Single(Light::Spot { .. })),
        declare: |light, keys| {
            if let Single(Light::Spot {
                position,
                look_at,
                cone_angle,
                penumbra_angle,
                intensity,
            }) = light
            {
                let about = "Radiant intensity on the axis: at 1 m, the irradiance on a surface \
                    that faces the light.";
                keys.required("intensity_w_sr_nm", intensity, SpectrumOf::Emission, about);
                let coordinates = Vector(COORDINATES_M);
                keys.required("position_m", position, coordinates, "Where it is.");
                let about = "Point that it aims at; not where it is.";
                keys.required("look_at_m", look_at, coordinates, about);
                let limits = Degrees(Limits::closed(0.1, 180.0));
                let about = "Half angle of the cone, outside of which there is no light; 180 is a \
                    point that shines everywhere.";
                keys.key("cone_angle_deg", cone_angle, limits, about);
                let limits = Degrees(Limits::closed(0.0, 180.0));
                let about = "Width of the edge inside the cone, over which the light fades out; 0 \
                    is sharp. At most `cone_angle_deg`.";
                keys.key("penumbra_angle_deg", penumbra_angle, limits, about);
                check_cone(*position, *look_at, [*cone_angle, *penumbra_angle], keys);
                refuse_darkness(intensity, keys);
            }
        },
    },
    Variant {
        name: "rig",
        about: "Lights as photographers set them up, around what the camera looks at.",
        new: || Rig(authored::Rig::usual()),
        is: |light| matches!(light, Rig(_)),
        declare: |light, keys| {
            if let Rig(own) = light {
                rig(own, keys);
            }
        },
    },
];

/// `edge_share`, `picture` and `emission` of an area light.
fn area_pattern(pattern: &mut Option<AreaPattern>, keys: &mut Keys<'_>) {
    let mut edge = 1.0;
    let limits = Number(Limits::above(0.0, 1.0));
    let about = "Radiance in the middle of each edge over that in the middle, as on the cloth of a \
        soft box: a bell over the mesh's texture coordinates. 1 is even.";
    keys.key("edge_share", &mut edge, limits, about);
    let mut picture: Option<NamedFile> = None;
    let about = "A picture over the mesh's texture coordinates, upright, that multiplies the \
        radiance: what RGB 1 1 1 stands for is `radiance_w_m2_sr_nm`.";
    keys.optional("picture", &mut picture, PICTURE, about);
    let picture = picture.map(|named| named.file);
    let mut layer = None;
    super::picture_layer(&mut layer, keys);
    let mut emission = false;
    let about = "Whether the light that the materials of the object's glTF file emit multiplies the radiance: \
        what an emission of RGB 1 1 1 stands for is `radiance_w_m2_sr_nm`.";
    keys.key("emission", &mut emission, Flag, about);
    keys.exclude("emission", "picture");
    if layer.is_some() && picture.is_none() && keys.reader().is_some() {
        let problem = "there is no picture that could have layers".to_owned();
        keys.refuse(&["layer"], problem, "write `picture` too, or leave it out");
    }
    if (picture.is_some() || emission)
        && let Some(block) = keys.reader()
    {
        let key = if emission { "emission" } else { "picture" };
        let at = block.node(key).map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "a picture's colour", rgb::RANGE_NM);
    }
    if edge < 1.0 || picture.is_some() || emission {
        *pattern = Some(AreaPattern {
            edge,
            picture,
            layer,
            emission,
        });
    }
}

/// Reports a cone without a direction, or an edge wider than its cone.
fn check_cone(position: DVec3, look_at: DVec3, [cone, penumbra]: [f64; 2], keys: &Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    // Closer than this the direction would be dominated by rounding errors.
    if (look_at - position).length() <= 1e-9 * position.length().max(1e-3) {
        let error = DocumentError::BadView {
            problem: "the light shines at the point where it stands",
            help: "move `position_m` or `look_at_m`",
        };
        report(keys, "look_at_m", error);
    }
    if penumbra > cone {
        let problem = "the edge of the light is wider than its cone".to_owned();
        let help = "write at most the value of `cone_angle_deg`, 20 if that is left out";
        keys.refuse(&["penumbra_angle_deg"], problem, help);
    }
}

/// `towards`, or `elevation_deg` and `azimuth_deg`.
fn direction(towards: &mut DVec3, keys: &mut Keys<'_>) {
    let mut vector = None;
    let about = "Direction towards the light, of any length, instead of the two angles.";
    keys.optional("towards", &mut vector, Vector(COORDINATES_M), about);
    keys.exclude("towards", "elevation_deg");
    keys.exclude("towards", "azimuth_deg");
    if keys.reader().is_some() && keys.has("towards") {
        match vector.map(DVec3::try_normalize) {
            Some(Some(direction)) => *towards = direction,
            Some(None) => {
                let error = DocumentError::BadView {
                    problem: "`towards` is zero, so the light comes from nowhere",
                    help: "write a direction, for example `towards = [0, 0, 1]`",
                };
                report(keys, "towards", error);
            }
            None => {}
        }
        return;
    }
    let (mut elevation, mut azimuth) = (90.0, 0.0);
    let limits = Number(Limits::closed(-90.0, 90.0));
    let about = "Height above the horizon.";
    keys.needed("elevation_deg", &mut elevation, limits, about);
    let limits = Number(Limits::closed(-360.0, 360.0));
    let about = "Direction along the ground, from +x towards +y.";
    keys.key("azimuth_deg", &mut azimuth, limits, about);
    keys.group(&["towards", "elevation_deg"]);
    let (up, along) = sin_cos_deg(elevation);
    let (sin, cos) = sin_cos_deg(azimuth);
    *towards = DVec3::new(along * cos, along * sin, up);
}

/// Reports a light that is dark at all wavelengths of the film.
fn refuse_darkness(spectrum: &Spectrum, keys: &Keys<'_>) {
    let Some(block) = keys.reader().filter(|_| keys.is_sound()) else {
        return;
    };
    if is_dark(spectrum, block.cx.range_nm.get()) {
        let name = block.path.rsplit('.').nth(1).unwrap_or("");
        let name = escaped(name, QUOTED);
        block.cx.error(&block.at, DocumentError::DarkLight { name });
    }
}

/// Whether a spectrum is 0 at every wavelength of the film.
fn is_dark(spectrum: &Spectrum, range_nm: Option<[f64; 2]>) -> bool {
    match spectrum {
        Spectrum::Constant(value) => *value == 0.0,
        Spectrum::Table { points, .. } => {
            let [low, high] = range_nm.unwrap_or([0.0, f64::INFINITY]);
            // A table is 0 between two rows only if both are 0, so the rows just outside the range
            // count too.
            let first = points
                .partition_point(|(nm, _)| *nm <= low)
                .saturating_sub(1);
            let last = points
                .partition_point(|(nm, _)| *nm < high)
                .min(points.len() - 1);
            points[first.min(last)..=last]
                .iter()
                .all(|(_, value)| *value == 0.0)
        }
        Spectrum::D65 { .. } | Spectrum::Blackbody { .. } => false,
    }
}
