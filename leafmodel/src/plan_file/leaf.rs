//! A leaf: the keys of a plan, and what belongs together in them.

use super::compound;
use super::outline::{self, outline};
use super::venation;
use crate::blade::BladeForm;
use crate::blade::hairs::HairPlan;
use crate::blade::layers::Layer;
use crate::blade::petiole::PetiolePlan;
use crate::blade::senescence::{AgeSource, Senescence};
use crate::blade::stance::Stance;
use crate::blade::surface::SurfacePlan;
use crate::blade::tissue::Tissue;
use crate::blade::unevenness::Unevenness;
use crate::compound::CompoundForm;
use crate::document::declared::Declared;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number};
use crate::leaf::LeafPlan;
use crate::leaf::damage::Damage;
use crate::leaf::outline_plan::Contour;
use crate::optics::contents_keys::{NEVER_TOGETHER, contents};
use crate::optics::{Contents, Pigments};
use crate::shape::growth_form::GrowthForm;
use crate::venation::plan::AuxinPlan;

/// A leaf of which nothing is said but its length.
pub fn usual_leaf(length_mm: f64) -> LeafPlan {
    LeafPlan {
        length_mm,
        seed: 0,
        outline: Contour::GrowthAlgorithm(GrowthForm::default()).into(),
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
        map_size: 1024,
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
    keys.block("pigments", about, |keys| plan.pigments.declare(keys));
    let base = plan.tissue.lamina;
    let about = "Cells of several types.";
    keys.optional_block(
        "mosaic",
        &mut plan.mosaic,
        Default::default,
        about,
        |pattern, keys| pattern.keys(keys, base),
    );
    Layer::all(&mut plan.layers, keys);
    let about = "How its greens differ from place to place; left out, only by the mottle.";
    let uneven = &mut plan.unevenness;
    keys.optional_block(
        "unevenness",
        uneven,
        Unevenness::default,
        about,
        Declared::declare,
    );
    let about = "How far it has aged; left out, it is in summer.";
    let aged = &mut plan.senescence;
    keys.optional_block(
        "senescence",
        aged,
        Senescence::default,
        about,
        Declared::declare,
    );
    let about = "What has eaten of it once it had grown.";
    let damage = &mut plan.damage;
    keys.optional_block("damage", damage, Damage::default, about, Declared::declare);
    blade_and_stalks(plan, keys);
    if keys.reader().is_some() {
        check(plan, keys);
    }
}

/// The blade in space, what its faces bear, and its stalks.
fn blade_and_stalks(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let length_mm = plan.length_mm;
    let about = "How the blade lies in space.";
    keys.block("blade", about, |keys| {
        // A finer mesh than this has more than some ten million triangles.
        let edges = Limits::closed((length_mm / 2000.0).max(0.001), length_mm);
        plan.form.keys(keys, edges);
        plan.stance.declare(keys);
    });
    let about = "What its faces have below the mesh; left out, they are smooth.";
    let smooth = || SurfacePlan::SMOOTH;
    keys.optional_block(
        "surface",
        &mut plan.surface,
        smooth,
        about,
        Declared::declare,
    );
    HairPlan::kinds(&mut plan.hairs, keys);
    // Leaflets have stalks of their own.
    keys.exclude("compound", "petiole");
    let about = "Its stalk, if it is a simple leaf.";
    let stalk = &mut plan.petiole;
    keys.optional_block(
        "petiole",
        stalk,
        PetiolePlan::default,
        about,
        Declared::declare,
    );
    let about = "This is the largest leaflet of a compound leaf.";
    keys.optional_block(
        "compound",
        &mut plan.compound,
        CompoundForm::default,
        about,
        CompoundForm::keys,
    );
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
    tissue.keys_of_veins(keys);
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
