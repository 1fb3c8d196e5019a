//! `surface`: what the faces of a leaf have below the mesh.

use crate::blade::surface::SurfacePlan;
use crate::blade::surface::dust::DustPlan;
use crate::blade::surface::stomata::StomataPlan;
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
    let about = "GGX roughness of both coats over tissue that has died of age, beside their own: \
        squares add up.";
    keys.key("dead_roughness", &mut value.dead_roughness, limits, about);
    let about = "How far the leaf has matured: 0 just unfolded, 1 mature.";
    keys.key("maturity", &mut value.maturity, limits, about);
    let limits = Number(Limits::closed(0.2, 1.5));
    let about = "Roughness of both coats of a leaf that has just unfolded over that of the mature \
        one; below 1 it is glossier.";
    keys.key("young_roughness", &mut value.young_roughness, limits, about);
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
    let about = "Its stomata: pits that are seen where a pixel is smaller than they are.";
    keys.block("stomata", about, |keys| stomata(&mut value.stomata, keys));
    let about = "Mineral dust on its faces; left out, they are clean.";
    keys.block("dust", about, |keys| dust(&mut value.dust, keys));
    if keys.is_sound() && value.cells_um > 0.0 && value.cells_um < 5.0 {
        let problem = format!("{} is neither 0 nor from 5 to 500", value.cells_um);
        let help = "cells of an epidermis are 10 to 200 µm wide; write 0 for none";
        keys.refuse(&["cells_um"], problem, help);
    }
}

/// The keys of `stomata`.
fn stomata(value: &mut StomataPlan, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(0.0, 2000.0));
    let [adaxial, abaxial] = &mut value.per_mm2;
    let about = "Stomata per mm² of the adaxial face, away from veins: 0 for none, else from 1.";
    keys.key("adaxial_per_mm2", adaxial, limits, about);
    let about = "Stomata per mm² of the abaxial face. Most leaves have 50 to 500 there.";
    keys.key("abaxial_per_mm2", abaxial, limits, about);
    let limits = Number(Limits::closed(5.0, 120.0));
    let about = "Length of a pit. Where there are more stomata they are smaller.";
    keys.key("length_um", &mut value.length_um, limits, about);
    let limits = Number(Limits::closed(0.2, 1.0));
    let about = "Width of a pit over its length.";
    keys.key("aspect", &mut value.aspect, limits, about);
    let limits = Number(Limits::closed(0.0, 30.0));
    let about = "Depth of a pit.";
    keys.key("depth_um", &mut value.depth_um, limits, about);
    let limits = Number(Limits::closed(0.0, 1000.0));
    let about = "Distance between rows that run along the veins, as in grasses: 0 if stomata lie \
        scattered, else from 20.";
    keys.key("row_um", &mut value.row_um, limits, about);
    if !keys.is_sound() {
        return;
    }
    if value.row_um > 0.0 && value.row_um < 20.0 {
        let problem = format!("{} is neither 0 nor from 20 to 1000", value.row_um);
        let help = "rows of stomata are some 50 to 300 µm apart; write 0 for scattered ones";
        keys.refuse(&["row_um"], problem, help);
    }
    for (key, density) in ["adaxial_per_mm2", "abaxial_per_mm2"]
        .into_iter()
        .zip(value.per_mm2)
    {
        if density > 0.0 && density < 1.0 {
            let problem = format!("{density} is neither 0 nor from 1 to 2000");
            keys.refuse(
                &[key],
                problem,
                "leaves have 5 to 1000 a mm²; write 0 for none",
            );
        }
    }
}

/// The keys of `dust`.
fn dust(value: &mut DustPlan, keys: &mut Keys<'_>) {
    let number = |least, most| Number(Limits::closed(least, most));
    let [adaxial, abaxial] = &mut value.load_g_per_m2;
    let about = "Mean load of the adaxial face. With grains of 12 µm, 5 g cover a fifth of it.";
    keys.key("adaxial_g_per_m2", adaxial, number(0.0, 50.0), about);
    let about = "Mean load of the abaxial face.";
    keys.key("abaxial_g_per_m2", abaxial, number(0.0, 50.0), about);
    let about = "Diameter of the grains. Smaller ones cover more for their mass.";
    keys.key("grain_um", &mut value.grain_um, number(1.0, 100.0), about);
    let about = "Factor on the reflectance of the dry soil that the dust comes from.";
    keys.key("brightness", &mut value.brightness, number(0.1, 1.5), about);
    let about = "Variation of the load from patch to patch, as a share of it.";
    keys.key("patchiness", &mut value.patchiness, number(0.0, 1.0), about);
    let about = "Size of the patches.";
    keys.key("patch_mm", &mut value.patch_mm, number(0.2, 200.0), about);
    let about = "By how much more lies on veins of the first two orders, over the load far from \
        them.";
    keys.key("at_veins", &mut value.at_veins, number(0.0, 10.0), about);
    let about = "By how much more lies at the margin, where water leaves the blade.";
    keys.key("at_margin", &mut value.at_margin, number(0.0, 10.0), about);
    let about =
        "Distance from a vein over which that falls to 1/e; four times that from the margin.";
    keys.key("reach_mm", &mut value.reach_mm, number(0.05, 50.0), about);
}
