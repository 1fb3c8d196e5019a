//! `contents`: what a leaf holds per leaf area, PROSPECT-D's inputs and betalains.

use leafmodel::optics::Contents;

use super::limits::Limits;
use super::reader::Block;

/// Keys of contents, in the order of [`Contents::to_array`].
pub(crate) const KEYS: [&str; Contents::COUNT] = [
    "structure",
    "chlorophyll_ug_per_cm2",
    "carotenoids_ug_per_cm2",
    "anthocyanins_ug_per_cm2",
    "betacyanins_ug_per_cm2",
    "betaxanthins_ug_per_cm2",
    "brown",
    "water_cm",
    "dry_matter_g_per_cm2",
];

/// Number of plates.
pub(crate) const STRUCTURE: Limits = Limits::closed(1.0, 10.0);

/// Reads a block of contents.
pub(crate) fn read_contents(block: &Block<'_>) -> Option<Contents> {
    const PIGMENT: Limits = Limits::closed(0.0, 1000.0);
    let structure = block.number("structure", STRUCTURE);
    let chlorophyll = block.number("chlorophyll_ug_per_cm2", PIGMENT);
    let carotenoids = block.number("carotenoids_ug_per_cm2", PIGMENT);
    let anthocyanins = block.number_or("anthocyanins_ug_per_cm2", PIGMENT, 0.0);
    let betacyanins = block.number_or("betacyanins_ug_per_cm2", PIGMENT, 0.0);
    let betaxanthins = block.number_or("betaxanthins_ug_per_cm2", PIGMENT, 0.0);
    let brown = block.number_or("brown", Limits::closed(0.0, 100.0), 0.0);
    let water = block.number("water_cm", Limits::closed(0.0, 1.0));
    let dry_matter = block.number("dry_matter_g_per_cm2", Limits::closed(0.0, 1.0));
    block.finish();
    let contents = Contents {
        structure: structure?,
        chlorophyll: chlorophyll?,
        carotenoids: carotenoids?,
        anthocyanins,
        betacyanins,
        betaxanthins,
        brown,
        water: water?,
        dry_matter: dry_matter?,
    };
    if contents.mixes_betalains_and_anthocyanins() {
        block.cx.warn(
            &block.at,
            "scene::betalains_and_anthocyanins",
            "this leaf holds betalains and anthocyanins, which never occur in the same plant"
                .to_owned(),
            Contents::NEVER_TOGETHER,
        );
    }
    Some(contents)
}

/// Reads a block of contents of which all may be left out, and are then those of `base`.
pub(crate) fn read_changed(block: &Block<'_>, base: Contents) -> Contents {
    const PIGMENT: Limits = Limits::closed(0.0, 1000.0);
    let mut contents = base;
    for (key, limits, value) in [
        ("structure", STRUCTURE, &mut contents.structure),
        ("chlorophyll_ug_per_cm2", PIGMENT, &mut contents.chlorophyll),
        ("carotenoids_ug_per_cm2", PIGMENT, &mut contents.carotenoids),
        (
            "anthocyanins_ug_per_cm2",
            PIGMENT,
            &mut contents.anthocyanins,
        ),
        ("betacyanins_ug_per_cm2", PIGMENT, &mut contents.betacyanins),
        (
            "betaxanthins_ug_per_cm2",
            PIGMENT,
            &mut contents.betaxanthins,
        ),
        ("brown", Limits::closed(0.0, 100.0), &mut contents.brown),
        ("water_cm", Limits::closed(0.0, 1.0), &mut contents.water),
        (
            "dry_matter_g_per_cm2",
            Limits::closed(0.0, 1.0),
            &mut contents.dry_matter,
        ),
    ] {
        *value = block.number_or(key, limits, *value);
    }
    block.finish();
    contents
}
