//! `[materials.NAME.…]`: diffuse, dielectric, leaf, solid; and the surface that grown leaves share with
//! those.

use super::contents::read_contents;
use super::limits::Limits;
use super::path::{Wanted, resolve};
use super::reader::Block;
use super::solid::read_solid_material;
use super::spectrum::{Role, read_spectrum, read_spectrum_or, require_prospect};
use crate::scene::description::{Coat, LeafTissue, Material, Spectrum};
use crate::scene::error::SceneError;
use crate::scene::source::Place;

/// Largest map of contents that is read, bytes.
const MOST_MAP_BYTES: u64 = 4 << 30;
/// Refractive index of a coat.
const COAT_ETA: f64 = 1.45;
/// GGX roughness of the adaxial and the abaxial coat: satin above, matt below.
const COAT_ALPHA: [f64; 2] = [0.3, 0.45];
/// Measured abaxial over adaxial reflectance, mean of 19 groups of broad leaves (Noda et al.).
const ABAXIAL_RATIO: [(f64, f64); 4] = [(450.0, 1.74), (550.0, 1.55), (680.0, 1.65), (800.0, 0.97)];

/// Reads one block of `[materials]`.
pub(crate) fn read_material(section: &Block<'_>) -> Option<Material> {
    let (variant, block) = section.variant(&["diffuse", "dielectric", "leaf", "solid"])?;
    let material = match variant {
        "diffuse" => read_spectrum(&block, "reflectance", Role::Share)
            .map(|reflectance| Material::Diffuse { reflectance }),
        "dielectric" => {
            let eta = block.number_or("eta", Limits::closed(0.25, 4.0), 1.5);
            let roughness = block.number_or("roughness", Limits::closed(0.0, 1.0), 0.0);
            Some(Material::Dielectric { eta, roughness })
        }
        "leaf" => read_leaf(&block),
        _ => read_solid_material(&block),
    };
    block.finish();
    material
}

fn read_leaf(block: &Block<'_>) -> Option<Material> {
    let extrapolate = block.cx.extrapolate.get();
    let tissue = match block.exactly_one(&["contents", "map", "measured"]) {
        Some("contents") => block.optional_block("contents").and_then(|inner| {
            require_prospect(block.cx, &inner.at);
            read_contents(&inner).map(|contents| LeafTissue::Contents {
                contents,
                extrapolate,
            })
        }),
        Some("map") => block.optional_block("map").and_then(|inner| {
            require_prospect(block.cx, &inner.at);
            read_map(&inner).map(|file| LeafTissue::Map { file, extrapolate })
        }),
        Some(_) => block
            .optional_block("measured")
            .and_then(|inner| read_measured(&inner)),
        None => None,
    };
    let abaxial_ratio = read_abaxial_ratio(block);
    let coats = read_coats(block);
    Some(Material::Leaf {
        tissue: tissue?,
        abaxial_ratio: abaxial_ratio?,
        coats,
    })
}

pub(super) fn read_map(block: &Block<'_>) -> Option<std::path::PathBuf> {
    let wanted = Wanted {
        endings: &["exr"],
        most_bytes: MOST_MAP_BYTES,
    };
    let file = block
        .text("file", "the path of an EXR with contents")
        .and_then(|(path, at)| resolve(block.cx, path, at, wanted));
    block.finish();
    file
}

fn read_measured(block: &Block<'_>) -> Option<LeafTissue> {
    let reflectance = read_spectrum(block, "reflectance", Role::Share);
    let transmittance = read_spectrum(block, "transmittance", Role::Share);
    block.finish();
    let (reflectance, transmittance) = (reflectance?, transmittance?);
    require_energy(block, &block.at, &reflectance, &transmittance);
    Some(LeafTissue::Measured {
        reflectance,
        transmittance,
    })
}

/// Reports where more light leaves than arrives: R + T is linear between the rows of both
/// tables, so it is greatest at one of them.
fn require_energy(block: &Block<'_>, at: &Place, reflectance: &Spectrum, transmittance: &Spectrum) {
    // Sums of decimals such as 0.1 + 0.9 round to just above 1.
    const ROUNDING: f64 = 1e-9;
    let mut wavelengths: Vec<f64> = vec![550.0];
    for spectrum in [reflectance, transmittance] {
        if let Spectrum::Table { points, .. } = spectrum {
            wavelengths.extend(points.iter().map(|(nm, _)| *nm));
        }
    }
    let mut greatest = (0.0, 0.0);
    for nm in wavelengths {
        let sum = share_at(reflectance, nm) + share_at(transmittance, nm);
        if sum > greatest.1 {
            greatest = (nm, sum);
        }
    }
    if greatest.1 > 1.0 + ROUNDING {
        let error = SceneError::EnergyNotConserved {
            wavelength_nm: greatest.0,
            sum: greatest.1,
        };
        block.cx.error(at, error);
    }
}

/// Value of a constant or table at a wavelength, with the end values outside.
fn share_at(spectrum: &Spectrum, nm: f64) -> f64 {
    match spectrum {
        Spectrum::Constant(value) => *value,
        Spectrum::Table { points, .. } => {
            let above = points.partition_point(|(other, _)| *other < nm);
            match (
                above.checked_sub(1).and_then(|below| points.get(below)),
                points.get(above),
            ) {
                (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (nm - x0) / (x1 - x0),
                (Some((_, value)), None) | (None, Some((_, value))) => *value,
                (None, None) => 0.0,
            }
        }
        // No share of light is read from these.
        Spectrum::D65 { .. } | Spectrum::Blackbody { .. } => 0.0,
    }
}

/// Reads `abaxial_ratio` of a leaf; the default goes on with its end values in any scene.
pub(crate) fn read_abaxial_ratio(block: &Block<'_>) -> Option<Spectrum> {
    read_spectrum_or(block, "abaxial_ratio", Role::Ratio, || Spectrum::Table {
        points: ABAXIAL_RATIO.to_vec(),
        extrapolate: true,
    })
}

/// Reads `adaxial` and `abaxial` of a leaf, both of which may be left out.
pub(crate) fn read_coats(block: &Block<'_>) -> [Coat; 2] {
    const ALPHA: Limits = Limits::closed(0.02, 1.0);
    let coat = |key: &'static str, alpha: f64| {
        let Some(inner) = block.optional_block(key) else {
            return Coat {
                eta: COAT_ETA,
                alpha_across: alpha,
                alpha_along: alpha,
            };
        };
        let eta = inner.number_or("eta", Limits::closed(1.0, 2.5), COAT_ETA);
        inner.exclude("alpha", "alpha_across");
        inner.exclude("alpha", "alpha_along");
        let alpha = inner.number_or("alpha", ALPHA, alpha);
        let alpha_across = inner.number_or("alpha_across", ALPHA, alpha);
        let alpha_along = inner.number_or("alpha_along", ALPHA, alpha);
        inner.finish();
        Coat {
            eta,
            alpha_across,
            alpha_along,
        }
    };
    let adaxial = coat("adaxial", COAT_ALPHA[0]);
    let abaxial = coat("abaxial", COAT_ALPHA[1]);
    [adaxial, abaxial]
}
