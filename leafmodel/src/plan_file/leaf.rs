//! A leaf: the keys of a plan, and what belongs together in them.

use super::compound::{self, compound, petiole, usual_compound, usual_petiole};
use super::contents::{NEVER_TOGETHER, contents};
use super::damage::damage;
use super::hairs::hairs;
use super::layers::layers;
use super::mosaic::{self, mosaic};
use super::outline::{self, outline};
use super::pigments::pigments;
use super::senescence::{self, senescence};
use super::solid::MAP_SIZE;
use super::stance::stance;
use super::surface::surface;
use super::unevenness::unevenness;
use super::venation;
use crate::blade::BladeForm;
use crate::blade::senescence::AgeSource;
use crate::blade::stance::Stance;
use crate::blade::surface::SurfacePlan;
use crate::blade::tissue::Tissue;
use crate::blade::unevenness::Unevenness;
use crate::blade::vein_body::VeinBody;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Degrees, Flag, Integer, Number};
use crate::leaf::LeafPlan;
use crate::leaf::damage::Damage;
use crate::leaf::outline_plan::Contour;
use crate::optics::{Contents, Pigments, VeinFactors};
use crate::venation::plan::AuxinPlan;

/// A leaf of which nothing is said but its length.
pub fn usual_leaf(length_mm: f64) -> LeafPlan {
    LeafPlan {
        length_mm,
        seed: 0,
        outline: Contour::GrowthAlgorithm(super::growth_form::usual()).into(),
        venation: AuxinPlan::default().into(),
        tissue: Tissue::of(Contents::NOTHING),
        unevenness: None,
        layers: Vec::new(),
        mosaic: None,
        senescence: None,
        form: BladeForm::nearly_flat(length_mm),
        stance: Stance::default(),
        surface: None,
        hairs: Vec::new(),
        petiole: None,
        compound: None,
        damage: None,
        pigments: Pigments::default(),
        map_size: MAP_SIZE,
    }
}

/// What is wanted of a leaf.
#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    /// All of it.
    Whole,
    /// Margin and veins: its contents need not be said.
    Veins,
    /// All of it, from a file of this program: tests have tried its margin.
    Preset,
}

/// The keys of a leaf.
pub fn leaf(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    whole_or_veins(plan, keys, Wanted::Whole);
}

/// The keys of a leaf in the file of a preset.
pub(super) fn leaf_of_preset(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    whole_or_veins(plan, keys, Wanted::Preset);
}

/// The keys of a leaf of which only margin and veins are wanted: its contents need not be said.
pub(super) fn veins_alone(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    whole_or_veins(plan, keys, Wanted::Veins);
}

fn whole_or_veins(plan: &mut LeafPlan, keys: &mut Keys<'_>, wanted: Wanted) {
    let before = plan.length_mm;
    let limits = Number(Limits::closed(0.1, 10_000.0));
    let about = "Length of the midrib.";
    keys.required("length_mm", &mut plan.length_mm, limits, about);
    follow_length(plan, before, plan.length_mm);
    let seed = Integer::within(0, u64::MAX);
    keys.key(
        "seed",
        &mut plan.seed,
        seed,
        "Same plan and seed, same leaf, bit for bit.",
    );
    let size = Integer::within(16, 8192);
    let about = "Texels of the content maps along the longer side.";
    keys.key("map_size", &mut plan.map_size, size, about);
    let names = outline::KINDS.map(|kind| kind.name);
    let errors = error_count(keys);
    let about = "The margin.";
    keys.required_block("outline", about, &names, |keys| outline(plan, keys));
    let can_be_tried = wanted != Wanted::Preset && is_whole(keys, "outline", errors);
    let tried = can_be_tried.then(|| outline::tried(plan, keys)).flatten();
    let names = venation::KINDS.map(|kind| kind.name);
    let errors = error_count(keys);
    let about = "How its veins come to be.";
    keys.required_block("venation", about, &names, |keys| {
        keys.kind(&mut plan.venation, &venation::KINDS);
    });
    if is_whole(keys, "venation", errors) {
        venation::check(plan, tried.as_ref(), keys);
    }
    tissue(plan, keys, wanted != Wanted::Veins);
    let about = "Which substances its pigments are.";
    keys.block("pigments", about, |keys| pigments(&mut plan.pigments, keys));
    let base = plan.tissue.lamina;
    let about = "Cells of several types.";
    keys.optional_block(
        "mosaic",
        &mut plan.mosaic,
        mosaic::usual,
        about,
        |pattern, keys| {
            mosaic(pattern, keys, base);
        },
    );
    layers(&mut plan.layers, keys);
    let about = "How its greens differ from place to place; left out, only by the mottle.";
    let uneven = &mut plan.unevenness;
    keys.optional_block("unevenness", uneven, Unevenness::default, about, unevenness);
    let about = "How far it has aged; left out, it is in summer.";
    let aged = &mut plan.senescence;
    keys.optional_block("senescence", aged, senescence::usual, about, senescence);
    let about = "What has eaten of it once it had grown.";
    keys.optional_block("damage", &mut plan.damage, Damage::default, about, damage);
    let length_mm = plan.length_mm;
    let about = "How the blade lies in space.";
    keys.block("blade", about, |keys| {
        form_keys(&mut plan.form, keys, length_mm);
        stance(&mut plan.stance, keys);
    });
    let about = "What its faces have below the mesh; left out, they are smooth.";
    let smooth = || SurfacePlan::SMOOTH;
    keys.optional_block("surface", &mut plan.surface, smooth, about, surface);
    hairs(&mut plan.hairs, keys);
    // Leaflets have stalks of their own.
    keys.exclude("compound", "petiole");
    let about = "Its stalk, if it is a simple leaf.";
    keys.optional_block("petiole", &mut plan.petiole, usual_petiole, about, petiole);
    let about = "This is the largest leaflet of a compound leaf.";
    keys.optional_block(
        "compound",
        &mut plan.compound,
        usual_compound,
        about,
        compound,
    );
    if keys.reader().is_some() {
        check(plan, keys);
    }
}

/// Lets what has the default for one length of the leaf have that for another.
pub(super) fn follow_length(plan: &mut LeafPlan, before: f64, after: f64) {
    if plan.form.max_edge_mm == BladeForm::nearly_flat(before).max_edge_mm {
        plan.form.max_edge_mm = BladeForm::nearly_flat(after).max_edge_mm;
    }
}

fn error_count(keys: &Keys<'_>) -> Option<usize> {
    let block = keys.reader()?;
    let is_survey = block.cx.survey.borrow().is_some();
    (!is_survey).then(|| block.cx.error_count())
}

/// Whether a block that must be there, or stands on a preset, was read without an error since there
/// were so many.
fn is_whole(keys: &Keys<'_>, block: &str, errors: Option<usize>) -> bool {
    let there = keys.base().is_some() || keys.has_path(&[block]);
    errors.is_some() && error_count(keys) == errors && there
}

/// `contents`, `veins` and `mottle`.
fn tissue(plan: &mut LeafPlan, keys: &mut Keys<'_>, whole: bool) {
    let tissue = &mut plan.tissue;
    let before = tissue.lamina;
    let about = "What the lamina holds between veins.";
    if whole || keys.has("contents") {
        keys.required_block("contents", about, &[], |keys| {
            contents(&mut tissue.lamina, keys);
        });
    }
    // Cells of a preset that held what the tissue does go on to do so.
    for held in plan
        .mosaic
        .iter_mut()
        .flat_map(|mosaic| &mut mosaic.contents)
    {
        for (constituent, own) in held.iter_mut() {
            if *own == before[constituent] {
                *own = tissue.lamina[constituent];
            }
        }
    }
    let about = "Factors on the contents over the middle of a thick vein.";
    keys.block("veins", about, |keys| {
        let limits = Number(Limits::closed(0.0, VeinFactors::MOST));
        for (constituent, factor) in tissue.vein_factors.iter_mut() {
            let about = "Factor on this content over a fully developed vein.";
            keys.key(constituent.name(), factor, limits, about);
        }
        let limits = Number(Limits::closed(0.001, 100.0));
        let about = "Radius from which a vein has the whole factors; finer ones take part of \
            them.";
        keys.key(
            "full_radius_mm",
            &mut tissue.full_vein_radius_mm,
            limits,
            about,
        );
        let limits = Number(Limits::closed(0.001, 5.0));
        let about = "Width over which a vein blends into the lamina.";
        keys.key(
            "sheath_width_mm",
            &mut tissue.sheath_width_mm,
            limits,
            about,
        );
        let about = "What thick veins are made of: a vein thicker than the blade holds this for \
            each thickness of the blade that it is thicker. Left out, the surplus follows from the \
            factors.";
        let body = &mut tissue.vein_body;
        keys.optional_block(
            "body",
            body,
            || VeinBody::USUAL,
            about,
            |body, keys| {
                let limits = Number(Limits::closed(0.0, VeinBody::MOST));
                for (constituent, share) in body.shares.iter_mut() {
                    let about =
                        "Share of what the blade between veins holds in the same thickness.";
                    keys.key(constituent.name(), share, limits, about);
                }
            },
        );
    });
    let mut mottle = (tissue.mottle != 0.0 || tissue.mottle_scale_mm != Tissue::MOTTLE_SCALE_MM)
        .then_some((tissue.mottle, tissue.mottle_scale_mm));
    let new = || (0.0, Tissue::MOTTLE_SCALE_MM);
    let about = "Chlorophyll and carotenoids vary from patch to patch.";
    keys.optional_block(
        "mottle",
        &mut mottle,
        new,
        about,
        |(share, scale_mm), keys| {
            let limits = Number(Limits::closed(0.0, 1.0));
            keys.required("share", share, limits, "How far they vary.");
            let limits = Number(Limits::closed(0.01, 1000.0));
            keys.key("scale_mm", scale_mm, limits, "Size of patches.");
        },
    );
    (tissue.mottle, tissue.mottle_scale_mm) = mottle.unwrap_or(new());
}

/// The keys of `blade`.
fn form_keys(form: &mut BladeForm, keys: &mut Keys<'_>, length_mm: f64) {
    let limits = Degrees(Limits::closed(-80.0, 80.0));
    let about = "Angle by which each half is raised about the midrib, towards the adaxial side.";
    keys.key("fold_deg", &mut form.fold, limits, about);
    let limits = Degrees(Limits::closed(-355.0, 355.0));
    let about = "Angle through which the midrib bends from base to apex, towards the abaxial \
        side.";
    keys.key("curl_deg", &mut form.curl, limits, about);
    let limits = Number(Limits::closed(0.0, 0.5));
    let about = "Height of the wave along the margin over the leaf's length.";
    keys.key("ruffle", &mut form.ruffle, limits, about);
    let limits = Number(Limits::closed(0.0, 100.0));
    let about = "Waves along each side.";
    keys.key("ruffle_waves", &mut form.ruffle_waves, limits, about);
    let limits = Degrees(Limits::closed(0.0, 55.0));
    let about = "Slope of the folds along primary and secondary veins (pleats), which lie in the \
        valleys.";
    keys.key("pleat_deg", &mut form.pleat, limits, about);
    let limits = Number(Limits::closed(0.0, 5.0));
    let about = "Height of veins on the abaxial side over their diameter.";
    keys.key("relief", &mut form.relief, limits, about);
    let limits = Number(Limits::closed(0.001, 10.0));
    let about = "Thickness between veins.";
    keys.key("thickness_mm", &mut form.thickness_mm, limits, about);
    let limits = Number(Limits::closed(0.05, 1.0));
    let about = "Thickness at the margin over that between veins; contents per area fall with it.";
    keys.key("margin_thickness", &mut form.margin.share, limits, about);
    let limits = Number(Limits::closed(0.01, 100.0));
    let about = "Distance from the margin within which the thickness falls to that.";
    keys.key("margin_width_mm", &mut form.margin.width_mm, limits, about);
    let about = "Whether the blade has two faces and a rim, for pictures from close by, and not one \
        sheet that stands for both.";
    keys.key("closed", &mut form.closed, Flag, about);
    // A finer mesh than this has more than some ten million triangles.
    let edges = Number(Limits::closed((length_mm / 2000.0).max(0.001), length_mm));
    let about = "Longest edge of the mesh.";
    keys.key("max_edge_mm", &mut form.max_edge_mm, edges, about);
    let limits = Number(Limits::closed(1e-4, 1e3));
    let about = "Veins at least this wide are edges of the mesh and have relief.";
    keys.key(
        "meshed_vein_radius_mm",
        &mut form.meshed_vein_radius_mm,
        limits,
        about,
    );
}

/// Reports what is allowed one by one and not together.
fn check(plan: &LeafPlan, keys: &Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    let earns = matches!(plan.outline.contour, Contour::Transport(_))
        || matches!(
            plan.venation,
            crate::leaf::venation_plan::VenationPlan::Transport(_)
        );
    if let Some(senescence) = &plan.senescence
        && senescence.needs_cells()
        && !earns
    {
        let path: &[&str] = match senescence.source {
            AgeSource::Revenue { .. } => &["senescence", "revenue_share"],
            AgeSource::Day { .. } => &["senescence", "deaths_days"],
        };
        let problem = "no cell of this leaf earns any revenue: it is not a transport leaf";
        let help = "write [leaves.NAME.outline.transport] or [leaves.NAME.venation.transport], or leave senescence out";
        keys.refuse(path, problem.to_owned(), help);
    }
    compound::check(plan, keys);
    let lamina = &plan.tissue.lamina;
    let dead = plan
        .senescence
        .as_ref()
        .map(|senescence| &senescence.contents);
    let mut parts = std::iter::once(lamina).chain(dead);
    if parts.any(Contents::mixes_betalains_and_anthocyanins) {
        // Told where those contents are.
        return;
    }
    if let Some([anthocyanins, betalains]) = plan.anthocyanins_beside_betalains() {
        let message = format!(
            "this leaf holds anthocyanins (`{anthocyanins}`) and betalains (`{betalains}`), which never occur in the same plant"
        );
        keys.warn(NEVER_TOGETHER, message, Contents::NEVER_TOGETHER);
    }
}
