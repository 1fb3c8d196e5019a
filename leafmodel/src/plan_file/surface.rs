//! `surface`: what the faces of a leaf have below the mesh.

use crate::blade::surface::SurfacePlan;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::Number;

/// The keys of `surface`.
pub(super) fn surface(value: &mut SurfacePlan, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(-2.0, 2.0));
    let about = "Depth of the groove over a vein on the adaxial face, over the vein's diameter; \
        below 0 it stands out.";
    keys.key("impressed", &mut value.impressed, limits, about);
    let about = "Height of a vein on the abaxial face over its diameter; below 0 it is sunk.";
    keys.key("raised", &mut value.raised, limits, about);
    let limits = Number(Limits::closed(0.0, 5.0));
    let about = "Height to which the lamina bulges far from veins, towards the adaxial side.";
    keys.key("bulge_mm", &mut value.bulge_mm, limits, about);
    let limits = Number(Limits::closed(0.05, 100.0));
    let about = "Distance from a vein within which it rises to that; narrower areoles bulge less.";
    keys.key("bulge_width_mm", &mut value.bulge_width_mm, limits, about);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "GGX roughness of both coats over a fully developed vein beside their own: \
        squares add up.";
    keys.key("vein_roughness", &mut value.vein_roughness, limits, about);
    let limits = Number(Limits::closed(0.0, 500.0));
    let about = "Width of the cells of the epidermis: 0 for none, else from 5. They are seen where \
        a pixel is smaller than a cell.";
    keys.key("cells_um", &mut value.cells_um, limits, about);
    let limits = Number(Limits::closed(1.0, 30.0));
    let about = "Length of these cells along the midrib over their width.";
    keys.key("cell_elongation", &mut value.cell_elongation, limits, about);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "Share of a coat's roughness, as a square, that the bulging of cells makes.";
    keys.key("cell_share", &mut value.cell_share, limits, about);
    let limits = Number(Limits::closed(0.0, 10.0));
    let [adaxial, abaxial] = &mut value.bloom;
    let about = "Optical thickness of wax crystals on the adaxial face, which scatter all light: 0.1 \
        is a breath, 1 a white bloom.";
    keys.key("adaxial_bloom", adaxial, limits, about);
    let about = "Optical thickness of wax crystals on the abaxial face.";
    keys.key("abaxial_bloom", abaxial, limits, about);
    if keys.is_sound() && value.cells_um > 0.0 && value.cells_um < 5.0 {
        let problem = format!("{} is neither 0 nor from 5 to 500", value.cells_um);
        let help = "cells of an epidermis are 10 to 200 µm wide; write 0 for none";
        keys.refuse(&["cells_um"], problem, help);
    }
}
