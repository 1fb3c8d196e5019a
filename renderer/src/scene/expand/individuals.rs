//! Leaves of one kind that are not alike: individuals, and days of ageing.

use leafmodel::blade::senescence::AgeSource;

use super::planted::{Fault, Planted, add};
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

/// Gives objects that are strewn the different leaves that they ask for.
pub(super) fn grow_apart(scene: &mut Description, planted: &Planted) -> Result<(), Fault> {
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
            if let Some(days) = days {
                if let Some((problem, help)) = ageless(scene, &[leaf]) {
                    let path = &["objects", &name, "scatter", "days"];
                    return Err(Fault::new(path, problem, help));
                }
                age(&mut leaves, days, |number| number);
            }
            // The first is the leaf itself, unless another object or place shows it at its own age.
            let own = days.is_none() || users(scene, planted, leaf) == 1;
            for (number, value) in leaves.into_iter().enumerate() {
                let leaf = if number == 0 && own {
                    scene.leaves[leaf].value = value;
                    leaf
                } else {
                    let of = &scene.leaves[leaf].name;
                    // A list may hold the same leaf twice.
                    let name = format!("{of}.{name}.{}.{}", place + 1, number + 1);
                    add(&mut scene.leaves, name, value)
                };
                shapes.push(ObjectShape::Leaf { leaf });
            }
        }
        scene.objects[number].value.shapes = shapes;
    }
    Ok(())
}

/// Why one of these leaves cannot have days of ageing, and what to do; `None` if all can.
pub(super) fn ageless(scene: &Description, leaves: &[usize]) -> Option<(String, &'static str)> {
    let ages = |leaf: &Leaf| {
        let senescence = leaf.plan.senescence;
        senescence.is_some_and(|age| matches!(age.source, AgeSource::Day { .. }))
    };
    let mut leaves = leaves.iter().map(|&leaf| &scene.leaves[leaf]);
    let leaf = leaves.find(|leaf| !ages(&leaf.value))?;
    let problem = format!("the leaf `{}` does not age by days", leaf.name);
    Some((problem, "give it a block `senescence` with a `day`"))
}

/// Spreads ages evenly over leaves that [`ageless`] lets pass, by the rank of each from 0.
pub(super) fn age(leaves: &mut [Leaf], [first, last]: [f64; 2], rank: impl Fn(usize) -> usize) {
    let steps = (leaves.len() - 1).max(1) as f64;
    for (number, leaf) in leaves.iter_mut().enumerate() {
        let source = leaf.plan.senescence.as_mut().map(|age| &mut age.source);
        if let Some(AgeSource::Day { day, .. }) = source {
            *day = first + (last - first) * rank(number) as f64 / steps;
        }
    }
}

/// Ranks of so many leaves of which one follows the other along an axis, and the first the last, in
/// which neighbours are far apart, as leaves are by the golden angle; the first has the least.
pub(super) fn scattered_ranks(count: usize) -> impl Fn(usize) -> usize {
    // (√5 − 1) / 2 of a turn, or as much the other way round, so that the last is far from the first.
    let golden = 0.618_033_988_749_894_9;
    let last = count.saturating_sub(1) as f64 * golden;
    let step = if last.fract() < 0.5 {
        1.0 - golden
    } else {
        golden
    };
    let turn = move |number: usize| (number as f64 * step).fract();
    move |number| {
        let before = (0..count).filter(|&other| turn(other) < turn(number));
        before.count()
    }
}

/// How often a leaf stands in objects and in plants that objects are.
pub(super) fn users(scene: &Description, planted: &Planted, leaf: usize) -> usize {
    let shape = ObjectShape::Leaf { leaf };
    let objects = scene.objects.iter().flat_map(|object| &object.value.shapes);
    let plants = planted.plants.iter().enumerate();
    let plants = plants.filter(|(number, _)| planted.of_object.contains(&Some(*number)));
    let borne = plants.flat_map(|(_, plant)| {
        let perianth = plant.value.perianth.iter().flatten();
        plant.value.leaves.iter().chain(perianth)
    });
    objects.filter(|own| **own == shape).count() + borne.filter(|own| **own == leaf).count()
}

#[cfg(test)]
mod tests {
    use super::scattered_ranks;

    #[test]
    fn neighbours_in_a_ring_of_leaves_are_far_apart_in_rank() {
        for count in 3..40 {
            let rank = scattered_ranks(count);
            let ranks: Vec<usize> = (0..count).map(&rank).collect();
            let mut sorted = ranks.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..count) && ranks[0] == 0);
            let next = ranks.iter().cycle().skip(1);
            let apart = ranks.iter().zip(next).map(|(a, b)| a.abs_diff(*b));
            let least = apart.min().expect("there are some");
            assert!(5 * (least + 1) >= count, "{count}: {least}");
        }
    }
}
