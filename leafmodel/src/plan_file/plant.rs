//! The keys of a plant: its axes, and how they bear leaves.

use super::presets::Chosen;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Degrees, DegreesList, Integer, Number, Numbers, Vector, Word};
use crate::plant::presets::PRESETS;
use crate::plant::{AxisPlan, Branching, Buds, Phyllotaxis, PlantError, PlantPlan, Posture};

const SHARE: Limits = Limits::closed(0.0, 1.0);

/// The key `preset` of a plant. Where it is there, no other key is required.
pub fn plant_preset(plan: &mut PlantPlan, keys: &mut Keys<'_>) {
    let chosen = Chosen {
        kind: "preset",
        all: PRESETS,
        name_of: |preset| preset.name,
    };
    let mut preset = None;
    let about = "A plant whose numbers hold where nothing else is said.";
    keys.optional("preset", &mut preset, chosen, about);
    if let Some(preset) = preset {
        *plan = preset.plan();
        keys.set_base(preset.name);
    }
}

/// A plant of which nothing is said.
pub fn usual_plant() -> PlantPlan {
    PlantPlan::usual()
}

/// The keys of a plant's numbers.
pub fn plant(plan: &mut PlantPlan, keys: &mut Keys<'_>) {
    let about = "Same plan and seed, same plant.";
    keys.key("seed", &mut plan.seed, Integer::within(0, u64::MAX), about);
    let about = "Different leaves of each kind that are grown; neighbours differ from 2 on.";
    keys.key(
        "individuals",
        &mut plan.individuals,
        Integer::within(1, 1000),
        about,
    );
    axis(&mut plan.axis, keys);
    let about = "Branches in the axils of leaves.";
    keys.optional_block(
        "branches",
        &mut plan.branching,
        || Branching::USUAL,
        about,
        branches,
    );
    let about = "How leaves stand on their axis.";
    keys.block("posture", about, |keys| posture(&mut plan.posture, keys));
    let usual = || Buds {
        length_mm: 4.0,
        radius_mm: 1.2,
    };
    let about = "Buds in the axils of leaves and at the tips.";
    keys.optional_block("buds", &mut plan.buds, usual, about, |buds, keys| {
        let limits = Number(Limits::closed(0.2, 50.0));
        keys.key("length_mm", &mut buds.length_mm, limits, "Length.");
        let limits = Number(Limits::closed(0.1, 20.0));
        keys.key("radius_mm", &mut buds.radius_mm, limits, "Greatest radius.");
    });
    if keys.is_sound()
        && let Err(error) = plan.validate()
    {
        let help = match error {
            PlantError::NoRoom { .. } => {
                "use fewer nodes, a longer or thinner axis, or a \
                `shortening` nearer to 1"
            }
            PlantError::OutOfRange { .. }
            | PlantError::TooLarge
            | PlantError::NoLeaf
            | PlantError::Bent(_)
            | PlantError::NotBorne(_) => "choose another",
        };
        keys.refuse(&["nodes"], error.to_string(), help);
    }
}

fn axis(axis: &mut AxisPlan, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(1.0, 1e5));
    keys.key(
        "length_mm",
        &mut axis.length_mm,
        limits,
        "Length of the main axis.",
    );
    let about = "Nodes of the main axis, the last one at its tip.";
    keys.key("nodes", &mut axis.nodes, Integer::within(1, 1000), about);
    let about = "Share of an axis below its first node.";
    keys.key(
        "bare",
        &mut axis.bare,
        Number(Limits::closed(0.0, 0.99)),
        about,
    );
    let about = "Length of each internode over that of the one before.";
    keys.key(
        "shortening",
        &mut axis.shortening,
        Number(Limits::closed(0.5, 1.5)),
        about,
    );
    let about = "Radius at the foot and at the tip.";
    let limits = Numbers::<2>(Limits::closed(0.05, 1000.0));
    keys.key("radius_mm", &mut axis.radius_mm, limits, about);
    let about = "How much thicker nodes are, over the radius.";
    keys.key("swelling", &mut axis.swelling, Number(SHARE), about);
    let known = [
        ("distichous", Phyllotaxis::DISTICHOUS),
        ("decussate", Phyllotaxis::DECUSSATE),
        ("spiral", Phyllotaxis::SPIRAL),
        ("whorled", Phyllotaxis::WHORLED),
    ];
    let about = "How leaves follow one another: in two rows, in pairs at right angles, one by one \
        by the golden angle, or in whorls of three.";
    keys.key("phyllotaxis", &mut axis.phyllotaxis, Word(&known), about);
    let about = "Leaves of a node, instead of what `phyllotaxis` says.";
    let mut per_node = None;
    keys.optional("per_node", &mut per_node, Integer::within(1, 12), about);
    let about = "Angle about the axis from node to node, instead of what `phyllotaxis` says.";
    let mut divergence = None;
    let limits = Degrees(Limits::closed(-180.0, 180.0));
    keys.optional("divergence_deg", &mut divergence, limits, about);
    axis.phyllotaxis = Phyllotaxis {
        per_node: per_node.unwrap_or(axis.phyllotaxis.per_node),
        divergence: divergence.unwrap_or(axis.phyllotaxis.divergence),
    };
    let limits = Degrees(Limits::closed(0.0, 34.0));
    let about = "Angle by which the axis bends away from the leaf at each node of one leaf.";
    keys.key("zigzag_deg", &mut axis.zigzag, limits, about);
    let limits = Degrees(Limits::closed(0.0, 180.0));
    let about = "Angle of its foot from upright, towards +y.";
    keys.key("inclination_deg", &mut axis.inclination, limits, about);
    let limits = Degrees(Limits::closed(-170.0, 170.0));
    let about =
        "Angle by which a level axis would turn upwards from foot to tip; below 0 it droops.";
    keys.key("upward_deg", &mut axis.upward, limits, about);
    let limits = Degrees(Limits::closed(0.0, 28.0));
    let about = "Standard deviation of the bend of each internode.";
    keys.key("stray_deg", &mut axis.stray, limits, about);
}

fn branches(branches: &mut Branching, keys: &mut Keys<'_>) {
    let about = "1: the main axis has branches; 2: these have branches too; and so on.";
    keys.key("order", &mut branches.order, Integer::within(1, 4), about);
    let about = "The nodes with branches: from and up to these shares of their axis.";
    keys.key("between", &mut branches.between, Numbers::<2>(SHARE), about);
    let [from, to] = branches.between;
    if from > to {
        let problem = format!("there is nothing from {from} up to {to}");
        keys.refuse(&["between"], problem, "write the smaller share first");
    }
    let limits = Numbers::<2>(Limits::closed(0.02, 1.0));
    let about = "Their lengths at both ends of that, over that of the axis that bears them.";
    keys.key("length", &mut branches.length, limits, about);
    let limits = Degrees(Limits::closed(6.0, 114.0));
    let about = "Angle from the axis that bears them.";
    keys.key("angle_deg", &mut branches.angle, limits, about);
    let about = "Radius of a branch's foot over that of its axis there.";
    keys.key(
        "thickness",
        &mut branches.thickness,
        Number(Limits::closed(0.1, 1.0)),
        about,
    );
    let about = "Share of the axils there that have one; the others bear leaves.";
    keys.key("share", &mut branches.share, Number(SHARE), about);
}

fn posture(posture: &mut Posture, keys: &mut Keys<'_>) {
    let limits = DegreesList::<2>(Limits::closed(3.0, 170.0));
    let about = "Angle of the petiole's foot from the axis, at the axis' foot and at its tip.";
    keys.key("angle_deg", &mut posture.angle, limits, about);
    let limits = Numbers::<3>(Limits::closed(0.02, 2.0));
    let about = "Factor on the leaves at the axis' foot, in its middle and at its tip.";
    keys.key("size", &mut posture.size, limits, about);
    let about = "Share of the turn to the light that petioles make.";
    keys.key("to_light", &mut posture.to_light, Number(SHARE), about);
    let about = "Where the light comes from, in the plant's frame; any length but 0.";
    keys.key(
        "light",
        &mut posture.light,
        Vector(Limits::closed(-1e6, 1e6)),
        about,
    );
    match posture.light.try_normalize() {
        Some(light) => posture.light = light,
        None => keys.refuse(
            &["light"],
            "a direction of length 0 is none".to_owned(),
            "write where the light comes from, such as `[0, 0, 1]`",
        ),
    }
    let limits = Degrees(Limits::closed(0.0, 40.0));
    let about = "Standard deviation of the turns of each leaf.";
    keys.key("stray_deg", &mut posture.stray, limits, about);
    let about = "Leaves of each short shoot; with 1 there are no short shoots.";
    keys.key(
        "cluster",
        &mut posture.cluster,
        Integer::within(1, 12),
        about,
    );
    let limits = Number(Limits::closed(0.5, 200.0));
    keys.key(
        "spur_mm",
        &mut posture.spur_mm,
        limits,
        "Length of a short shoot.",
    );
}
