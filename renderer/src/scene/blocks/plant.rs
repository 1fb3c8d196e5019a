//! `[plants.NAME]`: a bough or shoot that bears leaves of the scene.

use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::plan_file;

use super::name_list::NamesIn;
use crate::scene::description::Plant;

/// The keys of one of `[plants]`.
pub(super) fn plant(plant: &mut Plant, keys: &mut Keys<'_>) {
    plan_file::plant_preset(&mut plant.plan, keys);
    let mut leaves = Vec::new();
    let kind = NamesIn("leaves", "the name of a leaf");
    let about = "The leaf that it bears; of a list, those from the foot of each axis to its tip.";
    keys.needed("leaf", &mut leaves, kind, about);
    plant.leaves = leaves.into_iter().map(|(leaf, _)| leaf).collect();
    let kind = NameIn("materials", "the name of a material");
    let about = "What its axes and buds are made of; left out, young brown bark.";
    keys.optional("bark", &mut plant.bark, kind, about);
    plan_file::plant(&mut plant.plan, keys);
}
