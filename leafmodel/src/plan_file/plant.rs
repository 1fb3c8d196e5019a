//! The keys of a plant: its axes, and how they bear leaves.

use super::presets::Chosen;
use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{
    Degrees, DegreesList, Flag, Integer, Number, Numbers, Vector, Word,
};
use crate::plant::presets::PRESETS;
use crate::plant::{
    AxisPlan, BarkRelief, Branching, Buds, Climbing, FlowerPlan, Phyllotaxis, PlantError,
    PlantPlan, Posture, PotPlan, Stems,
};

const SHARE: Limits = Limits::closed(0.0, 1.0);

/// The key `preset` of a plant. Where it is there, no other key is required.
pub fn plant_preset(plan: &mut PlantPlan, keys: &mut Keys<'_>) {
    let chosen = Chosen {
        kind: "preset",
        all: PRESETS,
        name_of: |preset| preset.name,
        about: |preset| preset.about,
    };
    let mut preset = None;
    let about = "A plant whose numbers hold where nothing else is said.";
    keys.optional("preset", &mut preset, chosen, about);
    if let Some(preset) = preset {
        *plan = preset.plan();
        keys.set_base(preset.name);
    } else if keys.has_path(&["preset"]) {
        keys.set_unknown_base();
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
    let about = "Other turns about its foot that a leaf tries whose blade would cut another one or an \
        axis; it takes the first that cuts nothing, or the one that cuts least. Compound leaves and \
        plants that climb try none.";
    let limits = Integer::within(0, 1000);
    keys.key("evasions", &mut plan.evasions, limits, about);
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
    let about = "The stems that rise from its foot.";
    keys.block("stems", about, |keys| stems(&mut plan.stems, keys));
    let about = "Whether its axes are green and soft instead of bark.";
    keys.key("green", &mut plan.is_green, Flag, about);
    let about = "The relief of its axes; left out, they are smooth.";
    keys.optional_block(
        "relief",
        &mut plan.relief,
        || BarkRelief::USUAL,
        about,
        relief,
    );
    let about = "A flower at the tip of each stem.";
    keys.optional_block(
        "flower",
        &mut plan.flower,
        || FlowerPlan::USUAL,
        about,
        flower,
    );
    let about = "How it climbs on a wall; left out, its axes stand free.";
    keys.optional_block(
        "climbing",
        &mut plan.climbing,
        || Climbing::USUAL,
        about,
        climbing,
    );
    let about = "A pot with soil, in which it stands.";
    keys.optional_block("pot", &mut plan.pot, || PotPlan::USUAL, about, pot);
    if keys.is_sound()
        && let Err(error) = plan.validate()
    {
        let (path, help): (&[&str], _) = match error {
            PlantError::NoRoom { .. } => (
                &["nodes"],
                "use fewer nodes, a longer or thinner axis, or a \
                `shortening` nearer to 1",
            ),
            PlantError::NoPot => (
                &["pot"],
                "make the pot wider or higher, its wall thinner, its rim lower or the soil deeper",
            ),
            PlantError::OutOfRange { .. }
            | PlantError::TooLarge
            | PlantError::NoLeaf
            | PlantError::Bent(_)
            | PlantError::NotBorne(_) => (&["nodes"], "choose another"),
        };
        keys.refuse(path, error.to_string(), help);
    }
}

fn relief(relief: &mut BarkRelief, keys: &mut Keys<'_>) {
    let limits = Number(Limits::closed(0.0, 20.0));
    let about = "Height of the ridges along an axis over the furrows between them.";
    keys.key("ridges_mm", &mut relief.ridges_mm, limits, about);
    let limits = Number(Limits::closed(0.1, 100.0));
    let about = "Distance from ridge to ridge around the thickest part of an axis; they are eight times as long.";
    keys.key("ridge_width_mm", &mut relief.ridge_width_mm, limits, about);
    let limits = Number(Limits::closed(0.0, 200.0));
    let about = "Lenticels, the pores of bark, on a square centimetre.";
    keys.key(
        "lenticels_per_cm2",
        &mut relief.lenticels_per_cm2,
        limits,
        about,
    );
    let limits = Numbers::<2>(Limits::closed(0.1, 50.0));
    let about = "Their lengths across and along the axis.";
    keys.key("lenticel_mm", &mut relief.lenticel_mm, limits, about);
    let limits = Number(Limits::closed(0.0, 5.0));
    let about = "Their height.";
    keys.key(
        "lenticel_height_mm",
        &mut relief.lenticel_height_mm,
        limits,
        about,
    );
    let limits = Number(Limits::closed(0.02, 20.0));
    let about = "About the longest edge of the mesh along and around an axis.";
    keys.key("edge_mm", &mut relief.edge_mm, limits, about);
    if keys.is_sound() && relief.is_crowded() {
        let problem = "so many of that size would cover all of the bark".to_owned();
        let help = "use fewer, or smaller ones by `lenticel_mm`";
        keys.refuse(&["lenticels_per_cm2"], problem, help);
    }
}

fn stems(stems: &mut Stems, keys: &mut Keys<'_>) {
    let about = "How many; the first is the main axis, the others are shorter.";
    keys.key("count", &mut stems.count, Integer::within(1, 100), about);
    let about = "Radius of the disc within which they rise; along a wall, half the width.";
    let limits = Number(Limits::closed(0.0, 1e4));
    keys.key("spread_mm", &mut stems.spread_mm, limits, about);
    let limits = Degrees(Limits::closed(0.0, 80.0));
    let about = "Angle by which the outermost lean outwards.";
    keys.key("fan_deg", &mut stems.fan, limits, about);
}

fn flower(flower: &mut FlowerPlan, keys: &mut Keys<'_>) {
    let about = "Sepals, petals, stamens of either whorl, stigmas: so many of each.";
    keys.key("parts", &mut flower.parts, Integer::within(2, 12), about);
    let limits = Number(Limits::closed(1.0, 1000.0));
    let about = "Length of the peduncle.";
    keys.key("peduncle_mm", &mut flower.peduncle_mm, limits, about);
    let limits = Number(Limits::closed(0.1, 20.0));
    let about = "Radius of the peduncle.";
    keys.key(
        "peduncle_radius_mm",
        &mut flower.peduncle_radius_mm,
        limits,
        about,
    );
    let limits = Degrees(Limits::closed(0.0, 143.0));
    let about = "Angle by which it leans away from the axis that bears it.";
    keys.key("nod_deg", &mut flower.nod, limits, about);
    let limits = DegreesList::<2>(Limits::closed(3.0, 170.0));
    let about = "Angles of the feet of sepals and of petals from the flower's axis.";
    keys.key("angles_deg", &mut flower.angles, limits, about);
    let lengths = || Numbers::<2>(Limits::closed(0.2, 100.0));
    let about = "Lengths of filament and anther.";
    keys.key("stamens_mm", &mut flower.stamens_mm, lengths(), about);
    let about = "Lengths of ovary and stigmas.";
    keys.key("pistil_mm", &mut flower.pistil_mm, lengths(), about);
}

fn climbing(climbing: &mut Climbing, keys: &mut Keys<'_>) {
    let about = "Away from the wall, in the plant's frame; any length but 0. The wall goes through \
        the plant's foot.";
    let limits = Vector(Limits::closed(-1e6, 1e6));
    keys.key("away", &mut climbing.away, limits, about);
    match climbing.away.try_normalize() {
        Some(away) => climbing.away = away,
        None => keys.refuse(
            &["away"],
            "a direction of length 0 is none".to_owned(),
            "write the direction in which the wall faces, such as `[1, 0, 0]`",
        ),
    }
    let limits = Degrees(Limits::closed(0.0, 85.0));
    let about = "Angle by which petioles stand off the wall.";
    keys.key("lift_deg", &mut climbing.lift, limits, about);
    let limits = Number(Limits::closed(0.0, 1000.0));
    let about = "Least distance between blades, taken flat, and the wall.";
    keys.key("clearance_mm", &mut climbing.clearance_mm, limits, about);
    let limits = Number(Limits::closed(0.0, 20.0));
    let about = "Adventitious roots by which axes hold on, for each millimetre of them.";
    keys.key(
        "rootlets_per_mm",
        &mut climbing.rootlets_per_mm,
        limits,
        about,
    );
}

fn pot(pot: &mut PotPlan, keys: &mut Keys<'_>) {
    let extent = || Number(Limits::closed(20.0, 2000.0));
    let about = "Outer diameter at the rim.";
    keys.key("diameter_mm", &mut pot.diameter_mm, extent(), about);
    let about = "Height, without the dish.";
    keys.key("height_mm", &mut pot.height_mm, extent(), about);
    let about = "Diameter of the foot over that at the top of the body, without the rim.";
    keys.key(
        "taper",
        &mut pot.taper,
        Number(Limits::closed(0.3, 1.0)),
        about,
    );
    let limits = Number(Limits::closed(1.0, 100.0));
    keys.key(
        "wall_mm",
        &mut pot.wall_mm,
        limits,
        "Thickness of the wall.",
    );
    let limits = Numbers::<2>(Limits::closed(0.0, 500.0));
    let about = "Height of the rim, and how far it stands out; with a 0 there is none.";
    keys.key("rim_mm", &mut pot.rim_mm, limits, about);
    let about = "Whether it stands in a dish.";
    keys.key("dish", &mut pot.dish, Flag, about);
    let about = "Height of the soil over that of the pot.";
    keys.key(
        "fill",
        &mut pot.fill,
        Number(Limits::closed(0.2, 1.0)),
        about,
    );
    let limits = Number(Limits::closed(0.0, 100.0));
    let about = "Crumbs for each square centimetre of soil.";
    keys.key("crumbs_per_cm2", &mut pot.crumbs_per_cm2, limits, about);
    let limits = Number(Limits::closed(0.1, 50.0));
    let about = "Radius of the largest crumbs; most are much smaller.";
    keys.key("crumb_mm", &mut pot.crumb_mm, limits, about);
    let about = "Moisture of the soil, from 0 dry to 1 wet.";
    keys.key("moisture", &mut pot.moisture, Number(SHARE), about);
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
