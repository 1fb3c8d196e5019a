//! What is absorbed in tissue, by constituent.
//!
//! A constituent takes the share of what a leaf absorbs that it has in the absorption coefficient of
//! PROSPECT's plate, `Cᵢ Kᵢ / Σ C K`, with the contents at the place of the event. The plates absorb
//! alike everywhere, so this split is exact for the model. What materials without known contents
//! absorb, and what leaves with measured spectra do, is `other`.

use leafmodel::optics::{Constituent, Texel};

use super::flux::{Event, LANES};
use super::stage::Stage;
use crate::material::Material;
use crate::spectrum::{Lanes, Wavelengths};

/// Number of parts: the constituents that absorb, and `other`.
pub(super) const PARTS: usize = Constituent::ABSORBING.len() + 1;

/// Their names, in order.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let named = Constituent::ABSORBING.into_iter().map(Constituent::name);
    named.chain(std::iter::once("other"))
}

/// What each part absorbs at an event.
pub(super) fn absorbed(
    stage: &Stage<'_>,
    event: &Event,
    wavelengths: &Wavelengths<LANES>,
) -> [Lanes<LANES>; PARTS] {
    let mut parts = [Lanes::ZERO; PARTS];
    let all = event.before - event.after;
    let material = event.instance.map(|instance| stage.material_of(instance));
    let tissue = material.and_then(Material::tissue);
    let Some((tissue, held)) = tissue.and_then(|tissue| Some((tissue, tissue.held?))) else {
        parts[PARTS - 1] = all;
        return parts;
    };
    let contents = held.at(event.uv);
    let pile = tissue.palette.lanes(wavelengths);
    let whole = pile.absorption(&contents);
    for (part, constituent) in parts.iter_mut().zip(Constituent::ABSORBING) {
        let alone = Texel::splat(0.0).with(&[(constituent, contents[constituent])]);
        let alone = pile.absorption(&alone);
        *part = Lanes::from_fn(|lane| {
            if whole[lane] > 0.0 {
                all.0[lane] * (alone[lane] / whole[lane])
            } else {
                0.0
            }
        });
    }
    // Of tissue that absorbs nothing: what roulette has moved.
    let nothing = |lane: usize| if whole[lane] > 0.0 { 0.0 } else { all.0[lane] };
    parts[PARTS - 1] = Lanes::from_fn(nothing);
    parts
}
