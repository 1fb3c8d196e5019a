//! What is told of a canopy's fluxes, and the sums that it is made of.

use std::collections::BTreeSet;

use super::constituents;
use super::flux::{Event, LANES};
use super::stage::Stage;
use crate::scene::description::{Canopy, Description};
use crate::spectrum::{Lanes, Wavelengths};

/// Fraction of the light at an event within which it may be rounded: some units of the last place of
/// single precision.
const ROUNDING: f64 = 5e-7;

/// What is told of each wavelength.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    pub(super) word: &'static str,
    pub(super) part: Option<String>,
    /// The word for its photon flux, and what that is multiplied with.
    pub(super) photons: Option<(&'static str, f64)>,
}

/// The places of the sums of quantities, by lanes, behind the denominator.
#[derive(Debug)]
pub(super) struct Ledger {
    pub(super) quantities: Vec<Quantity>,
    /// Number of the first quantity of objects, and which object each is.
    pub(super) objects: (usize, Vec<usize>),
    /// Number of the first quantity of layers, and the heights between them.
    layers: (usize, Vec<f32>),
    /// Number of the first quantity of constituents.
    constituents: Option<usize>,
    /// Number of the first quantity of instances, and the number of each of the world's instances
    /// among them.
    instances: Option<(usize, Vec<u32>)>,
    pub(super) soil: Option<usize>,
}

pub(super) const REFLECTED: usize = 0;
pub(super) const TRANSMITTED: usize = 1;
pub(super) const UNCOLLIDED: usize = 2;
const ARRIVING: usize = 3;
const BY_SOIL: usize = 4;

impl Ledger {
    /// The ledger of a canopy whose ground has this area, m².
    pub(super) fn new(
        scene: &Description,
        stage: &Stage<'_>,
        canopy: &Canopy,
        ground: f64,
    ) -> Self {
        let own = |word, photons| Quantity {
            word,
            part: None,
            photons,
        };
        let in_parts = |word, part, photons| Quantity {
            word,
            part: Some(part),
            photons: Some((photons, 1.0)),
        };
        let mut quantities = vec![
            own("reflected", Some(("reflected_photon_flux", 1.0))),
            own("transmitted", Some(("transmitted_photon_flux", 1.0))),
            own("uncollided", None),
        ];
        if canopy.soil.is_some() {
            let arriving = Some(("photon_flux_arriving_at_soil", 1.0));
            quantities.push(own("arriving_at_soil", arriving));
            let by_soil = Some(("photon_flux_absorbed_by_soil", 1.0));
            quantities.push(own("absorbed_by_soil", by_soil));
        }
        let seen = (0..stage.objects.len()).map(|instance| stage.objects[instance].object);
        // Of what is spread there may be no copy in the box, or none at all.
        let spread =
            (0..scene.objects.len()).filter(|&object| scene.objects[object].value.is_spread());
        let numbers: BTreeSet<usize> = seen
            .chain(spread)
            .filter(|object| Some(*object) != canopy.soil)
            .collect();
        let objects = (quantities.len(), numbers.into_iter().collect::<Vec<_>>());
        let names = objects
            .1
            .iter()
            .map(|&object| scene.objects[object].name.clone());
        quantities.extend(names.map(|name| in_parts("absorbed", name, "absorbed_photon_flux")));
        let first_layer = quantities.len();
        let borders = &canopy.layers;
        if let [lowest, .., highest] | [lowest @ highest] = borders.as_slice() {
            let between = borders.windows(2);
            let between = between.map(|pair| format!("{} to {} m", pair[0], pair[1]));
            let below = std::iter::once(format!("below {lowest} m"));
            let names = below.chain(between).chain([format!("above {highest} m")]);
            let photons = "photon_flux_absorbed_in_layer";
            quantities.extend(names.map(|name| in_parts("absorbed_in_layer", name, photons)));
        }
        let constituents = canopy.constituents.then(|| {
            let first = quantities.len();
            let word = "absorbed_by_constituent";
            let photons = "photon_flux_absorbed_by_constituent";
            let names = constituents::names().map(str::to_owned);
            quantities.extend(names.map(|name| in_parts(word, name, photons)));
            first
        });
        let instances = canopy.instances.then(|| {
            let first = quantities.len();
            let (named, numbers) = by_instance(scene, stage, canopy, ground);
            quantities.extend(named);
            (first, numbers)
        });
        let origin = stage.geometry.origin().z;
        Self {
            quantities,
            objects,
            layers: (
                first_layer,
                borders.iter().map(|z| (z - origin) as f32).collect(),
            ),
            constituents,
            instances,
            soil: canopy.soil,
        }
    }

    /// Adds what is left at an event.
    pub(super) fn add(
        &self,
        stage: &Stage<'_>,
        event: &Event,
        wavelengths: &Wavelengths<LANES>,
        sums: &mut [f64],
    ) {
        let absorbed = std::array::from_fn(|lane| {
            let [before, after] =
                [event.before, event.after].map(|weight| f64::from(weight.0[lane]));
            // What is within rounding is nothing: of many events it would be something.
            let absorbed = before - after;
            if absorbed.abs() <= ROUNDING * before {
                0.0
            } else {
                absorbed
            }
        });
        if Some(event.object) == self.soil {
            if event.is_scattered {
                add(sums, ARRIVING, &event.before);
            }
            add_each(sums, BY_SOIL, &absorbed);
            return;
        }
        let (first, objects) = &self.objects;
        let place = objects.partition_point(|object| *object < event.object);
        add_each(sums, first + place, &absorbed);
        let (first, borders) = &self.layers;
        if !borders.is_empty() {
            let layer = borders.partition_point(|border| *border < event.position.z);
            add_each(sums, first + layer, &absorbed);
        }
        if let Some(first) = self.constituents {
            let parts = constituents::absorbed(stage, event, wavelengths);
            for (part, absorbed) in parts.iter().enumerate() {
                add(sums, first + part, absorbed);
            }
        }
        // No medium stands where instances are told.
        if let (Some((first, numbers)), Some(instance)) = (&self.instances, event.instance) {
            let number = numbers[stage.numbers[instance as usize] as usize];
            add_each(sums, first + number as usize, &absorbed);
        }
    }
}

/// Adds to the lanes of a quantity.
pub(super) fn add(sums: &mut [f64], quantity: usize, values: &Lanes<LANES>) {
    add_each(sums, quantity, &values.0.map(f64::from));
}

/// Adds numbers to the lanes of a quantity.
pub(super) fn add_each(sums: &mut [f64], quantity: usize, values: &[f64; LANES]) {
    for (sum, value) in sums[1 + quantity * LANES..].iter_mut().zip(values) {
        *sum += value;
    }
}

/// The instances of a stage without soil: a quantity for each, and the number of each of the world's
/// instances among them.
///
/// They are named after their object and their number in it. Their photon fluxes are by the area of
/// one side of their triangles.
fn by_instance(
    scene: &Description,
    stage: &Stage<'_>,
    canopy: &Canopy,
    ground: f64,
) -> (Vec<Quantity>, Vec<u32>) {
    let world = stage.world;
    let shown: BTreeSet<u32> = stage.numbers.iter().copied().collect();
    let mut numbers = vec![u32::MAX; world.objects.len()];
    let mut in_object = vec![0_u32; scene.objects.len()];
    let mut quantities = Vec::new();
    for (number, place) in numbers.iter_mut().enumerate() {
        let object = world.objects[number].object;
        let own = in_object[object];
        in_object[object] += 1;
        if Some(object) == canopy.soil || !shown.contains(&(number as u32)) {
            continue;
        }
        *place = quantities.len() as u32;
        let area = stage.world.geometry.area_of(number as u32);
        let photons = "photon_flux_absorbed_by_instance";
        quantities.push(Quantity {
            word: "absorbed_by_instance",
            part: Some(format!("{} {own}", scene.objects[object].name)),
            photons: (area > 0.0).then_some((photons, ground / area)),
        });
    }
    (quantities, numbers)
}
