//! `[lights.NAME.…]`: distant, constant, environment, area.

use glam::DVec3;

use super::angle::sin_cos_deg;
use super::camera::COORDINATES_M;
use super::limits::Limits;
use super::names::Names;
use super::path::{Wanted, resolve};
use super::reader::Block;
use super::spectrum::{Role, read_spectrum, read_spectrum_or};
use crate::scene::description::{Light, Spectrum};
use crate::scene::error::SceneError;

/// Largest picture that is read, bytes.
const MOST_PICTURE_BYTES: u64 = 4 << 30;

/// Reads one block of `[lights]`.
pub(crate) fn read_light(section: &Block<'_>, objects: &Names<'_>) -> Option<Light> {
    let (variant, block) = section.variant(&["distant", "constant", "environment", "area"])?;
    let light = match variant {
        "distant" => read_distant(&block),
        "constant" => read_spectrum(&block, "radiance_w_m2_sr_nm", Role::Emission)
            .map(|radiance| Light::Constant { radiance }),
        "environment" => read_environment(&block),
        _ => {
            let object = block.text("object", "the name of an object that shines");
            let object = object.and_then(|name| objects.find(block.cx, name));
            let radiance = read_spectrum(&block, "radiance_w_m2_sr_nm", Role::Emission);
            object
                .zip(radiance)
                .map(|(object, radiance)| Light::Area { object, radiance })
        }
    };
    block.finish();
    let light = light?;
    let (Light::Distant {
        irradiance: spectrum,
        ..
    }
    | Light::Constant { radiance: spectrum }
    | Light::Environment {
        white: spectrum, ..
    }
    | Light::Area {
        radiance: spectrum, ..
    }) = &light;
    if is_dark(spectrum, block.cx.range_nm.get()) {
        let name = section.path.rsplit('.').next().unwrap_or("");
        let error = SceneError::DarkLight {
            name: crate::scene::source::escaped(name, super::context::QUOTED),
        };
        block.cx.error(&block.at, error);
        return None;
    }
    Some(light)
}

fn read_distant(block: &Block<'_>) -> Option<Light> {
    let irradiance = read_spectrum(block, "irradiance_w_m2_nm", Role::Emission);
    let diameter_deg = block.number_or("angular_diameter_deg", Limits::closed(0.01, 90.0), 0.53);
    let towards = block
        .optional_numbers("towards", COORDINATES_M)
        .map(DVec3::from_array);
    block.exclude("towards", "elevation_deg");
    block.exclude("towards", "azimuth_deg");
    let towards = if let Some(node) = block.node("towards") {
        let direction = towards.and_then(DVec3::try_normalize);
        if towards.is_some() && direction.is_none() {
            let error = SceneError::BadView {
                problem: "`towards` is zero, so the light comes from nowhere",
                help: "write a direction, for example `towards = [0, 0, 1]`",
            };
            block.cx.error(&node.at, error);
        }
        direction
    } else {
        let elevation = block.number("elevation_deg", Limits::closed(-90.0, 90.0));
        let azimuth = block.number_or("azimuth_deg", Limits::closed(-360.0, 360.0), 0.0);
        elevation.map(|elevation| {
            let (up, along) = sin_cos_deg(elevation);
            let (sin, cos) = sin_cos_deg(azimuth);
            DVec3::new(along * cos, along * sin, up)
        })
    };
    Some(Light::Distant {
        towards: towards?,
        angular_diameter: diameter_deg.to_radians(),
        irradiance: irradiance?,
    })
}

fn read_environment(block: &Block<'_>) -> Option<Light> {
    let wanted = Wanted {
        endings: &["exr", "png"],
        most_bytes: MOST_PICTURE_BYTES,
    };
    let file = block
        .text("path", "the path of an EXR or PNG picture")
        .and_then(|(path, at)| resolve(block.cx, path, at, wanted));
    let scale = block.number_or("scale", Limits::above(0.0, 1e12), 1.0);
    let rotation_deg = block.number_or("rotation_deg", Limits::closed(-360.0, 360.0), 0.0);
    let white = read_spectrum_or(block, "white_w_m2_sr_nm", Role::Emission, || {
        Spectrum::D65 { scale: 1.0 }
    });
    Some(Light::Environment {
        file: file?,
        scale,
        rotation: rotation_deg.to_radians(),
        white: white?,
    })
}

/// Whether a spectrum is 0 at every wavelength of the film.
fn is_dark(spectrum: &Spectrum, range_nm: Option<[f64; 2]>) -> bool {
    match spectrum {
        Spectrum::Constant(value) => *value == 0.0,
        Spectrum::Table { points, .. } => {
            let [low, high] = range_nm.unwrap_or([0.0, f64::INFINITY]);
            // Dark between two rows only if both are 0: those around the range count too.
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
