//! `[leaves.NAME]`: a leaf that is grown.

use leafmodel::blade::BladeForm;
use leafmodel::blade::tissue::Tissue;
use leafmodel::leaf::LeafPlan;
use leafmodel::leaf::outline_plan::Contour;
use leafmodel::leaf::venation_plan::VenationPlan;
use leafmodel::optics::{Contents, VeinFactors};

use super::compound::read_compound;
use super::contents::read_contents;
use super::layers::read_layers;
use super::limits::Limits;
use super::material::{read_abaxial_ratio, read_coats};
use super::mosaic::read_mosaic;
use super::outline::read_outline;
use super::petiole::read_petiole;
use super::pigments::read_pigments;
use super::reader::Block;
use super::senescence::read_senescence;
use super::spectrum::require_prospect;
use super::venation::read_venation;
use crate::scene::description::Leaf;

/// Texels of the content maps along the longer side where nothing is said.
pub(crate) const MAP_SIZE: u64 = 1024;

/// Reads one block of `[leaves]`.
pub(crate) fn read_leaf(block: &Block<'_>) -> Option<Leaf> {
    require_prospect(block.cx, &block.at);
    let length_mm = block.number("length_mm", Limits::closed(0.1, 10_000.0));
    let seed = block.integer_or("seed", 0, u64::MAX, 0);
    let map_size = block.integer_or("map_size", 16, 8192, MAP_SIZE) as u32;
    let outline = read_outline(block, seed);
    let venation = read_venation(block, outline.as_ref());
    let contents = block
        .block("contents", &[])
        .and_then(|inner| read_contents(&inner));
    let tissue = contents.map(|lamina| read_tissue(block, lamina));
    if contents.is_none() {
        // Its blocks are read all the same, so that their errors are found too.
        read_tissue(block, Contents::NOTHING);
    }
    let pigments = read_pigments(block);
    let earns = outline.as_ref().zip(venation.as_ref());
    let earns = earns.map(|(outline, venation)| {
        matches!(outline.plan.contour, Contour::Transport(_))
            || matches!(venation, VenationPlan::Transport(_))
    });
    let is_patterned = block.entry("mosaic").is_some();
    let mosaic = contents.and_then(|contents| read_mosaic(block, contents));
    let layers = read_layers(block);
    let is_aged = block.entry("senescence").is_some();
    let senescence = read_senescence(block, earns);
    let form = read_form(block, length_mm.unwrap_or(100.0));
    // Leaflets have stalks of their own.
    block.exclude("compound", "petiole");
    let petiole = read_petiole(block);
    let compound = read_compound(block);
    let abaxial_ratio = read_abaxial_ratio(block);
    let coats = read_coats(block);
    block.finish();
    if (is_aged && senescence.is_none()) || (is_patterned && mosaic.is_none()) {
        return None;
    }
    let plan = LeafPlan {
        length_mm: length_mm?,
        seed,
        outline: outline?.plan,
        venation: venation?,
        tissue: tissue?,
        layers: layers?,
        mosaic,
        senescence,
        form,
        petiole,
        pigments: pigments?,
        compound: compound.as_ref().map(|read| read.form.clone()),
        map_size,
    };
    warn_of_pigments(block, &plan);
    let fits = compound.is_none_or(|compound| compound.check(&plan));
    fits.then_some(Leaf {
        plan,
        abaxial_ratio: abaxial_ratio?,
        coats,
        extrapolate: block.cx.extrapolate.get(),
    })
}

/// Tells of anthocyanins and betalains in parts of one leaf; those of one block of contents are told there.
fn warn_of_pigments(block: &Block<'_>, plan: &LeafPlan) {
    let told = plan.tissue.lamina.mixes_betalains_and_anthocyanins()
        || plan
            .senescence
            .as_ref()
            .is_some_and(|senescence| senescence.contents.mixes_betalains_and_anthocyanins());
    if told {
        return;
    }
    if let Some([anthocyanins, betalains]) = plan.anthocyanins_beside_betalains() {
        let message = format!(
            "this leaf holds anthocyanins (`{anthocyanins}`) and betalains (`{betalains}`), which never occur in the same plant"
        );
        let code = "scene::betalains_and_anthocyanins";
        block
            .cx
            .warn(&block.at, code, message, Contents::NEVER_TOGETHER);
    }
}

/// Tissue of which only the contents are said.
pub(crate) fn default_tissue(lamina: Contents) -> Tissue {
    Tissue {
        lamina,
        vein_factors: VeinFactors::default(),
        full_vein_radius_mm: 0.06,
        sheath_width_mm: 0.1,
        mottle: 0.0,
        mottle_scale_mm: 1.0,
    }
}

/// A blade of which nothing is said: nearly flat.
pub(crate) fn default_form(length_mm: f64) -> BladeForm {
    BladeForm {
        fold: 0.0,
        curl: 0.0,
        ruffle: 0.0,
        ruffle_waves: 3.0,
        relief: 0.5,
        thickness_mm: 0.2,
        max_edge_mm: length_mm / 80.0,
        meshed_vein_radius_mm: 0.1,
    }
}

/// `veins` and `mottle`, both of which may be left out.
fn read_tissue(leaf: &Block<'_>, lamina: Contents) -> Tissue {
    const FACTORS: Limits = Limits::closed(0.0, VeinFactors::MOST);
    const FULL_MM: Limits = Limits::closed(0.001, 100.0);
    const SHEATH_MM: Limits = Limits::closed(0.001, 5.0);
    const PATCH_MM: Limits = Limits::closed(0.01, 1000.0);
    let mut tissue = default_tissue(lamina);
    if let Some(block) = leaf.optional_block("veins") {
        for (constituent, factor) in tissue.vein_factors.iter_mut() {
            *factor = block.number_or(constituent.name(), FACTORS, *factor);
        }
        tissue.full_vein_radius_mm =
            block.number_or("full_radius_mm", FULL_MM, tissue.full_vein_radius_mm);
        tissue.sheath_width_mm =
            block.number_or("sheath_width_mm", SHEATH_MM, tissue.sheath_width_mm);
        block.finish();
    }
    if let Some(block) = leaf.optional_block("mottle") {
        tissue.mottle = block
            .number("share", Limits::closed(0.0, 1.0))
            .unwrap_or_default();
        tissue.mottle_scale_mm = block.number_or("scale_mm", PATCH_MM, tissue.mottle_scale_mm);
        block.finish();
    }
    tissue
}

/// `blade`, which may be left out: a leaf that is nearly flat.
fn read_form(leaf: &Block<'_>, length_mm: f64) -> BladeForm {
    let mut form = default_form(length_mm);
    let Some(block) = leaf.optional_block("blade") else {
        return form;
    };
    form.fold = block
        .number_or("fold_deg", Limits::closed(-80.0, 80.0), 0.0)
        .to_radians();
    form.curl = block
        .number_or("curl_deg", Limits::closed(-355.0, 355.0), 0.0)
        .to_radians();
    form.ruffle = block.number_or("ruffle", Limits::closed(0.0, 0.5), form.ruffle);
    form.ruffle_waves = block.number_or(
        "ruffle_waves",
        Limits::closed(0.0, 100.0),
        form.ruffle_waves,
    );
    form.relief = block.number_or("relief", Limits::closed(0.0, 5.0), form.relief);
    form.thickness_mm = block.number_or(
        "thickness_mm",
        Limits::closed(0.001, 10.0),
        form.thickness_mm,
    );
    // A finer mesh than this has more than some ten million triangles.
    let edges = Limits::closed((length_mm / 2000.0).max(0.001), length_mm);
    form.max_edge_mm = block.number_or("max_edge_mm", edges, form.max_edge_mm);
    form.meshed_vein_radius_mm = block.number_or(
        "meshed_vein_radius_mm",
        Limits::closed(1e-4, 1e3),
        form.meshed_vein_radius_mm,
    );
    block.finish();
    form
}
