//! Leaves of one kind that are not alike: individuals, and days of ageing.

use leafmodel::blade::senescence::AgeSource;
use leafmodel::document::keys::Keys;
use leafmodel::document::names::Named;

use crate::scene::description::{Description, Leaf, ObjectShape};

/// A leaf, and others of its kind.
pub(super) fn individuals(leaf: &Leaf, count: u32) -> Vec<Leaf> {
    let other = |number: u32| Leaf {
        plan: leaf.plan.individual(None, number.into()),
        ..leaf.clone()
    };
    std::iter::once(leaf.clone())
        .chain((1..count).map(other))
        .collect()
}

/// Gives objects that are strewn the different leaves that they ask for; `keys` are those at the
/// top of the file, to which what is wrong is reported.
pub(in crate::scene) fn grow_apart(scene: &mut Description, keys: &Keys<'_>) {
    for number in 0..scene.objects.len() {
        let object = &scene.objects[number];
        let Some(strewn) = &object.value.strewn else {
            continue;
        };
        let (name, count, days) = (object.name.clone(), strewn.individuals, strewn.days);
        if count == 1 && days.is_none() {
            continue;
        }
        let mut shapes = Vec::new();
        for (place, shape) in object.value.shapes.clone().into_iter().enumerate() {
            let ObjectShape::Leaf { leaf } = shape else {
                shapes.push(shape);
                continue;
            };
            let mut leaves = individuals(&scene.leaves[leaf].value, count);
            if let Some(days) = days
                && !age(&mut leaves, days)
            {
                let problem = format!(
                    "the leaf `{}` does not age by days",
                    scene.leaves[leaf].name
                );
                let help = "give it a block `senescence` with a `day`";
                keys.refuse(&["objects", &name, "scatter", "days"], problem, help);
                return;
            }
            // The first is the leaf itself, unless another object or place shows it at its own age.
            let own = days.is_none() || users(scene, leaf) == 1;
            for (number, value) in leaves.into_iter().enumerate() {
                let leaf = if number == 0 && own {
                    scene.leaves[leaf].value = value;
                    leaf
                } else {
                    let of = &scene.leaves[leaf].name;
                    // A list may hold the same leaf twice.
                    let name = format!("{of}.{name}.{}.{}", place + 1, number + 1);
                    scene.leaves.push(Named { name, value });
                    scene.leaves.len() - 1
                };
                shapes.push(ObjectShape::Leaf { leaf });
            }
        }
        scene.objects[number].value.shapes = shapes;
    }
}

/// Spreads ages evenly over leaves; false if one of them has none.
fn age(leaves: &mut [Leaf], [first, last]: [f64; 2]) -> bool {
    let steps = (leaves.len() - 1).max(1) as f64;
    leaves.iter_mut().enumerate().all(|(number, leaf)| {
        let source = leaf.plan.senescence.as_mut().map(|age| &mut age.source);
        let Some(AgeSource::Day { day, .. }) = source else {
            return false;
        };
        *day = first + (last - first) * number as f64 / steps;
        true
    })
}

/// How often a leaf stands in objects and plants.
fn users(scene: &Description, leaf: usize) -> usize {
    let shape = ObjectShape::Leaf { leaf };
    let objects = scene.objects.iter().flat_map(|object| &object.value.shapes);
    let borne = scene.plants.iter().flat_map(|plant| &plant.value.leaves);
    objects.filter(|own| **own == shape).count() + borne.filter(|own| **own == leaf).count()
}
