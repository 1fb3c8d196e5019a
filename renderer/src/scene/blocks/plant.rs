//! `[plants.NAME]`: a bough or shoot that bears leaves of the scene.

use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Numbers;
use leafmodel::plan_file;

use super::name_list::NamesIn;
use super::scatter::refuse_ages_of_one;
use crate::scene::authored::Plant;

/// The keys of one of `[plants]`.
pub(super) fn plant(plant: &mut Plant, keys: &mut Keys<'_>) {
    plan_file::plant_preset(&mut plant.plan, keys);
    let mut leaves = Vec::new();
    let kind = NamesIn("leaves", "the name of a leaf");
    let about = "The leaf that it bears; of a list, those from the foot of each axis to its tip.";
    keys.needed("leaf", &mut leaves, kind, about);
    plant.leaves = leaves.into_iter().map(|(leaf, _)| leaf).collect();
    let about = "Days of ageing of its youngest and its oldest individuals, the others between; young \
        and old stand mixed. The leaves need `senescence` by `day`.";
    keys.optional(
        "days",
        &mut plant.days,
        Numbers::<2>(plan_file::DAYS),
        about,
    );
    let kind = NameIn("materials", "the name of a material");
    let about = "What its axes and buds are made of; left out, young brown bark.";
    keys.optional("bark", &mut plant.bark, kind, about);
    let mut walls = Vec::new();
    let kind = NamesIn("objects", "the name of an object");
    let about = "The objects on which it climbs, each a mesh in one place; left out, an even wall.";
    keys.key("wall", &mut walls, kind, about);
    plant.walls = walls.into_iter().map(|(object, _)| object).collect();
    let [sepal, petal] = &mut plant.perianth;
    let about = "The leaf that is a sepal of its flower.";
    let kind = || NameIn("leaves", "the name of a leaf");
    keys.optional("sepal", sepal, kind(), about);
    let about = "The leaf that is a petal of its flower.";
    keys.optional("petal", petal, kind(), about);
    let [pot, soil] = &mut plant.potting;
    let kind = || NameIn("materials", "the name of a material");
    let about = "What its pot and dish are made of; left out, fired clay.";
    keys.optional("pot_material", pot, kind(), about);
    let about = "What the soil in its pot is made of; left out, measured soil of its moisture.";
    keys.optional("soil_material", soil, kind(), about);
    plan_file::plant(&mut plant.plan, keys);
    refuse_ages_of_one(plant.plan.individuals, plant.days, keys);
    let is_there = |what: &Option<usize>| what.is_some();
    if plant.plan.flower.is_some() && !plant.perianth.iter().all(is_there) {
        let help = "name a leaf as `sepal` and one as `petal`, such as of the presets \
            `trillium-sepal` and `trillium-petal`";
        keys.refuse(&[], "its flower lacks sepals or petals".to_owned(), help);
    }
    if !plant.walls.is_empty() && plant.plan.climbing.is_none() {
        let help = "give it a block `climbing`, or leave `wall` out";
        keys.refuse(&["wall"], "the plant does not climb".to_owned(), help);
    }
}
